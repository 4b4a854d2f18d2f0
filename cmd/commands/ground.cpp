#include "commands/ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/plain_camera.hpp"
#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"
#include "records/scene.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

/// Level axes at the eye, from which azimuths grow from `ahead` to `aside`, and up.
struct EyeAxes {
  Vec3 aside, ahead, up;

  Vec3 level(double azimuth) const { return sum(sum({}, std::sin(azimuth), aside), std::cos(azimuth), ahead); }
  double azimuthOf(const Vec3& d) const { return std::atan2(detail::dot(d, aside), detail::dot(d, ahead)); }
};

/// The surface of a height. Its formulas are those of curves on the ellipsoid: a and b its semi-axes, e its
/// eccentricity, M and N its radii of curvature along and across the meridian.
class HeightGround final : public Ground {
 public:
  HeightGround(double height, const Vec3& eye) : height_(height), eye_(eye), foot_(ecefToGeodetic(eye)) {
    if (std::fabs(foot_.height - height) < kLeastRise)
      throw InputError("the eye is on the surface of height " + formatNumber(height) + "; no outline has a size there");
    isAbove_ = foot_.height > height;
    // What a camera on the ground stands on does not hide; below the ellipsoid the ground is lower too.
    hiding_ = isAbove_ ? height : std::min(0.0, foot_.height - 1);
    const auto& [east, north, up] = localAxes(foot_);
    axes_ = {east, north, up};
  }

  std::optional<Seen> hit(const Ray& ray) const override {
    const HeightCrossings found = crossingsOfHeight(ray, height_);
    if (found.count == 0 || (!isAbove_ && crossingsOfHeight(ray, hiding_).count > 0)) return std::nullopt;
    return Seen{sum(ray.origin, found.distances[0], ray.direction), found.distances[0]};
  }

  std::optional<Limit> farthest(double azimuth, double most) const override {
    if (std::fabs(foot_.height - height_) > most) return std::nullopt;
    const auto [elevation, touching] = horizon(azimuth);
    const Vec3 d = direction(azimuth, elevation);
    double t = touching;
    if (!isAbove_) {
      const HeightCrossings out = crossingsOfHeight({eye_, d}, height_);
      t = out.count > 0 ? out.distances[0] : 0;
    }
    if (t <= most) return Limit{sum(eye_, t, d), elevation, t, "horizon"};
    const double lower = elevationAt(azimuth, most);
    return Limit{sum(eye_, most, direction(azimuth, lower)), lower, most, "distance"};
  }

  double azimuthOf(const Vec3& d) const override { return axes_.azimuthOf(d); }
  double turning() const override { return isAbove_ ? 1 : -1; }
  Vec2 placeOf(const Vec3& point) const override {
    const Geodetic place = ecefToGeodetic(point);
    return {place.lon, place.lat};
  }
  Vec2 way(const Vec2& from, const Vec2& to) const override {
    return {std::remainder(to.x - from.x, 360), to.y - from.y};
  }
  Vec2 scaleAt(const Vec2& place) const override {
    const double s = std::sin(place.y * kRadian), w2 = 1 - kE2 * s * s, n = kA / std::sqrt(w2);
    return {kRadian * (n + height_) * std::cos(place.y * kRadian), kRadian * (n * (1 - kE2) / w2 + height_)};
  }
  double areaBelow(const Vec2& place) const override { return kRadian * (belowLat(place.y) - belowLat(foot_.lat)); }
  double areaOf(double sum, double turn) const override {
    if (std::fabs(turn) < 180) return std::fabs(sum);
    const double pole = belowLat(std::copysign(90, foot_.lat)) - belowLat(foot_.lat);
    return std::fabs(pole * kRadian * turn - sum);
  }

 private:
  static constexpr double kA = kWgs84.equatorial, kB = kWgs84.polar, kE2 = 1 - (kB / kA) * (kB / kA);
  static constexpr double kLeastRise = 1e-6;  ///< metres
  static constexpr int kSteps = 50;

