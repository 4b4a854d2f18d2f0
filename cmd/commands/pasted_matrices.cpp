// Text to tokens; tokens to runs of numbers that no word and no key parts; runs to parts (what one bracket holds, or
// one line); parts to stacks, which are the rows of a matrix or a matrix each.
#include "commands/pasted_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kNone = std::string_view::npos;

bool isAmong(char c, std::string_view set) { return set.find(c) != kNone; }
/// Every character beyond ASCII counts as a letter.
bool isNameStart(char c) { return isLetter(c) || c == '_' || static_cast<unsigned char>(c) >= 0x80; }
bool isNamePart(char c) { return isNameStart(c) || isDigit(c); }
bool isSpace(char c) { return isAmong(c, " \t\n\v\f"); }

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// ---- Before: one character for what looks alike, decimal points, comments apart

/// A character beyond ASCII as plain text; empty: it stays.
std::string_view plain(char32_t c) {
  const bool decorates = c == 0xA0 || c == 0x200B || c == 0x25B8 || c == 0x25BF || (c >= 0x2190 && c <= 0x21FF) ||
                         (c >= 0x239B && c <= 0x23AE) || (c >= 0x2500 && c <= 0x257F);
  return decorates     ? " "
         : c == 0x2212 ? "-"
         : c == 0x221E ? "inf"
         : c == 0xFF1A ? ":"
         : c == 0xFF0C ? ","
         : c == 0xFEFF ? " "
                       : "";
}

/// Lines end with \n; the escapes \n, \t and \r of quoted strings are blanks.
std::string plainText(std::string_view text) {
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

/// The end of the number at `at`, which may have a sign and an exponent; kNone if there is none.
std::size_t numberEnd(std::string_view t, std::size_t at) {
  const auto digits = [&](std::size_t from) {
    while (from < t.size() && isDigit(t[from])) ++from;
    return from;
  };
  const std::size_t first = at + (at < t.size() && isAmong(t[at], "+-") ? 1 : 0);
  std::size_t end = digits(first);
  const bool hasWhole = end > first;
  if (end < t.size() && t[end] == '.') {
    const std::size_t after = digits(end + 1);
    if (hasWhole || after > end + 1) end = after;
  }
  if (end == first) return kNone;
  if (end < t.size() && isAmong(t[end], "eEdD")) {
    const std::size_t sign = end + 1 + (end + 1 < t.size() && isAmong(t[end + 1], "+-") ? 1 : 0);
    if (const std::size_t after = digits(sign); after > sign) end = after;
  }
  return end;
}

/// **1.0** and _1.0_: the marks around a number become blanks.
void blankEmphasis(std::string& t) {
  for (std::size_t at = 0; at < t.size(); ++at) {
    if (!isAmong(t[at], "*_")) continue;
    const std::size_t first = at;
    while (at < t.size() && isAmong(t[at], "*_")) ++at;
    const std::size_t marks = at - first, end = numberEnd(t, at);
    const bool isFree = first == 0 || !(isNamePart(t[first - 1]) || isAmong(t[first - 1], ")]"));
    if (end == kNone || marks > 3 || !isFree) continue;
    const std::string_view after = std::string_view(t).substr(end, marks + 1);
    const bool isPair = after.size() >= marks &&
                        std::equal(t.begin() + static_cast<std::ptrdiff_t>(first),
                                   t.begin() + static_cast<std::ptrdiff_t>(at), after.substr(0, marks).rbegin());
    if (!isPair || (after.size() > marks && (isNamePart(after[marks]) || isAmong(after[marks], "*([")))) continue;
    t.replace(first, marks, marks, ' ');
    t.replace(end, marks, marks, ' ');
    at = end;
  }
}

/// In a paragraph where every comma stands between two digits, once in a number, no number has a point, and one has a
/// single digit in front and five or more behind (pairs of pixels have not), commas are decimal.
void pointDecimalCommas(std::string& t) {
  for (std::size_t begin = 0; begin < t.size();) {
    const std::size_t end = std::min(t.find("\n\n", begin), t.size());
    std::size_t numbers = 0;
    bool isDecimal = true, isLong = false;
    for (std::size_t at = begin; at < end && isDecimal;) {
      const std::size_t chunk = std::min({t.find_first_of(" \t\n\v\f()[]{}|;:=<>", at), end});
      const std::string_view part = std::string_view(t).substr(at, chunk - at);
      at = std::max(chunk, at) + 1;
      for (std::size_t i = 1; i + 1 < part.size(); ++i)
        if (part[i] == '.' && isDigit(part[i - 1]) && isDigit(part[i + 1])) isDecimal = false;
      const std::size_t comma = part.find(',');
      if (comma == kNone) continue;
      std::string number(part.substr(0, part.size() - (part.ends_with('f') ? 1 : 0)));
      number[comma] = '.';
      isDecimal = isDecimal && part.find('.') == kNone && comma > 0 && isDigit(part[comma - 1]) &&
                  comma + 1 < part.size() && isDigit(part[comma + 1]) && numberEnd(number, 0) == number.size();
      const bool hasOne = comma == 1 || (comma == 2 && !isDigit(part[0]));
      isLong =
          isLong || (hasOne && part.substr(comma + 1).find_first_not_of("0123456789") >= 5 && part.size() > comma + 5);
      ++numbers;
    }
    if (isDecimal && isLong && numbers >= 3)
      for (std::size_t at = begin + 1; at + 1 < end; ++at)
        if (t[at] == ',' && isDigit(t[at - 1]) && isDigit(t[at + 1])) t[at] = '.';
    begin = end + 2;
  }
}

struct Separated {
  std::string live, comments;
};

/// The text without its comments, and the comments alone. All else is blanks, so that lines stay.
Separated separate(const std::string& text) {
  Separated parts{text, std::string(text.size(), ' ')};
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') parts.comments[i] = '\n';
  bool isLineStart = true;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::string_view two = std::string_view(text).substr(i, 2);
    const bool isBehindBlank = i > 0 && isAmong(text[i - 1], " \t");
    const bool isMark = (isLineStart && isAmong(c, "#%")) || two == "//" || two == "/*" ||
                        (c == '#' && isBehindBlank && (two.size() < 2 || isSpace(two[1]) || isNamePart(two[1])));
    if (!isMark) {
      isLineStart = c == '\n' || (isLineStart && isAmong(c, " \t"));
      ++i;
      continue;
    }
    const bool isBlock = two == "/*";
    const std::size_t close = isBlock ? text.find("*/", i + 2) : text.find('\n', i), end = std::min(close, text.size());
    const std::size_t after = std::min(end + (isBlock ? 2 : 0), text.size());
    const std::size_t inside = isBlock ? i + 2 : std::min(text.find_first_not_of(c, i), end);
    for (std::size_t j = i; j < after; ++j)
      if (text[j] != '\n') parts.live[j] = ' ';
    for (std::size_t j = inside; j < end; ++j) parts.comments[j] = text[j];
    i = after;
    isLineStart = false;
  }
  return parts;
}

