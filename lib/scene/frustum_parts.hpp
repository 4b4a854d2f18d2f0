// The numbers of a frustum, with all their digits.
#pragma once

#include <array>

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::detail {

/// For a point or a vector: whether it is finite and up to kFarthestPoint. NaN fails.
inline bool isInRange(const Vec3& v) noexcept { return maxAbs(v) <= kFarthestPoint && isFinite(v); }

/// A plane. The signed distance of p is normal . (p - eye) + offset, positive inside.
struct ExactPlane {
  Side side = sideLeft;
  WideVec3 normal;
  Wide offset;
  /// A point's distance is within normalBound |p - eye|_1 + offsetBound of the true one. A point no farther from the
  /// plane than that is measured again with the exact rows. normalBound is kPlaneBound times the factor in
  /// FrustumPlane, offsetBound is normalBound times the size of the offset's terms.
  double normalBound = 0, offsetBound = 0;
  /// The same plane in a point's distances along the camera's axes: scale (X - edge W), with Y instead of X for bottom
  /// and top; in orthographic scale (X - edge); for near and far scale (W - edge).
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

/// How far inside a plane a point lies, in world units. Negative beyond the plane, 0 if exact arithmetic too cannot
/// tell the point from one on the plane.
Wide distanceInside(const FrustumParts& frustum, const ExactPlane& plane, const Vec3& point) noexcept;

inline const FrustumParts& parts(const Frustum& frustum) noexcept { return *Access::shared(frustum); }

}  // namespace viewproj::detail
