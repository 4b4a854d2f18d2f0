#include "text/json_scan.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

bool isHexDigit(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

/// The code unit of four digits that stand here, or -1.
int codeUnit(const char* at, const char* end) {
  if (end - at < 4 || !std::all_of(at, at + 4, isHexDigit)) return -1;
  int unit = 0;
  for (int i = 0; i < 4; ++i) unit = 16 * unit + (at[i] <= '9' ? at[i] - '0' : (at[i] | 0x20) - 'a' + 10);
  return unit;
}

/// After its backslash; the first half of a character with the other half.
const char* passEscape(const char* at, const char* end) {
  if (at == end) return nullptr;
  if (*at != 'u') return std::string_view("\"\\/bfnrt").find(*at) == std::string_view::npos ? nullptr : at + 1;
  const int unit = codeUnit(++at, end);
  if (unit < 0 || (unit >= 0xdc00 && unit <= 0xdfff)) return nullptr;
  at += 4;
  if (unit < 0xd800 || unit > 0xdbff) return at;
  if (end - at < 2 || at[0] != '\\' || at[1] != 'u') return nullptr;
  const int second = codeUnit(at + 2, end);
  return second >= 0xdc00 && second <= 0xdfff ? at + 6 : nullptr;
}

const char* passWord(const char* at, const char* end, std::string_view word) {
  return std::string_view(at, end).starts_with(word) ? at + word.size() : nullptr;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// As readJsonNumber, of what is finite for having no exponent and few digits; null for others.
const char* passShortNumber(const char* at, const char* end) {
  constexpr std::ptrdiff_t kMostDigits = 300;
  if (end - at > kMostDigits) end = at + kMostDigits;
  const auto passDigits = [&] {
    const char* const first = at;
    while (at < end && isDigit(*at)) ++at;
    return at != first;
  };
  if (at < end && *at == '-') ++at;
  const bool isZero = at < end && *at == '0';
  const char* const first = at;
  if (!passDigits() || (isZero && at - first > 1)) return nullptr;
  if (at < end && *at == '.' && (++at, !passDigits())) return nullptr;
  return at == end || (*at | 0x20) == 'e' ? nullptr : at;
}

const char* passNumber(const char* at, const char* end) {
  double unused = 0;
  const char* const after = passShortNumber(at, end);
  return after ? after : readJsonNumber(at, end, unused);
}

}  // namespace

const char* passJsonString(const char* at, const char* end) {
  if (at == end || *at != '"') return nullptr;
  const char* const begin = ++at;
  bool isAscii = true;
  while (at < end && *at != '"') {
    const auto byte = static_cast<unsigned char>(*at++);
    if (byte < ' ') return nullptr;
    if (byte == '\\' && !(at = passEscape(at, end))) return nullptr;
    isAscii = isAscii && byte < 0x80;
  }
  if (at == end || (!isAscii && !isUtf8({begin, at}))) return nullptr;
  return at + 1;
}

const char* passJsonFlag(const char* at, const char* end) {
  const char* const after = passWord(at, end, "true");
  return after ? after : passWord(at, end, "false");
}

const char* passJson(const char* at, const char* end, int depth) {
  switch (at < end ? *at : '\0') {
    case '"':
      return passJsonString(at, end);
    case '[':
    case '{':
      return depth > 0 ? passJsonItems(at, end, depth - 1, [](std::string_view, std::string_view) {}) : nullptr;
    case 'n':
      return passWord(at, end, "null");
    case 't':
    case 'f':
      return passJsonFlag(at, end);
    default:
      return passNumber(at, end);
  }
}

}  // namespace viewproj::cmd