// ---- Tokens

enum class Kind { number, open, close, row, index, callee, alias, repeat, factor, key, word };

struct Token {
  Kind kind;
  std::size_t line;
  std::string_view text = {}, label = {};  ///< label: ViewProj of ViewProj.row1
  double value = 0;
};

constexpr std::string_view kColumnsApart = "\n";  ///< the key of "Columns 1 through 3"

/// m00, M[1], _11, row1, x, x_axis, 0: what may stand in front of an entry or a row.
bool isIndex(std::string_view w) {
  if (w.size() == 1 && isAmong(w[0], "xyzwoXYZWO")) return true;
  if (!w.empty() && isAmong(w[0], "xyzw") && isOneOf(w.substr(1), {"axis", "_axis"})) return true;
  std::size_t at = 0;
  for (const std::string_view front : {"row", "column", "col", "line", "r", "c", "m", "M", "e", "a", "E", "A", "_"})
    if (at == 0 && w.starts_with(front)) at = front.size();
  if (at > 0 && at < w.size() && w[at] == '_') ++at;
  return at < w.size() && isDigit(w[at]) && w.find_first_not_of(at > 0 ? "0123456789_," : "0123456789", at) == kNone;
}

/// The types of numbers and matrices of many languages.
bool isType(std::string_view word) {
  std::string w = lower(word);
  if (w.starts_with("system.")) w = w.substr(7);
  if (isOneOf(w,
              {"const", "new", "float", "double", "half", "single", "int", "uint", "float32", "float64", "f32", "f64"}))
    return true;
  std::string_view rest = w;
  for (const std::string_view front : {"dvec", "dmat", "dfloat", "ddouble", "vec", "mat", "float", "double"})
    if (rest.starts_with(front)) {
      rest = rest.substr(front.size());
      return (rest.size() == 1 && isDigit(rest[0])) ||
             (rest.size() == 3 && isDigit(rest[0]) && rest[1] == 'x' && isDigit(rest[2]));
    }
  return false;
}

/// Tags that only lay a page out.
bool isHtml(const std::string& name) {
  return isOneOf(name, {"br", "p", "td", "tr", "th", "li", "span", "b", "i", "code", "pre", "div", "em", "font", "mn",
                        "mtd", "mtr", "sub", "sup"});
}

std::string_view lastPart(std::string_view name) { return name.substr(name.rfind('.') + 1); }

class Scanner {
 public:
  explicit Scanner(std::string_view text) : t_(text) {}

  std::vector<Token> tokens() {
    bool isLineStart = true;  // but for blanks, prompts and bullets
    while (at_ < t_.size()) {
      const char c = t_[at_];
      if (c == '\n') {
        ++line_;
        ++at_;
        isLineStart = true;
      } else if (isLineStart && (isAmong(c, "*>") || (isAmong(c, "+-") && isSpaceOrEnd(at_ + 1)))) {
        ++at_;
      } else if (follows("...") && (isLineStart || lineEndsAt(at_ + 3))) {
        at_ += 3;
      } else if (isAmong(c, " \t")) {
        ++at_;
      } else {
        isLineStart = false;
        step(c);
      }
    }
    return std::move(out_);
  }

 private:
  char at(std::size_t i) const { return i < t_.size() ? t_[i] : '\0'; }
  bool follows(std::string_view word) const { return t_.substr(at_, word.size()) == word; }
  bool isSpaceOrEnd(std::size_t i) const { return i >= t_.size() || isSpace(t_[i]); }
  std::size_t afterBlanks(std::size_t i) const {
    while (i < t_.size() && isAmong(t_[i], " \t")) ++i;
    return i;
  }
  std::size_t afterDigits(std::size_t i) const {
    while (i < t_.size() && isDigit(t_[i])) ++i;
    return i;
  }
  bool lineEndsAt(std::size_t i) const { return at(afterBlanks(i)) == '\n'; }
  void emit(Kind kind, std::string_view text = {}, std::string_view label = {}, double value = 0) {
    out_.push_back({kind, line_, text, label, value});
  }
  std::string_view take(std::size_t end) {
    const std::string_view taken = t_.substr(at_, end - at_);
    at_ = end;
    return taken;
  }

