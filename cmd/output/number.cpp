#include "output/number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace viewproj::cmd {
namespace {

template <class T>
void append(std::string& out, T value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  const double size = std::fabs(static_cast<double>(value));
  // Beyond the integers that T holds exactly, plain digits would be longer than the shortest.
  const double largestPlain = sizeof(T) == sizeof(double) ? 1e16 : 1e7;
  const bool plain = value == 0 || (size >= 1e-5 && size < largestPlain);
  char text[40];
  if (plain) {
    out.append(text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr);
    return;
  }
  // 5e-06 and 1e+16 become 5e-6 and 1e16.
  char* end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr;
  char* exponent = std::find(text, end, 'e') + 1;
  out.append(text, exponent);
  if (*exponent == '-') out += '-';
  ++exponent;
  while (exponent + 1 < end && *exponent == '0') ++exponent;
  out.append(exponent, end);
}

}  // namespace

void appendNumber(std::string& out, double value) { append(out, value); }
void appendNumber(std::string& out, float value) { append(out, value); }

std::string formatNumber(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

std::string formatDigits(double value, int digits) {
  if (!std::isfinite(value)) return formatNumber(value);
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
  std::from_chars(text, end, value);
  return formatNumber(value);
}

}  // namespace viewproj::cmd
