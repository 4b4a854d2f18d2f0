// Proven bounds on the error of a projected point, as named constants.
//
// Derivation, for perspective and one coordinate. u is the rounding unit, 2^-53. A scaled row A is off by u of each
// entry, d = P - E by u, each product by u, the two sums and the residual's sum by 3 u. To first order, with
// D = |d0| + |d1| + |d2| + residualReach,
//   |X^ - X| <= 6 u M D,  |W^ - W| <= 6 u F D          M = largest entry of the rows x and y, F = of the row w.
// From X/W - X^/W^ = ((X - X^) - (X^/W^)(W - W^)) / W, with r = 1/W and t = D |r|, and the roundings of r, of the
// product and of the sum with the center (u each) and the center's own error cE (its rounding, and 2^-97 of its largest
// term):
//   |x^ - x| <= t (c1 + c2 |q|) + u' (2 |q| + |x|) + cE      c1 = 6 u M (1 + 2^-8), c2 = 6 u F (1 + 2^-8)
// with u' = u (1 + 2^-8), provided c2 t < 2^-10; 2^-8 covers second-order terms and the evaluation of the bound itself.
// Window depth: the roundings of r, of depthScale, of the product and of the sum, and the offset's own zE,
//   |z^ - z| <= |depthScale r| (c2 t + 3 u') + u' |z| + zE
// and a few of the smallest doubles where numbers are subnormal. Orthographic, where x and W are the sums themselves:
//   |x^ - x| <= c1 D + u' |x| + cE,   |z^ - z| <= |depthScale| (c2 D + 2 u' |W|) + u' |z| + zE.
// exact: a row's entries and d are each split in two. The high part of a row has 25 bits of M, and all three are
// multiples of one number. The high part of d has 27 bits of D, also multiples of one number: adding and subtracting
// 2^27 D makes it. So the products of high parts have at most 52 bits, and their sum is exact. The six products with
// low parts are below 2^-24 M D, and each rounding of them is at most 2^-77 M D.
// kExactDot is 13 of those roundings, kExactQuotient 8 2^-79. What follows needs 1.41 of the 2 in kZivMargin:
// tests/proofs/exact_*.g count the roundings.
// For every point whose pixel lies in the picture, d = W (C + qx RX + qy RY) with C, RX, RY the columns of the pose, so
// t <= |C|_1 + |qx| |RX|_1 + |qy| |RY|_1. This bounds points at any distance for the camera alone. (d also has the
// remainder of rounding the eye: at most half of a component of d, and near a half only if that component is so few
// ulps of the eye that neither it nor its product is rounded.) tests/proofs checks all but this paragraph by machine.
#pragma once

namespace viewproj::detail {

/// The rounding unit.
inline constexpr double kUnitDouble = 0x1p-53;

/// Roundings in the computation of a coordinate's numerator. 2^-8 covers second-order terms.
inline constexpr double kRoundings = 6;
inline constexpr double kSecondOrder = 1 + 0x1p-8;

/// The relative error of W must be below this for the bounds to hold. Nearer to the eye plane the exact path decides.
inline constexpr double kLargestRelativeError = 0x1p-10;

/// If |W| is above this many D, its sign is certain and its relative error is below kLargestRelativeError. (Rows are at
/// most slightly over unit length: F <= 1 + 2^-9.)
inline constexpr double kSignUncertainty = 0x1p-40;
inline constexpr double kSignUncertaintyExact = 0x1p-60;

/// Above these no underflow disturbs the bounds, for every camera and point in range: a row in pixels is between 1e-90
/// and 1e90. Points nearer to the eye go to the exact path.
inline constexpr double kSmallestReach = 0x1p-200;
inline constexpr double kSmallestDistance = 0x1p-240;

/// exact, before the final rounding; all relative. A numerator is within kExactDot M D, W within kExactDot F D, a
/// quotient within kExactQuotient and every parameter within kExactParameter. kZivMargin multiplies these.
inline constexpr double kExactDot = 0x1.ap-74;
inline constexpr double kExactQuotient = 0x1p-76;
inline constexpr double kExactParameter = 0x1p-97;
/// What the low parts may lose to underflow.
inline constexpr double kExactUnderflow = 0x1p-1070;

}  // namespace viewproj::detail