  /// The end of [3], [1,], [,0] or []; kNone for any other bracket.
  std::size_t indexEnd(std::size_t i) const {
    if (at(i) != '[') return kNone;
    const auto afterComma = [&](std::size_t j) { return afterBlanks(afterBlanks(j) + (at(afterBlanks(j)) == ',')); };
    const std::size_t end = afterComma(afterDigits(afterComma(i + 1)));
    return at(end) == ']' ? end + 1 : kNone;
  }

  void step(char c) {
    if (c == '"') quote();
    if (c == '<' && tag()) return;
    if (const std::size_t bracket = indexEnd(at_); bracket != kNone) {
      emit(Kind::index, take(bracket));
    } else if (isAmong(c, "([{")) {
      emit(Kind::open);
      ++at_;
    } else if (isAmong(c, ")]}")) {
      emit(Kind::close);
      ++at_;
    } else if (c == ';') {
      emit(Kind::row);
      ++at_;
    } else if (const std::size_t notFinite = notFiniteEnd(); notFinite != kNone) {
      emit(Kind::number, take(notFinite), {}, std::numeric_limits<double>::quiet_NaN());
    } else if (numberEnd(t_, at_) != kNone) {
      number();
    } else if (isNameStart(c)) {
      word();
    } else {
      if (!isAmong(c, "#\v\f,|&'\"`\\<>~$@!?:=")) emit(Kind::word);
      ++at_;
    }
  }

  /// A cell of CSV with three numbers or more is a bracket.
  void quote() {
    if (at_ == closing_) return emit(Kind::close);
    const std::size_t end = std::min(t_.find_first_not_of("-+0123456789.eE,; \t", at_ + 1), t_.size());
    std::size_t count = 0;
    for (std::size_t i = at_ + 1; i < end; ++i) {
      const auto isNumber = [&](char c) { return isDigit(c) || c == '.'; };
      count += isNumber(t_[i]) && !isNumber(t_[i - 1]) ? 1 : 0;
    }
    if (at(end) != '"' || count < 3) return;
    emit(Kind::open);
    closing_ = end;
  }

  bool tag() {
    constexpr std::string_view kRepeats = "<repeats ";
    if (follows(kRepeats)) {
      const std::size_t digits = at_ + kRepeats.size(), end = afterDigits(digits);
      if (t_.substr(end, 7) == " times>" && end > digits && end - digits < 4) {
        emit(Kind::repeat, {}, {}, parseNumber(t_.substr(digits, end - digits)).value_or(1));
        at_ = end + 7;
        return true;
      }
    }
    const bool isEnd = at(at_ + 1) == '/';
    const std::size_t begin = at_ + (isEnd ? 2 : 1);
    if (!isLetter(at(begin)) && !isAmong(at(begin), "!?")) return false;
    const std::size_t close = t_.find_first_of("<>()[]{}\n", begin);
    if (at(std::min(close, t_.size())) != '>') return false;
    std::size_t nameEnd = begin + 1;
    while (isNamePart(at(nameEnd)) || isAmong(at(nameEnd), ":.-")) ++nameEnd;
    const std::string_view name = t_.substr(begin, nameEnd - begin);
    if (!isHtml(lower(name))) {
      if (isEnd) {
        emit(Kind::close);
        emit(Kind::word);
      } else {
        key(name);
        if (!isAmong(t_[close - 1], "/?")) emit(Kind::open);
      }
    }
    at_ = close + 1;
    return true;
  }

  /// nan, inf, 1.#INF
  std::size_t notFiniteEnd() const {
    const std::size_t begin = at_ + (isAmong(t_[at_], "+-") ? 1 : 0);
    const std::string next = lower(t_.substr(begin, 12));
    for (const std::string_view word : {"nan", "infinity", "inf", "1.#inf", "1.#qnan", "1.#snan", "1.#ind"}) {
      if (!next.starts_with(word)) continue;
      std::size_t end = begin + word.size();
      if (word == "nan" && at(end) == '(') end = std::min(t_.find(')', end), t_.size() - 1) + 1;
      while (word[0] == '1' && at(end) == '0') ++end;
      if (!isNamePart(at(end)) && at(end) != '.') return end;
    }
    return kNone;
  }

  void number() {
    if (at(at_) == '0' && isAmong(at(at_ + 1), "xX")) {  // an address
      at_ = std::min(t_.find_first_not_of("0123456789abcdefABCDEF", at_ + 2), t_.size());
      return;
    }
    const std::size_t digitsEnd = numberEnd(t_, at_), end = suffixEnd(digitsEnd), after = afterBlanks(end);
    const std::string_view digits = t_.substr(at_, digitsEnd - at_);
    if (end == digitsEnd && at(after) == '*' && isAmong(at(afterBlanks(after + 1)), "\n[")) {
      emit(Kind::factor, digits, {}, valueOf(digits));
      at_ = after + 1;
      return;
    }
    const bool isTime = at(end) == ':' && isDigit(at(end + 1)) && isDigit(at(end + 2));
    if (digits.find_first_not_of("0123456789", digits[0] == '.' ? 1 : 0) == kNone && end == digitsEnd) {  // 0: 1.5
      const std::size_t mark = afterBlanks(end + (isAmong(at(end), "'\"") && at(end) != '\0' ? 1 : 0));
      const bool isLongTime = isTime && !isDigit(at(end + 3)) && at(end + 3) != '.';
      if (mark < t_.size() && isAmong(t_[mark], ":=") && !(mark + 1 < t_.size() && isAmong(t_[mark + 1], ":=")) &&
          !isLongTime)
        return emit(Kind::index, take(end));
    }
    const char next = at(end), second = at(after);
    const bool isWord =
        end < t_.size() &&
        (isNamePart(next) || isAmong(next, ".%/^+*-") || isTime || (after < t_.size() && isAmong(second, "*/^")) ||
         (after > end && after + 1 < t_.size() && isAmong(second, "+-") && isAmong(t_[after + 1], " \t")));
    if (isWord) {
      at_ = std::min(t_.find_first_of(" \t\n\v\f,;|()[]{}<>\"'", at_), t_.size());
      return emit(Kind::word);
    }
    emit(Kind::number, digits, {}, valueOf(digits));
    at_ = end;
  }

