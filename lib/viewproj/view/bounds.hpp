// How far a projected point can be from the true one, proven, as named constants and as a number for a camera or a
// point.
//
// Derivation (perspective, one coordinate; u is the rounding unit, 2^-53 in double and 2^-24 in float32). A scaled row
// A is off by u of each entry, d = P - E by u, each product by u, the two sums and the residual's by 3 u: with D = |d0|
// + |d1| + |d2| + residualReach and to first order
//   |X^ - X| <= 6 u M D,  |W^ - W| <= 6 u F D          M = largest entry of the rows x and y, F = of the row w.
// From X/W - X^/W^ = ((X - X^) - (X^/W^)(W - W^)) / W, with r = 1/W and t = D |r|, the rounding of r and of the product
// (u each) and of the sum with the center (u) and the center's own error cE (its rounding, and what its parts leave,
// 2^-97 of the largest):
//   |x^ - x| <= t (c1 + c2 |q|) + u' (2 |q| + |x|) + cE      c1 = 6 u M (1 + 2^-8), c2 = 6 u F (1 + 2^-8)
// provided c2 t < 2^-10; 2^-8 takes up the second order and the evaluation of the bound itself. The last sum is in
// double in fast too: u' of |x| is 2^-53 (1 + 2^-8) there. Window depth: the rounding of r (u), and in double those of
// depthScale, of the product and of the sum, and the offset's own zE,
//   |z^ - z| <= |depthScale r| (c2 t + u' + 2^-52 (1 + 2^-8)) + 2^-53 (1 + 2^-8) |z| + zE
// and a few of the smallest doubles where numbers are subnormal. Orthographic, where x and W are the sums themselves:
//   |x^ - x| <= c1 D + u' |x| + cE,   |z^ - z| <= |depthScale| (c2 D + 2^-52 (1 + 2^-8) |W|) + 2^-53 (...) |z| + zE.
// For every point whose pixel lies in the picture, d = W (C + qx RX + qy RY) with C, RX, RY the columns of the pose, so
// t <= |C|_1 + |qx| |RX|_1 + |qy| |RY|_1: a bound for the camera alone, of points at any distance.
#pragma once

#include "viewproj/camera/camera.hpp"

namespace viewproj {

/// Rounding units.
inline constexpr double kUnitDouble = 0x1p-53;
inline constexpr double kUnitFloat = 0x1p-24;

/// Roundings on the way of a coordinate's numerator; 2^-8 covers second-order terms.
inline constexpr double kRoundings = 6;
inline constexpr double kSecondOrder = 1 + 0x1p-8;

/// The relative error of W must stay below this for the bounds to hold: nearer the eye plane, the exact path decides.
inline constexpr double kLargestRelativeError = 0x1p-10;

/// |W| above this many D: the sign of W is certain, and its relative error below kLargestRelativeError (rows are at
/// most a little over unit length: F <= 1 + 2^-9).
inline constexpr double kSignUncertainty = 0x1p-40;
inline constexpr double kSignUncertaintyFast = 0x1p-11;
inline constexpr double kSignUncertaintyExact = 0x1p-60;

/// Where neither overflow nor underflow disturbs the bounds; points outside are left to the exact path.
inline constexpr double kLargestReach = 0x1p700;
inline constexpr double kSmallestDistance = 0x1p-700;
inline constexpr double kLargestReachFast = 0x1p60;
inline constexpr double kSmallestDistanceFast = 0x1p-60;
inline constexpr double kLargestReachExact = 0x1p400;
inline constexpr double kSmallestReachExact = 0x1p-400;
inline constexpr double kSmallestDistanceExact = 0x1p-450;

/// The entries of the scaled rows must lie between 1 / this and this; other cameras are left to the exact path whole.
inline constexpr double kLargestRow = 0x1p300;
inline constexpr double kLargestRowFast = 0x1p40;

/// Nonzero centres, depth offsets and depth scales lie between 1 / this and this; other cameras are left to the exact
/// path whole, and in exact to numbers with an exponent of their own.
inline constexpr double kLargestRange = 0x1p600;
inline constexpr double kLargestRangeExact = 0x1p500;

/// exact, before the final rounding: a numerator is within kExactDotX M D (128 u^2 of the dot product and 2^-98 of the
/// scaled rows), W within kExactDotW F D, and every parameter and operation within kExactParameter, all relative.
inline constexpr double kExactDotX = 0x1.1p-97;
inline constexpr double kExactDotW = 0x1.1p-98;
inline constexpr double kExactParameter = 0x1p-97;
/// What low parts may lose below the smallest double.
inline constexpr double kExactUnderflow = 0x1p-1070;

/// exact: units in the last place of the result, for x, y, depth and viewDistance; a result that cancels to about zero
/// keeps an absolute error instead, 1e-26 of the viewport's size, or of the whole picture's where a window was cropped
/// or shifted from far off the axis.
inline constexpr double kExactUlps = 0.51;
inline constexpr double kExactAbsolute = 1e-26;

/// How far around the picture `auto` keeps its tolerance: the picture and one more on every side.
inline constexpr double kGuardBand = 3;

/// Farther than any point that is not left to the exact path anyway, in pixels.
inline constexpr double kNoBand = 0x1p1010;

/// Above this the square of a ray's length might have overflowed.
inline constexpr double kLargestSquaredLength = 0x1p1000;

/// How far from the principal point a picture enlarged band times about its middle reaches, in pixels.
struct PictureReach {
  double x = kNoBand, y = kNoBand;
};

PictureReach pictureReach(const Camera& camera, double band) noexcept;

/// exact, of a window depth that is not certain: the distance is known to this share, and the depth to this share of
/// depthScale / W (perspective) or depthScale W (orthographic). It counts in slabs of far/near - 1 below 1e-11.
inline constexpr double kExactDistance = 0x1p-96;

/// The largest error of screen x and y, in pixels, and of window depth. Infinite where nothing is promised.
struct ErrorBound {
  double screen = 0;
  double depth = 0;
};

/// For every point whose true pixel lies in the picture enlarged band times about its middle, between near and far in
/// orthographic (and whose depth lies between near and far, for the depth's bound).
ErrorBound boundInPicture(const Camera& camera, Precision precision, double band = 1) noexcept;

/// For one point, wherever it lies.
ErrorBound boundOfPoint(const Camera& camera, const Vec3& point, Precision precision) noexcept;

/// Homogeneous: weights other than 1 have the bound of exact, whatever the precision, as worldToScreen works on them.
ErrorBound boundOfPoint(const Camera& camera, const Vec4& point, Precision precision) noexcept;

/// The cheapest precision that is within tolerance pixels in the whole picture and one more picture on every side of it
/// (band 3). exact where none is.
Precision precisionWithin(const Camera& camera, double tolerance) noexcept;

}  // namespace viewproj
