#include "viewproj/screen.hpp"

#include <cmath>

#include "projection/exact_point.hpp"
#include "projection/kernels/formulas.hpp"

namespace viewproj {

using namespace detail;
namespace {

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
      precision == Precision::standard ? byStandard(c.constants, point) : pointKernels().exactPoint(c.constants, point);
  if (!r.valid && !r.behind) return exactToScreen(c, point);
  if (!isDirection) return settled(c, r.valid, {r.x, r.y, r.depth}, r.distance, precision);
  const std::uint8_t alsoOutside = std::isfinite(c.projection.far) ? sideFar : 0;
  return settled(c, r.valid, {r.x, r.y, c.depthAtInfinity}, NAN, precision, alsoOutside);
}

/// One point of a camera with a lens.
ScreenPoint throughLens(const CameraParts& c, const Vec4& point) noexcept {
  if (point.w != 1) return exactToScreen(c, point);
  const Projected<double, bool> r = pointKernels().exactPoint(c.constants, point);
  if (!r.valid && !r.behind) return exactToScreen(c, point);
  return settled(c, r.valid && !std::isnan(r.x), {r.x, r.y, r.depth}, r.distance, Precision::exact);
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

}  // namespace viewproj
