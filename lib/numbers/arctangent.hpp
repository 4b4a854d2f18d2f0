// The arctangent and the way back in double-double: bits and bounds that libm does not promise.
#pragma once

#include "numbers/double_double.hpp"

namespace viewproj::detail {

/// The angle of this slope, in radians, for 0 <= slope < 2^900: within 2^-94 of itself.
DoubleDouble arctangent(DoubleDouble slope) noexcept;

/// The sine and the cosine of an angle from 0 to a quarter turn, divided by the larger: of the angle within 2^-94.
struct Direction {
  DoubleDouble across, along;
};
Direction directionOf(DoubleDouble angle) noexcept;

inline constexpr DoubleDouble kQuarterTurn{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

}  // namespace viewproj::detail
