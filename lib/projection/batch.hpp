// Many points or pixels at a time.
#pragma once

#include <cstddef>
#include <span>

#include "camera/camera.hpp"
#include "projection/screen.hpp"

namespace viewproj {

/// What became of the points of a batch.
struct BatchCounts {
  std::size_t escalated = 0;  ///< settled one by one: off the kernel's range, next to the eye plane, or not certain
  std::size_t uncertain = 0;  ///< exact: of those, the ones that no arithmetic here decides (ties, numbers about 0)
};

/// Screen x, screen y and window depth of each point, NaN where it has none (behind the eye plane, or not finite): the
/// numbers of worldToScreen for a single point, bit for bit, on every processor. Both spans have the same size and may
/// be the same memory.
BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen,
                          Precision precision = Precision::exact) noexcept;

/// The cheapest precision that is within tolerance pixels (precisionWithin) for points in the picture and one more
/// picture on every side of it; exact for every other.
BatchCounts worldToScreenWithin(const Camera& camera, double tolerance, std::span<const Vec3> points,
                                std::span<Vec3> screen) noexcept;

/// The same in full, with viewDistance, status and the sides a point lies beyond: the single point's, bit for bit.
/// Takes about a third longer.
BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<ScreenPoint> screen,
                          Precision precision = Precision::exact) noexcept;
BatchCounts worldToScreenWithin(const Camera& camera, double tolerance, std::span<const Vec3> points,
                                std::span<ScreenPoint> screen) noexcept;

/// The unit directions of the rays through screen positions, within kRayDirectionBound of the true ones.
void screenToRayDirections(const Camera& camera, std::span<const Vec2> pixels, std::span<Vec3> directions) noexcept;

}  // namespace viewproj
