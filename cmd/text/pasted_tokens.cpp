// Plain text to tokens: numbers, brackets, names and indices; what is none of them is a word, or nothing.
#include <algorithm>
#include <limits>

#include "text/pasted_parts.hpp"

namespace viewproj::cmd::pasted {
namespace {

constexpr std::string_view kUnionNames = "rgbastpq";

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
  const std::string w = lower(word.starts_with("System.") ? word.substr(7) : word);
  if (isOneOf(w,
              {"const", "new", "float", "double", "half", "single", "int", "uint", "float32", "float64", "f32", "f64"}))
    return true;
  std::string_view size = w.starts_with('d') && !w.starts_with("double") ? std::string_view(w).substr(1) : w;
  for (const std::string_view front : {"vec", "mat", "float", "double"})
    if (size.starts_with(front)) {
      size.remove_prefix(front.size());
      return !size.empty() && isDigit(size[0]) &&
             (size.size() == 1 || (size.size() == 3 && size[1] == 'x' && isDigit(size[2])));
    }
  return false;
}

/// Tags that only lay a page out.
bool isHtml(std::string_view name) {
  return isOneOf(lower(name), {"br", "p", "td", "tr", "th", "li", "span", "b", "i", "code", "pre", "div", "em", "font",
                               "mn", "mtd", "mtr", "sub", "sup"});
}

double valueOf(std::string_view digits) {
  std::string text(digits.substr(digits.starts_with('+') ? 1 : 0));
  for (char& c : text) c = c == 'd' || c == 'D' ? 'e' : c;
  double value = 0;
  return readNumber(text.data(), text.data() + text.size(), value) ? value : std::numeric_limits<double>::quiet_NaN();
}

class Scanner {
 public:
  explicit Scanner(std::string_view text) : t_(text) {}

