// The characters of a text: whether its bytes are UTF-8, and how messages and terminals can have them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// Of ASCII.
inline bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Whether a byte goes on with a character that an earlier one began.
inline bool continuesCharacter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

inline constexpr char32_t kNoCharacter = 0xFFFFFFFF;
/// The character at `at`, which moves on past it; kNoCharacter, and one byte on, where there is none of UTF-8 as RFC
/// 3629 has it.
char32_t nextCharacter(std::string_view text, std::size_t& at);

bool isUtf8(std::string_view text);

/// Whether a line has nothing but white space.
inline bool isBlank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

/// Without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

/// Throws InputError where a text begins with the byte order mark of UTF-16 or UTF-32.
void requireNarrow(const std::string& name, std::string_view start);

/// With <U+001B> and the like for control characters (of ASCII, of Unicode, and those that turn the direction of
/// writing), which a terminal would obey. kept: characters that stay.
std::string visible(std::string_view text, std::string_view kept = "");

/// The beginning of a text in quotes, visible and on one line.
std::string inQuotes(std::string_view text, std::size_t most = 40);

}  // namespace viewproj::cmd
