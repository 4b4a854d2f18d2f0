#include "camera/values.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/rigid.hpp"
#include "camera/sea_level.hpp"
#include "numbers/double_double.hpp"
#include "numbers/vectors.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// A number of degrees, "60deg" or "1.0472rad".
std::optional<Angle> parseAngle(const Json& value) {
  if (value.is_number()) return Angle(value.get<double>());
  if (!value.is_string()) return std::nullopt;
  const std::string_view text = value.get_ref<const std::string&>();
  for (const auto& [unit, isRadians] : {std::pair("deg", false), {"\xC2\xB0", false}, {"rad", true}})
    if (text.ends_with(unit))
      if (const auto number = parseNumber(text.substr(0, text.size() - std::string_view(unit).size())))
        return isRadians ? Angle::radians(*number) : Angle(*number);
  return std::nullopt;
}

/// Above 0 and below 180 degrees.
Angle readFieldOfView(const Node& value) {
  const Angle angle = readAngle(value, 0, 180, "between 0 and 180 degrees");
  const double degrees = degreesOf(angle);
  if (degrees == 0 || degrees == 180) value.fail("expected an angle between 0 and 180 degrees");
  return angle;
}

Aspect readRatio(const Node& value) {
  const Json& json = value.json();
  Aspect ratio(-1);
  if (json.is_number()) {
    ratio = Aspect(json.get<double>());
  } else if (json.is_string()) {
    const std::string_view text = json.get_ref<const std::string&>();
    const std::size_t mark = text.find_first_of("/:");
    const auto over = parseNumber(text.substr(0, mark));
    const auto under = mark == std::string_view::npos ? std::nullopt : parseNumber(text.substr(mark + 1));
    if (over && under) ratio = Aspect(*over, *under);
  }
  if (!(ratio.width > 0 && ratio.height > 0)) value.fail("expected a ratio above 0, as in 1.78 or \"16/9\"");
  return ratio;
}

std::string_view readWord(const Node& value, const Field& field) {
  const auto words = field.words();
  if (!value.json().is_string()) value.fail("expected " + alternatives(words));
  const auto found = std::find(words.begin(), words.end(), value.text());
  if (found == words.end()) value.fail("is not known" + suggestion(value.text(), words, "help conventions"));
  return *found;
}

double readAbove0(const Node& value) {
  if (!(value.number() > 0)) value.fail("expected a number above 0");
  return value.number();
}

double readFar(const Node& value) {
  if (value.json() == "inf") return kInfiniteFar;
  if (!value.json().is_number()) value.fail("expected a number or \"inf\"");
  return value.number();
}

Vec2 readPair(const Node& value, Kind kind) {
  const std::vector<double> ends = value.numbers(2);
  if (kind == Kind::range && !(ends[0] != ends[1])) value.fail("expected two numbers that differ");
  if (kind == Kind::size && !(ends[0] > 0 && ends[1] > 0)) value.fail("expected two numbers above 0");
  return {ends[0], ends[1]};
}

/// This many numbers, of which one is not 0.
std::vector<double> readDirection(const Node& value, std::size_t count) {
  std::vector<double> numbers = value.numbers(count);
  if (std::all_of(numbers.begin(), numbers.end(), [](double n) { return n == 0; })) value.fail("must not be all 0");
  return numbers;
}

Quaternion readQuaternion(const Node& value) {
  if (!value.holdsNumbers(4)) value.fail("expected [x, y, z, w]");
  const std::vector<double> q = readDirection(value, 4);
  return {q[0], q[1], q[2], q[3]};
}

/// An object {x, y, z, w} is as engines write it, and they differ in the axes and the hand of the world.
void requireAxes(const Node& rotation) {
  const Json& root = *rotation.document().root;
  if (!rotation.json().is_object() || valueAt(root, "convention") || valueAt(root, "cameraAxes")) return;
  rotation.fail(
      "{x, y, z, w} needs a convention, for programs differ in their axes: --read-as unity if it is Unity's, --read-as "
      "opengl if it looks along its -z");
}

