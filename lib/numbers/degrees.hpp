// Trigonometry of angles in degrees, without rounding to radians first, and the tangent of angles in radians.
#pragma once

#include "numbers/double_double.hpp"
#include "numbers/dyadic.hpp"

namespace viewproj::detail {

/// tan(degrees / 2), for 0 < degrees < 180. The reduction to 0..45 degrees is exact, so the result keeps its digits
/// right up to 180. Relative error at most kTanHalfDegreesBound for degrees >= 1e-200. NaN outside the open interval.
DoubleDouble tanHalfDegrees(double degrees) noexcept;

/// 4 * 2^-106, as measured against MPFR; the Taylor remainder is below 2^-117.
inline constexpr double kTanHalfDegreesBound = 0x1p-104;

/// tan(radians / 2), for 0 < radians < pi. Relative error at most kTanHalfRadiansBound up to 3.1; towards pi the
/// tangent is ill-conditioned and the error grows as 1 / (pi - radians). NaN outside the interval and within 1e-16 of
/// pi.
DoubleDouble tanHalfRadians(DoubleDouble radians) noexcept;

/// As measured against MPFR.
inline constexpr double kTanHalfRadiansBound = 0x1p-97;

/// The inverse: the double nearest to the angle in degrees whose half has this tangent. 0 for a tangent that is not
/// above 0, 180 if no smaller double is nearer, NaN for NaN.
double degreesOfHalfTangent(DoubleDouble tangent) noexcept;

/// The angle in degrees between the directions (from, 1) and (to, 1) with from <= to, the edges of a window at distance
/// 1. Within an ulp.
double degreesAcross(DoubleDouble from, DoubleDouble to) noexcept;

/// The angle in degrees between the directions (x0, y0, 1) and (x1, y1, 1) to two corners. Within an ulp.
double degreesBetween(DoubleDouble x0, DoubleDouble y0, DoubleDouble x1, DoubleDouble y1) noexcept;

/// Sine and cosine as multiples of kSinCosStep.
struct SinCos {
  Dyadic<1> sine, cosine;
};

/// Products of sines and cosines drop digits below this step.
inline constexpr double kSinCosStep = 0x1p-224;
Dyadic<1> sinCosProduct(const Dyadic<1>& a, const Dyadic<1>& b) noexcept;

/// Sine and cosine of any finite angle, and of up to 1e6 radians, each within kSinCosBound. Multiples of 90 degrees are
/// exact. Takes a few microseconds.
SinCos sinCosDegrees(double degrees) noexcept;
SinCos sinCosRadians(double radians) noexcept;

/// About fifty operations drop less than one step each.
inline constexpr double kSinCosBound = 64 * kSinCosStep;

}  // namespace viewproj::detail
