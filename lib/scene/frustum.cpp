#include <algorithm>
#include <array>
#include <cmath>

#include "scene/frustum_parts.hpp"

namespace viewproj {

using namespace detail;
namespace {

bool isDepth(Side side) noexcept { return side == sideNear || side == sideFar; }
bool isUpright(Side side) noexcept { return side == sideLeft || side == sideRight; }
bool isTilted(const CameraParts& c, Side side) noexcept { return !isDepth(side) && !c.projection.orthographic; }

/// Adds the plane of an edge of the window, or of near or far. sign: +1 if what is inside is above the edge.
void add(FrustumParts& f, Side side, DoubleDouble edge, double sign) noexcept {
  const CameraParts& c = parts(f.camera);
  const Axes& rows = c.pose.rows;
  const DDVec3& residuals = c.pose.residual;
  const DDVec3& axis = isDepth(side) ? rows.forward : isUpright(side) ? rows.right : rows.up;
  const DoubleDouble residual = isDepth(side) ? residuals.z : isUpright(side) ? residuals.x : residuals.y;
  WideVec3 normal = toWide(axis);
  Wide offset = Wide(residual) - Wide(edge);
  if (isTilted(c, side)) {
    normal = normal - toWide(rows.forward) * edge;
    offset = Wide(residual) - Wide(edge) * Wide(residuals.z);
  }
  const Wide scale = Wide(sign) / lengthOf(normal);
  normal = normal * scale;
  offset = offset * scale;
  const Vec3 n = rounded(normal);
  f.planes[f.count] = {side, edge, scale, n, double(offset)};
  f.rounded[f.count++] = {side, {n.x, n.y, n.z, double(offset - dot(normal, toWide(c.pose.eye)))}};
}

// ---- Distances to a plane, in double and in numbers of the exact rows

bool isLess(double a, double b) noexcept { return a < b; }
double magnitude(double a) noexcept { return std::fabs(a); }
using detail::isLess;
using detail::magnitude;

/// A signed distance to a plane, positive inside, and its error bound.
template <class Number>
struct Measured {
  Number distance, bound;

