#include "text/utf8.hpp"

#include <algorithm>
#include <cstdio>

#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

/// Bytes of the character that begins with this one, and the values that its second byte may have; 0 bytes: none does.
struct Lead {
  std::size_t bytes;
  unsigned char lowest = 0x80, highest = 0xBF;
};

Lead leadOf(unsigned char byte) {
  if (byte < 0x80) return {1};
  if (byte < 0xC2 || byte > 0xF4) return {0};
  if (byte < 0xE0) return {2};
  // Neither longer than need be, nor half a pair of UTF-16, nor beyond U+10FFFF.
  if (byte == 0xE0) return {3, 0xA0};
  if (byte == 0xED) return {3, 0x80, 0x9F};
  if (byte < 0xF0) return {3};
  if (byte == 0xF0) return {4, 0x90};
  if (byte == 0xF4) return {4, 0x80, 0x8F};
  return {4};
}

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

bool isUtf8(std::string_view text, bool mayBeCut) {
  for (std::size_t at = 0; at < text.size();) {
    const Lead lead = leadOf(static_cast<unsigned char>(text[at]));
    if (lead.bytes == 0) return false;
    const std::size_t end = std::min(at + lead.bytes, text.size());
    if (end < at + lead.bytes && !mayBeCut) return false;
    for (std::size_t i = at + 1; i < end; ++i) {
      const auto byte = static_cast<unsigned char>(text[i]);
      const bool second = i == at + 1;
      if (byte < (second ? lead.lowest : 0x80) || byte > (second ? lead.highest : 0xBF)) return false;
    }
    at = end;
  }
  return true;
}

std::string_view wideEncoding(std::string_view start) {
  using namespace std::string_view_literals;
  const std::string_view four = start.substr(0, 4), two = start.substr(0, 2);
  if (four == "\xFF\xFE\0\0"sv || four == "\0\0\xFE\xFF"sv) return "UTF-32";
  if (two == "\xFF\xFE"sv || two == "\xFE\xFF"sv) return "UTF-16";
  if (start.size() < 2 || start.size() == 3) return {};
  // Without a byte order mark, of which iconv must be told the order: 0, and x for a character of ASCII.
  std::string pattern;
  for (const char c : four) pattern += c == 0 ? '0' : (c >= ' ' && c < 0x7f) || (c >= '\t' && c <= '\r') ? 'x' : '-';
  if (pattern == "x000") return "UTF-32LE";
  if (pattern == "000x") return "UTF-32BE";
  if (pattern == "x0x0" || pattern == "x0") return "UTF-16LE";
  if (pattern == "0x0x" || pattern == "0x") return "UTF-16BE";
  return {};
}

void requireNarrow(const std::string& name, std::string_view start) {
  const std::string encoding(wideEncoding(start));
  if (!encoding.empty())
    throw InputError(name + ": is " + encoding + "; expected UTF-8, as iconv -f " + encoding + " -t UTF-8 makes it");
}

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
