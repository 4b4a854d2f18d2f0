// The schema of what is read from streams, from the rows of coordinates.
#include <cmath>

#include "commands/schema/json_schema.hpp"
#include "input/coordinates.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char *kObject = R"({"type": "object"})", *kArray = R"({"type": "array"})";

std::string having(const JsonObject& properties, const std::vector<std::string_view>& required = {}) {
  JsonObject schema;
  schema.say("type", "object").add("properties", properties.text());
  if (!required.empty()) schema.add("required", jsonWords(required));
  return schema.text();
}

/// The field that tells whether a record has the row.
std::string_view firstField(const Coordinate& row) {
  return row.form == CoordinateForm::numbers ? row.parts[0].name : row.name;
}

/// An object that has it; of a row that counts by the form of its value, in that form.
std::string has(const Coordinate& row) {
  const bool byForm = row.form != CoordinateForm::numbers && row.form != CoordinateForm::array;
  const std::string value = !byForm ? "true" : row.first == '[' ? kArray : kObject;
  return having(JsonObject().add(firstField(row), value), {firstField(row)});
}

std::string vector3() { return arraySchema(numberSchema(-INFINITY, INFINITY), 3, 3); }

/// What a record that has the row must be.
std::string valueOf(const Coordinate& row) {
  JsonObject properties;
  std::vector<std::string_view> required;
  const auto addPart = [&](const CoordinatePart& part) {
    properties.add(part.name, part.size > 1 ? vector3() : numberSchema(part.least, part.most));
  };
  switch (row.form) {
    case CoordinateForm::array:
      properties.add(row.name, reference(row.orNull ? "pixelOrNull" : row.kind == kindPoint ? "xyz" : "nonzero3"));
      required = {row.name};
      break;
    case CoordinateForm::numbers:
      for (std::size_t i = 0; i < row.parts.size(); ++i) {
        addPart(row.parts[i]);
        if (i < row.fewest) required.push_back(row.parts[i].name);
      }
      break;
    case CoordinateForm::points:
      properties.add(row.name, arraySchema(vector3(), row.fewest, row.fewest));
      break;
    case CoordinateForm::object:
      for (const CoordinatePart& part : row.parts) {
        addPart(part);
        required.push_back(part.name);
      }
      return having(JsonObject().add(row.name, having(properties, required)));
    case CoordinateForm::word:
      break;
  }
  return having(properties, required);
}

/// x, y, z, w that are not all 0.
std::string notAllZero(const Coordinate& row) {
  JsonObject zeros;
  for (const CoordinatePart& part : row.parts) zeros.add(part.name, R"({"const": 0})");
  return JsonObject().add("not", having(zeros, {row.parts.back().name})).text();
}

std::string both(const std::string& a, const std::string& b) {
  return JsonObject().add("allOf", jsonArray({a, b})).text();
}

/// The first of the rows that a record has decides; or else what else says.
template <class Then>
std::string firstOf(std::span<const Coordinate* const> rows, const Then& then, const std::string& otherwise) {
  if (rows.empty()) return otherwise;
  return JsonObject()
      .say("description", std::string(rows[0]->name) + ": " + std::string(rows[0]->help) + ".")
      .add("if", has(*rows[0]))
      .add("then", then(*rows[0]))
      .add("else", firstOf(rows.subspan(1), then, otherwise))
      .text();
}

std::string pointFields() {
  const std::span rows(coordinates::kPoints);
  const auto then = [](const Coordinate& row) {
    return row.form == CoordinateForm::numbers && row.most > row.fewest ? both(valueOf(row), notAllZero(row))
                                                                        : valueOf(row);
  };
  return firstOf(rows.first(rows.size() - 1), then, valueOf(*rows.back()));
}

/// A point that is no direction, and the radius of a sphere about it.
std::string finitePoint() {
  JsonObject never;
  for (const Coordinate* row : coordinates::kNotRead)
    never.add(row->name, JsonObject().add("not", row->first == '{' ? kObject : R"({"type": "string"})").text());
  const CoordinatePart& radius = coordinates::radius.parts[0];
  never.add(radius.name, numberSchema(radius.least, radius.most));
  const auto weighted = [](const Coordinate& row) -> std::string {
    if (row.kind != kindPoint) return "true";
    if (row.form == CoordinateForm::array) return having(JsonObject().add(row.name, reference("weighted")));
    return having(JsonObject().add("w", R"({"not": {"const": 0}})"));
  };
  const std::span rows(coordinates::kPoints);
  return JsonObject()
      .add("if", kObject)
      .add("then",
           both(having(never), both(reference("pointFields"), firstOf(rows.first(rows.size() - 1), weighted, "false"))))
      .add("else", both(reference("xyz"), reference("weighted")))
      .text();
}

