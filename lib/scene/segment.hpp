// The part of a segment of the world that a camera sees.
#pragma once

#include <cstdint>

#include "scene/frustum.hpp"

namespace viewproj {

struct SegmentEnd {
  double t = 0;  ///< a + t (b - a) is this end: 0 is a, 1 is b
  Vec2 screen;
  double depth = 0;         ///< window depth
  double viewDistance = 0;  ///< along the viewing axis
  std::uint8_t side = 0;    ///< the Side that cuts it off here, on whose boundary it lies; 0: the segment's own end
};

struct VisibleSegment {
  bool visible = false;
  SegmentEnd start, end;  ///< start.t <= end.t; as they are made if not visible
};

/// Numbers of an end that a side cuts off: t is within this of the true one, relative to the size of the segment's
/// distances to the planes, and screen and depth within it of the picture's size and the depth range.
inline constexpr double kSegmentBound = 0x1p-50;

/// Clipped against the planes before any division (Liang & Barsky, "A new concept and method for line clipping", 1984,
/// in homogeneous coordinates), so that a segment through the eye plane is cut and not mirrored. A segment that lies on
/// a boundary is visible. Its own ends have the numbers of worldToScreen. Input that is not finite is not visible.
VisibleSegment clipSegment(const Frustum& frustum, const Vec3& a, const Vec3& b) noexcept;

/// t of the segment's point that is seen nearest the pixel. In perspective equal steps on the screen are not equal
/// steps along the segment: 1 / viewDistance is what is linear on the screen. NaN if the segment is not visible.
double parameterUnder(const Frustum& frustum, const VisibleSegment& segment, const Vec2& pixel) noexcept;

/// a + t (b - a), rounded once.
Vec3 pointAlong(const Vec3& a, const Vec3& b, double t) noexcept;

}  // namespace viewproj
