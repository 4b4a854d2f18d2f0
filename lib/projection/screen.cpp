#include "viewproj/screen.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "projection/blocks.hpp"
#include "projection/exact_point.hpp"
#include "projection/kernels/formulas.hpp"

namespace viewproj {

using namespace detail;
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Vec2) == 2 * sizeof(double));

Kernels::Project kernelOf(const CameraParts& c, Precision precision) noexcept {
  return c.lens ? kernels().throughLens : precision == Precision::standard ? kernels().standard : kernels().exact;
}

/// A point that a formula has settled. isSeen: it has a screen position. `alsoOutside`:
/// sides that a direction lies beyond.
ScreenPoint settled(const CameraParts& c, bool isSeen, const Vec3& position, double distance, Precision precision,
                    std::uint8_t alsoOutside = 0) noexcept {
  const bool isExact = precision == Precision::exact;
  if (!isSeen && distance > 0) return {NAN, NAN, position.z, distance, PointStatus::beyondLens, 0, isExact, precision};
  if (!isSeen) return {NAN, NAN, NAN, distance, PointStatus::behind, 0, isExact, precision};
  const std::uint8_t outside = sidesBeyond(c, {position.x, position.y, position.z, distance}) | alsoOutside;
  // Made in one go: small members that are set one by one and then copied cost more than the projection. Adding 0 turns
  // -0 into 0, which a residual does.
  return {position.x, position.y, position.z, distance + 0.0, PointStatus::inFront, outside, isExact, precision};
}

/// A residual that a camera does not have adds zeros: the same bits.
Projected<double, bool> byStandard(const ProjectionConstants& k, const Vec4& p) noexcept {
  return k.orthographic ? StandardFormula<ScalarLanes, Traits<true, true, true>>(k).point(p.x, p.y, p.z)
                        : StandardFormula<ScalarLanes, Traits<false, true, true>>(k).point(p.x, p.y, p.z);
}

/// One point of a camera without a lens.
ScreenPoint alone(const CameraParts& c, const Vec4& point, Precision precision) noexcept {
  const bool isDirection = point.w == 0;
  if (point.w != 1 && !(isDirection && !c.projection.orthographic)) return exactToScreen(c, point);
  if (isDirection) precision = Precision::exact;
  const Projected<double, bool> r =
      precision == Precision::standard ? byStandard(c.constants, point) : kernels().exactPoint(c.constants, point);
  if (!r.valid && !r.behind) return exactToScreen(c, point);
  if (!isDirection) return settled(c, r.valid, {r.x, r.y, r.depth}, r.distance, precision);
  const std::uint8_t alsoOutside = std::isfinite(c.projection.far) ? sideFar : 0;
  return settled(c, r.valid, {r.x, r.y, c.depthAtInfinity}, NAN, precision, alsoOutside);
}

/// One point of a camera with a lens.
ScreenPoint throughLens(const CameraParts& c, const Vec4& point) noexcept {
  if (point.w != 1) return exactToScreen(c, point);
  const Projected<double, bool> r = kernels().exactPoint(c.constants, point);
  if (!r.valid && !r.behind) return exactToScreen(c, point);
  return settled(c, r.valid && !std::isnan(r.x), {r.x, r.y, r.depth}, r.distance, Precision::exact);
}

/// One of a batch.
ScreenPoint counted(const ScreenPoint& p, BatchCounts& counts) noexcept {
  ++counts.escalated;
  if (p.status == PointStatus::inFront && p.precision == Precision::exact && !p.certain) ++counts.uncertain;
  return p;
}

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

}  // namespace

bool isInRange(const Camera& camera, const Vec4& point) noexcept { return isInDomain(parts(camera).pose.eye, point); }

std::uint8_t sidesBeyond(const Camera& camera, const Vec2& screen) noexcept {
  return detail::sidesBeyond(parts(camera), {screen.x, screen.y, NAN, NAN});
}

ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision) noexcept {
  return worldToScreen(camera, Vec4{point.x, point.y, point.z, 1}, precision);
}

ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  return c.lens ? throughLens(c, point) : alone(c, point, precision);
}

BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen,
                          Precision precision) noexcept {
  return worldToScreen(camera, Points(points), screen, precision);
}

BatchCounts worldToScreen(const Camera& camera, const Points& points, std::span<Vec3> screen,
                          Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  const auto kernel = kernelOf(c, precision);
  const std::size_t count = std::min(points.count, screen.size());
  // What lies where the results go, or is no Vec3, is copied.
  const auto* const first = static_cast<const std::byte*>(points.first);
  const bool isPlain = !points.areFloats && points.stride == sizeof(Vec3);
  const bool isCopied = !isPlain || first == reinterpret_cast<const std::byte*>(screen.data());
  BatchCounts counts;
  double copy[3 * kBlock];  // unlike vectors, not made zero
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t size = std::min(kBlock, count - i);
    const std::byte* const start = first + i * points.stride;
    const double* const in = isCopied ? copy : reinterpret_cast<const double*>(start);
    if (isCopied) copyPoints(points, start, size, copy);
    Vec3* out = screen.data() + i;
    Left left;
    const auto settle = [&](std::size_t j) {
      const ScreenPoint p =
          counted(worldToScreen(camera, Vec3{in[3 * j], in[3 * j + 1], in[3 * j + 2]}, precision), counts);
      out[j] = {p.x, p.y, p.depth};
    };
    kernel(c.constants, in, &out->x, nullptr, size, left.bits);
    left.each(settle);
  }
  return counts;
}

BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<ScreenPoint> screen,
                          Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  const auto kernel = kernelOf(c, precision);
  if (c.lens) precision = Precision::exact;
  const std::size_t count = std::min(points.size(), screen.size());
  BatchCounts counts;
  double position[3 * kBlock], distance[kBlock];
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t size = std::min(kBlock, count - i);
    Left left;
    kernel(c.constants, &points[i].x, position, distance, size, left.bits);
    for (std::size_t j = 0; j < size; ++j) {
      const double* const p = position + 3 * j;
      if (left.has(j))
        screen[i + j] = counted(worldToScreen(camera, points[i + j], precision), counts);
      else
        screen[i + j] = settled(c, !std::isnan(p[0]), {p[0], p[1], p[2]}, distance[j], precision);
    }
  }
  return counts;
}

}  // namespace viewproj
