#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "projection/exact_point.hpp"
#include "scene/frustum_parts.hpp"

namespace viewproj {

using namespace detail;
namespace {

bool isDepth(Side side) noexcept { return side == sideNear || side == sideFar; }
bool isUpright(Side side) noexcept { return side == sideLeft || side == sideRight; }

/// Adds a plane: for a window's edge sign (X - edge W) >= 0, or Y instead of X; in orthographic sign (X - edge) >= 0;
/// for near and far sign (W - edge) >= 0. across: the opposite edge.
void add(FrustumParts& f, Side side, DoubleDouble edge, double across, double sign) noexcept {
  const CameraParts& c = parts(f.camera);
  const Axes& rows = c.pose.rows;
  const DDVec3& residuals = c.pose.residual;
  const bool isTilted = !isDepth(side) && !c.projection.orthographic;
  const DDVec3& axis = isDepth(side) ? rows.forward : isUpright(side) ? rows.right : rows.up;
  const DoubleDouble residual = isDepth(side) ? residuals.z : isUpright(side) ? residuals.x : residuals.y;
  const double reach = std::max(std::fabs(edge.hi), std::fabs(across));
  ExactPlane& p = f.planes[f.count];
  p.side = side;
  p.edge = edge;
  p.normal = isTilted ? toWide(axis) - toWide(rows.forward) * p.edge : toWide(axis);
  p.offset = Wide(residual) - (isTilted ? p.edge * Wide(residuals.z) : p.edge);
  p.scale = Wide(sign) / lengthOf(p.normal);
  p.normal = p.normal * p.scale;
  p.offset = p.offset * p.scale;
  const double perLength = double(magnitude(p.scale));
  p.normalBound = kPlaneBound * (1 + (isTilted ? reach : 0)) * perLength;
  p.offsetBound =
      p.normalBound * perLength * (std::fabs(residual.hi) + reach * (isTilted ? std::fabs(residuals.z.hi) : 1));
  const Vec3 n = rounded(p.normal);
  f.rounded[f.count++] = {side, {n.x, n.y, n.z, double(p.offset - dot(p.normal, toWide(c.pose.eye)))}};
}

/// The signed distance to a plane, positive inside, and its error bound.
struct Measured {
  Wide distance, bound;

