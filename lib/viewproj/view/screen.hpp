// worldToScreen: where a point of the world lies in the picture.
#pragma once

#include <cstdint>

#include "viewproj/camera/camera.hpp"

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

  bool visible() const noexcept { return status == PointStatus::inFront && outside == 0; }
};

/// standard, at 60 degrees, 1920x1080, for on-screen points with the eye up to 1e12 from the origin, in pixels;
/// measured against MPFR. The bound for any camera is a matter of its window: see the README.
inline constexpr double kStandardScreenError = 1e-12;

/// exact: units in the last place of the result, for x, y, depth and viewDistance; below 1e-26 of the viewport's size a
/// result that cancels to about zero keeps that absolute error instead.
inline constexpr double kExactUlps = 0.51;
inline constexpr double kExactAbsolute = 1e-26;

/// Projects a point. Subtracts the eye first (exactly, in exact), then three dot products and one division: no matrix.
ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision = Precision::exact) noexcept;

/// Homogeneous: (x/w, y/w, z/w), negative w included; with w = 0 a direction, whose vanishing point is given. Weights
/// other than 1 are worked on in double-double whatever the precision.
ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision = Precision::exact) noexcept;

}  // namespace viewproj
