#include "projection/exact_point.hpp"

#include <algorithm>
#include <cmath>

#include "camera/depth.hpp"
#include "camera/require.hpp"
#include "projection/kernels/error_model.hpp"

namespace viewproj::detail {
namespace {

/// A number and its largest error.
struct Bounded {
  Wide value;
  Wide error;
};

NearestDouble nearest(const Bounded& b) noexcept {
  if (b.value.sign() == 0) return {double(b.value), b.error.sign() == 0 && std::isfinite(b.value.value.hi)};
  // The error of rounding to double does not count.
  const double share =
      std::ldexp(b.error.value.hi / std::fabs(b.value.value.hi), b.error.exponent - b.value.exponent) * (1 + 0x1p-50);
  return nearestDouble(b.value, share < 1 ? share : 1);
}

/// A point's distances along the camera's axes times its weight. forwardIsExact: forward has no error.
struct Distances {
  Wide right, up, forward;
  double weight;
  bool forwardIsExact;

  Bounded dividedByWeight(const Wide& distance) const noexcept {
    return withError(weight == 1 ? distance : distance / Wide(weight));
  }
  Bounded dividedByForward(const Wide& distance) const noexcept { return withError(distance / forward); }

 private:
  static Bounded withError(const Wide& value) noexcept { return {value, Wide(kExactParameter) * magnitude(value)}; }
};

/// center + scale * h. reach: the center's, from ScreenMap.
NearestDouble screenCoordinate(DoubleDouble center, double reach, DoubleDouble scale, const Bounded& h) noexcept {
  const Wide step = Wide(scale) * h.value;
  return nearest({sumOrZero(Wide(center), step),
                  Wide(std::fabs(scale.hi)) * h.error + Wide(kExactParameter) * (Wide(reach) + magnitude(step))});
}

/// The direction, scaled by a power of two, so that squares neither overflow nor underflow.
Sight<DoubleDouble> sightOf(const Distances& e) noexcept {
  const int exponent = std::max({e.right.exponent, e.up.exponent, e.forward.exponent});
  const auto scaled = [&](const Wide& a) {
    const int power = std::max(a.exponent - exponent, -900);
    const DoubleDouble value = scaleByPowerOfTwo(a.value, power);
    return e.weight < 0 ? -value : value;
  };
  return {scaled(e.right), -scaled(e.up), scaled(e.forward)};
}

NearestDouble windowDepth(const CameraParts& c, const Bounded& distance, bool distanceIsExact) noexcept {
  const ProjectionParts& p = c.projection;
  const Wide& w = distance.value;
  const DepthShares shares = depthShares(p, w, 1, distanceIsExact);
  Wide first = Wide(c.depthAtNear) * shares.ofNear, second = Wide(c.depthAtFar) * shares.ofFar;
  Wide ofDistance;
  if (!distanceIsExact) ofDistance = distance.error + Wide(kExactParameter) * magnitude(w);
  if (std::isfinite(p.far)) ofDistance = ofDistance / (Wide(p.far) - Wide(p.near));
  if (!p.orthographic) {
    first = first / w;
    second = second / w;
    ofDistance = Wide(p.near) / w * (ofDistance / w);
    if (std::isfinite(p.far)) ofDistance = Wide(p.far) * ofDistance;
  }
  const Wide range = magnitude(Wide(c.depthAtFar) - Wide(c.depthAtNear));
  return nearest({first + second, range * ofDistance + Wide(kExactParameter) * (magnitude(first) + magnitude(second))});
}

/// Orthographic: the sides through which a direction leaves the picture.
ScreenPoint directionOut(const Distances& e) noexcept {
  const auto side = [](const Wide& a, Side below, Side above) {
    return a.sign() < 0 ? below : a.sign() > 0 ? above : 0;
  };
  ScreenPoint p = without(PointStatus::atInfinity, kNaN);
  p.outside = static_cast<std::uint8_t>(side(e.right, sideLeft, sideRight) | side(e.up, sideBottom, sideTop) |
                                        side(e.forward, sideNear, sideFar));
  p.certain = true;
  return p;
}

ScreenPoint toScreen(const CameraParts& c, const Distances& e) noexcept {
  const bool isDirection = e.weight == 0, orthographic = c.projection.orthographic;
  if (isDirection && orthographic) return directionOut(e);
  const Bounded distance = isDirection        ? Bounded{}
                           : e.forwardIsExact ? Bounded{e.forward, {}}
                                              : e.dividedByWeight(e.forward);
  const NearestDouble viewDistance = isDirection ? NearestDouble{kNaN, true} : nearest(distance);
  const bool isForward = e.forward.sign() * (e.weight < 0 ? -1 : 1) > 0;
  ScreenPoint p;
  LensPixel bent{};
  if (c.lens) bent = bentPixel(c, sightOf(e));
  if (!orthographic && (c.lens ? !bent.seen.isSeen : !isForward)) {
    p = without(isForward ? PointStatus::beyondLens : PointStatus::behind, viewDistance.value);
    p.certain = viewDistance.certain && (!c.lens || bent.seen.certain);
    if (!isForward) return p;
  }
  const NearestDouble depth = !orthographic && !isForward ? NearestDouble{kNaN, true}
                              : isDirection               ? NearestDouble{c.depthAtInfinity, true}
                              : hasDepth(c.projection)    ? windowDepth(c, distance, e.forwardIsExact)
                                                          : NearestDouble{kNaN, true};
  p.depth = depth.value;
  if (p.status == PointStatus::beyondLens) {
    p.certain = p.certain && depth.certain;
    return p;
  }
  const ScreenMap& map = c.screen;
  const auto inWindow = [&](const Wide& a) { return orthographic ? e.dividedByWeight(a) : e.dividedByForward(a); };
  if (!c.lens) {
    bent.x = screenCoordinate(map.centerX, map.reachX, map.scaleX, inWindow(e.right));
    bent.y = screenCoordinate(map.centerY, map.reachY, map.scaleY, inWindow(e.up));
  }
  p.x = bent.x.value;
  p.y = bent.y.value;
  p.viewDistance = viewDistance.value;
  p.certain =
      viewDistance.certain && bent.x.certain && bent.y.certain && depth.certain && (!c.lens || bent.seen.certain);
  p.outside = sidesBeyond(c, p);
  if (isDirection && isForward && std::isfinite(c.projection.far)) p.outside |= sideFar;
  if (isDirection && !isForward && hasDepth(c.projection)) p.outside |= sideNear;
  return p;
}

/// Of a point in the domain.
Distances distancesOf(const CameraParts& c, const Vec4& point) noexcept {
  const AxisDistances a = exactDistances(c.pose, point);
  Distances e{a.right, a.up, a.forward, point.w, c.constants.forwardIsAxis && point.w == 1};
  if (e.forwardIsExact) {
    const std::size_t axis = onlyEntry(c.pose.exact->rows[2]);
    const DoubleDouble away = twoDiff(Vec3{point.x, point.y, point.z}[axis], c.pose.eye[axis]);
    e.forward = c.pose.rows.forward[axis].hi < 0 ? -away : away;
  }
  return e;
}

}  // namespace

bool isInDomain(const Vec3& eye, const Vec4& p) noexcept {
  if (!isInDomain(p.w) || (p.w == 0 && p.x == 0 && p.y == 0 && p.z == 0)) return false;
  const double w = p.w;
  const double reach = std::fabs(p.x - w * eye.x) + std::fabs(p.y - w * eye.y) + std::fabs(p.z - w * eye.z);
  return reach < kFarthestPoint * (w == 0 ? 1 : std::fabs(w));
}

AxisDistances exactDistances(const PoseParts& pose, const Vec4& point) noexcept {
  const ExactPose& exact = *pose.exact;
  const Dyadic<1> w = point.w;
  const Vec3 xyz{point.x, point.y, point.z};
  Vector3<Dyadic<2>> d;
  for (std::size_t i = 0; i < 3; ++i) {
    if (point.w == 1)
      d[i] = Dyadic<1>::difference(xyz[i], exact.origin[i]);
    else
      d[i] = Dyadic<2>(xyz[i]) - Dyadic<1>(exact.origin[i]) * w;
  }
  std::array<Wide, 3> along;
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic<5> sum = dot(exact.rows[i], d);
    along[i] = (exact.translation[i] == 0 ? sum : sum + Dyadic<1>(exact.translation[i]) * w).rounded() * exact.scale[i];
  }
  return {along[0], along[1], along[2]};
}

ScreenPoint exactToScreen(const CameraParts& c, const Vec4& point) noexcept {
  if (!isInDomain(c.pose.eye, point)) return without(PointStatus::outOfRange, kNaN);
  return toScreen(c, distancesOf(c, point));
}

Sight<DoubleDouble> exactSight(const CameraParts& c, const Vec4& point) noexcept {
  return sightOf(distancesOf(c, point));
}

}  // namespace viewproj::detail