EulerTurns readEuler(const Node& value) {
  if (!value.json().is_object()) value.fail("expected {\"order\", \"degrees\"}, as an option YXZ:30,20,0");
  allowMembers(value, wordsIn(rowOf(Kind::euler).members));
  if (!value.find("order")) value.fail("needs order, such as YXZ, rpy or opk; --set euler.order=YXZ gives it");
  const Node order = value.require("order"), degrees = value.require("degrees");
  const auto* const row = rowNamed(kEulerOrders, order.text());
  if (!row) order.fail("expected three axes, such as YXZ, or one of rpy, blender, unity, godot, unreal, opk");
  if (degrees.size() != 3) degrees.fail("expected three angles");
  const EulerOrder& as = row->second;
  EulerTurns euler{row, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    Angle angle = readAngle(degrees[as.listed[i]]);
    angle.value *= as.sign[i];
    euler.turns[i] = {static_cast<int>(as.axis[i]), angle};
  }
  return euler;
}

/// A list of poses; a list of lists of numbers is the rows of one.
bool isChain(const Json& value) {
  return value.is_array() && !value.empty() &&
         (value.front().is_object() ||
          (value.front().is_array() && !value.front().empty() && value.front().front().is_array()));
}

/// A turn without a place, of any order that is not of camera axes of its own.
Mat4 rotationOf(const Node& euler) {
  const EulerTurns turns = readEuler(euler);
  if (turns.order->second.cameraAxes)
    euler.fail(std::string(turns.order->first) + " is of a camera's own axes; give it to the field euler");
  const Pose pose = poseFromTurns({}, turns.turns, CameraAxes::RUF);
  Mat4 m;
  for (std::size_t i = 0; i < 3; ++i) m[i] = {pose.right()[i], pose.up()[i], pose.forward()[i], 0};
  return m;
}

MatrixNumbers readMatrix(const Node& value) {
  (void)value.numbers(16);
  return {value.mat4(), value.json().is_array() && value.json().size() == 16};
}

/// Fails at a member that is not known. Its value does not matter, so it is not shown.
[[noreturn]] void failUnknown(const Node& value, const std::string& hint) {
  static const Json kNothing;
  Node(value.document(), kNothing, value.path()).fail("is not known" + hint);
}

template <class Take>
void readMembers(const Node& object, const Take& take) {
  for (const auto& item : object.json().items()) {
    const Node value(object.document(), item.value(), joinedPath(object.path(), item.key()));
    const Field* const field = findField(value.path());
    if (item.key().find('.') != std::string::npos || (!field && namesUnder(value.path()).empty())) {
      if (value.path() == "projection.fov")
        value.fail(
            "does not say which angle: fovY is from bottom to top (OpenGL, Direct3D, Unity, three.js), fovX from left "
            "to right (Unreal)");
      failUnknown(value, suggestField(value.path(), item.key(), namesUnder(object.path())));
    }
    if (item.value().is_null()) continue;
    if (field)
      take(*field, readValue(value, *field));
    else if (item.value().is_object())
      readMembers(value, take);
    else
      value.fail("expected an object");
  }
}

/// How messages about two fields call one: the option that set it, or its name.
std::string_view spelled(const Document& document, const Field& field) {
  const auto label = document.labels.find(field.path);
  if (label == document.labels.end()) return shortName(field);
  const std::string_view text = label->second;
  return text.substr(text.starts_with(document.name + ": ") ? document.name.size() + 2 : 0);
}

}  // namespace

const FieldValue* FieldValues::value(FieldId id) const {
  const auto found = std::lower_bound(values_.begin(), values_.end(), &*id,
                                      [](const auto& row, const Field* field) { return row.first < field; });
  return found != values_.end() && found->first == &*id ? &found->second : nullptr;
}

Node FieldValues::nodeAt(std::string_view path) const {
  const Json* at = valueAt(*document_.root, path);
  while (!at) {
    const std::size_t dot = path.rfind('.');
    path = path.substr(0, dot == std::string_view::npos ? 0 : dot);
    at = valueAt(*document_.root, path);
  }
  return {document_, *at, std::string(path)};
}

