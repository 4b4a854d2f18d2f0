// The JSON Schema of what is read from streams, from the rows of coordinates.
#include <cctype>
#include <cmath>
#include <vector>

#include "input/coordinates.hpp"
#include "schema/parts.hpp"
#include "schema/schemas.hpp"

namespace viewproj::cmd {
namespace {

using schema::Json;

Json notZero() { return {{"not", {{"const", 0}}}}; }

Json numbers(std::size_t fewest, std::size_t most) {
  return {{"type", "array"}, {"items", schema::ofType("number")}, {"minItems", fewest}, {"maxItems", most}};
}

Json having(const Json& properties, const Json& required = Json::array()) {
  Json schema = {{"type", "object"}, {"properties", properties}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json partOf(const CoordinatePart& part) {
  if (part.size > 1) return schema::reference("vector");
  Json schema = schema::ofType("number");
  if (std::isfinite(part.least)) schema["minimum"] = static_cast<int>(part.least);
  if (std::isfinite(part.most)) schema["maximum"] = static_cast<int>(part.most);
  return schema;
}

/// The pattern of a name and its aliases in any case.
std::string anyCase(std::string_view name, Aliases aliases) {
  std::string pattern;
  const auto add = [&](std::string_view one) {
    pattern += pattern.empty() ? "^(" : "|";
    for (const char c : one) {
      const auto letter = static_cast<unsigned char>(c);
      pattern +=
          std::string("[") + static_cast<char>(std::tolower(letter)) + static_cast<char>(std::toupper(letter)) + "]";
    }
  };
  add(name);
  for (const std::string_view alias : aliases) add(alias);
  return pattern + ")$";
}

/// An object with a field of the name, in any case, or of an alias, and a value that fits.
Json hasNamed(std::string_view name, Aliases aliases, const Json& value) {
  return {{"not", {{"type", "object"}, {"patternProperties", {{anyCase(name, aliases), {{"not", value}}}}}}}};
}

/// An object that has the parts of a row, in any case or by aliases.
Json hasParts(const Coordinate& row) {
  std::vector<Json> parts;
  Json properties = Json::object();
  for (std::size_t i = 0; i < row.fewest; ++i) properties[std::string(row.parts[i].name)] = partOf(row.parts[i]);
  parts.push_back(having(properties));
  for (std::size_t i = 0; i < row.fewest; ++i)
    parts.push_back(hasNamed(row.parts[i].name, row.parts[i].aliases, partOf(row.parts[i])));
  Json all = schema::ofType("object");
  all["allOf"] = parts;
  return all;
}

/// An object that has the row: its fields, in the form by which that counts.
Json has(const Coordinate& row) {
  const bool byForm = row.form != CoordinateForm::numbers && row.form != CoordinateForm::array;
  if (row.form == CoordinateForm::numbers) {
    Json properties = Json::object(), required = Json::array();
    for (std::size_t i = 0; i < row.fewest; ++i) {
      properties[std::string(row.parts[i].name)] = true;
      required.push_back(row.parts[i].name);
    }
    return having(properties, required);
  }
  const std::string field(row.name);
  return having({{field, !byForm            ? Json(true)
                         : row.first == '[' ? schema::ofType("array")
                                            : schema::ofType("object")}},
                {field});
}

/// What a record that has it must be.
Json valueOf(const Coordinate& row) {
  const std::string name(row.name);
  Json properties = Json::object(), required = Json::array();
  for (std::size_t i = 0; i < row.parts.size(); ++i) {
    properties[std::string(row.parts[i].name)] = partOf(row.parts[i]);
    if (row.form == CoordinateForm::object || i < row.fewest) required.push_back(row.parts[i].name);
  }
  switch (row.form) {
    case CoordinateForm::array:
      return having({{name, schema::reference(row.orNull              ? "pixelOrNull"
                                              : row.kind == kindPoint ? "point"
                                                                      : "direction")}},
                    {name});
    case CoordinateForm::points:
      return having({{name,
                      {{"type", "array"},
                       {"items", schema::reference("vector")},
                       {"minItems", row.fewest},
                       {"maxItems", row.fewest}}}});
    case CoordinateForm::object:
      return having({{name, having(properties, required)}});
    default:
      return having(properties, required);
  }
}

/// x, y, z, w, or X, Y, Z, W, that are not all 0.
Json notAllZero(const Coordinate& row) {
  Json zeros = Json::object(), upperZeros = Json::object();
  const auto upper = [](std::string_view name) {
    std::string letters(name);
    for (char& c : letters) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return letters;
  };
  for (const CoordinatePart& part : row.parts)
    zeros[std::string(part.name)] = upperZeros[upper(part.name)] = {{"const", 0}};
  const std::string_view first = row.parts.front().name, last = row.parts.back().name;
  return {{"if", having({{std::string(first), true}}, {first})},
          {"then", {{"not", having(zeros, {last})}}},
          {"else", {{"not", having(upperZeros, {upper(last)})}}}};
}

/// The first of the rows that a record has decides, or else the last word.
template <class Then>
Json firstOf(std::span<const Coordinate* const> rows, const Then& then, const Json& otherwise) {
  if (rows.empty()) return otherwise;
  return {{"description", std::string(rows[0]->name) + ": " + std::string(rows[0]->help)},
          {"if", has(*rows[0])},
          {"then", then(*rows[0])},
          {"else", firstOf(rows.subspan(1), then, otherwise)}};
}

Json pointFields() {
  const std::span rows(coordinates::kPoints);
  const auto then = [](const Coordinate& row) {
    const bool weighted = row.form == CoordinateForm::numbers && row.most > row.fewest;
    return weighted ? schema::allOf({valueOf(row), notAllZero(row)}) : valueOf(row);
  };
  const auto named = [](const Coordinate& row) {
    std::vector<Json> parts;
    for (std::size_t i = 0; i < row.fewest; ++i)
      parts.push_back(hasNamed(row.parts[i].name, row.parts[i].aliases, true));
    return Json{{"allOf", parts}};
  };
  const Json others = {{"if", {{"anyOf", {named(coordinates::xyz), named(coordinates::place)}}}},
                       {"then", schema::reference("otherNames")},
                       {"else", {{"anyOf", {schema::reference("otherNames"), schema::reference("shape")}}}}};
  return schema::allOf({schema::ofType("object"), firstOf(rows, then, others)});
}

/// The w of x, y, z, or W of X, Y, Z.
Json weightOf(const Json& weight) {
  return {{"if", having({{"x", true}}, {"x"})}, {"then", having({{"w", weight}})}, {"else", having({{"W", weight}})}};
}

/// A point by names in another case and by aliases, where a record has none of the very names.
Json otherNames() {
  return {
      {"anyOf",
       {hasNamed(coordinates::position.name, coordinates::position.aliases, schema::reference("point")),
        schema::allOf({hasParts(coordinates::xyz), weightOf(schema::ofType("number")), notAllZero(coordinates::xyz)}),
        hasParts(coordinates::place), hasNamed(coordinates::direction.name, {}, schema::reference("direction"))}}};
}

/// An object of x, y, z or of lat, lon, height, or an array.
Json pointOr(const Json& array, const Json& object) { return {{"anyOf", {array, object}}}; }

Json objectOr(const Json& object, const Json& array) {
  return {{"if", schema::ofType("object")}, {"then", object}, {"else", array}};
}

/// A point that is no direction, perhaps with the radius of a sphere about it.
Json finitePoint() {
  Json beside = Json::object();
  for (const Coordinate* row : coordinates::kNotRead)
    beside[std::string(row->name)] = {{"not", row->first == '{' ? schema::ofType("object") : Json{{"type", "string"}}}};
  beside[std::string(coordinates::radius.name)] = partOf(coordinates::radius.parts[0]);
  const auto weight = [](const Coordinate& row) -> Json {
    if (row.kind != kindPoint) return row.kind != kindDirection;
    if (row.form == CoordinateForm::array) return having({{std::string(row.name), schema::reference("weighted")}});
    return having({{"w", notZero()}});
  };
  Json others = having({{"W", notZero()}});
  others["patternProperties"] = {
      {anyCase(coordinates::position.name, coordinates::position.aliases),
       Json{{"anyOf", {schema::reference("weighted"), {{"not", schema::reference("point")}}}}}}};
  return objectOr(
      schema::allOf({having(beside), schema::reference("pointFields"), firstOf(coordinates::kPoints, weight, others)}),
      schema::allOf({schema::reference("xyz"), schema::reference("weighted")}));
}

Json pixelFields() {
  Json distances = Json::object();
  for (const Coordinate* row : coordinates::kDistances)
    distances[std::string(row->name)] = {{"type", {"number", "null"}}};
  const std::span rows(coordinates::kPixels);
  const auto then = [](const Coordinate& row) {
    return &row == &coordinates::xy ? schema::allOf({valueOf(row), having({{"z", false}})}) : valueOf(row);
  };
  std::vector<Json> others = {schema::allOf({hasParts(coordinates::xy), having({{"z", false}, {"Z", false}})})};
  for (const Coordinate* row : {&coordinates::screen, &coordinates::pixel})
    others.push_back(hasNamed(row->name, {}, numbers(2, 2)));
  return schema::allOf({having(distances), firstOf(rows, then, {{"anyOf", others}})});
}

/// A record, an array of records or a document.
Json arranged(const std::string& record) {
  const Json records = {{"type", "array"}, {"items", schema::reference(record)}};
  return {{"if", schema::reference("isDocument")},
          {"then", having({{"points", records}}, {"points"})},
          {"else",
           {{"if", schema::reference("isArrayOfRecords")}, {"then", records}, {"else", schema::reference(record)}}}};
}

}  // namespace

std::string pointsSchema() {
  Json all = schema::head(
      "points", "Points for viewproj",
      "One JSON value of a stream of points, as project and measure read it: a record, an array of records, or a "
      "document {\"points\": [records], ...}; project reads shapes too. Of a sequence of values (NDJSON, jq) it "
      "describes each. #/$defs/shapes "
      "describes what cull reads, #/$defs/pixels what ray reads; draw reads points and shapes. Points are in the "
      "world's frame and unit, that of the camera; places (degrees on WGS84, metres above the ellipsoid) need a camera "
      "on the Earth, and three numbers without names one elsewhere. A field counts as a shape where its value has the "
      "form. What none of these names, names in another case and the aliases do: see otherNames. Two points or two "
      "shapes "
      "in a record are an error. Other fields of a record pass through, so names that results get are taken, unless "
      "--prefix names those "
      "otherwise. null is a value here and does not count as absent. What a schema cannot say and the reader still "
      "asks for: a document's first key is points; no coordinate of a box's max is below that of its min; a depth or "
      "viewDistance is in front of the eye; no number leaves the range of doubles, and no key is given twice.");
  const Json pixel = {{"anyOf", {schema::reference("numbers2"), {{"type", "null"}}}}};
  const auto segment = [&](const Coordinate& row) {
    return schema::allOf({valueOf(row), having({{std::string(coordinates::pixel.name), pixel}})});
  };
  const Coordinate* const segments[] = {&coordinates::segment};
  Json& definitions = all["$defs"];
  definitions["points"] = arranged("pointRecord");
  definitions["shapes"] = arranged("shapeRecord");
  definitions["pixels"] = arranged("pixelRecord");
  definitions["isDocument"] = having({{"points", schema::ofType("array")}}, {"points"});
  definitions["isArrayOfRecords"] = {{"description", "An array with a number in it is a record."},
                                     {"type", "array"},
                                     {"not", {{"type", "array"}, {"contains", schema::ofType("number")}}}};
  definitions["pointRecord"] =
      objectOr(firstOf(segments, segment, schema::reference("pointFields")), schema::reference("xyz"));
  definitions["pointFields"] = pointFields();
  definitions["shapeRecord"] = firstOf(coordinates::kShapes, valueOf, schema::reference("finitePoint"));
  definitions["shape"] = firstOf(coordinates::kShapes, valueOf, false);
  definitions["finitePoint"] = finitePoint();
  definitions["pixelRecord"] = objectOr(pixelFields(), numbers(2, 3));
  definitions["numbers2"] = numbers(2, 2);
  definitions["otherNames"] = otherNames();
  const Json zeros = {{"not",
                       {{"type", "object"},
                        {"properties", {{"x", {{"const", 0}}}, {"y", {{"const", 0}}}, {"z", {{"const", 0}}}}},
                        {"required", {"x", "y", "z"}}}}};
  const auto ofParts = [](const Json& weight) {
    return Json{{"anyOf",
                 {schema::allOf({hasParts(coordinates::xyz), weightOf(weight), notAllZero(coordinates::xyz)}),
                  hasParts(coordinates::place)}}};
  };
  const Json ofXyz = schema::allOf({hasParts(coordinates::xyz), having({{"w", false}}), zeros});
  definitions["point"] = pointOr(schema::reference("xyz"), ofParts(schema::ofType("number")));
  definitions["vector"] = pointOr(numbers(3, 3), ofParts(false));
  definitions["direction"] = pointOr(schema::reference("nonzero3"), ofXyz);
  definitions["xyz"] = numbers(3, 4);
  definitions["xyz"]["not"] = {{"const", {0, 0, 0, 0}}};
  definitions["nonzero3"] = numbers(3, 3);
  definitions["nonzero3"]["contains"] = notZero();
  const Json zeroAtEnd = {
      {"type", "array"}, {"prefixItems", {true, true, true, {{"const", 0}}}}, {"minItems", 4}, {"maxItems", 4}};
  definitions["weighted"] = {{"anyOf", {{{"type", "array"}, {"not", zeroAtEnd}}, weightOf(notZero())}}};
  definitions["pixelOrNull"] = numbers(2, 2);
  definitions["pixelOrNull"]["type"] = {"array", "null"};
  all["$ref"] = "#/$defs/points";
  return all.dump(2) + "\n";
}

}  // namespace viewproj::cmd
