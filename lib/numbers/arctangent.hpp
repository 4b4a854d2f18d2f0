// The arctangent and its inverse in double-double, with bits and bounds that libm does not guarantee.
#pragma once

#include "numbers/double_double.hpp"

namespace viewproj::detail {

/// The angle of this slope in radians, for 0 <= slope < 2^900. The relative error is at most 2^-94.
DoubleDouble arctangent(DoubleDouble slope) noexcept;

/// The sine (across) and cosine (along) of an angle from 0 to a quarter turn, both divided by the larger one. The angle
/// they represent is within 2^-94 relative.
struct Direction {
  DoubleDouble across, along;
};
Direction directionOf(DoubleDouble angle) noexcept;

inline constexpr DoubleDouble kQuarterTurn{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

}  // namespace viewproj::detail
