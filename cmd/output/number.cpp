#include "output/number.hpp"

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
  const auto result = plain ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed)
                            : std::to_chars(text, text + sizeof text, value, std::chars_format::scientific);
  out.append(text, result.ptr);
}

}  // namespace

void appendNumber(std::string& out, double value) { append(out, value); }
void appendNumber(std::string& out, float value) { append(out, value); }

std::string formatNumber(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

}  // namespace viewproj::cmd
