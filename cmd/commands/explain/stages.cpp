#include "commands/explain/stages.hpp"

#include <cmath>
#include <limits>

#include "camera/depth.hpp"
#include "projection/clip_point.hpp"
#include "projection/window_point.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class Number>
ClipMargins marginsOf(const ClipPoint<Number>& c, const ProjectionParts& projection,
                      const Convention& convention) noexcept {
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
    result[i] = (DoubleDouble(xyz[i]) + twoProd(-origin[i], p.w)) / DoubleDouble(p.w);
  }
  return result;
}

}  // namespace

PointStages pointStages(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  PointStages s;
  s.screen = worldToScreen(camera, point);
  if (s.screen.status == PointStatus::outOfRange) {
    s.world = s.relative = s.view = s.ndc = {kNaN, kNaN, kNaN};
    s.clip = {kNaN, kNaN, kNaN, kNaN};
    s.margins = {kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
    return s;
  }
  const PoseParts& pose = parts(camera).pose;
  s.world = rounded(relativeTo({}, point));
  DDVec3 relative = relativeTo(pose.eye, point);
  if (point.w != 0)
    relative = relative + (pose.columns.right * pose.residual.x + pose.columns.up * pose.residual.y +
                           pose.columns.forward * pose.residual.z);
  s.relative = rounded(relative);
  const AxisPoint<Wide> a = toAxesExactly(pose, point);
  const auto c = toClip(parts(camera), a, convention);
  s.view = toView(a, convention);
  s.clip = toVector(c);
  s.margins = marginsOf(c, parts(camera).projection, convention);
  s.ndc = toNdc(c);
  return s;
}

PixelStages pixelStages(const Camera& camera, const Vec2& screen) noexcept {
  const CameraParts& c = parts(camera);
  const WindowPoint<Wide> at = toWindow<Wide>(c, screen);
  const WideVec3 toward = c.projection.orthographic ? toWide(c.pose.columns.forward) : offsetAt(c, at, Wide(1));
  return {{sumOrZero(screen.x, -c.screen.centerX).hi + 0.0, sumOrZero(screen.y, -c.screen.centerY).hi + 0.0},
          {nearestDouble(at.right), nearestDouble(at.up)},
          {nearestDouble(toward.x), nearestDouble(toward.y), nearestDouble(toward.z)},
          nearestDouble(lengthOf(toward)),
          screenToRay(camera, screen)};
}

DepthStages depthStages(const Camera& camera, const Vec2& screen, double depth) noexcept {
  const CameraParts& c = parts(camera);
  const DepthLine line = inverseDepthLine(c.projection, {c.depthAtNear, c.depthAtFar});
  DepthStages s;
  s.offset = line.offset.hi;
  s.scale = line.scale.hi;
  const DoubleDouble sum = sumOrZero(line.offset, line.scale * DoubleDouble(depth));
  s.sum = sum.hi + 0.0;
  s.point = screenToWorld(camera, screen, depth);
  s.distance = s.point.status != DepthStatus::point ? kNaN
               : c.projection.orthographic          ? s.sum
                                                    : (DoubleDouble(1) / sum).hi;
  return s;
}

}  // namespace viewproj::cmd
