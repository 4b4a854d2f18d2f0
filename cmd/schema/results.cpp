// The JSON Schema of results, from their rows.
#include "output/results.hpp"

#include <cmath>

#include "input/camera_fields.hpp"
#include "output/camera_matrices.hpp"
#include "schema/parts.hpp"
#include "schema/schemas.hpp"

namespace viewproj::cmd {
namespace {

using schema::Json;

Json words(ResultWords which, bool orNull) {
  const auto known = wordsOf(which);
  return schema::wordOf({known.begin(), known.end()}, orNull);
}

Json number(const ResultRow& row) {
  Json schema = {{"type", "number"}};
  if (std::isfinite(row.least)) schema["minimum"] = static_cast<int>(row.least);
  if (std::isfinite(row.most)) schema["maximum"] = static_cast<int>(row.most);
  return schema;
}

Json schemaOf(const ResultRow& row);

/// An object of the parts and nothing else. Those that are not always given come together.
Json objectOf(ResultParts parts) {
  Json properties = Json::object(), required = Json::array(), asked = Json::array();
  for (const ResultRow* part : parts) {
    properties[std::string(part->name)] = schemaOf(*part);
    (part->given == Given::asked ? asked : required).push_back(part->name);
  }
  Json schema = {
      {"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", false}};
  for (const Json& name : asked) schema["dependentRequired"][name.get<std::string>()] = asked;
  return schema;
}

/// Of its value; null aside, but for words.
Json valueOf(const ResultRow& row) {
  switch (row.kind) {
    case ResultKind::number:
      return number(row);
    case ResultKind::vector:
      return {{"type", "array"}, {"items", number(row)}, {"minItems", row.size}, {"maxItems", row.size}};
    case ResultKind::flag:
      return {{"type", "boolean"}};
    case ResultKind::names:
      return {{"type", "array"}, {"uniqueItems", true}, {"items", words(row.words, false)}};
    case ResultKind::word:
      return words(row.words, row.canBeNull);
    case ResultKind::json:
      return schema::anyOf({{{"type", "string"}}, {{"type", "number"}}});
    case ResultKind::group:
      return objectOf(row.parts);
    case ResultKind::list:
      return {{"type", "array"}, {"items", objectOf(row.parts)}};
  }
  return true;  // uncounted: these are all
}

Json schemaOf(const ResultRow& row) {
  Json schema = valueOf(row);
  if (row.canBeNull && row.kind != ResultKind::word) schema = schema::anyOf({schema, schema::ofType("null")});
  schema["description"] = std::string(row.help) + (row.unit.empty() ? "" : "; " + std::string(row.unit));
  return schema;
}

/// The first row of a name counts: of a hit with a place and one without the former.
Json propertiesOf(ResultParts rows) {
  Json properties = Json::object();
  for (const ResultRow* row : rows)
    if (!properties.contains(std::string(row->name))) properties[std::string(row->name)] = schemaOf(*row);
  return properties;
}

/// A record with these results.
Json recordOf(ResultParts rows) {
  Json required = Json::array();
  for (const ResultRow* row : rows)
    if (row->given != Given::asked) required.push_back(row->name);
  return {{"type", "object"}, {"properties", propertiesOf(rows)}, {"required", required}};
}

/// An object whose field has this value.
Json isThere(const std::string& name, const Json& value) {
  return {{"type", "object"}, {"required", {name}}, {"properties", {{name, {{"const", value}}}}}};
}

Json having(const Json& properties) { return {{"type", "object"}, {"properties", properties}}; }

/// A record with one of these results at least.
Json someOf(ResultParts rows) {
  Json any = Json::array();
  for (const ResultRow* row : rows) {
    const std::string name(row->name);
    any.push_back({{"type", "object"}, {"required", {name}}, {"properties", {{name, true}}}});
  }
  return {{"type", "object"}, {"properties", propertiesOf(rows)}, {"minProperties", 2}, {"anyOf", any}};
}

/// Or a shape.
Json projectedPoint() {
  Results rows;
  for (const PointResult& result : pointResults()) rows.push_back(&result.row);
  Json schema = someOf(rows);
  schema["if"] = isThere("visible", true);
  schema["then"] = having({{"outside", {{"const", Json::array()}}}});
  return schema;
}

Json projectedSegment() {
  Json schema = recordOf(results::kSegment), there = Json::object(), none = Json::object();
  schema["properties"]["segment"] = {{"type", "array"},
                                     {"items", schema::anyOf({schema::reference("vector3"), schema::ofType("object")})},
                                     {"minItems", 2},
                                     {"maxItems", 2}};
  schema["required"].push_back("segment");
  for (const ResultRow* row : results::kSegment) {
    if (row->kind != ResultKind::group) continue;
    if (row->given != Given::asked) there[std::string(row->name)] = {{"type", "object"}};
    none[std::string(row->name)] = schema::ofType("null");
  }
  schema["description"] = "The ends of what is visible of it, null where nothing is.";
  schema["if"] = isThere("visible", true);
  schema["then"] = having(there);
  schema["else"] = having(none);
  return schema;
}

Json culled() {
  Json schema = recordOf(results::kCull);
  schema["if"] = isThere("cull", "inside");
  schema["then"] = having({{"plane", schema::ofType("null")}});
  schema["else"] = having({{"plane", words(ResultWords::sides, false)}});
  return schema;
}

/// Planes of cull: an infinite far has none.
Json planes() {
  Json properties = Json::object(), required = Json::array();
  for (const std::string_view side : wordsOf(ResultWords::sides)) {
    properties[std::string(side)] = schema::reference("vector4");
    if (side != "far") required.push_back(side);
  }
  return {{"description", "a, b, c, d, ax + by + cz + d >= 0 inside. An infinite far has no plane."},
          {"type", "object"},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

/// Of cull: on near and far, or where that is infinite the directions to it.
Json corners() {
  const auto of = [](const std::vector<std::string>& planes) {
    Json properties = Json::object(), required = Json::array();
    for (const std::string& plane : planes)
      for (const char* corner : {"BottomLeft", "BottomRight", "TopRight", "TopLeft"}) {
        properties[plane + corner] = schema::reference("vector3");
        required.push_back(plane + corner);
      }
    return Json{
        {"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", false}};
  };
  return {{"description", "Of the view; the directions to those of a far that is infinite."},
          {"anyOf", {of({"near", "far"}), of({"near", "direction"})}}};
}

/// Of a convention, as reports write it: without its preset, and with all axes or some.
Json axes(bool all) {
  Json properties = Json::object(), required = Json::array();
  for (const Field* field : field::axes.fields) {
    if (field == &field::preset) continue;
    required.push_back(field->name);
    properties[field->name] = field->words ? schema::wordOf(field->words(), false) : schema::ofType("boolean");
  }
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (all) schema["required"] = required;
  return schema;
}

Json matrices() {
  Json properties = {{"convention", schema::reference("allAxes")}};
  properties["camera"] = {{"type", "string"}, {"description", "With --all: what picks it of its file."}};
  properties["eye"] = schema::reference("vector3");
  properties["eye"]["description"] = "With --relative-to-eye: to be subtracted before the view.";
  for (const CameraMatrix& row : cameraMatrices())
    for (const std::string_view after : {std::string_view(), kInverse})
      properties[std::string(row.name) + std::string(after)] = schema::reference("matrix4");
  return {
      {"description", "Rows as the convention writes them on paper: with row vectors the translation is the last row."},
      {"type", "object"},
      {"properties", properties},
      {"required", {"convention"}},
      {"minProperties", 2},
      {"additionalProperties", false}};
}

}  // namespace

std::string resultsSchema() {
  Json all = schema::head(
      "results", "Results of viewproj in JSON",
      "One JSON value of what a command prints in JSON. Of lines (NDJSON) it describes each. #/$defs/NAME describes "
      "what the command NAME alone prints: project, ray, cull, planes (cull --planes), corners (cull --corners), "
      "matrix, "
      "explain, inspect, depth, depths (depth --depth), measure. Screen positions are pixels as the viewport counts "
      "them, depth is window depth, distances and points "
      "are in the world's unit and frame, angles in degrees unless named radians. What has no value is null. Records "
      "keep the fields they came with in front of the results; those whose names --prefix changes, and fields of a "
      "result's name that --fields leaves out, are not described.");
  const Json reports = Json::parse(reportsText());
  Json definitions = Json::object();
  const auto filter = [&](const std::string& name, const std::string& record, const std::vector<Json>& records) {
    definitions[name] = schema::recordsOf(record);
    Json any = records;
    any.push_back(schema::reference("errorRecord"));
    definitions[record] = {{"anyOf", any}};
  };
  filter("project", "projectedRecord", {schema::reference("projectedPoint"), schema::reference("projectedSegment")});
  filter("ray", "castRecord", {schema::reference("cast")});
  filter("cull", "culledRecord", {schema::reference("culled")});
  definitions["projectedPoint"] = projectedPoint();
  definitions["projectedSegment"] = projectedSegment();
  definitions["cast"] = someOf(results::kRay);
  definitions["culled"] = culled();
  definitions["outside"] = {{"type", "array"}, {"uniqueItems", true}, {"items", words(ResultWords::outside, false)}};
  definitions["planes"] = planes();
  definitions["corners"] = corners();
  definitions["axes"] = axes(false);
  definitions["allAxes"] = axes(true);
  definitions["matrix"] = matrices();
  definitions.update(reports);
  for (const char* name :
       {"project", "ray", "cull", "planes", "corners", "matrix", "explain", "inspect", "depth", "depths", "measure"})
    all["anyOf"].push_back(schema::reference(name));
  all["$defs"] = definitions;
  return all.dump(2) + "\n";
}

}  // namespace viewproj::cmd
