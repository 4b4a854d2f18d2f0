#include "camera/check.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "numbers/double_double.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr const char* kAngle = "expected a number of degrees, \"60deg\" or \"1.0472rad\"";

std::optional<Angle> readAngle(const Json& value) {
  if (value.is_number()) return Angle(value.get<double>());
  if (!value.is_string()) return std::nullopt;
  const std::string_view text = value.get_ref<const std::string&>();
  for (const auto& [unit, isRadians] : {std::pair("deg", false), {"\xC2\xB0", false}, {"rad", true}})
    if (text.ends_with(unit))
      if (const auto number = parseNumber(text.substr(0, text.size() - std::string_view(unit).size())))
        return isRadians ? Angle::radians(*number) : Angle(*number);
  return std::nullopt;
}

double inDegrees(Angle angle) {
  constexpr DoubleDouble kDegreesOfRadian{57.29577951308232, -1.9878495670576283e-15};
  return angle.isRadians ? (DoubleDouble(angle.value) * kDegreesOfRadian).hi : angle.value;
}

std::optional<Aspect> readRatio(const Json& value) {
  if (value.is_number()) return Aspect(value.get<double>());
  if (!value.is_string()) return std::nullopt;
  const std::string_view text = value.get_ref<const std::string&>();
  const std::size_t mark = text.find_first_of("/:");
  if (mark == std::string_view::npos) return std::nullopt;
  const auto over = parseNumber(text.substr(0, mark)), under = parseNumber(text.substr(mark + 1));
  if (!over || !under) return std::nullopt;
  return Aspect(*over, *under);
}

void requireNotAllZero(const std::vector<double>& numbers, const Node& value) {
  if (std::all_of(numbers.begin(), numbers.end(), [](double n) { return n == 0; })) value.fail("must not be all 0");
}

void checkAngle(const Node& value, double least, double most, const char* range) {
  const auto angle = readAngle(value.json());
  if (!angle) value.fail(kAngle);
  const double degrees = inDegrees(*angle);
  if (!(degrees >= least && degrees <= most) || !std::isfinite(degrees))
    value.fail(std::string("expected an angle ") + range);
}

void checkRigid(const Node& value) {
  if (!value.json().is_object() || value.json().contains("data")) {
    requireAffine(value.mat4(), value);
    return;
  }
  allowMembers(value, {"rotation", "rotationVector", "translation"});
  const auto rotation = value.find("rotation"), vector = value.find("rotationVector");
  if (rotation && vector) value.fail("rotation and rotationVector are the same thing; keep one");
  if (!rotation && !vector) value.fail("needs rotation or rotationVector");
  if (vector) (void)vector->numbers(3);
  if (rotation && !rotation->holdsNumbers(4) && !rotation->holdsNumbers(9))
    rotation->fail("expected [x, y, z, w] or 3 rows of 3 numbers");
  (void)value.require("translation").numbers(3);
}

/// The numbers of a model of a lens.
struct LensNumbers {
  std::vector<std::string_view> required, others;
};

LensNumbers numbersOf(LensModel model) {
  switch (model) {
    case LensModel::brown:
      return {{}, {"k", "p"}};
    case LensModel::fisheye:
      return {{}, {"k"}};
    case LensModel::unified:
      return {{"alpha"}, {"beta"}};
    case LensModel::doubleSphere:
      return {{"xi", "alpha"}, {}};
    case LensModel::omni:
      return {{"xi"}, {"k", "p"}};
    case LensModel::fov:
      return {{"omega"}, {}};
  }
  return {};
}

void checkLensLimit(const Node& limit, bool isBrown) {
  if (limit.find("degrees") && limit.find("radius")) limit.fail("degrees and radius are the same thing; keep one");
  if (isBrown) {
    allowMembers(limit, {"degrees", "radius"});
    if (const auto radius = limit.find("radius")) {
      if (!(radius->number() > 0)) limit.fail("must be above 0");
      return;
    }
  }
  allowMembers(limit, {"degrees"});
  if (const double degrees = limit.require("degrees").number(); !(degrees > 0 && degrees <= 180))
    limit.fail("expected degrees above 0 and up to 180");
}

