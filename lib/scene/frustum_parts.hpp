// The numbers of a frustum.
#pragma once

#include <array>

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "projection/exact_point.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::detail {

/// For a point or a vector: whether it is finite and up to kFarthestPoint. NaN fails.
inline bool isInRange(const Vec3& v) noexcept { return maxAbs(v) <= kFarthestPoint && isFinite(v); }

/// The corners of a box, with max along x, y, z where bit 0, 1, 2 of the index is set.
inline std::array<Vec3, 8> cornersOf(const Box& b) noexcept {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z};
  return corners;
}

/// A plane in a point's distances X, Y, W along the camera's axes. The signed distance, positive inside, is
///   scale (X - edge W)   left and right; bottom and top have Y in place of X
///   scale (X - edge)     the same in orthographic
///   scale (W - edge)     near and far
/// and with the rounded plane normal . (point - eye) + offset.
struct ExactPlane {
  Side side = sideLeft;
  Wide edge, scale;
  Vec3 normal;
  double offset = 0;
};

struct FrustumParts {
  Camera camera;
  std::array<ExactPlane, 6> planes{};
  std::size_t count = 0;
  std::array<FrustumPlane, 6> rounded{};

  const ExactPlane* begin() const noexcept { return planes.data(); }
  const ExactPlane* end() const noexcept { return planes.data() + count; }
};

/// How far inside a plane a point lies, in world units. Negative beyond the plane, 0 if it counts as on it.
Wide distanceInside(const FrustumParts& frustum, const ExactPlane& plane, const AxisDistances& point) noexcept;

inline const FrustumParts& parts(const Frustum& frustum) noexcept { return *Access::shared(frustum); }

}  // namespace viewproj::detail
