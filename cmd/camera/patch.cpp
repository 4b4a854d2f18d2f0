#include "camera/patch.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/check.hpp"
#include "camera/read_camera.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kType = "projection.type";

Json numberOrText(const std::string& text) {
  const auto number = parseNumber(text);
  return number ? Json(*number) : Json(text);
}

/// Text such as 1,2,3 as an array, or lat=1,lon=2,height=3 as an object.
Json listOrObject(const std::string& text) {
  if (text.find('=') == std::string::npos) {
    const auto numbers = parseNumberList(text);
    return numbers ? Json(*numbers) : Json(text);
  }
  Json object = Json::object();
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size()), equals = text.find('=', at);
    if (equals >= comma || object.contains(text.substr(at, equals - at))) return text;
    object[text.substr(at, equals - at)] = numberOrText(text.substr(equals + 1, comma - equals - 1));
    at = comma + 1;
  }
  return object;
}

Json parsedValue(Kind kind, const std::string& text) {
  switch (kind) {
    case Kind::pair:
    case Kind::direction:
    case Kind::place:
    case Kind::quaternion:
      return listOrObject(text);
    case Kind::euler: {
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos) return text;
      Json turns = Json::array();
      for (std::size_t at = colon + 1; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        turns.push_back(numberOrText(text.substr(at, comma - at)));
        at = comma + 1;
      }
      return {{"order", text.substr(0, colon)}, {"degrees", turns}};
    }
    case Kind::lens: {
      Json value;
      return parseJson(text, value) ? Json(text) : value;
    }
    default:
      return numberOrText(text);
  }
}

std::uint8_t typeNamed(const Json* type) {
  if (type && type->is_string())
    for (const auto& [name, bit] : kTypeNames)
      if (*type == name) return bit;
  return 0;
}

/// Keeps near and far of a projection matrix that another kind of projection replaces.
void keepRange(const Document& document, Json& projection) {
  const Document matrix{document.name, std::make_shared<Json>(*document.root), document.isTyped, document.labels};
  matrix.root->erase("viewport");
  const Projection lens = *readCamera(matrix, {.allowStretch = true}).projection;
  projection["near"] = lens.zNear();
  if (std::isfinite(lens.zFar())) projection["far"] = lens.zFar();
}

/// Sets the projection's type to one that all given fields belong to: the present type, if possible.
void layType(const Document& document, const std::vector<Patch>& patches) {
  Json& root = *document.root;
  std::uint8_t possible = kAllTypes;
  bool isNamed = false, decides = false;  // near, far and shift do not decide: they fit the present type
  for (const Patch& patch : patches) {
    const Field* const field = findField(patch.path);
    if (patch.path == kType && !patch.isOption) return;  // check() compares this one with the other fields
    if (!field || field->types == 0 || patch.value->is_null()) continue;
    isNamed = true;
    decides = decides || patch.path == kType || (field->types != kWithNear && field->types != kAllTypes);
    possible &= patch.path == kType ? typeNamed(patch.value.get()) : field->types;
  }
  const Json* const currentType = valueAt(root, kType);
  if (!isNamed ||
      (currentType && (!decides || typeNamed(currentType) == 0 || (typeNamed(currentType) & possible) != 0)))
    return;
  if (!currentType && !document.isTyped && valueAt(root, "projection")) return;  // check() reports this
  const auto next = std::find_if(std::begin(kTypeNames), std::end(kTypeNames),
                                 [&](const auto& row) { return (row.second & possible) != 0; });
  if (next == std::end(kTypeNames)) return;
  Json& projection = root["projection"];
  if (typeNamed(currentType) == kMatrix) keepRange(document, projection);
  for (const Field& field : kFields)
    if (field.types != 0 && (field.types & next->second) == 0 && projection.is_object())
      projection.erase(std::string(shortName(field)));
  projection["type"] = next->first;
}

void removeField(Json& root, const Field& field) {
  const std::size_t dot = field.path.find('.');
  if (dot == std::string_view::npos)
    root.erase(std::string(field.path));
  else
    root[std::string(field.path.substr(0, dot))].erase(std::string(field.path.substr(dot + 1)));
}

/// The eye of a matrix pose, even if other parts of the document are wrong.
Vec3 eyeOf(const Document& document, std::string_view pose) {
  Document alone = document;
  alone.root = std::make_shared<Json>(Json::object());
  for (const std::string_view name : {std::string_view("convention"), std::string_view("cameraAxes"), pose})
    if (document.root->contains(name)) (*alone.root)[name] = (*document.root)[name];
  return readCamera(alone, {}).pose->eye();
}

/// Removes fields that contradict this one. The position of a matrix pose is kept.
void displace(const Document& document, const Field& field) {
  Json& root = *document.root;
  for (const Field* other : presentFields(document)) {
    if (!contradiction({other, &field}).first) continue;
    if (other->kind == Kind::rigid && !valueAt(root, "position")) {
      const Vec3 eye = eyeOf(document, other->path);
      root["position"] = {eye.x, eye.y, eye.z};
    }
    removeField(root, *other);
  }
}

