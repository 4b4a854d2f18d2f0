#include "input/matrix_scanner.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "input/written_digits.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool isWordStart(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool isWord(char c) { return isWordStart(c) || isDigit(c) || c == '.'; }
bool isSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Reads one text from front to back; numbers gather until they are sixteen.
class Scanner {
 public:
  Scanner(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  std::vector<WrittenMatrix> matrices() {
    while (at_ < text_.size()) step();
    if (!brackets_.empty()) fail(brackets_.back(), std::string("'") + text_[brackets_.back()] + "' is never closed");
    requireNothingGathered();
    if (found_.empty()) fail(0, "has no numbers; expected the 16 of a matrix");
    return std::move(found_);
  }

 private:
  struct Gathered {
    WrittenNumber number;
    std::size_t line, group, offset;
  };

  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    throw InputError(place(file_, positionAt(text_, offset)) + ": " + visible(message));
  }

  void step() {
    const char c = text_[at_];
    const std::string_view rest = std::string_view(text_).substr(at_);
    if (c == '\n') {
      ++line_;
      ++at_;
      lineIsEmpty_ = true;
      return;
    }
    const bool first = lineIsEmpty_;
    if (!isSpace(c)) lineIsEmpty_ = false;
    if (isSpace(c) || c == ',' || c == '|') {
      ++at_;
    } else if (c == ';') {
      if (brackets_.empty())
        word_.clear();
      else
        ++group_;  // a row of MATLAB's
      ++at_;
    } else if (c == '#') {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      if (first) heading(text_.substr(at_ + 1, end - at_ - 1));
      at_ = end;
    } else if (rest.starts_with("//")) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (rest.starts_with("/*")) {
      const std::size_t end = text_.find("*/", at_);
      if (end == std::string::npos) fail(at_, "'/*' is never closed");
      line_ += static_cast<std::size_t>(
          std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(end - at_), '\n'));
      at_ = end + 2;
    } else if (rest.starts_with("::")) {  // of a namespace, whose word is no name: glm::mat4
      at_ += 2;
    } else if (c == '=' || c == ':') {
      // What stood before was a declaration: float m[4][4] =
      if (!areArraySizes()) requireNothingGathered();
      gathered_.clear();
      name_ = word_;
      ++at_;
    } else if (c == '{' || c == '[' || c == '(') {
      if (c == '{' && brackets_.empty() && areArraySizes()) gathered_.clear();  // float m[16]{
      brackets_.push_back(at_++);
      ++group_;
    } else if (c == '}' || c == ']' || c == ')') {
      close(c);
    } else if (isWordStart(c)) {
      word();
    } else if (isDigit(c) || c == '.' || c == '-' || c == '+') {
      number();
    } else {
      fail(at_, "'" + character() + "' was not expected in a matrix of 16 numbers");
    }
  }

  /// As in m[4][4].
  bool areArraySizes() const {
    return std::all_of(gathered_.begin(), gathered_.end(), [](const Gathered& g) {
      return g.number.value > 0 && g.number.value <= 16 && g.number.value == std::floor(g.number.value);
    });
  }

  void close(char c) {
    const char opening = c == '}' ? '{' : c == ']' ? '[' : '(';
    if (brackets_.empty()) fail(at_, std::string("'") + c + "' closes nothing");
    if (text_[brackets_.back()] != opening)
      fail(at_, std::string("'") + c + "' closes a '" + text_[brackets_.back()] + "'");
    brackets_.pop_back();
    ++group_;
    ++at_;
  }

  void heading(const std::string& text) {
    requireNothingGathered();
    const std::size_t begin = text.find_first_not_of("# \t\r");
    const std::size_t end = text.find_last_not_of(" \t\r");
    name_ = begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
  }

  void word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && isWord(text_[at_])) ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    const std::string lower = lowered(word);
    if (lower == "nan" || lower == "inf" || lower == "infinity") fail(begin, "'" + word + "' is not a finite number");
    if (brackets_.empty()) word_ = word;
    if (at_ < text_.size() && text_[at_] == '<') at_ = std::min(text_.find('>', at_), text_.size() - 1) + 1;
  }

  void number() {
    const std::size_t begin = at_;
    if (text_[at_] == '+' || text_[at_] == '-') ++at_;
    while (at_ < text_.size() &&
           (isWord(text_[at_]) || ((text_[at_] == '+' || text_[at_] == '-') && std::tolower(text_[at_ - 1]) == 'e')))
      ++at_;
    const std::string token = text_.substr(begin, at_ - begin);
    std::string digits = token;
    while (!digits.empty() && std::string_view("fFlLhH").find(digits.back()) != std::string_view::npos)
      digits.pop_back();
    const auto value = parseNumber(digits);
    if (!value || digits.size() + 2 < token.size()) fail(begin, "'" + token + "' is not a finite number");
    gathered_.push_back({writtenNumber(digits, *value), line_, group_, begin});
    if (gathered_.size() == 16) flush();
  }

  template <class Key>
  bool fourByFour(Key key) const {
    for (std::size_t i = 0; i < 16; ++i)
      if (i % 4 != 0 ? key(i) != key(i - 1) : i > 0 && key(i) == key(i - 1)) return false;
    return true;
  }

  void flush() {
    WrittenMatrix m;
    m.name = visible(name_);
    std::array<WrittenNumber, 16> numbers;
    for (std::size_t i = 0; i < 16; ++i) numbers[i] = gathered_[i].number;
    setNumbers(m, numbers);
    if (fourByFour([&](std::size_t i) { return gathered_[i].line; }) ||
        fourByFour([&](std::size_t i) { return gathered_[i].group; }))
      m.order = NumberOrder::rows;
    found_.push_back(m);
    gathered_.clear();
    name_.clear();
    word_.clear();
  }

  /// Of three rows, on lines or in brackets of their own or all in one.
  bool isOfThreeRows() const {
    const std::size_t count = gathered_.size(), columns = count / 3;
    if (count != 9 && count != 12) return false;
    const auto is = [&](const auto& key) {
      bool rows = true, flat = true;
      for (std::size_t i = 1; i < count; ++i) {
        const bool isNew = key(gathered_[i]) != key(gathered_[i - 1]);
        rows = rows && isNew == (i % columns == 0);
        flat = flat && !isNew;
      }
      return std::pair(rows, flat);
    };
    const auto [byLine, oneLine] = is([](const Gathered& g) { return g.line; });
    const auto [byGroup, oneGroup] = is([](const Gathered& g) { return g.group; });
    return byLine || byGroup || (oneLine && oneGroup);
  }

  void flushCalibration() {
    WrittenMatrix m;
    m.name = visible(name_);
    m.isCalibration = true;
    m.columns = gathered_.size() / 3;
    std::array<WrittenNumber, 16> numbers;
    for (std::size_t i = 0; i < gathered_.size(); ++i) numbers[i] = gathered_[i].number;
    setNumbers(m, numbers);
    found_.push_back(m);
    gathered_.clear();
    name_.clear();
  }

  void requireNothingGathered() {
    const std::size_t count = gathered_.size();
    if (count == 0) return;
    if (isOfThreeRows()) return flushCalibration();
    if (name_ == "eye" && count == 3) {  // beside matrices relative to the eye
      gathered_.clear();
      return;
    }
    const std::string what = std::to_string(count) + (count == 1 ? " number" : " numbers");
    if (found_.empty() || !name_.empty())
      fail(gathered_.back().offset, (name_.empty() ? "" : name_ + ": ") + "ends after " + what + "; a matrix has 16");
    fail(gathered_.front().offset,
         "has " + what + " more than " + (found_.size() == 1 ? "the 16 of a matrix" : "matrices of 16 each"));
  }

  /// The character at hand, of one byte or more.
  std::string character() const {
    std::size_t end = at_ + 1;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
    return text_.substr(at_, end - at_);
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0, line_ = 0, group_ = 0;
  bool lineIsEmpty_ = true;
  std::vector<std::size_t> brackets_;
  std::string word_, name_;
  std::vector<Gathered> gathered_;
  std::vector<WrittenMatrix> found_;
};

