#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geoid.hpp>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <string>

#include "camera/require.hpp"
#include "camera/turned_axes.hpp"
#include "geodesy/normal.hpp"

namespace viewproj {

using namespace detail;
namespace {

enum : std::size_t { kRight, kUpward, kForward };

/// The axes at a place: right is east, forward is north.
TurnedAxes eastUpNorth(const Geodetic& place) noexcept {
  TurnedAxes axes({{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}});
  axes.turn(kRight, kUpward, place.lon);
  axes.turn(kForward, kUpward, place.lat);
  return axes;
}

void requirePlace(const Geodetic& place, const std::string& field) {
  const auto require = [&](bool good, const char* part, const char* message) {
    if (!good) throw CameraError(field + "." + part, message);
  };
  require(place.lat >= -90 && place.lat <= 90, "lat", "must be from -90 to 90 degrees");
  require(std::isfinite(place.lon), "lon", "must be a finite number of degrees");
  require(std::isfinite(place.height), "height", "must be a finite number of metres");
}

/// The pose of a camera whose right, up and forward are these axes before the turns.
Pose turned(const Vec3& eye, TurnedAxes axes, const HeadingPitchRoll& angles) {
  requireTurn(angles.heading, "heading");
  requireTurn(angles.roll, "roll");
  if (!(std::fabs(angles.pitch.value) <= (angles.pitch.isRadians ? std::numbers::pi : 180)))
    throw CameraError("pitch", "must be from -180 to 180 degrees");
  axes.turn(kRight, kForward, angles.heading);
  axes.turn(kUpward, kForward, angles.pitch);
  axes.turn(kRight, kUpward, angles.roll);
  return poseFromAxes(eye, {axes.axis(kRight), axes.axis(kUpward), axes.axis(kForward)});
}

bool haveSameNormal(const Geodetic& a, const Geodetic& b) noexcept {
  if (a.lat != b.lat) return false;
  const double first = std::remainder(a.lon, 360), second = std::remainder(b.lon, 360);
  return first == second || (std::fabs(first) == 180 && second == -first) || std::fabs(a.lat) == 90;
}

}  // namespace

bool isPlace(const Geodetic& place) noexcept {
  return place.lat >= -90 && place.lat <= 90 && std::isfinite(place.lon) && std::isfinite(place.height);
}

double placeError(const Vec3& point) noexcept {
  constexpr double kFarthest = 1.1e7;  // from the Earth's centre, where kGeodesyBound holds
  return kGeodesyBound * std::max(1.0, length(point) / kFarthest);
}

Vec3 geodeticToEcef(const Geodetic& place) noexcept {
  if (!isPlace(place)) return {kNaN, kNaN, kNaN};
  Vec3 p;
  GeographicLib::Geocentric::WGS84().Forward(place.lat, place.lon, place.height, p.x, p.y, p.z);
  return {p.x + 0.0, p.y + 0.0, p.z + 0.0};  // -0 becomes 0
}

Geodetic ecefToGeodetic(const Vec3& point) noexcept {
  if (!isFinite(point)) return {kNaN, kNaN, kNaN};
  Geodetic place;
  GeographicLib::Geocentric::WGS84().Reverse(point.x, point.y, point.z, place.lat, place.lon, place.height);
  return {place.lat + 0.0, place.lon + 0.0, place.height + 0.0};
}

struct Geoid::Grid {
  Grid(const std::string& name, const std::string& folder) : heights(name, folder) {}
  mutable std::mutex reading;
  GeographicLib::Geoid heights;
};

Geoid::Geoid(const std::string& file) {
  const std::string ending = ".pgm";
  if (!file.ends_with(ending)) throw CameraError("geoid", "the name of a file ends in .pgm");
  const std::size_t slash = file.find_last_of("/\\");
  const std::string folder = slash == std::string::npos ? "." : file.substr(0, slash + 1);
  const std::string name = file.substr(slash + 1);
  try {
    grid_ = shareNew<Grid>(name.substr(0, name.size() - ending.size()), folder);
  } catch (const std::exception& e) {
    throw CameraError("geoid", e.what());
  }
}

double Geoid::operator()(const Geodetic& place) const try {
  const std::lock_guard lock(grid_->reading);
  return grid_->heights(place.lat, place.lon);
} catch (const std::exception& e) {
  throw CameraError("geoid", e.what());
}

FineVec3 detail::exactNormal(const Geodetic& place) noexcept {
  if (!isPlace(place)) return {kNaN, kNaN, kNaN};
  return eastUpNorth(place).axis(kUpward);
}

Pose poseFromHeadingPitchRoll(const Geodetic& position, const HeadingPitchRoll& angles) {
  requirePlace(position, "position");
  const Vec3 eye = geodeticToEcef(position);
  return withError(turned(eye, eastUpNorth(position), angles), {.eye = placeError(eye)});
}

Pose poseInEastNorthUp(const Vec3& position, const HeadingPitchRoll& angles) {
  return turned(position, TurnedAxes({{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}}), angles);
}

PoseError lookAtError(const Pose& pose, const Vec3& target, const Vec3& up, double eyeError,
                      double targetError) noexcept {
  const Vec3 eye = pose.eye(), above = pose.up();
  // The direction turns by this; the axes around it by as much, divided by the sine between direction and up.
  const double turn = (eyeError + targetError) / length({target.x - eye.x, target.y - eye.y, target.z - eye.z});
  const double angle = 1.01 * turn * (1 + 1 / (above.x * up.x + above.y * up.y + above.z * up.z));
  return {eyeError, turn == 0 ? 0 : turn < 0.01 && angle > 0 ? angle : kInfinity};
}

Pose lookAtPlace(const Geodetic& position, const Geodetic& target) {
  requirePlace(position, "position");
  requirePlace(target, "target");
  if (haveSameNormal(position, target))
    throw CameraError("target", position.height == target.height
                                    ? "is the camera's own position: there is no direction to look in"
                                    : "is straight above or below the camera, so it does not say which way is up; give "
                                      "a heading and a pitch, or an up");
  const Vec3 eye = geodeticToEcef(position), at = geodeticToEcef(target);
  const Pose pose = lookAtWithUp(eye, at, exactNormal(position), Handedness::right);
  return withError(pose, lookAtError(pose, at, ellipsoidNormal(position), placeError(eye), placeError(at)));
}

Pose lookAtOnEarth(const Vec3& position, const Vec3& target, const Geodetic& upFrom, Handedness world) {
  return lookAtWithUp(position, target, exactNormal(upFrom), world);
}

Pose lookAlongOnEarth(const Vec3& position, const Vec3& direction, const Geodetic& upFrom, Handedness world) {
  return lookAlongWithUp(position, direction, exactNormal(upFrom), world);
}

Vec3 ellipsoidNormal(const Geodetic& place) noexcept { return rounded(rounded(exactNormal(place))); }

}  // namespace viewproj
