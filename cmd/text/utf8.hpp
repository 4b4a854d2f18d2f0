// The characters of a text: UTF-8, and a safe form for messages and terminals.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// ASCII letters only.
inline bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Whether a byte continues a character that an earlier byte began.
inline bool continuesCharacter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

inline constexpr char32_t kNoCharacter = 0xFFFFFFFF;
/// The character at `at`, which is moved past it. If there is no valid UTF-8 (RFC 3629), returns kNoCharacter and moves
/// one byte.
char32_t nextCharacter(std::string_view text, std::size_t& at);

bool isUtf8(std::string_view text);

/// Whether a line has only white space.
inline bool isBlank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

/// The text without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

/// The byte order mark of UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
inline std::string_view withoutByteOrderMark(std::string_view text) {
  return text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
}
/// Whether a text may become a byte order mark, of any encoding, with more bytes.
bool mayBeginByteOrderMark(std::string_view text);
/// Throws InputError if a text begins with the byte order mark of UTF-16 or UTF-32.
void requireNarrow(const std::string& name, std::string_view start);

/// Replaces control characters, which a terminal would obey, by <U+001B> and the like: those of ASCII and Unicode, and
/// those that change the direction of writing. kept: characters that stay.
std::string visible(std::string_view text, std::string_view kept = "");

/// The beginning of a text in quotes, on one line, with control characters replaced.
std::string inQuotes(std::string_view text, std::size_t most = 40);

}  // namespace viewproj::cmd
