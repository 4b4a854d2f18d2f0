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

/// sign (X - edge W) >= 0 of a window's edge, X or Y in X's place; sign (X - edge) >= 0 in orthographic and, of W, of
/// near and far. across: the edge on the other side.
void add(FrustumParts& f, Side side, DoubleDouble edge, double across, double sign) noexcept {
  const CameraParts& c = parts(f.camera);
  const Axes& rows = c.pose.rows;
  const DDVec3& left = c.pose.residual;
  const bool isTilted = !isDepth(side) && !c.projection.orthographic;
  const DDVec3& axis = isDepth(side) ? rows.forward : isUpright(side) ? rows.right : rows.up;
  const DoubleDouble residual = isDepth(side) ? left.z : isUpright(side) ? left.x : left.y;
  const double reach = std::max(std::fabs(edge.hi), std::fabs(across));
  ExactPlane& p = f.planes[f.count];
  p.side = side;
  p.edge = edge;
  p.normal = isTilted ? toWide(axis) - toWide(rows.forward) * p.edge : toWide(axis);
  p.offset = Wide(residual) - (isTilted ? p.edge * Wide(left.z) : p.edge);
  p.scale = Wide(sign) / lengthOf(p.normal);
  p.normal = p.normal * p.scale;
  p.offset = p.offset * p.scale;
  const double perLength = double(magnitude(p.scale));
  p.normalBound = kPlaneBound * (1 + (isTilted ? reach : 0)) * perLength;
  p.offsetBound = p.normalBound * perLength * (std::fabs(residual.hi) + reach * (isTilted ? std::fabs(left.z.hi) : 1));
  const Vec3 n = rounded(p.normal);
  f.rounded[f.count++] = {side, {n.x, n.y, n.z, double(p.offset - dot(p.normal, toWide(c.pose.eye)))}};
}

/// A distance inside, and how far from the true one it may be.
struct Measured {
  Wide distance, bound;

  bool isCertain() const noexcept { return isLess(bound, magnitude(distance)); }
};

Measured distance(const FrustumParts& f, const ExactPlane& p, const Vec3& point) noexcept {
  const WideVec3 v = toWide(point) - toWide(parts(f.camera).pose.eye);
  return {dot(p.normal, v) + p.offset, Wide(p.normalBound) * oneNorm(v) + Wide(p.offsetBound)};
}

/// From the exact rows, in microseconds.
Measured exactDistance(const FrustumParts& f, const ExactPlane& p, const Vec3& point) noexcept {
  const CameraParts& c = parts(f.camera);
  const AxisDistances e = exactDistances(c.pose, {point.x, point.y, point.z, 1});
  const Wide& along = isDepth(p.side) ? e.forward : isUpright(p.side) ? e.right : e.up;
  const bool isTilted = !isDepth(p.side) && !c.projection.orthographic;
  const Wide edge = isTilted ? p.edge * e.forward : p.edge;
  const Wide size = (magnitude(along) + magnitude(edge)) * Wide(kCullBound);
  const Wide ofRows = isTilted ? e.error * (Wide(1) + magnitude(p.edge)) : e.error;
  return {(along - edge) * p.scale, (size + ofRows) * magnitude(p.scale)};
}

/// Of a shape, the points that decide on which side of a plane it lies, and how much farther a sphere reaches.
struct Deciding {
  std::array<Vec3, 3> points;
  std::size_t count = 1;
  Wide radius = {};
};

/// The distances of a shape's point farthest inside a plane and of the one farthest beyond it.
struct Ends {
  Measured inmost, outmost;

  bool areCertain() const noexcept { return inmost.isCertain() && outmost.isCertain(); }
};

/// share: what of the radius the bound takes up.
template <class Measure>
Ends endsOf(const Deciding& shape, double share, const Measure& measure) noexcept {
  Ends ends{measure(shape.points[0]), {}};
  ends.outmost = ends.inmost;
  for (std::size_t i = 1; i < shape.count; ++i) {
    const Measured d = measure(shape.points[i]);
    if (isLess(ends.inmost.distance, d.distance)) ends.inmost = d;
    if (isLess(d.distance, ends.outmost.distance)) ends.outmost = d;
  }
  ends.inmost.distance = ends.inmost.distance + shape.radius;
  ends.outmost.distance = ends.outmost.distance - shape.radius;
  for (Measured* end : {&ends.inmost, &ends.outmost}) end->bound = end->bound + shape.radius * Wide(share);
  return ends;
}

template <class DecidingOn>
Cull verdictOf(const FrustumParts& f, const DecidingOn& decidingOn) noexcept {
  Cull result{CullVerdict::inside, 0};
  Wide farthest;
  for (const ExactPlane& p : f) {
    const Deciding shape = decidingOn(p);
    Ends ends = endsOf(shape, p.normalBound, [&](const Vec3& v) { return distance(f, p, v); });
    if (!ends.areCertain()) ends = endsOf(shape, kCullBound, [&](const Vec3& v) { return exactDistance(f, p, v); });
    const auto& [inmost, outmost] = ends;
    const bool outside = isLess(inmost.distance + inmost.bound, 0);
    if (!outside && (result.verdict == CullVerdict::outside || !isLess(outmost.distance + outmost.bound, 0))) continue;
    // Of outside, how far the whole shape is beyond; of intersects, how far a part of it is.
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
