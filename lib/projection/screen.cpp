#include "viewproj/screen.hpp"

#include <cmath>
#include <limits>

#include "projection/exact_point.hpp"
#include "projection/kernels/formulas.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ScreenPoint settledExactly(const CameraParts& c, const Vec4& point) noexcept {
  return isInDomain(c.pose.eye, point) ? exactToScreen(c, point) : without(PointStatus::outOfRange, kNaN);
}

/// A residual that a camera does not have adds zeros: the same bits.
Projected<double, bool> byStandard(const ProjectionConstants& k, const Vec3& p) noexcept {
  return k.orthographic ? StandardFormula<ScalarLanes, Traits<true, true, true>>(k).point(p.x, p.y, p.z)
                        : StandardFormula<ScalarLanes, Traits<false, true, true>>(k).point(p.x, p.y, p.z);
}

/// Of what a formula has settled.
ScreenPoint settled(const CameraParts& c, const Projected<double, bool>& r, double depth, double distance,
                    Precision precision) noexcept {
  ScreenPoint p = without(PointStatus::behind, distance);
  if (r.valid) {
    p = {r.x, r.y, depth, distance};
    p.outside = sidesBeyond(c, p);
  }
  p.precision = precision;
  p.certain = precision == Precision::exact;
  return p;
}

}  // namespace

bool isInRange(const Camera& camera, const Vec4& point) noexcept { return isInDomain(parts(camera).pose.eye, point); }

ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  const Projected<double, bool> r =
      precision == Precision::standard ? byStandard(c.constants, point) : kernels().exactPoint(c.constants, point);
  if (r.valid || r.behind) return settled(c, r, r.depth, r.distance, precision);
  return settledExactly(c, {point.x, point.y, point.z, 1});
}

ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  const Vec3 xyz{point.x, point.y, point.z};
  if (point.w == 1) return worldToScreen(camera, xyz, precision);
  const CameraParts& c = parts(camera);
  if (point.w != 0 || c.projection.orthographic) return settledExactly(c, point);
  const Projected<double, bool> r = kernels().exactDirection(c.constants, xyz);  // its vanishing point
  if (!r.valid && !r.behind) return settledExactly(c, point);
  ScreenPoint p = settled(c, r, c.depthAtInfinity, kNaN, Precision::exact);
  if (r.valid && std::isfinite(c.projection.far)) p.outside |= sideFar;
  return p;
}

}  // namespace viewproj
