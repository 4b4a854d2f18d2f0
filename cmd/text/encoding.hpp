// What characters an input's bytes are.
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

}  // namespace viewproj::cmd