  bool isCertain() const noexcept { return isLess(bound, magnitude(distance)); }
};

Measured distance(const FrustumParts& f, const ExactPlane& p, const Vec3& point) noexcept {
  const WideVec3 v = toWide(point) - toWide(parts(f.camera).pose.eye);
  return {dot(p.normal, v) + p.offset, Wide(p.normalBound) * oneNorm(v) + Wide(p.offsetBound)};
}

/// Uses the exact rows. Takes microseconds.
Measured exactDistance(const FrustumParts& f, const ExactPlane& p, const Vec3& point) noexcept {
  const CameraParts& c = parts(f.camera);
  const AxisDistances e = exactDistances(c.pose, {point.x, point.y, point.z, 1});
  const Wide& along = isDepth(p.side) ? e.forward : isUpright(p.side) ? e.right : e.up;
  const bool isTilted = !isDepth(p.side) && !c.projection.orthographic;
  const Wide edge = isTilted ? p.edge * e.forward : p.edge;
  const Wide size = (magnitude(along) + magnitude(edge)) * Wide(kCullBound);
  return {(along - edge) * p.scale, size * magnitude(p.scale)};
}

/// The points of a shape that decide on which side of a plane it lies. radius: how much farther a sphere reaches.
struct Deciding {
  std::array<Vec3, 3> points;
  std::size_t count = 1;
  Wide radius = {};
};

/// The distances of the shape's points that lie farthest inside and farthest outside a plane.
struct Ends {
  Measured inmost, outmost;
  bool areCertain = true;
};

/// share: the part of the radius to add to the bound.
template <class Measure>
Ends endsOf(const Deciding& shape, double share, const Measure& measure) noexcept {
  Ends ends;
  for (std::size_t i = 0; i < shape.count; ++i) {
    const Measured d = measure(shape.points[i]);
    const Wide bound = d.bound + shape.radius * Wide(share);
    const Measured in{d.distance + shape.radius, bound}, out{d.distance - shape.radius, bound};
    ends.areCertain = ends.areCertain && in.isCertain() && out.isCertain();
    if (i == 0 || isLess(ends.inmost.distance + ends.inmost.bound, in.distance + bound)) ends.inmost = in;
    if (i == 0 || isLess(out.distance + bound, ends.outmost.distance + ends.outmost.bound)) ends.outmost = out;
  }
  return ends;
}

template <class DecidingOn>
Cull verdictOf(const FrustumParts& f, const DecidingOn& decidingOn) noexcept {
  Cull result{CullVerdict::inside, 0};
  Wide farthest;
  for (const ExactPlane& p : f) {
    const Deciding shape = decidingOn(p);
    Ends ends = endsOf(shape, p.normalBound, [&](const Vec3& v) { return distance(f, p, v); });
    if (!ends.areCertain) ends = endsOf(shape, kCullBound, [&](const Vec3& v) { return exactDistance(f, p, v); });
    const auto& [inmost, outmost, certain] = ends;
    const bool outside = isLess(inmost.distance + inmost.bound, 0);
    if (!outside && (result.verdict == CullVerdict::outside || !isLess(outmost.distance + outmost.bound, 0))) continue;
    // For outside, how far the nearest point is beyond; for intersects, how far the farthest one is.
    const Wide beyond = outside ? inmost.distance : outmost.distance;
    const CullVerdict verdict = outside ? CullVerdict::outside : CullVerdict::intersects;
    if (verdict == result.verdict && !isLess(beyond, farthest)) continue;
    result = {verdict, p.side};
    farthest = beyond;
  }
  return result;
}

}  // namespace

Frustum viewFrustum(const Camera& camera) {
  if (parts(camera).lens)
    throw CameraError("distortion", "bends straight edges: planes, shapes and segments need a camera without it");
  const ProjectionParts& p = parts(camera).projection;
  const auto made = std::make_shared<FrustumParts>(FrustumParts{camera});
  add(*made, sideLeft, p.left, p.right.hi, 1);
  add(*made, sideRight, p.right, p.left.hi, -1);
  add(*made, sideBottom, p.bottom, p.top.hi, 1);
  add(*made, sideTop, p.top, p.bottom.hi, -1);
  if (hasDepth(p)) add(*made, sideNear, p.near, 0, 1);
  if (std::isfinite(p.far)) add(*made, sideFar, p.far, 0, -1);
  return Access::whole<Frustum, FrustumParts>(made);
}

const Camera& Frustum::camera() const noexcept { return parts_->camera; }
std::span<const FrustumPlane> Frustum::planes() const noexcept { return {parts_->rounded.data(), parts_->count}; }

Cull cull(const Frustum& frustum, const Vec3& point) noexcept {
  if (!isInRange(point)) return {};
  return verdictOf(parts(frustum), [&](const ExactPlane&) { return Deciding{{point}}; });
}

Cull cull(const Frustum& frustum, const Sphere& sphere) noexcept {
  if (!isValid(sphere)) return {};
  return verdictOf(parts(frustum), [&](const ExactPlane&) { return Deciding{{sphere.center}, 1, sphere.radius}; });
}

Cull cull(const Frustum& frustum, const Box& box) noexcept {
  if (!isValid(box)) return {};
  return verdictOf(parts(frustum), [&](const ExactPlane& p) {
    Deciding corners{{box.max, box.min}, 2};
    for (std::size_t i = 0; i < 3; ++i)
      if (p.normal[i].sign() < 0) std::swap(corners.points[0][i], corners.points[1][i]);
    return corners;
  });
}

Cull cull(const Frustum& frustum, const Triangle& t) noexcept {
  if (!isValid(t)) return {};
  return verdictOf(parts(frustum), [&](const ExactPlane&) { return Deciding{{t.a, t.b, t.c}, 3}; });
}

Wide detail::distanceInside(const FrustumParts& f, const ExactPlane& p, const Vec3& point) noexcept {
  Measured d = distance(f, p, point);
  if (!d.isCertain()) d = exactDistance(f, p, point);
  return d.isCertain() ? d.distance : Wide();
}

}  // namespace viewproj
