#include "camera/field_columns.hpp"

#include <algorithm>
#include <iterator>

#include "camera/fields.hpp"
#include "camera/sea_level.hpp"
#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// Paths, and the other names of each, by their letters and digits.
constexpr std::string_view kShort[][2] = {{"position.x", "x"},
                                          {"position.y", "y"},
                                          {"position.z", "z"},
                                          {"position.lat", "lat latitude"},
                                          {"position.lon", "lon lng longitude"},
                                          {"rotation.x", "qx"},
                                          {"rotation.y", "qy"},
                                          {"rotation.z", "qz"},
                                          {"rotation.w", "qw"},
                                          {"heading", "yaw azimuth"},
                                          {"projection.fx", "flx focalx"},
                                          {"projection.fy", "fly focaly"},
                                          {"projection.fovX", "hfov"},
                                          {"projection.fovY", "vfov"},
                                          {"projection.fovDiagonal", "dfov"},
                                          {"projection.cx", "ppx u0 principalpointx"},
                                          {"projection.cy", "ppy v0 principalpointy"}};
/// Names that may be of something else: only their whole path is a camera's.
constexpr std::string_view kAmbiguous = "name schema type left right bottom top width height matrix pixels origin";

}  // namespace

bool isSeaLevelName(std::string_view name) {
  return std::any_of(std::begin(kSeaLevelNames), std::end(kSeaLevelNames),
                     [&](std::string_view known) { return sameButForCase(known, name); });
}

std::string seaLevelNote(std::string_view name) {
  return inQuotes(name) + (hasGeoid() ? " is taken as height above sea level, because of --geoid; where it is an RTK "
                                        "receiver's above the ellipsoid, --set position.height=… says so"
                                      : " is taken as height above the ellipsoid; heights above sea level differ from "
                                        "it by up to 107 m");
}

std::string pathOfColumn(std::string_view column, bool isOnEarth) {
  const std::string letters = lettersOf(column);
  const auto isCalled = [&](std::string_view name) { return !name.empty() && lettersOf(name) == letters; };
  for (const auto& [path, names] : kShort)
    if (isAmong(letters, names)) return std::string(path);
  const bool isSeaLevel = isSeaLevelName(column);
  if (isSeaLevel || letters == "height" || (letters == "h" && isOnEarth))
    return !isOnEarth ? "" : isSeaLevel && hasGeoid() ? "position.altitude" : "position.height";
  if (isAmong(letters, kAmbiguous)) return "";
  if (isAmong(letters, "projection viewport convention")) return letters;
  for (const Field& field : kFields)
    if (isCalled(field.path) || isCalled(field.alias)) return std::string(field.path);
  for (const Field& field : kFields)
    if ((field.types != 0 || topName(field) == "viewport") && isCalled(field.path.substr(field.path.rfind('.') + 1)))
      return std::string(field.path);
  // A member of a field's value.
  for (const Field& field : kFields) {
    const std::string members = "x y z w " + std::string(rowOf(field.kind).members);
    for (const std::string_view member : wordsIn(members))
      for (const std::string_view name : {field.path, field.alias})
        if (!name.empty() && isCalled(std::string(name) + std::string(member)))
          return std::string(field.path) + "." + std::string(member);
  }
  // The unit that the field has anyway.
  for (const std::string_view unit : {"_deg", "_m", "_px", "_mm"})
    if (column.ends_with(unit)) return pathOfColumn(column.substr(0, column.size() - unit.size()), isOnEarth);
  return "";
}

}  // namespace viewproj::cmd