  /// The integral of (M + H)(N + H) cos lat from the equator.
  double belowLat(double lat) const {
    const double s = std::sin(lat * kRadian), w2 = 1 - kE2 * s * s, e = std::sqrt(kE2);
    return kB * kB / 2 * (s / w2 + std::atanh(e * s) / e) +
           height_ * (kA * std::asin(e * s) / e + kA * (1 - kE2) * s / std::sqrt(w2)) + height_ * height_ * s;
  }
  Vec3 direction(double azimuth, double elevation) const {
    return sum(sum({}, std::cos(elevation), axes_.level(azimuth)), std::sin(elevation), axes_.up);
  }
  /// How the direction changes with the elevation.
  Vec3 rising(double azimuth, double elevation) const {
    return sum(sum({}, -std::sin(elevation), axes_.level(azimuth)), std::cos(elevation), axes_.up);
  }
  /// Where the ray is lowest: Newton's method on its slope.
  double lowest(const Vec3& d) const {
    double t = -detail::dot(eye_, d);
    for (int i = 0; i < kSteps; ++i) {
      const Geodetic place = ecefToGeodetic(sum(eye_, t, d));
      const double slope = detail::dot(localAxes(place).up, d), s = std::sin(place.lat * kRadian);
      const double n = kA / std::sqrt(1 - kE2 * s * s);
      const double step = slope * (n + place.height) / std::max(1 - slope * slope, 1e-3);
      t -= step;
      if (std::fabs(step) < 1e-6) break;
    }
    return t;
  }
  /// The elevation of the ray that touches what hides, and how far away.
  std::pair<double, double> horizon(double azimuth) const {
    double e = -std::acos(std::min(1.0, (kA + hiding_) / (kA + foot_.height))), t = 0;
    for (int i = 0; i < kSteps; ++i) {
      const Vec3 d = direction(azimuth, e);
      t = lowest(d);
      const Geodetic place = ecefToGeodetic(sum(eye_, t, d));
      const double step = (place.height - hiding_) / (t * detail::dot(localAxes(place).up, rising(azimuth, e)));
      e -= step;
      if (std::fabs(step) < 1e-16) break;
    }
    return {e, t};
  }
  /// The elevation of the surface's points at a distance.
  double elevationAt(double azimuth, double distance) const {
    const double h = foot_.height, rise = (height_ - h) * (2 * kA + height_ + h) - distance * distance;
    double e = std::asin(std::clamp(rise / (2 * (kA + h) * distance), -1.0, 1.0));
    for (int i = 0; i < kSteps; ++i) {
      const Geodetic place = ecefToGeodetic(sum(eye_, distance, direction(azimuth, e)));
      const double slope = distance * detail::dot(localAxes(place).up, rising(azimuth, e));
      const double step = std::clamp((place.height - height_) / slope, -0.2, 0.2);
      if (!std::isfinite(step)) break;
      e -= step;
      if (std::fabs(step) < 1e-15) break;
    }
    return e;
  }

  double height_;
  Vec3 eye_;
  Geodetic foot_;
  bool isAbove_ = true;
  double hiding_ = 0;
  EyeAxes axes_;
};

/// Places are metres from the eye's foot.
class PlaneGround final : public Ground {
 public:
  PlaneGround(const Vec3& normal, double offset, const Vec3& eye) : plane_{normal, offset} {
    Vec3 up = unit(normal);
    height_ = detail::dot(up, eye) + offset / length(normal);
    if (height_ == 0) throw InputError("the eye is on the plane; no outline has a size there");
    if (height_ < 0) up = sum({}, -1, up);
    foot_ = sum(eye, -std::fabs(height_), up);
    height_ = std::fabs(height_);
    const Vec3 other = std::fabs(up.z) > 0.5 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    const Vec3 level = sum(other, -detail::dot(other, up), up);
    const Vec3 aside = unit(level);
    axes_ = {aside, detail::crossOf(up, aside), up};
  }

  std::optional<Seen> hit(const Ray& ray) const override {
    const Hits hits = intersect(ray, plane_);
    if (hits.count == 0 || !std::isfinite(hits.hits[0].distance)) return std::nullopt;
    return Seen{hits.hits[0].point, hits.hits[0].distance};
  }
  std::optional<Limit> farthest(double azimuth, double most) const override {
    constexpr double kFar = 1e15;
    if (!(most > height_)) return std::nullopt;
    if (!std::isfinite(most)) return Limit{sum(foot_, kFar * height_, axes_.level(azimuth)), 0, most};
    const double radius = std::sqrt((most - height_) * (most + height_));
    return Limit{sum(foot_, radius, axes_.level(azimuth)), -std::asin(height_ / most), most, "distance"};
  }
  double azimuthOf(const Vec3& d) const override { return axes_.azimuthOf(d); }
  double turning() const override { return 1; }
  Vec2 placeOf(const Vec3& point) const override {
    const Vec3 from = sum(point, -1, foot_);
    return {detail::dot(from, axes_.aside), detail::dot(from, axes_.ahead)};
  }
  Vec2 way(const Vec2& from, const Vec2& to) const override { return {to.x - from.x, to.y - from.y}; }
  Vec2 scaleAt(const Vec2&) const override { return {1, 1}; }
  double areaBelow(const Vec2& place) const override { return place.y; }
  double areaOf(double sum, double) const override { return std::fabs(sum); }

 private:
  PlaneEquation plane_;
  double height_ = 0;
  Vec3 foot_;
  EyeAxes axes_;
};

}  // namespace

std::unique_ptr<Ground> groundOfHeight(double height, const Vec3& eye) {
  return std::make_unique<HeightGround>(height, eye);
}

std::unique_ptr<Ground> groundOfPlane(const Vec3& normal, double offset, const Vec3& eye) {
  return std::make_unique<PlaneGround>(normal, offset, eye);
}

}  // namespace viewproj::cmd
