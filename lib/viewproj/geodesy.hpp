// Places on the Earth: latitude, longitude and height to world coordinates and back, and cameras at such places.
//
// The ellipsoid is WGS84. The world is ECEF: Earth-centred, turning with the Earth, metres, right-handed, x towards
// latitude and longitude 0, z towards the north pole. Conversions are GeographicLib's (Karney, "Geodesics on an
// ellipsoid of revolution", 2011, appendix B). Rotations are computed here, to more digits than doubles have.
//
// A component of its own: link viewproj::geodesy, which brings GeographicLib. In pkg-config: viewproj-geodesy.
//
// Example:
//   const Pose pose = poseFromHeadingPitchRoll({.lat = 0, .lon = 0, .height = 100}, {.heading = 90});
//   const Geodetic place = ecefToGeodetic(pose.eye());
//   std::printf("%.0f, %.0f m up, looking %g east", pose.eye().x, place.height, pose.forward().y);
//   // prints 6378237, 100 m up, looking 1 east
#pragma once

#include <array>
#include <string>

#include "viewproj/screen.hpp"

namespace viewproj {

struct Geodetic {
  double lat = 0;     ///< degrees, from -90 to 90
  double lon = 0;     ///< degrees east, any finite number
  double height = 0;  ///< metres above the ellipsoid, not above sea level (up to 107 m apart)
};

/// Whether all are finite and lat is from -90 to 90.
bool isPlace(const Geodetic& place) noexcept;

/// Largest error of either conversion in metres, within 5000 km of the ellipsoid. Farther out it grows with the
/// distance from the Earth's centre. (GeographicLib states 7 nm; rounding lat and lon adds the rest.)
inline constexpr double kGeodesyBound = 10e-9;

/// The same bound for a point: kGeodesyBound, or farther out its share of the distance from the Earth's centre.
double placeError(const Vec3& point) noexcept;

/// NaN if place is invalid. Poles and the antimeridian are ordinary places: at a pole x and y are 0 for every lon.
Vec3 geodeticToEcef(const Geodetic& place) noexcept;

/// The place above or below the nearest point of the ellipsoid, with lon from -180 to 180. The Earth's centre gives the
/// north pole. NaN if a coordinate is not finite.
Geodetic ecefToGeodetic(const Vec3& point) noexcept;

/// How far sea level lies above the ellipsoid: a grid in a file of GeographicLib (egm96-5.pgm, egm2008-1.pgm; its tool
/// geographiclib-get-geoids fetches them), interpolated by its cubic rule. A height above the ellipsoid is a height
/// above sea level plus this.
///
///   const Geoid geoid("/usr/share/GeographicLib/geoids/egm96-5.pgm");
///   Geodetic summit{45.8326, 6.8652, 4806};                        // above sea level
///   summit.height += geoid(summit);
class Geoid {
 public:
  /// Throws CameraError naming "geoid" if there is no such file, or it is none.
  explicit Geoid(const std::string& file);
  /// Metres, at any height; NaN for no place. Reads the file, one thread at a time. Throws CameraError naming "geoid"
  /// if it cannot be read.
  double operator()(const Geodetic& place) const;

 private:
  struct Grid;
  detail::Shared<Grid> grid_;
};

/// Orientation of a camera in degrees: heading clockwise from north, pitch above the horizon, roll with the right side
/// down. With east, north and up at the eye, a level camera looks along
///   forward = north cos(heading) + east sin(heading);
/// Pitch turns forward towards up, then roll turns right towards down. This is the definition of Cesium's Camera.
/// Cesium's HeadingPitchRoll of a model counts heading from the model's x axis, east.
struct HeadingPitchRoll {
  Angle heading = 0;  ///< any finite number up to 1e6 radians
  Angle pitch = 0;    ///< from -180 to 180 degrees; beyond 90 the camera is upside down
  Angle roll = 0;     ///< as heading
};

// These throw a CameraError that names the wrong field, such as "position.lat". The eye is the result of
// geodeticToEcef: numbers are computed as if it were exact, and Pose::error says how far it may be from the place. Axes
// are within 2^-100, and within kTurnedRowBound in exact arithmetic.

/// East, north and up depend on lat and lon. At a pole, too, lon defines east.
Pose poseFromHeadingPitchRoll(const Geodetic& position, const HeadingPitchRoll& angles);

/// The same in a world whose x, y, z are east, north and up, such as a map grid: heading is counted from its north.
Pose poseInEastNorthUp(const Vec3& position, const HeadingPitchRoll& angles);

/// Up in the picture points away from the ellipsoid. Throws if target is straight above or below position, because up
/// would be undefined.
Pose lookAtPlace(const Geodetic& position, const Geodetic& target);

/// lookAt and lookAlong with ECEF positions. Up is the outward normal of the ellipsoid at upFrom, to more digits than
/// doubles have. Throw like lookAt and lookAlong; an invalid upFrom is named "up".
Pose lookAtOnEarth(const Vec3& position, const Vec3& target, const Geodetic& upFrom, Handedness world);
Pose lookAlongOnEarth(const Vec3& position, const Vec3& direction, const Geodetic& upFrom, Handedness world);

/// The error of a pose that looks from its eye at target with this up, a unit vector, if its eye and its target
/// may be so far from the true ones.
PoseError lookAtError(const Pose& pose, const Vec3& target, const Vec3& up, double eyeError,
                      double targetError) noexcept;

/// The outward unit normal of the ellipsoid at a place, rounded. NaN if place is invalid.
Vec3 ellipsoidNormal(const Geodetic& place) noexcept;

// ---- Heights along a ray

/// The distances along a ray, 0 or more, where it has the given height above the ellipsoid: up to two, nearest first.
struct HeightCrossings {
  std::array<double, 2> distances{};
  int count = 0;
};

inline constexpr double kLeastCrossedHeight = -1e6;

/// Finds crossings with the surface of constant height, which is not an ellipsoid: at each, the height is within
/// kCrossingBound of the given one. A ray that begins within the bound of the surface begins on it. None for heights
/// below kLeastCrossedHeight, and for a ray that is not finite or not of unit direction. Method: along a line, the
/// distance to a convex body has one minimum, found by bisection of its slope, normal . direction. On each side of it,
/// Newton's method is kept between bounds. For height 0, intersect(ray, kWgs84) of scene.hpp is ten times faster.
HeightCrossings crossingsOfHeight(const Ray& ray, double height) noexcept;
inline constexpr double kCrossingBound = 1e-7;  ///< metres, for rays that begin within 5000 km of the ellipsoid

}  // namespace viewproj
