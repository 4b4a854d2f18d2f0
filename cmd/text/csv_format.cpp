#include "text/csv_format.hpp"

#include <algorithm>

#include "text/parse_number.hpp"

namespace viewproj::cmd {

std::string_view nameOfSeparator(char separator) {
  for (const SeparatorName& one : kSeparators)
    if (one.separator == separator) return one.name;
  return "";
}

std::string quotedIfNeeded(std::string_view cell, const CsvFormat& format) {
  const auto needs = [&](char c) { return c == '"' || c == '\r' || c == '\n' || format.separates(c); };
  const bool isLost = cell.empty() && format.isBlanks();
  if (!isLost && std::none_of(cell.begin(), cell.end(), needs)) return std::string(cell);
  std::string quoted = "\"";
  for (const char c : cell) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::optional<double> parseDecimal(std::string_view text, char decimal) {
  if (decimal == '.') return parseNumber(text);
  if (text.find('.') != std::string_view::npos) return std::nullopt;
  std::string plain(text);
  std::replace(plain.begin(), plain.end(), decimal, '.');
  return parseNumber(plain);
}

std::string withDecimal(std::string_view number, char decimal) {
  std::string text(number);
  std::replace(text.begin(), text.end(), '.', decimal);
  return text;
}

}  // namespace viewproj::cmd
