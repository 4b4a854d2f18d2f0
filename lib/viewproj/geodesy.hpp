// Places on the Earth: latitude, longitude and height to world coordinates and back, and cameras that stand there.
//
// WGS84 throughout. The world is ECEF: Earth-centred and turning with it, metres, right-handed, x towards latitude and
// longitude 0, z towards the north pole. Conversions are GeographicLib's (Karney, "Geodesics on an ellipsoid of
// revolution", 2011, appendix B); rotations are our own, because a double would not hold them.
#pragma once

#include "viewproj/camera.hpp"

namespace viewproj {

struct Geodetic {
  double lat = 0;     ///< degrees, from -90 to 90
  double lon = 0;     ///< degrees east, any finite number
  double height = 0;  ///< metres above the ellipsoid, which sea level leaves by up to 107 m
};

/// Finite, and lat from -90 to 90.
bool isPlace(const Geodetic& place) noexcept;

/// How far in metres either conversion may be from the true place, within 5000 km of the ellipsoid; farther out it
/// grows with the distance from the Earth's centre. (GeographicLib states 7 nm; rounding lat and lon adds the rest.)
inline constexpr double kGeodesyBound = 10e-9;

/// NaN for what is no place. Poles and antimeridian are places like others: at a pole x and y are 0 whatever lon is.
Vec3 geodeticToEcef(const Geodetic& place) noexcept;

/// lon from -180 to 180. The nearest point of the ellipsoid counts: at the centre of the Earth that is the north pole.
/// NaN where a coordinate is not finite.
Geodetic ecefToGeodetic(const Vec3& point) noexcept;

/// How a camera is turned, in degrees: heading clockwise from north, pitch above the horizon, roll with the right side
/// down. With east, north and up at the eye, the level camera of a heading looks along
///   forward = north cos(heading) + east sin(heading);
/// pitch turns forward towards up, then roll turns right towards down. (As Cesium's Camera has it; its
/// HeadingPitchRoll of a model counts heading from the model's x axis, east.)
struct HeadingPitchRoll {
  double heading = 0;  ///< any finite number
  double pitch = 0;    ///< from -90 to 90
  double roll = 0;     ///< any finite number
};

// These throw CameraError, naming "position.lat" and the like, where something is out of range. The eye is the doubles
// of geodeticToEcef, exact from there on; axes come out within 2^-100, and in the exact rows within kTurnedRowBound.

/// East, north and up are those of lat and lon: at a pole, as everywhere, lon says where east is.
Pose poseFromHeadingPitchRoll(const Geodetic& position, const HeadingPitchRoll& turned);

/// Up in the picture is away from the ellipsoid. Throws where target is straight above or below position, which leaves
/// open where up is.
Pose lookAtPlace(const Geodetic& position, const Geodetic& target);

/// lookAt and lookAlong of ECEF positions. Up in the picture is away from the ellipsoid at a place: its normal there,
/// to more digits than doubles have. Throws as those two, naming "up" for what is no place.
Pose lookAtOnEarth(const Vec3& position, const Vec3& target, const Geodetic& upFrom, Handedness world);
Pose lookAlongOnEarth(const Vec3& position, const Vec3& direction, const Geodetic& upFrom, Handedness world);

/// The outward normal of the ellipsoid at a place, of unit length, rounded; NaN for what is no place.
Vec3 ellipsoidNormal(const Geodetic& place) noexcept;

}  // namespace viewproj