  /// Past f, F, h, l, d, _f32, f32 and f64.
  std::size_t suffixEnd(std::size_t i) const {
    const std::size_t letter = i + (at(i) == '_' ? 1 : 0);
    const bool isSized = at(letter) == 'f' && isOneOf(t_.substr(letter + 1, 2), {"32", "64"});
    const std::size_t end = isSized ? letter + 3 : at(i) != '\0' && isAmong(at(i), "fFlLhHd") ? i + 1 : i;
    return isNamePart(at(end)) ? i : end;
  }

  static double valueOf(std::string_view digits) {
    std::string text(digits);
    for (char& c : text) c = c == 'd' || c == 'D' ? 'e' : c;
    if (text.starts_with('+')) text.erase(0, 1);
    double value = 0;
    return readNumber(text.data(), text.data() + text.size(), value) ? value : std::numeric_limits<double>::quiet_NaN();
  }

  void key(std::string_view name) {
    const std::string_view last = lastPart(name);
    if (isIndex(last))
      emit(Kind::index, last, name.substr(0, name.size() - last.size() - (last.size() < name.size() ? 1 : 0)));
    else if (last.size() == 1 && isAmong(last[0], "rgbastpq"))
      emit(Kind::alias);
    else
      emit(Kind::key, name);
  }

  /// "World to Camera Transform:": of a line that has but words up to a colon the last four.
  std::string_view phrase(std::size_t begin, std::size_t end) const {
    constexpr std::size_t kLongest = 200;
    std::size_t first = begin, words = 1;
    for (std::size_t start = begin; begin - start < kLongest; ++words) {
      if (words <= 4) first = start;
      const std::size_t word = start == 0 ? kNone : t_.find_last_not_of(" \t", start - 1);
      if (word == kNone || isAmong(t_[word], "\n>*#/-")) return t_.substr(first, end - first);
      if (word + 1 == start || !(isNamePart(t_[word]) || t_[word] == '.')) break;
      for (start = word; start > 0 && (isNamePart(t_[start - 1]) || isAmong(t_[start - 1], ".-"));) --start;
      if (!isNameStart(t_[start])) break;
    }
    return t_.substr(begin, end - begin);
  }

  void word() {
    const std::size_t begin = at_;
    const bool isLatex = begin > 0 && t_[begin - 1] == '\\';
    while (isNamePart(at(at_)) || at(at_) == '.' || (follows("::") && (isNamePart(at(at_ + 2)) || at(at_ + 2) == '.')))
      at_ += follows("::") ? 2 : 1;
    const std::string_view w = t_.substr(begin, at_ - begin);
    if (isLatex) {
      for (const std::string_view operation : {"frac", "times", "cdot", "sqrt", "sin", "cos", "tan", "pm"})
        if (w.starts_with(operation)) return emit(Kind::word);
      return;
    }
    skipTemplate();
    if (at(at_) == '(') {  // Array(16) [
      const std::size_t end = afterDigits(at_ + 1);
      if (end > at_ + 1 && at(end) == ')' && (lineEndsAt(end + 1) || isAmong(at(afterBlanks(end + 1)), "[{"))) {
        at_ = end + 1;
        return;
      }
    }
    if (at_ < t_.size() && isAmong(t_[at_], "([{") && indexEnd(at_) == kNone) return emit(Kind::callee, w);
    if (assignment(begin, w)) return;
    const std::string_view last = lastPart(w);
    const std::string name = lower(w);
    const std::size_t next = afterBlanks(at_);
    const std::size_t digits = afterDigits(next);
    if (isOneOf(name, {"row", "col", "column", "line"}) && digits > next && isAmong(at(digits), " \t:")) {
      at_ = digits;
      return emit(Kind::index);
    }
    if (isOneOf(name, {"column", "columns"}) && digits > next) return emit(Kind::key, kColumnsApart);
    const bool isBeforeEntry = (next > at_ && next < t_.size() && isAmong(t_[next], "-+.0123456789([{")) ||
                               at(afterBlanks(at_ + (at(at_) == ',' ? 1 : 0))) == '"';
    if (isIndex(last) && w.size() > 1 && isBeforeEntry) return key(w);
    if (!isType(w)) emit(Kind::word);
  }

  /// vec4<f32>
  void skipTemplate() {
    std::size_t i = at_ + (at(at_) == ' ' ? 1 : 0);
    if (at(i) != '<') return;
    for (++i; isNamePart(at(i)) || (i < t_.size() && isAmong(t_[i], " \t,:*"));) ++i;
    if (at(i) == '>') at_ = i + 1;
  }

  /// name =, name[2] = and "name": of a word that has been read.
  bool assignment(std::size_t begin, std::string_view w) {
    std::size_t end = at_;
    for (std::size_t next = indexEnd(end); next != kNone; next = indexEnd(end)) end = afterBlanks(next);
    const std::string_view indices = t_.substr(at_, end - at_);
    if (end < t_.size() && isAmong(t_[end], "'\"")) ++end;
    end = afterBlanks(end);
    const bool isColon = at(end) == ':' && at(end + 1) != '=';
    if (at(end) != ':' && at(end) != '=') return false;
    end += at(end) == ':' && at(end + 1) == '=' ? 2 : 1;
    if (end < t_.size() && isAmong(t_[end], ":=")) return false;
    const std::size_t wordEnd = at_;
    at_ = end;
    const std::size_t next = afterBlanks(end);
    if (!indices.empty() && next < t_.size() && !isAmong(t_[next], "({[\n")) {
      emit(Kind::index, indices, w);
      return true;
    }
    const std::string_view last = lastPart(w);
    const bool isLabel = isIndex(last) || (last.size() == 1 && isAmong(last[0], "rgbastpq"));
    key(isColon && !isLabel ? phrase(begin, wordEnd) : w);
    return true;
  }