void checkLens(const Node& value) {
  if (!value.json().is_object()) value.fail("expected an object");
  const Node model = value.require("model");
  const auto models = wordsOf<kLensModelNames>();
  if (std::find(models.begin(), models.end(), model.text()) == models.end())
    model.fail("is not a known model; known are " + joined(models));
  const LensModel which = valueOf(kLensModelNames, model.text());
  const LensNumbers numbers = numbersOf(which);
  std::vector<std::string_view> members = {"model"};
  members.insert(members.end(), numbers.required.begin(), numbers.required.end());
  members.insert(members.end(), numbers.others.begin(), numbers.others.end());
  members.push_back("limit");
  for (const char* const number : {"k", "p", "xi", "alpha", "beta", "omega"})
    if (const auto member = value.find(number);
        member && std::find(members.begin(), members.end(), number) == members.end())
      member->fail("does not belong to the model " + std::string(model.text()));
  allowMembers(value, members);
  for (const std::string_view number : numbers.required) (void)value.require(number).number();
  if (const auto beta = value.find("beta"); beta && !(beta->number() > 0)) beta->fail("expected a number above 0");
  const auto k = value.find("k"), p = value.find("p");
  const std::size_t count = k ? k->size() : 0;
  const bool isFisheye = which == LensModel::fisheye;
  if (k && count > 0) (void)k->numbers(count);
  if (isFisheye ? count > 4 : !(count <= 3 || count == 6))
    k->fail(isFisheye ? "expected up to 4 numbers" : "expected 1, 2, 3 or 6 numbers");
  if (p) (void)p->numbers(2);
  if (const auto limit = value.find("limit")) checkLensLimit(*limit, which == LensModel::brown);
}

/// Fails at a member that is not known. Its value does not matter, so it is not shown.
[[noreturn]] void failUnknown(const Node& value, const std::string& hint) {
  static const Json kNothing;
  Node(value.document(), kNothing, value.path()).fail("is not known" + hint);
}

void checkMembers(const Node& object) {
  const std::vector<std::string_view> names = namesUnder(object.path());
  for (const auto& item : object.json().items()) {
    const Node value(object.document(), item.value(), joinedPath(object.path(), item.key()));
    if (std::find(names.begin(), names.end(), item.key()) == names.end()) {
      if (value.path() == "projection.fov")
        value.fail(
            "does not say which angle: fovY is from bottom to top (OpenGL, Direct3D, Unity, three.js), fovX from left "
            "to right (Unreal)");
      failUnknown(value, suggestField(value.path(), item.key(), names));
    }
    if (item.value().is_null()) continue;
    if (const Field* field = findField(value.path()))
      checkValue(value, *field);
    else if (!item.value().is_object())
      value.fail("expected an object");
    else
      checkMembers(value);
  }
}

}  // namespace

