#include "viewproj/view/ray.hpp"

#include <cmath>
#include <limits>

#include "viewproj/numbers/ulp.hpp"
#include "viewproj/view/kernels/formulas.hpp"
#include "viewproj/view/lens.hpp"

namespace viewproj {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 kNoVector{kNaN, kNaN, kNaN};

bool isFinite(const Vec2& v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y); }

/// A screen position in window coordinates, right and up.
struct WindowPoint {
  DoubleDouble right, up;
};

WindowPoint toWindow(const Camera& c, const Vec2& screen) noexcept {
  return {sumOrZero(screen.x, -c.screen.centerX) / c.screen.scaleX,
          sumOrZero(screen.y, -c.screen.centerY) / c.screen.scaleY};
}

/// The offset from the unrounded eye of the point at a window position and distance.
DDVec3 offsetAt(const Camera& c, const WindowPoint& at, DoubleDouble distance) noexcept {
  const Axes& axes = c.pose.columns;
  const DoubleDouble spread = c.projection.orthographic ? DoubleDouble(1) : distance;
  const DDVec3 along{at.right * spread, at.up * spread, distance};
  return {dotOrZero({axes.right.x, axes.up.x, axes.forward.x}, along),
          dotOrZero({axes.right.y, axes.up.y, axes.forward.y}, along),
          dotOrZero({axes.right.z, axes.up.z, axes.forward.z}, along)};
}

/// The world point at a window position and distance.
Vec3 worldPointAt(const Camera& c, WindowPoint at, DoubleDouble distance) noexcept {
  // Scaled down where a product would overflow on the way.
  const bool huge = std::max(std::fabs(distance.hi), maxAbs(c.pose.eye)) > 0x1p900;
  if (!huge) return rounded(unroundedEye(c.pose) + offsetAt(c, at, distance));
  constexpr int kDown = -200;
  if (c.projection.orthographic) at = {scaleByPowerOfTwo(at.right, kDown), scaleByPowerOfTwo(at.up, kDown)};
  const Vec3 p =
      rounded(scaleByPowerOfTwo(unroundedEye(c.pose), kDown) + offsetAt(c, at, scaleByPowerOfTwo(distance, kDown)));
  return {std::ldexp(p.x, -kDown), std::ldexp(p.y, -kDown), std::ldexp(p.z, -kDown)};
}

Vec3 originAt(const Camera& c, const WindowPoint& at, RayOrigin origin) noexcept {
  const double distance = origin == RayOrigin::nearPlane ? c.projection.near : 0;
  return worldPointAt(c, at, distance);
}

Vec3 exactDirection(const Camera& c, const WindowPoint& at) noexcept {
  return rounded(normalized(c.projection.orthographic ? c.pose.columns.forward : offsetAt(c, at, 1)));
}

Vec3 standardDirection(const Camera& c, const Vec2& screen) noexcept {
  if (c.projection.orthographic) return exactDirection(c, {});
  const auto r = RayFormula<ScalarLanes>(c.constants)(screen.x, screen.y);
  if (!(r.squaredLength < kLargestSquaredLength)) return exactDirection(c, toWindow(c, screen));
  return {r.x, r.y, r.z};
}

/// The length of the offset from the eye for a unit of view distance.
double slant(const Camera& c, const WindowPoint& at) noexcept {
  const DDVec3 v = c.projection.orthographic ? c.pose.columns.forward : offsetAt(c, at, 1);
  return 1 / inverseLength(v).hi;
}

/// The point at a distance that is off by at most distanceError.
WorldPoint pointAt(const Camera& c, const WindowPoint& at, DoubleDouble distance, double distanceError) noexcept {
  const Vec3 position = worldPointAt(c, at, distance);
  if (!viewproj::isFinite(position)) return {kNoVector, DepthStatus::infinity};
  const double rounding = halfUlp(position.x) + halfUlp(position.y) + halfUlp(position.z);
  return {position, DepthStatus::point,
          1.01 * (distanceError > 0 ? distanceError * slant(c, at) + rounding : rounding)};
}

}  // namespace

