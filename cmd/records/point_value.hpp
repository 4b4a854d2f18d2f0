// One point as a value of JSON: [x, y, z], {"x": ..., "y": ..., "z": ...} or {"lat": ..., "lon": ..., "height": ...}.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// What an array of three numbers may be.
enum class PointForm : unsigned char {
  none,
  vector,      ///< x, y, z and no place
  point,       ///< x, y, z
  ofTheEarth,  ///< a place as well, so that it is none: objects tell
};

/// Three numbers that may be a place, or not, with a camera on the Earth. way: how to say which.
std::string bareTriple(const std::string& way);
inline constexpr const char* kObjectsSay =
    "{\"lat\": LAT, \"lon\": LON, \"height\": HEIGHT} or {\"x\": X, \"y\": Y, \"z\": Z}";
inline constexpr const char* kNotOnEarth =
    "lat, lon, height need a camera that stands on the Earth: a position by lat, lon, height, or \"world\": \"ecef\"";

/// Whether it has the form of a point, be the numbers what they may: three or four in an array, or the names of an
/// object.
bool isPointValue(std::string_view json);

/// What stands where in an object: the values as written. isPlace: lat, lon, height.
struct PointObject {
  std::array<std::string_view, 3> parts, names;
  bool isPlace = false;
  std::string seaLevel;  ///< the name of a height that may be counted from the sea
};

/// Nothing where the object is no point. Throws RecordError, at 0, where it is two or leaves open which number is
/// meant.
std::optional<PointObject> pointObject(std::string_view json);

}  // namespace viewproj::cmd
