// The JSON Schema of a camera file.
#include "input/camera_fields.hpp"
#include "input/projection_types.hpp"
#include "schema/parts.hpp"
#include "schema/schemas.hpp"

namespace viewproj::cmd {
namespace {

using schema::Json;

/// Names of the presets for which this holds.
template <class Condition>
Json presetsWith(const Condition& condition, bool orNull = false) {
  std::vector<std::string_view> names;
  for (const ConventionPreset& preset : conventionPresets())
    if (condition(preset)) names.push_back(preset.name);
  return schema::wordOf(names, orNull);
}

bool isLeft(const ConventionPreset& preset) { return preset.convention.world == Handedness::left; }
bool isReversed(const ConventionPreset& preset) { return preset.convention.reverseZ; }

/// A preset's name, or its axes one by one.
Json convention() {
  return {{"description", field::convention.help},
          {"if", {{"type", "string"}}},
          {"then", schema::wordOf(presetNames(), false)},
          {"else", schema::objectOf(field::axes, true)}};
}

Json projection() {
  Json types = Json::array(), which = Json::array();
  for (const ProjectionType& type : projectionTypes()) {
    types.push_back(type.name);
    which.push_back({{"if", schema::has(field::type, {{"const", type.name}})},
                     {"then", schema::reference(std::string(type.name))}});
  }
  return {{"description", field::projection.help},
          {"type", {"object", "null"}},
          {"properties", {{std::string(field::type), {{"description", field::type.help}, {"enum", types}}}}},
          {"required", {field::type.name}},
          {"allOf", which}};
}

/// The preset that the file names is left-handed.
Json namesLeftPreset() {
  const Json names = presetsWith(isLeft);
  return schema::has(field::convention, schema::anyOf({names, schema::has(field::preset, names)}));
}

Json worldIsLeft() {
  const Json names = presetsWith(isLeft);
  Json byPreset = schema::has(field::preset, names);
  byPreset["properties"][std::string(field::handedness)] = {{"type", "null"}};
  return schema::has(field::convention,
                     schema::anyOf({names, schema::has(field::handedness, {{"const", "left"}}), byPreset}));
}

/// A rotation keeps handedness, so the camera's axes have the world's; those that a file does not name are its
/// preset's.
Json rotationRule() {
  const auto axes = [](const char* one, const char* other) {
    return Json{{"type", "object"},
                {"properties", {{std::string(field::cameraAxes), {{"enum", {one, other, nullptr}}}}}}};
  };
  const Json stated = schema::has(field::cameraAxes);
  const Json left = schema::reference("worldIsLeft"), leftPreset = schema::reference("namesLeftPreset");
  return {{"description", "A rotation keeps handedness, so the camera's axes have the world's."},
          {"if", schema::anyOf({schema::has(field::rotation), schema::has(field::euler)})},
          {"then",
           {{"if", left},
            {"then", schema::allOf({axes("RUF", "FRU"), schema::anyOf({leftPreset, stated})})},
            {"else", schema::allOf({axes("RUB", "RDF"), schema::anyOf({{{"not", leftPreset}}, stated})})}}}};
}

Json isPlace(const Field& field) { return schema::has(field, schema::place()); }

Json earthRule() {
  return {{"description", "Earth-centred coordinates are right-handed; a heading is one of a place."},
          {"allOf",
           {{{"if", schema::anyOf({schema::has(field::world), isPlace(field::position), isPlace(field::target)})},
             {"then", {{"not", schema::reference("worldIsLeft")}}}},
            {{"if", schema::anyOf({schema::has(field::heading), schema::has(field::pitch), schema::has(field::roll)})},
             {"then", isPlace(field::position)}}}}};
}

Json usesType(const Json& type, const Json& further = Json::object()) {
  Json value = schema::has(field::type, type);
  value.update(further);
  return schema::has(field::projection, value);
}

/// Of the ways to give a window those that tell the picture's shape themselves, and the aspect.
Json tellsShape(std::span<const Way> ways) {
  Json shapes = Json::array({schema::has(field::aspect)});
  for (const Way& way : ways) {
    if (way.uses(field::aspect)) continue;
    Json parts = Json::array();
    for (const FieldList list : {way.keys, way.with})
      for (const Field* field : list) parts.push_back(schema::has(*field));
    shapes.push_back({{"allOf", parts}});
  }
  return {{"anyOf", shapes}};
}

Json viewportRule() {
  std::vector<std::string_view> counting;
  for (const ProjectionType& type : projectionTypes())
    if (type.countsPixels) counting.push_back(type.name);
  return {{"description", "Some projections count the viewport's pixels, or take its shape for their own."},
          {"if", schema::anyOf({usesType(schema::wordOf(counting, false)),
                                usesType({{"const", kPerspective}}, {{"not", tellsShape(field::perspectiveWays)}}),
                                usesType({{"const", kOrthographic}}, {{"not", tellsShape(field::orthographicWays)}})})},
          {"then", schema::has(field::viewport)}};
}

/// x, y, width and height, or an object of all.
Json viewport() {
  const Json number = schema::ofType("number"), positive = {{"type", "number"}, {"exclusiveMinimum", 0}};
  return {
      {"description", field::viewport.help},
      {"if", {{"type", "array"}}},
      {"then",
       {{"type", "array"}, {"prefixItems", {number, number, positive, positive}}, {"minItems", 4}, {"maxItems", 4}}},
      {"else", schema::objectOf(field::picture, true)}};
}

Json reversedRules() {
  const Json none = {{"type", "null"}};
  const Json names = presetsWith(isReversed, true);
  const Json byPreset = {{"type", "object"},
                         {"properties", {{std::string(field::reverseZ), none}, {std::string(field::preset), names}}}};
  const Json picture = {
      {"type", {"object", "null"}},
      {"properties",
       {{std::string(field::x), none}, {std::string(field::y), none}, {std::string(field::depthRange), none}}}};
  const Json conventions = schema::anyOf({names, schema::has(field::reverseZ, {{"const", true}}), byPreset});
  return {{"description", "A ps2 projection says itself where the picture and the depths lie, and maps near to zMax."},
          {"if", usesType({{"const", kPs2}})},
          {"then",
           {{"type", "object"},
            {"properties", {{std::string(field::viewport), picture}, {std::string(field::convention), conventions}}}}}};
}

}  // namespace

std::string cameraSchema() {
  Json schema = schema::head(
      "camera", "Camera file of viewproj",
      std::string(field::camera.help) +
          " Each may be absent where the command does without; what is null counts as absent. Lengths are in the "
          "world's unit, angles in degrees, pixels in screen units. Meant is the file as it stands: what --viewport or "
          "--set would add does not count. Files of other programs, which viewproj also reads (glTF, transforms.json, "
          "three.js, calibrations, bare matrices), are not described here. What a schema cannot say and the reader "
          "still asks for: far is above near, right above left and top above bottom; the two numbers of a ps2 depth "
          "range differ; an angle or a ratio that is a text lies in the range of a number in its place; a camera shape "
          "fits the viewport's to 0.1 %; target is not the eye, and up not along the "
          "view; a matrix is orthogonal to 0.001 and its axes have the world's handedness; no number leaves the range "
          "of doubles on the way; no key is given twice.");
  schema["allOf"] = {schema::objectOf(field::camera, false,
                                      {{std::string(field::convention), convention()},
                                       {std::string(field::projection), projection()},
                                       {std::string(field::viewport), viewport()}}),
                     rotationRule(), earthRule(), reversedRules(), viewportRule()};
  Json& parts = schema["$defs"];
  for (const ProjectionType& type : projectionTypes())
    parts[std::string(type.name)] =
        schema::objectOf(type.form, false, {{std::string(field::type), {{"const", type.name}}}});
  parts["namesLeftPreset"] = namesLeftPreset();
  parts["worldIsLeft"] = worldIsLeft();
  return schema.dump(2) + "\n";
}

}  // namespace viewproj::cmd
