#include "stream/form.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "input/number.hpp"

namespace viewproj::cmd {
namespace {

/// But for a character that the end cuts off.
bool isUtf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at++]);
    if (byte >= 0x80 && (byte < 0xC2 || byte > 0xF4)) return false;
    for (int more = byte < 0x80 ? 0 : byte < 0xE0 ? 1 : byte < 0xF0 ? 2 : 3; more > 0 && at < text.size(); --more)
      if ((text[at++] & 0xC0) != 0x80) return false;
  }
  return true;
}

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
      {".txt", Form::text},  {".xyz", Form::text},    {".f64", Form::f64},    {".bin", Form::f64},
  };
  for (const auto& [ending, form] : kEndings)
    if (fileName.ends_with(ending)) return form;
  return std::nullopt;
}

std::optional<Form> formOfBytes(std::string_view start, bool goesOn) {
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return Form::text;
  start.remove_prefix(first);
  if (start[0] == '{' || start[0] == '[') return Form::json;
  const auto isControl = [](char c) { return (c >= 0 && c < '\t') || (c > '\r' && c < ' ') || c == 0x7f; };
  const bool controls = std::any_of(start.begin(), start.end(), isControl);
  if (start.find('\0') != std::string_view::npos || (controls && !isUtf8(start))) return std::nullopt;
  const std::string_view line = start.substr(0, start.find('\n'));
  const char c = start[0];
  const bool number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || line.starts_with("NaN");
  if (line.find(',') != std::string_view::npos) return Form::csv;
  return number || hasNumber(line) || (goesOn && line.find(';') == std::string_view::npos) ? Form::text : Form::csv;
}

std::string_view wideEncoding(std::string_view start) {
  using namespace std::string_view_literals;
  const std::string_view four = start.substr(0, 4), two = start.substr(0, 2);
  if (four == "\xFF\xFE\0\0"sv || four == "\0\0\xFE\xFF"sv) return "UTF-32";
  if (two == "\xFF\xFE"sv || two == "\xFE\xFF"sv) return "UTF-16";
  if (start.size() < 2 || start.size() == 3) return {};
  // Without a byte order mark: 0, and x for a character of ASCII.
  std::string pattern;
  for (const char c : four) pattern += c == 0 ? '0' : (c >= ' ' && c < 0x7f) || (c >= '\t' && c <= '\r') ? 'x' : '-';
  if (pattern == "x000" || pattern == "000x") return "UTF-32";
  return pattern == "x0x0" || pattern == "0x0x" || pattern == "x0" || pattern == "0x" ? "UTF-16" : "";
}

}  // namespace viewproj::cmd
