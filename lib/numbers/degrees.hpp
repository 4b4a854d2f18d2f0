// Trigonometry of angles in degrees, without rounding to radians first; and the tangent of angles in radians.
#pragma once

#include "numbers/double_double.hpp"
#include "numbers/dyadic.hpp"

namespace viewproj::detail {

/// tan of half the angle, 0 < degrees < 180. The reduction to 0..45 degrees is exact, so the result keeps its digits
/// right up to 180. Relative error at most kTanHalfDegreesBound for degrees >= 1e-200; NaN outside the open interval.
DoubleDouble tanHalfDegrees(double degrees) noexcept;

/// 4 * 2^-106, as measured against MPFR; the Taylor remainder is below 2^-117.
inline constexpr double kTanHalfDegreesBound = 0x1p-104;

/// tan of half the angle, 0 < radians < pi. Relative error at most kTanHalfRadiansBound up to 3.1; towards pi, where
/// the tangent is ill-conditioned, it grows as 1 / (pi - radians). NaN outside the open interval and within 1e-16 of
/// pi.
DoubleDouble tanHalfRadians(DoubleDouble radians) noexcept;

/// As measured against MPFR.
inline constexpr double kTanHalfRadiansBound = 0x1p-97;

/// The way back: the double nearest the angle in degrees whose half has this tangent. 0 for a tangent that is not above
/// 0, 180 where no double below is nearer; NaN for NaN.
double degreesOfHalfTangent(DoubleDouble tangent) noexcept;

/// Degrees between the directions (from, 1) and (to, 1), from <= to: those of a window at unit distance. Within an ulp.
double degreesAcross(DoubleDouble from, DoubleDouble to) noexcept;

/// Degrees between the directions to two corners, (x0, y0, 1) and (x1, y1, 1). Within an ulp.
double degreesBetween(DoubleDouble x0, DoubleDouble y0, DoubleDouble x1, DoubleDouble y1) noexcept;

/// Multiples of kSinCosStep.
struct SinCos {
  Dyadic<1> sine, cosine;
};

/// Products of sines and cosines drop what is below it.
inline constexpr double kSinCosStep = 0x1p-224;
Dyadic<1> sinCosProduct(const Dyadic<1>& a, const Dyadic<1>& b) noexcept;

/// Sine and cosine of any finite angle, each within kSinCosDegreesBound; exact at multiples of 90 degrees. The
/// reduction to 0..45 degrees is exact. A few microseconds.
SinCos sinCosDegrees(double degrees) noexcept;

/// Some fifty operations that each drop less than a step.
inline constexpr double kSinCosDegreesBound = 64 * kSinCosStep;

/// A multiple of 90.
bool isRightAngle(double degrees) noexcept;

}  // namespace viewproj::detail
