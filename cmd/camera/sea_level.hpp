// The Earth's surface: how far sea level lies above the ellipsoid, and what the Earth hides.
#pragma once

#include <optional>
#include <string>

#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// --geoid: metres, the same everywhere, or the name of a file of GeographicLib. From here on heights with names such
/// as altitude are above sea level. Throws UsageError.
void setGeoid(const std::string& option, const std::string& text);
bool hasGeoid();
/// Metres above the ellipsoid; 0 without --geoid. Any number of threads may call it.
double seaLevelAt(double lat, double lon);

inline constexpr const char* kNeedsGeoid =
    "is above sea level and needs --geoid: its metres above the ellipsoid, or a file of GeographicLib";

/// The height above the ellipsoid of an altitude at the camera. Throws UsageError without --geoid, and fails where the
/// camera is not on the Earth.
double heightOfAltitude(const CameraFile& camera, double altitude);

/// Whether the way from an eye to a point, in ECEF, crosses the surface at sea level. Below that the surface lies a
/// metre below the lower of the two, so that the ground which they stand on hides nothing, but no deeper than the
/// Earth's seas. A weight of 0 is a direction.
bool earthHides(const Vec3& eye, const Vec4& point);

}  // namespace viewproj::cmd
