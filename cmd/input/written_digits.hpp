// Numbers as they were typed.
#pragma once

#include <array>
#include <string_view>

#include "input/written_matrix.hpp"

namespace viewproj::cmd {

struct WrittenNumber {
  double value = 0;
  int significant = 0;  ///< digits from the first that is not 0 on
};

/// text: a number that parseNumber takes.
WrittenNumber writtenNumber(std::string_view text, double value);

void setNumbers(WrittenMatrix& matrix, const std::array<WrittenNumber, 16>& numbers);

}  // namespace viewproj::cmd
