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

AxisPoint toAxes(const Pose& pose, const Vec4& point) noexcept {
  const Vec4 p = withUnitWeight(point);
  const EyePoint e = toEye(pose, p);
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

}  // namespace

Vec3 worldToView(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN};
  const AxisPoint a = toAxes(camera.pose, point);
  const AxisSigns sign = axisSigns(convention.view);
  return {rounded(a.right), sign.up * a.up.hi + 0.0, sign.forward * a.forward.hi + 0.0};
}

Vec4 worldToClip(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN, kNaN};
  const ClipPoint c = toClip(ndcLens(camera.projection, convention), toAxes(camera.pose, point));
  return {rounded(c.x), rounded(c.y), rounded(c.z), rounded(c.w)};
}

Vec3 worldToNdc(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN};
  const ClipPoint c = toClip(ndcLens(camera.projection, convention), toAxes(camera.pose, point));
  if (!(c.w.hi > 0)) return {kNaN, kNaN, kNaN};
  return {rounded(c.x / c.w), rounded(c.y / c.w), rounded(c.z / c.w)};
}

}  // namespace viewproj
