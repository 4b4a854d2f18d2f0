// Text in columns and lines for a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// The width of a text in terminal columns: its number of characters, not bytes.
std::size_t columnsOf(std::string_view text);

/// The text with blanks appended up to this many columns.
std::string paddedRight(std::string_view text, std::size_t columns);

/// Wraps words into lines of up to `width` columns. Each line but the first begins with `indent` blanks; the first
/// assumes that `indent` columns are already used. Ends with a line break.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

/// An entry of a list: left, then the text wrapped from a column on, or on the next line if left is too long.
std::string entry(const std::string& left, std::size_t column, std::string_view text, std::size_t width);

/// The width for standard output: COLUMNS, else the terminal's width, else 80; at least 40.
std::size_t terminalWidth();

}  // namespace viewproj::cmd
