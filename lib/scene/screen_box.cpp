#include <array>
#include <cstddef>
#include <optional>

#include "projection/exact_point.hpp"
#include "scene/frustum_parts.hpp"
#include "scene/view_space.hpp"

namespace viewproj {

using namespace detail;
namespace {

/// Of what was added, the least and the most.
struct Range {
  Wide least, most;
  bool empty = true;

  void add(const Wide& value) noexcept {
    if (empty || isLess(value, least)) least = value;
    if (empty || isLess(most, value)) most = value;
    empty = false;
  }
};

struct WindowRange {
  Range x, y;
};

ScreenBox onScreen(const CameraParts& c, const WindowRange& window) noexcept {
  const ScreenMap& m = c.screen;
  return {screenX(m, window.x.least), screenY(m, window.y.most), screenX(m, window.x.most), screenY(m, window.y.least)};
}

bool hasNear(const FrustumParts& f) noexcept { return hasDepth(parts(f.camera).projection); }
const ExactPlane& nearPlane(const FrustumParts& f) noexcept { return f.planes[4]; }

/// With all digits of what is left where a point is much farther aside than away.
ViewPoint preciseView(const CameraParts& c, const Vec3& point) noexcept {
  constexpr double kAside = 0x1p-40;
  const WideVec3 d = fromEye(c.pose, point);
  const ViewPoint p = toView(c.pose, d);
  const Wide size = oneNorm(d);
  if (isLess(size * Wide(kAside), magnitude(p.forward) + magnitude(Wide(c.projection.near)))) return p;
  const AxisDistances e = exactDistances(c.pose, {point.x, point.y, point.z, 1});
  return {e.right, e.up, e.forward};
}

/// What of a convex body lies in front of near: its corners there, and where its edges cross.
template <std::size_t Count>
std::optional<ScreenBox> boxOfCorners(const FrustumParts& f, const std::array<Vec3, Count>& corners,
                                      bool (*isEdge)(std::size_t, std::size_t)) noexcept {
  if (!hasNear(f)) return std::nullopt;
  const CameraParts& c = parts(f.camera);
  std::array<ViewPoint, Count> points;
  std::array<Wide, Count> inFront;
  WindowRange window;
  const auto add = [&](const ViewPoint& p) {
    const WindowXY at = onWindow(c, p);
    window.x.add(at.x);
    window.y.add(at.y);
  };
  for (std::size_t i = 0; i < Count; ++i) {
    points[i] = preciseView(c, corners[i]);
    inFront[i] = distanceInside(f, nearPlane(f), corners[i]);
    if (inFront[i].sign() == 0) points[i].forward = Wide(c.projection.near);  // within the bound, whichever side
    if (inFront[i].sign() >= 0) add(points[i]);
  }
  for (std::size_t i = 0; i < Count; ++i)
    for (std::size_t j = 0; j < Count; ++j) {
      if (inFront[i].sign() <= 0 || inFront[j].sign() >= 0 || !isEdge(i, j)) continue;
      const Wide size = inFront[i] - inFront[j], t = inFront[i] / size, rest = -inFront[j] / size;
      const auto between = [&](const Wide& from, const Wide& to) { return from * rest + to * t; };
      add({between(points[i].right, points[j].right), between(points[i].up, points[j].up), Wide(c.projection.near)});
    }
  if (window.x.empty) return std::nullopt;
  return onScreen(c, window);
}

/// Of a sphere, seen along a row of the camera in the plane of that row and forward: a disc.
///   along = part x + skew w, W = stretch w in axes x, w of unit length
struct Disc {
  Wide x, w, radius;
  Wide part, skew, stretch;
  Wide near;  ///< as w
};

Range rangeOf(const Disc& d, bool orthographic) noexcept {
  Range range;
  const auto add = [&](const Wide& x, const Wide& w) {
    if (orthographic)
      range.add(d.part * x + d.skew * w);
    else
      range.add((d.part * (x / w) + d.skew) / d.stretch);
  };
  // r^2 - (near - w)^2, of what remains where r and w are large and alike.
  const Wide half = ((d.radius - d.w) + d.near) * ((d.radius + d.w) - d.near);
  const bool isCut = isLess(d.w - d.radius, d.near);
  if (isCut && half.sign() >= 0) {
    const Wide chord = half.sign() == 0 ? Wide() : sqrt(half);
    add(d.x - chord, d.near);
    add(d.x + chord, d.near);
  }
  const auto addInFront = [&](const Wide& x, const Wide& w) {
    if (!isCut || !isLess(w, d.near)) add(x, w);
  };
  if (orthographic) {
    // Where the disc reaches farthest along (part, skew).
    const Wide length = sqrt(d.part * d.part + d.skew * d.skew);
    const Wide toX = d.radius * (d.part / length), toW = d.radius * (d.skew / length);
    addInFront(d.x + toX, d.w + toW);
    addInFront(d.x - toX, d.w - toW);
    if (range.empty) add(d.x, d.near);  // near touches it
    return range;
  }
  // Where lines through the eye touch it. The eye may lie within.
  const Wide squared = d.x * d.x + d.w * d.w, length2 = d.x * d.x + (d.w - d.radius) * (d.w + d.radius);
  if (length2.sign() <= 0) return range;  // then near cuts it
  const Wide length = sqrt(length2), share = length / squared;
  for (const Wide& r : {d.radius, -d.radius})
    addInFront((d.x * length + d.w * r) * share, (d.w * length - d.x * r) * share);
  if (range.empty) add(d.x, d.near);  // near touches it
  return range;
}

Disc discOf(const CameraParts& c, const DDVec3& row, const Wide& along, const Wide& forward, double radius) noexcept {
  const WideVec3 r = toWide(row), f = toWide(c.pose.rows.forward);
  const Wide stretch = lengthOf(f), skew = dot(r, f) / stretch;
  const Wide part = lengthOf(r - f * (skew / stretch)), w = forward / stretch;
  return {(along - skew * w) / part, w, radius, part, skew, stretch, Wide(c.projection.near) / stretch};
}

}  // namespace

std::optional<ScreenBox> screenBox(const Frustum& frustum, const Sphere& sphere) noexcept {
  const FrustumParts& f = parts(frustum);
  if (!isValid(sphere) || !hasNear(f)) return std::nullopt;
  if ((distanceInside(f, nearPlane(f), sphere.center) + Wide(sphere.radius)).sign() < 0) return std::nullopt;
  const CameraParts& c = parts(f.camera);
  const ViewPoint p = preciseView(c, sphere.center);
  const WindowRange window{
      rangeOf(discOf(c, c.pose.rows.right, p.right, p.forward, sphere.radius), c.projection.orthographic),
      rangeOf(discOf(c, c.pose.rows.up, p.up, p.forward, sphere.radius), c.projection.orthographic)};
  return onScreen(c, window);
}

std::optional<ScreenBox> screenBox(const Frustum& frustum, const Box& box) noexcept {
  if (!isValid(box)) return std::nullopt;
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
  return boxOfCorners(parts(frustum), corners, [](std::size_t i, std::size_t j) {
    const std::size_t differ = i ^ j;
    return (differ & (differ - 1)) == 0;
  });
}

std::optional<ScreenBox> screenBox(const Frustum& frustum, const Triangle& triangle) noexcept {
  if (!isValid(triangle)) return std::nullopt;
  return boxOfCorners<3>(parts(frustum), {triangle.a, triangle.b, triangle.c},
                         [](std::size_t, std::size_t) { return true; });
}

}  // namespace viewproj
