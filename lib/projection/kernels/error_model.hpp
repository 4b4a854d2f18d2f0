// How far a projected point can be from the true one, proven, as named constants.
//
// Derivation (perspective, one coordinate; u is the rounding unit, 2^-53). A scaled row A is off by u of each entry, d
// = P - E by u, each product by u, the two sums and the residual's by 3 u: with D = |d0|
// + |d1| + |d2| + residualReach and to first order
//   |X^ - X| <= 6 u M D,  |W^ - W| <= 6 u F D          M = largest entry of the rows x and y, F = of the row w.
// From X/W - X^/W^ = ((X - X^) - (X^/W^)(W - W^)) / W, with r = 1/W and t = D |r|, the rounding of r and of the product
// (u each) and of the sum with the center (u) and the center's own error cE (its rounding, and what its parts leave,
// 2^-97 of the largest):
//   |x^ - x| <= t (c1 + c2 |q|) + u' (2 |q| + |x|) + cE      c1 = 6 u M (1 + 2^-8), c2 = 6 u F (1 + 2^-8)
// with u' = u (1 + 2^-8), provided c2 t < 2^-10; 2^-8 takes up the second order and the evaluation of the bound itself.
// Window depth: the roundings of r, of depthScale, of the product and of the sum, and the offset's own zE,
//   |z^ - z| <= |depthScale r| (c2 t + 3 u') + u' |z| + zE
// and a few of the smallest doubles where numbers are subnormal. Orthographic, where x and W are the sums themselves:
//   |x^ - x| <= c1 D + u' |x| + cE,   |z^ - z| <= |depthScale| (c2 D + 2 u' |W|) + u' |z| + zE.
// exact: a row's entries and d are cut in two. The high part of a row has 25 bits of M, and all three are multiples of
// one number; that of d, by adding and subtracting 2^27 D, 27 bits of D, multiples of one number too. So the three
// products of high parts have at most 52 bits, and their sum is exact; the six with low parts are below 2^-24 M D, and
// each rounding of them is 2^-77 M D or less. kExactDot is 13 of those, kExactQuotient 8 2^-79, and of kZivMargin's 2
// 1.41 is needed for what comes after: tests/proofs/exact_*.g count them.
// For every point whose pixel lies in the picture, d = W (C + qx RX + qy RY) with C, RX, RY the columns of the pose, so
// t <= |C|_1 + |qx| |RX|_1 + |qy| |RY|_1: a bound for the camera alone, of points at any distance. (d is off from that
// by what rounding the eye left, which is half of a component of d at most, and near a half only where that component
// is so few last places of the eye that neither it nor its product takes a rounding.) All but this paragraph stands in
// tests/proofs for a machine.
#pragma once

namespace viewproj::detail {

/// The rounding unit.
inline constexpr double kUnitDouble = 0x1p-53;

/// Roundings on the way of a coordinate's numerator; 2^-8 covers second-order terms.
inline constexpr double kRoundings = 6;
inline constexpr double kSecondOrder = 1 + 0x1p-8;

/// The relative error of W must stay below this for the bounds to hold: nearer the eye plane, the exact path decides.
inline constexpr double kLargestRelativeError = 0x1p-10;

/// |W| above this many D: the sign of W is certain, and its relative error below kLargestRelativeError (rows are at
/// most a little over unit length: F <= 1 + 2^-9).
inline constexpr double kSignUncertainty = 0x1p-40;
inline constexpr double kSignUncertaintyExact = 0x1p-60;

/// Where no underflow disturbs the bounds, of a camera's and a point's numbers as large and as small as they may be: a
/// row in pixels is between 1e-180 and 1e180. Points nearer to the eye are left to the exact path.
inline constexpr double kSmallestReach = 0x1p-200;
inline constexpr double kSmallestDistance = 0x1p-240;

/// exact, before the final rounding, in shares of which kZivMargin is allowed for: a numerator is within kExactDot M D,
/// W within kExactDot F D, a quotient within kExactQuotient, and every parameter within kExactParameter, all relative.
inline constexpr double kExactDot = 0x1.ap-74;
inline constexpr double kExactQuotient = 0x1p-76;
inline constexpr double kExactParameter = 0x1p-97;
/// What low parts may lose below the smallest double.
inline constexpr double kExactUnderflow = 0x1p-1070;

/// Above this the square of a ray's length might have overflowed.
inline constexpr double kLargestSquaredLength = 0x1p1000;

}  // namespace viewproj::detail
