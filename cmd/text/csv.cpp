#include "text/csv.hpp"

#include <algorithm>

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;

/// "a comma" or "'|'".
std::string nameOf(char separator) {
  for (const SeparatorName& one : kSeparators)
    if (one.separator == separator) return "a " + std::string(one.name);
  return inQuotes(std::string_view(&separator, 1));
}

/// The offset after the quote that closes the one at `quote`; npos if none does.
std::size_t afterQuotes(std::string_view text, std::size_t quote) {
  std::size_t close = text.find('"', quote + 1);
  while (close != npos && close + 1 < text.size() && text[close + 1] == '"') close = text.find('"', close + 2);
  return close == npos ? npos : close + 1;
}

}  // namespace

char separatorOf(std::string_view line) {
  bool isQuoted = false, hasSemicolon = false;
  for (const char c : line) {
    isQuoted ^= c == '"';
    if (c == '\t' && !isQuoted) return c;
    hasSemicolon |= c == ';' && !isQuoted;
  }
  return hasSemicolon ? ';' : ',';
}

void CsvRecord::split(std::string_view text, char separator, std::size_t most) {
  fields.clear();
  numbers.clear();
  fault.clear();
  isOpen = false;
  const auto fail = [&](std::size_t at, const std::string& message) {
    if (!fault.empty()) return;
    fault = message;
    faultAt = at;
  };
  const char *const first = text.data(), *const last = first + text.size();
  for (const char* at = first;; ++at) {
    const char* const begin = at;
    const bool isQuoted = at < last && *at == '"';
    if (isQuoted) {
      const auto quote = static_cast<std::size_t>(at - first);
      const std::size_t after = afterQuotes(text, quote);
      isOpen = after == npos;
      if (isOpen) fail(quote, "the quote that opens here is not closed");
      at = first + std::min(after, text.size());
    }
    const char* const closed = at;
    double number = kNoNumber;
    const char* const afterNumber = isQuoted ? nullptr : passJsonNumber(at, last, number);
    if (afterNumber) at = afterNumber;
    while (at < last && *at != separator && *at != '\n') {
      const bool endsLine = *at == '\r' && (at + 1 == last || at[1] == '\n');
      if (endsLine) break;
      if (*at == '\r' && !isQuoted) fail(static_cast<std::size_t>(at - first), kLoneReturn);
      ++at;
    }
    if (isQuoted && at > closed)
      fail(static_cast<std::size_t>(closed - first),
           "text after the closing quote; expected " + nameOf(separator) + " or the end of the line");
    if (fields.size() <= most) {
      fields.emplace_back(begin, at);
      numbers.push_back(at == afterNumber ? number : kNoNumber);
    }
    if (at < last && *at == separator) continue;
    if (at < last && *at == '\r') ++at;
    end = static_cast<std::size_t>(at - first);
    return;
  }
}

void CsvRecord::splitSome(std::string_view text, char separator, std::size_t size, std::size_t most) {
  split(text, separator, most);
  if (fault.empty() && fields.size() == size) return;
  if (const std::size_t line = text.find('\n'); line < end) {
    split(text.substr(0, line), separator, most);
    end = line;
  }
}

bool needsQuotes(std::string_view cell, char separator) {
  return std::any_of(cell.begin(), cell.end(),
                     [&](char c) { return c == '"' || c == '\r' || c == '\n' || c == separator; });
}

std::string quotedIfNeeded(std::string_view cell, char separator) {
  if (!needsQuotes(cell, separator)) return std::string(cell);
  std::string quoted = "\"";
  for (const char c : cell) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csvValue(std::string_view field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
  std::string value;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    if (field[i] == '"' && field[i + 1] == '"' && i + 2 < field.size()) ++i;
    value += field[i];
  }
  return value;
}

std::string wholeCell(std::string_view field, char separator) {
  const bool isWhole = field.starts_with('"') && afterQuotes(field, 0) == field.size();
  return isWhole ? std::string(field) : quotedIfNeeded(field, separator);
}

}  // namespace viewproj::cmd