Ray screenToRay(const Camera& c, const Vec2& screen, Precision precision, RayOrigin origin) noexcept {
  if (!isFinite(screen)) return {kNoVector, kNoVector};
  const bool originIsEye = origin == RayOrigin::eye && !c.projection.orthographic;
  if (precision == Precision::standard)
    return {originIsEye ? c.pose.eye : originAt(c, toWindow(c, screen), origin), standardDirection(c, screen)};
  const WindowPoint at = toWindow(c, screen);
  return {originIsEye ? c.pose.eye : originAt(c, at, origin), exactDirection(c, at)};
}

WorldPoint screenToWorld(const Camera& c, const Vec2& screen, double depth) noexcept {
  if (!isFinite(screen) || !std::isfinite(depth)) return {kNoVector, DepthStatus::notFinite};
  const Projection& p = c.projection;
  const DoubleDouble range = twoDiff(c.depthAtFar, c.depthAtNear);
  // How far the depth is from near's and from far's, as shares of the range: they sum to 1.
  const DoubleDouble fromNear = twoDiff(depth, c.depthAtNear) / range;
  const DoubleDouble fromFar = twoDiff(c.depthAtFar, depth) / range;
  const WindowPoint at = toWindow(c, screen);
  const double shareError = halfUlp(depth) / std::fabs(range.hi);
  if (p.orthographic)
    return pointAt(c, at, DoubleDouble(p.near) * fromFar + DoubleDouble(p.far) * fromNear,
                   (p.far - p.near) * shareError);
  if (depth == c.depthAtInfinity) return {kNoVector, DepthStatus::infinity};
  // fromNear = (1 - n/w) f/(f - n), so w = n / (fromFar + fromNear n/f).
  DoubleDouble divisor = fromFar;
  if (std::isfinite(p.far)) divisor += fromNear * (DoubleDouble(p.near) / DoubleDouble(p.far));
  if (!(divisor.hi > 0)) return {kNoVector, DepthStatus::beyond};
  const DoubleDouble distance = DoubleDouble(p.near) / divisor;
  // Towards infinity the distance changes most: by shareError in the divisor, at most.
  const double farthest = divisor.hi - shareError;
  return pointAt(c, at, distance,
                 farthest > 0 ? distance.hi * (shareError / farthest) : std::numeric_limits<double>::infinity());
}

PixelStages pixelStages(const Camera& c, const Vec2& screen) noexcept {
  const WindowPoint at = toWindow(c, screen);
  const DDVec3 toward = c.projection.orthographic ? c.pose.columns.forward : offsetAt(c, at, 1);
  return {{sumOrZero(screen.x, -c.screen.centerX).hi + 0.0, sumOrZero(screen.y, -c.screen.centerY).hi + 0.0},
          {at.right.hi + 0.0, at.up.hi + 0.0},
          rounded(toward),
          (DoubleDouble(1) / inverseLength(toward)).hi,
          screenToRay(c, screen)};
}

DepthStages depthStages(const Camera& c, const Vec2& screen, double depth) noexcept {
  const DepthLine line = inverseDepthLine(c.projection, c.depthAtNear, c.depthAtFar);
  DepthStages s;
  s.offset = line.offset.hi;
  s.scale = line.scale.hi;
  const DoubleDouble sum = sumOrZero(line.offset, line.scale * DoubleDouble(depth));
  s.sum = sum.hi + 0.0;
  s.point = screenToWorld(c, screen, depth);
  s.distance = s.point.status != DepthStatus::point ? kNaN
               : c.projection.orthographic          ? s.sum
                                                    : (DoubleDouble(1) / sum).hi;
  return s;
}

WorldPoint screenToWorldAtDistance(const Camera& c, const Vec2& screen, double viewDistance) noexcept {
  if (!isFinite(screen) || !std::isfinite(viewDistance)) return {kNoVector, DepthStatus::notFinite};
  if (!c.projection.orthographic && !(viewDistance > 0)) return {kNoVector, DepthStatus::beyond};
  return pointAt(c, toWindow(c, screen), viewDistance, 0);
}

double distancePerDepth(const Camera& c, const Vec2& screen, double viewDistance) noexcept {
  const double scale = c.constants.depthScale.hi;
  const double perDepth = c.projection.orthographic ? 1 / scale : viewDistance * (viewDistance / scale);
  return std::fabs(perDepth) * slant(c, toWindow(c, screen));
}

}  // namespace viewproj
