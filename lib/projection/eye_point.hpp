// A point's distances along the camera's axes: the one step that every projection begins with.
#pragma once

#include "camera/pose.hpp"
#include "numbers/wide.hpp"

namespace viewproj {

/// The point with |w| in [1, 2); or with w = 0 where x/w would overflow, because such a point is as good as a
/// direction.
Vec4 withUnitWeight(const Vec4& point) noexcept;

/// right, up and forward times 2^exponent are the distances, for a point still to be divided by its w.
struct EyePoint {
  DoubleDouble right, up, forward;
  int exponent = 0;
  /// Of each of the three numbers: its absolute error is at most this. (0: none but the last bits of double-double.)
  /// forwardIsExact: of forward, none at all.
  double error = 0;
  bool forwardIsExact = false;
};

/// An exponent of toEye farther from 0: distances have their digits, but not all products with them.
inline constexpr int kLargestExponent = 400;

/// In double-double. A distance that cancels to less than its own error is 0.
/// The error bound: rows are within 2^-100 of the true ones, and d within 2^-105 relative; a product of the two carries
/// 2^-99, and the sum of three 2^-98 of |d0| + |d1| + |d2|.
EyePoint toEye(const Pose& pose, const Vec4& point) noexcept;

/// From the exact rows, each distance rounded once at the end: zero means zero, and the sign of forward is certain. Of
/// a pose made of sines and cosines the rows have an error, 2^-206 and more where up is near the view; a distance that
/// cancels to less is 0 and not certain, and a point nearer to the eye plane than 2^60 errors counts as on it.
/// Microseconds instead of a quarter of one.
EyePoint toEyeExactly(const Pose& pose, const Vec4& point) noexcept;

/// Whether toEyeExactly has all digits of this point: whether no product of a coordinate underflows.
bool isInExactRange(const Pose& pose, const Vec4& point) noexcept;

/// The same distances, each within 2^-99 of itself and the error. For every pose and point of doubles.
struct WideEyePoint {
  Wide right, up, forward;
  Wide error;
};

/// As toEyeExactly, whatever the magnitudes: tens of microseconds.
WideEyePoint toEyeWidely(const Pose& pose, const Vec4& point) noexcept;

}  // namespace viewproj
