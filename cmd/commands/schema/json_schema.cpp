#include "commands/schema/json_schema.hpp"

#include <cmath>

#include "text/format_number.hpp"

namespace viewproj::cmd {
namespace {

/// Texts of ours have quotes, and nothing else to escape.
std::string quotedJson(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string joinedBy(const std::vector<std::string>& values, std::string_view separator) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : std::string(separator)) + value;
  return text;
}

}  // namespace

JsonObject& JsonObject::add(std::string_view name, const std::string& value) {
  const std::string member = quotedJson(name) + ": " + value;
  members_ += (members_.empty() ? "" : ", ") + member;
  lines_ += (lines_.empty() ? "" : ",\n") + std::string("  ") + member;
  return *this;
}

JsonObject& JsonObject::say(std::string_view name, std::string_view text) { return add(name, quotedJson(text)); }

std::string JsonObject::lines() const { return "{\n" + lines_ + "\n}"; }

std::string jsonArray(const std::vector<std::string>& values) { return "[" + joinedBy(values, ", ") + "]"; }

std::string jsonWords(const std::vector<std::string_view>& words) {
  std::vector<std::string> values;
  for (const std::string_view word : words) values.push_back(quotedJson(word));
  return jsonArray(values);
}

std::string reference(std::string_view name) { return JsonObject().say("$ref", "#/$defs/" + std::string(name)).text(); }

std::string numberSchema(double least, double most) {
  JsonObject schema;
  schema.say("type", "number");
  if (std::isfinite(least)) schema.add("minimum", formatNumber(least));
  if (std::isfinite(most)) schema.add("maximum", formatNumber(most));
  return schema.text();
}

std::string arraySchema(const std::string& items, std::size_t fewest, std::size_t most) {
  return JsonObject()
      .say("type", "array")
      .add("items", items)
      .add("minItems", std::to_string(fewest))
      .add("maxItems", std::to_string(most))
      .text();
}

std::string requiring(const std::vector<std::string_view>& names) {
  JsonObject properties;
  for (const std::string_view name : names) properties.add(name, "true");
  return JsonObject()
      .say("type", "object")
      .add("required", jsonWords(names))
      .add("properties", properties.text())
      .text();
}

std::string documentSchema(std::string_view record) {
  const std::string records = JsonObject().say("type", "array").add("items", reference(record)).text();
  return JsonObject()
      .say("type", "object")
      .add("required", jsonWords({"points"}))
      .add("properties", JsonObject().add("points", records).text())
      .text();
}

}  // namespace viewproj::cmd
