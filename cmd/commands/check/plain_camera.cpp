#include "commands/check/plain_camera.hpp"

#include <algorithm>

#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd::mistakes {

using namespace detail;
namespace {

constexpr Vec2 kNone{NAN, NAN};

/// NaN where the lens folds: where its radius no longer grows.
Vec2 bent(const TrialLens& lens, double x, double y) {
  const auto& [k1, k2, k3] = lens.k;
  const auto& [p1, p2] = lens.p;
  const double u = x * x + y * y, g = 1 + u * (k1 + u * (k2 + u * k3));
  if (!(g > 0 && 1 + u * (3 * k1 + u * (5 * k2 + u * 7 * k3)) > 0)) return kNone;
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

double angleOf(const Rows& r) { return std::atan2(length(skewOf(r)), r[0].x + r[1].y + r[2].z - 1); }

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
  plain.lens = lensOf(camera);
  return plain;
}

PlainPose poseOf(const PlainCamera& camera) {
  return {camera.eye, camera.axes[0], scaled(camera.axes[1], -1), camera.axes[2]};
}

Vec2 pixelOf(const PlainCamera& camera, const Vec4& p) {
  const double weight = p.w == 0 ? 1 : p.w;
  const Vec3 way = p.w == 0
                       ? Vec3{p.x, p.y, p.z}
                       : Vec3{p.x / weight - camera.eye.x, p.y / weight - camera.eye.y, p.z / weight - camera.eye.z};
  const Vec3 at = camera.axes * way;
  Vec2 seen{at.x, at.y};
  if (camera.isOrthographic) {
    if (p.w == 0) return kNone;
  } else if (camera.lens && !camera.trial) {
    seen = distorted(*camera.lens, at);
  } else {
    if (!(at.z > 0)) return kNone;
    seen = camera.trial ? bent(*camera.trial, at.x / at.z, at.y / at.z) : Vec2{at.x / at.z, at.y / at.z};
  }
  return {camera.focal.x * seen.x + camera.centre.x, camera.focal.y * seen.y + camera.centre.y};
}

}  // namespace viewproj::cmd::mistakes
