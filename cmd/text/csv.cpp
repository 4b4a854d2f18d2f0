#include "text/csv.hpp"

#include <algorithm>

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

}  // namespace viewproj::cmd
