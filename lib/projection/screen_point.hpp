// A projected point.
#pragma once

#include <cstdint>

#include "camera/camera.hpp"

namespace viewproj {

/// What a point or a direction of the world is to the camera.
enum class PointStatus : std::uint8_t {
  inFront,     ///< has a screen position
  behind,      ///< perspective: on or behind the plane through the eye; no screen position
  atInfinity,  ///< orthographic: a direction, which no finite screen position belongs to
  notFinite,   ///< the input had a NaN or an infinity, or was 0 0 0 0
};

/// The boundaries of the view that a point may lie beyond, named the same in every convention.
enum Side : std::uint8_t {
  sideLeft = 1,
  sideRight = 2,
  sideBottom = 4,
  sideTop = 8,
  sideNear = 16,
  sideFar = 32,
};

/// Numbers that do not exist are NaN.
struct ScreenPoint {
  double x = 0, y = 0;      ///< position, in the viewport's origin and pixelCenter
  double depth = 0;         ///< window depth, not clamped
  double viewDistance = 0;  ///< along the viewing axis; NaN for a direction
  PointStatus status = PointStatus::inFront;
  std::uint8_t outside = 0;  ///< Sides the point lies beyond; a point on a boundary is inside
  /// exact: x, y, depth and viewDistance are certainly the doubles nearest the true values. Otherwise one of them is a
  /// tie or cancels to about 0, and within kExactUlps or kExactAbsolute.
  bool certain = false;
  /// What the numbers were computed in: exact where the precision asked for could not bound the point.
  /// boundOfPoint of this precision is theirs.
  Precision precision = Precision::exact;

  bool visible() const noexcept { return status == PointStatus::inFront && outside == 0; }
};

}  // namespace viewproj
