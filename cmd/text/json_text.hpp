// JSON as text: where things stand in it, and its parts byte for byte. nlohmann-json judges what is valid.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// Counted from 1; columns in bytes.
struct TextPosition {
  std::size_t line = 1, column = 1;
};

/// Where the byte at offset stands in text, if text begins at start.
TextPosition positionAt(std::string_view text, std::size_t offset, TextPosition start = {});

/// "FILE:LINE:COLUMN".
std::string place(std::string_view file, TextPosition position);

struct JsonFault {
  std::size_t offset;
  std::string message;
};

/// Nothing if text is one valid JSON value, as nlohmann-json judges it; but a NUL, which it takes for the end of the
/// text, is a fault like other characters.
std::optional<JsonFault> jsonFault(std::string_view text);
bool isJson(std::string_view text);

/// How deep a value may be nested: what reads it calls itself for each level.
inline constexpr std::size_t kDeepestJson = 200;

/// Reads the value of a text, unless the text is nested too deep or has another fault, or an object of it has a key
/// twice: that is returned.
std::optional<JsonFault> parseJson(std::string_view text, nlohmann::json& value);

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

  /// As next() in two steps, for one who may look into the value instead of passing it: the next part, whose value
  /// still ends where the text does; then past it, where its value gets its end.
  std::optional<Part> begin();
  void pass(Part& part);

 private:
  std::string_view text_;
  bool isObject_;
  std::size_t at_;
};

/// The offset after the JSON value that starts at `at`. The text must be valid JSON.
std::size_t endOfValue(std::string_view text, std::size_t at);

/// A key or string as written (without quotes) with its escapes resolved.
std::string unescaped(std::string_view raw);

/// The offset of the value at a path of keys and array indices, or of the innermost part of the path that exists.
std::size_t locate(std::string_view text, std::span<const std::string> path);

}  // namespace viewproj::cmd
