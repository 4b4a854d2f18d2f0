#include "viewproj/screen.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <type_traits>

#include "camera/lens.hpp"
#include "projection/eye_point.hpp"
#include "projection/kernels/formulas.hpp"
#include "projection/sides.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Number is DoubleDouble, or Wide where products may leave the range of doubles. Size is what errors are counted in.

template <class Number>
using Size = std::conditional_t<std::is_same_v<Number, Wide>, Wide, double>;

double sizeOf(DoubleDouble a) noexcept { return std::fabs(a.hi); }
Wide sizeOf(const Wide& a) noexcept { return magnitude(a); }

bool isBelow(double a, double b) noexcept { return a < b; }
bool isBelow(const Wide& a, const Wide& b) noexcept { return isLess(a, b); }

int signOf(double a) noexcept { return a > 0 ? 1 : a < 0 ? -1 : 0; }
int signOf(DoubleDouble a) noexcept { return signOf(a.hi); }
int signOf(const Wide& a) noexcept { return a.sign(); }

/// A number, and how far it may be from the true one.
template <class Number>
struct Bounded {
  Number value;
  Size<Number> error = 0;
};

NearestDouble nearest(const Bounded<DoubleDouble>& b) noexcept {
  return {rounded(b.value), roundsAlike(b.value, b.error)};
}

NearestDouble nearest(const Bounded<Wide>& b) noexcept {
  if (b.value.sign() == 0) return {double(b.value), b.error.sign() == 0 && std::isfinite(b.value.value.hi)};
  const Wide share = b.error / magnitude(b.value);
  if (!isLess(share, 1)) return {nearestDouble(b.value), false};
  return nearestDouble(b.value, double(share));
}

/// A point's distances along the camera's axes times its weight, each off by at most `error`; forwardIsExact: forward
/// by nothing.
template <class Number>
struct Distances {
  Number right, up, forward;
  Size<Number> error;
  double weight;
  bool forwardIsExact = false;

  bool isDecided(const Number& distance) const noexcept {
    return signOf(error) == 0 || isBelow(error, sizeOf(distance));
  }
  /// The weight divided out.
  Bounded<Number> inWorld(const Number& distance) const noexcept {
    if (weight == 1) return {distance, error + kExactParameter * sizeOf(distance)};
    const Number divided = distance / Number(weight);
    return {divided, error / std::fabs(weight) + kExactParameter * sizeOf(divided)};
  }
  /// X / W: |X/W - x/w| <= error (1 + |x/w|) / (|w| - error).
  Bounded<Number> inWindow(const Number& distance) const noexcept {
    const Number q = distance / forward;
    const Size<Number> size = sizeOf(q);
    return {q, error * (1.0 + size) / (sizeOf(forward) - error) + kExactParameter * size};
  }
};

/// center + scale * h. reach: that of the center (ScreenMap).
template <class Number>
NearestDouble screenCoordinate(DoubleDouble center, double reach, DoubleDouble scale,
                               const Bounded<Number>& h) noexcept {
  const Number step = as<Number>(scale) * h.value;
  return nearest(Bounded<Number>{sumOrZero(as<Number>(center), step),
                                 std::fabs(scale.hi) * h.error + kExactParameter * (reach + sizeOf(step))});
}

template <class Number>
NearestDouble windowDepth(const CameraParts& c, const Bounded<Number>& distance, bool distanceIsExact) noexcept {
  const ProjectionParts& p = c.projection;
  const Number& w = distance.value;
  const DepthShares<Number> shares = depthShares<Number>(p.orthographic, p.near, p.far, w, 1, distanceIsExact);
  Number first = Number(c.depthAtNear) * shares.ofNear, second = Number(c.depthAtFar) * shares.ofFar;
  Size<Number> ofDistance = distanceIsExact ? 0 : distance.error + kExactParameter * sizeOf(w);
  if (std::isfinite(p.far)) ofDistance = ofDistance / sizeOf(Number(p.far) - Number(p.near));
  if (!p.orthographic) {
    first = first / w;
    second = second / w;
    ofDistance = p.near / sizeOf(w) * (ofDistance / sizeOf(w));
    if (std::isfinite(p.far)) ofDistance = p.far * ofDistance;
  }
  const Size<Number> range = sizeOf(Number(c.depthAtFar) - Number(c.depthAtNear));
  return nearest(
      Bounded<Number>{first + second, range * ofDistance + kExactParameter * (sizeOf(first) + sizeOf(second))});
}

/// A result, and whether it is certain to be the double nearest the true value in each of its numbers.
struct Attempt {
  ScreenPoint point;
  bool certain;
};

/// Orthographic: a direction runs out of the picture through these sides.
template <class Number>
Attempt directionOut(const Distances<Number>& e) noexcept {
  const auto side = [](const Number& a, Side below, Side above) {
    return signOf(a) < 0 ? below : signOf(a) > 0 ? above : 0;
  };
  ScreenPoint p = without(PointStatus::atInfinity, kNaN);
  p.outside = static_cast<std::uint8_t>(side(e.right, sideLeft, sideRight) | side(e.up, sideBottom, sideTop) |
                                        side(e.forward, sideNear, sideFar));
  return {p, e.isDecided(e.right) && e.isDecided(e.up) && e.isDecided(e.forward)};
}