/// Whether two paths are equal, or one leads to the other.
bool overlap(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  return b.starts_with(a) && (a.size() == b.size() || b[a.size()] == '.');
}

/// Throws if the patch is not for a field or a part of one.
void requireField(const Patch& patch) {
  std::vector<std::string_view> paths;
  for (const Field& field : kFields) {
    if (overlap(field.path, patch.path)) return;
    paths.push_back(field.path);
  }
  throw InputError(patch.label + ": is not known" + suggestField(patch.path, patch.path, paths));
}

/// The element of an array at a step of a path. Throws if it does not exist.
Json& elementAt(Json& array, const std::string& step, const Patch& patch) {
  for (std::size_t i = 0; i < array.size(); ++i)
    if (std::to_string(i) == step) return array[i];
  throw UsageError(patch.label + ": there is no element " + step + " of " + std::to_string(array.size()));
}

/// Sets the value at a path of names and indices, and creates missing objects. A null value removes the member.
void put(Json& root, const Patch& patch) {
  Json* at = &root;
  for (std::size_t begin = 0; begin <= patch.path.size();) {
    const std::size_t end = std::min(patch.path.find('.', begin), patch.path.size());
    const std::string step = patch.path.substr(begin, end - begin);
    begin = end + 1;
    if (at->is_null()) *at = Json::object();
    if (at->is_array()) {
      at = &elementAt(*at, step, patch);
    } else if (!at->is_object()) {
      throw UsageError(patch.label + ": " + patch.path.substr(0, end - step.size() - 1) + " is not an object");
    } else {
      if (patch.value->is_null() && end == patch.path.size()) return (void)at->erase(step);
      if (patch.value->is_null() && !at->contains(step)) return;
      at = &(*at)[step];
    }
  }
  *at = *patch.value;
}

}  // namespace

Patch optionPatch(const Field& field, const std::string& text) {
  Patch patch{std::string(field.path), std::make_shared<const Json>(parsedValue(field.kind, text)),
              std::string(field.option)};
  Document alone{"", std::make_shared<Json>(*patch.value), true, {{patch.path, patch.label}}};
  checkValue(Node(alone, *alone.root, patch.path), field);
  return patch;
}

Patch orthographicPatch() { return {kType, std::make_shared<const Json>("orthographic"), "--orthographic"}; }

Patch setPatch(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--set " + text + ": expected FIELD=VALUE, as in projection.fovY=75");
  std::string path = text.substr(0, equals);
  const std::string written = text.substr(equals + 1);
  const std::string label = "--set " + path;
  if (!isUtf8(text)) throw UsageError(label + ": the value is not UTF-8");
  Json value;
  if (jsonFault(written))
    value = written;
  else if (const auto fault = parseJson(written, value))
    throw UsageError(label + ": " + fault->message);
  const std::string first = path.substr(0, path.find('.'));
  for (const Field& field : kFields)
    if (const auto names = namesOf(field); std::find(names.begin() + 1, names.end(), first) != names.end())
      path = std::string(field.path) + path.substr(first.size());
  if (path == "convention" && value.is_string()) value = {{"preset", value}};
  return {path, std::make_shared<const Json>(std::move(value)), label, false};
}

std::vector<Patch> viewportPatches(double width, double height) {
  return {{"viewport.width", std::make_shared<const Json>(width), "--viewport"},
          {"viewport.height", std::make_shared<const Json>(height), "--viewport"}};
}

void requireConsistent(const std::vector<Patch>& patches) {
  const auto typesOf = [](const Field& field) {
    return field.path == kType ? std::uint8_t{kOrthographic} : field.types;
  };
  for (const Patch& second : patches)
    for (const Patch& first : patches) {
      if (&first == &second) break;
      if (!first.isOption && !second.isOption) continue;
      if (overlap(first.path, second.path))
        throw UsageError(first.label + " and " + second.label + " give the same field; keep one");
      const Field *const a = findField(first.path), *const b = findField(second.path);
      if (!a || !b || first.value->is_null() || second.value->is_null()) continue;
      const bool differ = a->types != 0 && b->types != 0 && (typesOf(*a) & typesOf(*b)) == 0;
      if (differ || contradiction({a, b}).first)
        throw UsageError(contradictionMessage(first.label, second.label, a->group));
    }
}

void lay(Document& document, const std::vector<Patch>& patches) {
  for (const Patch& patch : patches) requireField(patch);
  layType(document, patches);
  for (const Patch& patch : patches) {
    const Field* const field = findField(patch.path);
    if (patch.path == kType && patch.isOption) continue;
    if (field && !patch.value->is_null()) displace(document, *field);
    put(*document.root, patch);
    document.labels[patch.path] = patch.label;
  }
}

}  // namespace viewproj::cmd
