#include "projection/ray.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "camera/lens.hpp"
#include "numbers/ulp.hpp"
#include "numbers/wide.hpp"
#include "projection/kernels/formulas.hpp"

namespace viewproj {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 kNoVector{kNaN, kNaN, kNaN};

bool isFinite(const Vec2& v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y); }

// Number is DoubleDouble, or Wide where products may leave the range of doubles.

template <class Number>
Number as(DoubleDouble a) noexcept {
  if constexpr (std::is_same_v<Number, Wide>)
    return toWide(a);
  else
    return a;
}

template <class Number>
Vector3<Number> as(const DDVec3& a) noexcept {
  return {as<Number>(a.x), as<Number>(a.y), as<Number>(a.z)};
}

/// A screen position in window coordinates, right and up.
template <class Number>
struct WindowPoint {
  Number right, up;
};

template <class Number>
WindowPoint<Number> toWindow(const Camera& c, const Vec2& screen) noexcept {
  return {sumOrZero(as<Number>(screen.x), -as<Number>(c.screen.centerX)) / as<Number>(c.screen.scaleX),
          sumOrZero(as<Number>(screen.y), -as<Number>(c.screen.centerY)) / as<Number>(c.screen.scaleY)};
}

/// The offset from the unrounded eye of the point at a window position and distance.
template <class Number>
Vector3<Number> offsetAt(const Camera& c, const WindowPoint<Number>& at, Number distance) noexcept {
  const Axes& axes = c.pose.columns;
  const Number spread = c.projection.orthographic ? as<Number>(1) : distance;
  const Vector3<Number> along{at.right * spread, at.up * spread, distance};
  const auto part = [&](std::size_t i) {
    return dotOrZero(as<Number>(DDVec3{axes.right[i], axes.up[i], axes.forward[i]}), along);
  };
  return {part(0), part(1), part(2)};
}

/// The world point at a window position and distance.
Vec3 worldPointAt(const Camera& c, const WindowPoint<DoubleDouble>& at, DoubleDouble distance) noexcept {
  return rounded(unroundedEye(c.pose) + offsetAt(c, at, distance));
}

Vec3 worldPointAt(const Camera& c, const WindowPoint<Wide>& at, const Wide& distance) noexcept {
  const Axes& axes = c.pose.columns;
  const DDVec3& residual = c.pose.residual;
  const WideVec3 rest = toWide(axes.right) * toWide(residual.x) + toWide(axes.up) * toWide(residual.y) +
                        toWide(axes.forward) * toWide(residual.z);
  const WideVec3 p = toWide(c.pose.eye) - rest + offsetAt(c, at, distance);
  return {nearestDouble(p.x), nearestDouble(p.y), nearestDouble(p.z)};
}

template <class Number>
Vec3 exactDirection(const Camera& c, const WindowPoint<Number>& at) noexcept {
  if (c.projection.orthographic) return rounded(normalized(c.pose.columns.forward));
  if constexpr (std::is_same_v<Number, Wide>)
    return unitOf(offsetAt(c, at, Wide(1)));
  else
    return rounded(normalized(offsetAt(c, at, DoubleDouble(1))));
}

/// Whether double-double has the range for the point at a screen position and distance.
bool isOrdinary(const Camera& c, const Vec2& screen, double distance) noexcept {
  constexpr double kLargest = 0x1p400;
  const auto isWithin = [](double a) { return a == 0 || (std::fabs(a) < kLargest && std::fabs(a) > 1 / kLargest); };
  return c.constants.range < kLargestRangeExact && isWithin(distance) && std::fabs(screen.x) < kLargest &&
         std::fabs(screen.y) < kLargest && maxAbs(c.pose.eye) < 0x1p900;
}

Vec3 exactDirection(const Camera& c, const Vec2& screen) noexcept {
  return isOrdinary(c, screen, 1) ? exactDirection(c, toWindow<DoubleDouble>(c, screen))
                                  : exactDirection(c, toWindow<Wide>(c, screen));
}

Vec3 originAt(const Camera& c, const Vec2& screen, RayOrigin origin) noexcept {
  const double distance = origin == RayOrigin::nearPlane ? c.projection.near : 0;
  return isOrdinary(c, screen, distance) ? worldPointAt(c, toWindow<DoubleDouble>(c, screen), distance)
                                         : worldPointAt(c, toWindow<Wide>(c, screen), distance);
}

Vec3 standardDirection(const Camera& c, const Vec2& screen) noexcept {
  if (c.projection.orthographic) return exactDirection(c, Vec2{});
  const auto r = RayFormula<ScalarLanes>(c.constants)(screen.x, screen.y);
  if (!(r.squaredLength < kLargestSquaredLength)) return exactDirection(c, screen);
  return {r.x, r.y, r.z};
}

