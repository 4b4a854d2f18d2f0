// A paste as plain text: what looks alike is one character, and what belongs to a page or a log is blanks.
#include <algorithm>
#include <regex>

#include "text/pasted_parts.hpp"

namespace viewproj::cmd::pasted {
namespace {

constexpr std::string_view kDigits = "0123456789";

std::size_t afterDigits(std::string_view t, std::size_t at) {
  return std::min(t.find_first_not_of(kDigits, at), t.size());
}

/// A character beyond ASCII as plain text; empty: it stays.
std::string_view plain(char32_t c) {
  const bool decorates = c == 0xA0 || c == 0x200B || c == 0x25B8 || c == 0x25BF || (c >= 0x2190 && c <= 0x21FF) ||
                         (c >= 0x239B && c <= 0x23AE) || (c >= 0x2500 && c <= 0x257F);
  const bool elides = c == 0x2026 || (c >= 0x22EE && c <= 0x22F1);
  return decorates     ? " "
         : elides      ? "..."
         : c == 0x2212 ? "-"
         : c == 0x221E ? "inf"
         : c == 0xFF1A ? ":"
         : c == 0xFF0C ? ","
         : c == 0xFEFF ? " "
                       : "";
}

/// LaTeX's 1.2\times10^{3} and Mathematica's 1.2*^3 as 1.2e3.
std::string withExponents(const std::string& t) {
  if (t.find("*^") != kNone) {
    static const std::regex starred(R"(([\d.])\*\^([-+]?\d{1,3}))");
    return std::regex_replace(t, starred, "$1e$2");
  }
  if (t.find("10^") == kNone) return t;
  static const std::regex power(R"( ?\\(?:times|cdot) ?10\^\{?([-+]?\d{1,3})\}?)");
  return std::regex_replace(t, power, "e$1");
}

/// The escapes \n, \t and \r of quoted strings are blanks.
std::string withPlainCharacters(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = at;
    if (text[at] == '\r') {
      out += '\n';
      at += text.substr(at, 2) == "\r\n" ? 2 : 1;
    } else if (text[at] == '\\') {
      at = std::min(text.find_first_not_of('\\', at), text.size());
      const bool isEscape =
          at < text.size() && isAmong(text[at], "ntr") && !(at + 1 < text.size() && isLetter(text[at + 1]));
      out += isEscape ? " " : text.substr(start, at - start);
      at += isEscape ? 1 : 0;
    } else {
      const std::string_view other = plain(nextCharacter(text, at));
      out += other.empty() ? text.substr(start, at - start) : other;
    }
  }
  return out;
}

void blank(std::string& t, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i)
    if (t[i] != '\n') t[i] = ' ';
}

/// **1.0**, _1.0_ and **r0**: the marks become blanks.
void blankEmphasis(std::string& t) {
  for (std::size_t at = 0; at < t.size(); ++at) {
    if (!isAmong(t[at], "*_")) continue;
    const std::size_t first = at;
    at = std::min(t.find_first_not_of("*_", at), t.size());
    const std::string_view marks = std::string_view(t).substr(first, at - first);
    std::size_t inner = numberEnd(t, at);
    if (inner == kNone && marks == "**")
      for (inner = at; inner < t.size() && (isLetter(t[inner]) || isDigit(t[inner]));) ++inner;
    const bool isFree = first == 0 || !(isNamePart(t[first - 1]) || isAmong(t[first - 1], ")]"));
    if (inner == kNone || inner == at || marks.size() > 3 || !isFree) continue;
    const std::string_view behind = std::string_view(t).substr(inner, marks.size());
    const std::size_t after = inner + marks.size();
    if (!std::equal(marks.begin(), marks.end(), behind.rbegin(), behind.rend())) continue;
    if (after < t.size() && (isNamePart(t[after]) || isAmong(t[after], "*(["))) continue;
    blank(t, first, at);
    blank(t, inner, after);
    at = inner;
  }
}

