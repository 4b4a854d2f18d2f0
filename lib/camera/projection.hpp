// A projection's numbers.
//
// Every way to describe a lens is a function that ends in six numbers. To add one, add a function that computes the
// edges, and a row to the camera file's reader.
#pragma once

#include "camera/access.hpp"
#include "numbers/double_double.hpp"

namespace viewproj::detail {

/// Edges are distances along the right and the up axis: in perspective on the plane at distance 1 from the eye
/// (tangents), in orthographic anywhere. near and far are distances along the viewing axis.
struct ProjectionParts {
  bool orthographic = false;
  DoubleDouble left, right, bottom, top;
  double near = 0;  ///< perspective: 0 for none
  double far = 0;   ///< may be infinite in perspective

  /// right - left and top - bottom to 2^-98 of themselves, which edges that lie far off the axis do not give; 0: they
  /// do.
  DoubleDouble width{}, height{};
  /// The largest number that left and right, and that bottom and top, were computed from: each is within 2^-98 of it.
  /// 0: the larger of the two edges.
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
/// Throws CameraError unless edges are in order and within the limits of a window, near and far as camera.hpp says.
Projection made(const ProjectionParts& parts);

}  // namespace viewproj::detail
