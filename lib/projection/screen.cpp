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

/// Perspective: the vanishing point.
ScreenPoint directionToScreen(const CameraParts& c, const Vec3& direction) noexcept {
  const Projected<double, bool> r = kernels().exactDirection(c.constants, direction);
  ScreenPoint p;
  if (r.behind) {
    p = without(PointStatus::behind, kNaN);
  } else if (r.valid) {
    p.x = r.x;
    p.y = r.y;
    p.depth = c.depthAtInfinity;
    p.viewDistance = kNaN;
    p.outside = sidesBeyond(c, p);
    if (std::isfinite(c.projection.far)) p.outside |= sideFar;
  } else {
    return settledExactly(c, {direction.x, direction.y, direction.z, 0});
  }
  p.certain = true;
  return p;
}

}  // namespace

bool isInRange(const Camera& camera, const Vec4& point) noexcept { return isInDomain(parts(camera).pose.eye, point); }

ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  const Projected<double, bool> r =
      precision == Precision::standard ? byStandard(c.constants, point) : kernels().exactPoint(c.constants, point);
  ScreenPoint p;
  if (r.behind) {
    p = without(PointStatus::behind, r.distance);
  } else if (r.valid) {
    p.x = r.x;
    p.y = r.y;
    p.depth = r.depth;
    p.viewDistance = r.distance;
    p.outside = sidesBeyond(c, p);
  } else {
    return settledExactly(c, {point.x, point.y, point.z, 1});
  }
  p.precision = precision;
  p.certain = precision == Precision::exact;
  return p;
}

ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  const Vec3 xyz{point.x, point.y, point.z};
  if (point.w == 1) return worldToScreen(camera, xyz, precision);
  const CameraParts& c = parts(camera);
  return point.w == 0 && !c.projection.orthographic ? directionToScreen(c, xyz) : settledExactly(c, point);
}

}  // namespace viewproj
