#include "schema/camera.hpp"

#include <nlohmann/json.hpp>

#include "camera/fields.hpp"

namespace viewproj::cmd {
namespace {

using Schema = nlohmann::ordered_json;

Schema ofType(const char* type) { return {{"type", type}}; }
Schema numbers(std::size_t count) {
  return {{"type", "array"}, {"items", ofType("number")}, {"minItems", count}, {"maxItems", count}};
}
Schema coordinates(std::size_t count) {
  Schema object = {{"type", "object"}, {"required", Schema::array()}};
  for (const char* name : {"x", "y", "z", "w"})
    if (object["required"].size() < count) object["required"].push_back(name);
  return {{"anyOf", {numbers(count), object}}};
}
Schema rows() { return {{"type", "array"}, {"items", numbers(4)}, {"minItems", 3}, {"maxItems", 4}}; }
Schema numberOrText(const char* pattern) {
  return {{"anyOf", {ofType("number"), {{"type", "string"}, {"pattern", pattern}}}}};
}

/// A value of the field. What takes several fields, or a range, the reader says.
Schema schemaOf(const Field& field) {
  switch (field.kind) {
    case Kind::text:
      return ofType("string");
    case Kind::word: {
      Schema words = Schema::array();
      for (const std::string_view word : field.words()) words.push_back(word);
      return {{"enum", words}};
    }
    case Kind::flag:
      return ofType("boolean");
    case Kind::number:
      return ofType("number");
    case Kind::positive:
      return {{"type", "number"}, {"exclusiveMinimum", 0}};
    case Kind::far:
      return {{"anyOf", {ofType("number"), {{"const", "inf"}}}}};
    case Kind::zero:
      return {{"const", 0}};
    case Kind::ratio:
      return numberOrText("[/:]");
    case Kind::angle:
    case Kind::elevation:
    case Kind::turn:
      return numberOrText("(deg|rad|\xC2\xB0)$");
    case Kind::pair:
    case Kind::range:
    case Kind::size:
      return coordinates(2);
    case Kind::direction:
      return coordinates(3);
    case Kind::quaternion:
      return coordinates(4);
    case Kind::place: {
      Schema schema = coordinates(3);
      schema["anyOf"].push_back({{"type", "object"}, {"required", {"lat", "lon", "height"}}});
      return schema;
    }
    case Kind::euler:
      return {{"type", "object"}, {"required", {"order", "degrees"}}};
    case Kind::rigid:
      return {{"anyOf", {rows(), {{"type", "object"}, {"required", {"translation"}}}}}};
    case Kind::matrix:
      return {{"anyOf", {rows(), numbers(16)}}};
    case Kind::lens:
      return {{"type", "object"}, {"required", {"model"}}};
  }
  return Schema::object();
}

}  // namespace

std::string cameraSchema() {
  Schema schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"$id", "urn:viewproj:schema:camera"},
                   {"title", "Camera file of viewproj"},
                   {"type", "object"},
                   {"additionalProperties", false}};
  for (const Field& field : kFields) {
    Schema* object = &schema;
    std::string_view rest = field.path;
    for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
      object = &(*object)["properties"][std::string(rest.substr(0, dot))];
      (*object)["type"] = {"object", "null"};
      (*object)["additionalProperties"] = false;
      rest.remove_prefix(dot + 1);
    }
    Schema value = {{"anyOf", {schemaOf(field), ofType("null")}}, {"description", field.help}};
    (*object)["properties"][std::string(rest)] = value;
    for (std::string_view others = field.others; !others.empty();) {
      const std::string_view other = others.substr(0, others.find(' '));
      others.remove_prefix(std::min(other.size() + 1, others.size()));
      (*object)["properties"][std::string(other)] = value;
    }
  }
  Schema& convention = schema["properties"]["convention"];
  convention = {{"anyOf", {schemaOf(*findField("convention.preset")), convention}}};
  return schema.dump(2) + "\n";
}

}  // namespace viewproj::cmd
