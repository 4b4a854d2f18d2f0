#include "viewproj/view/clip.hpp"

#include <cmath>
#include <limits>

#include "viewproj/view/eye_point.hpp"
#include "viewproj/view/lens.hpp"

namespace viewproj {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Coordinates along right, up, forward, and 1 for a point or 0 for a direction.
struct AxisPoint {
  DoubleDouble right, up, forward, weight;
};

AxisPoint toAxes(const Pose& pose, const Vec4& point,
                 EyePoint (*toEyePoint)(const Pose&, const Vec4&) = toEye) noexcept {
  const Vec4 p = withUnitWeight(point);
  const EyePoint e = toEyePoint(pose, p);
  const DoubleDouble perW = p.w == 0 ? DoubleDouble(1) : DoubleDouble(1) / DoubleDouble(p.w);
  const auto inWorld = [&](DoubleDouble a) { return scaleByPowerOfTwo(a * perW, e.exponent); };
  return {inWorld(e.right), inWorld(e.up), inWorld(e.forward), p.w == 0 ? 0.0 : 1.0};
}

struct ClipPoint {
  DoubleDouble x, y, z, w;
};

ClipPoint toClip(const Lens& l, const AxisPoint& a) noexcept {
  const DoubleDouble& w = l.orthographic ? a.weight : a.forward;
  return {sumOrZero(l.scaleX * a.right, l.offsetX * w), sumOrZero(l.scaleY * a.up, l.offsetY * w),
          l.orthographic ? sumOrZero(l.depth.scale * a.forward, l.depth.offset * a.weight)
                         : sumOrZero(l.depth.offset * a.forward, l.depth.scale * a.weight),
          w};
}

bool isUsable(const Vec4& p) noexcept { return isFinite(Vec3{p.x, p.y, p.z}) && std::isfinite(p.w); }

/// Adding 0 turns -0 into 0.
double rounded(DoubleDouble a) noexcept { return a.hi + 0.0; }

Vec3 toView(const AxisPoint& a, const Convention& convention) noexcept {
  const AxisSigns sign = axisSigns(convention.view);
  return {rounded(a.right), sign.up * a.up.hi + 0.0, sign.forward * a.forward.hi + 0.0};
}

Vec3 toNdc(const ClipPoint& c) noexcept {
  if (!(c.w.hi > 0)) return {kNaN, kNaN, kNaN};
  return {rounded(c.x / c.w), rounded(c.y / c.w), rounded(c.z / c.w)};
}

ClipMargins marginsOf(const ClipPoint& c, const Projection& projection, const Convention& convention) noexcept {
  const auto above = [&](DoubleDouble value) { return rounded(sumOrZero(value, c.w)); };   // value >= -w
  const auto below = [&](DoubleDouble value) { return rounded(sumOrZero(c.w, -value)); };  // value <= w
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
  return toView(toAxes(camera.pose, point), convention);
}

Vec4 worldToClip(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN, kNaN};
  const ClipPoint c = toClip(ndcLens(camera.projection, convention), toAxes(camera.pose, point));
  return {rounded(c.x), rounded(c.y), rounded(c.z), rounded(c.w)};
}

Vec3 worldToNdc(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN};
  return toNdc(toClip(ndcLens(camera.projection, convention), toAxes(camera.pose, point)));
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
  const AxisPoint a = toAxes(pose, point, toEyeExactly);
  const ClipPoint c = toClip(ndcLens(camera.projection, convention), a);
  s.world = rounded(relativeTo({}, p));
  DDVec3 relative = relativeTo(pose.eye, p);
  if (p.w != 0)
    relative = relative + (pose.columns.right * pose.residual.x + pose.columns.up * pose.residual.y +
                           pose.columns.forward * pose.residual.z);
  s.relative = rounded(relative);
  s.view = toView(a, convention);
  s.clip = {rounded(c.x), rounded(c.y), rounded(c.z), rounded(c.w)};
  s.margins = marginsOf(c, camera.projection, convention);
  s.ndc = toNdc(c);
  return s;
}

}  // namespace viewproj