void FieldValues::failMissing(FieldId id) const {
  const Node object = node(id);
  const bool isOfPicture = id->path == "viewport.width" || id->path == "viewport.height";
  object.fail("needs " + std::string(id->path.substr(object.path().empty() ? 0 : object.path().size() + 1)) +
              (isOfPicture ? "; --viewport WIDTHxHEIGHT gives it" : ""));
}

FieldValues readValues(const Document& document, std::string_view under) {
  FieldValues values(document);
  auto& rows = values.values_;
  const Json* const object = valueAt(*document.root, under);
  if (object)
    readMembers(Node(values.document_, *object, std::string(under)),
                [&](const Field& field, FieldValue value) { rows.emplace_back(&field, std::move(value)); });
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (!under.empty()) return values;
  if (valueAt(*document.root, "projection")) {
    if (!values.has("projection.type"))
      values.failAt("projection", "needs a type: " + alternatives(wordsOf<kTypeNames>()));
    const std::string_view type = *values.find<std::string_view>("projection.type");
    for (const auto& [field, value] : rows)
      if (field->types != 0 && (field->types & valueOf(kTypeNames, type)) == 0)
        values.failAt(field->path, "is not a field of the type " + std::string(type));
  }
  for (const auto& second : rows)
    for (const auto& first : rows) {
      if (&first == &second) break;
      if (contradict(*first.first, *second.first))
        values.failAt("", contradictionMessage(spelled(document, *first.first), spelled(document, *second.first),
                                               first.first->group));
    }
  return values;
}

FieldValue readValue(const Node& value, const Field& field) {
  switch (field.kind) {
    case Kind::text:
      return value.text();
    case Kind::word:
      return readWord(value, field);
    case Kind::flag:
      return value.flag();
    case Kind::number:
      return value.number();
    case Kind::positive:
      return readAbove0(value);
    case Kind::far:
      return readFar(value);
    case Kind::zero:
      if (value.number() != 0) value.fail("must be 0: skewed pixels are not supported");
      return 0.0;
    case Kind::ratio:
      return readRatio(value);
    case Kind::angle:
      return readFieldOfView(value);
    case Kind::pitch:
      return readAngle(value, -180, 180, "from -180 to 180 degrees");
    case Kind::turn:
      return readAngle(value);
    case Kind::pair:
    case Kind::range:
    case Kind::size:
      return readPair(value, field.kind);
    case Kind::direction: {
      const std::vector<double> v = readDirection(value, 3);
      return Vec3{v[0], v[1], v[2]};
    }
    case Kind::place:
      return readPosition(value);
    case Kind::quaternion:
      requireAxes(value);
      return readQuaternion(value);
    case Kind::euler:
      return readEuler(value);
    case Kind::rigid:
      return readRigid(value);
    case Kind::matrix:
      return readMatrix(value);
    case Kind::lens:
      break;
  }
  return readLensNumbers(value);
}

