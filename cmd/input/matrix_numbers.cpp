#include "input/matrix_numbers.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "camera/check.hpp"
#include "camera/read_pose.hpp"
#include "input/matrix_scanner.hpp"
#include "input/written_digits.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

namespace {

/// The numbers in JSON text of arrays.
std::array<WrittenNumber, 16> writtenNumbers(std::string_view json, const std::vector<double>& values) {
  constexpr std::string_view kBetween = "[], \t\r\n";
  std::array<WrittenNumber, 16> numbers;
  std::size_t at = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    at = json.find_first_not_of(kBetween, at);
    const std::size_t end = json.find_first_of(kBetween, at);
    numbers[i] = writtenNumber(json.substr(at, end - at), values[i]);
    at = end;
  }
  return numbers;
}

/// As `matrix --to csv` writes them.
constexpr std::string_view kCsvHeader = "matrix,row,column1,column2,column3,column4";

WrittenMatrices parseCsv(std::string_view text, const std::string& name) {
  WrittenMatrices result;
  std::array<WrittenNumber, 16> numbers;
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
      if (!value) fail(inQuotes(cells[2 + i]) + " is not a finite number");
      numbers[4 * row + i] = writtenNumber(cells[2 + i], *value);
    }
    if (++row < 4) continue;
    WrittenMatrix& m = result.matrices.emplace_back();
    m.name = visible(matrix);
    m.order = NumberOrder::rows;
    setNumbers(m, numbers);
    row = 0;
  }
  if (row > 0 || result.matrices.empty()) fail("ends after " + std::to_string(row) + " rows; a matrix has 4");
  return result;
}

/// The array of a field, or of what FileStorage wrote there: its value and its text. Null where it is none.
std::pair<const nlohmann::json*, std::string_view> arrayAt(const nlohmann::json& value, std::string_view text) {
  if (value.is_array()) return {&value, text};
  const auto data = value.is_object() ? value.find("data") : value.end();
  if (data == value.end() || !data->is_array()) return {};
  JsonParts parts(text);
  while (const auto part = parts.next())
    if (unescaped(part->key) == "data") return {&*data, part->value};
  return {};
}

/// Of a value of an object that inspect reads; nothing for one that is no matrix and stands beside them.
std::optional<WrittenMatrix> matrixOf(const Node& document, const std::string& key, std::string_view text) {
  const Json& whole = document.json()[key];
  const auto [array, written] = arrayAt(whole, text);
  if (!array) return std::nullopt;
  const nlohmann::json& value = *array;
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
  const auto says = [&](const char* word, std::size_t count) {
    return !whole.is_object() || !whole.contains(word) || whole[word] == count;
  };
  const auto isOf = [&](std::size_t rows, std::size_t columns) {
    return good && numbers.size() == rows * columns && value.size() == (nested ? rows : rows * columns) &&
           says("rows", rows) && says("cols", columns) &&
           (!nested || std::all_of(value.begin(), value.end(),
                                   [&](const auto& row) { return row.is_array() && row.size() == columns; }));
  };
  const bool isK = isOf(3, 3), isP = isOf(3, 4);
  // A rotation; an eye, the coefficients of a lens: one row or one column.
  if (isK && (numbers[3] != 0 || numbers[6] != 0 || numbers[7] != 0)) return std::nullopt;
  if (!isK && !isP && !isOf(4, 4)) {
    if (!nested || isOf(1, numbers.size()) || isOf(numbers.size(), 1)) return std::nullopt;
    Node(document.document(), whole, key)
        .fail("expected 16 numbers or 4 rows of 4; or 3 rows of 3 or 4, a calibration");
  }
  WrittenMatrix m;
  m.name = visible(key);
  m.isCalibration = isK || isP;
  m.columns = isK ? 3 : 4;
  m.order = nested || whole.is_object() ? NumberOrder::rows : NumberOrder::memory;
  setNumbers(m, writtenNumbers(written, numbers));
  return m;
}

WrittenMatrices parseObject(std::string text, const std::string& name) {
  blankComments(text);
  const Document document = load(text, name);
  const Node root(document);
  WrittenMatrices result;
  JsonParts parts(std::string_view(text).substr(text.find('{')));
  while (const auto part = parts.next())
    if (auto m = matrixOf(root, unescaped(part->key), part->value)) result.matrices.push_back(std::move(*m));
  if (result.matrices.empty()) root.fail("has no matrix: no value of 16 numbers or 4 rows of 4");
  if (const auto convention = root.find("convention")) {
    Document stated{name, std::make_shared<Json>(Json{{"convention", convention->json()}})};
    normalize(stated);
    check(stated);
    result.convention = readConvention(stated).convention;
  }
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
  const auto has = [&](const char* word) { return text.find(word) != std::string::npos; };
  return {scanMatrices(text, name), std::nullopt, has("float") || has("mat4") || has("f32")};
}

}  // namespace viewproj::cmd
