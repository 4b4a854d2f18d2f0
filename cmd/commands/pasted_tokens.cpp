// Plain text to tokens: numbers, brackets, names and indices; what is none of them is a word, or nothing.
#include <algorithm>
#include <limits>
#include <regex>

#include "commands/pasted_parts.hpp"

namespace viewproj::cmd::pasted {
namespace {

constexpr auto kIgnoreCase = std::regex::ECMAScript | std::regex::icase;

/// What is matched at one place, and looks no further than a line or so.
struct Patterns {
  std::regex bracketIndex{
      R"(\[[ \t]*(?:\d*[ \t]*,?|,[ \t]*\d+)[ \t]*\]|\[[ \t]*\d+[ \t]*,[ \t]*\d+[ \t]*\](?=[ \t]*[:=]))"};
  /// m00, _11, row1, x, x_axis, 0: what may stand in front of an entry or a row.
  std::regex indexName{R"((?:row|column|col|line|[rcmMeaEA_])_?\d[\d_,]*|[xyzwoXYZWO]|[xyzw]_?axis|\d+)"};
  /// A second name of x, y, z, w in a union.
  std::regex unionName{"[rgbastpq]"};
  std::regex type{R"((?:system\.)?(?:const|new|float|double|half|single|u?int|(?:float|f)(?:32|64))|)"
                  R"(d?(?:vec|mat|float|double)\d(?:x\d)?)",
                  kIgnoreCase};
  std::regex tag{R"(<(/?)([A-Za-z!?][\w:.-]*)[^<>()\[\]{}\n]*>)"};
  /// Tags that only lay a page out.
  std::regex html{"br|p|t[drh]|li|span|b|i|code|pre|div|em|font|mn|mt[dr]|su[bp]", kIgnoreCase};
  std::regex repeats{R"(<repeats (\d{1,9}) times>)"};
  /// A cell of CSV with three numbers or more, up to its closing quote.
  std::regex cell{R"("[-+eE,; \t]*(?:[\d.]+[-+eE,; \t]+){2,}[\d.]+[-+eE,; \t]*(?="))"};
  std::regex notFinite{R"([-+]?(?:nan(?:\([^)\n]*\))?|inf(?:inity)?|1\.#(?:inf|[qs]nan|ind)0*)(?![\w.]))", kIgnoreCase};
  std::regex address{"0[xX][0-9a-fA-F]*"};
  std::regex suffix{R"((?:_?f(?:32|64)|[fFlLhHd])(?!\w))"};
  std::regex factor{R"([ \t]*\*(?=[ \t]*[\n\[]))"};
  std::regex whole{R"(\.?\d+)"};
  /// Behind 3 of 3: 1.5, but not of a time of day.
  std::regex entryMark{R"((?!:\d\d(?![\d.]))['"]?[ \t]*[:=](?![:=]))"};
  /// Behind the beginning of a word or an expression: 1200x800, 50%, 09:12, 2 * x, 1 - 2.
  std::regex noNumber{R"([\w.%/^+*-]|:\d\d|[ \t]*[*/^]|[ \t]+[-+][ \t])"};
  std::regex restOfWord{R"([^ \t\n\v\f,;|()\[\]{}<>"']+)"};
  std::regex latexWord{"frac|times|cdot|sqrt|sin|cos|tan|pm"};
  std::regex templated{R"( ?<[\w \t,:*]*>)"};             // of vec4<f32>
  std::regex sized{R"(\(\d+\)(?=[ \t]*(?:[\[{\n]|$)))"};  // of Array(16) [
  std::regex rowName{"row|col|column|line", kIgnoreCase};
  std::regex rowNumber{R"([ \t]*\d+(?=[ \t:]))"};
  std::regex columns{"columns?", kIgnoreCase};
  std::regex number{R"([ \t]*\d)"};
  /// Of name =, name[2] =, "name": and name :=
  std::regex assignment{R"(((?:\[[ \t]*\d*[ \t]*,?[ \t]*\d*[ \t]*\][ \t]*)*)['"]?[ \t]*(:=|:|=)(?![:=]))"};
  std::regex valueBehind{R"([ \t]*[^ \t({\[\n])"};
  std::regex entryBehind{R"([ \t]+[-|+.\d(\[{]|,?[ \t]*")"};
  /// |---|---| and +---+---+
  std::regex tableRule{R"([-:= \t]*[|+][-|+:= \t]*(?=\n|$))"};
  std::regex lineEnd{R"([ \t]*(?=\n|$))"};
};

const Patterns& patterns() {
  static const Patterns all;
  return all;
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
      if (c == '\n') {
        ++line_;
        ++at_;
        isLineStart = true;
        if (const std::size_t end = after(k_.tableRule, at_); end != kNone && take(end).find("--") != kNone)
          emit(Kind::tableRule);
      } else if (isLineStart && (isAmong(c, "*>") || (isAmong(c, "+-") && isSpaceOrEnd(at_ + 1)))) {
        ++at_;
      } else if (t_.substr(at_, 3) == "...") {  // a prompt at the start of a line, a continuation at its end
        if (isLineStart == (after(k_.lineEnd, at_ + 3) != kNone)) emit(Kind::elided);
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
  bool isSpaceOrEnd(std::size_t i) const { return i >= t_.size() || isSpace(t_[i]); }

  /// Where a pattern ends that begins at `begin`; kNone if none does. found_ has its parts.
  std::size_t after(const std::regex& pattern, std::size_t begin) {
    constexpr std::size_t kWindow = 2000;  // std::regex needs stack for each character
    const std::string_view window = t_.substr(std::min(begin, t_.size()), kWindow);
    const char* const first = window.data();
    const bool fits =
        std::regex_search(first, first + window.size(), found_, pattern, std::regex_constants::match_continuous);
    return fits ? begin + static_cast<std::size_t>(found_.length()) : kNone;
  }
  static bool is(std::string_view word, const std::regex& pattern) {
    constexpr std::size_t kLongest = 40;
    return word.size() < kLongest && std::regex_match(word.begin(), word.end(), pattern);
  }
  std::string_view part(std::size_t i) const { return {found_[i].first, static_cast<std::size_t>(found_[i].length())}; }

  void emit(Kind kind, std::string_view text = {}, std::string_view label = {}, double value = 0) {
    out_.push_back({kind, line_, text, label, value});
  }
  std::string_view take(std::size_t end) {
    const std::string_view taken = t_.substr(at_, end - at_);
    at_ = end;
    return taken;
  }

  void step(char c) {
    if (c == '"') quote();
    if (c == '<' && tag()) return;
    std::size_t end = kNone;
    if (c == '[' && (end = after(k_.bracketIndex, at_)) != kNone) {
      emit(Kind::index, take(end));
    } else if (isAmong(c, "-+nNiI1") && (end = after(k_.notFinite, at_)) != kNone) {
      emit(Kind::number, take(end), {}, std::numeric_limits<double>::quiet_NaN());
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

  void quote() {
    if (at_ == closing_) return emit(Kind::close);
    const std::size_t end = after(k_.cell, at_);
    if (end == kNone) return;
    emit(Kind::open);
    closing_ = end;
  }

  bool tag() {
    if (const std::size_t end = after(k_.repeats, at_); end != kNone) {
      emit(Kind::repeat, {}, {}, valueOf(part(1)));
      at_ = end;
      return true;
    }
    const std::size_t end = after(k_.tag, at_);
    if (end == kNone) return false;
    const std::string_view name = part(2);
    const bool isEnd = !part(1).empty(), isOpening = !isAmong(t_[end - 2], "/?");
    at_ = end;
    if (is(name, k_.html)) return true;
    if (isEnd) {
      emit(Kind::close);
      emit(Kind::word);
    } else {
      key(name);
      if (isOpening) emit(Kind::open);
    }
    return true;
  }

  void number() {
    if (const std::size_t end = after(k_.address, at_); end != kNone && end > at_) {
      if (!out_.empty() && out_.back().kind == Kind::key) out_.back().kind = Kind::word;  // it names no numbers
      at_ = end;
      return;
    }
    const std::size_t digitsEnd = numberEnd(t_, at_), suffixEnd = after(k_.suffix, digitsEnd);
    const std::size_t end = suffixEnd == kNone ? digitsEnd : suffixEnd;
    const std::string_view digits = t_.substr(at_, digitsEnd - at_);
    if (const std::size_t factorEnd = after(k_.factor, end); factorEnd != kNone && end == digitsEnd) {
      emit(Kind::factor, digits, {}, valueOf(digits));
      at_ = factorEnd;
    } else if (end == digitsEnd && is(digits, k_.whole) && after(k_.entryMark, end) != kNone) {
      emit(Kind::index, take(end));
    } else if (isNamePart(at(end)) || after(k_.noNumber, end) != kNone) {
      at_ = after(k_.restOfWord, at_);
      emit(Kind::word);
    } else {
      emit(Kind::number, digits, {}, valueOf(digits));
      at_ = end;
    }
  }

  static std::string_view lastPart(std::string_view name) { return name.substr(name.rfind('.') + 1); }

  void key(std::string_view name) {
    const std::string_view last = lastPart(name);
    if (is(last, k_.indexName))
      emit(Kind::index, last, name.substr(0, name.size() - last.size() - (last.size() < name.size() ? 1 : 0)));
    else
      emit(is(last, k_.unionName) ? Kind::alias : Kind::key, name);
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
    const auto goesOn = [&](std::size_t i) { return isNamePart(at(i)) || at(i) == '.'; };
    const auto isScope = [&] { return at(at_) == ':' && at(at_ + 1) == ':' && goesOn(at_ + 2); };
    while (goesOn(at_) || isScope()) at_ += isScope() ? 2 : 1;
    const std::string_view w = t_.substr(begin, at_ - begin), last = lastPart(w);
    if (begin > 0 && t_[begin - 1] == '\\') {
      if (after(k_.latexWord, begin) != kNone) emit(Kind::word);
      return;
    }
    std::size_t end = kNone;
    if ((end = after(k_.templated, at_)) != kNone) at_ = end;
    if ((end = after(k_.sized, at_)) != kNone) {
      at_ = end;
    } else if (isAmong(at(at_), "([{") && after(k_.bracketIndex, at_) == kNone) {
      emit(Kind::callee, w);
    } else if (assignment(begin, w)) {
      return;
    } else if (is(w, k_.rowName) && (end = after(k_.rowNumber, at_)) != kNone) {
      at_ = end;
      emit(Kind::index);
    } else if (is(w, k_.columns) && after(k_.number, at_) != kNone) {
      emit(Kind::key, kColumnsApart);
    } else if (is(last, k_.indexName) && w.size() > 1 && after(k_.entryBehind, at_) != kNone) {
      key(w);
    } else if (!is(w, k_.type)) {
      emit(Kind::word);
    }
  }

  /// name =, name[2] = and "name": of a word that has been read.
  bool assignment(std::size_t begin, std::string_view w) {
    const std::size_t end = after(k_.assignment, at_), wordEnd = at_;
    if (end == kNone) return false;
    const std::string_view indices = part(1), sign = part(2), last = lastPart(w);
    at_ = end;
    if (!indices.empty() && after(k_.valueBehind, end) != kNone)
      emit(Kind::index, indices, w);
    else
      key(sign == ":" && !is(last, k_.indexName) && !is(last, k_.unionName) ? phrase(begin, wordEnd) : w);
    return true;
  }

  const Patterns& k_ = patterns();
  std::string_view t_;
  std::size_t at_ = 0, line_ = 1, closing_ = kNone;
  std::cmatch found_;
  std::vector<Token> out_;
};

}  // namespace

std::vector<Token> tokensOf(std::string_view text) { return Scanner(text).tokens(); }

}  // namespace viewproj::cmd::pasted
