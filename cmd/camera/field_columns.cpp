#include "camera/field_columns.hpp"

#include <algorithm>
#include <iterator>

#include "camera/fields.hpp"
#include "camera/sea_level.hpp"

namespace viewproj::cmd {
namespace {

/// Paths, and the short names of each.
constexpr std::string_view kShort[][2] = {{"position.x", "x"},
                                          {"position.y", "y"},
                                          {"position.z", "z"},
                                          {"position.lat", "lat latitude"},
                                          {"position.lon", "lon lng longitude"},
                                          {"rotation.x", "qx"},
                                          {"rotation.y", "qy"},
                                          {"rotation.z", "qz"},
                                          {"rotation.w", "qw"},
                                          {"heading", "yaw"}};
/// Members of the projection whose names have no other meaning.
constexpr std::string_view kLens =
    "fovY fovX fovDiagonal focalLength sensorWidth sensorHeight sensorDiagonal fx fy cx cy near far";

bool isOneOf(std::string_view name, std::string_view words) {
  const std::vector<std::string_view> all = wordsIn(words);
  return std::find(all.begin(), all.end(), name) != all.end();
}

}  // namespace

std::string pathOfColumn(std::string_view column, bool isOnEarth) {
  for (const auto& [path, names] : kShort)
    if (isOneOf(column, names)) return std::string(path);
  const bool isSeaLevel = isOneOf(column, "alt altitude elevation ele");
  if (isSeaLevel || column == "height")
    return !isOnEarth ? "" : isSeaLevel && hasGeoid() ? "position.altitude" : "position.height";
  if (isOneOf(column, kLens)) return "projection." + std::string(column);
  if (column == "name" || column == "$schema") return "";
  const std::size_t dot = std::min(column.rfind('.'), column.size());
  const bool isPart = isOneOf(column.substr(dot), ".x .y .z .w .lat .lon .height .altitude");
  const auto isField = [&](const Field& field) {
    return field.path == column || (isPart && field.path == column.substr(0, dot));
  };
  const bool isWhole = column == "projection" || column == "viewport";
  return isWhole || std::any_of(std::begin(kFields), std::end(kFields), isField) ? std::string(column) : "";
}

}  // namespace viewproj::cmd
