#include <algorithm>
#include <cmath>

#include "numbers/double_double.hpp"
#include "projection/kernels/formulas.hpp"
#include "projection/through_lens.hpp"
#include "viewproj/screen.hpp"

namespace viewproj {

using namespace detail;
namespace {

double sumOfSizes(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// What a coordinate's error bound depends on.
struct Situation {
  double t;            ///< D / |W|, or D in orthographic
  double q;            ///< distance from the principal point, pixels
  double position;     ///< size of the screen coordinate
  double perDistance;  ///< 1 / |W|, or |W| in orthographic
  double depth;        ///< size of the window depth
};

ErrorBound boundOfStandard(const CameraParts& c, const Situation& s) {
  const ProjectionConstants& k = c.constants;
  const double c1 = kRoundings * kUnitDouble * k.sizeXY * kSecondOrder;
  const double c2 = kRoundings * kUnitDouble * k.sizeW * kSecondOrder;
  constexpr double kUnit = kUnitDouble * kSecondOrder;
  const double center =
      std::max(std::fabs(k.centerX.lo), std::fabs(k.centerY.lo)) + kExactParameter * std::max(k.reachX, k.reachY);
  const double scale = std::fabs(k.depthScale.hi);
  const double depth = std::isnan(s.depth) ? kInfinity : s.depth;  // no bound for a depth that does not exist
  const double last = kUnit * depth + std::fabs(k.depthOffset.lo);
  if (k.orthographic)
    return {c1 * s.t + kUnit * s.position + center, scale * (c2 * s.t + 2 * kUnit * s.perDistance) + last};
  if (!(c2 * s.t < kLargestRelativeError)) return {kInfinity, kInfinity};
  return {s.t * (c1 + c2 * s.q) + 2 * kUnit * s.q + kUnit * s.position + center,
          scale * s.perDistance * (c2 * s.t + kUnit + 2 * kUnit) + last};
}

/// What the errors of the pose and of the point add, for p of the camera without its lens. A point that moves by m at a
/// distance w has its x/w moved by m (1 + |x/w|) / (w - m) at most, and is no farther from the eye than (1 + |x/w|) w.
ErrorBound boundOfInput(const CameraParts& c, const ScreenPoint& p, double pointError) {
  const auto [eye, angle] = c.pose.error;
  if (!(eye + angle + pointError > 0)) return {};
  const ScreenMap& map = c.screen;
  const double scaleX = std::fabs(map.scaleX.hi), scaleY = std::fabs(map.scaleY.hi), scale = std::max(scaleX, scaleY);
  const double across = std::fabs(p.x - map.centerX.hi) / scaleX + std::fabs(p.y - map.centerY.hi) / scaleY;
  const double depth = std::fabs(c.constants.depthScale.hi), away = eye + pointError, w = std::fabs(p.viewDistance);
  if (c.projection.orthographic) {
    const double move = kSecondOrder * (away + angle * (across + w));
    return {scale * move, depth * move};
  }
  const double share = (std::isnan(w) ? 0 : away / w) + angle * (1 + across);
  const double move = share < 1 ? kSecondOrder * share / (1 - share) : kInfinity;
  return {scale * (1 + across) * move, std::isnan(w) ? 0 : depth / w * move};
}

/// The bound of a point that was projected exactly.
ErrorBound boundOfExact(const CameraParts& c, const ScreenPoint& p) {
  if (p.status != PointStatus::inFront) return {kInfinity, kInfinity};
  const double size = std::max(std::fabs(p.x), std::fabs(p.y));
  const double undecided = p.certain ? 0 : kExactAbsolute * std::max(c.constants.reachX, c.constants.reachY);
  // Depth is offset + scale / W, or offset + scale W.
  const double fromDistance = kExactDistance * (std::fabs(p.depth) + std::fabs(c.constants.depthOffset.hi));
  return {std::max(halfUlp(size) * 2 * kExactUlps, undecided),
          std::max(halfUlp(p.depth) * 2 * kExactUlps, p.certain ? 0 : std::max(kExactAbsolute, fromDistance))};
}

/// The bound of a point of a camera without a lens, whose numbers count as exact.
ErrorBound boundOfArithmetic(const CameraParts& c, const ScreenPoint& p, const Vec4& point,
                             Precision precision) noexcept {
  if (p.status != PointStatus::inFront || precision == Precision::exact) return boundOfExact(c, p);
  const ProjectionConstants& k = c.constants;
  const Vec3 d{point.x - k.eye.x, point.y - k.eye.y, point.z - k.eye.z};
  const double reach = (sumOfSizes(d) + k.residualReach) * kSecondOrder;
  const double w = std::fabs(p.viewDistance);
  Situation s;
  s.t = k.orthographic ? reach : reach / w;
  s.q = std::max(std::fabs(p.x - k.centerX.hi), std::fabs(p.y - k.centerY.hi)) * kSecondOrder;
  s.position = std::max(std::fabs(p.x), std::fabs(p.y));
  s.perDistance = k.orthographic ? w : 1 / w;
  s.depth = std::fabs(p.depth);
  const ErrorBound bound = boundOfStandard(c, s);
  // Points that standard cannot bound are projected exactly. So are points too near for an inverse of the distance.
  return std::isinf(bound.screen) || std::isinf(s.perDistance) ? boundOfExact(c, p) : bound;
}

}  // namespace

Vec2 detail::pictureReach(const CameraParts& c) noexcept {
  const Viewport& v = c.viewport;
  const double half = v.pixelCenter - 0.5;
  const auto reach = [&](double start, double size, double center) {
    const double middle = start + half + size / 2;
    // The middle and the centre may cancel.
    const double rounding = 0x1p-50 * (std::fabs(start) + std::fabs(half) + size + std::fabs(center));
    return (std::fabs(middle - center) + size / 2 + rounding) * kSecondOrder;
  };
  return {reach(v.x, v.width, c.constants.centerX.hi), reach(v.y, v.height, c.constants.centerY.hi)};
}

ErrorBound boundInPicture(const Camera& camera, Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  return c.lens ? boundInPictureThroughLens(c) : boundWithin(c, pictureReach(c), precision);
}

ErrorBound detail::boundWithin(const CameraParts& c, const Vec2& reach, Precision precision) noexcept {
  const ProjectionConstants& k = c.constants;
  Situation s;
  s.q = std::max(reach.x, reach.y);
  s.position = std::max(std::fabs(k.centerX.hi) + reach.x, std::fabs(k.centerY.hi) + reach.y);
  s.depth = std::max(std::fabs(c.depthAtNear), std::fabs(c.depthAtFar));
  const double across = sumOfSizes(k.rayX) * reach.x + sumOfSizes(k.rayY) * reach.y;
  if (k.orthographic) {
    s.perDistance = std::max(std::fabs(c.projection.near), std::fabs(c.projection.far));
    s.t = (across + sumOfSizes(k.rayW) * s.perDistance + k.residualReach) * kSecondOrder;
  } else {
    s.perDistance = 1 / c.projection.near;
    const double ofResidual = k.residualReach > 0 ? k.residualReach * s.perDistance : 0;
    s.t = (sumOfSizes(k.rayW) + across + ofResidual) * kSecondOrder;
  }
  if (precision == Precision::standard) return boundOfStandard(c, s);
  return {std::max(halfUlp(s.position) * 1.02, kExactAbsolute * std::max(k.reachX, k.reachY)),
          std::max(halfUlp(s.depth) * 1.02, kExactDistance * (s.depth + std::fabs(k.depthOffset.hi)))};
}

ErrorBound boundOfPoint(const Camera& camera, const Vec3& point, Precision precision, double pointError) noexcept {
  return boundOfPoint(camera, Vec4{point.x, point.y, point.z, 1}, precision, pointError);
}

ErrorBound boundOfPoint(const Camera& camera, const Vec4& point, Precision precision, double pointError) noexcept {
  const CameraParts& c = parts(camera);
  const CameraParts& pinhole = c.lens ? *c.pinhole : c;
  const ScreenPoint p = worldToScreen(withoutLens(camera), point, Precision::exact);
  const ErrorBound input = boundOfInput(pinhole, p, pointError);
  const ErrorBound bound = boundOfArithmetic(pinhole, p, point, c.lens || point.w != 1 ? Precision::exact : precision);
  return {c.lens ? boundThroughLens(camera, point, pointError) : bound.screen + input.screen,
          bound.depth + input.depth};
}

}  // namespace viewproj
