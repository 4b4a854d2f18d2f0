// JSON text from values: all that the tool writes as JSON and that is no record of a stream.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

/// What is not UTF-8 is replaced.
std::string jsonOf(std::string_view text);
inline std::string jsonOf(const std::string& text) { return jsonOf(std::string_view(text)); }
inline std::string jsonOf(const char* text) { return jsonOf(std::string_view(text)); }
/// The shortest number that reads back as the same; null for what is not finite.
std::string jsonOf(double number);
std::string jsonOf(bool flag);
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
