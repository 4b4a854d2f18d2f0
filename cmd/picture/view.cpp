#include "picture/view.hpp"

#include <algorithm>
#include <numbers>

#include "camera/sea_level.hpp"
#include "numbers/vectors.hpp"
#include "picture/ground.hpp"

namespace viewproj::cmd {
namespace {

using detail::crossOf;
using detail::dot;

constexpr double kPi = std::numbers::pi;

double reachOf(const Camera& camera) {
  const Projection p = camera.projection();
  if (p.isOrthographic() || lensOf(camera)) return kPi;
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
  if (reach >= kPi) return circle;
  // A direction is in view where cos(angle) along + sin(angle) |across| cos(turn) >= cos(reach).
  const double most = std::sin(angle) * std::sqrt(std::max(0.0, 1 - along * along));
  const double least = std::cos(reach) - std::cos(angle) * along;
  if (std::fabs(least) < most)  // else all of them, or none
    circle.turns = std::min(0.5, std::acos(least / most) / (2 * kPi) + kMargin);
  return circle;
}

/// A sphere around a shape.
Sphere sphereAround(const SceneObject& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape.shape)) return *sphere;
  const std::vector<Vec3> corners = cornersOf(shape);
  Sphere sphere{middleOf(corners), corners.empty() ? HUGE_VAL : 0};
  for (const Vec3& corner : corners) sphere.radius = std::max(sphere.radius, apart(corner, sphere.center));
  return sphere;
}

}  // namespace

View::View(const Camera& camera, std::vector<SceneObject> shapes, bool worldIsEcef)
    : camera_(camera),
      pinhole_(withoutLens(camera)),
      shapes_(std::move(shapes)),
      worldIsEcef_(worldIsEcef),
      eye_(camera.pose().eye()),
      first_(pictureCorners(camera.viewport()).first),
      reach_(reachOf(camera)),
      frustum_(viewFrustum(pinhole_)) {
  constexpr double kLonger = 960, kLeft = 46, kHead = 58, kHeadWithoutTicks = 40;
  const double width = camera.viewport().width, height = camera.viewport().height;
  const double top = isFromTop() ? kHead : kHeadWithoutTicks;
  scale_ = kLonger / std::max(width, height);
  frame_ = {kLeft, top, kLeft + width * scale_, top + height * scale_};
  std::vector<Sphere> around;
  for (const SceneObject& shape : shapes_) around.push_back(sphereAround(shape));
  tree_ = SphereTree(std::move(around));
}

Vec2 View::onSheet(const Vec2& screen) const {
  const double y = (screen.y - first_.y) * scale_;
  return {frame_.left + (screen.x - first_.x) * scale_, isFromTop() ? frame_.top + y : frame_.bottom - y};
}

Vec2 View::offSheet(const Vec2& at) const {
  const double y = isFromTop() ? at.y - frame_.top : frame_.bottom - at.y;
  return {first_.x + (at.x - frame_.left) / scale_, first_.y + y / scale_};
}

std::optional<Vec2> View::pixelOf(const Vec4& point) const {
  const ScreenPoint p = worldToScreen(camera_, point, Precision::standard);
  return p.status == PointStatus::inFront ? std::optional(onSheet({p.x, p.y})) : std::nullopt;
}

std::optional<Vec2> View::place(const Vec4& point, Extent extent) const {
  const Camera& camera = extent == Extent::withoutLens ? pinhole_ : camera_;
  const ScreenPoint p = worldToScreen(camera, point, Precision::standard);
  const unsigned distances = extent == Extent::anyDistance ? sideNear | sideFar : 0U;
  if (p.status != PointStatus::inFront || (p.outside & ~distances) != 0) return std::nullopt;
  return onSheet({p.x, p.y});
}

Ray View::rayAt(const Vec2& at) const { return screenToRay(camera_, offSheet(at), RayOrigin::nearPlane); }

