#include "camera/patch.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/read_pose.hpp"
#include "camera/read_projection.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"
#include "text/xml_text.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kType = "projection.type";

Json numberOrText(std::string_view text) {
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
  for (const std::string_view part : split(text, ",")) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || object.contains(part.substr(0, equals))) return text;
    object[std::string(part.substr(0, equals))] = numberOrText(part.substr(equals + 1));
  }
  return object;
}

/// "YXZ:a,b,c".
Json eulerOf(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return text;
  Json turns = Json::array();
  for (const std::string_view part : split(std::string_view(text).substr(colon + 1), ","))
    turns.push_back(numberOrText(part));
  return {{"order", text.substr(0, colon)}, {"degrees", turns}};
}

}  // namespace

std::optional<Json> poseOfOrigin(const Json& origin) {
  // Several, or a turn by another name, are none.
  const Json none = Json::object();
  if (origin.is_array()) return std::nullopt;
  for (const auto& [name, value] : (origin.is_object() ? origin : none).items())
    if (name.starts_with('@') && name != "@xyz" && name != "@rpy") return std::nullopt;
  Json place = Json::array(), turns = Json::array();
  for (const auto& [name, list] : {std::pair("@xyz", &place), {"@rpy", &turns}}) {
    const bool isStated = origin.is_object() && origin.contains(name) && origin[name].is_string();
    const std::string text = isStated ? origin[name].get<std::string>() : "0 0 0";
    for (const std::string_view word : wordsIn(text)) {
      const auto number = parseNumber(word);
      if (!number) return std::nullopt;
      list->push_back(list == &turns ? Json(formatNumber(*number) + "rad") : Json(*number));
    }
    if (list->size() != 3) return std::nullopt;
  }
  return Json{{"translation", place}, {"euler", {{"order", "rpy"}, {"degrees", turns}}}};
}

std::optional<Json> writtenPose(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  if (text.starts_with("<origin")) {
    Json root;
    const bool isXml = !parseXml(text, kDeepestJson, root) && root.is_object() && root.contains("origin");
    const auto pose = isXml ? poseOfOrigin(root["origin"]) : std::nullopt;
    if (!pose)
      throw UsageError(visible(text) + ": expected three numbers, as in <origin xyz=\"1 2 3\" rpy=\"0 0 1.57\"/>");
    return pose;
  }
  const bool isRobots = text.starts_with("p[");
  if (!isRobots && !isGodotPose(text)) return std::nullopt;
  std::string list(text.substr(text.find_first_of("[(") + 1));
  std::erase_if(list, [](char c) { return c == ' ' || c == ']' || c == ')'; });
  const auto n = parseNumberList(list);
  if (!n || n->size() != (isRobots ? 6 : 12))
    throw UsageError(visible(text) + ": expected " + (isRobots ? "6 numbers" : "12 numbers"));
  const auto part = [&](std::size_t i) { return Json{(*n)[i], (*n)[i + 1], (*n)[i + 2]}; };
  if (isRobots) return Json{{"translation", part(0)}, {"rotationVector", part(3)}};
  return Json{{"rotation", {part(0), part(3), part(6)}}, {"translation", part(9)}};
}

std::optional<Json> poseOfText(const std::string& text) {
  if (auto pose = writtenPose(text)) return pose;
  const std::size_t blank = text.find(' ');
  const auto place = parseNumberList(text.substr(0, blank));
  if (place && place->size() == 3 && blank == std::string::npos)
    return Json{{"translation", *place}, {"rotation", {0, 0, 0, 1}}};
  if (!place || place->size() < 2 || blank == std::string::npos) return std::nullopt;
  const std::string turn = text.substr(blank + 1), order = turn.substr(0, turn.find(':'));
  Json pose{{"translation", *place}};
  const auto numbers = [&] { return listOrObject(turn.substr(order.size() + 1)); };
  if (order == "quaternion" || order == "quat")
    pose["rotation"] = numbers();
  else if (order == "vector" || order == "rvec")
    pose["rotationVector"] = numbers();
  else if (place->size() == 3 && order.size() < turn.size() && rowNamed(kEulerOrders, order))
    pose["euler"] = eulerOf(turn);
  else
    throw UsageError(text +
                     ": expected a place and its turn, as '1,2,3 rpy:0,0,90' (or unity, unreal, opk, or axes as "
                     "YXZ), '1,2,3 quat:0,0,0,1' or '1,2,3 rvec:0,0,1.57'");
  return pose;
}

