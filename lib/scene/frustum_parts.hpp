// A frustum with all its digits.
#pragma once

#include <array>

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::detail {

/// Of a point or a vector, up to kFarthestPoint. Written so that NaN fails.
inline bool isInRange(const Vec3& v) noexcept { return maxAbs(v) <= kFarthestPoint && isFinite(v); }

/// A plane's signed distance to p is normal . (p - eye) + offset, positive inside.
struct ExactPlane {
  Side side = sideLeft;
  WideVec3 normal;
  Wide offset;
  /// A point's distance is within normalBound |p - eye|_1 + offsetBound of the true one. What is no farther from a
  /// plane than that is measured again, by the exact rows. normalBound is kPlaneBound times what FrustumPlane says,
  /// offsetBound is normalBound times the size of what the offset is made of.
  double normalBound = 0, offsetBound = 0;
  /// The same plane by a point's distances along the camera's axes: scale (X - edge W), Y for X of the lower and the
  /// upper side; in orthographic scale (X - edge); of near and far scale (W - edge).
  Wide edge, scale;
};

struct FrustumParts {
  Camera camera;
  std::array<ExactPlane, 6> planes{};
  std::size_t count = 0;
  std::array<FrustumPlane, 6> rounded{};

  const ExactPlane* begin() const noexcept { return planes.data(); }
  const ExactPlane* end() const noexcept { return planes.data() + count; }
};

/// How far inside a plane a point lies, in world units; negative beyond it, 0 where it cannot be told from one on it by
/// exact arithmetic either.
Wide distanceInside(const FrustumParts& frustum, const ExactPlane& plane, const Vec3& point) noexcept;

inline const FrustumParts& parts(const Frustum& frustum) noexcept { return *Access::shared(frustum); }

}  // namespace viewproj::detail