RigidTransform readRigid(const Node& value) {
  if (isChain(value.json())) {
    Rigid product;
    for (std::size_t i = 0; i < value.size(); ++i) product = product * rigidOf(readRigid(value[i]));
    return {matrixOf(product), detail::rounded(product.origin)};
  }
  if (!value.json().is_object()) {
    // Numbers without rows may run by rows or by columns.
    if (!value.json().is_array() || value.size() == 0 || !value.json()[0].is_array())
      value.fail("expected 4 rows of 4 numbers, as in [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]");
    const Mat4 matrix = value.mat4();
    requireAffine(matrix, value);
    return {matrix, {matrix[0][3], matrix[1][3], matrix[2][3]}};
  }
  allowMembers(value, wordsIn(rowOf(Kind::rigid).members));
  const auto rotation = value.find("rotation"), vector = value.find("rotationVector"), euler = value.find("euler");
  const int turns = int(rotation.has_value()) + int(vector.has_value()) + int(euler.has_value());
  if (turns > 1) value.fail("rotation, rotationVector and euler are the same thing; keep one");
  if (turns == 0) value.fail("needs rotation, rotationVector or euler");
  const Vec3 translation = value.require("translation").vec3();
  if (vector) {
    constexpr double kLargest = 1e6;  // a larger angle is not known to its last digits
    const Vec3 v = vector->vec3();
    if (!(detail::hypotenuse(v.x, v.y, v.z) <= kLargest))
      vector->fail("its length is the angle in radians, at most 1e6");
    return {RotationVector{v}, translation};
  }
  Mat4 matrix;
  if (euler) {
    matrix = rotationOf(*euler);
  } else {
    if (rotation->holdsNumbers(4)) return {readQuaternion(*rotation), translation};
    const bool isFlat = rotation->json().is_array() && rotation->size() == 9;
    if (isFlat || !rotation->holdsNumbers(9))
      rotation->fail(std::string("expected [x, y, z, w] or 3 rows of 3 numbers") +
                     (isFlat ? "; 9 in one list may go by rows, or by columns as RealSense's do" : ""));
    const std::vector<double> r = rotation->numbers(9);
    for (std::size_t i = 0; i < 3; ++i) matrix[i] = {r[3 * i], r[3 * i + 1], r[3 * i + 2], 0};
  }
  for (std::size_t i = 0; i < 3; ++i) matrix[i][3] = translation[i];
  matrix[3] = {0, 0, 0, 1};
  return {matrix, translation};
}

Angle readAngle(const Node& value, double least, double most, const char* range) {
  const auto angle = parseAngle(value.json());
  if (!angle) value.fail("expected a number of degrees, \"60deg\" or \"1.0472rad\"");
  const double degrees = degreesOf(*angle);
  if (!(degrees >= least && degrees <= most) || !std::isfinite(degrees))
    value.fail(std::string("expected an angle ") + range);
  return *angle;
}

Position readPosition(const Node& value) {
  if (value.holdsNumbers(3)) return {value.vec3(), std::nullopt};
  if (!value.json().is_object() || value.json().contains("x")) value.fail("expected x, y, z, or lat, lon, height");
  allowMembers(value, wordsIn(rowOf(Kind::place).members));
  const Angle lat = readAngle(value.require("lat"), -90, 90, "from -90 to 90 degrees");
  const Angle lon = readAngle(value.require("lon"), -360, 360, "from -360 to 360 degrees");
  const auto altitude = value.find("altitude");
  if (altitude && value.find("height"))
    altitude->fail("is the height above sea level; keep one of height and altitude");
  if (altitude && !hasGeoid()) altitude->fail(kNeedsGeoid);
  Geodetic place{degreesOf(lat), degreesOf(lon), (altitude ? *altitude : value.require("height")).number()};
  if (altitude) place.height += seaLevelAt(place.lat, place.lon);
  const Vec3 point = geodeticToEcef(place);
  return {point, place, placeError(point), lat.isRadians || lon.isRadians};
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
  const std::string_view last = path.substr(path.rfind('.') + 1);
  for (const Field& field : kFields) {
    const auto hints = wordsIn(field.hints);
    if (last == field.path.substr(field.path.rfind('.') + 1) ||
        std::find(hints.begin(), hints.end(), path) != hints.end())
      return "; did you mean '" + std::string(field.path) + "'?";
  }
  for (const auto& [type, bit] : kTypeNames)
    if (path == type)
      for (const Field& field : kFields)
        if (field.types == bit)
          return "; it is a type of projection: --set projection.type=" + std::string(type) + " --set " +
                 std::string(field.path) + "=…";
  return suggestion(name, names, "help camera");
}

double degreesOf(Angle angle) {
  constexpr detail::DoubleDouble kDegreesOfRadian{57.29577951308232, -1.9878495670576283e-15};
  return angle.isRadians ? (detail::DoubleDouble(angle.value) * kDegreesOfRadian).hi : angle.value;
}

}  // namespace viewproj::cmd
