#include "camera/camera.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "camera/error.hpp"
#include "numbers/arithmetic.hpp"

namespace viewproj {

namespace {

/// Of pixels for a unit of the window, and of where its axis lies: one more factor of 2^20 is a double still.
constexpr double kLargestScale = 0x1p1000;

/// near / (far - near), far / (far - near) and 1 / (far - near), for finite far.
struct RangeShares {
  DoubleDouble near, far, one;
};

RangeShares rangeShares(const Projection& p) noexcept {
  const double scale = std::max(std::fabs(p.near), std::fabs(p.far)) > 0x1p900 ? 0x1p-200 : 1;
  const double n = p.near * scale;
  const double f = p.far * scale;
  const DoubleDouble range = twoDiff(f, n);
  return {DoubleDouble(n) / range, DoubleDouble(f) / range, timesPowerOfTwo(DoubleDouble(1) / range, scale)};
}

/// Exactly: rows that are rounded to an axis do not count.
bool forwardIsAxis(const Pose& pose) noexcept {
  const ExactRows& exact = pose.exact;
  if (!exact.isNarrow) return false;
  int zeros = 0, ones = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble row = pose.rows.forward[i];
    if (exact.forward[i].size() == 0 && row.hi == 0) ++zeros;
    // A row made of unit length is 1 where its other parts are 0; one that was given has to be.
    const bool made = exact.translation[0].isZero() && exact.translation[1].isZero() && exact.translation[2].isZero();
    const bool given = exact.forward[i].size() == 1 && std::fabs(exact.forward[i].term(0)) == 1 &&
                       exact.forwardScale.hi == 1 && exact.forwardScale.lo == 0;
    if (std::fabs(row.hi) == 1 && row.lo == 0 && (made || given)) ++ones;
  }
  return exact.error == 0 && zeros == 2 && ones == 1 && pose.residual.x.hi == 0 && pose.residual.y.hi == 0 &&
         pose.residual.z.hi == 0;
}

double rangeOf(std::initializer_list<double> numbers) noexcept {
  double range = 1;
  for (const double number : numbers) {
    const double size = std::fabs(number);
    if (size == 0 || std::isinf(size)) continue;
    range = std::max({range, size, 1 / size});
  }
  return range;
}

}  // namespace

DepthLine depthLine(const Projection& p, double atNear, double atFar) noexcept {
  // perspective:   offset = (f atFar - n atNear) / (f - n)     scale = f n (atNear - atFar) / (f - n)
  // infinite far:  offset = atFar                              scale = n (atNear - atFar)
  // orthographic:  offset = (f atNear - n atFar) / (f - n)     scale = (atFar - atNear) / (f - n)
  // f / (f - n) comes first, because f n may overflow.
  const DoubleDouble step = twoDiff(atNear, atFar);
  if (std::isinf(p.far)) return {atFar, DoubleDouble(p.near) * step};
  const RangeShares share = rangeShares(p);
  if (p.orthographic) return {share.far * DoubleDouble(atNear) - share.near * DoubleDouble(atFar), -step * share.one};
  return {share.far * DoubleDouble(atFar) - share.near * DoubleDouble(atNear), share.far * DoubleDouble(p.near) * step};
}

Camera makeCamera(const Pose& pose, const Projection& projection, const Viewport& viewport,
                  const Convention& convention) {
  if (const char* fault = arithmeticFault()) throw CameraError("arithmetic", fault);
  validate(projection);
  validate(viewport);
  validate(pose, convention.world);
  Camera c;
  c.pose = pose;
  c.projection = projection;
  c.viewport = viewport;
  c.convention = convention;
  c.screen = screenMap(projection, viewport);
  const auto isInRange = [](DoubleDouble center, DoubleDouble scale, double reach) {
    const double size = std::fabs(scale.hi);
    return isFinite(center) && isFinite(scale) && reach < kLargestScale && size > 1 / kLargestScale &&
           size < kLargestScale;
  };
  if (!isInRange(c.screen.centerX, c.screen.scaleX, c.screen.reachX) ||
      !isInRange(c.screen.centerY, c.screen.scaleY, c.screen.reachY))
    throw CameraError("projection", "has a window too small for doubles to tell its pixels apart");

  c.depthAtNear = convention.reverseZ ? viewport.depthSecond : viewport.depthFirst;
  c.depthAtFar = convention.reverseZ ? viewport.depthFirst : viewport.depthSecond;
  if (projection.orthographic)
    c.farOverRange = rangeShares(projection).one;
  else
    c.farOverRange = std::isinf(projection.far) ? DoubleDouble(1) : rangeShares(projection).far;
  const DepthLine depth = depthLine(projection, c.depthAtNear, c.depthAtFar);
  c.depthAtInfinity = depth.offset.hi;

  ProjectionConstants& k = c.constants;
  k.forwardIsAxis = forwardIsAxis(pose);
  const ScreenMap& map = c.screen;
  k.orthographic = projection.orthographic;
  k.eye = pose.eye;
  k.x = pose.rows.right * map.scaleX;
  k.y = pose.rows.up * map.scaleY;
  k.w = pose.rows.forward;
  k.residual = {pose.residual.x * map.scaleX, pose.residual.y * map.scaleY, pose.residual.z};
  k.centerX = map.centerX;
  k.centerY = map.centerY;
  k.depthOffset = depth.offset;
  k.depthScale = depth.scale;
  k.reachX = map.reachX;
  k.reachY = map.reachY;
  const double depths[] = {depth.offset.hi, depth.scale.hi, c.farOverRange.hi};
  const bool depthsAreNumbers = std::isfinite(depths[0]) && std::isfinite(depths[1]) && depths[1] != 0 &&
                                std::isfinite(depths[2]) && depths[2] != 0;
  k.range = !depthsAreNumbers ? std::numeric_limits<double>::infinity()
                              : rangeOf({map.reachX, map.reachY, map.centerX.hi, map.centerY.hi, map.scaleX.hi,
                                         map.scaleY.hi, depths[0], depths[1], depths[2], c.depthAtNear, c.depthAtFar,
                                         c.depthAtFar - c.depthAtNear, projection.near, projection.far});
  k.sizeXY = std::max(maxAbs(k.x), maxAbs(k.y));
  k.sizeW = maxAbs(k.w);
  k.farthest = std::max(std::fabs(projection.near), std::fabs(projection.far));
  k.residualReach = std::max(std::max(std::fabs(k.residual.x.hi), std::fabs(k.residual.y.hi)) / k.sizeXY,
                             std::fabs(k.residual.z.hi) / k.sizeW);
  // A residual that is there counts, however small: whether it does is told from this.
  const auto isZero = [](DoubleDouble a) { return a.hi == 0; };
  if (k.residualReach == 0 && !(isZero(k.residual.x) && isZero(k.residual.y) && isZero(k.residual.z)))
    k.residualReach = std::numeric_limits<double>::min();
  k.rayX = rounded(pose.columns.right * (DoubleDouble(1) / map.scaleX));
  k.rayY = rounded(pose.columns.up * (DoubleDouble(1) / map.scaleY));
  k.rayW = rounded(pose.columns.forward);
  return c;
}

}  // namespace viewproj
