#include <algorithm>
#include <bit>
#include <cmath>

#include "projection/exact_point.hpp"
#include "projection/kernels/kernels.hpp"
#include "viewproj/screen.hpp"

namespace viewproj {

using namespace detail;
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Vec2) == 2 * sizeof(double));

/// Points go in blocks: input and output may be the same memory, and a point that is not settled is read again.
constexpr std::size_t kBlock = 192;

/// Of a block, the points that a kernel has left: use(index) settles each.
struct Left {
  std::uint64_t bits[kBlock / 64] = {};

  bool has(std::size_t i) const noexcept { return bits[i / 64] >> i % 64 & 1; }
  template <class Use>
  void each(const Use& use) const noexcept {
    for (std::size_t i = 0; i < kBlock; i += 64)
      for (std::uint64_t rest = bits[i / 64]; rest; rest &= rest - 1)
        use(i + static_cast<std::size_t>(std::countr_zero(rest)));
  }
};

ScreenPoint settledAlone(const Camera& camera, const Vec3& point, BatchCounts& counts) noexcept {
  const ScreenPoint p = worldToScreen(camera, point, Precision::exact);
  ++counts.escalated;
  if (p.status == PointStatus::inFront && !p.certain) ++counts.uncertain;
  return p;
}

Kernels::Project kernelOf(Precision precision) noexcept {
  return precision == Precision::standard ? kernels().standard : kernels().exact;
}

}  // namespace

BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen,
                          Precision precision) noexcept {
  const auto kernel = kernelOf(precision);
  const std::size_t count = std::min(points.size(), screen.size());
  const bool inPlace = points.data() < screen.data() + count && screen.data() < points.data() + count;
  BatchCounts counts;
  double copy[3 * kBlock];  // unlike vectors, not made zero
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t size = std::min(kBlock, count - i);
    const double* in = &points[i].x;
    if (inPlace) in = std::copy_n(in, 3 * size, copy) - 3 * size;
    Vec3* out = screen.data() + i;
    Left left;
    kernel(parts(camera).constants, in, &out->x, nullptr, size, left.bits);
    left.each([&](std::size_t j) {
      const ScreenPoint p = settledAlone(camera, {in[3 * j], in[3 * j + 1], in[3 * j + 2]}, counts);
      out[j] = {p.x, p.y, p.depth};
    });
  }
  return counts;
}

BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<ScreenPoint> screen,
                          Precision precision) noexcept {
  const auto kernel = kernelOf(precision);
  const std::size_t count = std::min(points.size(), screen.size());
  BatchCounts counts;
  double position[3 * kBlock], distance[kBlock];
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t size = std::min(kBlock, count - i);
    Left left;
    kernel(parts(camera).constants, &points[i].x, position, distance, size, left.bits);
    for (std::size_t j = 0; j < size; ++j) {
      ScreenPoint& p = screen[i + j];
      if (left.has(j)) {
        p = settledAlone(camera, points[i + j], counts);
        continue;
      }
      const double* const xyz = position + 3 * j;
      if (std::isnan(xyz[0])) {
        p = without(PointStatus::behind, distance[j]);
      } else {
        p = {xyz[0], xyz[1], xyz[2], distance[j]};
        p.outside = sidesBeyond(parts(camera), p);
      }
      p.precision = precision;
      p.certain = precision == Precision::exact;
    }
  }
  return counts;
}

void screenToRayDirections(const Camera& camera, std::span<const Vec2> pixels, std::span<Vec3> directions) noexcept {
  const std::size_t count = std::min(pixels.size(), directions.size());
  const CameraParts& c = parts(camera);
  if (c.projection.orthographic) {
    std::fill_n(directions.data(), count, c.direction);
    return;
  }
  for (std::size_t i = 0; i < count; i += kBlock) {
    Left left;
    kernels().rays(c.constants, &pixels[i].x, &directions[i].x, std::min(kBlock, count - i), left.bits);
    left.each([&](std::size_t j) { directions[i + j] = screenToRay(camera, pixels[i + j]).direction; });
  }
}

}  // namespace viewproj
