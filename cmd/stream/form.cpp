#include "stream/form.hpp"

#include <algorithm>
#include <utility>

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
      {".txt", Form::text},  {".xyz", Form::text},    {".f64", Form::f64},
  };
  for (const auto& [ending, form] : kEndings)
    if (fileName.ends_with(ending)) return form;
  return std::nullopt;
}

Form formOfBytes(std::string_view start) {
  const auto control = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < ' ' && std::string_view("\t\n\v\f\r").find(c) == std::string_view::npos) || byte == 0x7f;
  };
  if (std::any_of(start.begin(), start.end(), control)) return Form::f64;
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return Form::text;
  start.remove_prefix(first);
  if (start[0] == '{' || start[0] == '[') return Form::json;
  const std::string_view line = start.substr(0, start.find('\n'));
  const char c = start[0];
  const bool number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || line.starts_with("NaN");
  return line.find(',') != std::string_view::npos || !number ? Form::csv : Form::text;
}

}  // namespace viewproj::cmd
