#include "numbers/arctangent.hpp"

#include <cmath>

namespace viewproj::detail {

DoubleDouble arctangent(DoubleDouble slope) noexcept { return angleOf(slope); }

Direction directionOf(DoubleDouble angle) noexcept {
  const bool isSteep = angle.hi > kArctangents[16].hi;
  const DoubleDouble smaller = isSteep ? kQuarterTurn - angle : angle;
  // Newton's steps double the digits: the first leaves what the second is sure to reach, whatever libm's last bits are.
  DoubleDouble tangent = std::tan(smaller.hi);
  for (int i = 0; i < 2; ++i) tangent += (smaller - arctangent(tangent)) * (DoubleDouble(1) + tangent * tangent);
  return isSteep ? Direction{1, tangent} : Direction{tangent, 1};
}

}  // namespace viewproj::detail
