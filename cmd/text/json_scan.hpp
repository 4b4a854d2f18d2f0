// Valid JSON from its first byte to its last, at the speed of a stream. Each function returns where what it is called
// for ends that begins at `at`, or null where that is not valid JSON: what these accept nlohmann-json accepts.
#pragma once

namespace viewproj::cmd {

inline bool isJsonSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

inline const char* passJsonSpace(const char* at, const char* end) {
  while (at < end && isJsonSpace(*at)) ++at;
  return at;
}

const char* passJsonString(const char* at, const char* end);
/// true or false.
const char* passJsonFlag(const char* at, const char* end);
/// Any value. Null too where arrays and objects are deeper within each other than this.
const char* passJson(const char* at, const char* end, int depth);

}  // namespace viewproj::cmd