  std::string_view t_;
  std::size_t at_ = 0, line_ = 1, closing_ = kNone;
  std::vector<Token> out_;
};

// ---- Runs

struct Bracket {
  std::size_t parent = 0;
  std::string_view callee = {}, key = {};
  bool isRefused = false;  ///< of a call that makes a matrix of other things
  bool lacks = false;      ///< an index in it has no number
  bool isClosed = false;
};

struct Number {
  double value;
  std::string_view text;
  std::size_t line, bracket, semicolons;
  std::string_view label, key;
  std::size_t keyLine, indexDigits, index;
};

struct Run {
  std::vector<Number> numbers = {};
  double factor = 1;
  bool isRefused = false;   ///< columns apart, lookAt(...)
  bool isUnopened = false;  ///< it ends with a bracket that nothing opened
};

struct Runs {
  std::vector<Run> runs;
  std::vector<Bracket> brackets{Bracket{}};  ///< the first is none
};

bool isGeneric(std::string_view key) {
  return isOneOf(lower(lastPart(key)), {"data", "elements", "value", "values", "columns", "array", "v", "type", "name",
                                        "result", "ans", "floats", "dtype", "some", "rows", "cols", "dt", "m"});
}

/// A call that makes a matrix: what it is given is none.
bool makesMatrix(std::string_view callee) {
  const std::string c = lower(callee);
  for (const char* word : {"lookat", "look_at", "perspective", "frustum", "viewport", "unproject"})
    if (c.find(word) != kNone) return true;
  return c.ends_with("rgb") || c.ends_with("rgba");
}

Runs runsOf(const std::vector<Token>& tokens) {
  constexpr std::size_t kDeepest = 64;  // brackets beyond are not told apart
  Runs result;
  std::vector<Bracket>& brackets = result.brackets;
  Run run;
  std::size_t open = 0, depth = 0, semicolons = 0, keyLine = 0;
  std::string_view label, callee, pending, lastKey, index;
  bool isAlias = false, areApart = false;
  Kind last = Kind::word;
  const auto finish = [&](double factor) {
    if (!run.numbers.empty()) result.runs.push_back(std::move(run));
    run = Run{.factor = factor, .isRefused = areApart};
  };
  for (const Token& token : tokens) {
    const Kind kind = token.kind;
    if (kind == Kind::number) {
      if (!(isAlias && !run.numbers.empty() && run.numbers.back().text == token.text)) {
        Number n{token.value, token.text, token.line, open, semicolons, label, lastKey, keyLine, 0, 0};
        for (const char c : index)
          if (isDigit(c) && ++n.indexDigits < 9) n.index = n.index * 10 + static_cast<std::size_t>(c - '0');
        run.numbers.push_back(n);
        run.isRefused = run.isRefused || brackets[open].isRefused;
      }
    } else if (kind == Kind::repeat) {
      for (double i = 1; i < token.value && !run.numbers.empty(); ++i)
        run.numbers.push_back(Number(run.numbers.back()));
    } else if (kind == Kind::open) {
      if (++depth <= kDeepest) {
        brackets.push_back({open, callee, pending, brackets[open].isRefused || makesMatrix(callee)});
        open = brackets.size() - 1;
      }
    } else if (kind == Kind::close) {
      ++semicolons;
      if (!index.empty() && last == Kind::index) brackets[open].lacks = open != 0;
      if (depth == 0)
        run.isUnopened = !run.numbers.empty();
      else if (depth-- <= kDeepest) {
        brackets[open].isClosed = true;
        open = brackets[open].parent;
      }
    } else if (kind == Kind::row) {
      ++semicolons;
    } else if (kind == Kind::word || kind == Kind::key || kind == Kind::factor) {
      areApart = token.text == kColumnsApart || (areApart && kind == Kind::word);
      finish(kind == Kind::factor ? token.value : 1);
      if (kind == Kind::key && token.text != kColumnsApart && !isGeneric(token.text)) {
        lastKey = token.text;
        keyLine = token.line;
      }
    }
    if (kind == Kind::key || kind == Kind::word || kind == Kind::number || kind == Kind::close)
      pending = kind == Kind::key ? token.text : std::string_view();
    isAlias = kind == Kind::alias;
    callee = kind == Kind::callee ? token.text : std::string_view();
    last = kind;
    index = kind == Kind::index ? token.text : std::string_view();
    label = kind != Kind::index ? std::string_view() : token.label.empty() ? label : token.label;
  }
  finish(1);
  return result;
}

// ---- Parts and stacks

using Part = std::span<const Number>;

struct Block {
  std::vector<const Number*> numbers;
  std::size_t rows, columns;
  bool isInMemoryOrder;
};

/// Cuts a list where the key of neighbours differs.
template <class List, class Key>
std::vector<List> cut(List list, Key key) {
  std::vector<List> parts;
  for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
    for (end = begin + 1; end < list.size() && key(list[end]) == key(list[end - 1]);) ++end;
    parts.push_back(list.subspan(begin, end - begin));
  }
  return parts;
}

bool isShape(std::size_t rows, std::size_t columns) {
  return (rows == 3 && columns == 3) || ((rows == 3 || rows == 4) && columns == 4) || (rows == 4 && columns == 3);
}
bool isCount(std::size_t n) { return n == 9 || n == 12 || n == 16; }

