// The one scanner of JSON: valid JSON from its first byte to its last at the speed of a stream, and what is wrong with
// other text. Each pass function returns the end of what begins at `at`, or null where that is not valid JSON.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

inline bool isJsonSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
inline bool beginsJsonNumber(char c) { return c == '-' || (c >= '0' && c <= '9'); }
inline bool opensJson(char c) { return c == '{' || c == '['; }

inline const char* passJsonSpace(const char* at, const char* end) {
  while (at < end && isJsonSpace(*at)) ++at;
  return at;
}

/// The offset of what is no space at `at` or after it, or the text's size.
inline std::size_t afterJsonSpace(std::string_view text, std::size_t at) {
  if (at >= text.size()) return text.size();
  return static_cast<std::size_t>(passJsonSpace(text.data() + at, text.data() + text.size()) - text.data());
}

const char* passJsonString(const char* at, const char* end);
/// true or false.
const char* passJsonFlag(const char* at, const char* end);
/// Any value but an array or object.
const char* passJsonScalar(const char* at, const char* end);

/// Where a scan stopped, and what was expected there.
struct JsonStop {
  const char* at = nullptr;
  const char* expected = "";
};

/// What a scan reports as it passes it; a base for those who need a part of it.
struct JsonEvents {
  void open(const char*) {}         ///< an array or object, at its bracket
  void close(const char*) {}        ///< it ends before this
  void name(std::string_view) {}    ///< of an object's member, as written, with its quotes
  void scalar(std::string_view) {}  ///< any other value, as written
};

inline constexpr std::size_t kAnyDepth = ~std::size_t{0};

/// Any value. depth: so many arrays and objects may be within each other.
template <class Events>
const char* scanJson(const char* at, const char* end, std::size_t depth, Events& events, JsonStop* stop = nullptr) {
  std::string closing;  // the brackets that close what is open
  const char* value = "a value";
  const auto fail = [&](const char* expected) -> const char* {
    if (stop) *stop = {at, expected};
    return nullptr;
  };
  for (;;) {
    bool isBegun = false;  // an array or object that has a value
    if (at < end && opensJson(*at)) {
      if (closing.size() == depth) return fail("nothing so deep");
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

/// Any value.
const char* passJson(const char* at, const char* end, std::size_t depth);

/// What is wrong with a text, and where.
struct JsonFault {
  std::size_t offset;
  std::string message;
};

/// Nothing if text is one valid JSON value, as nlohmann-json judges it; but a NUL, which it takes for the end of the
/// text, is a fault like other characters, and so is a byte order mark.
std::optional<JsonFault> jsonFault(std::string_view text);

/// What a scan that stopped says of its text.
JsonFault faultOf(std::string_view text, const JsonStop& stop);

/// As jsonFault, with the events of the scan.
template <class Events>
std::optional<JsonFault> scanWhole(std::string_view text, Events& events) {
  const char* const end = text.data() + text.size();
  JsonStop stop;
  const char* after = scanJson(passJsonSpace(text.data(), end), end, kAnyDepth, events, &stop);
  if (!after) return faultOf(text, stop);
  after = passJsonSpace(after, end);
  return after == end ? std::nullopt : std::optional(faultOf(text, {after, "the end"}));
}

}  // namespace viewproj::cmd
