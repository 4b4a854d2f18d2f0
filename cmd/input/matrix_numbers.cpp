#include "input/matrix_numbers.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "camera/camera.hpp"
#include "input/convention_fields.hpp"
#include "input/document.hpp"
#include "text/encoding.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/parse_number.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {

using namespace detail;
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

/// A number as it was typed.
struct Typed {
  double value = 0;
  int significant = 0;  ///< digits from the first that is not 0 on
  int decimals = 0;     ///< the place of the last digit is 10^-decimals
  int exponent = 0;     ///< that of the first digit
};

/// text: a number that parseNumber takes.
Typed typedNumber(std::string_view text, double value) {
  Typed number{.value = value};
  bool fraction = false;
  std::size_t at = text.find_first_of("0123456789.");
  for (; at < text.size() && (isDigit(text[at]) || text[at] == '.'); ++at) {
    if (text[at] == '.') {
      fraction = true;
      continue;
    }
    if (fraction) ++number.decimals;
    if (number.significant > 0 || text[at] != '0') ++number.significant;
  }
  if (at + 1 < text.size()) {
    const auto power = parseNumber(text.substr(at + 1));
    number.decimals -= static_cast<int>(std::clamp(power.value_or(0), -1000.0, 1000.0));
  }
  number.exponent = number.significant - 1 - number.decimals;
  return number;
}

/// What the digits of sixteen numbers are worth: half a unit of the finest place that the matrix shows, or of the last
/// of as many digits as its longest number has; with as many as float32s have, also what these round away. 0, 1 and -1
/// are what they are, unless written out.
void setDigits(WrittenMatrix& m, const std::array<Typed, 16>& numbers) {
  int finest = 0;
  for (const Typed& number : numbers) {
    m.digits = std::max(m.digits, number.significant);
    finest = std::max(finest, number.decimals);
  }
  for (std::size_t i = 0; i < 16; ++i) {
    const auto& [value, significant, decimals, exponent] = numbers[i];
    m.numbers[i] = value;
    const bool isWord = value == 0 || std::fabs(value) == 1;
    const bool isWrittenOut = (finest > 1 && decimals == finest) || (value != 0 && significant > 2);
    if (isWord && !isWrittenOut) continue;
    const double ofPlace = std::pow(10.0, -finest);
    const double ofDigits = value == 0 ? 0 : std::pow(10.0, exponent - m.digits + 1);
    m.within[i] = std::max(ofPlace, ofDigits) / 2;
    if (mayBeFloats(m)) {
      const float narrow = std::fabs(static_cast<float>(value));
      m.within[i] = std::max(m.within[i], static_cast<double>(std::nextafter(narrow, HUGE_VALF) - narrow) / 2);
    }
  }
}

/// A row and a column, from 0 or from 1.
struct Cell {
  int row, column;
};

