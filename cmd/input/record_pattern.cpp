#include "input/record_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "text/encoding.hpp"
#include "text/json_text.hpp"
#include "text/parse_number.hpp"

namespace viewproj::cmd {
namespace {

/// Bytes of a record: longer ones cost too much to remember.
constexpr std::size_t kLongest = 4096;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Where a string ends that begins here, or null, as for one that has characters by their numbers.
const char* passString(const char* at, const char* end) {
  if (at == end || *at != '"') return nullptr;
  const char* const begin = ++at;
  bool isAscii = true;
  for (; at < end && *at != '"'; ++at) {
    if (*at == '\\' && (++at == end || std::string_view("\"\\/bfnrt").find(*at) == std::string_view::npos))
      return nullptr;
    const auto byte = static_cast<unsigned char>(*at);
    if (byte < ' ') return nullptr;
    isAscii = isAscii && byte < 0x80;
  }
  if (at == end || (!isAscii && !isUtf8({begin, at}))) return nullptr;
  return at + 1;
}

const char* passFlag(const char* at, const char* end) {
  for (const std::string_view flag : {"true", "false"})
    if (std::string_view(at, end).starts_with(flag)) return at + flag.size();
  return nullptr;
}

/// Whether the string that ends before `at` is a name.
bool isName(std::string_view text, std::size_t at) {
  while (at < text.size() && isSpace(text[at])) ++at;
  return at < text.size() && text[at] == ':';
}

}  // namespace

RecordPattern::RecordPattern(const RecordParts& record, const Layout& layout) {
  const std::string_view text = record.text;
  if (text.size() > kLongest) return;
  Numbers numbers;
  NumberTexts texts;
  readNumbers(record, layout, numbers, &texts);
  for (std::size_t i = 0; i < layout.slots(); ++i) {
    absent_[i] = numbers[i];
    if (texts[i].empty() && !std::isnan(numbers[i])) return;
  }
  std::size_t begin = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const Kind kind = c == '"' ? Kind::string : c == 't' || c == 'f' ? Kind::flag : Kind::number;
    if (kind == Kind::number && c != '-' && !isDigit(c)) {
      ++at;
      continue;
    }
    const std::size_t end = endOfValue(text, at);
    if (kind != Kind::string || !isName(text, end)) {
      const auto slot = std::find_if(texts.begin(), texts.end(),
                                     [&](std::string_view value) { return value.data() == text.data() + at; });
      common_ += text.substr(begin, at - begin);
      pieces_.push_back({at - begin, kind, static_cast<std::size_t>(slot - texts.begin())});
      begin = end;
    }
    at = end;
  }
  common_ += text.substr(begin);
}

std::size_t RecordPattern::read(std::string_view text, Numbers& numbers) const {
  if (common_.empty()) return 0;
  const char* at = text.data();
  const char* const end = at + text.size();
  const char* common = common_.data();
  const auto passCommon = [&](std::size_t size) {
    if (static_cast<std::size_t>(end - at) < size || std::memcmp(at, common, size) != 0) return false;
    at += size;
    common += size;
    return true;
  };
  std::copy(absent_.begin(), absent_.end(), numbers.begin());
  for (const Piece& piece : pieces_) {
    if (!passCommon(piece.size)) return 0;
    double unused = 0;
    switch (piece.kind) {
      case Kind::number:
        at = readJsonNumber(at, end, piece.slot == kNoSlot ? unused : numbers[piece.slot]);
        break;
      case Kind::string:
        at = passString(at, end);
        break;
      case Kind::flag:
        at = passFlag(at, end);
        break;
    }
    if (!at) return 0;
  }
  const auto left = static_cast<std::size_t>(common_.data() + common_.size() - common);
  return passCommon(left) ? static_cast<std::size_t>(at - text.data()) : 0;
}

}  // namespace viewproj::cmd