std::vector<std::string_view> namesUnder(std::string_view prefix) {
  std::vector<std::string_view> names;
  for (const Field& field : kFields) {
    std::string_view rest = field.path;
    if (!prefix.empty() && !(rest.starts_with(prefix) && rest.substr(prefix.size()).starts_with('.'))) continue;
    if (!prefix.empty()) rest.remove_prefix(prefix.size() + 1);
    const std::string_view name = rest.substr(0, rest.find('.'));
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

void allowMembers(const Node& object, const std::vector<std::string_view>& names) {
  if (!object.json().is_object()) object.fail("expected an object");
  for (const auto& item : object.json().items())
    if (std::find(names.begin(), names.end(), item.key()) == names.end())
      failUnknown(Node(object.document(), item.value(), joinedPath(object.path(), item.key())),
                  suggestion(item.key(), names));
}

void requireAffine(const Mat4& m, const Node& value) {
  if (m[3] == std::array<double, 4>{0, 0, 0, 1}) return;
  const bool isTransposed = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
  value.fail(std::string("the last row is not 0 0 0 1") + (isTransposed ? "; transpose the matrix" : ""));
}

std::string suggestField(std::string_view path, std::string_view name, const std::vector<std::string_view>& names) {
  for (const Field& field : kFields)
    if (path.substr(path.rfind('.') + 1) == field.path.substr(field.path.rfind('.') + 1))
      return "; did you mean '" + std::string(field.path) + "'?";
  return suggestion(name, names, "help camera");
}

Angle angleOf(const Node& value) { return readAngle(value.json()).value_or(Angle(0)); }
double degreesOf(const Node& value) { return inDegrees(angleOf(value)); }
Aspect ratioOf(const Node& value) { return readRatio(value.json()).value_or(Aspect(1)); }

void checkValue(const Node& value, const Field& field) {
  switch (field.kind) {
    case Kind::text:
      return (void)value.text();
    case Kind::word: {
      const auto words = field.words();
      if (!value.json().is_string()) value.fail("expected " + alternatives(words));
      if (std::find(words.begin(), words.end(), value.text()) == words.end())
        value.fail("is not known" + suggestion(value.text(), words, "help conventions"));
      return;
    }
    case Kind::flag:
      return (void)value.flag();
    case Kind::number:
      return (void)value.number();
    case Kind::positive:
      if (!(value.number() > 0)) value.fail("expected a number above 0");
      return;
    case Kind::far:
      if (value.json() != "inf" && !value.json().is_number()) value.fail("expected a number or \"inf\"");
      return;
    case Kind::zero:
      if (value.number() != 0) value.fail("must be 0: skewed pixels are not supported");
      return;
    case Kind::ratio: {
      const auto ratio = readRatio(value.json());
      if (!ratio || !(ratio->width > 0 && ratio->height > 0))
        value.fail("expected a ratio above 0, as in 1.78 or \"16/9\"");
      return;
    }
    case Kind::angle: {
      checkAngle(value, 0, 180, "between 0 and 180 degrees");
      const double degrees = degreesOf(value);
      if (degrees == 0 || degrees == 180) value.fail("expected an angle between 0 and 180 degrees");
      return;
    }
    case Kind::elevation:
      return checkAngle(value, -90, 90, "from -90 to 90 degrees");
    case Kind::turn:
      return checkAngle(value, -HUGE_VAL, HUGE_VAL, "in degrees");
    case Kind::pair:
      return (void)value.numbers(2);
    case Kind::range:
      if (const std::vector<double> ends = value.numbers(2); !(ends[0] != ends[1]))
        value.fail("expected two numbers that differ");
      return;
    case Kind::size:
      for (const double side : value.numbers(2))
        if (!(side > 0)) value.fail("expected two numbers above 0");
      return;
    case Kind::direction:
      return requireNotAllZero(value.numbers(3), value);
    case Kind::place:
      if (value.holdsNumbers(3)) return;
      if (!value.json().is_object() || value.json().contains("x")) value.fail("expected x, y, z, or lat, lon, height");
      allowMembers(value, {"lat", "lon", "height"});
      checkAngle(value.require("lat"), -90, 90, "from -90 to 90 degrees");
      checkAngle(value.require("lon"), -HUGE_VAL, HUGE_VAL, "in degrees");
      return (void)value.require("height").number();
    case Kind::quaternion:
      return requireNotAllZero(value.numbers(4), value);
    case Kind::euler: {
      if (!value.json().is_object()) value.fail("expected {\"order\", \"degrees\"}, as an option YXZ:30,20,0");
      allowMembers(value, {"order", "degrees"});
      const Node order = value.require("order"), turns = value.require("degrees");
      if (const auto words = wordsOf<kEulerOrders>();
          std::find(words.begin(), words.end(), order.text()) == words.end())
        order.fail("expected three axes, such as YXZ");
      if (turns.size() != 3) turns.fail("expected three angles");
      for (std::size_t i = 0; i < 3; ++i) checkAngle(turns[i], -HUGE_VAL, HUGE_VAL, "in degrees");
      return;
    }
    case Kind::rigid:
      return checkRigid(value);
    case Kind::matrix:
      (void)value.numbers(16);
      return (void)value.mat4();
    case Kind::lens:
      return checkLens(value);
  }
}

std::string_view shortName(const Field& field) {
  return field.types != 0 ? field.path.substr(field.path.find('.') + 1) : field.path;
}

std::pair<const Field*, const Field*> contradiction(const std::vector<const Field*>& fields) {
  for (const Field* a : fields)
    for (const Field* b : fields) {
      if (a == b) break;
      if (a->group == b->group && a->group != Group::none && (a->sets & b->sets) == 0) return {b, a};
    }
  return {};
}

std::string contradictionMessage(std::string_view first, std::string_view second, Group group) {
  return std::string(first) + " and " + std::string(second) +
         (group == Group::pose ? " both orient the camera; keep one" : " both say what the camera sees; keep one");
}

const Json* valueAt(const Json& root, std::string_view path) {
  const Json* at = &root;
  while (at && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    if (!at->is_object()) return nullptr;
    const auto member = at->find(path.substr(0, dot));
    at = member == at->end() || member->is_null() ? nullptr : &*member;
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return at;
}

std::vector<const Field*> presentFields(const Document& document) {
  std::vector<const Field*> fields;
  for (const Field& field : kFields)
    if (valueAt(*document.root, field.path)) fields.push_back(&field);
  return fields;
}

std::vector<std::string_view> namesOf(const Field& field) {
  std::vector<std::string_view> names{field.path.substr(0, field.path.find('.'))};
  for (std::string_view others = field.others; !others.empty();) {
    names.push_back(others.substr(0, others.find(' ')));
    others.remove_prefix(std::min(names.back().size() + 1, others.size()));
  }
  return names;
}

void normalize(Document& document) {
  Json& root = *document.root;
  if (!root.is_object()) throw InputError(document.name + ": expected a JSON object");
  for (const Field& field : kFields) {
    if (field.others.empty()) continue;
    const std::string name(field.path);
    for (const std::string_view other : namesOf(field)) {
      const auto member = root.find(other);
      if (other == name || member == root.end()) continue;
      if (const auto existing = root.find(name); !member->is_null() && existing != root.end() && !existing->is_null())
        Node(document, *member, std::string(other))
            .fail("is another name of " + name + ", which is there too; keep one");
      Json value = std::move(*member);
      root.erase(member);
      if (value.is_null()) continue;
      root[name] = std::move(value);
      document.labels.emplace(name, document.name + ": " + name + " (as " + std::string(other) + ")");
    }
  }
  if (const auto convention = root.find("convention"); convention != root.end() && convention->is_string())
    *convention = Json{{"preset", *convention}};
}

void check(const Document& document) {
  const Node root(document);
  checkMembers(root);
  const std::vector<const Field*> present = presentFields(document);
  const auto spelled = [&](const Field& field) {
    const auto label = document.labels.find(field.path);
    if (label == document.labels.end()) return shortName(field);
    const std::string_view text = label->second;
    const std::size_t name = text.starts_with(document.name + ": ") ? document.name.size() + 2 : 0;
    return text.substr(name);
  };
  if (const auto projection = root.find("projection")) {
    const auto type = projection->find("type");
    if (!type) projection->fail("needs a type: " + alternatives(wordsOf<kTypeNames>()));
    const std::uint8_t bit = valueOf(kTypeNames, type->text());
    for (const Field* field : present)
      if (field->types != 0 && (field->types & bit) == 0)
        Node(document, *valueAt(*document.root, field->path), std::string(field->path))
            .fail("is not a field of the type " + type->text());
  }
  if (const auto [first, second] = contradiction(present); first)
    root.fail(contradictionMessage(spelled(*first), spelled(*second), first->group));
}

}  // namespace viewproj::cmd
