#include "text/form.hpp"

#include <algorithm>
#include <utility>

#include "text/encoding.hpp"
#include "text/parse_number.hpp"

namespace viewproj::cmd {
namespace {

bool hasNumber(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r";
  for (std::size_t at = 0; (at = line.find_first_not_of(kBlanks, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    if (parseNumber(line.substr(at, end - at))) return true;
    at = end;
  }
  return false;
}

}  // namespace

OutputForm sameForm(Form form) {
  switch (form) {
    case Form::csv:
      return OutputForm::csv;
    case Form::text:
      return OutputForm::text;
    case Form::f64:
      return OutputForm::f64;
    case Form::json:
      break;
  }
  return OutputForm::lines;
}

std::optional<Form> formOfName(std::string_view fileName) {
  static constexpr std::pair<std::string_view, Form> kEndings[] = {
      {".json", Form::json}, {".ndjson", Form::json}, {".jsonl", Form::json}, {".csv", Form::csv},
      {".tsv", Form::csv},   {".xyz", Form::text},    {".f64", Form::f64},    {".bin", Form::f64},
  };
  for (const auto& [ending, form] : kEndings)
    if (fileName.ends_with(ending)) return form;
  return std::nullopt;
}

std::string_view behindComments(std::string_view text, char comment) {
  constexpr std::string_view kSpace = " \t\r\n";
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
    if (!isTextComment(text, comment)) return text;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

std::optional<Form> formOfBytes(std::string_view start, bool goesOn, char decimal) {
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return Form::text;
  start.remove_prefix(first);
  if (start[0] == '{' || start[0] == '[') return Form::json;
  const auto isControl = [](char c) { return (c >= 0 && c < '\t') || (c > '\r' && c < ' ') || c == 0x7f; };
  const bool controls = std::any_of(start.begin(), start.end(), isControl);
  if (start.find('\0') != std::string_view::npos || (controls && !isUtf8(start, true))) return std::nullopt;
  const std::string_view line = start.substr(0, start.find('\n'));
  const char c = start[0];
  const bool number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || line.starts_with("NaN");
  if ((decimal != ',' && line.find(',') != std::string_view::npos) || line.find(';') != std::string_view::npos)
    return Form::csv;
  return number || hasNumber(line) || goesOn ? Form::text : Form::csv;
}

}  // namespace viewproj::cmd
