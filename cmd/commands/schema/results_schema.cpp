// The schema of results, from their rows.
#include "commands/schema/json_schema.hpp"
#include "output/results.hpp"

namespace viewproj::cmd {
namespace {

std::vector<std::string> quotedWords(Words words) {
  std::vector<std::string> values;
  for (const std::string_view word : wordsOf(words)) values.push_back("\"" + std::string(word) + "\"");
  return values;
}

std::string enumeration(std::vector<std::string> values, bool orNull) {
  if (orNull) values.emplace_back("null");
  return JsonObject().add("enum", jsonArray(values)).text();
}

std::string schemaOf(const ResultRow& row);

/// An object of the parts and nothing else.
JsonObject objectOf(std::span<const ResultRow* const> parts) {
  JsonObject properties;
  std::vector<std::string_view> required;
  for (const ResultRow* part : parts) {
    properties.add(part->name, schemaOf(*part));
    if (part->given != Given::asked) required.push_back(part->name);
  }
  JsonObject schema;
  schema.say("type", "object")
      .add("properties", properties.text())
      .add("required", jsonWords(required))
      .add("additionalProperties", "false");
  // Those that are not always given come together.
  std::vector<std::string_view> asked;
  for (const ResultRow* part : parts)
    if (part->given == Given::asked) asked.push_back(part->name);
  if (asked.empty()) return schema;
  JsonObject together;
  for (const std::string_view name : asked) together.add(name, jsonWords(asked));
  schema.add("dependentRequired", together.text());
  return schema;
}

/// Of its value, null aside.
std::string valueOf(const ResultRow& row) {
  switch (row.kind) {
    case ResultKind::number:
      return numberSchema(row.least, row.most);
    case ResultKind::vector:
      return arraySchema(numberSchema(row.least, row.most), row.size, row.size);
    case ResultKind::flag:
      return JsonObject().say("type", "boolean").text();
    case ResultKind::names:
      return JsonObject()
          .say("type", "array")
          .add("uniqueItems", "true")
          .add("items", enumeration(quotedWords(row.words), false))
          .text();
    case ResultKind::word:
      return enumeration(quotedWords(row.words), row.canBeNull);
    case ResultKind::json:
      return JsonObject().add("anyOf", R"([{"type": "string"}, {"type": "number"}])").text();
    case ResultKind::group:
      return objectOf(row.parts).text();
    case ResultKind::list:
      return JsonObject().say("type", "array").add("items", objectOf(row.parts).text()).text();
  }
  return "true";
}

std::string schemaOf(const ResultRow& row) {
  JsonObject schema;
  const std::string unit(row.unit);
  schema.say("description", std::string(row.help) + (unit.empty() ? "" : "; " + unit));
  const bool isNull = row.canBeNull && row.kind != ResultKind::word;
  schema.add(isNull ? "anyOf" : "allOf",
             isNull ? jsonArray({valueOf(row), R"({"type": "null"})"}) : jsonArray({valueOf(row)}));
  return schema.text();
}

JsonObject propertiesOf(std::span<const ResultRow* const> rows) {
  JsonObject properties;
  std::string_view last;
  for (const ResultRow* row : rows)
    if (row->name != last) properties.add(last = row->name, schemaOf(*row));
  return properties;
}

std::string type(std::string_view name) { return JsonObject().say("type", name).text(); }
std::string constant(std::string_view value) { return JsonObject().add("const", std::string(value)).text(); }

/// An object whose fields are as given.
std::string having(const JsonObject& properties) {
  return JsonObject().say("type", "object").add("properties", properties.text()).text();
}

/// One whose field has this value.
std::string isThere(std::string_view name, std::string_view value) {
  return JsonObject()
      .say("type", "object")
      .add("required", jsonWords({name}))
      .add("properties", JsonObject().add(name, constant(value)).text())
      .text();
}

std::string projectedPoint() {
  Results rows;
  std::vector<std::string> any;
  for (const PointResult& result : pointResults()) {
    rows.push_back(&result.row);
    any.push_back(requiring({result.row.name}));
  }
  return JsonObject()
      .say("type", "object")
      .add("properties", propertiesOf(rows).text())
      .add("minProperties", "2")
      .add("anyOf", jsonArray(any))
      .add("if", isThere("visible", "true"))
      .add("then", having(JsonObject().add("screen", type("array")).add("outside", constant("[]"))))
      .text();
}

std::string projectedSegment() {
  JsonObject properties = propertiesOf(results::kSegment);
  properties.add("segment", arraySchema(reference("vector3"), 2, 2));
  std::vector<std::string_view> required = {"segment"};
  JsonObject there, none;
  for (const ResultRow* row : results::kSegment) {
    if (row->given != Given::asked) required.push_back(row->name);
    if (row->kind != ResultKind::group) continue;
    if (row->given != Given::asked) there.add(row->name, type("object"));
    none.add(row->name, type("null"));
  }
  return JsonObject()
      .say("description", "The ends of what is visible of it, null where nothing is.")
      .say("type", "object")
      .add("properties", properties.text())
      .add("required", jsonWords(required))
      .add("if", isThere("visible", "true"))
      .add("then", having(there))
      .add("else", having(none))
      .text();
}

/// A record with these results.
JsonObject recordOf(std::span<const ResultRow* const> rows) {
  std::vector<std::string_view> required;
  for (const ResultRow* row : rows)
    if (row->given != Given::asked) required.push_back(row->name);
  JsonObject schema;
  schema.say("type", "object").add("properties", propertiesOf(rows).text()).add("required", jsonWords(required));
  return schema;
}

std::string culled() {
  JsonObject side;
  side.add("plane", enumeration(quotedWords(Words::sides), false));
  return recordOf(results::kCull)
      .add("if", isThere("cull", "\"inside\""))
      .add("then", having(JsonObject().add("plane", type("null"))))
      .add("else", having(side))
      .text();
}

std::string anyOf(const std::vector<std::string_view>& names) {
  std::vector<std::string> parts;
  for (const std::string_view name : names) parts.push_back(reference(name));
  return JsonObject().add("anyOf", jsonArray(parts)).text();
}

/// What a filter prints: a record, an array of some, a document.
std::string printed(std::string_view record) {
  return JsonObject()
      .add("anyOf",
           jsonArray({reference(record), JsonObject().say("type", "array").add("items", reference(record)).text(),
                      documentSchema(record)}))
      .text();
}

}  // namespace

std::string resultsSchema(std::string_view reports) {
  JsonObject definitions;
  definitions.add("project", printed("projectedRecord"))
      .add("projectedRecord", anyOf({"projectedPoint", "projectedSegment", "errorRecord"}))
      .add("projectedPoint", projectedPoint())
      .add("projectedSegment", projectedSegment())
      .add("ray", printed("castRecord"))
      .add("castRecord", anyOf({"cast", "errorRecord"}))
      .add("cast", recordOf(results::kRay).text())
      .add("cull", printed("culledRecord"))
      .add("culledRecord", anyOf({"culled", "errorRecord"}))
      .add("culled", culled());
  // The reports' own definitions, without the brackets around them.
  const std::size_t from = reports.find('{') + 1, to = reports.rfind('}');
  std::string all = definitions.lines();
  all = all.substr(0, all.rfind('\n')) + "," + std::string(reports.substr(from, to - from)) + "  }";
  constexpr std::string_view kSays =
      "One JSON value of what a command prints in JSON. Of lines (NDJSON) it describes each. #/$defs/NAME describes "
      "what "
      "the command NAME alone prints: project, ray, cull, planes (cull --planes), matrix, explain, inspect, depth, "
      "measure. Screen positions are pixels as the viewport counts them, depth is window depth, distances and points "
      "are "
      "in the world's unit and frame, angles in degrees unless named radians. What has no value is null. Records keep "
      "the fields they came with in front of the results; those whose names --prefix changes, and fields of a result's "
      "name that --fields leaves out, are not described.";
  JsonObject schema;
  schema.say("$schema", "https://json-schema.org/draft/2020-12/schema")
      .say("$id", "urn:viewproj:schema:results")
      .say("title", "Results of viewproj in JSON")
      .say("description", kSays)
      .add("anyOf", jsonArray({reference("project"), reference("ray"), reference("cull"), reference("planes"),
                               reference("matrix"), reference("explain"), reference("inspect"), reference("depth"),
                               reference("measure")}))
      .add("$defs", all);
  return schema.lines() + "\n";
}

}  // namespace viewproj::cmd
