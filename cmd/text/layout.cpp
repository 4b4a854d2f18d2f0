#include "text/layout.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
std::size_t columnsOf(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continuesCharacter(c); }));
}

std::string paddedRight(std::string_view text, std::size_t columns) {
  return std::string(text) + std::string(columns - std::min(columns, columnsOf(text)), ' ');
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string out;
  std::size_t column = indent;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \n", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const std::size_t columns = columnsOf(word);
    if (column > indent && column + 1 + columns > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      out += ' ';
      ++column;
    }
    out += word;
    column += columns;
    at = end;
  }
  return out + "\n";
}

std::string entry(const std::string& left, std::size_t column, std::string_view text, std::size_t width) {
  const bool fits = columnsOf(left) + 2 <= column;
  return (fits ? paddedRight(left, column) : left + "\n" + std::string(column, ' ')) + wrapped(text, width, column);
}

std::size_t terminalWidth() {
  constexpr std::size_t kUsual = 80, kLeast = 40;
  std::size_t columns = 0;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing changes the environment
  if (const char* const setting = std::getenv("COLUMNS"))
    (void)std::from_chars(setting, setting + std::string_view(setting).size(), columns);
  if (columns == 0) columns = terminalColumns();
  return columns == 0 ? kUsual : std::max(kLeast, columns);
}

}  // namespace viewproj::cmd
