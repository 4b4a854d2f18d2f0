// JSON as text: parsing values, splitting them without change, and writing them.
#pragma once

#include <concepts>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/error.hpp"
#include "text/json_scan.hpp"

namespace viewproj::cmd {

/// Parses a text. Returns what is wrong: invalid JSON, too deep nesting, or an object that has a key twice.
std::optional<JsonFault> parseJson(std::string_view text, nlohmann::json& value);

/// A JSON number as an integer if 64 bits hold it, otherwise as the nearest double.
nlohmann::json numberOfJson(std::string_view text);

/// Replaces // and /* */ comments by blanks, so that all else keeps its place. A comment that does not end stays.
void blankComments(std::string& text);

/// The parts of an array or object, one after the other. The text must be valid JSON.
class JsonParts {
 public:
  /// text: an array or an object, from its opening bracket on.
  explicit JsonParts(std::string_view text) : text_(text), isObject_(text.starts_with('{')), at_(1) {}

  struct Part {
    std::string_view key;    ///< without its quotes, escapes as written; empty in an array
    std::string_view value;  ///< as written
    std::size_t offset;      ///< of the value, or of the key in an object, from the start of the text
  };

  /// The next part, or nothing at the end.
  std::optional<Part> next();

 private:
  std::string_view text_;
  bool isObject_;
  std::size_t at_;
};

/// The offset after the JSON value that starts at `at`. Does not check whether the value is valid.
std::size_t endOfValue(std::string_view text, std::size_t at);

/// A key or string as written (without quotes), with its escapes resolved.
std::string unescaped(std::string_view raw);

/// A JSON string. Bytes that are not UTF-8 are replaced.
std::string jsonOf(std::string_view text);
inline std::string jsonOf(const std::string& text) { return jsonOf(std::string_view(text)); }
inline std::string jsonOf(const char* text) { return jsonOf(std::string_view(text)); }
/// The shortest number that reads back as the same; null for infinity and NaN.
std::string jsonOf(double number);
inline std::string jsonOf(bool flag) { return flag ? "true" : "false"; }
template <std::unsigned_integral Integer>
std::string jsonOf(Integer number) {
  return std::to_string(number);
}
template <class T>
std::string jsonOf(const std::optional<T>& value) {
  return value ? jsonOf(*value) : "null";
}

/// [a, b] of JSON texts. between: the text between two items. If it breaks the line, so does the text before the first.
std::string jsonList(const std::vector<std::string>& items, std::string_view between = ", ");

/// [a, b] of values.
template <class Values>
std::string jsonListOf(const Values& values) {
  std::vector<std::string> items;
  for (const auto& value : values) items.push_back(jsonOf(value));
  return jsonList(items);
}

/// {"name": value, ...} in the order of the calls.
class JsonObject {
 public:
  template <class T>
  JsonObject& add(std::string_view name, const T& value) {
    return addText(name, jsonOf(value));
  }
  /// json: a value. between: the text between it and the previous member.
  JsonObject& addText(std::string_view name, std::string_view json, std::string_view between = ", ");
  /// Appends the members of another object; an empty text appends nothing.
  JsonObject& addMembers(std::string_view members, std::string_view between = ", ");
  const std::string& members() const { return members_; }
  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

}  // namespace viewproj::cmd
