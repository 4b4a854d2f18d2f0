#include "scene/frustum.hpp"

#include <algorithm>
#include <cmath>

namespace viewproj {
namespace {

/// sign (normal . (p - eye) + offset) >= 0, not yet of unit length. reach is the larger of the plane's window edge and
/// the one across from it; parts is the size of what the offset is a sum of.
FrustumPlane plane(const Camera& c, Side side, const WideVec3& normal, const Wide& offset, double sign, double reach,
                   double parts) noexcept {
  const Wide scale = Wide(sign) / lengthOf(normal);
  FrustumPlane p;
  p.side = side;
  p.normal = normal * scale;
  p.offset = offset * scale;
  const double perLength = double(magnitude(scale));
  p.normalBound = kPlaneBound * (1 + reach) * perLength;
  p.offsetBound = p.normalBound * (parts * perLength);
  const Vec3 n = rounded(p.normal);
  p.equation = {n.x, n.y, n.z, double(p.offset - dot(p.normal, toWide(c.pose.eye)))};
  return p;
}

/// Of an edge of the window: sign (X - edge W) >= 0, or sign (X - edge) >= 0 in orthographic. X is axis . (p - eye) +
/// residual.
FrustumPlane windowPlane(const Camera& c, Side side, const DDVec3& axis, DoubleDouble residual, DoubleDouble edge,
                         DoubleDouble across, double sign) noexcept {
  const double reach = std::max(std::fabs(edge.hi), std::fabs(across.hi));
  const Wide wideEdge(edge, 0);
  if (c.projection.orthographic)
    return plane(c, side, toWide(axis), Wide(residual, 0) - wideEdge, sign, 0, std::fabs(residual.hi) + reach);
  const DoubleDouble depthResidual = c.pose.residual.z;
  return plane(c, side, toWide(axis) - toWide(c.pose.rows.forward) * wideEdge,
               Wide(residual, 0) - wideEdge * Wide(depthResidual, 0), sign, reach,
               std::fabs(residual.hi) + reach * std::fabs(depthResidual.hi));
}

/// Across the view: sign (W - distance) >= 0.
FrustumPlane depthPlane(const Camera& c, Side side, double distance, double sign) noexcept {
  const DoubleDouble residual = c.pose.residual.z;
  return plane(c, side, toWide(c.pose.rows.forward), Wide(residual, 0) - Wide(distance), sign, 0,
               std::fabs(residual.hi) + std::fabs(distance));
}

/// A corner of a box or the centre of a sphere, relative to the eye.
WideVec3 relativeToEye(const Frustum& f, const Vec3& p) noexcept { return toWide(p) - toWide(f.camera.pose.eye); }

Wide oneNorm(const WideVec3& v) noexcept { return magnitude(v.x) + magnitude(v.y) + magnitude(v.z); }

Wide distance(const FrustumPlane& p, const WideVec3& v) noexcept { return dot(p.normal, v) + p.offset; }

/// The planes' distances of the two points of a shape that lie farthest inside and farthest beyond. reach: the larger
/// |p - eye|_1 that went into them.
struct Extent {
  Wide inmost, outmost;
  Wide reach;
};

template <class ExtentOf>
Cull verdictOf(const Frustum& f, const ExtentOf& extentOf) noexcept {
  Cull result{CullVerdict::inside, 0};
  Wide farthest;
  for (const FrustumPlane& p : f) {
    const Extent e = extentOf(p);
    const Wide bound = Wide(p.normalBound) * e.reach + Wide(p.offsetBound);
    const bool outside = isLess(e.inmost + bound, 0);
    if (!outside && (result.verdict == CullVerdict::outside || !isLess(e.outmost + bound, 0))) continue;
    // Of outside, how far the whole shape is beyond; of intersects, how far a part of it is.
    const Wide beyond = outside ? e.inmost : e.outmost;
    const CullVerdict verdict = outside ? CullVerdict::outside : CullVerdict::intersects;
    if (verdict == result.verdict && !isLess(beyond, farthest)) continue;
    result = {verdict, p.side};
    farthest = beyond;
  }
  return result;
}

}  // namespace

Frustum viewFrustum(const Camera& c) noexcept {
  const Projection& p = c.projection;
  const Pose& pose = c.pose;
  Frustum f;
  f.camera = c;
  f.planes = {windowPlane(c, sideLeft, pose.rows.right, pose.residual.x, p.left, p.right, 1),
              windowPlane(c, sideRight, pose.rows.right, pose.residual.x, p.right, p.left, -1),
              windowPlane(c, sideBottom, pose.rows.up, pose.residual.y, p.bottom, p.top, 1),
              windowPlane(c, sideTop, pose.rows.up, pose.residual.y, p.top, p.bottom, -1),
              depthPlane(c, sideNear, p.near, 1),
              {}};
  f.count = std::isfinite(p.far) ? 6 : 5;
  if (f.count == 6) f.planes[5] = depthPlane(c, sideFar, p.far, -1);
  return f;
}

Cull cull(const Frustum& f, const Vec3& point) noexcept {
  if (!isFinite(point)) return {};
  const WideVec3 relative = relativeToEye(f, point);
  const Wide reach = oneNorm(relative);
  return verdictOf(f, [&](const FrustumPlane& p) {
    const Wide d = distance(p, relative);
    return Extent{d, d, reach};
  });
}

Cull cull(const Frustum& f, const Sphere& sphere) noexcept {
  if (!isValid(sphere)) return {};
  const WideVec3 center = relativeToEye(f, sphere.center);
  const Wide radius = sphere.radius;
  const Wide reach = oneNorm(center) + radius;
  return verdictOf(f, [&](const FrustumPlane& p) {
    const Wide d = distance(p, center);
    return Extent{d + radius, d - radius, reach};
  });
}

Cull cull(const Frustum& f, const Box& box) noexcept {
  if (!isValid(box)) return {};
  const WideVec3 min = relativeToEye(f, box.min), max = relativeToEye(f, box.max);
  const Wide reach = oneNorm(min) + oneNorm(max);
  return verdictOf(f, [&](const FrustumPlane& p) {
    WideVec3 pVertex, nVertex;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool outwards = p.normal[i].sign() < 0;
      pVertex[i] = outwards ? min[i] : max[i];
      nVertex[i] = outwards ? max[i] : min[i];
    }
    return Extent{distance(p, pVertex), distance(p, nVertex), reach};
  });
}

Cull cull(const Frustum& f, const Triangle& triangle) noexcept {
  if (!isValid(triangle)) return {};
  const WideVec3 corners[] = {relativeToEye(f, triangle.a), relativeToEye(f, triangle.b), relativeToEye(f, triangle.c)};
  Wide reach;
  for (const WideVec3& corner : corners)
    if (isLess(reach, oneNorm(corner))) reach = oneNorm(corner);
  return verdictOf(f, [&](const FrustumPlane& p) {
    Extent e{distance(p, corners[0]), distance(p, corners[0]), reach};
    for (const WideVec3& corner : corners) {
      const Wide d = distance(p, corner);
      if (isLess(e.inmost, d)) e.inmost = d;
      if (isLess(d, e.outmost)) e.outmost = d;
    }
    return e;
  });
}

Wide distanceInside(const Frustum& f, const FrustumPlane& p, const Vec3& point) noexcept {
  const WideVec3 v = relativeToEye(f, point);
  const Wide d = distance(p, v);
  return isLess(Wide(p.normalBound) * oneNorm(v) + Wide(p.offsetBound), magnitude(d)) ? d : Wide();
}

}  // namespace viewproj
