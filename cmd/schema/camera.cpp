#include "schema/camera.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "input/camera_fields.hpp"
#include "input/projection_types.hpp"

namespace viewproj::cmd {
namespace {

using Json = nlohmann::ordered_json;

Json objectOf(const ObjectForm& form, bool orNull, const Json& own = Json::object());

Json ofType(const char* type) { return {{"type", type}}; }
Json notNull() { return {{"not", ofType("null")}}; }
Json anyOf(const Json& one, const Json& other) { return {{"anyOf", {one, other}}}; }

/// One of the words, or null.
Json wordOf(const std::vector<std::string_view>& words, bool orNull = true) {
  Json known = Json::array();
  for (const std::string_view word : words) known.push_back(word);
  if (orNull) known.push_back(nullptr);
  return {{"enum", known}};
}

Json numbers(int count) {
  return {{"type", {"array", "null"}}, {"items", ofType("number")}, {"minItems", count}, {"maxItems", count}};
}

Json notAllZero(int count) {
  Json schema = numbers(count);
  schema["contains"] = {{"not", {{"const", 0}}}};
  return schema;
}

Json number(std::initializer_list<std::pair<std::string, int>> limits) {
  Json schema = {{"type", {"number", "null"}}};
  for (const auto& [keyword, limit] : limits) schema[keyword] = limit;
  return schema;
}

Json withoutNull(Json schema) {
  if (!schema.contains("type") || !schema["type"].is_array()) {
    schema["not"] = ofType("null");
    return schema;
  }
  schema["type"] = schema["type"][0];
  return schema;
}

/// As parseNumber takes it.
const std::string kNumber = "[ \\t]*[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?[ \\t]*";

/// The same for numbers, and for texts that match.
Json orText(const Json& number, const std::string& pattern) {
  return anyOf(number, {{"type", "string"}, {"pattern", pattern}});
}

Json angle(std::initializer_list<std::pair<std::string, int>> limits) {
  return orText(number(limits), "^" + kNumber + "(deg|rad|\xC2\xB0)$");
}

/// An object of so many coordinates, or else what an array is to be.
Json orCoordinates(Json array, std::size_t count, bool notZero) {
  Json object = {{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
  Json zero = Json::object();
  for (const char* name : {"x", "y", "z", "w"}) {
    if (object["required"].size() == count) break;
    object["properties"][name] = ofType("number");
    object["required"].push_back(name);
    zero[name] = {{"const", 0}};
  }
  object["additionalProperties"] = false;
  if (notZero) object["not"] = {{"type", "object"}, {"properties", zero}};
  return {{"if", ofType("object")}, {"then", object}, {"else", std::move(array)}};
}

/// Of an object that is a place, not x, y, z.
Json place() {
  const Json hasX = {{"type", "object"}, {"required", {"x"}}, {"properties", {{"x", Json::object()}}}};
  return {{"type", "object"}, {"not", hasX}};
}

Json matrix() {
  const Json row = withoutNull(numbers(4));
  return {{"type", {"array", "null"}},
          {"prefixItems", {row, row, row, {{"const", {0, 0, 0, 1}}}}},
          {"minItems", 4},
          {"maxItems", 4}};
}

Json formOf(const Field& field) {
  switch (field.form) {
    case ValueForm::text:
      return {{"type", {"string", "null"}}};
    case ValueForm::flag:
      return {{"type", {"boolean", "null"}}};
    case ValueForm::number:
      return number({});
    case ValueForm::positive:
      return number({{"exclusiveMinimum", 0}});
    case ValueForm::zero:
      return {{"enum", {0, nullptr}}};
    case ValueForm::ratio:
      return orText(number({{"exclusiveMinimum", 0}}), "^" + kNumber + "/" + kNumber + "$");
    case ValueForm::angle:
      return angle({{"exclusiveMinimum", 0}, {"exclusiveMaximum", 180}});
    case ValueForm::elevation:
      return angle({{"minimum", -90}, {"maximum", 90}});
    case ValueForm::turn:
      return angle({});
    case ValueForm::pair:
      return numbers(2);
    case ValueForm::range: {
      Json schema = numbers(2);
      schema["uniqueItems"] = true;
      return schema;
    }
    case ValueForm::turns: {
      Json schema = numbers(3);
      schema["items"] = withoutNull(angle({}));
      return schema;
    }
    case ValueForm::direction:
      return orCoordinates(notAllZero(3), 3, true);
    case ValueForm::quaternion:
      return orCoordinates(notAllZero(4), 4, true);
    case ValueForm::position:
      return {{"if", place()}, {"then", objectOf(*field.object, false)}, {"else", orCoordinates(numbers(3), 3, false)}};
    case ValueForm::rigid:
      return matrix();
    case ValueForm::word:
      return wordOf(field.words());
    case ValueForm::object:
      return objectOf(*field.object, true);
    case ValueForm::anything:
    case ValueForm::label:
    case ValueForm::natural:
    case ValueForm::triple:
    case ValueForm::points:
    case ValueForm::objects:
      break;
  }
  return Json::object();  // no field of a camera file has these forms
}

/// A value of this field, or null.
Json valueOf(const Field& field) {
  Json schema = formOf(field);
  schema["description"] = field.help;
  return schema;
}

std::vector<std::string> allNames(const Field& field) {
  std::vector<std::string> names{std::string(field)};
  for (const std::string_view other : field.aliases()) names.emplace_back(other);
  return names;
}

/// The object has this field, under any of its names.
Json has(const Field& field) {
  Json ways = Json::array();
  for (const std::string& name : allNames(field))
    ways.push_back({{"type", "object"}, {"required", {name}}, {"properties", {{name, notNull()}}}});
  return {{"anyOf", ways}};
}

/// At most one of the names has a value.
Json underOneName(const Field& field) {
  Json ways = Json::array();
  const std::vector<std::string> names = allNames(field);
  for (const std::string& name : names) {
    Json others = Json::object();
    for (const std::string& other : names)
      if (other != name) others[other] = ofType("null");
    ways.push_back({{"type", "object"}, {"properties", others}});
  }
  return {{"anyOf", ways}};
}

bool contains(FieldList list, const Field* field) { return std::find(list.begin(), list.end(), field) != list.end(); }

/// The fields that a form's ways speak of are used as this one does; null: none is there.
Json usedAs(const ObjectForm& form, const Way* way) {
  Json absent = Json::object(), any = Json::array(), all = Json::array();
  for (const Field* field : form.fields) {
    if (way && contains(way->keys, field) && way->anyKey) {
      any.push_back(has(*field));
    } else if (way && (contains(way->keys, field) || contains(way->with, field))) {
      all.push_back(has(*field));
    } else if (!way || !way->uses(*field)) {
      for (const Way& other : form.ways)
        if (other.uses(*field))
          for (const std::string& one : allNames(*field)) absent[one] = ofType("null");
    }
  }
  Json schema = ofType("object");
  if (!any.empty()) schema["anyOf"] = any;
  if (!all.empty()) schema["allOf"] = all;
  schema["properties"] = absent;
  return schema;
}

/// An object of this form; what is null counts as absent. own: schemas of fields that their rows do not tell.
Json objectOf(const ObjectForm& form, bool orNull, const Json& own) {
  Json schema = {{"description", form.help}, {"type", "object"}};
  if (orNull) schema["type"] = {"object", "null"};
  Json required = Json::array();
  for (const Field* field : form.fields) {
    const std::string name(*field);
    Json value = own.contains(name) ? own[name] : valueOf(*field);
    if (contains(form.required, field)) {
      required.push_back(name);
      value = withoutNull(value);
    }
    schema["properties"][name] = value;
    for (const std::string_view other : field->aliases()) {
      value["description"] = "Another name of " + name + ".";
      schema["properties"][std::string(other)] = value;
    }
    if (!field->aliases().empty()) schema["allOf"].push_back(underOneName(*field));
  }
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  if (form.ways.empty()) return schema;
  Json ways = Json::array();
  if (form.aim.empty()) ways.push_back(usedAs(form, nullptr));
  for (const Way& way : form.ways) ways.push_back(usedAs(form, &way));
  schema["oneOf"] = ways;
  return schema;
}

/// A preset's name, or its axes one by one.
Json convention() {
  return {{"description", field::convention.help},
          {"if", ofType("string")},
          {"then", wordOf(presetNames(), false)},
          {"else", objectOf(field::axes, true)}};
}

Json projection() {
  Json types = Json::array(), which = Json::array();
  for (const ProjectionType& type : projectionTypes()) {
    const Json isType = {{"type", "object"},
                         {"required", {field::type.name}},
                         {"properties", {{std::string(field::type), {{"const", type.name}}}}}};
    types.push_back(type.name);
    which.push_back(
        {{"if", isType}, {"then", objectOf(type.form, false, {{std::string(field::type), {{"const", type.name}}}})}});
  }
  return {{"description", field::projection.help},
          {"type", {"object", "null"}},
          {"properties", {{std::string(field::type), {{"description", field::type.help}, {"enum", types}}}}},
          {"required", {field::type.name}},
          {"allOf", which}};
}

/// x, y, width and height, or an object of all.
Json viewport() {
  const Json number = ofType("number"), positive = {{"type", "number"}, {"exclusiveMinimum", 0}};
  return {
      {"description", field::viewport.help},
      {"if", ofType("array")},
      {"then",
       {{"type", "array"}, {"prefixItems", {number, number, positive, positive}}, {"minItems", 4}, {"maxItems", 4}}},
      {"else", objectOf(field::picture, true)}};
}

}  // namespace

std::string cameraSchema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"$id", "urn:viewproj:schema:camera"},
                 {"title", "Camera file of viewproj"}};
  schema.update(objectOf(field::camera, false,
                         {{std::string(field::convention), convention()},
                          {std::string(field::projection), projection()},
                          {std::string(field::viewport), viewport()}}));
  schema["description"] =
      std::string(field::camera.help) +
      " Each may be absent where the command does without; what is null counts as absent. Lengths are in the world's "
      "unit, angles in degrees, pixels in screen units. Files of other programs, which viewproj also reads, are not "
      "described here. The reader also checks what a schema cannot say, and what takes several fields: that far is "
      "above near, that the camera's shape fits the viewport's, that a rotation's axes have the world's handedness.";
  return schema.dump(2) + "\n";
}

}  // namespace viewproj::cmd
