// The only scanner of JSON: it passes valid JSON at the speed of a stream and describes errors in other text. Each pass
// function returns the end of the value that begins at `at`, or null if it is not valid JSON.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

inline bool isJsonSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
inline bool opensJson(char c) { return c == '{' || c == '['; }

inline const char* passJsonSpace(const char* at, const char* end) {
  while (at < end && isJsonSpace(*at)) ++at;
  return at;
}

/// The offset of the first character at or after `at` that is not white space, or the text's size.
inline std::size_t afterJsonSpace(std::string_view text, std::size_t at) {
  if (at >= text.size()) return text.size();
  return static_cast<std::size_t>(passJsonSpace(text.data() + at, text.data() + text.size()) - text.data());
}

const char* passJsonString(const char* at, const char* end);
/// Passes true or false.
const char* passJsonFlag(const char* at, const char* end);
/// Passes any value except an array or object.
const char* passJsonScalar(const char* at, const char* end);

/// Where a scan stopped, and what it expected there.
struct JsonStop {
  const char* at = nullptr;
  const char* expected = "";
};

/// The events of a scan. A base for classes that use some of them.
struct JsonEvents {
  void open(const char*) {}         ///< an array or object begins at this bracket
  void close(const char*) {}        ///< an array or object ended before this byte
  void name(std::string_view) {}    ///< the key of a member, as written, with its quotes
  void scalar(std::string_view) {}  ///< any other value, as written
};

/// How deep a value may be nested.
inline constexpr std::size_t kDeepestJson = 200;
/// What a scan expects where a value is nested deeper than it may be.
inline constexpr const char* kLessNesting = "less nesting";

/// Passes any value. depth: how many arrays and objects may be nested.
template <class Events>
const char* scanJson(const char* at, const char* end, std::size_t depth, Events& events, JsonStop* stop = nullptr) {
  std::string closing;  // the brackets that will close the open ones
  const char* value = "a value";
  const auto fail = [&](const char* expected) -> const char* {
    if (stop) *stop = {at, expected};
    return nullptr;
  };
  for (;;) {
    bool isBegun = false;  // whether an array or object has begun and has a value
    if (at < end && opensJson(*at)) {
      if (closing.size() == depth) return fail(kLessNesting);
      events.open(at);
      closing += *at == '{' ? '}' : ']';
      at = passJsonSpace(at + 1, end);
      isBegun = at == end || *at != closing.back();
    } else {
      const char* const after = passJsonScalar(at, end);
      if (!after) return fail(value);
      events.scalar({at, after});
      at = after;
    }
    if (!isBegun) {
      for (; !closing.empty(); closing.pop_back()) {
        at = passJsonSpace(at, end);
        if (at == end || *at != closing.back()) break;
        events.close(++at);
      }
      if (closing.empty()) return at;
      if (at == end || *at != ',') return fail(closing.back() == '}' ? ", or }" : ", or ]");
      at = passJsonSpace(at + 1, end);
    }
    const bool isObject = closing.back() == '}';
    value = isBegun || isObject ? "a value" : "a value after the comma";
    if (!isObject) continue;
    const char* const after = passJsonString(at, end);
    if (!after) return fail(isBegun ? "a key in double quotes" : "a key in double quotes after the comma");
    events.name({at, after});
    at = passJsonSpace(after, end);
    if (at == end || *at != ':') return fail(":");
    at = passJsonSpace(at + 1, end);
  }
}

/// Passes any value.
const char* passJson(const char* at, const char* end, std::size_t depth);

/// What is wrong with a text, and where.
struct JsonFault {
  std::size_t offset;
  std::string message;
};

/// Nothing if text is one valid JSON value, as nlohmann-json defines it. One difference: a NUL (which ends the text
/// there), a byte order mark and nests deeper than kDeepestJson are errors here.
std::optional<JsonFault> jsonFault(std::string_view text);

/// Describes the error where a scan stopped.
JsonFault faultOf(std::string_view text, const JsonStop& stop);

/// Like jsonFault, and reports the events of the scan.
template <class Events>
std::optional<JsonFault> scanWhole(std::string_view text, Events& events) {
  const char* const end = text.data() + text.size();
  JsonStop stop;
  const char* after = scanJson(passJsonSpace(text.data(), end), end, kDeepestJson, events, &stop);
  if (!after) return faultOf(text, stop);
  after = passJsonSpace(after, end);
  return after == end ? std::nullopt : std::optional(faultOf(text, {after, "the end"}));
}

}  // namespace viewproj::cmd
