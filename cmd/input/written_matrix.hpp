// A matrix of a text, with how its numbers were written.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "input/readings/readings.hpp"

namespace viewproj::cmd {

struct WrittenMatrix {
  std::string name;  ///< as the input calls it, or empty
  std::array<double, 16> numbers{};
  std::array<double, 16> within{};          ///< how far each may be off, going by its digits
  int digits = 0;                           ///< the most significant ones that a number has
  NumberOrder order = NumberOrder::memory;  ///< rows: written in four groups or on four lines of four
  /// 4: a 4x4 matrix. 3 or 4 with isCalibration: three rows of so many, the first of the numbers.
  std::size_t columns = 4;
  bool isCalibration = false;
};

/// It has as many digits as the shortest text of float32s has.
inline bool mayBeFloats(const WrittenMatrix& m) { return m.digits >= 7 && m.digits <= 9; }

}  // namespace viewproj::cmd
