#include "records/screen_box.hpp"

#include <span>
#include <vector>

#include "camera/read_camera.hpp"
#include "numbers/wide.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// The smallest and the largest of the added values.
struct Range {
  Wide least, most;
  bool empty = true;

  void add(const Wide& value) {
    if (empty || isLess(value, least)) least = value;
    if (empty || isLess(most, value)) most = value;
    empty = false;
  }
};

/// Distances along right, up and forward.
struct ViewPoint {
  Wide right, up, forward;
};

ViewPoint viewOf(const Camera& camera, const Vec4& point) {
  const DDVec3 d = joined(alongAxes(camera, point));
  return {d.x, d.y, d.z};
}

ViewPoint viewOf(const Camera& camera, const Vec3& p) { return viewOf(camera, {p.x, p.y, p.z, 1}); }

/// The distance in front of near; 0 if it is within the error.
Wide beyondNear(const Camera& camera, const Wide& forward) {
  const Wide near = camera.projection().zNear(), distance = forward - near;
  const Wide error = (magnitude(forward) + magnitude(near)) * Wide(0x1p-90);
  return isLess(error, magnitude(distance)) ? distance : Wide();
}

/// The box of ranges on the window at unit distance, or in orthographic in space.
ScreenBox onScreen(const Camera& camera, const Range& x, const Range& y) {
  const auto at = [&](const Wide& right, const Wide& up) {
    return screenAt(camera, split(DDVec3{toDoubleDouble(right), toDoubleDouble(up), 1}));
  };
  const Vec2 first = at(x.least, y.most), last = at(x.most, y.least);
  return {first.x, first.y, last.x, last.y};
}

/// The box of the part of a convex body in front of near: its corners there, and its edges' crossings with near.
std::optional<ScreenBox> boxOfCorners(const Camera& camera, std::span<const Vec3> corners,
                                      bool (*isEdge)(std::size_t, std::size_t)) {
  if (!hasDepth(camera.projection())) return std::nullopt;
  const bool orthographic = camera.projection().isOrthographic();
  const Wide near = camera.projection().zNear();
  Range x, y;
  const auto add = [&](const ViewPoint& p) {
    x.add(orthographic ? p.right : p.right / p.forward);
    y.add(orthographic ? p.up : p.up / p.forward);
  };
  std::vector<ViewPoint> points;
  std::vector<Wide> inFront;
  for (const Vec3& corner : corners) {
    points.push_back(viewOf(camera, corner));
    inFront.push_back(beyondNear(camera, points.back().forward));
    if (inFront.back().sign() == 0) points.back().forward = near;
    if (inFront.back().sign() >= 0) add(points.back());
  }
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < corners.size(); ++j) {
      if (inFront[i].sign() <= 0 || inFront[j].sign() >= 0 || !isEdge(i, j)) continue;
      const Wide size = inFront[i] - inFront[j], t = inFront[i] / size, rest = -inFront[j] / size;
      const auto between = [&](const Wide& from, const Wide& to) { return from * rest + to * t; };
      add({between(points[i].right, points[j].right), between(points[i].up, points[j].up), near});
    }
  if (x.empty) return std::nullopt;
  return onScreen(camera, x, y);
}

/// The disc of a sphere in the plane of a camera's row and forward:
///   along = part x + skew w, W = stretch w in axes x, w of unit length
struct Disc {
  Wide x, w, radius;
  Wide part, skew, stretch;
  Wide near;  ///< in units of w
};

Range rangeOf(const Disc& d, bool orthographic) {
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

std::optional<ScreenBox> screenBox(const Camera& camera, const Sphere& sphere) {
  if (!isValid(sphere) || !hasDepth(camera.projection())) return std::nullopt;
  const bool orthographic = camera.projection().isOrthographic();
  const ViewPoint p = viewOf(camera, sphere.center);
  // The camera's rows, from the world's axes along them.
  const ViewPoint x = viewOf(camera, {1, 0, 0, 0}), y = viewOf(camera, {0, 1, 0, 0}), z = viewOf(camera, {0, 0, 1, 0});
  const WideVec3 forward{x.forward, y.forward, z.forward};
  const Wide stretch = lengthOf(forward), near = Wide(camera.projection().zNear()) / stretch;
  if ((beyondNear(camera, p.forward) / stretch + Wide(sphere.radius)).sign() < 0) return std::nullopt;
  const auto disc = [&](const WideVec3& row, const Wide& along) {
    const Wide skew = dot(row, forward) / stretch, w = p.forward / stretch;
    const Wide part = lengthOf(row - forward * (skew / stretch));
    return Disc{(along - skew * w) / part, w, sphere.radius, part, skew, stretch, near};
  };
  return onScreen(camera, rangeOf(disc({x.right, y.right, z.right}, p.right), orthographic),
                  rangeOf(disc({x.up, y.up, z.up}, p.up), orthographic));
}

std::optional<ScreenBox> screenBox(const Camera& camera, const Box& box) {
  if (!isValid(box)) return std::nullopt;
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
  return boxOfCorners(camera, corners, [](std::size_t i, std::size_t j) {
    const std::size_t differ = i ^ j;
    return (differ & (differ - 1)) == 0;
  });
}

std::optional<ScreenBox> screenBox(const Camera& camera, const Triangle& t) {
  if (!isValid(t)) return std::nullopt;
  return boxOfCorners(camera, std::array{t.a, t.b, t.c}, [](std::size_t, std::size_t) { return true; });
}

}  // namespace viewproj::cmd
