// The numbers of a projection.
//
// Every way to describe a projection is a function that computes the edges, near and far. To add one, add such a
// function and a row to the camera file's reader.
#pragma once

#include "camera/access.hpp"
#include "numbers/double_double.hpp"

namespace viewproj::detail {

/// Edges are distances along the right and up axes: in perspective on the plane at distance 1 from the eye (tangents),
/// in orthographic at every distance. near and far are distances along the viewing axis.
struct ProjectionParts {
  bool orthographic = false;
  DoubleDouble left, right, bottom, top;
  double near = 0;  ///< perspective: 0 for no near plane
  double far = 0;   ///< may be infinite in perspective

  /// right - left and top - bottom, within 2^-98 relative, if edges far off the axis would not give that; otherwise 0.
  DoubleDouble width{}, height{};
  /// The largest number that left and right (bottom and top) were computed from: each is within 2^-98 of it. 0 means
  /// the larger of the two edges.
  double reachX = 0, reachY = 0;
};

/// A perspective with near 0 has no near plane, and so no depth.
inline bool hasDepth(const ProjectionParts& p) noexcept { return p.orthographic || p.near > 0; }

inline DoubleDouble windowWidth(const ProjectionParts& p) noexcept {
  return p.width.hi > 0 ? p.width : p.right - p.left;
}
inline DoubleDouble windowHeight(const ProjectionParts& p) noexcept {
  return p.height.hi > 0 ? p.height : p.top - p.bottom;
}

inline const ProjectionParts& parts(const Projection& projection) noexcept { return *Access::shared(projection); }
/// Throws CameraError unless edges are in order and the window, near and far are within viewproj/camera.hpp's limits.
Projection made(const ProjectionParts& parts);

}  // namespace viewproj::detail
