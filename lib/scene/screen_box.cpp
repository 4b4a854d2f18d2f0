// The rectangle of a shape on the screen, from the distances of its points along the camera's axes.
#include <array>
#include <optional>
#include <span>

#include "scene/frustum_parts.hpp"

namespace viewproj {

using namespace detail;
namespace {

AxisDistances distancesOf(const CameraParts& c, const Vec3& p) noexcept {
  return exactDistances(c.pose, {p.x, p.y, p.z, 1});
}

/// The smallest and the largest of the added values.
struct Range {
  Wide least, most;
  bool empty = true;

  void add(const Wide& value) noexcept {
    if (empty || isLess(value, least)) least = value;
    if (empty || isLess(most, value)) most = value;
    empty = false;
  }
};

/// The distance in front of near; 0 if it is within the error.
Wide beyondNear(const CameraParts& c, const Wide& forward) noexcept {
  const Wide near = c.projection.near, distance = forward - near;
  const Wide error = (magnitude(forward) + magnitude(near)) * Wide(0x1p-90);
  return isLess(error, magnitude(distance)) ? distance : Wide();
}

/// The box of ranges on the window at unit distance, or in orthographic in space.
ScreenBox onScreen(const ScreenMap& map, const Range& x, const Range& y) noexcept {
  const auto at = [](DoubleDouble center, DoubleDouble scale, const Wide& along) {
    return double(sumOrZero(Wide(center), Wide(scale) * along));
  };
  return {at(map.centerX, map.scaleX, x.least), at(map.centerY, map.scaleY, y.most),
          at(map.centerX, map.scaleX, x.most), at(map.centerY, map.scaleY, y.least)};
}

/// The box of the part of a convex body in front of near: its corners there, and its edges' crossings with near.
/// Without near the whole body must be in front of the eye.
template <std::size_t kCorners, class IsEdge>
std::optional<ScreenBox> boxOfCorners(const CameraParts& c, const std::array<Vec3, kCorners>& corners,
                                      const IsEdge& isEdge) noexcept {
  const bool orthographic = c.projection.orthographic;
  const Wide near = c.projection.near;
  Range x, y;
  const auto add = [&](const AxisDistances& p) {
    x.add(orthographic ? p.right : p.right / p.forward);
    y.add(orthographic ? p.up : p.up / p.forward);
  };
  std::array<AxisDistances, kCorners> points;
  std::array<Wide, kCorners> inFront;
  for (std::size_t i = 0; i < kCorners; ++i) {
    points[i] = distancesOf(c, corners[i]);
    inFront[i] = beyondNear(c, points[i].forward);
    if (inFront[i].sign() <= 0 && !hasDepth(c.projection)) return std::nullopt;
    if (inFront[i].sign() == 0) points[i].forward = near;
    if (inFront[i].sign() >= 0) add(points[i]);
  }
  for (std::size_t i = 0; i < kCorners; ++i)
    for (std::size_t j = 0; j < kCorners; ++j) {
      if (inFront[i].sign() <= 0 || inFront[j].sign() >= 0 || !isEdge(i ^ j)) continue;
      const Wide size = inFront[i] - inFront[j], t = inFront[i] / size, rest = -inFront[j] / size;
      const auto between = [&](const Wide& from, const Wide& to) { return from * rest + to * t; };
      add({between(points[i].right, points[j].right), between(points[i].up, points[j].up), near});
    }
  if (x.empty) return std::nullopt;
  return onScreen(c.screen, x, y);
}

/// The disc of a sphere in the plane of a camera's row and forward:
///   along = part x + skew w, W = stretch w in axes x, w of unit length
struct Disc {
  Wide x, w, radius;
  Wide part, skew, stretch;
  Wide near;  ///< in units of w
};

Range rangeOf(const Disc& d, bool orthographic) noexcept {
  Range range;
  const auto add = [&](const Wide& x, const Wide& w) {
    if (orthographic)
      range.add(d.part * x + d.skew * w);
    else
      range.add((d.part * (x / w) + d.skew) / d.stretch);
  };
  // r^2 - (near - w)^2, computed so that it keeps its digits when r and w are large and similar.
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
  } else {
    // Where lines through the eye touch the disc. If the eye is inside, near cuts the disc.
    const Wide squared = d.x * d.x + d.w * d.w, length2 = d.x * d.x + (d.w - d.radius) * (d.w + d.radius);
    if (length2.sign() <= 0) return range;
    const Wide length = sqrt(length2), share = length / squared;
    for (const Wide& r : {d.radius, -d.radius})
      addInFront((d.x * length + d.w * r) * share, (d.w * length - d.x * r) * share);
  }
  if (range.empty) add(d.x, d.near);  // the disc touches near
  return range;
}

}  // namespace

std::optional<ScreenBox> screenBox(const Camera& camera, const Sphere& sphere) noexcept {
  const CameraParts& c = parts(camera);
  if (!isValid(sphere)) return std::nullopt;
  const AxisDistances p = distancesOf(c, sphere.center);
  const Axes& rows = c.pose.rows;
  const WideVec3 forward = toWide(rows.forward);
  const Wide stretch = lengthOf(forward), near = Wide(c.projection.near) / stretch;
  const Wide inFront = beyondNear(c, p.forward) / stretch, radius = sphere.radius;
  if ((inFront + radius).sign() < 0 || !(hasDepth(c.projection) || isLess(radius, inFront))) return std::nullopt;
  const auto rangeAlong = [&](const DDVec3& axis, const Wide& along) {
    const WideVec3 row = toWide(axis);
    const Wide skew = dot(row, forward) / stretch, w = p.forward / stretch;
    const Wide part = lengthOf(row - forward * (skew / stretch));
    return rangeOf({(along - skew * w) / part, w, sphere.radius, part, skew, stretch, near}, c.projection.orthographic);
  };
  return onScreen(c.screen, rangeAlong(rows.right, p.right), rangeAlong(rows.up, p.up));
}

std::optional<ScreenBox> screenBox(const Camera& camera, const Box& box) noexcept {
  if (!isValid(box)) return std::nullopt;
  return boxOfCorners(parts(camera), cornersOf(box), [](std::size_t differ) { return (differ & (differ - 1)) == 0; });
}

std::optional<ScreenBox> screenBox(const Camera& camera, const Triangle& t) noexcept {
  if (!isValid(t)) return std::nullopt;
  return boxOfCorners(parts(camera), std::array{t.a, t.b, t.c}, [](std::size_t) { return true; });
}

}  // namespace viewproj
