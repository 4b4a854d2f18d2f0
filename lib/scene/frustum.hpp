// What part of the world a camera sees, as planes; and whether a point, a sphere or a box lies in it.
//
// The planes come from the camera's parameters, so they do not depend on how a convention writes its matrices. They are
// those that Gribb & Hartmann, "Fast extraction of viewing frustum planes from the world-view-projection matrix", 2001,
// read from a matrix, without the digits that a matrix loses (far of a deep forward depth, everything far from the
// origin).
#pragma once

#include <array>
#include <cstdint>

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "projection/screen.hpp"
#include "scene/shapes.hpp"

namespace viewproj {

/// A plane's signed distance to p is normal . (p - eye) + offset, positive inside: culling never forms the world's
/// equation, whose d loses digits with the distance of the eye from the origin.
struct FrustumPlane {
  Side side = sideLeft;
  /// a, b, c, d with (a, b, c) the inward unit normal: a x + b y + c z + d >= 0 inside. Each is within 0.51 ulp of the
  /// true one, or a, b, c within normalBound and d within offsetBound + normalBound |eye|_1. As doubles they give
  /// distances to half an ulp of d: 5e-10 m for an eye in ECEF.
  Vec4 equation;

  WideVec3 normal;
  Wide offset;
  /// A distance is within normalBound r + offsetBound of the true one, with r = |p - eye|_1 of a point, |center -
  /// eye|_1
  /// + radius of a sphere, |min - eye|_1 + |max - eye|_1 of a box. What is no farther beyond a plane than that counts
  /// as on it.
  double normalBound = 0, offsetBound = 0;
};

/// normalBound is this times (1 + e) / |n|, where e is the larger of the two window edges across from each other (0 for
/// near and far, and in orthographic) and |n| the length of right - edge forward, between 1 and 1 + |edge|. offsetBound
/// is normalBound times the size of what the offset is made of: near, far, orthographic edges, the pose's residual.
inline constexpr double kPlaneBound = 0x1p-94;

struct Frustum {
  Camera camera;
  std::array<FrustumPlane, 6> planes;  ///< left, right, bottom, top, near, far
  int count = 6;                       ///< 5 for an infinite far, which has no plane

  const FrustumPlane* begin() const noexcept { return planes.data(); }
  const FrustumPlane* end() const noexcept { return planes.data() + count; }
};

/// For every camera that makeCamera gives: perspective and orthographic, off-centre, shifted or cropped, near negative
/// in orthographic, a pose matrix that is not quite orthogonal.
Frustum viewFrustum(const Camera& camera) noexcept;

enum class CullVerdict : std::uint8_t { inside, intersects, outside };

struct Cull {
  CullVerdict verdict = CullVerdict::outside;
  /// outside: the plane it lies farthest beyond. intersects: the plane of those it straddles that it reaches farthest
  /// beyond. 0 if inside, and for input that is not valid, which is outside.
  std::uint8_t side = 0;
};

// What touches a plane from within is inside, what touches it from without intersects.
//
// `inside` and `outside` are always right, up to the bound above. `intersects` may be said of a sphere or a box that is
// outside: near an edge or a corner of the frustum a shape may lie beyond no single plane and yet miss it. (Exact
// answers need the frustum's edges against the shape; nothing that is seen is ever lost.) Source: Assarsson & Möller,
// "Optimized view frustum culling algorithms for bounding boxes", 2000: a box is outside of a plane if its corner
// farthest along the normal is (p-vertex), and inside if the opposite corner is (n-vertex).

/// inside or outside, as a sphere of radius 0 there is inside or not. worldToScreen judges the pixel and the distance
/// that it gives out instead, and so forgives half an ulp of them. A point behind the eye of a perspective is beyond
/// near.
Cull cull(const Frustum& frustum, const Vec3& point) noexcept;

Cull cull(const Frustum& frustum, const Sphere& sphere) noexcept;
Cull cull(const Frustum& frustum, const Box& box) noexcept;
Cull cull(const Frustum& frustum, const Triangle& triangle) noexcept;

/// How far inside a plane a point lies, in world units; negative beyond it, 0 within the bound.
Wide distanceInside(const Frustum& frustum, const FrustumPlane& plane, const Vec3& point) noexcept;

}  // namespace viewproj
