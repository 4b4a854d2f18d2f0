#include <cmath>

#include "scene/frustum_parts.hpp"

namespace viewproj {

using namespace detail;
namespace {

/// A point between a and b: the weights of b and of a in it, and the plane it lies on. Two weights keep the digits of a
/// small one when the ends are many magnitudes apart.
struct Cut {
  Wide t, rest;
  std::uint8_t side = 0;
};

/// Whether a is nearer to the segment's end b. Compares the smaller of the weights, which has more digits.
bool isFurther(const Cut& a, const Cut& b) noexcept {
  const bool nearB = (a.rest - a.t).sign() < 0 && (b.rest - b.t).sign() < 0;
  return nearB ? (a.rest - b.rest).sign() < 0 : (b.t - a.t).sign() < 0;
}

SegmentEnd originalEnd(const Camera& camera, const Vec3& point, double t) noexcept {
  const ScreenPoint p = worldToScreen(camera, point);
  return {t, {p.x, p.y}, p.depth, p.viewDistance, 0};
}

SegmentEnd cutEnd(const CameraParts& c, const AxisDistances& a, const AxisDistances& b, const Cut& cut) noexcept {
  const auto between = [&](const Wide& from, const Wide& to) { return from * cut.rest + to * cut.t; };
  const Wide w = between(a.forward, b.forward), scale = c.constants.depthScale;
  const bool orthographic = c.projection.orthographic;
  const auto onScreen = [&](DoubleDouble center, DoubleDouble perUnit, const Wide& distance) {
    return double(sumOrZero(Wide(center), Wide(perUnit) * (orthographic ? distance : distance / w)));
  };
  SegmentEnd end{double(cut.t),
                 {onScreen(c.screen.centerX, c.screen.scaleX, between(a.right, b.right)),
                  onScreen(c.screen.centerY, c.screen.scaleY, between(a.up, b.up))},
                 double(Wide(c.constants.depthOffset) + (orthographic ? scale * w : scale / w)),
                 double(w),
                 cut.side};
  // Set the coordinate on the boundary exactly.
  const bool down = c.viewport.origin == Origin::topLeft;
  if (cut.side == sideLeft) end.screen.x = c.corners.first.x;
  if (cut.side == sideRight) end.screen.x = c.corners.last.x;
  if (cut.side == sideBottom) end.screen.y = down ? c.corners.last.y : c.corners.first.y;
  if (cut.side == sideTop) end.screen.y = down ? c.corners.first.y : c.corners.last.y;
  if (cut.side == sideNear) end.depth = c.depthAtNear, end.viewDistance = c.projection.near;
  if (cut.side == sideFar) end.depth = c.depthAtFar, end.viewDistance = c.projection.far;
  return end;
}

}  // namespace

VisibleSegment clipSegment(const Frustum& frustum, const Vec3& a, const Vec3& b) noexcept {
  const FrustumParts& f = parts(frustum);
  const CameraParts& c = parts(f.camera);
  VisibleSegment result;
  if (!isInRange(a) || !isInRange(b) || !hasDepth(c.projection)) return result;
  const AxisDistances fromA = exactDistances(c.pose, {a.x, a.y, a.z, 1});
  const AxisDistances fromB = exactDistances(c.pose, {b.x, b.y, b.z, 1});
  Cut first{0, 1, 0}, last{1, 0, 0};
  for (const ExactPlane& p : f) {
    const Wide atA = distanceInside(f, p, fromA), atB = distanceInside(f, p, fromB);
    if (atA.sign() < 0 && atB.sign() < 0) return result;
    if (atA.sign() >= 0 && atB.sign() >= 0) continue;
    const Cut cut{atA / (atA - atB), atB / (atB - atA), p.side};
    if (atA.sign() < 0 ? isFurther(cut, first) : isFurther(last, cut)) (atA.sign() < 0 ? first : last) = cut;
  }
  if (isFurther(first, last)) return result;
  result.visible = true;
  result.start = first.side == 0 ? originalEnd(f.camera, a, 0) : cutEnd(c, fromA, fromB, first);
  result.end = last.side == 0 ? originalEnd(f.camera, b, 1) : cutEnd(c, fromA, fromB, last);
  return result;
}

Vec3 pointAlong(const Vec3& a, const Vec3& b, double t) noexcept {
  Vec3 point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = double(Wide(a[i]) + Wide(t) * (Wide(b[i]) - Wide(a[i])));
  return point;
}

}  // namespace viewproj
