#include "text/utf8.hpp"

#include <algorithm>
#include <cstdio>

#include "text/error.hpp"

namespace viewproj::cmd {

char32_t nextCharacter(std::string_view text, std::size_t& at) {
  const auto first = static_cast<unsigned char>(text[at++]);
  if (first < 0x80) return first;
  if (first < 0xC2 || first > 0xF4) return kNoCharacter;
  const std::size_t more = first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
  if (text.size() - at < more) return kNoCharacter;
  char32_t code = first & (0x3F >> more);
  for (std::size_t i = 0; i < more; ++i) {
    if (!continuesCharacter(text[at + i])) return kNoCharacter;
    code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3F);
  }
  // Not an overlong encoding, half of a UTF-16 pair, or beyond the last character.
  constexpr char32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
  if (code < kLeast[more] || (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF) return kNoCharacter;
  at += more;
  return code;
}

bool isUtf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();)
    if (nextCharacter(text, at) == kNoCharacter) return false;
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

bool mayBeginByteOrderMark(std::string_view text) {
  using namespace std::string_view_literals;
  const auto begins = [&](std::string_view mark) { return text.size() < mark.size() && mark.starts_with(text); };
  return begins(kByteOrderMark) || begins("\xFF\xFE\0\0"sv) || begins("\0\0\xFE\xFF"sv) || begins("\xFE\xFF");
}

void requireNarrow(const std::string& name, std::string_view start) {
  using namespace std::string_view_literals;
  std::string encoding;
  if (start.starts_with("\xFF\xFE"sv) || start.starts_with("\xFE\xFF"sv)) encoding = "UTF-16";
  if (start.starts_with("\xFF\xFE\0\0"sv) || start.starts_with("\0\0\xFE\xFF"sv)) encoding = "UTF-32";
  if (!encoding.empty())
    throw InputError(name + ": is " + encoding + "; expected UTF-8, as iconv -f " + encoding + " -t UTF-8 makes it");
}

std::string visible(std::string_view text, std::string_view kept) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    char32_t code = nextCharacter(text, at);
    if (code == kNoCharacter) code = static_cast<unsigned char>(text[begin]);
    const bool isControl = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
    if ((!isControl && !turns) || kept.find(text[begin]) != std::string_view::npos) {
      shown += text.substr(begin, at - begin);
      continue;
    }
    char name[12];
    std::snprintf(name, sizeof name, "<U+%04X>", static_cast<unsigned>(code));
    shown += name;
  }
  return shown;
}

std::string inQuotes(std::string_view text, std::size_t most) {
  std::size_t end = std::min(text.size(), most);
  while (end > 0 && end < text.size() && continuesCharacter(text[end])) --end;
  return "'" + visible(text.substr(0, end)) + (end < text.size() ? "...'" : "'");
}

}  // namespace viewproj::cmd
