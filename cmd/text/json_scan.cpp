#include "text/json_scan.hpp"

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The code unit of the four hexadecimal digits at `at`, or -1.
int codeUnit(const char* at, const char* end) {
  if (end - at < 4) return -1;
  int unit = 0;
  for (int i = 0; i < 4; ++i) {
    const char c = at[i], letter = static_cast<char>(c | 0x20);
    const int digit = isDigit(c) ? c - '0' : letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
    if (digit < 0) return -1;
    unit = 16 * unit + digit;
  }
  return unit;
}

/// Passes an escape after its backslash. The first half of a UTF-16 pair needs its second half.
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

/// Like passJsonNumber, but only without an exponent and with few digits, so always finite; null for other numbers.
const char* passShortNumber(const char* at, const char* end) {
  constexpr std::ptrdiff_t kShort = 300;
  if (end - at > kShort) end = at + kShort;
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
  return after ? after : passJsonNumber(at, end, unused);
}

/// What is wrong with a string that begins at `begin` and is not valid.
JsonFault faultOfString(std::string_view text, std::size_t begin) {
  const char* const end = text.data() + text.size();
  std::size_t at = begin + 1;
  for (; at < text.size() && text[at] != '"'; ++at) {
    const std::string_view rest = text.substr(at);
    if (static_cast<unsigned char>(text[at]) < ' ')
      return {at,
              "not valid JSON: a string has " + visible(rest.substr(0, 1)) + ", which JSON writes with a backslash"};
    if (text[at] != '\\') continue;
    const char* const after = passEscape(text.data() + at + 1, end);
    if (!after) return {at, "not valid JSON: a string has a backslash that begins no escape"};
    at = static_cast<std::size_t>(after - text.data()) - 1;
  }
  const bool isClosed = text.find('"', at) != std::string_view::npos;
  return {begin, std::string("not valid JSON: a string is not ") + (isClosed ? "UTF-8" : "closed")};
}

bool isWordCharacter(char c) { return isDigit(c) || isLetter(c) || c == '-' || c == '+' || c == '.' || c == '_'; }

/// A number or a word, valid or not, or else one character.
std::string_view tokenAt(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && isWordCharacter(text[end])) ++end;
  if (end == begin) (void)nextCharacter(text, end);
  return text.substr(begin, end - begin);
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

const char* passJsonScalar(const char* at, const char* end) {
  switch (at < end ? *at : '\0') {
    case '"':
      return passJsonString(at, end);
    case 'n':
      return passWord(at, end, "null");
    case 't':
    case 'f':
      return passJsonFlag(at, end);
    default:
      return passNumber(at, end);
  }
}

const char* passJson(const char* at, const char* end, std::size_t depth) {
  if (at < end && !opensJson(*at)) return passJsonScalar(at, end);
  JsonEvents none;
  return scanJson(at, end, depth, none);
}

JsonFault faultOf(std::string_view text, const JsonStop& stop) {
  const auto at = static_cast<std::size_t>(stop.at - text.data());
  const std::string_view expected = stop.expected;
  const auto fault = [&](const std::string& got) {
    return JsonFault{at, "not valid JSON: expected " + std::string(expected) + got};
  };
  if (at == text.size()) return fault(", got the end");
  if (expected == kLessNesting) return {at, "nested deeper than " + std::to_string(kDeepestJson)};
  const bool isValue = expected.starts_with("a value");
  if (text[at] == '"' && (isValue || expected.starts_with("a key"))) return faultOfString(text, at);
  if (text[at] == '\'' && isValue) return fault(", got '; texts need double quotes");
  const std::string_view token = tokenAt(text, at);
  if (!isValue || !isWordCharacter(token[0])) return fault(", got " + visible(token));
  if (isLargerThanDoubles(token)) return {at, inQuotes(token) + " is larger than any double"};
  return fault("; JSON has no " + std::string(token.substr(0, 40)));
}

std::optional<JsonFault> jsonFault(std::string_view text) {
  JsonEvents none;
  return scanWhole(text, none);
}

}  // namespace viewproj::cmd
