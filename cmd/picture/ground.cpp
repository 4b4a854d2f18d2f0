#include "picture/ground.hpp"

#include <algorithm>
#include <numbers>

#include "camera/plain_camera.hpp"
#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

using detail::dot;

constexpr double kRadian = std::numbers::pi / 180;

/// The surface of a height. Its formulas are those of curves on the ellipsoid: a and b its semi-axes, e its
/// eccentricity, M and N its radii of curvature along and across the meridian.
class HeightGround final : public Ground {
 public:
  HeightGround(double surface, const Vec3& eye) : eye_(eye), place_(ecefToGeodetic(eye)) {
    constexpr double kLeastRise = 1e-6;  // metres
    height = surface;
    const auto& [east, north, above] = localAxes(place_);
    aside = east;
    ahead = north;
    up = above;
    rise = place_.height - height;
    holdsEye = std::fabs(rise) < kLeastRise;
    isOnEarth = true;
    foot = {place_.lon, place_.lat};
    extent = {foot.x - 180, -90, foot.x + 180, 90};
    // What a camera on the ground stands on does not hide; below the ellipsoid the ground is lower too.
    hiding_ = rise > 0 ? height : std::min(0.0, place_.height - 1);
  }

  std::optional<Seen> hit(const Ray& ray) const override {
    const HeightCrossings found = crossingsOfHeight(ray, height);
    if (found.count == 0 || (rise < 0 && crossingsOfHeight(ray, hiding_).count > 0)) return std::nullopt;
    return Seen{sum(ray.origin, found.distances[0], ray.direction), found.distances[0]};
  }

  std::optional<Limit> farthest(double azimuth, double most) const override {
    if (std::fabs(rise) > most) return std::nullopt;
    const double h = place_.height, touching = -std::acos(std::min(1.0, (kA + hiding_) / (kA + h)));
    auto [elevation, t] = sightOf(azimuth, {touching, 0}, hiding_, true);
    const Vec3 d = direction(azimuth, elevation);
    if (rise < 0) t = crossingsOfHeight({eye_, d}, height).distances[0];
    if (t <= most) return Limit{sum(eye_, t, d), elevation, t, "horizon"};
    const double sine = (-rise * (2 * kA + height + h) - most * most) / (2 * (kA + h) * most);
    const Sight at = sightOf(azimuth, {std::asin(std::clamp(sine, -1.0, 1.0)), most}, height, false);
    return Limit{sum(eye_, most, direction(azimuth, at.elevation)), at.elevation, most, "distance"};
  }

  Vec2 placeOf(const Vec3& point) const override {
    const Geodetic place = ecefToGeodetic(point);
    return {place.lon, place.lat};
  }
  Vec3 pointAt(const Vec2& place) const override { return geodeticToEcef({place.y, place.x, height}); }
  Vec2 way(const Vec2& from, const Vec2& to) const override {
    return {std::remainder(to.x - from.x, 360), to.y - from.y};
  }
  Vec2 scaleAt(const Vec2& place) const override {
    const double s = std::sin(place.y * kRadian), w2 = 1 - kE2 * s * s, n = kA / std::sqrt(w2);
    return {kRadian * (n + height) * std::cos(place.y * kRadian), kRadian * (n * (1 - kE2) / w2 + height)};
  }
  double areaBelow(const Vec2& place) const override { return kRadian * (belowLat(place.y) - belowLat(foot.y)); }
  double areaOf(double sum, double turn) const override {
    if (std::fabs(turn) < 180) return std::fabs(sum);
    return std::fabs(areaBelow({0, std::copysign(90, foot.y)}) * turn - sum);
  }

 private:
  static constexpr double kA = kWgs84.equatorial, kB = kWgs84.polar, kE2 = 1 - (kB / kA) * (kB / kA);

