// float32 in and out: vertex buffers to screen positions.
//
// Nothing here allocates or throws.
#pragma once

#include <cstddef>

#include "viewproj/camera.hpp"
#include "viewproj/screen.hpp"

namespace viewproj {

/// Points in float32: an array for each coordinate, or vertices of a buffer. strideBytes is from one x to the next, and
/// the same for y and z.
struct FloatPoints {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  std::size_t count = 0;
  std::size_t strideBytes = sizeof(float);
};

/// x, y, z after one another in each vertex, the first at `first`.
constexpr FloatPoints vertices(const float* first, std::size_t count,
                               std::size_t strideBytes = 3 * sizeof(float)) noexcept {
  return count == 0 ? FloatPoints{} : FloatPoints{first, first + 1, first + 2, count, strideBytes};
}

/// Where results go, as FloatPoints.
struct FloatPositions {
  float *x = nullptr, *y = nullptr, *depth = nullptr;
  std::size_t strideBytes = sizeof(float);
};

constexpr FloatPositions positions(float* first, std::size_t strideBytes = 3 * sizeof(float)) noexcept {
  return first ? FloatPositions{first, first + 1, first + 2, strideBytes} : FloatPositions{};
}

/// Screen x, screen y and window depth of each point, NaN where it has none (behind the eye plane, or not finite). fast
/// computes in float32, the eye subtracted in double; standard and exact in their own arithmetic, each result then
/// rounded to float32. What fast cannot bound is settled exactly. The same bits on every processor. screen has room for
/// points.count; it may be the points' own memory in the same shape, or overlap none of it. How wrong:
/// floatBoundOfPoint.
BatchCounts worldToScreen(const Camera& camera, const FloatPoints& points, const FloatPositions& screen,
                          Precision precision = Precision::fast) noexcept;

/// As boundInPicture and boundOfPoint, of results in float32: beside the arithmetic's errors half a unit in the last
/// place of a float32. The points themselves count as exact.
ErrorBound floatBoundInPicture(const Camera& camera, Precision precision = Precision::fast, double band = 1) noexcept;
ErrorBound floatBoundOfPoint(const Camera& camera, const Vec3& point, Precision precision = Precision::fast) noexcept;

}  // namespace viewproj
