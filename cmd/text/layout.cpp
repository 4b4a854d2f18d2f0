#include "text/layout.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iterator>

#include "text/system.hpp"

namespace viewproj::cmd {
namespace {

struct Range {
  unsigned first, last;
};

constexpr Range kNone[] = {{0x300, 0x36F}, {0x200B, 0x200F}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}, {0xFE20, 0xFE2F}};
constexpr Range kTwo[] = {{0x1100, 0x115F},   {0x2E80, 0x303E},   {0x3041, 0xA4CF},  {0xAC00, 0xD7A3},
                          {0xF900, 0xFAFF},   {0xFE30, 0xFE6F},   {0xFF00, 0xFF60},  {0xFFE0, 0xFFE6},
                          {0x1F300, 0x1F64F}, {0x1F900, 0x1F9FF}, {0x20000, 0x3FFFD}};

template <std::size_t N>
bool isIn(const Range (&ranges)[N], unsigned code) {
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [&](const Range& r) { return code >= r.first && code <= r.last; });
}

/// The character at `at`, which moves on. What is no UTF-8 counts byte by byte.
unsigned nextCharacter(std::string_view text, std::size_t& at) {
  const auto first = static_cast<unsigned char>(text[at++]);
  const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
  unsigned code = more == 0 ? first : first & (0x3Fu >> more);
  for (int i = 0; i < more && at < text.size() && (text[at] & 0xC0) == 0x80; ++i)
    code = code << 6 | (static_cast<unsigned char>(text[at++]) & 0x3Fu);
  return code;
}

}  // namespace

std::size_t columnsOf(std::string_view text) {
  std::size_t columns = 0;
  for (std::size_t at = 0; at < text.size();) {
    const unsigned code = nextCharacter(text, at);
    columns += code < kNone[0].first ? 1 : isIn(kNone, code) ? 0 : isIn(kTwo, code) ? 2 : 1;
  }
  return columns;
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

std::string indented(std::string_view text, std::size_t blanks) {
  std::string out;
  for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    out += std::string(blanks, ' ') + std::string(text.substr(at, end - at)) + "\n";
  }
  return out;
}

std::size_t terminalWidth() {
  constexpr std::size_t kUsual = 80, kLeast = 40;
  std::size_t columns = 0;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes the environment
  if (const char* const told = std::getenv("COLUMNS"))
    (void)std::from_chars(told, told + std::string_view(told).size(), columns);
  if (columns == 0) columns = terminalColumns();
  return columns == 0 ? kUsual : std::max(kLeast, columns);
}

}  // namespace viewproj::cmd