/// In a paragraph where every comma stands between two digits, once in a number, no number has a point, and one has a
/// single digit in front and five or more behind (pairs of pixels have not), commas are decimal.
void pointDecimalCommas(std::string& t) {
  for (std::size_t begin = 0, end = 0; begin < t.size(); begin = end + 2) {
    end = std::min(t.find("\n\n", begin), t.size());
    std::vector<std::size_t> commas;
    bool areDecimal = true, isOneLong = false;
    for (std::size_t at = begin; at < end && areDecimal; ++at) {
      const bool isInside = at > begin && at + 1 < end && isDigit(t[at - 1]) && isDigit(t[at + 1]);
      if (t[at] == '.' && isInside) areDecimal = false;
      if (t[at] != ',') continue;
      const std::size_t after = afterDigits(t, at + 1);
      const bool isOneDigit = isInside && (at < begin + 2 || !isDigit(t[at - 2]));
      const bool endsHere = after >= end || !(isNamePart(t[after]) || isAmong(t[after], ".,")) ||
                            (isAmong(t[after], "eEf") && (after + 1 >= end || !isLetter(t[after + 1])));
      areDecimal = isInside && endsHere;
      isOneLong = isOneLong || (isOneDigit && after > at + 5);
      commas.push_back(at);
    }
    if (areDecimal && isOneLong && commas.size() >= 3)
      for (const std::size_t comma : commas) t[comma] = '.';
  }
}

/// "[2024-05-01 10:00:00.123] [info] 1 0 0 0": what stands in front of a line's numbers and has a time of day, where
/// the line above has the same but for its digits.
void blankLogPrefixes(std::string& t) {
  std::string last;
  for (std::size_t begin = 0; begin < t.size();) {
    const std::size_t end = std::min(t.find('\n', begin), t.size());
    const std::string_view line = std::string_view(t).substr(begin, end - begin);
    const std::size_t word = line.find_last_not_of("0123456789.+-eE,;|()[]{} \t");
    const std::size_t front = word == kNone ? 0 : std::min(line.find_first_of(" \t]", word), line.size());
    std::string shape;  // a 0 for each number, and no blanks
    for (const char c : line.substr(0, front))
      if (isDigit(c) ? !shape.ends_with('0') : !isAmong(c, " \t")) shape += isDigit(c) ? '0' : c;
    if (shape == last && shape.find("0:0:0") != kNone)
      blank(t, begin, begin + std::min(line.find_first_not_of("] \t", front), line.size()));
    last = std::move(shape);
    begin = end + 1;
  }
}

void separateComments(PlainText& text) {
  const std::string& t = text.all;
  text.live = text.comments = t;
  bool isLineStart = true;
  for (std::size_t at = 0; at < t.size();) {
    const char c = t[at], before = at > 0 ? t[at - 1] : '\n', next = at + 1 < t.size() ? t[at + 1] : '\n';
    const bool isBlock = c == '/' && next == '*';
    const bool isMark = isBlock || (c == '/' && next == '/') || (isLineStart && isAmong(c, "#%")) ||
                        (c == '#' && isAmong(before, " \t") && (isSpace(next) || isNamePart(next)));
    isLineStart = c == '\n' || (isLineStart && isAmong(c, " \t"));
    const std::size_t close = !isMark ? at : std::min(isBlock ? t.find("*/", at + 2) : t.find('\n', at), t.size());
    const std::size_t inside = !isMark ? at : isBlock ? at + 2 : std::min(t.find_first_not_of(c, at), close);
    const std::size_t after = !isMark ? at + 1 : std::min(close + (isBlock ? 2 : 0), t.size());
    if (isMark) blank(text.live, at, after);
    blank(text.comments, at, inside);
    blank(text.comments, close, after);
    at = after;
  }
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::size_t numberEnd(std::string_view t, std::size_t at) {
  const std::size_t first = at + (at < t.size() && isAmong(t[at], "+-") ? 1 : 0);
  std::size_t end = afterDigits(t, first);
  const bool hasWhole = end > first;
  if (end < t.size() && t[end] == '.') {
    const std::size_t after = afterDigits(t, end + 1);
    if (hasWhole || after > end + 1) end = after;
  }
  if (end == first) return kNone;
  if (end < t.size() && isAmong(t[end], "eEdD")) {
    const std::size_t sign = end + 1 + (end + 1 < t.size() && isAmong(t[end + 1], "+-") ? 1 : 0);
    if (const std::size_t after = afterDigits(t, sign); after > sign) end = after;
  }
  return end;
}

PlainText plainText(std::string_view given) {
  PlainText text{withExponents(withPlainCharacters(given)), {}, {}};
  blankEmphasis(text.all);
  pointDecimalCommas(text.all);
  blankLogPrefixes(text.all);
  separateComments(text);
  return text;
}

}  // namespace viewproj::cmd::pasted