double View::distanceTo(std::size_t shape, const Ray& ray) const {
  const Hits hits = hitsOf(ray, shapes_[shape]);
  return hits.count > 0 ? hits.hits[0].distance : HUGE_VAL;
}

bool View::hides(const Vec3& point, const Vec2& at, const SceneObject* except) const {
  constexpr double kNearer = 1 - 1e-7;  // a point of a surface is not hidden by it
  if (worldIsEcef_ && earthHides(eye_, pointOf(point))) return true;
  const Ray ray = rayAt(at);
  const double away = apart(point, ray.origin) * kNearer;
  return tree_.any(ray, away, [&](std::size_t i) { return &shapes_[i] != except && distanceTo(i, ray) < away; });
}

const SceneObject* View::shapeAt(const Vec2& at) const {
  const Ray ray = rayAt(at);
  std::pair nearest{HUGE_VAL, shapes_.size()};  // of equal ones the first
  tree_.any(ray, HUGE_VAL, [&](std::size_t i) {
    if (const double away = distanceTo(i, ray); away < HUGE_VAL) nearest = std::min(nearest, {away, i});
    return false;
  });
  return nearest.second < shapes_.size() ? &shapes_[nearest.second] : nullptr;
}

bool View::isSeenAt(const Vec2& at, const SceneObject& shape) const {
  const Ray ray = rayAt(at);
  const auto own = static_cast<std::size_t>(&shape - shapes_.data());
  const double away = distanceTo(own, ray);
  return away < HUGE_VAL &&
         !tree_.any(ray, away, [&](std::size_t i) { return std::pair(distanceTo(i, ray), i) < std::pair(away, own); });
}

std::vector<Vec3> cornersOf(const SceneObject& shape) {
  std::vector<Vec3> corners;
  if (const auto* box = std::get_if<Box>(&shape.shape))
    for (int i = 0; i < 8; ++i)
      corners.push_back(
          {(i & 1 ? box->max : box->min).x, (i & 2 ? box->max : box->min).y, (i & 4 ? box->max : box->min).z});
  if (const auto* triangle = std::get_if<Triangle>(&shape.shape)) corners = {triangle->a, triangle->b, triangle->c};
  return corners;
}

Vec3 middleOf(const std::vector<Vec3>& points) {
  Vec3 middle;
  for (const Vec3& point : points) middle = sum(middle, 1.0 / static_cast<double>(points.size()), point);
  return middle;
}

Vec4 Circle::operator()(double t) const {
  const double angle = 2 * kPi * turns * (2 * t - 1);
  const Vec3 p = sum(sum(middle, std::cos(angle), u), std::sin(angle), v);
  return {p.x, p.y, p.z * stretch, weight};
}

int Circle::steps(const View& view) const {
  constexpr double kFewest = 48, kMost = 100'000;
  return static_cast<int>(std::clamp(16 * kPi * turns / view.reach(), kFewest, kMost));
}

std::optional<Circle> outlineOf(const View& view, const Sphere& sphere, double stretch) {
  const Vec3 eye = view.eye(), forward = view.camera().pose().forward();
  const Vec3 way = view.isParallel() ? Vec3{forward.x, forward.y, forward.z / stretch}
                                     : sum(sphere.center, -1, {eye.x, eye.y, eye.z / stretch});
  const double share = view.isParallel() ? 0 : sphere.radius / length(way);
  if (!(share < 1)) return std::nullopt;
  const Vec3 axis = unit(way);
  Circle circle = circleAround(view, axis, std::asin(share));
  const double radius = sphere.radius * std::sqrt((1 - share) * (1 + share));
  circle.middle = sum(sphere.center, -sphere.radius * share, axis);
  circle.u = scaled(circle.u, radius);
  circle.v = scaled(circle.v, radius);
  circle.stretch = stretch;
  return circle;
}

Circle horizonOf(const View& view, const Vec3& normal) {
  Circle circle = circleAround(view, normal, kPi / 2);
  circle.weight = 0;
  return circle;
}

}  // namespace viewproj::cmd
