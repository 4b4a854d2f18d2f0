#include "picture/view.hpp"

#include <algorithm>
#include <numbers>

#include "camera/sea_level.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::cmd {
namespace {

using detail::crossOf;
using detail::dot;

constexpr double kLonger = 960, kLeft = 46, kHead = 58, kHeadWithoutTicks = 40;

double reachOf(const Camera& camera) {
  const Projection p = camera.projection();
  if (p.isOrthographic() || lensOf(camera)) return std::numbers::pi;
  return std::atan(std::hypot(std::max(std::fabs(p.left()), std::fabs(p.right())),
                              std::max(std::fabs(p.bottom()), std::fabs(p.top()))));
}

/// The directions at an angle from an axis, as far as the picture can show them. u: towards the viewing axis.
Circle circleAround(const View& view, const Vec3& axis, double angle) {
  constexpr double kMargin = 0.01;
  const Vec3 forward = view.camera().pose().forward();
  const double along = dot(forward, axis);
  Vec3 across = sum(forward, -along, axis);
  if (length(across) < 1e-6) across = crossOf(axis, std::fabs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  Circle circle{{}, unit(across), {}};
  circle.v = crossOf(axis, circle.u);
  const double reach = view.reach() + kMargin;
  if (view.isParallel() || reach >= std::numbers::pi) return circle;
  // A direction is in view where cos(angle) along + sin(angle) |across| cos(turn) >= cos(reach).
  const double most = std::sin(angle) * std::sqrt(std::max(0.0, 1 - along * along));
  const double least = std::cos(reach) - std::cos(angle) * along;
  if (std::fabs(least) < most)  // else all of them, or none
    circle.turns = std::min(0.5, std::acos(least / most) / (2 * std::numbers::pi) + kMargin);
  return circle;
}

/// A sphere around a shape; nothing of one without end.
std::optional<Sphere> sphereAround(const SceneObject& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape.shape)) return *sphere;
  if (const auto* box = std::get_if<Box>(&shape.shape))
    return Sphere{pointAlong(box->min, box->max, 0.5), length(sum(box->max, -1, box->min)) / 2};
  if (const auto* t = std::get_if<Triangle>(&shape.shape)) {
    const Vec3 middle = sum(sum(sum({}, 1 / 3.0, t->a), 1 / 3.0, t->b), 1 / 3.0, t->c);
    const auto away = [&](const Vec3& corner) { return length(sum(corner, -1, middle)); };
    return Sphere{middle, std::max({away(t->a), away(t->b), away(t->c)})};
  }
  return std::nullopt;
}

}  // namespace

View::View(const Camera& camera, std::vector<SceneObject> shapes, bool worldIsEcef)
    : camera_(camera),
      pinhole_(withoutLens(camera)),
      shapes_(std::move(shapes)),
      worldIsEcef_(worldIsEcef),
      eye_(camera.pose().eye()),
      first_(pictureCorners(camera.viewport()).first),
      scale_(kLonger / std::max(camera.viewport().width, camera.viewport().height)),
      reach_(reachOf(camera)),
      frame_{kLeft, isFromTop() ? kHead : kHeadWithoutTicks, 0, 0},
      frustum_(viewFrustum(pinhole_)),
      candidates_({}) {
  frame_.right = frame_.left + camera.viewport().width * scale_;
  frame_.bottom = frame_.top + camera.viewport().height * scale_;
  candidates_ = Cells<std::size_t>(frame_);
  for (std::size_t i = 0; i < shapes_.size(); ++i) candidates_.add(boundsOf(shapes_[i]), i);
}

Vec2 View::onSheet(const Vec2& screen) const {
  const double y = (screen.y - first_.y) * scale_;
  return {frame_.left + (screen.x - first_.x) * scale_, isFromTop() ? frame_.top + y : frame_.bottom - y};
}

Vec2 View::offSheet(const Vec2& at) const {
  const double y = isFromTop() ? at.y - frame_.top : frame_.bottom - at.y;
  return {first_.x + (at.x - frame_.left) / scale_, first_.y + y / scale_};
}

