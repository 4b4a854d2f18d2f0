#include "commands/check/plain_camera.hpp"

#include <algorithm>

#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd::mistakes {

using namespace detail;
namespace {

constexpr Vec2 kNone{NAN, NAN};

/// NaN where the lens folds: where its radius no longer grows.
Vec2 bent(const PlainLens& lens, const Vec2& at) {
  const auto& [k1, k2, k3, k4, k5, k6] = lens.k;
  const auto [x, y] = at;
  if (lens.model == LensModel::fisheye) {
    const double r = std::hypot(x, y), t = std::atan(r), w = t * t;
    if (!(1 + w * (3 * k1 + w * (5 * k2 + w * (7 * k3 + w * 9 * k4))) > 0)) return kNone;
    const double share = r > 0 ? t * (1 + w * (k1 + w * (k2 + w * (k3 + w * k4)))) / r : 1;
    return {x * share, y * share};
  }
  const double u = x * x + y * y, over = 1 + u * (k1 + u * (k2 + u * k3)), under = 1 + u * (k4 + u * (k5 + u * k6));
  const double slope = (k1 + u * (2 * k2 + u * 3 * k3)) * under - over * (k4 + u * (2 * k5 + u * 3 * k6));
  if (!(under > 0 && over * under + 2 * u * slope > 0)) return kNone;
  const double g = over / under, p1 = lens.p[0], p2 = lens.p[1];
  return {x * g + 2 * p1 * x * y + p2 * (u + 2 * x * x), y * g + p1 * (u + 2 * y * y) + 2 * p2 * x * y};
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

double angleOf(const Rows& r) {
  const Vec3 skew{r[2].y - r[1].z, r[0].z - r[2].x, r[1].x - r[0].y};
  return std::atan2(length(skew), r[0].x + r[1].y + r[2].z - 1);
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
  PlainCamera plain{
      {row(0, 1), row(1, down), row(2, ahead)}, camera.pose().eye(), {k.fx, downwards * k.fy}, {k.cx, k.cy}};
  plain.isOrthographic = camera.projection().isOrthographic();
  if (const auto lens = lensOf(camera)) plain.lens = {lens->model(), lens->k(), lens->p()};
  return plain;
}

Vec2 pixelOf(const PlainCamera& camera, const Vec4& p) {
  const double weight = p.w == 0 ? 1 : p.w;
  const Vec3 way = p.w == 0
                       ? Vec3{p.x, p.y, p.z}
                       : Vec3{p.x / weight - camera.eye.x, p.y / weight - camera.eye.y, p.z / weight - camera.eye.z};
  const Vec3 at = camera.axes * way;
  if (!camera.isOrthographic && !(at.z > 0)) return kNone;
  if (camera.isOrthographic && p.w == 0) return kNone;
  Vec2 seen = camera.isOrthographic ? Vec2{at.x, at.y} : Vec2{at.x / at.z, at.y / at.z};
  if (camera.lens) seen = bent(*camera.lens, seen);
  return {camera.focal.x * seen.x + camera.centre.x, camera.focal.y * seen.y + camera.centre.y};
}

}  // namespace viewproj::cmd::mistakes
