#include "projection/screen.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "camera/lens.hpp"
#include "projection/eye_point.hpp"
#include "projection/kernels/formulas.hpp"
#include "projection/picture_reach.hpp"
#include "projection/sides.hpp"

namespace viewproj {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// value * 2^exponent, and how far value may be from the true one.
struct Bounded {
  DoubleDouble value;
  double error = 0;
  int exponent = 0;

  /// Whether every number within the error rounds to the same double (Ziv's test), and the exponent does not round
  /// again.
  bool certain() const noexcept {
    const bool settled = value.hi + (value.lo + error) == value.hi && value.hi + (value.lo - error) == value.hi;
    return settled && (exponent == 0 || value.hi == 0 || std::isnormal(std::ldexp(value.hi, exponent)));
  }
};

/// Relative error of an operation in double-double, and of a camera's derived numbers (edges, scales, shares).
constexpr double kOperation = 0x1p-101;
constexpr double kParameter = 0x1p-98;
constexpr double kUnderflow = kExactUnderflow;
/// Beyond this the splitting of a product would overflow.
constexpr double kLargestFactor = 0x1p900;

/// Adding 0 turns -0 into 0.
double rounded(const Bounded& b) noexcept { return std::ldexp(b.value.hi, b.exponent) + 0.0; }

/// The same number with exponent 0.
Bounded plain(const Bounded& b) noexcept {
  return {scaleByPowerOfTwo(b.value, b.exponent), std::ldexp(b.error, b.exponent) + kUnderflow, 0};
}

/// X / W with both off by at most `error`: |X/W - x/w| <= error (1 + |x/w|) / (|w| - error).
Bounded windowCoordinate(DoubleDouble x, DoubleDouble w, double error) noexcept {
  const bool large = !(std::fabs(x.hi / w.hi) < kLargestFactor);
  const double scale = large ? 0x1p-600 : 1;
  const DoubleDouble q = timesPowerOfTwo(x, scale) / w;
  const double size = std::fabs(q.hi);
  return {q, error * (scale + size) / (std::fabs(w.hi) - error) + kOperation * size, large ? 600 : 0};
}

/// center + scale * h. reach: that of the center (ScreenMap).
Bounded screenCoordinate(DoubleDouble center, double reach, DoubleDouble scale, Bounded h) noexcept {
  if (!(std::fabs(scale.hi * h.value.hi) < kLargestFactor)) {
    h.value = timesPowerOfTwo(h.value, 0x1p-600);
    h.error *= 0x1p-600;
    h.exponent += 600;
  }
  const DoubleDouble step = scale * h.value;
  const DoubleDouble value = sumOrZero(scaleByPowerOfTwo(center, -h.exponent), step);
  const double size = std::ldexp(std::max(std::fabs(center.hi), 2 * reach), -h.exponent) + std::fabs(step.hi);
  return {value, std::fabs(scale.hi) * h.error + kParameter * size + kUnderflow, h.exponent};
}

/// Window depth at distance w > 0, from the nearer end of the depth range: near's and far's shares of it are
///   perspective   n (f - w) / ((f - n) w)   and   f (w - n) / ((f - n) w)
///   orthographic  (f - w) / (f - n)         and   (w - n) / (f - n)
Bounded windowDepth(const Camera& c, const Bounded& distance) noexcept {
  double n = c.projection.near, f = c.projection.far;
  DoubleDouble shareOfNear, shareOfFar;
  double distanceError;  // in shares
  double underflow = 1;  // in shares, times kUnderflow
  int exponent = 0;      // of the shares
  // A difference that cancels to less than the distance's error is 0, unless it has none.
  const auto difference = [&](DoubleDouble a, DoubleDouble b) {
    return distance.error == 0 ? a + -b : sumOrZero(a, -b);
  };
  if (c.projection.orthographic) {
    const Bounded w = distance.value.hi == 0 && distance.error == 0 ? distance : plain(distance);
    shareOfNear = difference(f, w.value) * c.farOverRange;
    shareOfFar = difference(w.value, n) * c.farOverRange;
    distanceError = c.farOverRange.hi * (w.error + (distance.error == 0 ? 0 : kParameter * std::fabs(w.value.hi)));
  } else {
    // Only ratios count: brought away from the ends of the range first, and the shares too if they are near them.
    const int size = std::ilogb(distance.value.hi) + distance.exponent;
    const int shift = size < -400 ? 300 : size > 400 ? -300 : 0;
    const DoubleDouble w = scaleByPowerOfTwo(distance.value, distance.exponent + shift);
    n = std::ldexp(n, shift);
    f = std::ldexp(f, shift);
    const DoubleDouble fromFar = f > w.hi * 0x1p120 ? DoubleDouble(1) : difference(f, w) / DoubleDouble(f);
    const DoubleDouble toNear = difference(w, n);
    if (!(n / w.hi < kLargestFactor)) exponent = 600;
    const double scale = exponent ? 0x1p-600 : 1;
    const DoubleDouble nearOverW = DoubleDouble(n * scale) / w;
    shareOfNear = nearOverW * fromFar * c.farOverRange;
    shareOfFar = timesPowerOfTwo(toNear, scale) / w * c.farOverRange;
    distanceError = nearOverW.hi * c.farOverRange.hi *
                    (distance.error == 0 ? 0 : distance.error / std::fabs(distance.value.hi) + kParameter);
    underflow = (1 + 1 / w.hi) * (1 + c.farOverRange.hi);
  }
  const auto part = [](double of, DoubleDouble share) { return of == 0 ? DoubleDouble(0) : DoubleDouble(of) * share; };
  const DoubleDouble first = part(c.depthAtNear, shareOfNear);
  const DoubleDouble second = part(c.depthAtFar, shareOfFar);
  const double sizes = std::fabs(first.hi) + std::fabs(second.hi);
  if (sizes == 0 && distance.error == 0 && distance.value.hi == 0) return {};
  const double lost = kUnderflow * (1 + underflow * (std::fabs(c.depthAtNear) + std::fabs(c.depthAtFar)));
  return {first + second, std::fabs(c.depthAtFar - c.depthAtNear) * distanceError + kParameter * sizes + lost,
          exponent};
}

/// Orthographic: a direction runs out of the picture through these sides.
std::uint8_t sidesTowards(const EyePoint& e) noexcept {
  unsigned sides = 0;
  if (e.right.hi < 0) sides |= sideLeft;
  if (e.right.hi > 0) sides |= sideRight;
  if (e.up.hi < 0) sides |= sideBottom;
  if (e.up.hi > 0) sides |= sideTop;
  if (e.forward.hi < 0) sides |= sideNear;
  if (e.forward.hi > 0) sides |= sideFar;
  return static_cast<std::uint8_t>(sides);
}

/// A result, and whether it is certain to be the double nearest the true value in each of its numbers.
struct Attempt {
  ScreenPoint point;
  bool certain;
};

/// A direction (w = 0), from its coordinates along the camera's axes.
Attempt directionToScreen(const Camera& c, const EyePoint& e) noexcept {
  if (c.projection.orthographic) {
    ScreenPoint p = without(PointStatus::atInfinity, kNaN);
    p.outside = sidesTowards(e);
    return {p, std::fabs(e.right.hi) > e.error && std::fabs(e.up.hi) > e.error && std::fabs(e.forward.hi) > e.error};
  }
  const bool signCertain = std::fabs(e.forward.hi) > e.error;
  if (!(e.forward.hi > 0)) return {without(PointStatus::behind, kNaN), signCertain};
  ScreenPoint p;
  const Bounded x = screenCoordinate(c.screen.centerX, c.screen.reachX, c.screen.scaleX,
                                     windowCoordinate(e.right, e.forward, e.error));
  const Bounded y =
      screenCoordinate(c.screen.centerY, c.screen.reachY, c.screen.scaleY, windowCoordinate(e.up, e.forward, e.error));
  p.x = rounded(x);
  p.y = rounded(y);
  p.depth = c.depthAtInfinity;
  p.viewDistance = kNaN;
  p.outside = sidesBeyond(c, p);
  if (std::isfinite(c.projection.far)) p.outside |= sideFar;
  return {p, signCertain && x.certain() && y.certain()};
}

Attempt pointToScreen(const Camera& c, const EyePoint& e, double w) noexcept {
  const auto inWorld = [&](DoubleDouble a) {
    const DoubleDouble divided = w == 1 ? a : a / DoubleDouble(w);
    return Bounded{divided, e.error + kOperation * std::fabs(divided.hi), e.exponent};
  };
  const Bounded distance = e.forwardIsExact ? Bounded{e.forward, 0, e.exponent} : inWorld(e.forward);
  ScreenPoint p;
  p.viewDistance = rounded(distance);
  Bounded x, y;
  if (c.projection.orthographic) {
    x = screenCoordinate(c.screen.centerX, c.screen.reachX, c.screen.scaleX, plain(inWorld(e.right)));
    y = screenCoordinate(c.screen.centerY, c.screen.reachY, c.screen.scaleY, plain(inWorld(e.up)));
  } else {
    const bool signCertain = std::fabs(e.forward.hi) > e.error;
    const bool inFront = w > 0 ? e.forward.hi > 0 : e.forward.hi < 0;
    if (!inFront) return {without(PointStatus::behind, p.viewDistance), signCertain && distance.certain()};
    x = screenCoordinate(c.screen.centerX, c.screen.reachX, c.screen.scaleX,
                         windowCoordinate(e.right, e.forward, e.error));
    y = screenCoordinate(c.screen.centerY, c.screen.reachY, c.screen.scaleY,
                         windowCoordinate(e.up, e.forward, e.error));
  }
  const Bounded depth = windowDepth(c, distance);
  p.x = rounded(x);
  p.y = rounded(y);
  p.depth = rounded(depth);
  p.outside = sidesBeyond(c, p);
  return {p, distance.certain() && x.certain() && y.certain() && depth.certain()};
}

Attempt attempt(const Camera& c, const EyePoint& e, double w) noexcept {
  return w == 0 ? directionToScreen(c, e) : pointToScreen(c, e, w);
}

// The same once more in numbers with exponents of their own, for cameras and points whose products leave the range of
// doubles.

struct WideBounded {
  Wide value, error;
};

/// What an operation or a camera's number adds, relative.
constexpr double kWideShare = 0x1p-97;

NearestDouble nearest(const WideBounded& b) noexcept {
  if (b.value.sign() == 0) return {double(b.value), b.error.sign() == 0 && std::isfinite(b.value.value.hi)};
  const Wide share = b.error / magnitude(b.value);
  if (!isLess(share, 1)) return {nearestDouble(b.value), false};
  return nearestDouble(b.value, double(share));
}

/// X / W with both off by at most `error`, as windowCoordinate.
WideBounded widelyToWindow(const Wide& x, const Wide& w, const Wide& error) noexcept {
  const Wide q = x / w;
  const Wide size = magnitude(q);
  return {q, error * (Wide(1) + size) / (magnitude(w) - error) + kWideShare * size};
}

WideBounded widelyToScreen(DoubleDouble center, double reach, DoubleDouble scale, const WideBounded& h) noexcept {
  const Wide step = toWide(scale) * h.value;
  return {sumOrZero(toWide(center), step),
          magnitude(toWide(scale)) * h.error + kWideShare * (Wide(reach) + magnitude(step))};
}

/// As windowDepth.
WideBounded widelyToDepth(const Camera& c, const WideBounded& w) noexcept {
  const Projection& p = c.projection;
  const Wide n = p.near, f = p.far;
  const DepthShares shares = depthShares(p.orthographic, p.near, p.far, w.value, 1);
  Wide first = Wide(c.depthAtNear) * shares.ofNear, second = Wide(c.depthAtFar) * shares.ofFar;
  Wide distanceError;
  if (p.orthographic) {
    distanceError = (w.error + kWideShare * magnitude(w.value)) / (f - n);
  } else {
    first = first / w.value;
    second = second / w.value;
    const Wide farOverRange = std::isinf(p.far) ? 1 : f / (f - n);
    distanceError = n / w.value * farOverRange * (w.error / w.value + kWideShare);
  }
  return {first + second, magnitude(Wide(c.depthAtFar) - Wide(c.depthAtNear)) * distanceError +
                              kWideShare * (magnitude(first) + magnitude(second))};
}

Attempt widelyToScreen(const Camera& c, const Vec4& point) noexcept {
  const WideEyePoint e = toEyeWidely(c.pose, point);
  const ScreenMap& map = c.screen;
  const bool signCertain = e.error.sign() == 0 || e.forward.sign() != 0;
  const auto sideOf = [](const Wide& a) { return DoubleDouble(a.sign()); };
  if (point.w == 0 && c.projection.orthographic) {
    ScreenPoint p = without(PointStatus::atInfinity, kNaN);
    p.outside = sidesTowards({sideOf(e.right), sideOf(e.up), sideOf(e.forward)});
    return {p, e.error.sign() == 0};
  }
  const auto inWorld = [&](const Wide& a) {
    const Wide weight = point.w == 0 ? 1 : point.w;
    const Wide divided = a / weight;
    return WideBounded{divided, e.error / magnitude(weight) + kWideShare * magnitude(divided)};
  };
  const WideBounded distance = inWorld(e.forward);
  const NearestDouble viewDistance = point.w == 0 ? NearestDouble{kNaN, true} : nearest(distance);
  WideBounded x, y;
  if (c.projection.orthographic) {
    x = inWorld(e.right);
    y = inWorld(e.up);
  } else {
    if (!(distance.value.sign() > 0))
      return {without(PointStatus::behind, viewDistance.value), signCertain && viewDistance.certain};
    x = widelyToWindow(e.right, e.forward, e.error);
    y = widelyToWindow(e.up, e.forward, e.error);
  }
  const NearestDouble screenX = nearest(widelyToScreen(map.centerX, map.reachX, map.scaleX, x));
  const NearestDouble screenY = nearest(widelyToScreen(map.centerY, map.reachY, map.scaleY, y));
  const NearestDouble depth =
      point.w == 0 ? NearestDouble{c.depthAtInfinity, true} : nearest(widelyToDepth(c, distance));
  ScreenPoint p;
  p.x = screenX.value;
  p.y = screenY.value;
  p.depth = depth.value;
  p.viewDistance = viewDistance.value;
  p.outside = sidesBeyond(c, p);
  if (point.w == 0 && std::isfinite(c.projection.far)) p.outside |= sideFar;
  return {p, viewDistance.certain && screenX.certain && screenY.certain && depth.certain};
}

/// Of a camera that looks along an axis of the world: whether the point's coordinate there is the eye's.
bool isBesideEye(const Camera& c, const Vec4& point) noexcept {
  const DDVec3& forward = c.pose.rows.forward;
  return forward.x.hi != 0   ? point.x == c.pose.eye.x
         : forward.y.hi != 0 ? point.y == c.pose.eye.y
                             : point.z == c.pose.eye.z;
}

/// Double-double first; the exact rows where it cannot certify a number, and where products could leave the range of
/// doubles, numbers with an exponent of their own. What they cannot certify either is a tie, or a number that cancels
/// to about 0.
ScreenPoint exactToScreen(const Camera& c, const Vec4& point) noexcept {
  EyePoint e = toEye(c.pose, point);
  Attempt result;
  // A point on the rounded eye has the residual alone, whose own digits may be below the smallest double.
  const bool isOnEye = !(e.error > 0x1p-99);
  if (!(c.constants.range < kLargestRangeExact && std::abs(e.exponent) <= kLargestExponent) || isOnEye) {
    result = widelyToScreen(c, point);
  } else {
    // Unless bringing the point to unit size pushed its last bits below the smallest double.
    const bool isHuge = std::max(maxAbs(Vec3{point.x, point.y, point.z}), maxAbs(c.pose.eye)) > 0x1p900;
    e.forwardIsExact = c.constants.forwardIsAxis && point.w == 1 &&
                       ((std::fabs(e.forward.hi) > 0x1p-900 && !isHuge) || isBesideEye(c, point));
    result = attempt(c, e, point.w);
    if (!result.certain && !isInExactRange(c.pose, point)) {
      result = widelyToScreen(c, point);
    } else if (!result.certain) {
      EyePoint exact = toEyeExactly(c.pose, point);
      if (e.forwardIsExact) {
        exact.forward = scaleByPowerOfTwo(e.forward, e.exponent - exact.exponent);
        exact.forwardIsExact = true;
      }
      result = attempt(c, exact, point.w);
      // A number beyond the largest double on the way to one that is not.
      const ScreenPoint& p = result.point;
      if (p.status == PointStatus::inFront && !isFinite(Vec3{p.x, p.y, p.depth})) result = widelyToScreen(c, point);
    }
  }
  result.point.certain = result.certain;
  return result.point;
}

/// A point in fast or standard. The parts of a formula that a camera does not need add zeros and compare with infinity
/// here: the same bits.
template <template <class, class> class Formula>
Projected<double, bool> byFormula(const ProjectionConstants& k, const Vec3& p, Band band) noexcept {
  return k.orthographic ? Formula<ScalarLanes, Traits<true, true, true>>(k, band).point(p.x, p.y, p.z)
                        : Formula<ScalarLanes, Traits<false, true, true>>(k, band).point(p.x, p.y, p.z);
}

/// Exact for what the precision cannot bound, and for what lies outside the band.
ScreenPoint pointToScreen(const Camera& c, const Vec3& point, Precision precision, Band band) noexcept {
  if (!isFinite(point)) return without(PointStatus::notFinite, kNaN);
  if (precision == Precision::exact) return exactToScreen(c, {point.x, point.y, point.z, 1});
  const Projected<double, bool> r = precision == Precision::fast ? byFormula<FastFormula>(c.constants, point, band)
                                                                 : byFormula<StandardFormula>(c.constants, point, band);
  if (r.behind) {
    ScreenPoint behind = without(PointStatus::behind, r.distance);
    behind.precision = precision;
    return behind;
  }
  if (!r.valid) return exactToScreen(c, {point.x, point.y, point.z, 1});
  ScreenPoint p;
  p.x = r.x;
  p.y = r.y;
  p.depth = r.depth;
  p.viewDistance = r.distance;
  p.outside = sidesBeyond(c, p);
  p.precision = precision;
  return p;
}

}  // namespace

ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  const Vec3 xyz{point.x, point.y, point.z};
  if (point.w == 1) return worldToScreen(camera, xyz, precision);
  if (!isFinite(xyz) || !std::isfinite(point.w) || (maxAbs(xyz) == 0 && point.w == 0))
    return without(PointStatus::notFinite, kNaN);
  const Vec4 unit = withUnitWeight(point);
  const int k = point.w == 0 ? 0 : std::ilogb(point.w);
  const bool isLossless =
      std::ldexp(unit.x, k) == point.x && std::ldexp(unit.y, k) == point.y && std::ldexp(unit.z, k) == point.z;
  if (isLossless || unit.w == 0) return exactToScreen(camera, unit);
  const Attempt result = widelyToScreen(camera, point);
  ScreenPoint p = result.point;
  p.certain = result.certain;
  return p;
}

ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision) noexcept {
  return pointToScreen(camera, point, precision, {});
}

ScreenPoint worldToScreenWithin(const Camera& camera, Precision chosen, const Vec3& point) noexcept {
  const PictureReach reach = pictureReach(camera, kGuardBand);
  return pointToScreen(camera, point, chosen, {reach.x, reach.y});
}

ScreenPoint worldToScreenWithin(const Camera& camera, Precision chosen, const Vec4& point) noexcept {
  if (point.w != 1) return worldToScreen(camera, point, Precision::exact);
  return worldToScreenWithin(camera, chosen, Vec3{point.x, point.y, point.z});
}

}  // namespace viewproj
