#include "projection/batch.hpp"

#include <algorithm>
#include <cmath>

#include "projection/bounds.hpp"
#include "projection/kernels/kernels.hpp"
#include "projection/ray.hpp"
#include "projection/screen.hpp"
#include "projection/sides.hpp"

namespace viewproj {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Vec2) == 2 * sizeof(double));

/// Points go in blocks: input and output may be the same memory, and a lane that is not settled is read again.
constexpr std::size_t kBlock = 256;

void tally(BatchCounts& counts, const ScreenPoint& settled) noexcept {
  ++counts.escalated;
  if (settled.status == PointStatus::inFront && !settled.certain) ++counts.uncertain;
}

struct Settling {
  const Camera& camera;
  const Vec3* points;
  Vec3* screen;
  BatchCounts counts;
};

void settlePoint(void* context, std::size_t index) noexcept {
  auto& s = *static_cast<Settling*>(context);
  const ScreenPoint p = worldToScreen(s.camera, s.points[index], Precision::exact);
  s.screen[index] = {p.x, p.y, p.depth};
  tally(s.counts, p);
}

auto kernelOf(Precision precision) noexcept {
  const Kernels& k = kernels();
  return precision == Precision::fast ? k.fast : precision == Precision::standard ? k.standard : k.exact;
}

BatchCounts run(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen, Precision precision,
                PictureReach band) noexcept {
  const auto kernel = kernelOf(precision);
  const std::size_t count = std::min(points.size(), screen.size());
  BatchCounts total;
  const bool inPlace = points.data() < screen.data() + count && screen.data() < points.data() + count;
  Vec3 copy[kBlock];
  const std::size_t step = inPlace ? kBlock : count;
  for (std::size_t i = 0; i < count; i += step) {
    const std::size_t size = std::min(step, count - i);
    const Vec3* in = points.data() + i;
    if (inPlace) in = std::copy_n(in, size, copy) - size;
    Settling settling{camera, in, screen.data() + i, {}};
    kernel(camera.constants, band.x, band.y, &in->x, &settling.screen->x, nullptr, size, {settlePoint, &settling});
    total.escalated += settling.counts.escalated;
    total.uncertain += settling.counts.uncertain;
  }
  return total;
}

/// A block of points in full.
struct FullSettling {
  const Camera& camera;
  const Vec3* points;
  ScreenPoint* screen;
  BatchCounts counts;
  bool settled[kBlock] = {};
};

void settleInFull(void* context, std::size_t index) noexcept {
  auto& s = *static_cast<FullSettling*>(context);
  s.screen[index] = worldToScreen(s.camera, s.points[index], Precision::exact);
  s.settled[index] = true;
  tally(s.counts, s.screen[index]);
}

BatchCounts run(const Camera& camera, std::span<const Vec3> points, std::span<ScreenPoint> screen, Precision precision,
                PictureReach band) noexcept {
  const auto kernel = kernelOf(precision);
  const std::size_t count = std::min(points.size(), screen.size());
  BatchCounts total;
  Vec3 position[kBlock];
  double distance[kBlock];
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t size = std::min(kBlock, count - i);
    FullSettling settling{camera, points.data() + i, screen.data() + i, {}};
    kernel(camera.constants, band.x, band.y, &settling.points->x, &position->x, distance, size,
           {settleInFull, &settling});
    for (std::size_t j = 0; j < size; ++j) {
      if (settling.settled[j]) continue;
      ScreenPoint& p = settling.screen[j];
      if (std::isnan(position[j].x)) {
        p = without(PointStatus::behind, distance[j]);
      } else {
        p = {position[j].x, position[j].y, position[j].z, distance[j]};
        p.outside = sidesBeyond(camera, p);
      }
      p.precision = precision;
      p.certain = precision == Precision::exact;
    }
    total.escalated += settling.counts.escalated;
    total.uncertain += settling.counts.uncertain;
  }
  return total;
}

template <class Screen>
BatchCounts runWithin(const Camera& camera, double tolerance, std::span<const Vec3> points,
                      std::span<Screen> screen) noexcept {
  const Precision precision = precisionWithin(camera, tolerance);
  return run(camera, points, screen, precision,
             precision == Precision::exact ? PictureReach{} : pictureReach(camera, kGuardBand));
}

struct RaySettling {
  const Camera& camera;
  const Vec2* pixels;
  Vec3* directions;
};

void settleRay(void* context, std::size_t index) noexcept {
  auto& s = *static_cast<RaySettling*>(context);
  s.directions[index] = screenToRay(s.camera, s.pixels[index], Precision::exact).direction;
}

}  // namespace

BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen,
                          Precision precision) noexcept {
  return run(camera, points, screen, precision, {});
}

BatchCounts worldToScreenWithin(const Camera& camera, double tolerance, std::span<const Vec3> points,
                                std::span<Vec3> screen) noexcept {
  return runWithin(camera, tolerance, points, screen);
}

BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<ScreenPoint> screen,
                          Precision precision) noexcept {
  return run(camera, points, screen, precision, {});
}

BatchCounts worldToScreenWithin(const Camera& camera, double tolerance, std::span<const Vec3> points,
                                std::span<ScreenPoint> screen) noexcept {
  return runWithin(camera, tolerance, points, screen);
}

void screenToRayDirections(const Camera& camera, std::span<const Vec2> pixels, std::span<Vec3> directions) noexcept {
  const std::size_t count = std::min(pixels.size(), directions.size());
  if (count == 0) return;
  if (camera.projection.orthographic) {
    const Vec3 direction = screenToRay(camera, {0, 0}, Precision::standard).direction;
    std::fill_n(directions.data(), count, direction);
    return;
  }
  RaySettling settling{camera, pixels.data(), directions.data()};
  kernels().rays(camera.constants, &pixels.data()->x, &directions.data()->x, count, {settleRay, &settling});
}

}  // namespace viewproj
