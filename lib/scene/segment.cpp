#include <algorithm>
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

SegmentEnd cutEnd(const CameraParts& c, const Vec3& a, const Vec3& b, const Cut& cut) noexcept {
  const WideVec3 eye = toWide(c.pose.eye), at = (toWide(a) - eye) * cut.rest + (toWide(b) - eye) * cut.t;
  const auto along = [&](const DDVec3& row, DoubleDouble residual) { return dot(toWide(row), at) + Wide(residual); };
  const Wide w = along(c.pose.rows.forward, c.pose.residual.z), scale = c.constants.depthScale;
  const bool orthographic = c.projection.orthographic;
  const auto onScreen = [&](DoubleDouble center, DoubleDouble perUnit, const Wide& distance) {
    return double(sumOrZero(Wide(center), Wide(perUnit) * (orthographic ? distance : distance / w)));
  };
  SegmentEnd end{double(cut.t),
                 {onScreen(c.screen.centerX, c.screen.scaleX, along(c.pose.rows.right, c.pose.residual.x)),
                  onScreen(c.screen.centerY, c.screen.scaleY, along(c.pose.rows.up, c.pose.residual.y))},
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
  VisibleSegment result;
  if (!isInRange(a) || !isInRange(b) || !hasDepth(parts(f.camera).projection)) return result;
  Cut first{0, 1, 0}, last{1, 0, 0};
  for (const ExactPlane& p : f) {
    const Wide atA = distanceInside(f, p, a), atB = distanceInside(f, p, b);
    if (atA.sign() < 0 && atB.sign() < 0) return result;
    if (atA.sign() >= 0 && atB.sign() >= 0) continue;
    const Cut cut{atA / (atA - atB), atB / (atB - atA), p.side};
    if (atA.sign() < 0 ? isFurther(cut, first) : isFurther(last, cut)) (atA.sign() < 0 ? first : last) = cut;
  }
  if (isFurther(first, last)) return result;
  const CameraParts& c = parts(f.camera);
  result.visible = true;
  result.start = first.side == 0 ? originalEnd(f.camera, a, 0) : cutEnd(c, a, b, first);
  result.end = last.side == 0 ? originalEnd(f.camera, b, 1) : cutEnd(c, a, b, last);
  return result;
}

Vec3 pointAlong(const Vec3& a, const Vec3& b, double t) noexcept {
  Vec3 point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = double(Wide(a[i]) + Wide(t) * (Wide(b[i]) - Wide(a[i])));
  return point;
}

}  // namespace viewproj
