#include "projection/clip.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

#include "camera/lens.hpp"
#include "projection/bounds.hpp"
#include "projection/eye_point.hpp"

namespace viewproj {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Number is DoubleDouble, or Wide where products may leave the range of doubles.

/// Coordinates along right, up, forward, and 1 for a point or 0 for a direction.
template <class Number>
struct AxisPoint {
  Number right, up, forward, weight;
};

AxisPoint<DoubleDouble> toAxes(const EyePoint& e, const Vec4& p) noexcept {
  const DoubleDouble perW = p.w == 0 ? DoubleDouble(1) : DoubleDouble(1) / DoubleDouble(p.w);
  const auto inWorld = [&](DoubleDouble a) { return scaleByPowerOfTwo(a * perW, e.exponent); };
  return {inWorld(e.right), inWorld(e.up), inWorld(e.forward), p.w == 0 ? 0.0 : 1.0};
}

AxisPoint<Wide> toAxes(const WideEyePoint& e, const Vec4& p) noexcept {
  const Wide w = p.w == 0 ? 1 : p.w;
  return {e.right / w, e.up / w, e.forward / w, p.w == 0 ? 0.0 : 1.0};
}

/// Gives the point's coordinates to use, in what has the range for them.
template <class Use>
auto withAxes(const Camera& camera, const Vec4& point, EyePoint (*toEyePoint)(const Pose&, const Vec4&),
              const Use& use) noexcept {
  const Vec4 p = withUnitWeight(point);
  const EyePoint e = toEye(camera.pose, p);
  const bool isNarrow = camera.constants.range < kLargestRangeExact && std::abs(e.exponent) <= kLargestExponent &&
                        (p.w == 0) == (point.w == 0);
  if (!isNarrow) return use(toAxes(toEyeWidely(camera.pose, point), point));
  return use(toAxes(toEyePoint == toEye ? e : toEyePoint(camera.pose, p), p));
}

template <class Number>
struct ClipPoint {
  Number x, y, z, w;
};

ClipPoint<DoubleDouble> toClip(const Camera& camera, const AxisPoint<DoubleDouble>& a,
                               const Convention& convention) noexcept {
  const Lens l = ndcLens(camera.projection, convention);
  const DoubleDouble& w = l.orthographic ? a.weight : a.forward;
  return {sumOrZero(l.scaleX * a.right, l.offsetX * w), sumOrZero(l.scaleY * a.up, l.offsetY * w),
          l.orthographic ? sumOrZero(l.depth.scale * a.forward, l.depth.offset * a.weight)
                         : sumOrZero(l.depth.offset * a.forward, l.depth.scale * a.weight),
          w};
}

ClipPoint<Wide> toClip(const Camera& camera, const AxisPoint<Wide>& a, const Convention& convention) noexcept {
  const Projection& p = camera.projection;
  const Lens l = ndcLens(p, convention);
  const Wide& w = l.orthographic ? a.weight : a.forward;
  const NdcDepths depths = ndcDepths(convention);
  const DepthShares shares = depthShares(p.orthographic, p.near, p.far, a.forward, a.weight);
  return {sumOrZero(toWide(l.scaleX) * a.right, toWide(l.offsetX) * w),
          sumOrZero(toWide(l.scaleY) * a.up, toWide(l.offsetY) * w),
          Wide(depths.atNear) * shares.ofNear + Wide(depths.atFar) * shares.ofFar, w};
}

bool isUsable(const Vec4& p) noexcept { return isFinite(Vec3{p.x, p.y, p.z}) && std::isfinite(p.w); }

/// Adding 0 turns -0 into 0.
double rounded(DoubleDouble a) noexcept { return a.hi + 0.0; }
double rounded(const Wide& a) noexcept { return nearestDouble(a); }

bool isAboveZero(DoubleDouble a) noexcept { return a.hi > 0; }
bool isAboveZero(const Wide& a) noexcept { return a.sign() > 0; }

template <class Number>
Vec3 toView(const AxisPoint<Number>& a, const Convention& convention) noexcept {
  const AxisSigns sign = axisSigns(convention.view);
  return {rounded(a.right), sign.up * rounded(a.up) + 0.0, sign.forward * rounded(a.forward) + 0.0};
}

template <class Number>
Vec4 toVector(const ClipPoint<Number>& c) noexcept {
  return {rounded(c.x), rounded(c.y), rounded(c.z), rounded(c.w)};
}

template <class Number>
Vec3 toNdc(const ClipPoint<Number>& c) noexcept {
  if (!isAboveZero(c.w)) return {kNaN, kNaN, kNaN};
  return {rounded(c.x / c.w), rounded(c.y / c.w), rounded(c.z / c.w)};
}

template <class Number>
ClipMargins marginsOf(const ClipPoint<Number>& c, const Projection& projection, const Convention& convention) noexcept {
  const auto above = [&](const Number& value) { return rounded(sumOrZero(value, c.w)); };   // value >= -w
  const auto below = [&](const Number& value) { return rounded(sumOrZero(c.w, -value)); };  // value <= w
  const bool up = convention.ndcY == NdcY::up;
  const double low = convention.ndcZ == NdcZ::zeroToOne ? rounded(c.z) : above(c.z);
  const double high = below(c.z);
  const double far = convention.reverseZ ? low : high;
  return {above(c.x),
          below(c.x),
          up ? above(c.y) : below(c.y),
          up ? below(c.y) : above(c.y),
          convention.reverseZ ? high : low,
          std::isinf(projection.far) ? kNaN : far};
}

/// (x / w, y / w, z / w), relative to origin; a direction as it is.
DDVec3 relativeTo(const Vec3& origin, const Vec4& p) noexcept {
  const Vec3 xyz{p.x, p.y, p.z};
  if (p.w == 0) return toDoubleDouble(xyz);
  DDVec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    Expansion<3> sum{xyz[i]};
    if (origin[i] != 0) sum.addProduct(-origin[i], p.w);
    result[i] = sum.rounded() / DoubleDouble(p.w);
  }
  return result;
}

}  // namespace

Vec3 worldToView(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN};
  return withAxes(camera, point, toEye, [&](const auto& a) { return toView(a, convention); });
}

Vec4 worldToClip(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN, kNaN};
  return withAxes(camera, point, toEye, [&](const auto& a) { return toVector(toClip(camera, a, convention)); });
}

Vec3 worldToNdc(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN};
  return withAxes(camera, point, toEye, [&](const auto& a) { return toNdc(toClip(camera, a, convention)); });
}

PointStages pointStages(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  PointStages s;
  s.screen = worldToScreen(camera, point);
  if (s.screen.status == PointStatus::notFinite) {
    s.world = s.relative = s.view = s.ndc = {kNaN, kNaN, kNaN};
    s.clip = {kNaN, kNaN, kNaN, kNaN};
    s.margins = {kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
    return s;
  }
  const Pose& pose = camera.pose;
  const Vec4 p = withUnitWeight(point);
  s.world = rounded(relativeTo({}, p));
  DDVec3 relative = relativeTo(pose.eye, p);
  if (p.w != 0)
    relative = relative + (pose.columns.right * pose.residual.x + pose.columns.up * pose.residual.y +
                           pose.columns.forward * pose.residual.z);
  s.relative = rounded(relative);
  withAxes(camera, point, toEyeExactly, [&](const auto& a) {
    const auto c = toClip(camera, a, convention);
    s.view = toView(a, convention);
    s.clip = toVector(c);
    s.margins = marginsOf(c, camera.projection, convention);
    s.ndc = toNdc(c);
  });
  return s;
}

}  // namespace viewproj
