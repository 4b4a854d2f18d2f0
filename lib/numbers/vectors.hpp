// Vectors in double-double, and functions of plain vectors.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "numbers/double_double.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::detail {

using DDVec3 = Vector3<DoubleDouble>;

constexpr DDVec3 operator-(const DDVec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
constexpr DDVec3 operator+(const DDVec3& a, const DDVec3& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr DDVec3 operator*(const DDVec3& a, DoubleDouble k) noexcept { return {a.x * k, a.y * k, a.z * k}; }

template <class A, class B>
constexpr auto dot(const Vector3<A>& a, const Vector3<B>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// a x b, for number types that are exact or keep an error bound.
template <class A, class B>
constexpr auto crossOf(const Vector3<A>& a, const Vector3<B>& b) noexcept {
  return Vector3<decltype(a.x * b.y)>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// a . b, or 0 if the products cancel to less than the error of a and b.
inline DoubleDouble dotOrZero(const DDVec3& a, const DDVec3& b) noexcept {
  const DDVec3 products{a.x * b.x, a.y * b.y, a.z * b.z};
  const DoubleDouble sum = products.x + products.y + products.z;
  const double largest = std::max({std::fabs(products.x.hi), std::fabs(products.y.hi), std::fabs(products.z.hi)});
  return std::fabs(sum.hi) <= largest * kCancellation ? DoubleDouble() : sum;
}

/// a x b. A component is 0 if its products cancel to less than the error of a and b.
constexpr DDVec3 cross(const DDVec3& a, const DDVec3& b) noexcept {
  return {sumOrZero(a.y * b.z, -(a.z * b.y)), sumOrZero(a.z * b.x, -(a.x * b.z)), sumOrZero(a.x * b.y, -(a.y * b.x))};
}

constexpr DDVec3 toDoubleDouble(const Vec3& a) noexcept { return {a.x, a.y, a.z}; }
constexpr DDVec3 joined(const SplitVec3& a) noexcept {
  return {{a.high.x, a.low.x}, {a.high.y, a.low.y}, {a.high.z, a.low.z}};
}
constexpr SplitVec3 split(const DDVec3& a) noexcept { return {{a.x.hi, a.y.hi, a.z.hi}, {a.x.lo, a.y.lo, a.z.lo}}; }
/// The nearest doubles; adding 0 turns -0 into 0.
constexpr double rounded(DoubleDouble a) noexcept { return a.hi + 0.0; }
constexpr Vec3 rounded(const DDVec3& a) noexcept { return {rounded(a.x), rounded(a.y), rounded(a.z)}; }

inline DDVec3 scaleByPowerOfTwo(const DDVec3& a, int exponent) noexcept {
  return {scaleByPowerOfTwo(a.x, exponent), scaleByPowerOfTwo(a.y, exponent), scaleByPowerOfTwo(a.z, exponent)};
}

/// Roughly, and only for sizes whose squares are finite.
inline double length(double x, double y) noexcept { return std::sqrt(x * x + y * y); }
inline double length(const Vec3& v) noexcept { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// As std::hypot, which each standard library rounds in its own way for three numbers.
inline double hypotenuse(double x, double y, double z) noexcept {
  const double largest = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
  if (largest == 0) return 0;
  x /= largest;
  y /= largest;
  z /= largest;
  return largest * std::sqrt(x * x + y * y + z * z);
}

inline double maxAbs(const Vec3& a) noexcept { return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}); }
inline double maxAbs(const DDVec3& a) noexcept { return maxAbs(rounded(a)); }

inline bool isFinite(const Vec3& a) noexcept { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// The power of two k for which a * 2^k has its largest component in [1, 2); 0 for a zero or non-finite vector.
inline int exponentToUnit(const DDVec3& a) noexcept {
  const double largest = maxAbs(a);
  return largest > 0 && std::isfinite(largest) ? -std::ilogb(largest) : 0;
}

/// 1 / |a|, for a not zero. Scales first, so that nothing overflows or underflows on the way.
inline DoubleDouble inverseLength(const DDVec3& a) noexcept {
  const int k = exponentToUnit(a);
  const DDVec3 scaled = scaleByPowerOfTwo(a, k);
  return scaleByPowerOfTwo(DoubleDouble(1) / sqrt(dot(scaled, scaled)), k);
}

/// a / |a|, for a not zero.
inline DDVec3 normalized(const DDVec3& a) noexcept {
  const DDVec3 scaled = scaleByPowerOfTwo(a, exponentToUnit(a));
  return scaled * inverseLength(scaled);
}

}  // namespace viewproj::detail
