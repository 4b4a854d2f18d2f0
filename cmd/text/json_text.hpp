// JSON as text: values from it, its parts byte for byte, and text from values.
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

/// How deep a value that is read may be nested.
inline constexpr std::size_t kDeepestJson = 200;

/// Reads the value of a text, unless the text is nested too deep or has another fault, or an object of it has a key
/// twice: that is returned.
std::optional<JsonFault> parseJson(std::string_view text, nlohmann::json& value);

/// A number as JSON writes it: an integer where 64 bits hold it, otherwise the nearest double.
nlohmann::json numberOfJson(std::string_view text);

/// Blanks in place of // and /* */ comments, so that all else stays where it is. One that does not end stays.
void blankComments(std::string& text);

/// The parts of an array or object, one after the other. The text must be valid JSON.
class JsonParts {
 public:
  /// text: an array or an object, from its opening bracket on.
  explicit JsonParts(std::string_view text) : text_(text), isObject_(text.starts_with('{')), at_(1) {}

  struct Part {
    std::string_view key;    ///< without its quotes, escapes as written; empty in an array
    std::string_view value;  ///< as written
    std::size_t offset;      ///< of the value, or in an object of the key, from the start of the text
  };

  /// The next part, or nothing at the end.
  std::optional<Part> next();

 private:
  std::string_view text_;
  bool isObject_;
  std::size_t at_;
};

/// The offset after the JSON value that starts at `at`, whether or not it is valid within.
std::size_t endOfValue(std::string_view text, std::size_t at);

/// A key or string as written (without quotes) with its escapes resolved.
std::string unescaped(std::string_view raw);

/// What is not UTF-8 is replaced.
std::string jsonOf(std::string_view text);
inline std::string jsonOf(const std::string& text) { return jsonOf(std::string_view(text)); }
inline std::string jsonOf(const char* text) { return jsonOf(std::string_view(text)); }
/// The shortest number that reads back as the same; null for what is not finite.
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

/// [a, b] of JSON texts. between: what stands between two; where that breaks the line, so does what stands before the
/// first.
std::string jsonList(const std::vector<std::string>& items, std::string_view between = ", ");

/// [a, b] of values.
template <class Values>
std::string jsonListOf(const Values& values) {
  std::vector<std::string> items;
  for (const auto& value : values) items.push_back(jsonOf(value));
  return jsonList(items);
}

/// {"name": value, ...} in the order in which they are added.
class JsonObject {
 public:
  template <class T>
  JsonObject& add(std::string_view name, const T& value) {
    return addText(name, jsonOf(value));
  }
  /// json: a value. between: what stands between it and the one before.
  JsonObject& addText(std::string_view name, std::string_view json, std::string_view between = ", ");
  /// Of another object; none is nothing.
  JsonObject& addMembers(std::string_view members, std::string_view between = ", ");
  const std::string& members() const { return members_; }
  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

}  // namespace viewproj::cmd