/// What a label says: m01, M12, _44.
std::optional<Cell> cellOf(std::string_view word) {
  constexpr int kMost = 4;
  if (word.size() < 3 || isDigit(word[word.size() - 3])) return std::nullopt;
  const Cell cell{word[word.size() - 2] - '0', word[word.size() - 1] - '0'};
  if (!isDigit(word[word.size() - 2]) || !isDigit(word.back()) || cell.row > kMost || cell.column > kMost)
    return std::nullopt;
  return cell;
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
    Typed number;
    std::size_t line, group, offset;
    std::optional<Cell> cell;  ///< as a label says: M12:
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
    // About a print of an object.
    const bool isAngle = c == '>' || (c == '<' && at_ + 1 < text_.size() && isWordStart(text_[at_ + 1]));
    const bool endsLabel = (c == '=' || c == ':') && label_;
    if (isSpace(c) || c == ',' || c == '|' || isAngle || endsLabel) {
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
    } else if (c == '=' || c == ':') {
      // What stood before was a declaration: float m[4][4] =
      if (!areArraySizes()) requireNothingGathered();
      gathered_.clear();
      name_ = word_;
      ++at_;
    } else if (c == '{' || c == '[' || c == '(') {
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
    label_ = cellOf(word);
    if (label_ && behindBlanks(at_) < text_.size() &&
        (text_[behindBlanks(at_)] == ':' || text_[behindBlanks(at_)] == '='))
      return;
    label_.reset();
    if (passNumbersOf(lower)) return;
    if (brackets_.empty()) word_ = word;
    if (at_ < text_.size() && text_[at_] == '<') at_ = std::min(text_.find('>', at_), text_.size() - 1) + 1;
  }

  std::size_t behindBlanks(std::size_t at) const { return std::min(text_.find_first_not_of(" \t", at), text_.size()); }
  std::size_t behindDigits(std::size_t at) const {
    return std::min(text_.find_first_not_of("0123456789", at), text_.size());
  }

  /// A number that belongs to the word before it: Array(16), Row 0:. Returns whether there was one.
  bool passNumbersOf(std::string_view lower) {
    std::size_t at = behindBlanks(at_);
    if (lower.ends_with("array") && at < text_.size() && text_[at] == '(') {
      const std::size_t begin = at + 1, end = behindDigits(begin);
      if (end == begin || end == text_.size() || text_[end] != ')') return false;
      at_ = end + 1;
      return true;
    }
    if (lower != "row" && lower != "column" && lower != "col") return false;
    const std::size_t end = behindDigits(at), colon = behindBlanks(end);
    if (end == at || colon == text_.size() || (text_[colon] != ':' && text_[colon] != '=')) return false;
    at_ = colon + 1;
    ++group_;
    return true;
  }

  void number() {
    const std::size_t begin = at_;
    // The size of what follows: Matrix 4x4.
    if (const std::size_t x = behindDigits(begin); x > begin && x + 1 < text_.size() && text_[x] == 'x')
      if (const std::size_t end = behindDigits(x + 1); end > x + 1 && (end == text_.size() || !isWord(text_[end]))) {
        at_ = end;
        return;
      }
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
    gathered_.push_back({typedNumber(digits, *value), line_, group_, begin, std::exchange(label_, std::nullopt)});
    if (gathered_.size() == 16) flush();
  }

  template <class Key>
  bool fourByFour(Key key) const {
    for (std::size_t i = 0; i < 16; ++i)
      if (i % 4 != 0 ? key(i) != key(i - 1) : i > 0 && key(i) == key(i - 1)) return false;
    return true;
  }

  /// Puts numbers in the places that their labels say. False where none has one.
  bool arrange() {
    const auto isLabelled = [](const Gathered& g) { return g.cell.has_value(); };
    const auto plain = std::find_if_not(gathered_.begin(), gathered_.end(), isLabelled);
    if (std::none_of(gathered_.begin(), gathered_.end(), isLabelled)) return false;
    if (plain != gathered_.end()) fail(plain->offset, "has no label, and others of the same matrix have one");
    // They count from 0 or from 1.
    int first = 1;
    for (const Gathered& g : gathered_) first = std::min({first, g.cell->row, g.cell->column});
    std::vector<std::optional<Gathered>> places(16);
    for (const Gathered& g : gathered_) {
      const int row = g.cell->row - first, column = g.cell->column - first;
      if (row > 3 || column > 3 || places[static_cast<std::size_t>(4 * row + column)])
        fail(g.offset, "has a label that is none of the rows and columns of 16 numbers, or one of before");
      places[static_cast<std::size_t>(4 * row + column)] = g;
    }
    for (std::size_t i = 0; i < 16; ++i) gathered_[i] = *places[i];
    return true;
  }

  void flush() {
    WrittenMatrix m;
    m.name = visible(name_);
    const bool labelled = arrange();
    std::array<Typed, 16> numbers;
    for (std::size_t i = 0; i < 16; ++i) numbers[i] = gathered_[i].number;
    setDigits(m, numbers);
    if (labelled || fourByFour([&](std::size_t i) { return gathered_[i].line; }) ||
        fourByFour([&](std::size_t i) { return gathered_[i].group; }))
      m.order = NumberOrder::rows;
    found_.push_back(m);
    gathered_.clear();
    name_.clear();
    word_.clear();
  }

  void requireNothingGathered() {
    const std::size_t count = gathered_.size();
    if (count == 0) return;
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
  std::optional<Cell> label_;  ///< of the number that follows
  std::vector<Gathered> gathered_;
  std::vector<WrittenMatrix> found_;
};

/// The numbers in JSON text of arrays.
std::array<Typed, 16> typedNumbers(std::string_view json, const std::vector<double>& values) {
  constexpr std::string_view kBetween = "[], \t\r\n";
  std::array<Typed, 16> numbers;
  std::size_t at = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    at = json.find_first_not_of(kBetween, at);
    const std::size_t end = json.find_first_of(kBetween, at);
    numbers[i] = typedNumber(json.substr(at, end - at), values[i]);
    at = end;
  }
  return numbers;
}

/// As `matrix --to csv` writes them.
constexpr std::string_view kCsvHeader = "matrix,row,column1,column2,column3,column4";

