#include "input/written_digits.hpp"

#include <algorithm>
#include <cmath>

#include "text/parse_number.hpp"

namespace viewproj::cmd {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

WrittenNumber writtenNumber(std::string_view text, double value) {
  WrittenNumber number{.value = value};
  bool fraction = false;
  std::size_t at = text.find_first_of("0123456789.");
  for (; at < text.size() && (isDigit(text[at]) || text[at] == '.'); ++at) {
    if (text[at] == '.') {
      fraction = true;
      continue;
    }
    if (fraction) ++number.decimals;
    if (number.significant > 0 || text[at] != '0') ++number.significant;
  }
  if (at + 1 < text.size()) {
    const auto power = parseNumber(text.substr(at + 1));
    number.decimals -= static_cast<int>(std::clamp(power.value_or(0), -1000.0, 1000.0));
  }
  number.exponent = number.significant - 1 - number.decimals;
  return number;
}

void setDigits(WrittenMatrix& m, const std::array<WrittenNumber, 16>& numbers) {
  int finest = 0;
  for (const WrittenNumber& number : numbers) {
    m.digits = std::max(m.digits, number.significant);
    finest = std::max(finest, number.decimals);
  }
  for (std::size_t i = 0; i < 16; ++i) {
    const auto& [value, significant, decimals, exponent] = numbers[i];
    m.numbers[i] = value;
    const bool isWord = value == 0 || std::fabs(value) == 1;
    const bool isWrittenOut = (finest > 1 && decimals == finest) || (value != 0 && significant > 2);
    if (isWord && !isWrittenOut) continue;
    const double ofPlace = powerOfTen(-finest);
    const double ofDigits = value == 0 ? 0 : powerOfTen(exponent - m.digits + 1);
    m.within[i] = std::max(ofPlace, ofDigits) / 2;
    if (mayBeFloats(m)) {
      const float narrow = std::fabs(static_cast<float>(value));
      m.within[i] = std::max(m.within[i], static_cast<double>(std::nextafter(narrow, HUGE_VALF) - narrow) / 2);
    }
  }
}

}  // namespace viewproj::cmd