namespace {

Json shortForm(Kind kind, const std::string& text) {
  if (rowOf(kind).isList) return listOrObject(text);
  if (kind == Kind::euler) return eulerOf(text);
  if (kind == Kind::rigid) return poseOfText(text).value_or(text);
  return kind == Kind::text ? Json(text) : numberOrText(text);
}

std::uint8_t typeNamed(const Json* type) {
  if (type && type->is_string())
    for (const auto& [name, bit] : kTypeNames)
      if (*type == name) return bit;
  return 0;
}

/// Whether two paths are equal, or one leads to the other.
bool overlap(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  return b.starts_with(a) && (a.size() == b.size() || b[a.size()] == '.');
}

/// The field that a path is of, or leads into. Null for the path of an object of fields, and for any other.
const Field* fieldOf(std::string_view path) {
  for (const Field& field : kFields)
    if (path.size() >= field.path.size() && overlap(field.path, path)) return &field;
  return nullptr;
}

/// The types that a patch of the projection fits; all for any other.
std::uint8_t typesOf(const Patch& patch) {
  const Field* const field = fieldOf(patch.path);
  if (!field || field->types == 0 || patch.value->is_null()) return kAllTypes;
  return patch.path == kType ? typeNamed(patch.value.get()) : field->types;
}

/// Of a field of a pose or a projection.
void removeField(Json& root, const Field& field) {
  Json& object = field.types != 0 ? root["projection"] : root;
  if (object.is_object()) object.erase(std::string(shortName(field)));
}

/// Keeps near and far of a projection matrix that another kind of projection replaces.
void keepRange(const Document& document) {
  const FieldValues values = readValues(document, "projection");
  const Projection matrix = readProjectionMatrix(values, readConvention(document));
  Json& projection = (*document.root)["projection"];
  if (matrix.zNear() > 0) projection["near"] = matrix.zNear();
  if (std::isfinite(matrix.zFar())) projection["far"] = matrix.zFar();
}

/// A field of view, laid over a K, takes its cx and cy away.
void noteLostAxis(Document& document, std::span<const Patch> patches) {
  std::string lost;
  for (const std::string_view axis : {"cx", "cy"})
    if (const Json* const value = valueAt(*document.root, "projection." + std::string(axis));
        value && value->is_number())
      lost += (lost.empty() ? "" : ", ") + std::string(axis) + " " + formatNumber(value->get<double>());
  const auto angle = std::find_if(patches.begin(), patches.end(), [](const Patch& patch) {
    return !patch.label.empty() && isAmong(patch.path, "projection.fovX projection.fovY");
  });
  if (!lost.empty() && angle != patches.end())
    document.notes.push_back(document.name + ": " + angle->label + " replaces " + lost +
                             " too: the axis is in the picture's middle; --fx and --fy keep them");
}

/// Sets the projection's type to one that all patches fit: the present type, if possible. Removes the fields that other
/// types have.
void applyType(Document& document, std::span<const Patch> patches) {
  Json& root = *document.root;
  std::uint8_t possible = kAllTypes;
  bool isNamed = false, decides = false;  // near, far and shift do not decide: they fit the present type
  for (const Patch& patch : patches) {
    const std::uint8_t types = typesOf(patch);
    possible &= types;
    isNamed = isNamed || (patch.path.starts_with("projection.") && !patch.value->is_null());
    decides = decides || types != kAllTypes;
  }
  const Json *const current = valueAt(root, kType), *const projection = valueAt(root, "projection");
  if (projection && !projection->is_object()) return;  // readValues() reports this
  if (!isNamed || (current && (!decides || typeNamed(current) == 0 || (typeNamed(current) & possible) != 0))) return;
  if (!current && projection && !document.isTyped && !decides) return;  // and this
  const auto next = std::find_if(std::begin(kTypeNames), std::end(kTypeNames),
                                 [&](const auto& row) { return (row.second & possible) != 0; });
  if (next == std::end(kTypeNames)) return;
  if (current && typeNamed(current) == kMatrix && valueAt(root, "projection.matrix")) keepRange(document);
  noteLostAxis(document, patches);
  for (const Field& field : kFields)
    if (field.types != 0 && (field.types & next->second) == 0) removeField(root, field);
  root["projection"]["type"] = next->first;
}

/// Removes the fields that contradict this one. The eye of a pose that goes becomes the position.
void displace(const Document& document, const Field& field) {
  Json& root = *document.root;
  for (const Field& other : kFields) {
    const Json* const value = contradict(other, field) ? valueAt(root, other.path) : nullptr;
    if (!value) continue;
    if (other.kind == Kind::rigid && !valueAt(root, "position")) {
      const Node node(document, *value, std::string(other.path));
      try {
        const Vec3 eye = eyeOf(std::get<RigidTransform>(readValue(node, other)), other.path == "cameraFromWorld");
        root["position"] = {eye.x, eye.y, eye.z};
      } catch (const CameraError& e) {
        node.fail(e.message());
      }
    }
    removeField(root, other);
  }
  // A matrix states a place. A position of the command line is meant to replace it.
  if (field.kind == Kind::rigid && !document.labels.contains("position") && root.is_object()) root.erase("position");
}

/// Throws if the patch is not of a field, a part of one, or an object of fields.
void requireField(const Patch& patch) {
  std::vector<std::string_view> paths;
  for (const Field& field : kFields) {
    if (overlap(field.path, patch.path)) return;
    paths.push_back(field.path);
  }
  throw UsageError(patch.label + ": is not known" + suggestField(patch.path, patch.path, paths));
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
      if (step == "height") at->erase("altitude");  // the same number above another surface
      if (step == "altitude") at->erase("height");
      at = &(*at)[step];
    }
  }
  *at = *patch.value;
}

