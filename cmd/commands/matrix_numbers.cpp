#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/read_convention.hpp"
#include "commands/inspect_report.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

bool isOneOf(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isWordStart(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool isWord(char c) { return isWordStart(c) || isDigit(c) || c == '.'; }

// ---- JSON

/// Of a value of an object; nothing for one that is no matrix and stands beside them.
std::optional<WrittenMatrix> matrixOf(const std::string& key, const Json& value, const std::string& source) {
  if (!value.is_array() || value.empty()) return std::nullopt;
  const bool nested = value.front().is_array();
  WrittenMatrix m{visible(key), {}, nested ? NumberOrder::rows : NumberOrder::memory};
  bool isGood = true;  // numbers, in rows of one length
  const auto gather = [&](const Json& entry) {
    isGood = isGood && entry.is_number();
    if (isGood) m.numbers.push_back(entry.get<double>());
  };
  for (const Json& row : value) {
    isGood = isGood && row.is_array() == nested && row.size() == value.front().size();
    std::for_each(row.begin(), row.end(), gather);  // of a number itself
  }
  const auto is = [&](std::size_t rows, std::size_t columns) {
    return isGood && m.numbers.size() == rows * columns && (!nested || value.size() == rows);
  };
  const bool isK = is(3, 3);
  if (isK && (m.numbers[3] != 0 || m.numbers[6] != 0 || m.numbers[7] != 0)) return std::nullopt;  // a rotation
  if (!isK && !is(3, 4) && !is(4, 4)) {
    if (!nested || value.size() == 1 || value.front().size() == 1)
      return std::nullopt;  // a vector, the coefficients of a lens
    throw InputError(source + ": " + visible(key) +
                     ": expected 16 numbers or 4 rows of 4; or 3 rows of 3 or 4, a calibration");
  }
  return m;
}

/// json: without comments. name: of its file, for messages.
WrittenMatrices parseObject(const std::string& json, const std::string& name) {
  const Document document = load(json, name);  // says what is wrong with it
  WrittenMatrices result;
  JsonParts parts(std::string_view(json).substr(json.find('{')));
  while (const auto part = parts.next()) {  // in the order of the text
    const std::string key = unescaped(part->key);
    if (auto m = matrixOf(key, document.root->at(key), name)) result.matrices.push_back(std::move(*m));
  }
  if (result.matrices.empty()) throw InputError(name + ": has no matrix: no value of 16 numbers or 4 rows of 4");
  if (const auto convention = Node(document).find("convention")) {
    result.convention = readConvention(document).convention;
  }
  return result;
}

// ---- Text

/// Reads one text from front to back; numbers gather until they are sixteen.
class Scanner {
 public:
  Scanner(const std::string& text, const std::string& source) : text_(text), source_(source) {}

  /// Whether a number has the suffix of a float.
  bool hasFloats() const { return hasFloats_; }

  std::vector<WrittenMatrix> matrices() {
    while (at_ < text_.size()) step();
    finish();
    if (found_.empty()) fail(0, "has no numbers; expected the 16 of a matrix");
    return std::move(found_);
  }

 private:
  struct Gathered {
    double value;
    std::size_t line, group, offset;
  };

  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    throw InputError(place(source_, positionAt(text_, offset)) + ": " + visible(message));
  }

  bool follows(std::string_view word) const { return text_.compare(at_, word.size(), word) == 0; }
  std::size_t after(const char* word) const {
    const std::size_t found = text_.find(word, at_);
    return found == std::string::npos ? text_.size() : found + std::string_view(word).size();
  }

  void step() {
    const char c = text_[at_];
    const bool isFirst = lineIsEmpty_;
    if (c == '\n') {
      ++line_;
      lineIsEmpty_ = true;
    } else if (!isOneOf(c, " \t\r\v\f")) {
      lineIsEmpty_ = false;
    }
    if (follows("//") || c == '#') {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      if (c == '#' && isFirst) heading(text_.substr(at_ + 1, end - at_ - 1));
      at_ = end;
    } else if (follows("/*")) {
      const std::size_t end = after("*/");
      line_ += static_cast<std::size_t>(std::count(&text_[at_], &text_[0] + end, '\n'));
      at_ = end;
    } else if (follows("::")) {  // of a namespace, whose word is no name: glm::mat4
      at_ += 2;
    } else if (c == '=' || c == ':') {
      // What stood before was a declaration: float m[4][4] =
      if (!areArraySizes()) finish();
      gathered_.clear();
      name_ = word_;
      ++at_;
    } else if (isOneOf(c, "{[(")) {
      if (c == '{' && depth_ == 0 && areArraySizes()) gathered_.clear();  // float m[16]{
      ++depth_;
      ++group_;
      ++at_;
    } else if (isOneOf(c, "}])")) {
      if (depth_ > 0) --depth_;
      ++group_;
      ++at_;
    } else if (isOneOf(c, " \t\r\v\f\n,|;")) {
      if (c == ';') ++group_;  // a row of MATLAB's
      ++at_;
    } else if (isWordStart(c)) {
      word();
    } else if (isDigit(c) || isOneOf(c, ".+-")) {
      number();
    } else {
      std::size_t end = at_ + 1;
      while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
      fail(at_, "'" + text_.substr(at_, end - at_) + "' was not expected in a matrix of 16 numbers");
    }
  }

  /// As in m[4][4].
  bool areArraySizes() const {
    return std::all_of(gathered_.begin(), gathered_.end(), [](const Gathered& g) {
      return g.value > 0 && g.value <= 16 && g.value == std::floor(g.value);
    });
  }

  void heading(const std::string& text) {
    finish();
    const std::size_t begin = text.find_first_not_of("# \t\r"), end = text.find_last_not_of(" \t\r");
    name_ = begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
  }

  void word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && isWord(text_[at_])) ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    std::string lower = word;
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (lower == "nan" || lower == "inf" || lower == "infinity") fail(begin, "'" + word + "' is not a finite number");
    if (depth_ == 0) word_ = word;
    if (at_ < text_.size() && text_[at_] == '<') at_ = after(">");
  }

  void number() {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && (isWord(text_[at_]) || (isOneOf(text_[at_], "+-") && isOneOf(text_[at_ - 1], "eE"))))
      ++at_;
    const std::string token = text_.substr(begin, at_ - begin);
    const std::string digits = token.substr(0, token.find_last_not_of("fFlLhH") + 1);
    const auto value = parseNumber(digits);
    if (!value || digits.size() + 2 < token.size()) fail(begin, "'" + token + "' is not a finite number");
    hasFloats_ = hasFloats_ || isOneOf(token.back(), "fF");
    gathered_.push_back({*value, line_, group_, begin});
    if (gathered_.size() == 16) flush(isInRows(4, 4) ? NumberOrder::rows : NumberOrder::memory);
  }

  /// So many rows, each on a line or in brackets of its own.
  bool isInRows(std::size_t rows, std::size_t columns) const {
    const auto isBy = [&](std::size_t Gathered::*key) {
      for (std::size_t i = 1; i < rows * columns; ++i)
        if ((gathered_[i].*key != gathered_[i - 1].*key) != (i % columns == 0)) return false;
      return true;
    };
    return gathered_.size() == rows * columns && (isBy(&Gathered::line) || isBy(&Gathered::group));
  }

  void flush(NumberOrder order) {
    WrittenMatrix& m = found_.emplace_back(
        WrittenMatrix{name_.empty() ? "matrix " + std::to_string(found_.size() + 1) : visible(name_), {}, order});
    for (const Gathered& g : gathered_) m.numbers.push_back(g.value);
    gathered_.clear();
    name_.clear();
    word_.clear();
  }

  /// A matrix ends here: what has gathered is a calibration, or too little.
  void finish() {
    const std::size_t count = gathered_.size();
    if (count == 0) return;
    const bool isFlat = count > 0 && gathered_.front().line == gathered_.back().line &&
                        gathered_.front().group == gathered_.back().group;
    if (isInRows(3, 3) || isInRows(3, 4) || (isFlat && (count == 9 || count == 12))) return flush(NumberOrder::rows);
    if (name_ == "eye" && count == 3) return gathered_.clear();  // beside matrices relative to the eye
    const std::string numbers = std::to_string(count) + (count == 1 ? " number" : " numbers");
    if (found_.empty() || !name_.empty())
      fail(gathered_.back().offset,
           (name_.empty() ? "" : name_ + ": ") + "ends after " + numbers + "; a matrix has 16");
    fail(gathered_.front().offset, "has " + numbers + " more than matrices of 16 each");
  }

  const std::string& text_;
  const std::string& source_;
  std::size_t at_ = 0, line_ = 0, group_ = 0, depth_ = 0;
  bool lineIsEmpty_ = true, hasFloats_ = false;
  std::string word_, name_;
  std::vector<Gathered> gathered_;
  std::vector<WrittenMatrix> found_;
};

}  // namespace

WrittenMatrices parseMatrices(const std::string& given, const std::string& source) {
  requireNarrow(source, given);
  const std::string text(withoutByteOrderMark(given));
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') {
    std::string blank = text;
    blankComments(blank);
    const std::size_t second = blank.find_first_not_of(" \t\r\n", first + 1);
    if (second != std::string::npos && isOneOf(blank[second], "\"}")) return parseObject(blank, source);
  }
  const auto has = [&](const char* word) { return text.find(word) != std::string::npos; };
  Scanner scanner(text, source);
  std::vector<WrittenMatrix> matrices = scanner.matrices();
  return {std::move(matrices), std::nullopt, scanner.hasFloats() || has("float") || has("mat4") || has("f32")};
}

}  // namespace viewproj::cmd
