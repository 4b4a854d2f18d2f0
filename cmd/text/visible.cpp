#include "text/visible.hpp"

#include <algorithm>
#include <cstdio>

namespace viewproj::cmd {
namespace {

struct Control {
  unsigned code;
  std::size_t bytes;  ///< 0: there is none
};

/// The control character that text begins with.
Control controlAt(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x20 || (first >= 0x7F && first < 0xA0)) return {first, 1};
  if (first == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) return {byte(1), 2};
  if (first != 0xE2 || (byte(1) != 0x80 && byte(1) != 0x81)) return {0, 0};
  const unsigned code = 0x2000 + ((byte(1) & 0x3F) << 6) + (byte(2) & 0x3F);
  const bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return {code, turns ? 3u : 0u};
}

}  // namespace

std::string visible(std::string_view text, std::string_view kept) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const unsigned char first = static_cast<unsigned char>(text[at]);
    const Control control = controlAt(text.substr(at));
    if (control.bytes == 0 || kept.find(text[at]) != std::string_view::npos) {
      // A character as a whole: the bytes that go on with it are no controls.
      std::size_t end = at + 1;
      while (first >= 0xC0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
      shown += text.substr(at, end - at);
      at = end;
      continue;
    }
    char code[12];
    std::snprintf(code, sizeof code, "<U+%04X>", control.code);
    shown += code;
    at += control.bytes;
  }
  return shown;
}

std::string inQuotes(std::string_view text, std::size_t most) {
  std::size_t end = std::min(text.size(), most);
  if (end < text.size())
    while (end > 0 && (text[end] & 0xC0) == 0x80) --end;  // not within a character
  return "'" + visible(text.substr(0, end)) + (end < text.size() ? "...'" : "'");
}

}  // namespace viewproj::cmd
