// Valid JSON from its first byte to its last, at the speed of a stream. Each function returns where what it is called
// for ends that begins at `at`, or null where that is not valid JSON: what these accept nlohmann-json accepts.
#pragma once

#include <algorithm>
#include <cstddef>
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
  while (at < text.size() && isJsonSpace(text[at])) ++at;
  return std::min(at, text.size());
}

const char* passJsonString(const char* at, const char* end);
/// true or false.
const char* passJsonFlag(const char* at, const char* end);
/// Any value. Null too where arrays and objects are deeper within each other than this.
const char* passJson(const char* at, const char* end, int depth);

/// An array or object, which begins here; depth is of its values. take: called with each name, quotes and all, or in an
/// array an empty one, and with each value.
template <class Take>
const char* passJsonItems(const char* at, const char* end, int depth, const Take& take) {
  const bool isObject = *at == '{';
  const char close = isObject ? '}' : ']';
  at = passJsonSpace(at + 1, end);
  if (at < end && *at == close) return at + 1;
  for (;;) {
    std::string_view name;
    if (isObject) {
      const char* const begin = at;
      if (!(at = passJsonString(at, end))) return nullptr;
      name = {begin, at};
      at = passJsonSpace(at, end);
      if (at == end || *at != ':') return nullptr;
      at = passJsonSpace(at + 1, end);
    }
    const char* const begin = at;
    if (!(at = passJson(at, end, depth))) return nullptr;
    take(name, std::string_view(begin, at));
    at = passJsonSpace(at, end);
    if (at == end) return nullptr;
    if (*at == close) return at + 1;
    if (*at != ',') return nullptr;
    at = passJsonSpace(at + 1, end);
  }
}

}  // namespace viewproj::cmd
