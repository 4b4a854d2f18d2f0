// What lies outside the picture. Internal.
#pragma once

#include <limits>

#include "camera/camera.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// A point that has no screen position.
inline ScreenPoint without(PointStatus status, double viewDistance) noexcept {
  ScreenPoint p;
  p.x = p.y = p.depth = std::numeric_limits<double>::quiet_NaN();
  p.viewDistance = viewDistance;
  p.status = status;
  return p;
}

/// Beyond which sides of the picture and of near and far, judged on the numbers that are given out.
inline std::uint8_t sidesBeyond(const CameraParts& c, const ScreenPoint& p) noexcept {
  const bool down = c.viewport.origin == Origin::topLeft;
  unsigned sides = 0;
  // Written so that a NaN would be outside.
  if (!(p.x >= c.corners.first.x)) sides |= sideLeft;
  if (!(p.x <= c.corners.last.x)) sides |= sideRight;
  if (!(p.y >= c.corners.first.y)) sides |= down ? sideTop : sideBottom;
  if (!(p.y <= c.corners.last.y)) sides |= down ? sideBottom : sideTop;
  if (p.viewDistance < c.projection.near) sides |= sideNear;
  if (p.viewDistance > c.projection.far) sides |= sideFar;
  return static_cast<std::uint8_t>(sides);
}

}  // namespace viewproj::detail