Block asRows(std::span<const Part> parts) {
  Block block{{}, parts.size(), parts[0].size(), false};
  for (const Part& part : parts)
    for (const Number& n : part) block.numbers.push_back(&n);
  return block;
}

/// 9, 12 or 16 numbers in memory order, or in rows by semicolons.
Block flat(std::span<const Part> parts) {
  Block block = asRows(parts);
  const std::size_t count = block.numbers.size();
  block.columns = count == 9 ? 3 : 4;
  block.rows = count / block.columns;
  bool isByRows = true;
  for (std::size_t i = 1; i < count; ++i)
    isByRows =
        isByRows && (block.numbers[i]->semicolons != block.numbers[i - 1]->semicolons) == (i % block.columns == 0);
  const bool isFourByThree = count == 12 && [&] {
    for (std::size_t i = 1; i < count; ++i)
      if ((block.numbers[i]->semicolons != block.numbers[i - 1]->semicolons) != (i % 3 == 0)) return false;
    return true;
  }();
  if (isFourByThree) block.columns = 3, block.rows = 4;
  block.isInMemoryOrder = !isByRows && !isFourByThree;
  return block;
}

/// 25 numbers of one bracket: a 4x4 that ends with 0 0 0 1 and a K.
std::vector<Block> poseAndK(std::span<const Part> parts) {
  const Block all = asRows(parts);
  const auto is = [&](std::size_t i, double value) { return all.numbers[i]->value == value; };
  const bool fits = is(12, 0) && is(13, 0) && is(14, 0) && is(15, 1) && !is(16, 0) && !is(20, 0) && !is(24, 0) &&
                    is(19, 0) && is(22, 0) && is(23, 0);
  if (!fits) return {};
  return {{{all.numbers.begin(), all.numbers.begin() + 16}, 4, 4, true},
          {{all.numbers.begin() + 16, all.numbers.end()}, 3, 3, true}};
}

/// The matrices of one run.
class Stacks {
 public:
  Stacks(const std::vector<Bracket>& brackets, const std::vector<std::size_t>& emptyLinesBefore, bool isUnopened,
         std::vector<Block>& found, std::vector<PassedOver>& passedOver)
      : brackets_(brackets),
        emptyLines_(emptyLinesBefore),
        isUnopened_(isUnopened),
        found_(found),
        passedOver_(passedOver) {}

  void find(Part numbers) {
    // An index that is the first one again, on another line, begins a new matrix.
    for (std::size_t i = 1; i < numbers.size(); ++i)
      if (numbers[0].indexDigits > 1 && numbers[i].indexDigits == numbers[0].indexDigits &&
          numbers[i].index == numbers[0].index && numbers[i].line != numbers[i - 1].line) {
        find(numbers.subspan(0, i));
        return find(numbers.subspan(i));
      }
    last_ = &numbers.back();
    std::map<std::size_t, std::size_t> total;
    for (const Number& n : numbers)
      for (std::size_t b = n.bracket; b != 0; b = brackets_[b].parent) ++total[b];
    cells_.clear();
    sizes_.clear();
    for (const Number& n : numbers) {
      std::size_t b = n.bracket;
      while (b != 0 && total[b] < 2) b = brackets_[b].parent;
      cells_[n.bracket] = b;
      ++sizes_[b];
    }
    std::vector<Part> parts;
    for (const Part& cell : cut(numbers, [&](const Number& n) { return cellOf(n); }))
      if (const std::size_t c = cellOf(cell[0]); c != 0 && (sizes_[c] == 3 || sizes_[c] == 4))
        parts.push_back(cell);
      else
        for (const Part& line : cut(cell, [](const Number& n) { return n.line; })) parts.push_back(line);
    dropLabels(parts);
    holds_.clear();
    for (const Part& part : parts)
      for (std::size_t b = part[0].bracket; b != 0; b = brackets_[b].parent) ++holds_[b];
    const auto group = [&](const Part& p) { return std::pair(parentOf(p), isAlone(p) ? p.data() : nullptr); };
    for (const std::span<const Part>& stack : cut(std::span<const Part>(parts), group)) place(stack);
  }

 private:
  std::size_t cellOf(const Number& n) { return cells_[n.bracket]; }

  /// An index, an offset, a size beside a bracket of numbers is none of them.
  void dropLabels(std::vector<Part>& parts) {
    std::set<std::size_t> wide;
    for (const Part& part : parts)
      if (part.size() >= 3 && cellOf(part[0]) != 0) wide.insert(part[0].line);
    const bool areSeveral = parts.size() > 1;
    std::erase_if(parts, [&](const Part& part) {
      return part.size() < 3 && wide.contains(part[0].line) && !(areSeveral && isCount(sizes_[cellOf(part[0])]));
    });
  }

  /// The innermost bracket that holds several parts.
  std::size_t parentOf(const Part& part) {
    const std::size_t cell = cellOf(part[0]);
    std::size_t b = part[0].bracket;
    while (b != 0 && !(holds_[b] >= 2 && (cell == 0 || b <= cell))) b = brackets_[b].parent;
    return b;
  }

  /// All of a matrix in one bracket on one line.
  bool isAlone(const Part& part) {
    const std::size_t cell = cellOf(part[0]);
    return cell != 0 && part.size() == sizes_[cell] && isCount(part.size());
  }

