#include "numbers/arctangent.hpp"

#include <cmath>

namespace viewproj::detail {

DoubleDouble arctangent(DoubleDouble slope) noexcept { return angleOf(slope, DoubleDouble(1)); }

Direction directionOf(DoubleDouble angle) noexcept {
  if (angle.hi > kQuarterTurn.hi) {
    const Direction forward = directionOf(kHalfTurn - angle);
    return {forward.across, -forward.along};
  }
  const bool isSteep = angle.hi > kArctangents[16].hi;
  const DoubleDouble smaller = isSteep ? kQuarterTurn - angle : angle;
  // Each Newton step doubles the digits. Two steps are enough for any libm, whatever its last bits are.
  DoubleDouble tangent = std::tan(smaller.hi);
  for (int i = 0; i < 2; ++i) tangent += (smaller - arctangent(tangent)) * (DoubleDouble(1) + tangent * tangent);
  return isSteep ? Direction{1, tangent} : Direction{tangent, 1};
}

}  // namespace viewproj::detail
