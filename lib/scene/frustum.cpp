#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "projection/exact_point.hpp"
#include "scene/frustum_parts.hpp"
#include "scene/view_space.hpp"

namespace viewproj {

using namespace detail;
namespace {

/// sign (normal . (p - eye) + offset) >= 0, not yet of unit length. reach is the larger of the plane's window edge and
/// the one across from it; parts is the size of what the offset is a sum of.
ExactPlane plane(const CameraParts& c, Side side, const WideVec3& normal, const Wide& offset, const Wide& edge,
                 double sign, double reach, double parts) noexcept {
  const Wide scale = Wide(sign) / lengthOf(normal);
  ExactPlane p;
  p.side = side;
  p.normal = normal * scale;
  p.offset = offset * scale;
  p.edge = edge;
  p.scale = scale;
  const double perLength = double(magnitude(scale));
  p.normalBound = kPlaneBound * (1 + reach) * perLength;
  p.offsetBound = p.normalBound * (parts * perLength);
  const Vec3 n = rounded(p.normal);
  p.equation = {n.x, n.y, n.z, double(p.offset - dot(p.normal, toWide(c.pose.eye)))};
  return p;
}

/// Of an edge of the window: sign (X - edge W) >= 0, or sign (X - edge) >= 0 in orthographic. X is axis . (p - eye) +
/// residual.
ExactPlane windowPlane(const CameraParts& c, Side side, const DDVec3& axis, DoubleDouble residual, DoubleDouble edge,
                       DoubleDouble across, double sign) noexcept {
  const double reach = std::max(std::fabs(edge.hi), std::fabs(across.hi));
  const Wide wideEdge(edge, 0);
  if (c.projection.orthographic)
    return plane(c, side, toWide(axis), Wide(residual, 0) - wideEdge, wideEdge, sign, 0,
                 std::fabs(residual.hi) + reach);
  const DoubleDouble depthResidual = c.pose.residual.z;
  return plane(c, side, toWide(axis) - toWide(c.pose.rows.forward) * wideEdge,
               Wide(residual, 0) - wideEdge * Wide(depthResidual, 0), wideEdge, sign, reach,
               std::fabs(residual.hi) + reach * std::fabs(depthResidual.hi));
}

/// Across the view: sign (W - distance) >= 0.
ExactPlane depthPlane(const CameraParts& c, Side side, double distance, double sign) noexcept {
  const DoubleDouble residual = c.pose.residual.z;
  return plane(c, side, toWide(c.pose.rows.forward), Wide(residual, 0) - Wide(distance), distance, sign, 0,
               std::fabs(residual.hi) + std::fabs(distance));
}

const PoseParts& poseOf(const FrustumParts& f) noexcept { return parts(f.camera).pose; }

Wide distance(const ExactPlane& p, const WideVec3& v) noexcept { return dot(p.normal, v) + p.offset; }

/// A distance inside, and how far from the true one it may be.
struct Measured {
  Wide distance, bound;

