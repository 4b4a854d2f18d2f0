#include "commands/plain_camera.hpp"

#include <algorithm>
#include <numbers>

#include "viewproj/matrices.hpp"

namespace viewproj::cmd {
namespace {

constexpr Vec2 kNone{NAN, NAN};

/// In the picture of focal length 1, from its centre; and back.
Vec2 unitOf(const PlainCamera& camera, const Vec2& pixel) {
  return {(pixel.x - camera.centre.x) / camera.focal.x, (pixel.y - camera.centre.y) / camera.focal.y};
}
Vec2 inPixels(const PlainCamera& camera, const Vec2& at) {
  return {camera.focal.x * at.x + camera.centre.x, camera.focal.y * at.y + camera.centre.y};
}

std::optional<PlainLens> plainOf(const std::optional<Lens>& lens) {
  if (!lens) return std::nullopt;
  const bool isFov = lens->model() == LensModel::fov, isBrown = lens->model() == LensModel::brown;
  return PlainLens{
      .isAngle = isFov || lens->model() == LensModel::fisheye,
      .xi = lens->xi(),
      .alpha = lens->alpha(),
      .beta = lens->beta(),
      .across = isFov ? 2 * std::tan(lens->omega() / 2) : 1,
      .k = lens->k(),
      .p = lens->p(),
      .limitCosine = std::cos(std::min(lens->limitDegrees(), isBrown ? 90.0 : 180.0) * std::numbers::pi / 180)};
}

}  // namespace

Vec2 PlainLens::operator()(const Vec3& d) const {
  const double square = d.x * d.x + d.y * d.y, size = std::sqrt(square + d.z * d.z);
  if (!(d.z > limitCosine * size)) return kNone;
  const auto& [k1, k2, k3, k4, k5, k6] = k;
  if (isAngle) {
    const double r = std::sqrt(square), t = std::atan2(across * r, d.z), u = t * t;
    const double by = r > 0 ? t * (1 + u * (k1 + u * (k2 + u * (k3 + u * k4)))) / (across * r) : 1 / d.z;
    return {d.x * by, d.y * by};
  }
  const double ahead = d.z + xi * size;
  const double divisor = alpha == 0 ? ahead : alpha * std::sqrt(beta * square + ahead * ahead) + (1 - alpha) * ahead;
  const double x = d.x / divisor, y = d.y / divisor, u = x * x + y * y, g = 1 + u * (k1 + u * (k2 + u * k3));
  // One that is sought ends where the radius no longer grows.
  if (isBrown() && !(g > 0 && 1 + u * (3 * k1 + u * (5 * k2 + u * 7 * k3)) > 0)) return kNone;
  const double by = g / (1 + u * (k4 + u * (k5 + u * k6))), along = by + 2 * (p[0] * y + p[1] * x);
  return {(1 + xi) * (x * along + p[1] * u), (1 + xi) * (y * along + p[0] * u)};
}

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
          .lens = plainOf(lensOf(camera)),
          .lensOfFile = lensOf(camera),
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
  if (camera.lens) return inPixels(camera, (*camera.lens)(at));
  return at.z > 0 ? inPixels(camera, {at.x / at.z, at.y / at.z}) : kNone;
}

Vec3 rayOf(const PlainCamera& camera, const Vec2& pixel) {
  const Vec2 at = unitOf(camera, pixel);
  const Vec3 ray = camera.lensOfFile ? undistorted(*camera.lensOfFile, at) : Vec3{at.x, at.y, 1};
  return std::isfinite(ray.x + ray.y) ? unit(ray) : Vec3{};
}

Vec2 withoutLens(const PlainCamera& camera, const Vec2& pixel) {
  const Vec3 ray = rayOf(camera, pixel);
  return ray.z > 0 ? inPixels(camera, {ray.x / ray.z, ray.y / ray.z}) : kNone;
}

Vec2 bentAgain(const PlainCamera& camera, const Vec2& pixel) {
  const Vec2 at = unitOf(camera, pixel);
  return camera.lens ? inPixels(camera, (*camera.lens)({at.x, at.y, 1})) : kNone;
}

}  // namespace viewproj::cmd
