// Many points or pixels at a time; what a kernel cannot settle goes the way of single ones.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "projection/blocks.hpp"
#include "projection/exact_point.hpp"
#include "projection/kernels/kernels.hpp"
#include "viewproj/screen.hpp"

namespace viewproj {

using namespace detail;
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Vec2) == 2 * sizeof(double));

Kernels::Project kernelOf(const CameraParts& c, Precision precision) noexcept {
  return c.lens ? kernels().throughLens : precision == Precision::standard ? kernels().standard : kernels().exact;
}

/// One of a batch.
ScreenPoint counted(const ScreenPoint& p, BatchCounts& counts) noexcept {
  ++counts.escalated;
  if (p.status == PointStatus::inFront && p.precision == Precision::exact && !p.certain) ++counts.uncertain;
  return p;
}

Vec3 pointAt(const double* xyz, std::size_t i) noexcept { return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}; }

void copyPoints(const Points& points, const std::byte* from, std::size_t count, double* to) noexcept {
  for (std::size_t i = 0; i < count; ++i, from += points.stride, to += 3) {
    if (!points.areFloats) {
      std::memcpy(to, from, 3 * sizeof(double));
      continue;
    }
    float xyz[3];
    std::memcpy(xyz, from, sizeof xyz);
    std::copy_n(xyz, 3, to);
  }
}

/// Calls use(first, count, three doubles a point) with each block of the points. What lies where the results go, or is
/// no Vec3, is copied.
template <class Use>
void eachBlock(const Points& points, std::size_t count, const void* results, const Use& use) noexcept {
  const auto* const first = static_cast<const std::byte*>(points.first);
  const bool isCopied = points.areFloats || points.stride != sizeof(Vec3) || points.first == results;
  double copy[3 * kBlock];  // unlike vectors, not made zero
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t size = std::min(kBlock, count - i);
    const std::byte* const start = first + i * points.stride;
    if (isCopied) copyPoints(points, start, size, copy);
    use(i, size, isCopied ? copy : reinterpret_cast<const double*>(start));
  }
}

}  // namespace

BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen,
                          Precision precision) noexcept {
  return worldToScreen(camera, Points(points), screen, precision);
}

BatchCounts worldToScreen(const Camera& camera, const Points& points, std::span<Vec3> screen,
                          Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  const auto kernel = kernelOf(c, precision);
  BatchCounts counts;
  const std::size_t count = std::min(points.count, screen.size());
  eachBlock(points, count, screen.data(), [&](std::size_t first, std::size_t size, const double* in) {
    Vec3* const out = screen.data() + first;
    Left left;
    kernel(c.constants, in, &out->x, nullptr, size, left.bits);
    left.each([&](std::size_t j) {
      const ScreenPoint p = counted(worldToScreen(camera, pointAt(in, j), precision), counts);
      out[j] = {p.x, p.y, p.depth};
    });
  });
  return counts;
}

BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<ScreenPoint> screen,
                          Precision precision) noexcept {
  return worldToScreen(camera, Points(points), screen, precision);
}

BatchCounts worldToScreen(const Camera& camera, const Points& points, std::span<ScreenPoint> screen,
                          Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  const auto kernel = kernelOf(c, precision);
  if (c.lens) precision = Precision::exact;
  BatchCounts counts;
  double position[3 * kBlock], distance[kBlock];
  const std::size_t count = std::min(points.count, screen.size());
  eachBlock(points, count, screen.data(), [&](std::size_t first, std::size_t size, const double* in) {
    Left left;
    kernel(c.constants, in, position, distance, size, left.bits);
    for (std::size_t j = 0; j < size; ++j) {
      const Vec3 at = pointAt(position, j);
      screen[first + j] = left.has(j) ? counted(worldToScreen(camera, pointAt(in, j), precision), counts)
                                      : settled(c, !std::isnan(at.x), at, distance[j], precision);
    }
  });
  return counts;
}

void screenToRayDirections(const Camera& camera, std::span<const Vec2> pixels, std::span<Vec3> directions) noexcept {
  const CameraParts& c = parts(camera);
  const std::size_t count = std::min(pixels.size(), directions.size());
  const auto settle = [&](std::size_t i) { directions[i] = screenToRay(camera, pixels[i]).direction; };
  if (c.projection.orthographic) {
    for (std::size_t i = 0; i < count; ++i)
      if (isInDomain(pixels[i]))
        directions[i] = c.direction;
      else
        settle(i);
  } else {
    const auto rays = c.lens ? kernels().raysThroughLens : kernels().rays;
    for (std::size_t i = 0; i < count; i += kBlock) {
      Left left;
      rays(c.constants, &pixels[i].x, &directions[i].x, std::min(kBlock, count - i), left.bits);
      left.each([&](std::size_t j) { settle(i + j); });
    }
  }
}

void screenToRays(const Camera& camera, std::span<const Vec2> pixels, std::span<Ray> rays, RayOrigin origin) noexcept {
  const CameraParts& c = parts(camera);
  const std::size_t count = std::min(pixels.size(), rays.size());
  const bool isFromEye = origin == RayOrigin::eye && !c.projection.orthographic;
  Vec3 directions[kBlock];
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t size = std::min(kBlock, count - i);
    if (isFromEye) screenToRayDirections(camera, pixels.subspan(i, size), directions);
    for (std::size_t j = 0; j < size; ++j)
      rays[i + j] = isFromEye && isInDomain(pixels[i + j]) ? Ray{c.pose.eye, directions[j]}
                                                           : screenToRay(camera, pixels[i + j], origin);
  }
}

}  // namespace viewproj
