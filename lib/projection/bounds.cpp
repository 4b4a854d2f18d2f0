#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/ulp.hpp"
#include "projection/kernels/formulas.hpp"
#include "viewproj/floats.hpp"
#include "viewproj/screen.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a number next to the smallest double is off by, however it was computed.
constexpr double kSubnormal = 4 * std::numeric_limits<double>::denorm_min();
constexpr double kSubnormalFloat = 4 * double{std::numeric_limits<float>::denorm_min()};

double oneNorm(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// What the bound of a coordinate depends on.
struct Situation {
  double t;            ///< D / |W|, or D in orthographic
  double q;            ///< distance from the principal point, pixels
  double position;     ///< size of the screen coordinate
  double perDistance;  ///< 1 / |W|, or |W| in orthographic
  double depth;        ///< size of the window depth
};

/// toFloat: fast from float32 to float32, whose last sums and parameters are in float too.
ErrorBound boundIn(const CameraParts& c, Precision precision, const Situation& s, bool toFloat = false) {
  const ProjectionConstants& k = c.constants;
  const double u = precision == Precision::fast ? kUnitFloat : kUnitDouble;
  const double roundings = toFloat ? kRoundingsFloat : kRoundings;
  const double c1 = roundings * u * k.sizeXY * kSecondOrder;
  const double c2 = roundings * u * k.sizeW * kSecondOrder;
  const double sum = (toFloat ? kUnitFloat : kUnitDouble) * kSecondOrder;
  const auto lost = [&](const DoubleDouble& a) {
    return std::fabs(a.lo) + (toFloat ? std::fabs(a.hi - double{static_cast<float>(a.hi)}) : 0);
  };
  const double center = std::max(lost(k.centerX), lost(k.centerY)) + kExactParameter * std::max(k.reachX, k.reachY);
  const double largestRow = precision == Precision::fast ? kLargestRowFast : kLargestRow;
  if (!isInRange(k, largestRow, toFloat ? kLargestRangeFloat : kLargestRange)) return {kInfinity, kInfinity};
  const double smallest = toFloat ? kSubnormalFloat : kSubnormal;
  const double scale = std::fabs(k.depthScale.hi) + smallest;
  const double last = sum * s.depth + lost(k.depthOffset) + smallest * (1 + s.perDistance);
  if (k.orthographic)
    return {c1 * s.t + sum * s.position + center, scale * (c2 * s.t + 2 * sum * s.perDistance) + last};
  if (!(c2 * s.t < kLargestRelativeError)) return {kInfinity, kInfinity};
  return {s.t * (c1 + c2 * s.q) + u * kSecondOrder * 2 * s.q + sum * s.position + center,
          scale * s.perDistance * (c2 * s.t + u * kSecondOrder + 2 * sum) + last};
}

/// Of a point that was projected exactly.
ErrorBound boundOfExact(const CameraParts& c, const ScreenPoint& p) {
  if (p.status != PointStatus::inFront) return {kInfinity, kInfinity};
  const double size = std::max(std::fabs(p.x), std::fabs(p.y));
  const double undecided = p.certain ? 0 : kExactAbsolute * std::max(c.constants.reachX, c.constants.reachY);
  // Depth is offset + scale / W, or offset + scale W.
  const double fromDistance = kExactDistance * (std::fabs(p.depth) + std::fabs(c.constants.depthOffset.hi));
  return {std::max(halfUlp(size) * 2 * kExactUlps, undecided),
          std::max(halfUlp(p.depth) * 2 * kExactUlps, p.certain ? 0 : std::max(kExactAbsolute, fromDistance))};
}

/// Of results in float32, which are infinite beyond its range. isRounded: from doubles, to half a unit of it.
ErrorBound inFloat(const ErrorBound& bound, double position, double depth, bool isRounded) {
  const auto of = [&](double error, double size) {
    const double most = (size + error) * kSecondOrder;
    if (!(most < double{std::numeric_limits<float>::max()})) return kInfinity;
    return isRounded ? error + (most * kUnitFloat + kSubnormalFloat) : error;
  };
  return {of(bound.screen, position), of(bound.depth, depth)};
}

ErrorBound inPicture(const Camera& camera, Precision precision, double band, bool toFloat) {
  const CameraParts& c = parts(camera);
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
  const auto ofExact = [&]() -> ErrorBound {
    return {std::max(halfUlp(s.position) * 1.02, kExactAbsolute * std::max(k.reachX, k.reachY)),
            std::max(halfUlp(s.depth) * 1.02, kExactDistance * (s.depth + std::fabs(k.depthOffset.hi)))};
  };
  const bool isFast = precision == Precision::fast;
  const ErrorBound bound = precision == Precision::exact ? ofExact() : boundIn(c, precision, s, toFloat && isFast);
  return toFloat ? inFloat(bound, s.position, s.depth, !isFast) : bound;
}

ErrorBound ofPoint(const Camera& camera, const Vec3& point, Precision precision, bool toFloat) {
  const CameraParts& c = parts(camera);
  const ScreenPoint p = worldToScreen(camera, point, Precision::exact);
  const double position = std::max(std::fabs(p.x), std::fabs(p.y)), depth = std::fabs(p.depth);
  const auto stored = [&](const ErrorBound& bound, bool isRounded = true) {
    return toFloat ? inFloat(bound, position, depth, isRounded) : bound;
  };
  if (p.status != PointStatus::inFront) return boundOfExact(c, p);
  if (precision == Precision::exact) return stored(boundOfExact(c, p));
  const ProjectionConstants& k = c.constants;
  const Vec3 d{point.x - k.eye.x, point.y - k.eye.y, point.z - k.eye.z};
  const double reach = (oneNorm(d) + k.residualReach) * kSecondOrder;
  const double w = std::fabs(p.viewDistance);
  Situation s;
  s.t = k.orthographic ? reach : reach / w;
  s.q = std::max(std::fabs(p.x - k.centerX.hi), std::fabs(p.y - k.centerY.hi)) * kSecondOrder;
  s.position = position;
  s.perDistance = k.orthographic ? w : 1 / w;
  s.depth = depth;
  const bool ownFloats = toFloat && precision == Precision::fast;
  const ErrorBound bound = boundIn(c, precision, s, ownFloats);
  // What the precision cannot bound goes the exact way, and so does a distance too small to have an inverse.
  if (std::isinf(bound.screen) || std::isinf(s.perDistance)) return stored(boundOfExact(c, p));
  return stored(bound, !ownFloats);
}

}  // namespace

ErrorBound boundInPicture(const Camera& camera, Precision precision, double band) noexcept {
  return inPicture(camera, precision, band, false);
}

ErrorBound floatBoundInPicture(const Camera& camera, Precision precision, double band) noexcept {
  return inPicture(camera, precision, band, true);
}

ErrorBound boundOfPoint(const Camera& camera, const Vec3& point, Precision precision) noexcept {
  return ofPoint(camera, point, precision, false);
}

ErrorBound floatBoundOfPoint(const Camera& camera, const Vec3& point, Precision precision) noexcept {
  return ofPoint(camera, point, precision, true);
}

ErrorBound boundOfPoint(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  if (point.w == 1) return boundOfPoint(camera, Vec3{point.x, point.y, point.z}, precision);
  return boundOfExact(parts(camera), worldToScreen(camera, point, Precision::exact));
}

Precision precisionWithin(const Camera& camera, double tolerance) noexcept {
  for (Precision precision : {Precision::fast, Precision::standard})
    if (boundInPicture(camera, precision, kGuardBand).screen <= tolerance) return precision;
  return Precision::exact;
}

}  // namespace viewproj
