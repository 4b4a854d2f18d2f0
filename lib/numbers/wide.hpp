// Double-double with its own exponent: products of many coordinates neither overflow nor underflow.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "numbers/vectors.hpp"

namespace viewproj::detail {

/// value * 2^exponent, with 1 <= |value| < 2, or zero. Infinities and NaN are kept and have sign 0. Each operation is
/// within 2^-102 of the true result, relative to the larger operand in a sum.
struct Wide {
  DoubleDouble value;
  int exponent = 0;

  Wide() = default;
  Wide(double a) noexcept : Wide(DoubleDouble(a)) {}  // NOLINT: a double is exact
  Wide(DoubleDouble a, int power = 0) noexcept {      // NOLINT: and so is a double-double
    if (a.hi == 0) return;
    const int k = static_cast<int>(std::bit_cast<std::uint64_t>(a.hi) >> 52 & 0x7ff) - 1023;
    if (!std::isfinite(a.hi)) {
      value = a;
    } else if (k < -1000 || k > 1000) {  // subnormal or near a limit of the range
      const int logarithm = std::ilogb(a.hi);
      value = scaleByPowerOfTwo(a, -logarithm);
      exponent = power + logarithm;
    } else {
      value = timesPowerOfTwo(a, powerOfTwo(-k));
      exponent = power + k;
    }
  }

  int sign() const noexcept { return !std::isfinite(value.hi) ? 0 : value.hi > 0 ? 1 : value.hi < 0 ? -1 : 0; }

  /// The nearest double within 0.5001 ulp (1 ulp if subnormal). Infinite beyond the largest double. Never -0.
  explicit operator double() const noexcept { return scaleByPowerOfTwo(value, exponent).hi + 0.0; }
};

/// The double nearest to a number, and whether every number within its relative error rounds to the same one. Never
/// certain for a subnormal double.
struct NearestDouble {
  double value;
  bool certain;
};

inline NearestDouble nearestDouble(const Wide& a, double share) noexcept {
  const double rounded = double(a);
  const bool isNormal = a.exponent >= -1022 || a.value.hi == 0;
  return {rounded, isNormal && std::isfinite(rounded) && roundsAlike(a.value, share * std::fabs(a.value.hi))};
}

/// The double nearest to an exact number.
inline double nearestDouble(const Wide& a) noexcept { return nearestDouble(a, 0).value; }

using WideVec3 = Vector3<Wide>;

inline Wide operator-(const Wide& a) noexcept {
  Wide negated = a;
  negated.value = -a.value;
  return negated;
}

// Not in line: that is smaller by a tenth of a program, and no slower.
[[gnu::noinline]] inline Wide operator+(const Wide& a, const Wide& b) noexcept {
  if (a.value.hi == 0 || b.value.hi == 0) return a.value.hi == 0 ? b : a;
  const Wide& larger = a.exponent < b.exponent ? b : a;
  const Wide& other = a.exponent < b.exponent ? a : b;
  const int shift = other.exponent - larger.exponent;
  if (shift < -300) return larger;
  return {larger.value + timesPowerOfTwo(other.value, powerOfTwo(shift)), larger.exponent};
}

inline Wide operator-(const Wide& a, const Wide& b) noexcept { return a + (-b); }
[[gnu::noinline]] inline Wide operator*(const Wide& a, const Wide& b) noexcept {
  return {a.value * b.value, a.exponent + b.exponent};
}
[[gnu::noinline]] inline Wide operator/(const Wide& a, const Wide& b) noexcept {
  return {a.value / b.value, a.exponent - b.exponent};
}

inline Wide sqrt(const Wide& a) noexcept {
  const int odd = a.exponent & 1;
  return {sqrt(timesPowerOfTwo(a.value, 1 + odd)), (a.exponent - odd) / 2};
}

inline Wide magnitude(const Wide& a) noexcept { return a.sign() < 0 ? -a : a; }
[[gnu::noinline]] inline bool isLess(const Wide& a, const Wide& b) noexcept { return (a - b).sign() < 0; }

/// a + b, or 0 if the terms cancel to less than their own error (kCancellation).
[[gnu::noinline]] inline Wide sumOrZero(const Wide& a, const Wide& b) noexcept {
  const Wide sum = a + b;
  return isLess(magnitude(a) * Wide(kCancellation), magnitude(sum)) || !std::isfinite(sum.value.hi) ? sum : Wide();
}

inline WideVec3 operator*(const WideVec3& a, const Wide& k) noexcept { return {a.x * k, a.y * k, a.z * k}; }
inline WideVec3 operator+(const WideVec3& a, const WideVec3& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline WideVec3 operator-(const WideVec3& a, const WideVec3& b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Wide lengthOf(const WideVec3& a) noexcept { return sqrt(dot(a, a)); }
inline Wide oneNorm(const WideVec3& a) noexcept { return magnitude(a.x) + magnitude(a.y) + magnitude(a.z); }

inline DoubleDouble toDoubleDouble(const Wide& a) noexcept { return scaleByPowerOfTwo(a.value, a.exponent); }
inline WideVec3 toWide(const DDVec3& a) noexcept { return {a.x, a.y, a.z}; }
inline WideVec3 toWide(const Vec3& a) noexcept { return {a.x, a.y, a.z}; }

inline double rounded(const Wide& a) noexcept { return nearestDouble(a); }
inline Vec3 rounded(const WideVec3& a) noexcept { return {rounded(a.x), rounded(a.y), rounded(a.z)}; }

/// a / |a| rounded to the nearest doubles, for a not zero.
inline Vec3 unitOf(const WideVec3& a) noexcept { return rounded(a * (Wide(1) / lengthOf(a))); }

}  // namespace viewproj::detail
