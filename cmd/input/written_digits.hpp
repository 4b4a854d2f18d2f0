// What the digits of a written matrix are worth.
#pragma once

#include <array>
#include <string_view>

#include "input/written_matrix.hpp"

namespace viewproj::cmd {

/// A number as it was typed.
struct WrittenNumber {
  double value = 0;
  int significant = 0;  ///< digits from the first that is not 0 on
  int decimals = 0;     ///< the place of the last digit is 10^-decimals
  int exponent = 0;     ///< that of the first digit
};

/// text: a number that parseNumber takes.
WrittenNumber writtenNumber(std::string_view text, double value);

/// The numbers, and what their digits are worth: half a unit of the finest place that the matrix shows, or of the last
/// of as many digits as its longest number has; with as many as float32s have, also what these round away. 0, 1 and -1
/// are what they are, unless written out.
void setDigits(WrittenMatrix& m, const std::array<WrittenNumber, 16>& numbers);

}  // namespace viewproj::cmd