  bool isCertain() const noexcept { return isLess(bound, magnitude(distance)); }
};

/// From the exact rows, in microseconds.
Measured exactDistance(const FrustumParts& f, const ExactPlane& p, const Vec3& point) noexcept {
  const CameraParts& c = parts(f.camera);
  const AxisDistances e = exactDistances(c.pose, {point.x, point.y, point.z, 1});
  const bool ofDepth = (p.side & (sideNear | sideFar)) != 0;
  const Wide& along = ofDepth ? e.forward : (p.side & (sideLeft | sideRight)) != 0 ? e.right : e.up;
  const bool isTilted = !ofDepth && !c.projection.orthographic;
  const Wide edge = isTilted ? p.edge * e.forward : p.edge;
  const Wide size = (magnitude(along) + magnitude(edge)) * Wide(kCullBound);
  const Wide ofRows = isTilted ? e.error * (Wide(1) + magnitude(p.edge)) : e.error;
  return {(along - edge) * p.scale, (size + ofRows) * magnitude(p.scale)};
}

/// The distances of a shape's point farthest inside a plane and of the one farthest beyond it. reach: the larger
/// |p - eye|_1 that went into them.
struct Extent {
  Wide inmost, outmost;
  Wide reach;
};

/// Those of its points that decide, and how much farther a sphere reaches.
struct Deciding {
  std::array<Vec3, 3> points;
  std::size_t count = 1;
  Wide radius = {};
};

struct Ends {
  Measured inmost, outmost;
};

Ends exactEnds(const FrustumParts& f, const ExactPlane& p, const Deciding& e) noexcept {
  Ends ends{exactDistance(f, p, e.points[0]), {}};
  ends.outmost = ends.inmost;
  for (std::size_t i = 1; i < e.count; ++i) {
    const Measured d = exactDistance(f, p, e.points[i]);
    if (isLess(ends.inmost.distance, d.distance)) ends.inmost = d;
    if (isLess(d.distance, ends.outmost.distance)) ends.outmost = d;
  }
  ends.inmost.distance = ends.inmost.distance + e.radius;
  ends.outmost.distance = ends.outmost.distance - e.radius;
  for (Measured* end : {&ends.inmost, &ends.outmost}) end->bound = end->bound + e.radius * Wide(kCullBound);
  return ends;
}

template <class ExtentOf, class DecidingOn>
Cull verdictOf(const FrustumParts& f, const ExtentOf& extentOf, const DecidingOn& decidingOn) noexcept {
  Cull result{CullVerdict::inside, 0};
  Wide farthest;
  for (const ExactPlane& p : f) {
    const Extent e = extentOf(p);
    const Wide bound = Wide(p.normalBound) * e.reach + Wide(p.offsetBound);
    Ends ends{{e.inmost, bound}, {e.outmost, bound}};
    if (!ends.inmost.isCertain() || !ends.outmost.isCertain()) ends = exactEnds(f, p, decidingOn(p));
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
  const CameraParts& c = parts(camera);
  if (c.lens)
    throw CameraError("distortion", "bends straight edges: planes, shapes and segments need a camera without it");
  const ProjectionParts& p = c.projection;
  const PoseParts& pose = c.pose;
  const auto made = std::make_shared<FrustumParts>(FrustumParts{camera});
  FrustumParts& f = *made;
  f.planes = {windowPlane(c, sideLeft, pose.rows.right, pose.residual.x, p.left, p.right, 1),
              windowPlane(c, sideRight, pose.rows.right, pose.residual.x, p.right, p.left, -1),
              windowPlane(c, sideBottom, pose.rows.up, pose.residual.y, p.bottom, p.top, 1),
              windowPlane(c, sideTop, pose.rows.up, pose.residual.y, p.top, p.bottom, -1)};
  f.count = 4;
  if (hasDepth(p)) f.planes[f.count++] = depthPlane(c, sideNear, p.near, 1);
  if (std::isfinite(p.far)) f.planes[f.count++] = depthPlane(c, sideFar, p.far, -1);
  for (std::size_t i = 0; i < f.count; ++i) f.rounded[i] = {f.planes[i].side, f.planes[i].equation};
  return Access::whole<Frustum, FrustumParts>(made);
}

const Camera& Frustum::camera() const noexcept { return parts_->camera; }
std::span<const FrustumPlane> Frustum::planes() const noexcept { return {parts_->rounded.data(), parts_->count}; }

Cull cull(const Frustum& frustum, const Vec3& point) noexcept {
  if (!isInRange(point)) return {};
  const WideVec3 relative = fromEye(poseOf(parts(frustum)), point);
  const Wide reach = oneNorm(relative);
  return verdictOf(
      parts(frustum),
      [&](const ExactPlane& p) {
        const Wide d = distance(p, relative);
        return Extent{d, d, reach};
      },
      [&](const ExactPlane&) { return Deciding{{point}}; });
}

Cull cull(const Frustum& frustum, const Sphere& sphere) noexcept {
  if (!isValid(sphere)) return {};
  const WideVec3 center = fromEye(poseOf(parts(frustum)), sphere.center);
  const Wide radius = sphere.radius;
  const Wide reach = oneNorm(center) + radius;
  return verdictOf(
      parts(frustum),
      [&](const ExactPlane& p) {
        const Wide d = distance(p, center);
        return Extent{d + radius, d - radius, reach};
      },
      [&](const ExactPlane&) {
        return Deciding{{sphere.center}, 1, radius};
      });
}

Cull cull(const Frustum& frustum, const Box& box) noexcept {
  if (!isValid(box)) return {};
  const WideVec3 min = fromEye(poseOf(parts(frustum)), box.min), max = fromEye(poseOf(parts(frustum)), box.max);
  const Wide reach = oneNorm(min) + oneNorm(max);
  return verdictOf(
      parts(frustum),
      [&](const ExactPlane& p) {
        WideVec3 pVertex, nVertex;
        for (std::size_t i = 0; i < 3; ++i) {
          const bool outwards = p.normal[i].sign() < 0;
          pVertex[i] = outwards ? min[i] : max[i];
          nVertex[i] = outwards ? max[i] : min[i];
        }
        return Extent{distance(p, pVertex), distance(p, nVertex), reach};
      },
      [&](const ExactPlane& p) {
        Deciding corners{{box.max, box.min}, 2};
        for (std::size_t i = 0; i < 3; ++i)
          if (p.normal[i].sign() < 0) std::swap(corners.points[0][i], corners.points[1][i]);
        return corners;
      });
}

Cull cull(const Frustum& frustum, const Triangle& triangle) noexcept {
  if (!isValid(triangle)) return {};
  const WideVec3 corners[] = {fromEye(poseOf(parts(frustum)), triangle.a), fromEye(poseOf(parts(frustum)), triangle.b),
                              fromEye(poseOf(parts(frustum)), triangle.c)};
  Wide reach;
  for (const WideVec3& corner : corners)
    if (isLess(reach, oneNorm(corner))) reach = oneNorm(corner);
  return verdictOf(
      parts(frustum),
      [&](const ExactPlane& p) {
        Extent e{distance(p, corners[0]), distance(p, corners[0]), reach};
        for (const WideVec3& corner : corners) {
          const Wide d = distance(p, corner);
          if (isLess(e.inmost, d)) e.inmost = d;
          if (isLess(d, e.outmost)) e.outmost = d;
        }
        return e;
      },
      [&](const ExactPlane&) {
        return Deciding{{triangle.a, triangle.b, triangle.c}, 3};
      });
}

Wide detail::distanceInside(const FrustumParts& f, const ExactPlane& p, const Vec3& point) noexcept {
  const WideVec3 v = fromEye(poseOf(f), point);
  Measured d{distance(p, v), Wide(p.normalBound) * oneNorm(v) + Wide(p.offsetBound)};
  if (!d.isCertain()) d = exactDistance(f, p, point);
  return d.isCertain() ? d.distance : Wide();
}

}  // namespace viewproj
