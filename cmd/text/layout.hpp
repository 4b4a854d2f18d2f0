// Text in columns and lines for a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// How many columns of a terminal the text takes: characters, not bytes, one each.
std::size_t columnsOf(std::string_view text);

/// With blanks after it up to so many columns.
std::string paddedRight(std::string_view text, std::size_t columns);

/// Lines of words of up to `width` columns, each but the first after `indent` blanks; the first goes on where `indent`
/// columns are taken. Ends in a line break.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

/// An entry of a list: text from a column on, wrapped, beside what stands left of it, or below where that is too long.
std::string entry(const std::string& left, std::size_t column, std::string_view text, std::size_t width);

/// The width of what standard output is shown on: COLUMNS, or else the terminal's, or else 80; at least 40.
std::size_t terminalWidth();

}  // namespace viewproj::cmd
