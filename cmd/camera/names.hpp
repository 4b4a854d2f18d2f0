// The words of camera files and options that select one of a few values.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "viewproj/camera.hpp"
#include "viewproj/convention.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::cmd {

template <class T>
using NameRow = std::pair<std::string_view, T>;

inline constexpr NameRow<Handedness> kWorldNames[] = {{"right", Handedness::right}, {"left", Handedness::left}};
inline constexpr NameRow<ViewAxes> kViewNames[] = {
    {"RUB", ViewAxes::RUB}, {"RUF", ViewAxes::RUF}, {"RDF", ViewAxes::RDF}};
inline constexpr NameRow<NdcZ> kNdcZNames[] = {{"-1..1", NdcZ::minusOneToOne}, {"0..1", NdcZ::zeroToOne}};
inline constexpr NameRow<NdcY> kNdcYNames[] = {{"up", NdcY::up}, {"down", NdcY::down}};
inline constexpr NameRow<Vectors> kVectorsNames[] = {{"column", Vectors::column}, {"row", Vectors::row}};
inline constexpr NameRow<Storage> kStorageNames[] = {{"column-major", Storage::columnMajor},
                                                     {"row-major", Storage::rowMajor}};
inline constexpr NameRow<CameraAxes> kCameraAxesNames[] = {{"RUB", CameraAxes::RUB}, {"RUF", CameraAxes::RUF},
                                                           {"RDF", CameraAxes::RDF}, {"FRU", CameraAxes::FRU},
                                                           {"FLU", CameraAxes::FLU}, {"FRD", CameraAxes::FRD}};
inline constexpr NameRow<Origin> kOriginNames[] = {{"top-left", Origin::topLeft}, {"bottom-left", Origin::bottomLeft}};

/// Named world coordinates: Earth-centred, Earth-fixed metres; x, y, z are east, north, up.
enum class World { any, ecef, enu };
inline constexpr NameRow<World> kWorlds[] = {{"ecef", World::ecef}, {"enu", World::enu}};

/// Three turns about the camera's own axes (0, 1, 2 for x, y, z), as a program lists their angles: the angle of turn i
/// is number listed[i], times sign[i].
struct EulerOrder {
  std::array<std::size_t, 3> axis;
  std::array<std::size_t, 3> listed{0, 1, 2};
  std::array<double, 3> sign{1, 1, 1};
  /// The camera axes of programs that have no others.
  std::optional<CameraAxes> cameraAxes{};
  /// Those of its program, whose world is left-handed; in a right-handed one the turns are of any camera.
  std::optional<CameraAxes> leftHandedAxes{};
};
/// Letters are axes in the order of the turns; rpy is ROS's, unreal FRotator's, opk (omega, phi, kappa) aerial
/// photogrammetry's.
inline constexpr NameRow<EulerOrder> kEulerOrders[] = {
    {"XYZ", {{0, 1, 2}}},
    {"XZY", {{0, 2, 1}}},
    {"YXZ", {{1, 0, 2}}},
    {"YZX", {{1, 2, 0}}},
    {"ZXY", {{2, 0, 1}}},
    {"ZYX", {{2, 1, 0}}},
    {"XYX", {{0, 1, 0}}},
    {"XZX", {{0, 2, 0}}},
    {"YXY", {{1, 0, 1}}},
    {"YZY", {{1, 2, 1}}},
    {"ZXZ", {{2, 0, 2}}},
    {"ZYZ", {{2, 1, 2}}},
    {"rpy", {.axis = {2, 1, 0}, .listed = {2, 1, 0}}},
    {"unity", {.axis = {1, 0, 2}, .listed = {1, 0, 2}, .leftHandedAxes = CameraAxes::RUF}},
    {"unreal", {.axis = {2, 1, 0}, .listed = {1, 0, 2}, .sign = {1, -1, -1}, .cameraAxes = CameraAxes::FRU}},
    {"opk", {.axis = {0, 1, 2}, .cameraAxes = CameraAxes::RUB}},
    {"blender", {.axis = {2, 1, 0}, .listed = {2, 1, 0}, .cameraAxes = CameraAxes::RUB}},
    {"godot", {.axis = {1, 0, 2}, .listed = {1, 0, 2}, .cameraAxes = CameraAxes::RUB}},
};

/// Notes on orders that may be meant for another: Unity and Godot turn in one order, in worlds of different hands.
inline constexpr NameRow<std::string_view> kOrderNotes[] = {
    {"unity",
     "order unity in a right-handed world is Godot's; Unity's own world is left-handed, as --read-as unity reads it"},
    {"XYZ", "order XYZ turns about the camera's own x first, as three.js does; Blender's XYZ is order blender"}};

/// The names of a table.
using Words = std::vector<std::string_view> (*)();
template <const auto& Table>
std::vector<std::string_view> wordsOf() {
  std::vector<std::string_view> names;
  for (const auto& row : Table) names.push_back(row.first);
  return names;
}

/// The row of a name, or null.
template <class Table>
const auto* rowNamed(const Table& table, std::string_view name) {
  const auto row =
      std::find_if(std::begin(table), std::end(table), [&](const auto& each) { return each.first == name; });
  return row == std::end(table) ? nullptr : &*row;
}

/// The value of a name. The table must have it.
template <class Table>
auto valueOf(const Table& table, std::string_view name) {
  return rowNamed(table, name)->second;
}

/// The name of a value. The table must have it.
template <class Table, class T>
std::string_view nameOf(const Table& table, T value) {
  return std::find_if(std::begin(table), std::end(table), [&](const auto& row) { return row.second == value; })->first;
}

inline std::vector<std::string_view> presetNames() {
  std::vector<std::string_view> names;
  for (const ConventionPreset& preset : conventionPresets()) names.push_back(preset.name);
  return names;
}

}  // namespace viewproj::cmd
