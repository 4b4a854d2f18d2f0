#include "commands/check/plain_camera.hpp"

#include <algorithm>
#include <numbers>

#include "viewproj/matrices.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr Vec2 kNone{NAN, NAN};

/// NaN where the lens folds: where its radius no longer grows.
Vec2 bent(const BrownTerms& lens, double x, double y) {
  const auto& [k1, k2, k3] = lens.k;
  const auto& [p1, p2] = lens.p;
  const double u = x * x + y * y, g = 1 + u * (k1 + u * (k2 + u * k3));
  if (!(u < lens.limit && g > 0 && 1 + u * (3 * k1 + u * (5 * k2 + u * 7 * k3)) > 0)) return kNone;
  return {x * g + 2 * p1 * x * y + p2 * (u + 2 * x * x), y * g + p1 * (u + 2 * y * y) + 2 * p2 * x * y};
}

/// In the picture of focal length 1, from its centre; and back.
Vec2 unitOf(const PlainCamera& camera, const Vec2& pixel) {
  return {(pixel.x - camera.centre.x) / camera.focal.x, (pixel.y - camera.centre.y) / camera.focal.y};
}
Vec2 inPixels(const PlainCamera& camera, const Vec2& at) {
  return {camera.focal.x * at.x + camera.centre.x, camera.focal.y * at.y + camera.centre.y};
}

std::optional<BrownTerms> termsOf(const std::optional<Lens>& lens) {
  if (!lens || lens->model() != LensModel::brown) return std::nullopt;
  const auto& [k1, k2, k3, k4, k5, k6] = lens->k();
  if (k4 != 0 || k5 != 0 || k6 != 0) return std::nullopt;
  const double limit = std::tan(std::min(lens->limitDegrees(), 90.0) * std::numbers::pi / 180);
  return BrownTerms{{k1, k2, k3}, lens->p(), limit * limit};
}

}  // namespace

Rows turn(const Vec3& vector) {
  const double angle = length(vector);
  if (!(angle > 0)) return kUnit;
  const Vec3 a = scaled(vector, 1 / angle);
  const double s = std::sin(angle), c = 1 - std::cos(angle);
  return {Vec3{1 - c * (1 - a.x * a.x), c * a.x * a.y - s * a.z, c * a.x * a.z + s * a.y},
          {c * a.x * a.y + s * a.z, 1 - c * (1 - a.y * a.y), c * a.y * a.z - s * a.x},
          {c * a.x * a.z - s * a.y, c * a.y * a.z + s * a.x, 1 - c * (1 - a.z * a.z)}};
}

PlainCamera plainOf(const Camera& camera) {
  const Mat4 view = matrix(withoutLens(camera), Space::view, Space::world);
  const double down = camera.convention().view == ViewAxes::RDF ? 1 : -1;
  const double ahead = camera.convention().view == ViewAxes::RUB ? -1 : 1;
  const auto row = [&](std::size_t i, double sign) {
    return Vec3{sign * view[i][0], sign * view[i][1], sign * view[i][2]};
  };
  const Intrinsics k = camera.intrinsics();
  const double downwards = camera.viewport().origin == Origin::topLeft ? 1 : -1;
  return {.axes = {row(0, 1), row(1, down), row(2, ahead)},
          .eye = camera.pose().eye(),
          .focal = {k.fx, downwards * k.fy},
          .centre = {k.cx, k.cy},
          .lens = lensOf(camera),
          .terms = termsOf(lensOf(camera)),
          .isOrthographic = camera.projection().isOrthographic()};
}

PlainPose poseOf(const PlainCamera& camera) {
  return {camera.eye, camera.axes[0], scaled(camera.axes[1], -1), camera.axes[2]};
}

Vec3 wayTo(const PlainCamera& camera, const Vec4& p) {
  if (p.w == 0) return {p.x, p.y, p.z};
  return {p.x / p.w - camera.eye.x, p.y / p.w - camera.eye.y, p.z / p.w - camera.eye.z};
}

Vec2 pixelOf(const PlainCamera& camera, const Vec4& p) {
  const Vec3 at = camera.axes * wayTo(camera, p);
  if (camera.isOrthographic) return p.w == 0 ? kNone : inPixels(camera, {at.x, at.y});
  if (camera.lens && !camera.terms) return inPixels(camera, distorted(*camera.lens, at));
  if (!(at.z > 0)) return kNone;
  const Vec2 seen{at.x / at.z, at.y / at.z};
  return inPixels(camera, camera.terms ? bent(*camera.terms, seen.x, seen.y) : seen);
}

Vec3 rayOf(const PlainCamera& camera, const Vec2& pixel) {
  const Vec2 at = unitOf(camera, pixel);
  const Vec3 ray = camera.lens ? undistorted(*camera.lens, at) : Vec3{at.x, at.y, 1};
  return std::isfinite(ray.x + ray.y) ? unit(ray) : Vec3{};
}

Vec2 withoutLens(const PlainCamera& camera, const Vec2& pixel) {
  const Vec3 ray = rayOf(camera, pixel);
  return ray.z > 0 ? inPixels(camera, {ray.x / ray.z, ray.y / ray.z}) : kNone;
}

Vec2 bentAgain(const PlainCamera& camera, const Vec2& pixel) {
  const Vec2 at = unitOf(camera, pixel);
  return inPixels(camera, distorted(*camera.lens, {at.x, at.y, 1}));
}

}  // namespace viewproj::cmd::mistakes