  bool isCertain() const noexcept { return isLess(bound, magnitude(distance)); }
};

/// Nine roundings, and 2^-90 for what the rounded plane loses where it cancels.
Measured<double> quickDistance(const FrustumParts& f, const ExactPlane& p, const Vec3& point) noexcept {
  const Vec3& eye = parts(f.camera).pose.eye;
  const double x = point.x - eye.x, y = point.y - eye.y, z = point.z - eye.z;
  const double size = std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(p.offset);
  return {p.normal.x * x + p.normal.y * y + p.normal.z * z + p.offset, 0x1p-49 * size + 0x1p-1000};
}

Measured<Wide> exactDistance(const FrustumParts& f, const ExactPlane& p, const AxisDistances& point) noexcept {
  const Wide& along = isDepth(p.side) ? point.forward : isUpright(p.side) ? point.right : point.up;
  const Wide edge = isTilted(parts(f.camera), p.side) ? p.edge * point.forward : p.edge;
  const Wide size = magnitude(along) + magnitude(edge);
  return {(along - edge) * p.scale, size * Wide(kCullBound) * magnitude(p.scale)};
}

// ---- Verdicts

/// What a shape is to one plane. beyond: of a shape outside the distance of its nearest point, else of its farthest.
struct OnPlane {
  CullVerdict verdict;
  double beyond;
};

/// From the distances of the points that lie farthest inside and farthest outside of the plane. share: the part of the
/// radius to add to the bounds. Sets isCertain to false if a point's side of the plane is not known.
template <class Number, class Measure>
OnPlane onPlane(std::size_t count, double radius, double share, const Measure& measure, bool& isCertain) noexcept {
  Measured<Number> inmost{}, outmost{};
  for (std::size_t i = 0; i < count; ++i) {
    const Measured<Number> at = measure(i);
    const Number bound = at.bound + Number(radius) * Number(share);
    const Measured<Number> in{at.distance + Number(radius), bound}, out{at.distance - Number(radius), bound};
    isCertain = isCertain && in.isCertain() && out.isCertain();
    if (i == 0 || isLess(inmost.distance + inmost.bound, in.distance + bound)) inmost = in;
    if (i == 0 || isLess(out.distance + bound, outmost.distance + outmost.bound)) outmost = out;
  }
  if (isLess(inmost.distance + inmost.bound, 0)) return {CullVerdict::outside, double(inmost.distance)};
  if (isLess(outmost.distance + outmost.bound, 0)) return {CullVerdict::intersects, double(outmost.distance)};
  return {CullVerdict::inside, 0};
}

/// Of a shape with these corners, or a sphere around one. chosen(plane): the indices of the `count` corners that decide
/// about a plane.
template <std::size_t kCorners, class Chosen>
Cull verdictOf(const FrustumParts& f, const std::array<Vec3, kCorners>& corners, std::size_t count, double radius,
               const Chosen& chosen) noexcept {
  std::array<AxisDistances, kCorners> exact;
  std::array<bool, kCorners> isKnown{};
  Cull result{CullVerdict::inside, 0};
  double farthest = 0;
  for (const ExactPlane& p : f) {
    const std::array<std::size_t, kCorners> index = chosen(p);
    bool isCertain = true;
    OnPlane on = onPlane<double>(
        count, radius, 0x1p-49, [&](std::size_t i) { return quickDistance(f, p, corners[index[i]]); }, isCertain);
    if (!isCertain)
      on = onPlane<Wide>(
          count, radius, kCullBound,
          [&](std::size_t i) {
            const std::size_t corner = index[i];
            const Vec3& v = corners[corner];
            if (!isKnown[corner]) exact[corner] = exactDistances(parts(f.camera).pose, {v.x, v.y, v.z, 1});
            isKnown[corner] = true;
            return exactDistance(f, p, exact[corner]);
          },
          isCertain);
    if (on.verdict < result.verdict || (on.verdict == result.verdict && !(on.beyond < farthest))) continue;
    result = {on.verdict, p.side};
    farthest = on.beyond;
  }
  return result;
}

}  // namespace

Frustum viewFrustum(const Camera& camera) {
  if (parts(camera).lens)
    throw CameraError("distortion", "bends straight edges: planes, shapes and segments need a camera without it");
  const ProjectionParts& p = parts(camera).projection;
  FrustumParts made{camera};
  add(made, sideLeft, p.left, 1);
  add(made, sideRight, p.right, -1);
  add(made, sideBottom, p.bottom, 1);
  add(made, sideTop, p.top, -1);
  if (hasDepth(p)) add(made, sideNear, p.near, 1);
  if (std::isfinite(p.far)) add(made, sideFar, p.far, -1);
  return Access::whole<Frustum>(share(made));
}

const Camera& Frustum::camera() const noexcept { return parts_->camera; }
std::span<const FrustumPlane> Frustum::planes() const noexcept { return {parts_->rounded.data(), parts_->count}; }

Cull cull(const Frustum& frustum, const Vec3& point) noexcept { return cull(frustum, Sphere{point, 0}); }

Cull cull(const Frustum& frustum, const Sphere& sphere) noexcept {
  if (!isValid(sphere)) return {};
  return verdictOf<1>(parts(frustum), {sphere.center}, 1, sphere.radius,
                      [](const ExactPlane&) { return std::array<std::size_t, 1>{}; });
}

Cull cull(const Frustum& frustum, const Box& box) noexcept {
  if (!isValid(box)) return {};
  return verdictOf(parts(frustum), cornersOf(box), 2, 0, [](const ExactPlane& p) {
    const std::size_t inmost = (p.normal.x < 0 ? 0u : 1u) | (p.normal.y < 0 ? 0u : 2u) | (p.normal.z < 0 ? 0u : 4u);
    return std::array<std::size_t, 8>{inmost, 7 - inmost};
  });
}

Cull cull(const Frustum& frustum, const Triangle& t) noexcept {
  if (!isValid(t)) return {};
  return verdictOf<3>(parts(frustum), {t.a, t.b, t.c}, 3, 0, [](const ExactPlane&) {
    return std::array<std::size_t, 3>{0, 1, 2};
  });
}

Wide detail::distanceInside(const FrustumParts& f, const ExactPlane& p, const AxisDistances& point) noexcept {
  const Measured<Wide> at = exactDistance(f, p, point);
  return at.isCertain() ? at.distance : Wide();
}

}  // namespace viewproj
