#include "viewproj/view/batch.hpp"

#include <algorithm>

#include "viewproj/view/bounds.hpp"
#include "viewproj/view/kernels/kernels.hpp"
#include "viewproj/view/ray.hpp"
#include "viewproj/view/screen.hpp"

namespace viewproj {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Vec2) == 2 * sizeof(double));

/// Points go in blocks: input and output may be the same memory, and a lane that is not settled is read again.
constexpr std::size_t kBlock = 256;

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
  ++s.counts.escalated;
  if (p.status == PointStatus::inFront && !p.certain) ++s.counts.uncertain;
}

BatchCounts run(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen, Precision precision,
                double bandX, double bandY) noexcept {
  const Kernels& k = kernels();
  const auto kernel = precision == Precision::fast ? k.fast : precision == Precision::standard ? k.standard : k.exact;
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
    kernel(camera.constants, bandX, bandY, &in->x, &settling.screen->x, size, {settlePoint, &settling});
    total.escalated += settling.counts.escalated;
    total.uncertain += settling.counts.uncertain;
  }
  return total;
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
  return run(camera, points, screen, precision, kNoBand, kNoBand);
}

BatchCounts worldToScreenWithin(const Camera& camera, double tolerance, std::span<const Vec3> points,
                                std::span<Vec3> screen) noexcept {
  const Precision precision = precisionWithin(camera, tolerance);
  if (precision == Precision::exact) return worldToScreen(camera, points, screen, precision);
  const PictureReach reach = pictureReach(camera, kGuardBand);
  return run(camera, points, screen, precision, reach.x, reach.y);
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
