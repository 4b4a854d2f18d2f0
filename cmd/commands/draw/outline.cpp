#include "commands/draw/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "camera/camera.hpp"
#include "scene/frustum_parts.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator*(double k, const Vec3& a) { return {k * a.x, k * a.y, k * a.z}; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// Whether an end is in the picture, a hundredth of its size aside. Of a segment with one end 1e30 times as far away as
/// the other, it need not be.
bool isInPicture(const Viewport& v, const SegmentEnd& end) {
  const Vec2 corner = pictureCorners(v).first;
  const double x = (end.screen.x - corner.x) / v.width, y = (end.screen.y - corner.y) / v.height;
  return std::fabs(x - 0.5) <= 0.51 && std::fabs(y - 0.5) <= 0.51;
}

void add(Outline& outline, const Frustum& frustum, const Vec3& a, const Vec3& b) {
  const VisibleSegment piece = clipSegment(frustum, a, b);
  if (!piece.visible) return;
  const Viewport& viewport = frustum.camera().viewport();
  if (isInPicture(viewport, piece.start) && isInPicture(viewport, piece.end))
    outline.pieces.push_back(piece);
  else
    outline.fault = "reaches too far to be drawn whole";
}

/// center + cos(angle) u + sin(angle) v.
struct Circle {
  Vec3 center, u, v;
  Vec3 at(double angle) const { return center + std::cos(angle) * u + std::sin(angle) * v; }
};

Circle circleAcross(const Vec3& center, const Vec3& axis, double radius) {
  const Vec3 size{std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)};
  const Vec3 other = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                     : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                          : Vec3{0, 0, 1};
  const Vec3 across = cross(axis, other);
  const Vec3 u = (1 / length(across)) * across;
  return {center, radius * u, radius * cross(axis, u)};
}

constexpr int kFewestChords = 24, kMostChords = 720;

/// So many that a chord's middle is within kChordShare of the circle, judged by how large the circle is seen. (The
/// sagitta of one of N chords is radius (pi/N)^2 / 2.)
template <class PointAt>
int chordsOf(const Camera& camera, const PointAt& pointAt) {
  double left = INFINITY, right = -INFINITY, low = INFINITY, high = -INFINITY;
  for (int i = 0; i < kFewestChords; ++i) {
    const ScreenPoint p = worldToScreen(camera, pointAt(2 * std::numbers::pi * i / kFewestChords));
    if (p.status != PointStatus::inFront) return kMostChords;
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  const double share =
      std::max(right - left, high - low) / 2 / std::max(camera.viewport().width, camera.viewport().height);
  const double chords = std::numbers::pi * std::sqrt(share / 2 / kChordShare);
  // A circle seen askew is bent more at its ends: twice as many there.
  return chords < kMostChords / 2.0 ? std::max(kFewestChords, 4 * static_cast<int>(std::ceil(chords / 2)))
                                    : kMostChords;
}

/// Of the sphere whose z is stretched.
Outline silhouette(const Frustum& frustum, const Sphere& sphere, double stretch) {
  Outline outline;
  const Camera& camera = frustum.camera();
  const auto flat = [&](const Vec3& p) { return Vec3{p.x, p.y, p.z / stretch}; };
  Circle circle;
  if (parts(camera).constants.orthographic) {
    const Vec3 along = flat(screenToRay(camera, {0, 0}).direction);
    circle = circleAcross(sphere.center, (1 / length(along)) * along, sphere.radius);
  } else {
    const Vec3 toCenter = sphere.center - flat(camera.pose().eye());
    const double distance = length(toCenter), share = sphere.radius / distance;
    if (!(share < 1)) {
      outline.fault = "no outline, the eye is within it";
      return outline;
    }
    const Vec3 axis = (1 / distance) * toCenter;
    circle = circleAcross(sphere.center - (sphere.radius * share) * axis, axis,
                          sphere.radius * std::sqrt((1 - share) * (1 + share)));
  }
  const auto pointAt = [&](double angle) {
    const Vec3 p = circle.at(angle);
    return Vec3{p.x, p.y, p.z * stretch};
  };
  const int chords = chordsOf(camera, pointAt);
  const Vec3 first = pointAt(0);
  Vec3 last = first;
  for (int i = 1; i <= chords; ++i) {
    const Vec3 next = i == chords ? first : pointAt(2 * std::numbers::pi * i / chords);
    add(outline, frustum, last, next);
    last = next;
  }
  // From its middle the surface reaches this far along the view, both ways.
  const DDVec3& forward = parts(camera).pose.rows.forward;
  const double reach = sphere.radius * length({forward.x.hi, forward.y.hi, forward.z.hi * stretch});
  const Vec3 center{sphere.center.x, sphere.center.y, sphere.center.z * stretch};
  const double distance = worldToScreen(camera, center).viewDistance;
  const auto cut = [&](double plane) { return std::fabs(distance - plane) < reach; };
  if (cut(camera.projection().zNear()))
    outline.fault = "cut by near, its edge there is not drawn";
  else if (cut(camera.projection().zFar()))
    outline.fault = "cut by far, its edge there is not drawn";
  return outline;
}

}  // namespace

Outline outlineOf(const Frustum& frustum, const Segment& segment) {
  Outline outline;
  outline.isSegment = true;
  add(outline, frustum, segment.a, segment.b);
  return outline;
}

Outline outlineOf(const Frustum& frustum, const Box& box) {
  const auto corner = [&](int i) {
    return Vec3{i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
  };
  Outline outline;
  // Round the bottom and the top, then the four between them.
  constexpr std::array<std::array<int, 2>, 12> kEdges = {
      {{0, 1}, {1, 3}, {3, 2}, {2, 0}, {4, 5}, {5, 7}, {7, 6}, {6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  for (const auto& [a, b] : kEdges) add(outline, frustum, corner(a), corner(b));
  return outline;
}

Outline outlineOf(const Frustum& frustum, const Triangle& t) {
  Outline outline;
  add(outline, frustum, t.a, t.b);
  add(outline, frustum, t.b, t.c);
  add(outline, frustum, t.c, t.a);
  return outline;
}

Outline outlineOf(const Frustum& frustum, const Sphere& sphere) {
  if (cull(frustum, sphere).verdict == CullVerdict::outside) return {};
  return silhouette(frustum, sphere, 1);
}

Outline outlineOf(const Frustum& frustum, const Ellipsoid& ellipsoid) {
  return silhouette(frustum, {{0, 0, 0}, ellipsoid.equatorial}, ellipsoid.polar / ellipsoid.equatorial);
}

Outline outlineOf(const Frustum& frustum, const HeightSurface& surface) {
  return outlineOf(frustum, Ellipsoid{kWgs84.equatorial + surface.height, kWgs84.polar + surface.height});
}

}  // namespace viewproj::cmd