std::string pixelFields() {
  JsonObject distances;
  for (const Coordinate* row : coordinates::kDistances) distances.add(row->name, R"({"type": ["number", "null"]})");
  const std::span rows(coordinates::kPixels);
  JsonObject z;
  z.add("z", "false");
  const std::string last = both(valueOf(*rows.back()), having(z));
  return both(having(distances), firstOf(rows.first(rows.size() - 1), valueOf, last));
}

/// An object as told, or an array.
std::string objectOr(const std::string& object, const std::string& array) {
  return JsonObject().add("if", kObject).add("then", object).add("else", array).text();
}

/// A record, an array of records or a document.
std::string arranged(std::string_view record) {
  return JsonObject()
      .add("if", reference("isDocument"))
      .add("then", documentSchema(record))
      .add("else", JsonObject()
                       .add("if", reference("isArrayOfRecords"))
                       .add("then", JsonObject().say("type", "array").add("items", reference(record)).text())
                       .add("else", reference(record))
                       .text())
      .text();
}

}  // namespace

std::string pointsSchema() {
  const std::string number = numberSchema(-INFINITY, INFINITY);
  JsonObject pixel;
  pixel.add(coordinates::pixel.name, R"({"anyOf": [{"$ref": "#/$defs/numbers2"}, {"type": "null"}]})");
  const auto segment = [&](const Coordinate& row) { return both(valueOf(row), having(pixel)); };
  const Coordinate* const segments[] = {&coordinates::segment};
  JsonObject definitions;
  definitions.add("points", arranged("pointRecord"))
      .add("shapes", arranged("shapeRecord"))
      .add("pixels", arranged("pixelRecord"))
      .add("isDocument", R"({"type": "object", "required": ["points"], "properties": {"points": {"type": "array"}}})")
      .add("isArrayOfRecords", R"({"description": "An array with a number in it is a record.", "type": "array", )"
                               R"("not": {"type": "array", "contains": {"type": "number"}}})")
      .add("numbers2", arraySchema(number, 2, 2))
      .add("xyz", both(arraySchema(number, 3, 4), R"({"not": {"const": [0, 0, 0, 0]}})"))
      .add("nonzero3", both(vector3(), R"({"type": "array", "contains": {"not": {"const": 0}}})"))
      .add("weighted", R"({"type": "array", "not": {"type": "array", )"
                       R"("prefixItems": [true, true, true, {"const": 0}], "minItems": 4, "maxItems": 4}})")
      .add("pixelOrNull", R"({"type": ["array", "null"], "items": {"type": "number"}, "minItems": 2, "maxItems": 2})")
      .add("pointRecord", objectOr(firstOf(segments, segment, reference("pointFields")), reference("xyz")))
      .add("pointFields", both(kObject, pointFields()))
      .add("shapeRecord", firstOf(coordinates::kShapes, valueOf, reference("finitePoint")))
      .add("finitePoint", finitePoint())
      .add("pixelRecord", objectOr(pixelFields(), reference("numbers2")));
  constexpr std::string_view kSays =
      "One JSON value of a stream of points, as project and measure read it: a record, an array of records, or a "
      "document "
      "{\"points\": [records], ...}. Of a sequence of values (NDJSON, jq) it describes each. #/$defs/shapes describes "
      "what "
      "cull reads, #/$defs/pixels what ray reads; draw reads points and shapes. Points are in the world's frame and "
      "unit, "
      "that of the camera; places (degrees on WGS84, metres above the ellipsoid) need a camera on the Earth, and three "
      "numbers without names one elsewhere. A field counts as a shape where its value has the form. Other fields of a "
      "record pass through, so names that results get are taken, unless --prefix names those otherwise. null is a "
      "value "
      "here and does not count as absent. What a schema cannot say and the reader still asks for: a document's first "
      "key "
      "is points; no coordinate of a box's max is below that of its min; a depth or viewDistance is in front of the "
      "eye; "
      "no number leaves the range of doubles, and no key is given twice.";
  JsonObject schema;
  schema.say("$schema", "https://json-schema.org/draft/2020-12/schema")
      .say("$id", "urn:viewproj:schema:points")
      .say("title", "Points for viewproj")
      .say("description", kSays)
      .add("$ref", "\"#/$defs/points\"")
      .add("$defs", definitions.lines());
  return schema.lines() + "\n";
}

}  // namespace viewproj::cmd
