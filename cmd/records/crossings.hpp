// Where a ray crosses a height above the Earth.
#pragma once

#include <array>

#include "viewproj/geodesy.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// The distances along a ray, 0 or more, at which its height above the ellipsoid is this: none, one or two, nearest
/// first.
struct HeightCrossings {
  std::array<double, 2> distances{};
  int count = 0;
};

inline constexpr double kLeastCrossedHeight = -1e6;

/// The surface of constant height, which is no ellipsoid, is met within kCrossingBound: there the height is the given
/// one up to that. Heights from kLeastCrossedHeight on; none for a ray that is not finite, or whose direction is not of
/// unit length. A ray that begins within the bound of the surface begins on it. Source: along a line the distance to a
/// convex body has one minimum, found by bisection of its slope, normal . direction; on either side of it Newton's
/// method, kept between bounds.
HeightCrossings crossingsOfHeight(const Ray& ray, double height) noexcept;
inline constexpr double kCrossingBound = 1e-7;  ///< metres, for rays that begin within 5000 km of the ellipsoid

}  // namespace viewproj::cmd