/// Applies patches that do not contradict each other: what they contradict in the document goes first.
void applyTogether(Document& document, std::span<const Patch> patches) {
  applyType(document, patches);
  for (const Patch& patch : patches)
    if (const Field* const field = fieldOf(patch.path); field && !patch.value->is_null()) displace(document, *field);
  for (const Patch& patch : patches) {
    put(*document.root, patch);
    if (!patch.label.empty()) document.labels[patch.path] = patch.label;
  }
}

void addPatches(const Json& object, const std::string& path, std::vector<Patch>& patches) {
  for (const auto& [name, value] : object.items()) {
    const std::string member = joinedPath(path, name);
    if (value.is_object() && !findField(member) && !namesUnder(member).empty())
      addPatches(value, member, patches);
    else
      patches.push_back({member, std::make_shared<const Json>(value), "", false});
  }
}

/// {"k1": a, "k2": b} as {"k": [a, b]}, where they count from 1 without a gap.
void gather(Json& lens, const std::string& name) {
  Json numbers = Json::array();
  const auto next = [&] { return name + std::to_string(numbers.size() + 1); };
  while (lens.contains(next())) numbers.push_back(lens[next()]);
  if (numbers.empty() || lens.contains(name)) return;
  for (std::size_t i = 1; i <= numbers.size(); ++i) lens.erase(name + std::to_string(i));
  lens[name] = std::move(numbers);
}

/// What looks like JSON and is none is told as that.
void requireJson(const std::string& label, const std::string& text) {
  if (!text.starts_with('{') && !text.starts_with('[')) return;
  if (const auto fault = jsonFault(text)) throw UsageError(label + " " + text + ": " + fault->message);
}

}  // namespace

Patch optionPatch(const Field& field, const std::string& text) {
  if (field.kind == Kind::lens) requireJson(std::string(field.option), text);
  Json value = shortForm(field.kind, text);
  if (Json parsed; field.kind == Kind::lens && !parseJson(text, parsed)) value = std::move(parsed);
  if (field.kind == Kind::lens && value.is_object())
    for (const char* name : {"k", "p"}) gather(value, name);
  Patch patch{std::string(field.path), std::make_shared<const Json>(std::move(value)), std::string(field.option)};
  const Document alone{"", std::make_shared<Json>(*patch.value), true, {{patch.path, patch.label}}};
  (void)readValue(Node(alone, *alone.root, patch.path), field);
  return patch;
}

Patch orthographicPatch() {
  return {std::string(kType), std::make_shared<const Json>("orthographic"), "--orthographic"};
}

