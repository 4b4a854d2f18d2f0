#include "projection/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/ulp.hpp"
#include "projection/kernels/formulas.hpp"
#include "projection/screen.hpp"

namespace viewproj {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a number next to the smallest double is off by, however it was computed.
constexpr double kSubnormal = 4 * std::numeric_limits<double>::denorm_min();

double oneNorm(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// What the bound of a coordinate depends on.
struct Situation {
  double t;            ///< D / |W|, or D in orthographic
  double q;            ///< distance from the principal point, pixels
  double position;     ///< size of the screen coordinate
  double perDistance;  ///< 1 / |W|, or |W| in orthographic
  double depth;        ///< size of the window depth
};

ErrorBound boundIn(const Camera& c, Precision precision, const Situation& s) {
  const ProjectionConstants& k = c.constants;
  const double u = precision == Precision::fast ? kUnitFloat : kUnitDouble;
  const double c1 = kRoundings * u * k.sizeXY * kSecondOrder;
  const double c2 = kRoundings * u * k.sizeW * kSecondOrder;
  const double sum = kUnitDouble * kSecondOrder;  // the last sum is in double in fast too
  const double center =
      std::max(std::fabs(k.centerX.lo), std::fabs(k.centerY.lo)) + kExactParameter * std::max(k.reachX, k.reachY);
  const double largestRow = precision == Precision::fast ? kLargestRowFast : kLargestRow;
  if (!isInRange(k, largestRow, kLargestRange)) return {kInfinity, kInfinity};
  const double scale = std::fabs(k.depthScale.hi) + kSubnormal;
  const double last = sum * s.depth + std::fabs(k.depthOffset.lo) + kSubnormal * (1 + s.perDistance);
  if (k.orthographic)
    return {c1 * s.t + sum * s.position + center, scale * (c2 * s.t + 2 * sum * s.perDistance) + last};
  if (!(c2 * s.t < kLargestRelativeError)) return {kInfinity, kInfinity};
  return {s.t * (c1 + c2 * s.q) + u * kSecondOrder * 2 * s.q + sum * s.position + center,
          scale * s.perDistance * (c2 * s.t + u * kSecondOrder + 2 * sum) + last};
}

/// Of a point that was projected exactly.
ErrorBound boundOfExact(const Camera& c, const ScreenPoint& p) {
  if (p.status != PointStatus::inFront) return {kInfinity, kInfinity};
  const double size = std::max(std::fabs(p.x), std::fabs(p.y));
  const double undecided = p.certain ? 0 : kExactAbsolute * std::max(c.constants.reachX, c.constants.reachY);
  // Depth is offset + scale / W, or offset + scale W.
  const double fromDistance = kExactDistance * (std::fabs(p.depth) + std::fabs(c.constants.depthOffset.hi));
  return {std::max(halfUlp(size) * 2 * kExactUlps, undecided),
          std::max(halfUlp(p.depth) * 2 * kExactUlps, p.certain ? 0 : std::max(kExactAbsolute, fromDistance))};
}

}  // namespace

ErrorBound boundInPicture(const Camera& c, Precision precision, double band) noexcept {
  const ProjectionConstants& k = c.constants;
  const PictureReach reach = pictureReach(c, band);
  Situation s;
  s.q = std::max(reach.x, reach.y);
  s.position = std::max(std::fabs(k.centerX.hi) + reach.x, std::fabs(k.centerY.hi) + reach.y);
  s.depth = std::max(std::fabs(c.viewport.depthFirst), std::fabs(c.viewport.depthSecond));
  const double across = oneNorm(k.rayX) * reach.x + oneNorm(k.rayY) * reach.y;
  if (k.orthographic) {
    s.perDistance = std::max(std::fabs(c.projection.near), std::fabs(c.projection.far));
    s.t = (across + oneNorm(k.rayW) * s.perDistance + k.residualReach) * kSecondOrder;
  } else {
    s.perDistance = 1 / c.projection.near;
    s.t = (oneNorm(k.rayW) + across + k.residualReach * s.perDistance) * kSecondOrder;
  }
  if (precision == Precision::exact)
    return {std::max(halfUlp(s.position) * 1.02, kExactAbsolute * std::max(k.reachX, k.reachY)),
            std::max(halfUlp(s.depth) * 1.02, kExactDistance * (s.depth + std::fabs(k.depthOffset.hi)))};
  return boundIn(c, precision, s);
}

ErrorBound boundOfPoint(const Camera& c, const Vec3& point, Precision precision) noexcept {
  const ScreenPoint p = worldToScreen(c, point, Precision::exact);
  if (p.status != PointStatus::inFront || precision == Precision::exact) return boundOfExact(c, p);
  const ProjectionConstants& k = c.constants;
  const Vec3 d{point.x - k.eye.x, point.y - k.eye.y, point.z - k.eye.z};
  const double reach = (oneNorm(d) + k.residualReach) * kSecondOrder;
  const double w = std::fabs(p.viewDistance);
  Situation s;
  s.t = k.orthographic ? reach : reach / w;
  s.q = std::max(std::fabs(p.x - k.centerX.hi), std::fabs(p.y - k.centerY.hi)) * kSecondOrder;
  s.position = std::max(std::fabs(p.x), std::fabs(p.y));
  s.perDistance = k.orthographic ? w : 1 / w;
  s.depth = std::fabs(p.depth);
  const ErrorBound bound = boundIn(c, precision, s);
  // What the precision cannot bound goes the exact way, and so does a distance too small to have an inverse.
  return std::isinf(bound.screen) || std::isinf(s.perDistance) ? boundOfExact(c, p) : bound;
}

ErrorBound boundOfPoint(const Camera& c, const Vec4& point, Precision precision) noexcept {
  if (point.w == 1) return boundOfPoint(c, Vec3{point.x, point.y, point.z}, precision);
  return boundOfExact(c, worldToScreen(c, point, Precision::exact));
}

Precision precisionWithin(const Camera& camera, double tolerance) noexcept {
  for (Precision precision : {Precision::fast, Precision::standard})
    if (boundInPicture(camera, precision, kGuardBand).screen <= tolerance) return precision;
  return Precision::exact;
}

}  // namespace viewproj