/// The length of the offset from the eye for a unit of view distance.
Wide slant(const Camera& c, const Vec2& screen) noexcept {
  if (c.projection.orthographic) return lengthOf(toWide(c.pose.columns.forward));
  return lengthOf(offsetAt(c, toWindow<Wide>(c, screen), Wide(1)));
}

/// The point at a distance that is off by at most distanceError.
WorldPoint pointAt(const Camera& c, const Vec2& screen, const Wide& distance, const Wide& distanceError) noexcept {
  const bool ordinary = isOrdinary(c, screen, double(distance));
  const Vec3 position = ordinary ? worldPointAt(c, toWindow<DoubleDouble>(c, screen), toDoubleDouble(distance))
                                 : worldPointAt(c, toWindow<Wide>(c, screen), distance);
  if (!viewproj::isFinite(position)) return {kNoVector, DepthStatus::infinity};
  const double rounding = halfUlp(position.x) + halfUlp(position.y) + halfUlp(position.z);
  const bool hasError = distanceError.sign() > 0 || !std::isfinite(distanceError.value.hi);
  return {position, DepthStatus::point,
          1.01 * (hasError ? double(distanceError * slant(c, screen)) + rounding : rounding)};
}

}  // namespace

Ray screenToRay(const Camera& c, const Vec2& screen, Precision precision, RayOrigin origin) noexcept {
  if (!isFinite(screen)) return {kNoVector, kNoVector};
  const bool originIsEye = origin == RayOrigin::eye && !c.projection.orthographic;
  return {originIsEye ? c.pose.eye : originAt(c, screen, origin),
          precision == Precision::standard ? standardDirection(c, screen) : exactDirection(c, screen)};
}

WorldPoint screenToWorld(const Camera& c, const Vec2& screen, double depth) noexcept {
  if (!isFinite(screen) || !std::isfinite(depth)) return {kNoVector, DepthStatus::notFinite};
  const Projection& p = c.projection;
  const Wide range = Wide(c.depthAtFar) - Wide(c.depthAtNear);
  // How far the depth is from near's and from far's, as shares of the range: they sum to 1.
  const Wide fromNear = (Wide(depth) - Wide(c.depthAtNear)) / range;
  const Wide fromFar = (Wide(c.depthAtFar) - Wide(depth)) / range;
  const Wide shareError = Wide(halfUlp(depth)) / magnitude(range);
  if (p.orthographic)
    return pointAt(c, screen, Wide(p.near) * fromFar + Wide(p.far) * fromNear,
                   (Wide(p.far) - Wide(p.near)) * shareError);
  if (depth == c.depthAtInfinity) return {kNoVector, DepthStatus::infinity};
  // fromNear = (1 - n/w) f/(f - n), so w = n / (fromFar + fromNear n/f).
  Wide divisor = fromFar;
  if (std::isfinite(p.far)) divisor = divisor + fromNear * (Wide(p.near) / Wide(p.far));
  if (!(divisor.sign() > 0)) return {kNoVector, DepthStatus::beyond};
  const Wide distance = Wide(p.near) / divisor;
  // Towards infinity the distance changes most: by shareError in the divisor, at most.
  const Wide farthest = divisor - shareError;
  return pointAt(
      c, screen, distance,
      farthest.sign() > 0 ? distance * (shareError / farthest) : Wide(std::numeric_limits<double>::infinity()));
}

PixelStages pixelStages(const Camera& c, const Vec2& screen) noexcept {
  const WindowPoint<Wide> at = toWindow<Wide>(c, screen);
  const WideVec3 toward = c.projection.orthographic ? toWide(c.pose.columns.forward) : offsetAt(c, at, Wide(1));
  return {{sumOrZero(screen.x, -c.screen.centerX).hi + 0.0, sumOrZero(screen.y, -c.screen.centerY).hi + 0.0},
          {nearestDouble(at.right), nearestDouble(at.up)},
          {nearestDouble(toward.x), nearestDouble(toward.y), nearestDouble(toward.z)},
          nearestDouble(lengthOf(toward)),
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
  return pointAt(c, screen, viewDistance, 0);
}

double distancePerDepth(const Camera& c, const Vec2& screen, double viewDistance) noexcept {
  const double scale = c.constants.depthScale.hi;
  const double perDepth = c.projection.orthographic ? 1 / scale : viewDistance * (viewDistance / scale);
  return std::fabs(perDepth) * double(slant(c, screen));
}

}  // namespace viewproj
