#include "schema/parts.hpp"

namespace viewproj::cmd::schema {
namespace {

Json notNull() { return {{"not", ofType("null")}}; }

Json numbers(int count) {
  return {{"type", {"array", "null"}}, {"items", {{"type", "number"}}}, {"minItems", count}, {"maxItems", count}};
}

Json notAllZero(int count) {
  Json schema = numbers(count);
  schema["contains"] = {{"not", {{"const", 0}}}};
  return schema;
}

Json number(std::initializer_list<std::pair<std::string, double>> limits) {
  Json schema = {{"type", {"number", "null"}}};
  for (const auto& [keyword, limit] : limits) schema[keyword] = static_cast<int>(limit);
  return schema;
}

Json withoutNull(Json schema) {
  if (!schema.contains("type") || !schema["type"].is_array()) {
    schema["not"] = ofType("null");
    return schema;
  }
  Json types = Json::array();
  for (const Json& type : schema["type"])
    if (type != "null") types.push_back(type);
  schema["type"] = types.size() == 1 ? types[0] : types;
  return schema;
}

/// The same for numbers, and for texts that match.
Json orText(const Json& number, const std::string& pattern) {
  return anyOf({number, {{"type", "string"}, {"pattern", pattern}}});
}

/// As parseNumber takes it.
const std::string kNumber = "[ \\t]*[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?[ \\t]*";

Json angle(std::initializer_list<std::pair<std::string, double>> limits) {
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
  return {{"if", {{"type", "object"}}}, {"then", object}, {"else", std::move(array)}};
}

Json matrix() {
  const Json row = withoutNull(numbers(4));
  return {{"type", {"array", "null"}},
          {"prefixItems", {row, row, row, {{"const", {0, 0, 0, 1}}}}},
          {"minItems", 4},
          {"maxItems", 4}};
}

Json range() {
  Json schema = numbers(2);
  schema["uniqueItems"] = true;
  return schema;
}

Json formOf(const Field& field) {
  switch (field.form) {
    case ValueForm::anything:  // uncounted: as its value
      return Json::object();   // uncounted: a node of glTF has them, of which there is no schema
    case ValueForm::text:
      return {{"type", {"string", "null"}}};
    case ValueForm::label:
      return anyOf({{{"type", "string"}}, {{"type", "number"}}, ofType("null")});
    case ValueForm::flag:
      return {{"type", {"boolean", "null"}}};
    case ValueForm::number:
      return number({});
    case ValueForm::positive:
      return number({{"exclusiveMinimum", 0}});
    case ValueForm::natural:
      return number({{"minimum", 0}});
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
    case ValueForm::range:
      return range();
    case ValueForm::triple:
      return numbers(3);
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
    case ValueForm::points: {
      Json schema = numbers(3);
      schema["items"] = orCoordinates(withoutNull(numbers(3)), 3, false);
      if (!field.object) return schema;
      Json places = schema;
      places["type"] = "array";
      places["items"] = objectOf(*field.object, false);
      return {{"anyOf", {schema, places}}};
    }
    case ValueForm::word:
      return wordOf(field.words());
    case ValueForm::object:
      return field.object ? objectOf(*field.object, true) : Json{{"type", {"object", "null"}}};
    case ValueForm::objects:
      return {{"type", {"array", "null"}}, {"items", objectOf(*field.object, false)}};
  }
  return Json::object();  // uncounted: these are all
}

std::vector<std::string> allNames(const Field& field) {
  std::vector<std::string> names{std::string(field)};
  for (const std::string_view other : field.aliases()) names.emplace_back(other);
  return names;
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
  Json required = Json::array(), properties = Json::object(), any = Json::array(), all = Json::array();
  for (const Field* field : form.fields) {
    const std::string name(*field);
    if (way && contains(way->keys, field) && way->anyKey) {
      any.push_back(has(*field));
    } else if (way && (contains(way->keys, field) || contains(way->with, field))) {
      if (!field->aliases().empty()) {
        all.push_back(has(*field));
        continue;
      }
      required.push_back(name);
      properties[name] = notNull();
    } else if (!way || !way->uses(*field)) {
      for (const Way& other : form.ways)
        if (other.uses(*field))
          for (const std::string& one : allNames(*field)) properties[one] = ofType("null");
    }
  }
  Json schema = {{"type", "object"}};
  if (!required.empty()) schema["required"] = required;
  if (!any.empty()) schema["anyOf"] = any;
  if (!all.empty()) schema["allOf"] = all;
  schema["properties"] = properties;
  return schema;
}

}  // namespace

Json head(const std::string& name, const std::string& title, const std::string& description) {
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"$id", "urn:viewproj:schema:" + name},
          {"title", title},
          {"description", description}};
}

Json ofType(const char* type) { return {{"type", type}}; }

Json reference(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }

Json wordOf(const std::vector<std::string_view>& words, bool orNull) {
  Json known = Json::array();
  for (const std::string_view word : words) known.push_back(word);
  if (orNull) known.push_back(nullptr);
  return {{"enum", known}};
}

Json valueOf(const Field& field) {
  Json schema = formOf(field);
  if (!field.help.empty()) schema["description"] = field.help;
  return schema;
}

Json place() {
  const Json hasX = {{"type", "object"}, {"required", {"x"}}, {"properties", {{"x", Json::object()}}}};
  return {{"type", "object"}, {"not", hasX}};
}

Json has(const Field& field, const Json& value) {
  Json ways = Json::array();
  for (const std::string& name : allNames(field))
    ways.push_back({{"type", "object"}, {"required", {name}}, {"properties", {{name, value}}}});
  return ways.size() == 1 ? ways[0] : Json{{"anyOf", ways}};
}

Json recordsOf(const std::string& record) {
  const Json records = {{"type", "array"}, {"items", reference(record)}};
  return anyOf({reference(record),
                records,
                {{"type", "object"}, {"required", {"points"}}, {"properties", {{"points", records}}}}});
}

Json allOf(std::initializer_list<Json> parts) { return {{"allOf", Json(parts)}}; }
Json anyOf(std::initializer_list<Json> parts) { return {{"anyOf", Json(parts)}}; }

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
    if (field->aliases().empty()) continue;
    for (const std::string_view other : field->aliases()) {
      Json same = valueOf(*field);
      same["description"] = "Another name of " + name + ".";
      schema["properties"][std::string(other)] = same;
    }
    schema["allOf"].push_back(underOneName(*field));
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

}  // namespace viewproj::cmd::schema