Patch setPatch(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--set " + text + ": expected FIELD=VALUE, as in projection.fovY=75");
  std::string path = text.substr(0, equals);
  const std::string written = text.substr(equals + 1);
  const std::string label = "--set " + path;
  if (!isUtf8(text)) throw UsageError(label + ": the value is not UTF-8");
  const std::string first = path.substr(0, path.find('.'));
  for (const Field& field : kFields)
    if (!field.alias.empty() && field.alias == first) path = std::string(field.path) + path.substr(first.size());
  const Field* const field = findField(path);
  const bool isText = field && field->kind == Kind::text && written != "null" && !written.starts_with('"');
  if (!isText) requireJson(label, written);
  Json value;
  if (isText || jsonFault(written))
    value = field                                    ? shortForm(field->kind, written)
            : written.find(',') == std::string::npos ? numberOrText(written)
                                                     : listOrObject(written);
  else if (const auto fault = parseJson(written, value))
    throw UsageError(label + ": " + fault->message);
  if (path == "convention" && value.is_string()) value = {{"preset", value}};
  return {path, std::make_shared<const Json>(std::move(value)), label, false};
}

std::vector<Patch> viewportPatches(double width, double height) {
  return {{"viewport.width", std::make_shared<const Json>(width), "--viewport"},
          {"viewport.height", std::make_shared<const Json>(height), "--viewport"}};
}

// cppcheck-suppress constParameter  // what it points to changes
void resizePicture(Document& document, double factor) {
  const FieldValues values = readValues(document);
  const auto picture = readPicture(values, readConvention(values));
  const std::string percent = "--viewport " + formatNumber(100 * factor) + "%";
  const std::string advice = "; --viewport WIDTHxHEIGHT gives one";
  if (!picture) throw InputError(document.name + ": has no viewport, of which " + percent + " is a part" + advice);
  const std::uint8_t type = typeOf(values);
  if (type == kPs2) values.failAt("projection", "has pixels of its own, which " + percent + " does not change");
  const Viewport& frame = picture->frame;
  const auto resized = [&](double number) {
    const double exact = number * factor, whole = std::round(exact);
    return std::fabs(exact - whole) < 1e-9 * exact ? whole : exact;
  };
  const double width = resized(frame.width), height = resized(frame.height);
  if (width != std::floor(width) || height != std::floor(height))
    values.failAt("viewport", "a picture of " + formatDigits(width, 6) + "x" + formatDigits(height, 6) +
                                  " has a part of a pixel, with " + percent + advice);
  Json& root = *document.root;
  if (type == kIntrinsics && !values.has("projection.pixels"))
    root["projection"]["pixels"] = {frame.width, frame.height};
  Json& viewport = root["viewport"];
  viewport["width"] = width;
  viewport["height"] = height;
  for (const char* place : {"x", "y", "crop.x", "crop.y", "crop.width", "crop.height"})
    if (const Json* const number = valueAt(root, "viewport." + std::string(place)))
      put(root, {"viewport." + std::string(place), std::make_shared<const Json>(number->get<double>() * factor), ""});
}

void requireConsistent(const std::vector<Patch>& patches) {
  for (const Patch& second : patches)
    for (const Patch& first : patches) {
      if (&first == &second) break;
      const Field *const a = findField(first.path), *const b = findField(second.path);
      if (!first.isOption || !second.isOption || !a || !b) continue;
      if (contradict(*a, *b) || (typesOf(first) & typesOf(second)) == 0)
        throw UsageError(contradictionMessage(first.label, second.label, a->group));
    }
}

void applyPatches(Document& document, const std::vector<Patch>& patches) {
  for (const Patch& patch : patches) requireField(patch);
  std::vector<Patch> options;
  std::copy_if(patches.begin(), patches.end(), std::back_inserter(options),
               [](const Patch& patch) { return patch.isOption; });
  for (const Patch& set : patches)
    for (const Patch& option : options)
      if (!set.isOption && option.path.starts_with(set.path + ".") &&
          !valueAt(*set.value, option.path.substr(set.path.size() + 1)))
        throw UsageError(option.label + ": is lost, since " + set.label + " replaces all of " + set.path +
                         "; give --set " + option.path + "=VALUE behind it");
  applyTogether(document, options);
  for (const Patch& patch : patches)
    if (!patch.isOption) applyTogether(document, std::span(&patch, 1));
}

void layOver(Document& document, const Json& fields) {
  std::vector<Patch> patches;
  addPatches(fields, "", patches);
  for (const Patch& patch : patches) {
    std::erase_if(document.labels, [&](const auto& label) { return overlap(label.first, patch.path); });
    if (const Field* const field = findField(patch.path); field && field->kind == Kind::rigid)
      document.labels.erase("position");  // it states the place
  }
  applyTogether(document, patches);
}

}  // namespace viewproj::cmd
