// A point's distances along the camera's axes: the one step that every projection begins with; and what a projection
// ends with.
#pragma once

#include <limits>

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "projection/through_lens.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// Whether a point is one that is projected: finite, not 0 0 0 0, no farther than kFarthestPoint from the eye, a
/// direction no longer; its weight 0 or between 1e-90 and 1e90 in magnitude.
bool isInDomain(const Vec3& eye, const Vec4& point) noexcept;

/// Distances along right, up and forward, still to be divided by the point's weight. Each is within 2^-99 of itself and
/// the error, which only a pose of sines and cosines has: its rows are off by 2^-206 and more where up is near the
/// view. Then a distance that cancels to less is 0, and a point nearer to the eye plane than 2^60 errors counts as on
/// it. Otherwise 0 means 0, and the sign of forward is certain.
struct AxisDistances {
  Wide right, up, forward;
  Wide error;
};

/// From the exact rows, in about a microsecond. Of points that isInDomain.
AxisDistances exactDistances(const PoseParts& pose, const Vec4& point) noexcept;

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

/// The screen position of any point, by exactDistances. What is not certain is a tie, or a number that cancels to about
/// 0.
ScreenPoint exactToScreen(const CameraParts& camera, const Vec4& point) noexcept;

/// The same point's tangents, of a camera with a lens.
BoundedTangents exactTangents(const CameraParts& camera, const Vec4& point) noexcept;

}  // namespace viewproj::detail
