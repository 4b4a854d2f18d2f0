// Plain vectors and matrices.
#pragma once

#include <array>
#include <cstddef>

namespace viewproj {

template <class T>
struct Vector3 {
  T x{}, y{}, z{};

  constexpr T& operator[](std::size_t i) noexcept { return i == 0 ? x : i == 1 ? y : z; }
  constexpr const T& operator[](std::size_t i) const noexcept { return i == 0 ? x : i == 1 ? y : z; }
  friend constexpr bool operator==(const Vector3&, const Vector3&) = default;
};

using Vec3 = Vector3<double>;

/// About 106 bits: the sum of high and low, with low at most half an ulp of high.
struct SplitVec3 {
  Vec3 high, low;
};

struct Vec2 {
  double x = 0, y = 0;
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

/// Needs all four numbers or none, so that {1, 2, 3} is a Vec3.
struct Vec4 {
  double x = 0, y = 0, z = 0, w = 0;

  constexpr Vec4() noexcept = default;
  constexpr Vec4(double first, double second, double third, double fourth) noexcept
      : x(first), y(second), z(third), w(fourth) {}
  friend constexpr bool operator==(const Vec4&, const Vec4&) = default;
};

/// Four rows of four, for column vectors: y[i] = sum over j of m[i][j] * x[j].
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

}  // namespace viewproj
