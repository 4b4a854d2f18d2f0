#include "camera/sea_level.hpp"

#include <algorithm>
#include <variant>

#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {
namespace {

/// Set before any other thread begins.
std::variant<std::monostate, double, Geoid> seaLevel;

}  // namespace

void setGeoid(const std::string& option, const std::string& text) {
  constexpr double kLargest = 110;  // 107 m south of India
  const auto number = parseNumber(text);
  if (number && !(std::fabs(*number) <= kLargest))
    throw UsageError(option + " " + text + ": sea level is at most 107 m above or below the ellipsoid");
  try {
    if (number)
      seaLevel = *number;
    else
      seaLevel = Geoid(text);
  } catch (const CameraError& e) {
    throw UsageError(option + " " + text + ": expected metres, or a file as egm96-5.pgm; " + e.message());
  }
}

bool hasGeoid() { return seaLevel.index() != 0; }

double seaLevelAt(double lat, double lon) {
  if (const auto* const geoid = std::get_if<Geoid>(&seaLevel)) return (*geoid)({lat, lon, 0});
  const auto* const number = std::get_if<double>(&seaLevel);
  return number ? *number : 0;
}

double heightOfAltitude(const CameraFile& camera, double altitude) {
  if (!hasGeoid()) throw UsageError("--altitude " + formatNumber(altitude) + " " + kNeedsGeoid);
  if (!camera.worldIsEcef) camera.fail("--altitude needs a camera on the Earth; --height is the plane z = H");
  const Geodetic place = ecefToGeodetic(camera.pose ? camera.pose->eye() : Vec3{});
  return altitude + seaLevelAt(place.lat, place.lon);
}

bool earthHides(const Vec3& eye, const Vec4& p) {
  const bool isDirection = p.w == 0;
  const Vec3 to = isDirection ? Vec3{p.x, p.y, p.z} : scaled({p.x, p.y, p.z}, 1 / p.w);
  const Geodetic from = ecefToGeodetic(eye);
  const double lower = isDirection ? from.height : std::min(from.height, ecefToGeodetic(to).height);
  constexpr double kDeepest = -12e3;  // metres, lower than any ground: what lies deeper is in the Earth
  const double up = std::max(std::min(seaLevelAt(from.lat, from.lon), lower - 1), kDeepest);
  const double a = kWgs84.equatorial + up, b = kWgs84.polar + up;
  const auto shrunk = [&](const Vec3& v) { return Vec3{v.x / a, v.y / a, v.z / b}; };
  const Vec3 start = shrunk(eye), way = isDirection ? shrunk(to) : sum(shrunk(to), -1, start);
  const double nearest =
      std::clamp(-detail::dot(start, way) / detail::dot(way, way), 0.0, isDirection ? detail::kInfinity : 1.0);
  return length(sum(start, nearest, way)) < 1;
}

}  // namespace viewproj::cmd