/// Throws at numbers as 1,5 beside others, separated by blanks: a comma would come between two.
void requireDecimalPoints(const std::string& text, const std::string& name) {
  constexpr std::string_view kBetween = " \t\r\n;|[](){}";
  std::size_t withComma = 0, first = 0;
  for (std::size_t at = 0; (at = text.find_first_not_of(kBetween, at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
    const std::string_view word = std::string_view(text).substr(at, end - at);
    const std::size_t comma = word.find(',');
    if (comma != std::string_view::npos) {
      if (comma == 0 || comma + 1 == word.size() || !isDigit(word[comma - 1]) || !isDigit(word[comma + 1]) ||
          word.find_first_of(",.", comma + 1) != std::string_view::npos)
        return;
      if (withComma++ == 0) first = at + comma;
    } else if (word.find('.') != std::string_view::npos) {
      return;
    }
    at = end;
  }
  constexpr std::size_t kFewest = 4;
  if (withComma >= kFewest)
    throw InputError(place(name, positionAt(text, first)) +
                     ": a comma separates numbers here; of decimal commas tr , . makes points");
}

}  // namespace

std::vector<WrittenMatrix> scanMatrices(const std::string& text, const std::string& name) {
  requireDecimalPoints(text, name);
  return Scanner(text, name).matrices();
}

}  // namespace viewproj::cmd