WrittenMatrices parseCsv(std::string_view text, const std::string& name) {
  WrittenMatrices result;
  result.isOwn = true;
  std::array<Typed, 16> numbers;
  std::size_t line = 1, row = 0;
  std::string matrix;
  const auto fail = [&](const std::string& message) {
    throw InputError(place(name, {line, 1}) + ": " + visible(message));
  };
  for (std::size_t at = std::min(text.find('\n'), text.size()); at < text.size();) {
    const std::size_t begin = at + 1;
    at = std::min(text.find('\n', begin), text.size());
    std::string_view rest = text.substr(begin, at - begin);
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    ++line;
    if (isBlank(rest) || rest.starts_with("eye,")) continue;
    std::array<std::string_view, 6> cells;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t comma = i + 1 < cells.size() ? std::min(rest.find(','), rest.size()) : rest.size();
      cells[i] = rest.substr(0, comma);
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    if (row == 0) matrix = cells[0];
    if (cells[0] != matrix || cells[1] != std::to_string(row + 1))
      fail("expected row " + std::to_string(row + 1) + " of " + (matrix.empty() ? "a matrix" : matrix));
    for (std::size_t i = 0; i < 4; ++i) {
      const auto value = parseNumber(cells[2 + i]);
      if (!value) fail(quoted(cells[2 + i]) + " is not a finite number");
      numbers[4 * row + i] = typedNumber(cells[2 + i], *value);
    }
    if (++row < 4) continue;
    WrittenMatrix& m = result.matrices.emplace_back();
    m.name = visible(matrix);
    m.order = NumberOrder::rows;
    setDigits(m, numbers);
    row = 0;
  }
  if (row > 0 || result.matrices.empty()) fail("ends after " + std::to_string(row) + " rows; a matrix has 4");
  return result;
}

WrittenMatrices parseObject(const std::string& text, const std::string& name) {
  const Document document(text, name);
  WrittenMatrices result;
  JsonParts parts(std::string_view(text).substr(text.find('{')));
  while (const auto part = parts.next()) {
    const std::string key = unescaped(part->key);
    const nlohmann::json& value = document.root()[key];
    if (!value.is_array()) continue;
    std::vector<double> numbers;
    bool good = true;
    const auto gather = [&](const nlohmann::json& entry) {
      good = good && entry.is_number();
      if (good) numbers.push_back(entry.get<double>());
    };
    for (const auto& row : value)
      if (row.is_array())
        std::for_each(row.begin(), row.end(), gather);
      else
        gather(row);
    const bool nested = !value.empty() && value.front().is_array();
    good = good && numbers.size() == 16 && value.size() == (nested ? 4 : 16) &&
           (!nested ||
            std::all_of(value.begin(), value.end(), [](const auto& row) { return row.is_array() && row.size() == 4; }));
    if (!good) {
      if (!nested && value.size() < 9) continue;  // an eye, a position, ...
      document.fail({key}, "expected 16 numbers or 4 rows of 4", false);
    }
    WrittenMatrix m;
    m.name = visible(key);
    m.order = nested ? NumberOrder::rows : NumberOrder::memory;
    setDigits(m, typedNumbers(part->value, numbers));
    result.matrices.push_back(m);
  }
  if (result.matrices.empty()) document.fail({}, "has no matrix: no value of 16 numbers or 4 rows of 4");
  const auto convention = document.root().find("convention");
  if (convention != document.root().end() && convention->is_object())
    result.convention = readAxes(ObjectReader(document, *convention, {"convention"}), {});
  result.isOwn = result.convention.has_value();
  return result;
}

}  // namespace

WrittenMatrices parseMatrices(const std::string& given, const std::string& name) {
  requireNarrow(name, given);
  const std::string text = given.starts_with("\xEF\xBB\xBF") ? given.substr(3) : given;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') {
    const std::size_t second = text.find_first_not_of(" \t\r\n", first + 1);
    if (second != std::string::npos && (text[second] == '"' || text[second] == '}')) return parseObject(text, name);
  }
  if (text.starts_with(kCsvHeader)) return parseCsv(text, name);
  // As the comment in source code begins.
  const bool isOwn = text.find("-handed world; view x right, ") != std::string::npos;
  const auto has = [&](const char* word) { return text.find(word) != std::string::npos; };
  return {Scanner(text, name).matrices(), std::nullopt, isOwn, has("float") || has("mat4") || has("f32")};
}

}  // namespace viewproj::cmd
