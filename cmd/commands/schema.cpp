// viewproj schema: the JSON Schema of a camera file, from the table of its fields.
#include <nlohmann/json.hpp>

#include "camera/fields.hpp"
#include "commands/cli.hpp"
#include "commands/command.hpp"
#include "output/output_file.hpp"
#include "output/report.hpp"

namespace viewproj::cmd {
namespace {

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

OrderedJson schemaOf(const Field& field) {
  if (field.kind == Kind::word) return {{"enum", field.words()}};
  return OrderedJson::parse(rowOf(field.kind).schema);
}

std::string cameraSchema() {
  OrderedJson schema = OrderedJson::parse(
      R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "urn:viewproj:schema:camera",
          "title": "Camera file of viewproj", "type": "object", "additionalProperties": false})");
  schema["$defs"] = OrderedJson::parse(kParts);
  for (const Field& field : kFields) {
    OrderedJson* object = &schema;
    std::string_view rest = field.path;
    for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
      object = &(*object)["properties"][std::string(rest.substr(0, dot))];
      (*object)["type"] = {"object", "null"};
      (*object)["additionalProperties"] = false;
      rest.remove_prefix(dot + 1);
    }
    const OrderedJson value = {{"anyOf", {schemaOf(field), {{"type", "null"}}}}, {"description", field.help}};
    (*object)["properties"][std::string(rest)] = value;
    if (object != &schema) continue;
    if (!field.alias.empty()) schema["properties"][std::string(field.alias)] = value;
  }
  schema["properties"]["cameras"] = {{"type", "array"},
                                     {"items", {{"$ref", "#"}}},
                                     {"description", "Cameras, each laid over the other members of the file."}};
  OrderedJson& convention = schema["properties"]["convention"];
  convention = {{"anyOf", {schemaOf(*findField("convention.preset")), convention}}};
  return schema.dump(2) + "\n";
}

}  // namespace

Action declareSchema(CLI::App& app) {
  describe(app, "The JSON Schema (draft 2020-12) of a camera file, for editors and validators.",
           "Example:\n  viewproj schema > camera.schema.json");
  addOnlyForm(app, "JSON", ".json");
  return [] {
    writeOutput(cameraSchema());
    return 0;
  };
}

}  // namespace viewproj::cmd
