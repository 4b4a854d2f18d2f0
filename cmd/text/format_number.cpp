#include "text/format_number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "text/parse_number.hpp"

namespace viewproj::cmd {
namespace {

/// No number is longer.
constexpr std::size_t kLongest = 40;

/// Returns the end of what it wrote.
template <class T>
char* write(char* out, T value) {
  if (!std::isfinite(value)) {
    std::memcpy(out, "null", 4);
    return out + 4;
  }
  const double size = std::fabs(static_cast<double>(value));
  // Beyond the integers that T holds exactly, plain digits would be longer than the shortest.
  const double largestPlain = sizeof(T) == sizeof(double) ? 1e16 : 1e7;
  if (value == 0 || (size >= 1e-5 && size < largestPlain))
    return std::to_chars(out, out + kLongest, value, std::chars_format::fixed).ptr;
  // 5e-06 and 1e+16 become 5e-6 and 1e16.
  char* const end = std::to_chars(out, out + kLongest, value, std::chars_format::scientific).ptr;
  const char* from = std::find(out, end, 'e') + 1;
  char* to = const_cast<char*>(from);
  if (*from == '-') ++to;
  ++from;
  while (from + 1 < end && *from == '0') ++from;
  return std::copy(from, static_cast<const char*>(end), to);
}

}  // namespace

double toDigits(double value, int digits) {
  if (digits == 0 || !std::isfinite(value)) return value;
  char text[kLongest];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
  readNumber(text, end, value);
  return value;
}

void appendNumber(std::string& out, double value) {
  char text[kLongest];
  out.append(text, write(text, value));
}

void appendNumber(std::string& out, float value) {
  char text[kLongest];
  out.append(text, write(text, value));
}

void appendNumber(TextBuffer& out, double value) { out.written(write(out.room(kLongest), value)); }

std::string formatNumber(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

std::string formatDigits(double value, int digits) { return formatNumber(toDigits(value, digits)); }

std::string formatCount(double value) {
  static constexpr std::pair<double, const char*> kUnits[] = {{1e12, " T"}, {1e9, " G"}, {1e6, " M"}, {1e3, " k"}};
  constexpr int kDigits = 3;
  value = toDigits(value, kDigits);  // first: 999.6 is 1 k
  for (const auto& [unit, name] : kUnits)
    if (std::fabs(value) >= unit) return formatDigits(value / unit, kDigits) + name;
  return formatNumber(value);
}

}  // namespace viewproj::cmd
