// Plain vectors and matrices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "numbers/double_double.hpp"

namespace viewproj {

template <class T>
struct Vector3 {
  T x{}, y{}, z{};

  constexpr T& operator[](std::size_t i) noexcept { return i == 0 ? x : i == 1 ? y : z; }
  constexpr const T& operator[](std::size_t i) const noexcept { return i == 0 ? x : i == 1 ? y : z; }
  friend constexpr bool operator==(const Vector3&, const Vector3&) = default;
};

using Vec3 = Vector3<double>;
using DDVec3 = Vector3<DoubleDouble>;

struct Vec2 {
  double x = 0, y = 0;
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

struct Vec4 {
  double x = 0, y = 0, z = 0, w = 0;
  friend constexpr bool operator==(const Vec4&, const Vec4&) = default;
};

/// Four rows of four; acts on column vectors: y[i] = sum over j of m[i][j] * x[j].
struct Mat4 {
  std::array<std::array<double, 4>, 4> m{};

  constexpr std::array<double, 4>& operator[](std::size_t row) noexcept { return m[row]; }
  constexpr const std::array<double, 4>& operator[](std::size_t row) const noexcept { return m[row]; }
  friend constexpr bool operator==(const Mat4&, const Mat4&) = default;
};

constexpr Mat4 transposed(const Mat4& a) noexcept {
  Mat4 t;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) t[i][j] = a[j][i];
  return t;
}

constexpr DDVec3 operator-(const DDVec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
constexpr DDVec3 operator+(const DDVec3& a, const DDVec3& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr DDVec3 operator*(const DDVec3& a, DoubleDouble k) noexcept { return {a.x * k, a.y * k, a.z * k}; }

constexpr DoubleDouble dot(const DDVec3& a, const DDVec3& b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// a . b, or 0 where the products cancel to less than the error of a and b.
inline DoubleDouble dotOrZero(const DDVec3& a, const DDVec3& b) noexcept {
  const DDVec3 products{a.x * b.x, a.y * b.y, a.z * b.z};
  const DoubleDouble sum = products.x + products.y + products.z;
  const double largest = std::max({std::fabs(products.x.hi), std::fabs(products.y.hi), std::fabs(products.z.hi)});
  return std::fabs(sum.hi) <= largest * kCancellation ? DoubleDouble() : sum;
}

/// a x b, each component 0 where its products cancel to less than the error of a and b.
constexpr DDVec3 cross(const DDVec3& a, const DDVec3& b) noexcept {
  return {sumOrZero(a.y * b.z, -(a.z * b.y)), sumOrZero(a.z * b.x, -(a.x * b.z)), sumOrZero(a.x * b.y, -(a.y * b.x))};
}

constexpr DDVec3 toDoubleDouble(const Vec3& a) noexcept { return {a.x, a.y, a.z}; }
/// The nearest doubles; adding 0 turns -0 into 0.
constexpr Vec3 rounded(const DDVec3& a) noexcept { return {a.x.hi + 0.0, a.y.hi + 0.0, a.z.hi + 0.0}; }

inline DDVec3 scaleByPowerOfTwo(const DDVec3& a, int exponent) noexcept {
  return {scaleByPowerOfTwo(a.x, exponent), scaleByPowerOfTwo(a.y, exponent), scaleByPowerOfTwo(a.z, exponent)};
}

inline double maxAbs(const Vec3& a) noexcept { return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}); }
inline double maxAbs(const DDVec3& a) noexcept { return maxAbs(rounded(a)); }

inline bool isFinite(const Vec3& a) noexcept { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// The power of two k for which a * 2^k has its largest component in [1, 2); 0 for a zero or non-finite vector.
inline int exponentToUnit(const DDVec3& a) noexcept {
  const double largest = maxAbs(a);
  return largest > 0 && std::isfinite(largest) ? -std::ilogb(largest) : 0;
}

/// 1 / |a|, for a that is not zero; scaled first, so that nothing overflows or underflows on the way.
inline DoubleDouble inverseLength(const DDVec3& a) noexcept {
  const int k = exponentToUnit(a);
  const DDVec3 scaled = scaleByPowerOfTwo(a, k);
  return scaleByPowerOfTwo(DoubleDouble(1) / sqrt(dot(scaled, scaled)), k);
}

/// a / |a|, for a that is not zero.
inline DDVec3 normalized(const DDVec3& a) noexcept {
  const DDVec3 scaled = scaleByPowerOfTwo(a, exponentToUnit(a));
  return scaled * inverseLength(scaled);
}

}  // namespace viewproj
