// Columns of tables and records that are fields of a camera.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// Other names of a height: geodesy's h, and those that may be above sea level, in any letter case.
inline constexpr std::string_view kHeightNames[] = {"h", "alt", "altitude", "elevation", "ele"};
inline constexpr std::span kSeaLevelNames = std::span(kHeightNames).subspan(1);
bool isSeaLevelName(std::string_view name);
/// Without --geoid, of a height with such a name.
std::string seaLevelNote(std::string_view name);

/// Where the value of a column stands in a camera document: its path, or one that has a short name, such as x, lat, qx,
/// yaw or fovX. Letters and digits count alone, in any case. Empty: it is no field of a camera. isOnEarth: another
/// column is a latitude, so that a height is the position's.
std::string pathOfColumn(std::string_view column, bool isOnEarth);

}  // namespace viewproj::cmd