  void place(std::span<const Part> stack) {
    const std::size_t inside = parentOf(stack[0]);
    const std::vector<std::span<const Part>> whole{stack},
        pieces = cut(stack, [&](const Part&p) { return emptyLines_[p[0].line]; });
    const bool isWholeFirst = inside != 0 || pieces.size() == 1;
    const auto read = [&](const std::vector<std::span<const Part>>& each) {
      std::vector<std::vector<Block>> blocks;
      for (const auto& one : each) blocks.push_back(blocksOf(one, inside));
      return blocks;
    };
    const auto* chosen = isWholeFirst ? &whole : &pieces;
    auto blocks = read(*chosen);
    if (std::all_of(blocks.begin(), blocks.end(), [](const auto& b) { return b.empty(); })) {
      chosen = isWholeFirst ? &pieces : &whole;
      blocks = read(*chosen);
    }
    for (std::size_t i = 0; i < chosen->size(); ++i) {
      if (blocks[i].empty()) passOver((*chosen)[i]);
      for (Block& block : blocks[i]) keep(std::move(block), inside);
    }
  }

  void passOver(std::span<const Part> parts) {
    PassedOver over{parts[0][0].line, 0, parts.size(), parts[0].size()};
    for (const Part& part : parts) {
      over.numbers += part.size();
      if (part.size() != over.columns) over.columns = 0;
    }
    if (over.columns != 3 && over.columns != 4) over.rows = over.columns = 0;
    passedOver_.push_back(over);
  }

  void keep(Block block, std::size_t inside) {
    const std::size_t first = cellOf(*block.numbers.front()), end = cellOf(*block.numbers.back());
    const std::size_t holder = inside != 0 ? inside : first == end ? first : 0;  // the bracket around all of it
    const bool isCutOff = holder != 0 ? !brackets_[holder].isClosed : isUnopened_ && block.numbers.back() == last_;
    const bool lacks = std::any_of(block.numbers.begin(), block.numbers.end(), [&](const Number* n) {
      for (std::size_t b = n->bracket; b != 0; b = brackets_[b].parent)
        if (brackets_[b].lacks) return true;
      return false;
    });
    if ((isCutOff && block.numbers.size() < 16) || lacks || !isNumberedWhole(block))
      passedOver_.push_back({block.numbers.front()->line, block.numbers.size()});
    else
      found_.push_back(std::move(block));
  }

  /// Numbers that each have an index have the first to the last: 0 to 15, m00 to m33, M11 to M44.
  static bool isNumberedWhole(const Block& block) {
    for (const Number* n : block.numbers)
      if (n->indexDigits == 0) return true;
    const Number &first = *block.numbers.front(), &last = *block.numbers.back();
    if (first.indexDigits > 2) return true;
    if (first.indexDigits == 1) return last.index - first.index == block.numbers.size() - 1 && first.index < 2;
    const std::size_t size = block.rows * 10 + block.columns;
    return last.indexDigits != 2 || (first.index == 0 && last.index == size - 11) ||
           (first.index == 11 && last.index == size);
  }

  std::vector<Block> blocksOf(std::span<const Part> parts, std::size_t inside) {
    std::map<std::size_t, std::size_t> ofLine;
    std::size_t count = 0, most = 0, least = kNone;
    bool isOne = true, areCells = true;
    for (const Part& part : parts) {
      ++ofLine[part[0].line];
      count += part.size();
      most = std::max(most, part.size());
      least = std::min(least, part.size());
      isOne = isOne && cellOf(part[0]) == cellOf(parts[0][0]);
      areCells = areCells && cellOf(part[0]) != 0;
    }
    // Outside of brackets the parts lie one a line, or all on one.
    const std::size_t first = ofLine.begin()->second;
    const bool isEven =
        inside != 0 || (std::all_of(ofLine.begin(), ofLine.end(), [&](const auto& l) { return l.second == first; }) &&
                        (first == 1 || first == parts.size()));
    if (isOne && cellOf(parts[0][0]) != 0 && count == 25) return poseAndK(parts);
    if (least == most) {
      if (isCount(most) && !(isOne && inside != 0)) {
        std::vector<Block> each;
        for (std::size_t i = 0; i < parts.size(); ++i) each.push_back(flat(parts.subspan(i, 1)));
        return each;
      }
      const bool isFourByThree = parts.size() == 4 && most == 3;
      if (isShape(parts.size(), most) && isEven && (inside != 0 || areCells || !isFourByThree)) return {asRows(parts)};
      if (most == 3 || most == 4) return {};
    }
    const bool areEights = parts.size() == 2 && least == 8 && most == 8;
    if (isOne && isCount(count) && (inside != 0 || most == 1 || areEights)) return {flat(parts)};
    if (inside == 0 && parts.size() == 5)  // "4 4" in front of sixteen
      for (const bool isFront : {true, false}) {
        const std::span<const Part> rows = parts.subspan(isFront ? 1 : 0, 4);
        if (std::all_of(rows.begin(), rows.end(), [](const Part& p) { return p.size() == 4; }) &&
            parts[isFront ? 0 : 4].size() < 3)
          return {asRows(rows)};
      }
    return {};
  }

  const std::vector<Bracket>& brackets_;
  const std::vector<std::size_t>& emptyLines_;
  const bool isUnopened_;
  const Number* last_ = nullptr;
  std::map<std::size_t, std::size_t> cells_, sizes_, holds_;  ///< by bracket
  std::vector<Block>& found_;
  std::vector<PassedOver>& passedOver_;
};

// ---- Names