  /// The integral of (M + H)(N + H) cos lat from the equator.
  double belowLat(double lat) const {
    const double s = std::sin(lat * kRadian), w2 = 1 - kE2 * s * s, e = std::sqrt(kE2);
    return kB * kB / 2 * (s / w2 + std::atanh(e * s) / e) +
           height * (kA * std::asin(e * s) / e + kA * (1 - kE2) * s / std::sqrt(w2)) + height * height * s;
  }
  /// Height and normal at a distance along a direction from the eye.
  struct Level {
    double height;
    Vec3 normal;
  };
  Level levelAt(double t, const Vec3& d) const {
    const Geodetic place = ecefToGeodetic(sum(eye_, t, d));
    return {place.height, localAxes(place).up};
  }
  struct Sight {
    double elevation, distance;
  };
  /// At an azimuth, the elevation at which the ray is as high as this, by Newton's method: at its distance, or, to
  /// touch the surface, where it is lowest, which is found in turn as over a sphere.
  Sight sightOf(double azimuth, Sight at, double wanted, bool touches) const {
    constexpr int kSteps = 50;
    for (int i = 0; i < kSteps; ++i) {
      const Vec3 d = direction(azimuth, at.elevation);
      const Level before = levelAt(at.distance, d);
      const double nearer = touches ? dot(before.normal, d) * (kA + before.height) : 0;
      at.distance -= nearer;
      const auto [above, normal] = touches ? levelAt(at.distance, d) : before;
      const Vec3 rising = direction(azimuth, at.elevation + std::numbers::pi / 2);
      const double step = (above - wanted) / (at.distance * dot(normal, rising));
      if (!std::isfinite(step)) break;
      at.elevation -= std::clamp(step, -0.2, 0.2);
      if (std::fabs(step) < 1e-16 && std::fabs(nearer) < 1e-6) break;
    }
    return at;
  }

  Vec3 eye_;
  Geodetic place_;
  double hiding_ = 0;
};

class PlaneGround final : public Ground {
 public:
  /// away: of the eye along the normal, a unit vector. size: of the numbers that it comes from.
  PlaneGround(const SceneObject& plane, const Vec3& normal, double away, const Vec3& eye, double size)
      : plane_(plane), base_(sum(eye, -away, normal)) {
    constexpr double kLeastShare = 1e-12;
    up = scaled(normal, away < 0 ? -1 : 1);
    rise = std::fabs(away);
    holdsEye = rise <= kLeastShare * size;
    const Vec3 axis = std::fabs(up.z) > 0.5 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    aside = unit(sum(axis, -dot(axis, up), up));
    ahead = detail::crossOf(up, aside);
    origin = {-dot(base_, aside), -dot(base_, ahead)};
  }

  std::optional<Seen> hit(const Ray& ray) const override {
    const Hits hits = hitsOf(ray, plane_);
    if (hits.count == 0 || !std::isfinite(hits.hits[0].distance)) return std::nullopt;
    return Seen{hits.hits[0].point, hits.hits[0].distance};
  }
  std::optional<Limit> farthest(double azimuth, double most) const override {
    constexpr double kFar = 1e15;
    if (!(most > rise)) return std::nullopt;
    if (!std::isfinite(most)) return Limit{sum(base_, kFar * rise, direction(azimuth, 0)), 0, most};
    const double radius = std::sqrt((most - rise) * (most + rise));
    return Limit{sum(base_, radius, direction(azimuth, 0)), -std::asin(rise / most), most, "distance"};
  }
  Vec2 placeOf(const Vec3& point) const override {
    const Vec3 from = sum(point, -1, base_);
    return {dot(from, aside), dot(from, ahead)};
  }
  Vec3 pointAt(const Vec2& place) const override { return sum(sum(base_, place.x, aside), place.y, ahead); }

 private:
  SceneObject plane_;
  Vec3 base_;  ///< below the eye
};

}  // namespace

double Ground::azimuthOf(const Vec3& d) const { return std::atan2(dot(d, aside), dot(d, ahead)); }

Vec3 Ground::direction(double azimuth, double elevation) const {
  const Vec3 level = sum(scaled(aside, std::sin(azimuth)), std::cos(azimuth), ahead);
  return sum(scaled(level, std::cos(elevation)), std::sin(elevation), up);
}

bool isGround(const SceneObject& shape) {
  return !std::holds_alternative<Sphere>(shape.shape) && !std::holds_alternative<Box>(shape.shape) &&
         !std::holds_alternative<Triangle>(shape.shape);
}

std::unique_ptr<const Ground> groundOf(const SceneObject& shape, const Vec3& eye) {
  if (const auto* const surface = std::get_if<HeightSurface>(&shape.shape))
    return std::make_unique<HeightGround>(surface->height, eye);
  if (std::holds_alternative<Ellipsoid>(shape.shape)) return std::make_unique<HeightGround>(0, eye);
  if (const auto* const plane = std::get_if<Plane>(&shape.shape)) {
    const Vec3 normal = unit(plane->normal);
    return std::make_unique<PlaneGround>(shape, normal, dot(sum(eye, -1, plane->point), normal), eye,
                                         length(eye) + length(plane->point));
  }
  if (const auto* const plane = std::get_if<PlaneEquation>(&shape.shape)) {
    const Vec3 normal = unit(plane->normal);
    return std::make_unique<PlaneGround>(shape, normal, dot(eye, normal) + plane->offset / length(plane->normal), eye,
                                         0);
  }
  return nullptr;
}

}  // namespace viewproj::cmd
