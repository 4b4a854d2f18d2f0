// viewproj schema: the JSON Schema of a camera file, from the table of its fields.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "camera/check.hpp"
#include "commands/cli.hpp"
#include "commands/command.hpp"
#include "output/output_file.hpp"

namespace viewproj::cmd {
namespace {

using Schema = nlohmann::ordered_json;

/// What several kinds of value have in common.
constexpr const char* kParts = R"({
  "pair": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2},
  "triple": {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3},
  "four": {"type": "array", "items": {"type": "number"}, "minItems": 4, "maxItems": 4},
  "sixteen": {"type": "array", "items": {"type": "number"}, "minItems": 16, "maxItems": 16},
  "rows": {"type": "array", "items": {"$ref": "#/$defs/four"}, "minItems": 3, "maxItems": 4},
  "xy": {"anyOf": [{"$ref": "#/$defs/pair"}, {"type": "object", "required": ["x", "y"]}]},
  "xyz": {"anyOf": [{"$ref": "#/$defs/triple"}, {"type": "object", "required": ["x", "y", "z"]}]},
  "xyzw": {"anyOf": [{"$ref": "#/$defs/four"}, {"type": "object", "required": ["x", "y", "z", "w"]}]},
  "angle": {"anyOf": [{"type": "number"}, {"type": "string", "pattern": "(deg|rad|°)$"}]}
})";

/// What a value of a kind looks like. What depends on other fields, and ranges, the reader alone checks.
constexpr std::pair<Kind, const char*> kSchemas[] = {
    {Kind::text, R"({"type": "string"})"},
    {Kind::flag, R"({"type": "boolean"})"},
    {Kind::number, R"({"type": "number"})"},
    {Kind::positive, R"({"type": "number", "exclusiveMinimum": 0})"},
    {Kind::far, R"({"anyOf": [{"type": "number"}, {"const": "inf"}]})"},
    {Kind::zero, R"({"const": 0})"},
    {Kind::ratio, R"({"anyOf": [{"type": "number"}, {"type": "string", "pattern": "[/:]"}]})"},
    {Kind::angle, R"({"$ref": "#/$defs/angle"})"},
    {Kind::elevation, R"({"$ref": "#/$defs/angle"})"},
    {Kind::turn, R"({"$ref": "#/$defs/angle"})"},
    {Kind::pair, R"({"$ref": "#/$defs/xy"})"},
    {Kind::range, R"({"$ref": "#/$defs/xy"})"},
    {Kind::size, R"({"$ref": "#/$defs/xy"})"},
    {Kind::direction, R"({"$ref": "#/$defs/xyz"})"},
    {Kind::quaternion, R"({"$ref": "#/$defs/xyzw"})"},
    {Kind::place, R"({"anyOf": [{"$ref": "#/$defs/xyz"}, {"type": "object", "required": ["lat", "lon", "height"]}]})"},
    {Kind::euler, R"({"type": "object", "required": ["order", "degrees"]})"},
    {Kind::rigid, R"({"anyOf": [{"$ref": "#/$defs/rows"}, {"type": "object", "required": ["translation"]}]})"},
    {Kind::matrix, R"({"anyOf": [{"$ref": "#/$defs/rows"}, {"$ref": "#/$defs/sixteen"}]})"},
    {Kind::lens, R"({"type": "object", "required": ["model"], "additionalProperties": false, "properties": {
        "model": {"enum": ["brown", "fisheye", "unified", "double-sphere", "omni", "fov"]},
        "k": {"type": "array", "items": {"type": "number"}, "maxItems": 6}, "p": {"$ref": "#/$defs/pair"},
        "xi": {"type": "number", "exclusiveMinimum": -1}, "alpha": {"type": "number"},
        "beta": {"type": "number", "exclusiveMinimum": 0},
        "omega": {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 3.15},
        "limit": {"type": "object"}}})"},
};

Schema schemaOf(const Field& field) {
  if (field.kind == Kind::word) return {{"enum", field.words()}};
  for (const auto& [kind, schema] : kSchemas)
    if (kind == field.kind) return Schema::parse(schema);
  return Schema::object();  // none: every kind has its row
}

std::string cameraSchema() {
  Schema schema = Schema::parse(
      R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "urn:viewproj:schema:camera",
          "title": "Camera file of viewproj", "type": "object", "additionalProperties": false})");
  schema["$defs"] = Schema::parse(kParts);
  for (const Field& field : kFields) {
    Schema* object = &schema;
    std::string_view rest = field.path;
    for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
      object = &(*object)["properties"][std::string(rest.substr(0, dot))];
      (*object)["type"] = {"object", "null"};
      (*object)["additionalProperties"] = false;
      rest.remove_prefix(dot + 1);
    }
    const Schema value = {{"anyOf", {schemaOf(field), {{"type", "null"}}}}, {"description", field.help}};
    (*object)["properties"][std::string(rest)] = value;
    if (object != &schema) continue;
    for (const std::string_view name : namesOf(field)) schema["properties"][std::string(name)] = value;
  }
  Schema& convention = schema["properties"]["convention"];
  convention = {{"anyOf", {schemaOf(*findField("convention.preset")), convention}}};
  return schema.dump(2) + "\n";
}

}  // namespace

Action declareSchema(CLI::App& app) {
  app.description("The JSON Schema (draft 2020-12) of a camera file, for editors and validators.");
  app.footer("Example:\n  viewproj schema > camera.schema.json");
  addOnlyForm(app, "JSON", ".json");
  return [] {
    writeOutput(cameraSchema());
    return 0;
  };
}

}  // namespace viewproj::cmd
