// Where a ray crosses a height above the Earth.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "numbers/vectors.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj {
namespace {

/// The height above the surface at a point of the ray, and its slope along the ray.
struct Rise {
  double height, slope;
};

class Line {
 public:
  Line(const Ray& ray, double height) : ray_(ray), height_(height) {}

  Rise at(double t) const noexcept {
    const Vec3 &o = ray_.origin, &d = ray_.direction;
    const Geodetic place = ecefToGeodetic({o.x + t * d.x, o.y + t * d.y, o.z + t * d.z});
    constexpr double kRadian = std::numbers::pi / 180;
    const double lat = place.lat * kRadian, lon = place.lon * kRadian, across = std::cos(lat);
    return {place.height - height_, across * (std::cos(lon) * d.x + std::sin(lon) * d.y) + std::sin(lat) * d.z};
  }

  /// Where the line is nearest to the ellipsoid, approximately.
  double lowest() const noexcept {
    constexpr double kStart = 1e5, kNear = 1e-5;
    const Vec3 &o = ray_.origin, &d = ray_.direction;
    const double middle = -(o.x * d.x + o.y * d.y + o.z * d.z);
    double low = middle - kStart, high = middle + kStart;
    while (at(low).slope > 0) low -= high - low;
    while (at(high).slope < 0) high += high - low;
    while (high - low > kNear) {
      const double t = low + (high - low) / 2;
      if (t <= low || t >= high) break;
      (at(t).slope < 0 ? low : high) = t;
    }
    return low + (high - low) / 2;
  }

  /// The crossing between a point below the surface and the outside, in direction 1 or -1.
  double crossing(double below, double direction) const noexcept {
    double step = 1e6, above = below + direction * step;
    while (at(above).height < 0) above = below + direction * (step *= 2);
    double t = above;
    for (int steps = 1;; ++steps) {
      const Rise rise = at(t);
      (rise.height < 0 ? below : above) = t;
      const double next = t - rise.height / rise.slope;
      const bool isBetween = (next - below) * (next - above) < 0;
      const double bounded = isBetween ? next : below + (above - below) / 2;
      if (std::fabs(bounded - t) < 1e-9 || bounded == t || steps == 100) return bounded;
      t = bounded;
    }
  }

 private:
  const Ray& ray_;
  double height_;
};

}  // namespace

HeightCrossings crossingsOfHeight(const Ray& ray, double height) noexcept {
  HeightCrossings result;
  constexpr double kFarthest = 1e15;
  using namespace detail;
  if (!isFinite(ray.origin) || !isFinite(ray.direction) || !(maxAbs(ray.origin) < kFarthest)) return result;
  const Vec3& d = ray.direction;
  if (!(std::fabs(d.x * d.x + d.y * d.y + d.z * d.z - 1) < 1e-6)) return result;
  if (!(height >= kLeastCrossedHeight && height < kFarthest)) return result;
  const Line line(ray, height);
  const double lowest = line.lowest();
  if (!(line.at(lowest).height <= 0)) return result;
  for (const double direction : {-1.0, 1.0}) {
    const double distance = line.crossing(lowest, direction);
    if (distance >= -kCrossingBound)
      result.distances[static_cast<std::size_t>(result.count++)] = std::max(distance, 0.0);
  }
  return result;
}

}  // namespace viewproj