  std::vector<Token> tokens() {
    bool isLineStart = true;  // but for blanks, prompts and bullets
    while (at_ < t_.size()) {
      const char c = t_[at_];
      const bool isDots = follows("...");
      if (c == '\t') quote('\t');
      const bool isMark = isLineStart && (isAmong(c, "*>") || (isAmong(c, "+-") && isSpaceOrEnd(at_ + 1)));
      if (c == '\n') {
        ++line_;
        ++at_;
        isLineStart = true;
        skipTableRule();
      } else if (isDots) {  // a prompt at the start of a line, a continuation at its end
        if (isLineStart == lineEndsAt(at_ + 3)) emit(Kind::elided);
        at_ += 3;
      } else if (isMark || isAmong(c, " \t")) {
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
    while (isAmong(at(i), " \t")) ++i;
    return i;
  }
  std::size_t afterDigits(std::size_t i) const {
    while (isDigit(at(i))) ++i;
    return i;
  }
  bool lineEndsAt(std::size_t i) const { return isAmong(at(afterBlanks(i)), "\n") || afterBlanks(i) >= t_.size(); }
  void emit(Kind kind, std::string_view text = {}, std::string_view label = {}, double value = 0) {
    out_.push_back({kind, line_, text, label, value});
  }
  std::string_view take(std::size_t end) {
    const std::string_view taken = t_.substr(at_, end - at_);
    at_ = end;
    return taken;
  }

  /// |---|---| and +---+---+, of a whole line.
  void skipTableRule() {
    const std::size_t end = std::min(t_.find_first_not_of("|+-:= \t", at_), t_.size());
    const std::string_view rule = t_.substr(at_, end - at_);
    if (!isSpaceOrEnd(end) || rule.find_first_of("|+") == kNone || rule.find("--") == kNone) return;
    emit(Kind::tableRule);
    at_ = end;
  }

  /// The end of [3], [1,], [,0] or [], and of [1,2] or [0..3] in front of = or :; kNone for any other bracket.
  std::size_t indexEnd(std::size_t i) const {
    if (at(i) != '[') return kNone;
    const std::size_t first = afterBlanks(i + 1), firstEnd = afterBlanks(afterDigits(first));
    const bool isRange = t_.substr(std::min(firstEnd, t_.size()), 2) == "..";
    const std::size_t second = isRange               ? afterBlanks(firstEnd + 2)
                               : at(firstEnd) == ',' ? afterBlanks(firstEnd + 1)
                                                     : firstEnd;
    const std::size_t end = afterBlanks(afterDigits(second));
    if (at(end) != ']') return kNone;
    const bool isPair = isDigit(at(first)) && (isRange || at(firstEnd) == ',') && isDigit(at(second));
    return isPair && !isAmong(at(afterBlanks(end + 1)), "=:") ? kNone : end + 1;
  }

  void step(char c) {
    if (c == '"') quote('"');
    if (c == '<' && tag()) return;
    if (const std::size_t bracket = indexEnd(at_); bracket != kNone) {
      emit(Kind::index, take(bracket));
    } else if (const std::size_t notFinite = notFiniteEnd(); notFinite != kNone) {
      emit(Kind::number, take(notFinite), {}, std::numeric_limits<double>::quiet_NaN());
    } else if (numberEnd(t_, at_) != kNone) {
      number();
    } else if (isNameStart(c)) {
      word();
    } else {
      if (isAmong(c, "([{")) emit(Kind::open);
      if (isAmong(c, ")]}")) emit(Kind::close);
      if (c == ';' || (c == '\\' && at(at_ + 1) == '\\')) emit(Kind::row);
      if (!isAmong(c, "([{)]};#\v\f,|&'\"`\\<>~$@!?:=")) emit(Kind::word);
      ++at_;
    }
  }

  /// A cell of CSV with three numbers or more is a bracket; of a table of tabs one with commas and a cell behind it.
  void quote(char end) {
    if (at_ == closing_) {
      emit(Kind::close);
      if (end == '"') return;
    }
    const std::string_view inside = end == '"' ? "-+0123456789.eE,; \t" : "-+0123456789.eE, ";
    const std::size_t last = std::min(t_.find_first_not_of(inside, at_ + 1), t_.size());
    const auto isNumber = [&](std::size_t i) { return isDigit(t_[i]) || t_[i] == '.'; };
    std::size_t count = 0, commas = 0;
    for (std::size_t i = at_ + 1; i < last; ++i) {
      count += isNumber(i) && !isNumber(i - 1) ? 1 : 0;
      commas += t_[i] == ',' ? 1 : 0;
    }
    if (at(last) != end || count < 3 || (end == '\t' && commas + 1 < count)) return;
    emit(Kind::open);
    closing_ = last;
  }

  bool tag() {
    constexpr std::string_view kRepeats = "<repeats ";
    if (follows(kRepeats)) {
      const std::size_t digits = at_ + kRepeats.size(), end = afterDigits(digits);
      if (t_.substr(end, 7) == " times>" && end > digits) {
        emit(Kind::repeat, {}, {}, valueOf(t_.substr(digits, end - digits)));
        at_ = end + 7;
        return true;
      }
    }
    const bool isEnd = at(at_ + 1) == '/';
    const std::size_t begin = at_ + (isEnd ? 2 : 1);
    if (!isLetter(at(begin)) && !isAmong(at(begin), "!?")) return false;
    const std::size_t close = t_.find_first_of("<>()[]{}\n", begin);
    if (at(close) != '>') return false;
    std::size_t nameEnd = begin + 1;
    while (isNamePart(at(nameEnd)) || isAmong(at(nameEnd), ":.-")) ++nameEnd;
    const std::string_view name = t_.substr(begin, nameEnd - begin);
    const std::string_view rest = t_.substr(nameEnd, close - nameEnd);
    const bool arePlainWords = rest.find('=') == kNone && rest.find_first_not_of(" /") != kNone;
    if (arePlainWords) {  // <No data fields>
      emit(Kind::word);
    } else if (!isHtml(name)) {
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
    if (!isAmong(at(begin), "nNiI1")) return kNone;
    const std::string next = lower(t_.substr(begin, 12));
    for (const std::string_view word : {"nan", "infinity", "inf", "1.#inf", "1.#qnan", "1.#snan", "1.#ind"}) {
      if (!next.starts_with(word)) continue;
      std::size_t end = begin + word.size();
      if (word == "nan" && at(end) == '(') end = std::min(t_.find_first_of(")\n", end), t_.size() - 1) + 1;
      while (word[0] == '1' && at(end) == '0') ++end;
      if (!isNamePart(at(end)) && at(end) != '.') return end;
    }
    return kNone;
  }

  void number() {
    if (at(at_) == '0' && isAmong(at(at_ + 1), "xX")) {  // an address, and what is in front of it names no numbers
      if (!out_.empty() && out_.back().kind == Kind::key) out_.back().kind = Kind::word;
      at_ = std::min(t_.find_first_not_of("0123456789abcdefABCDEF", at_ + 2), t_.size());
      return;
    }
    const std::size_t digitsEnd = numberEnd(t_, at_), end = suffixEnd(digitsEnd), after = afterBlanks(end);
    const std::string_view digits = t_.substr(at_, digitsEnd - at_);
    const char next = at(end), second = at(after);
    if (end == digitsEnd && second == '*' && isAmong(at(afterBlanks(after + 1)), "\n[")) {
      emit(Kind::factor, digits, {}, valueOf(digits));
      at_ = after + 1;
      return;
    }
    const bool isTime = next == ':' && isDigit(at(end + 1)) && isDigit(at(end + 2));
    const bool isLongTime = isTime && !isDigit(at(end + 3)) && at(end + 3) != '.';
    const std::size_t mark = afterBlanks(end + (isAmong(next, "'\"") ? 1 : 0));
    const bool isWhole = end == digitsEnd && digits.find_first_not_of("0123456789", digits[0] == '.' ? 1 : 0) == kNone;
    if (isWhole && isAmong(at(mark), ":=") && !isAmong(at(mark + 1), ":=") && !isLongTime)  // 0: 1.5
      return emit(Kind::index, take(end));
    if (isNamePart(next) || isAmong(next, ".%/^+*-") || isTime || isAmong(second, "*/^") ||
        (after > end && isAmong(second, "+-") && isAmong(at(after + 1), " \t"))) {
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
    const std::size_t end = isSized ? letter + 3 : isAmong(at(i), "fFlLhHd") ? i + 1 : i;
    return isNamePart(at(end)) ? i : end;
  }

  static std::string_view lastPart(std::string_view name) { return name.substr(name.rfind('.') + 1); }
  static bool isUnionName(std::string_view name) { return name.size() == 1 && isAmong(name[0], kUnionNames); }

  void key(std::string_view name) {
    const std::string_view last = lastPart(name);
    if (isIndex(last))
      emit(Kind::index, last, name.substr(0, name.size() - last.size() - (last.size() < name.size() ? 1 : 0)));
    else
      emit(isUnionName(last) ? Kind::alias : Kind::key, name);
  }

  /// "World to Camera Transform:": of a line that has but words up to a colon the last four.
  std::string_view phrase(std::size_t begin, std::size_t end) const {
    constexpr std::size_t kLongest = 200;
    std::size_t first = begin, words = 1;
    for (std::size_t start = begin; begin - start < kLongest; ++words) {
      if (words <= 4) first = start;
      const std::size_t word = start == 0 ? kNone : t_.find_last_not_of(" \t", start - 1);
      if (word == kNone || isAmong(t_[word], "\n>*#/-]")) return t_.substr(first, end - first);
      if (word + 1 == start || !(isNamePart(t_[word]) || t_[word] == '.')) break;
      for (start = word; start > 0 && (isNamePart(t_[start - 1]) || isAmong(t_[start - 1], ".-"));) --start;
      if (!isNameStart(t_[start])) break;
    }
    return t_.substr(begin, end - begin);
  }

  void word() {
    const std::size_t begin = at_;
    const bool isLatex = begin > 0 && t_[begin - 1] == '\\';
    const auto goesOn = [&](std::size_t i) { return isNamePart(at(i)) || at(i) == '.'; };
    while (goesOn(at_) || (follows("::") && goesOn(at_ + 2))) at_ += follows("::") ? 2 : 1;
    const std::string_view w = t_.substr(begin, at_ - begin), last = lastPart(w);
    if (isLatex) {
      for (const std::string_view operation : {"frac", "times", "cdot", "sqrt", "sin", "cos", "tan", "pm"})
        if (w.starts_with(operation)) return emit(Kind::word);
      return;
    }
    skipTemplate();
    if (const std::size_t end = afterDigits(at_ + 1);
        at(at_) == '(' && end > at_ + 1 && at(end) == ')' &&
        (lineEndsAt(end + 1) || isAmong(at(afterBlanks(end + 1)), "[{"))) {
      at_ = end + 1;  // Array(16) [
      return;
    }
    const std::string name = lower(w);
    if (isPlace(last)) return;
    const std::size_t wordEnd = at_;
    if (follows("()")) at_ += 2;  // view() =
    if (assignment(begin, w)) return;
    at_ = wordEnd;
    if (isAmong(at(at_), "([{") && indexEnd(at_) == kNone) return emit(Kind::callee, w);
    // What a switch names is no number.
    if (isOneOf(name, {"true", "false"}) && !out_.empty() && out_.back().kind == Kind::key)
      out_.back().kind = Kind::word;
    const std::size_t next = afterBlanks(at_), digits = afterDigits(next);
    if (isOneOf(name, {"row", "col", "column", "line"}) && digits > next && isAmong(at(digits), " \t:")) {
      at_ = digits;
      return emit(Kind::index);
    }
    if (isOneOf(name, {"column", "columns"}) && digits > next) return emit(Kind::key, kColumnsApart);
    const bool isBeforeEntry = (next > at_ && isAmong(at(next), "|-+.0123456789([{")) ||
                               at(afterBlanks(at_ + (at(at_) == ',' ? 1 : 0))) == '"';
    if (isIndex(last) && w.size() > 1 && isBeforeEntry) return key(w);
    if (!isType(w)) emit(Kind::word);
  }

  /// scene.cpp:214 and main.rs:88:5, which name no numbers.
  bool isPlace(std::string_view ending) {
    const bool isSource = isOneOf(ending, {"c", "cc", "cpp", "cxx", "h", "hpp", "m", "mm", "rs", "go", "py", "js", "ts",
                                           "java", "kt", "cs", "swift"});
    if (!isSource || ending.data() == t_.data() || ending.data()[-1] != '.' || at(at_) != ':' || !isDigit(at(at_ + 1)))
      return false;
    while (at(at_) == ':' && isDigit(at(at_ + 1))) at_ = afterDigits(at_ + 1);
    emit(Kind::word);
    return true;
  }

  /// vec4<f32>
  void skipTemplate() {
    std::size_t i = at_ + (at(at_) == ' ' ? 1 : 0);
    if (at(i) != '<') return;
    for (++i; isNamePart(at(i)) || isAmong(at(i), " \t,:*");) ++i;
    if (at(i) == '>') at_ = i + 1;
  }

  /// name =, name[2] = and "name": of a word that has been read.
  bool assignment(std::size_t begin, std::string_view w) {
    std::size_t end = at_;
    for (std::size_t next = indexEnd(end); next != kNone; next = indexEnd(end)) end = afterBlanks(next);
    const std::string_view indices = t_.substr(at_, end - at_), last = lastPart(w);
    const std::size_t mark = afterBlanks(end + (isAmong(at(end), "'\"") ? 1 : 0));
    const bool isShort = at(mark) == ':' && at(mark + 1) == '=', isColon = at(mark) == ':' && !isShort;
    end = mark + (isShort ? 2 : 1);
    if (!isAmong(at(mark), ":=") || isAmong(at(end), ":=")) return false;
    const std::size_t wordEnd = at_;
    at_ = end;
    if (!indices.empty() && afterBlanks(end) < t_.size() && !isAmong(at(afterBlanks(end)), "({[\n"))
      emit(Kind::index, indices, w);
    else
      key(isColon && !isIndex(last) && !isUnionName(last) ? phrase(begin, wordEnd) : w);
    return true;
  }

  std::string_view t_;
  std::size_t at_ = 0, line_ = 1, closing_ = kNone;
  std::vector<Token> out_;
};

}  // namespace

std::vector<Token> tokensOf(std::string_view text) { return Scanner(text).tokens(); }

}  // namespace viewproj::cmd::pasted
