// A matrix of a text, with how its numbers were written.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace viewproj::cmd {

/// What the order of the numbers stands for.
enum class NumberOrder {
  memory,  ///< sixteen in a row: the order in memory
  rows,    ///< four rows of four: rows as on paper, or the order in memory
};

struct WrittenMatrix {
  std::string name;  ///< as the input calls it, or empty
  std::array<double, 16> numbers{};
  int digits = 0;                           ///< the most significant ones that a number has
  NumberOrder order = NumberOrder::memory;  ///< rows: written in four groups or on four lines of four
  /// 4: a 4x4 matrix. 3 or 4 with isCalibration: three rows of so many, the first of the numbers.
  std::size_t columns = 4;
  bool isCalibration = false;
};

}  // namespace viewproj::cmd
