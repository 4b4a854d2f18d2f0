// Columns of tables and records that are fields of a camera.
#pragma once

#include <string>
#include <string_view>

namespace viewproj::cmd {

/// Where the value of a column stands in a camera document: its path, or one that has a short name, such as x, lat, qx,
/// yaw or fovX. Empty: it is no field of a camera. isOnEarth: another column is a latitude, so that a height is the
/// position's.
std::string pathOfColumn(std::string_view column, bool isOnEarth);

}  // namespace viewproj::cmd
