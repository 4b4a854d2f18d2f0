// The characters of a text: whether its bytes are UTF-8, and how messages and terminals can have them.
#pragma once

#include <string>
#include <string_view>

namespace viewproj::cmd {

/// Whether all of it is UTF-8, as RFC 3629 has it. mayBeCut: but for a character that the end cuts off.
bool isUtf8(std::string_view text, bool mayBeCut = false);

/// Whether a line has nothing but white space.
inline bool isBlank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

/// UTF-16 or UTF-32, as iconv names it, where the first four bytes of a text, or two that are all, are of text in it;
/// otherwise nothing.
std::string_view wideEncoding(std::string_view start);

/// Throws InputError where there is such an encoding.
void requireNarrow(const std::string& name, std::string_view start);

/// With <U+001B> and the like for control characters (of ASCII, of Unicode, and those that turn the direction of
/// writing), which a terminal would obey. kept: characters that stay.
std::string visible(std::string_view text, std::string_view kept = "");

/// The beginning of a text in quotes, visible and on one line.
std::string inQuotes(std::string_view text, std::size_t most = 40);

}  // namespace viewproj::cmd
