// Where a ray crosses a height above the Earth.
#pragma once

#include <array>

#include "viewproj/geodesy.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// The distances along a ray, 0 or more, where it has the given height above the ellipsoid: up to two, nearest first.
struct HeightCrossings {
  std::array<double, 2> distances{};
  int count = 0;
};

inline constexpr double kLeastCrossedHeight = -1e6;

/// Finds crossings with the surface of constant height, which is not an ellipsoid: at each, the height is within
/// kCrossingBound of the given one. A ray that begins within the bound of the surface begins on it. None for heights
/// below kLeastCrossedHeight, and for a ray that is not finite or not of unit direction. Method: along a line, the
/// distance to a convex body has one minimum, found by bisection of its slope, normal . direction. On each side of it,
/// Newton's method is kept between bounds.
HeightCrossings crossingsOfHeight(const Ray& ray, double height) noexcept;
inline constexpr double kCrossingBound = 1e-7;  ///< metres, for rays that begin within 5000 km of the ellipsoid

}  // namespace viewproj::cmd
