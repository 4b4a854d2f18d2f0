// Trigonometry of angles that come in radians.
#pragma once

#include "numbers/double_double.hpp"

namespace viewproj {

/// tan of half the angle, 0 < radians < pi. Relative error at most kTanHalfRadiansBound up to 3.1; towards pi, where
/// the tangent is ill-conditioned, it grows as 1 / (pi - radians). NaN outside the open interval and within 1e-16 of
/// pi.
DoubleDouble tanHalfRadians(DoubleDouble radians) noexcept;

/// As measured against MPFR.
inline constexpr double kTanHalfRadiansBound = 0x1p-97;

}  // namespace viewproj
