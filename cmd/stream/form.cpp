#include "stream/form.hpp"

#include <algorithm>
#include <utility>

#include "input/encoding.hpp"

namespace viewproj::cmd {
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
      {".txt", Form::text},  {".xyz", Form::text},    {".f64", Form::f64},    {".bin", Form::f64},
  };
  for (const auto& [ending, form] : kEndings)
    if (fileName.ends_with(ending)) return form;
  return std::nullopt;
}

std::optional<Form> formOfBytes(std::string_view start) {
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
  return line.find(',') != std::string_view::npos || !number ? Form::csv : Form::text;
}

}  // namespace viewproj::cmd
