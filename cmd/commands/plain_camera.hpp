// A camera as plain doubles, for trying many thousands of them on a few pairs.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "camera/plain_camera.hpp"
#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::cmd {

/// Rows of a 3x3 matrix.
using Rows = std::array<Vec3, 3>;
inline constexpr Rows kUnit = {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

inline Vec3 operator*(const Rows& m, const Vec3& v) {
  return {detail::dot(m[0], v), detail::dot(m[1], v), detail::dot(m[2], v)};
}
inline Vec3 column(const Rows& m, std::size_t i) { return {m[0][i], m[1][i], m[2][i]}; }
inline Rows transposed(const Rows& m) { return {column(m, 0), column(m, 1), column(m, 2)}; }
inline Rows operator*(const Rows& a, const Rows& b) {
  const Rows t = transposed(b);
  return {t * a[0], t * a[1], t * a[2]};
}
inline Rows diagonal(double k) { return {Vec3{k, 0, 0}, {0, k, 0}, {0, 0, k}}; }
inline double determinant(const Rows& m) { return detail::dot(m[0], detail::crossOf(m[1], m[2])); }

/// About the vector, by its length in radians.
Rows turn(const Vec3& vector);
/// Of a rotation: the axis, times twice the sine of the angle.
inline Vec3 skewOf(const Rows& r) { return {r[2].y - r[1].z, r[0].z - r[2].x, r[1].x - r[0].y}; }
/// In radians, of a rotation.
inline double angleOf(const Rows& r) { return std::atan2(length(skewOf(r)), r[0].x + r[1].y + r[2].z - 1); }

inline Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }
inline double length(const Vec2& a) { return std::sqrt(a.x * a.x + a.y * a.y); }

/// The numbers of a lens, as viewproj/lens.hpp has them. All 0: the pinhole.
struct PlainLens {
  bool isAngle = false;  ///< fisheye and fov
  double xi = 0, alpha = 0, beta = 1, across = 1;
  std::array<double, 6> k{};
  std::array<double, 2> p{};
  double limitCosine = 0;  ///< of the angle from the axis from which on it sees nothing

  /// Whether it has Brown's radial and tangential terms alone.
  bool isBrown() const { return !isAngle && xi == 0 && alpha == 0 && k[3] == 0 && k[4] == 0 && k[5] == 0; }
  /// Of focal length 1. NaN for what it does not see.
  Vec2 operator()(const Vec3& direction) const;
  friend bool operator==(const PlainLens&, const PlainLens&) = default;
};

struct PlainCamera {
  Rows axes;  ///< right, down and forward in the world
  Vec3 eye;
  Vec2 focal, centre;                   ///< in pixels; focal.y is negative where y runs upwards
  std::optional<PlainLens> lens = {};   ///< of lensOf, or one that is sought
  std::optional<Lens> lensOfFile = {};  ///< undistorts
  bool isOrthographic = false;
};

PlainCamera plainOf(const Camera& camera);
PlainPose poseOf(const PlainCamera& camera);

/// From the eye, in the world: a weight of 0 is a direction.
Vec3 wayTo(const PlainCamera& camera, const Vec4& point);
/// NaN where the point has none.
Vec2 pixelOf(const PlainCamera& camera, const Vec4& point);
/// The ray of a pixel in the camera's axes, of unit length; 0 where the lens has none.
Vec3 rayOf(const PlainCamera& camera, const Vec2& pixel);
/// The same pixel without the lens, or with the lens a second time. NaN where there is none.
Vec2 withoutLens(const PlainCamera& camera, const Vec2& pixel);
Vec2 bentAgain(const PlainCamera& camera, const Vec2& pixel);

}  // namespace viewproj::cmd