std::optional<Vec2> View::place(const Vec4& point, Extent extent) const {
  constexpr unsigned kDistances = sideNear | sideFar;
  const Camera& camera = extent == Extent::withoutLens ? pinhole_ : camera_;
  const ScreenPoint p = worldToScreen(camera, point, Precision::standard);
  const unsigned beyond = extent == Extent::anyDistance ? p.outside & ~kDistances : p.outside;
  if (p.status != PointStatus::inFront || beyond != 0) return std::nullopt;
  return onSheet({p.x, p.y});
}

Ray View::rayAt(const Vec2& at) const { return screenToRay(camera_, offSheet(at), RayOrigin::nearPlane); }

bool View::hides(const Vec3& point, const Vec2& at, const SceneObject* except) const {
  constexpr double kNearer = 1 - 1e-7;  // a point of a surface is not hidden by it
  if (worldIsEcef_ && earthHides(eye_, pointOf(point))) return true;
  const Ray ray = rayAt(at);
  const double away = length(sum(point, -1, ray.origin)) * kNearer;
  return anyShapeAt(at, [&](const SceneObject& shape) {
    if (&shape == except) return false;
    const Hits hits = hitsOf(ray, shape);
    return hits.count > 0 && hits.hits[0].distance < away;
  });
}

const SceneObject* View::shapeAt(const Vec2& at) const {
  const Ray ray = rayAt(at);
  const SceneObject* nearest = nullptr;
  double least = HUGE_VAL;
  anyShapeAt(at, [&](const SceneObject& shape) {
    const Hits hits = hitsOf(ray, shape);
    if (hits.count > 0 && hits.hits[0].distance < least) least = hits.hits[0].distance, nearest = &shape;
    return false;
  });
  return nearest;
}

Rect View::boundsOf(const SceneObject& shape) const {
  constexpr int kSamples = 24;
  constexpr double kMore = 0.02;  // of the size: a polygon of 24 corners lies within its circle by 0.9 %
  const Rect everywhere{-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL};
  const auto sphere = sphereAround(shape);
  auto outline = sphere ? outlineOf(*this, *sphere) : std::nullopt;
  if (!outline) return everywhere;
  outline->turns = 0.5;
  std::vector<Vec2> places;
  for (int i = 0; i < kSamples; ++i) {
    const ScreenPoint p = worldToScreen(camera_, (*outline)(i / double(kSamples)), Precision::standard);
    if (p.status != PointStatus::inFront) return everywhere;
    places.push_back(onSheet({p.x, p.y}));
  }
  const Rect box = cmd::boundsOf(places);
  return grown(box, 2 + kMore * std::max(box.right - box.left, box.bottom - box.top));
}

Vec4 Circle::operator()(double t) const {
  const double angle = 2 * std::numbers::pi * turns * (2 * t - 1);
  const Vec3 p = sum(sum(middle, std::cos(angle), u), std::sin(angle), v);
  return {p.x, p.y, p.z * stretch, weight};
}

int Circle::steps(const View& view) const {
  constexpr double kFewest = 48, kMost = 100'000;
  return static_cast<int>(std::clamp(16 * std::numbers::pi * turns / view.reach(), kFewest, kMost));
}

std::optional<Circle> outlineOf(const View& view, const Sphere& sphere, double stretch) {
  const Vec3 eye = view.eye(), forward = view.camera().pose().forward();
  const Vec3 way = view.isParallel() ? Vec3{forward.x, forward.y, forward.z / stretch}
                                     : sum(sphere.center, -1, {eye.x, eye.y, eye.z / stretch});
  const double away = length(way), share = view.isParallel() ? 0 : sphere.radius / away;
  if (!(share < 1)) return std::nullopt;
  const Vec3 axis = unit(way);
  Circle circle = circleAround(view, axis, std::asin(share));
  const double radius = sphere.radius * std::sqrt((1 - share) * (1 + share));
  circle.middle = sum(sphere.center, -sphere.radius * share, axis);
  circle.u = sum({}, radius, circle.u);
  circle.v = sum({}, radius, circle.v);
  circle.stretch = stretch;
  return circle;
}

Circle horizonOf(const View& view, const Vec3& normal) {
  Circle circle = circleAround(view, normal, std::numbers::pi / 2);
  circle.weight = 0;
  return circle;
}

}  // namespace viewproj::cmd
