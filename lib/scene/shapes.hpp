// The shapes of a scene, in world coordinates.
#pragma once

#include <cmath>

#include "numbers/vectors.hpp"

namespace viewproj {

/// All points p with normal . (p - point) = 0. The normal need not be of unit length.
struct Plane {
  Vec3 point, normal;
};

/// A radius of 0 is a point.
struct Sphere {
  Vec3 center;
  double radius = 0;
};

/// Axis-aligned, its faces included. May be flat: a rectangle, a segment or a point.
struct Box {
  Vec3 min, max;
};

/// Its edges and corners included. A triangle of no area is hit by no ray.
struct Triangle {
  Vec3 a, b, c;
};

/// Of revolution about z, centred at the origin.
struct Ellipsoid {
  double equatorial = 0, polar = 0;  ///< semi-axes
};

/// WGS84 in ECEF metres: a = 6378137 and b = a (1 - 1/298.257223563), the nearest double.
inline constexpr Ellipsoid kWgs84{6378137, 6356752.314245179};

// Whether a shape is one: finite numbers, a normal that is not zero, radius >= 0, min <= max, semi-axes > 0. Shapes
// that are not valid are hit by no ray and are outside of every frustum. Written so that NaN fails.

inline bool isValid(const Plane& p) noexcept { return isFinite(p.point) && isFinite(p.normal) && maxAbs(p.normal) > 0; }
inline bool isValid(const Sphere& s) noexcept { return isFinite(s.center) && s.radius >= 0 && std::isfinite(s.radius); }
inline bool isValid(const Box& b) noexcept {
  return isFinite(b.min) && isFinite(b.max) && b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z;
}
inline bool isValid(const Triangle& t) noexcept { return isFinite(t.a) && isFinite(t.b) && isFinite(t.c); }
inline bool isValid(const Ellipsoid& e) noexcept {
  return e.equatorial > 0 && e.polar > 0 && std::isfinite(e.equatorial) && std::isfinite(e.polar);
}

}  // namespace viewproj