/// Whether the text says that what stands in a row is a column.
bool saysColumns(std::string_view text) {
  const std::string t = lower(text);
  for (const char* word : {"matrix3d", "simd_float", "simd_double", "x_axis", "from_cols", "setcolumn"})
    if (t.find(word) != kNone) return true;
  if (const std::size_t x = t.find("[x:");
      x != kNone && t.find_first_not_of(" \t", x + 3) != kNone && t[t.find_first_not_of(" \t", x + 3)] == '(')
    return true;
  for (std::size_t at = t.find("mat"); at != kNone; at = t.find("mat", at + 1)) {
    const std::size_t begin = at > 0 && t[at - 1] == 'd' ? at - 1 : at;
    std::size_t end = at + 3;
    while (end < t.size() && isNamePart(t[end])) ++end;
    if ((begin == 0 || !isNamePart(t[begin - 1])) &&
        isOneOf(std::string_view(t).substr(at + 3, end - at - 3), {"3", "4", "3x3", "3x4", "4x3", "4x4"}))
      return true;
  }
  return false;
}

/// What the lines in front and the brackets around call the matrices.
class Namer {
 public:
  Namer(std::string_view text, const std::vector<Bracket>& brackets) : brackets_(brackets) {
    for (std::size_t at = 0; at <= text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      lines_.push_back(text.substr(at, end - at));
      at = end + 1;
    }
  }

  std::string_view line(std::size_t number) const { return lines_[number - 1]; }
  std::size_t lines() const { return lines_.size(); }

  /// after: the line of the matrix before it.
  void name(PastedMatrix& m, const Block& block, std::size_t after) {
    const Number& first = *block.numbers.front();
    m.line = first.line;
    std::string_view label, around, prose;
    for (const Number* n : block.numbers)
      if (label.empty()) label = n->label;
    for (std::size_t b = first.bracket; b != 0; b = brackets_[b].parent) {
      const Bracket& bracket = brackets_[b];
      if (around.empty() && !bracket.key.empty() && bracket.key != kColumnsApart && !isGeneric(bracket.key))
        around = bracket.key;
      m.isByColumns = m.isByColumns || saysColumns(bracket.callee);
      m.isCss = m.isCss || bracket.callee.find("matrix3d") != kNone;
    }
    const bool isNear = first.keyLine > after || first.keyLine == m.line;
    std::vector<std::string_view> front;
    for (std::size_t i = m.line - 1; i > after && (prose.empty() || front.size() < 3); --i) {
      if (front.size() < 3 && std::any_of(line(i).begin(), line(i).end(), isNameStart)) front.push_back(line(i));
      if (prose.empty() && hasWord(line(i))) prose = line(i);
    }
    for (auto each = front.rbegin(); each != front.rend(); ++each) m.context += std::string(*each) + " ";
    constexpr std::size_t kMost = 300;
    const std::string_view own = line(m.line);
    m.context += own;
    if (m.context.size() > kMost) m.context.erase(0, m.context.size() - kMost);
    while (!prose.empty() && isAmong(prose.front(), " \t#/%*>`-=:")) prose.remove_prefix(1);
    while (!prose.empty() && isAmong(prose.back(), " \t#/%*>`-=:")) prose.remove_suffix(1);
    m.name = !label.empty() ? label : !around.empty() ? around : isNear && !first.key.empty() ? first.key : prose;
    if (m.line != columnsLine_) {
      columnsLine_ = m.line;
      hasColumns_ = saysColumns(own);
    }
    m.isByColumns = m.isByColumns || hasColumns_;
  }

 private:
  static bool hasWord(std::string_view line) {
    const auto isWordLetter = [](char c) { return isNameStart(c) && c != '_'; };
    for (std::size_t i = 1; i < line.size(); ++i)
      if (isWordLetter(line[i - 1]) && isWordLetter(line[i])) return true;
    return false;
  }

  const std::vector<Bracket>& brackets_;
  std::vector<std::string_view> lines_;
  std::size_t columnsLine_ = 0;
  bool hasColumns_ = false;
};

PastedMatrices findIn(std::string_view part, std::string_view text) {
  const Runs runs = runsOf(Scanner(part).tokens());
  Namer namer(text, runs.brackets);
  // Before each line: how many empty ones, which may have the mark of a quote or comment.
  std::vector<std::size_t> emptyLines(namer.lines() + 2);
  for (std::size_t i = 1; i <= namer.lines(); ++i)
    emptyLines[i + 1] = emptyLines[i] + (namer.line(i).find_first_not_of("#/%*> \t\v\f") == kNone ? 1 : 0);
  PastedMatrices result;
  std::size_t after = 0;
  for (const Run& run : runs.runs) {
    std::vector<Block> blocks;
    std::vector<PassedOver> over;
    if (run.isRefused)
      over.push_back({run.numbers.front().line, run.numbers.size()});
    else
      Stacks(runs.brackets, emptyLines, run.isUnopened, blocks, over).find(run.numbers);
    // cppcheck-suppress knownEmptyContainer  // Stacks fills it
    for (const Block& block : blocks) {
      PastedMatrix& m = result.matrices.emplace_back();
      namer.name(m, block, after);
      after = block.numbers.back()->line;
      m.rows = block.rows;
      m.columns = block.columns;
      m.isInMemoryOrder = block.isInMemoryOrder;
      m.factor = run.factor;
      for (const Number* n : block.numbers) {
        std::string digits(n->text);
        for (char& c : digits) c = c == 'd' || c == 'D' ? 'e' : c;
        m.numbers.push_back({n->value, std::move(digits)});
      }
    }
    result.passedOver.insert(result.passedOver.end(), over.begin(), over.end());
  }
  return result;
}

}  // namespace

PastedMatrices findMatrices(std::string_view given) {
  std::string text = plainText(given);
  blankEmphasis(text);
  pointDecimalCommas(text);
  const Separated parts = separate(text);
  PastedMatrices live = findIn(parts.live, text);
  if (!live.matrices.empty()) return live;
  PastedMatrices apart = findIn(parts.comments, text);
  if (apart.matrices.empty() && !live.passedOver.empty()) return live;
  return apart;
}

}  // namespace viewproj::cmd
