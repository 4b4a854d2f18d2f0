#include "text/form.hpp"

#include <algorithm>

#include "text/names.hpp"
#include "text/npy_header.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

struct Words {
  bool number = false, other = false;
};

/// The kinds of words in a line.
Words wordsOf(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r";
  Words words;
  for (std::size_t at = 0; (at = line.find_first_not_of(kBlanks, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    (parseNumber(line.substr(at, end - at)) ? words.number : words.other) = true;
    at = end;
  }
  return words;
}

}  // namespace

OutputForm sameForm(Form form) {
  switch (form) {
    case Form::csv:
      return OutputForm::csv;
    case Form::text:
      return OutputForm::text;
    case Form::f64:
    case Form::f32:
    case Form::npy:
      return OutputForm::f64;
    case Form::json:
      break;
  }
  return OutputForm::lines;
}

std::span<const FormRow<Form>> inputForms() {
  static constexpr FormRow<Form> kRows[] = {
      {"json", Form::json, ".json .ndjson .jsonl",
       "objects or [x,y,z]: one after the other, in an array, under \"points\""},
      {"csv", Form::csv, ".csv .tsv", "a header and rows, or rows that begin with coordinates"},
      {"text", Form::text, ".xyz", "numbers separated by blanks, a point a line"},
      {"f64", Form::f64, ".f64", "little-endian doubles, three a point or --width N (a pixel: x, y, depth)"},
      {"f32", Form::f32, ".f32", "the same as little-endian floats"},
      {"npy", Form::npy, ".npy", "a NumPy array of floats or doubles, a row a point"},
  };
  return kRows;
}

std::span<const FormRow<OutputForm>> outputForms() {
  static constexpr FormRow<OutputForm> kRows[] = {
      {"ndjson", OutputForm::lines, ".ndjson .jsonl", "a JSON object a line"},
      {"json", OutputForm::array, ".json", "one JSON array"},
      {"csv", OutputForm::csv, ".csv .tsv", "a header and rows; .tsv: separated by tabs"},
      {"text", OutputForm::text, ".txt .xyz", "the results' numbers alone, a line a record"},
      {"f64", OutputForm::f64, ".f64", "the same as little-endian doubles"},
      {"table", OutputForm::table, "", "aligned columns, for reading"},
  };
  return kRows;
}

std::string_view endingOf(std::string_view fileName) {
  const std::string_view name = fileName.substr(fileName.rfind('/') + 1);
  const std::size_t point = name.rfind('.');
  return point == std::string_view::npos || point == 0 ? std::string_view() : name.substr(point);
}

bool isEnding(std::string_view ending, std::string_view endings) {
  for (std::size_t at = 0; !ending.empty() && at < endings.size();) {
    const std::size_t end = std::min(endings.find(' ', at), endings.size());
    if (sameButForCase(endings.substr(at, end - at), ending)) return true;
    at = end + 1;
  }
  return false;
}

std::optional<Form> formOfName(std::string_view fileName) {
  for (const FormRow<Form>& row : inputForms())
    if (isEnding(endingOf(fileName), row.endings)) return row.form;
  return std::nullopt;
}

std::string_view afterComments(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
    if (!isTextComment(text)) return text;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

std::optional<Form> formOfBytes(std::string_view start) {
  if (start.starts_with(kNpyMagic)) return Form::npy;
  start = afterComments(withoutByteOrderMark(start));
  if (start.empty()) return Form::text;
  if (start[0] == '{' || start[0] == '[') return Form::json;
  const auto isControl = [](unsigned char c) { return c < '\t' || (c > '\r' && c < ' ') || c == 0x7f; };
  const bool controls = std::any_of(start.begin(), start.end(), isControl);
  std::string_view complete = start;  // without the last character, which may be cut off
  while (!complete.empty() && continuesCharacter(complete.back())) complete.remove_suffix(1);
  const auto last = static_cast<unsigned char>(complete.empty() ? 0 : complete.back());
  if (last >= 0xC2 && last <= 0xF4) complete.remove_suffix(1);
  if (start.find('\0') != std::string_view::npos || (controls && !isUtf8(complete))) return std::nullopt;
  const std::string_view line = start.substr(0, start.find('\n'));
  const char c = start[0];
  const bool number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || line.starts_with("NaN");
  const Words words = wordsOf(line);
  const bool isTabbed = line.find('\t') != std::string_view::npos && words.other;
  if (isTabbed || line.find_first_of(",;") != std::string_view::npos) return Form::csv;
  return number || words.number ? Form::text : Form::csv;
}

}  // namespace viewproj::cmd
