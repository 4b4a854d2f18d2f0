// The first step of every projection, a point's distances along the camera's axes, and the last one, its result.
#pragma once

#include <cmath>

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "projection/through_lens.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// Whether a point can be projected: it is finite and not 0 0 0 0, a point is no farther than kFarthestPoint from the
/// eye and a direction no longer, and the weight is 0 or between 1e-45 and 1e45 in magnitude.
bool isInDomain(const Vec3& eye, const Vec4& point) noexcept;
/// Whether a pixel can have a ray. NaN fails.
inline bool isInDomain(const Vec2& pixel) noexcept {
  return std::fabs(pixel.x) < kFarthestPoint && std::fabs(pixel.y) < kFarthestPoint;
}

/// Distances along right, up and forward, not yet divided by the point's weight. Each is within 2^-99 of itself: 0 is
/// exact, and so are the signs.
struct AxisDistances {
  Wide right, up, forward;
};

/// Computed from the exact rows in about a microsecond. The point must pass isInDomain.
AxisDistances exactDistances(const PoseParts& pose, const Vec4& point) noexcept;

/// A point that has no screen position.
inline ScreenPoint without(PointStatus status, double viewDistance) noexcept {
  ScreenPoint p;
  p.x = p.y = p.depth = kNaN;
  p.viewDistance = viewDistance;
  p.status = status;
  return p;
}

/// The sides of the picture, and near or far, that a point is beyond. Uses the rounded numbers of the result.
inline std::uint8_t sidesBeyond(const CameraParts& c, const ScreenPoint& p) noexcept {
  const bool down = c.viewport.origin == Origin::topLeft;
  unsigned sides = 0;
  // A NaN counts as outside.
  if (!(p.x >= c.corners.first.x)) sides |= sideLeft;
  if (!(p.x <= c.corners.last.x)) sides |= sideRight;
  if (!(p.y >= c.corners.first.y)) sides |= down ? sideTop : sideBottom;
  if (!(p.y <= c.corners.last.y)) sides |= down ? sideBottom : sideTop;
  // Through a lens a point may be seen that is not in front, by a camera without a near plane too.
  if (p.viewDistance < c.projection.near && hasDepth(c.projection)) sides |= sideNear;
  if (p.viewDistance > c.projection.far) sides |= sideFar;
  return static_cast<std::uint8_t>(sides);
}

/// A point that a formula has settled. isSeen: it has a screen position. alsoOutside: sides that a direction lies
/// beyond.
inline ScreenPoint settled(const CameraParts& c, bool isSeen, const Vec3& position, double distance,
                           Precision precision, std::uint8_t alsoOutside = 0) noexcept {
  const bool isExact = precision == Precision::exact;
  if (!isSeen && distance > 0) return {NAN, NAN, position.z, distance, PointStatus::beyondLens, 0, isExact, precision};
  if (!isSeen) return {NAN, NAN, NAN, distance, PointStatus::behind, 0, isExact, precision};
  const std::uint8_t outside = sidesBeyond(c, {position.x, position.y, position.z, distance}) | alsoOutside;
  // Made in one go: small members that are set one by one and then copied cost more than the projection. Adding 0 turns
  // -0 into 0, which a residual does.
  return {position.x, position.y, position.z, distance + 0.0, PointStatus::inFront, outside, isExact, precision};
}

/// The screen position of any point, from exactDistances. A number that is not certain is a tie or cancels to about 0.
ScreenPoint exactToScreen(const CameraParts& camera, const Vec4& point) noexcept;

/// The same point's direction, of a camera with a lens.
Sight<DoubleDouble> exactSight(const CameraParts& camera, const Vec4& point) noexcept;

}  // namespace viewproj::detail
