// worldToScreen: where a point of the world lies in the picture.
#pragma once

#include <cstdint>

#include "viewproj/camera/camera.hpp"
#include "viewproj/view/bounds.hpp"

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

/// Projects a point, as near the true value as view/bounds.hpp says of the precision; points that fast or standard
/// cannot bound are projected exactly. Subtracts the eye first (exactly, in exact), then three dot products and one
/// division: no matrix.
ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision = Precision::exact) noexcept;

/// Homogeneous: (x/w, y/w, z/w), negative w included; with w = 0 a direction, whose vanishing point is given. Weights
/// other than 1 are worked on in double-double whatever the precision.
ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision = Precision::exact) noexcept;

/// A single point as the batch of this name (view/batch.hpp) projects it, bit for bit: in the precision chosen where
/// its pixel lies in the picture or one more picture on any side of it, exactly elsewhere. chosen is
/// precisionWithin(camera, tolerance), found once for all points; tolerance is in pixels.
ScreenPoint worldToScreenWithin(const Camera& camera, Precision chosen, const Vec3& point) noexcept;
ScreenPoint worldToScreenWithin(const Camera& camera, Precision chosen, const Vec4& point) noexcept;

}  // namespace viewproj