template <class Number>
Attempt toScreen(const CameraParts& c, const Distances<Number>& e) noexcept {
  const bool isDirection = e.weight == 0, orthographic = c.projection.orthographic;
  if (isDirection && orthographic) return directionOut(e);
  const Bounded<Number> distance = isDirection        ? Bounded<Number>{}
                                   : e.forwardIsExact ? Bounded<Number>{e.forward}
                                                      : e.inWorld(e.forward);
  const NearestDouble viewDistance = isDirection ? NearestDouble{kNaN, true} : nearest(distance);
  if (!orthographic && !(signOf(e.forward) * (e.weight < 0 ? -1 : 1) > 0))
    return {without(PointStatus::behind, viewDistance.value), e.isDecided(e.forward) && viewDistance.certain};
  const ScreenMap& map = c.screen;
  const auto inWindow = [&](const Number& a) { return orthographic ? e.inWorld(a) : e.inWindow(a); };
  const NearestDouble x = screenCoordinate(map.centerX, map.reachX, map.scaleX, inWindow(e.right));
  const NearestDouble y = screenCoordinate(map.centerY, map.reachY, map.scaleY, inWindow(e.up));
  const NearestDouble depth = isDirection              ? NearestDouble{c.depthAtInfinity, e.isDecided(e.forward)}
                              : hasDepth(c.projection) ? windowDepth(c, distance, e.forwardIsExact)
                                                       : NearestDouble{kNaN, true};
  ScreenPoint p;
  p.x = x.value;
  p.y = y.value;
  p.depth = depth.value;
  p.viewDistance = viewDistance.value;
  p.outside = sidesBeyond(c, p);
  if (isDirection && std::isfinite(c.projection.far)) p.outside |= sideFar;
  return {p, viewDistance.certain && x.certain && y.certain && depth.certain};
}

Attempt toScreen(const CameraParts& c, const EyePoint& e, double weight) noexcept {
  // So far from the ends of the range, products and quotients of all these stay in it, with their last bits.
  constexpr double kLargest = 0x1p200, kSmallest = 0x1p-400;
  const bool isScalable = std::abs(e.exponent) <= 1000;
  const double scale = isScalable ? Wide::powerOfTwo(e.exponent) : 1;
  const auto hasRange = [&](DoubleDouble a) {
    const double size = std::fabs(a.hi * scale);
    return a.hi == 0 || (kSmallest < size && size < kLargest);
  };
  if (isScalable && c.constants.range < kLargest && hasRange(e.right) && hasRange(e.up) && hasRange(e.forward)) {
    const auto scaled = [&](DoubleDouble a) { return timesPowerOfTwo(a, scale); };
    return toScreen(c, Distances<DoubleDouble>{scaled(e.right), scaled(e.up), scaled(e.forward), scale * e.error,
                                               weight, e.forwardIsExact});
  }
  const auto wide = [&](DoubleDouble a) { return Wide(a, e.exponent); };
  return toScreen(c,
                  Distances<Wide>{wide(e.right), wide(e.up), wide(e.forward), wide(e.error), weight, e.forwardIsExact});
}

/// Whatever the magnitudes.
Attempt widelyToScreen(const CameraParts& c, const Vec4& point) noexcept {
  const WideEyePoint e = toEyeWidely(c.pose, point);
  return toScreen(c, Distances<Wide>{e.right, e.up, e.forward, e.error, point.w});
}

/// Of a camera that looks along an axis of the world: whether the point's coordinate there is the eye's.
bool isBesideEye(const CameraParts& c, const Vec4& point) noexcept {
  const DDVec3& forward = c.pose.rows.forward;
  return forward.x.hi != 0   ? point.x == c.pose.eye.x
         : forward.y.hi != 0 ? point.y == c.pose.eye.y
                             : point.z == c.pose.eye.z;
}

/// Double-double first; the exact rows where it cannot certify a number, and where products could leave the range of
/// doubles, numbers with an exponent of their own. What they cannot certify either is a tie, or a number that cancels
/// to about 0.
ScreenPoint exactToScreen(const CameraParts& c, const Vec4& point) noexcept {
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
    result = toScreen(c, e, point.w);
    if (!result.certain && !isInExactRange(c.pose, point)) {
      result = widelyToScreen(c, point);
    } else if (!result.certain) {
      EyePoint exact = toEyeExactly(c.pose, point);
      if (e.forwardIsExact) {
        exact.forward = scaleByPowerOfTwo(e.forward, e.exponent - exact.exponent);
        exact.forwardIsExact = true;
      }
      result = toScreen(c, exact, point.w);
    }
  }
  result.point.certain = result.certain;
  return result.point;
}

/// A residual that a camera does not have adds zeros: the same bits.
Projected<double, bool> byStandard(const ProjectionConstants& k, const Vec3& p) noexcept {
  return k.orthographic ? StandardFormula<ScalarLanes, Traits<true, true, true>>(k).point(p.x, p.y, p.z)
                        : StandardFormula<ScalarLanes, Traits<false, true, true>>(k).point(p.x, p.y, p.z);
}

}  // namespace

ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision) noexcept {
  if (!isFinite(point)) return without(PointStatus::notFinite, kNaN);
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
    return exactToScreen(c, {point.x, point.y, point.z, 1});
  }
  p.precision = precision;
  p.certain = precision == Precision::exact;
  return p;
}

ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  const Vec3 xyz{point.x, point.y, point.z};
  if (point.w == 1) return worldToScreen(camera, xyz, precision);
  if (!isFinite(xyz) || !std::isfinite(point.w) || (maxAbs(xyz) == 0 && point.w == 0))
    return without(PointStatus::notFinite, kNaN);
  const Vec4 unit = withUnitWeight(point);
  const int k = point.w == 0 ? 0 : std::ilogb(point.w);
  const bool isLossless =
      std::ldexp(unit.x, k) == point.x && std::ldexp(unit.y, k) == point.y && std::ldexp(unit.z, k) == point.z;
  if (isLossless || unit.w == 0) return exactToScreen(parts(camera), unit);
  const Attempt result = widelyToScreen(parts(camera), point);
  ScreenPoint p = result.point;
  p.certain = result.certain;
  return p;
}

}  // namespace viewproj
