// Conventions as data: the directions of each space's axes, and the layout of a matrix.
//
// Example:
//   Convention reversed = conventions::vulkan;
//   reversed.reverseZ = true;
//   std::printf("%d", reversed.ndcZ == NdcZ::zeroToOne && reversed.ndcY == NdcY::down);  // prints 1
#pragma once

#include <span>
#include <string_view>

#include "viewproj/vectors.hpp"

namespace viewproj {

/// Handedness of the world's coordinates, as in LookAtRH and LookAtLH.
enum class Handedness { right, left };

/// The directions of x, y, z in view space: Right, Up or Down, Forward or Back.
enum class ViewAxes { RUB, RUF, RDF };

/// Range of NDC z between near and far.
enum class NdcZ { minusOneToOne, zeroToOne };

/// The direction of NDC y in the picture.
enum class NdcY { up, down };

/// Column vectors (M v) or row vectors (v M).
enum class Vectors { column, row };

/// The order of a matrix's sixteen numbers in memory.
enum class Storage { columnMajor, rowMajor };

struct Convention {
  Handedness world = Handedness::right;
  ViewAxes view = ViewAxes::RUB;
  NdcZ ndcZ = NdcZ::minusOneToOne;
  bool reverseZ = false;  ///< swaps near and far in NDC z and in window depth
  NdcY ndcY = NdcY::up;
  Vectors vectors = Vectors::column;
  Storage storage = Storage::columnMajor;

  friend constexpr bool operator==(const Convention&, const Convention&) = default;
};

/// The directions of x, y, z of a rotation or pose matrix: Right, Left, Up, Down, Forward, Back. FLU is that of ROS,
/// Gazebo and lidars, FRD that of aircraft.
enum class CameraAxes { RUB, RUF, RDF, FRU, FLU, FRD };

/// A named convention, with the usual defaults of the programs that use it. One that differs is made from a copy:
///   Convention reversed = conventions::vulkan;
///   reversed.reverseZ = true;
struct ConventionPreset {
  std::string_view name;
  Convention convention;
  CameraAxes cameraAxes = CameraAxes::RUB;  ///< axes of poses
  Vec3 up{0, 1, 0};                         ///< the world's up
  double pixelCenter = 0.5;                 ///< of pixels in viewports

  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr operator const Convention&() const noexcept { return convention; }
};

namespace detail {
/// To add a preset, add its row here and its constant below; tests report what else is missing. Sources: the OpenGL,
/// Direct3D, Vulkan, Metal and WebGPU specifications; Unity's Camera.worldToCameraMatrix and projectionMatrix; Unreal's
/// FReversedZPerspectiveMatrix; OpenCV's calib3d; ps2sdk's create_view_screen. If y of view space points down, so does
/// y of the world.
// clang-format off
inline constexpr Handedness kR = Handedness::right, kL = Handedness::left;
inline constexpr ViewAxes kRUB = ViewAxes::RUB, kRUF = ViewAxes::RUF, kRDF = ViewAxes::RDF;
inline constexpr NdcZ kNO = NdcZ::minusOneToOne, kZO = NdcZ::zeroToOne;
inline constexpr NdcY kUp = NdcY::up, kDown = NdcY::down;
inline constexpr Vectors kColumn = Vectors::column, kRow = Vectors::row;
inline constexpr Storage kColumns = Storage::columnMajor, kRows = Storage::rowMajor;
inline constexpr ConventionPreset kConventionPresets[] = {
    //             world view  ndcZ reverseZ ndcY  vectors storage     axes of poses, up, pixelCenter
    {"opengl",    {kR,   kRUB, kNO, false,   kUp,   kColumn, kColumns}, CameraAxes::RUB},
    {"opengl-lh", {kL,   kRUF, kNO, false,   kUp,   kColumn, kColumns}, CameraAxes::RUF},
    {"d3d",       {kL,   kRUF, kZO, false,   kUp,   kRow,    kRows}, CameraAxes::RUF},
    {"d3d-rh",    {kR,   kRUB, kZO, false,   kUp,   kRow,    kRows}, CameraAxes::RUB},
    {"vulkan",    {kR,   kRUB, kZO, false,   kDown, kColumn, kColumns}, CameraAxes::RUB},
    {"metal",     {kR,   kRUB, kZO, false,   kUp,   kColumn, kColumns}, CameraAxes::RUB},
    {"webgpu",    {kR,   kRUB, kZO, false,   kUp,   kColumn, kColumns}, CameraAxes::RUB},
    {"unity",     {kL,   kRUB, kNO, false,   kUp,   kColumn, kColumns}, CameraAxes::RUF},
    {"unreal",    {kL,   kRUF, kZO, true,    kUp,   kRow,    kRows}, CameraAxes::FRU, {0, 0, 1}},
    {"opencv",    {kR,   kRDF, kZO, false,   kUp,   kColumn, kRows}, CameraAxes::RDF, {0, -1, 0}, 0},
    {"ps2",       {kR,   kRDF, kZO, true,    kDown, kRow,    kRows}, CameraAxes::RDF, {0, -1, 0}},
};
// clang-format on

/// Never defined. Calling it makes presetNamed fail to compile for an unknown name.
const ConventionPreset& noSuchPreset();
consteval const ConventionPreset& presetNamed(std::string_view name) {
  for (const ConventionPreset& preset : kConventionPresets)
    if (preset.name == name) return preset;
  return noSuchPreset();
}
}  // namespace detail

/// The presets as constants, such as conventions::d3d. Each converts to a Convention.
namespace conventions {
inline constexpr const ConventionPreset& opengl = detail::presetNamed("opengl");
inline constexpr const ConventionPreset& openglLh = detail::presetNamed("opengl-lh");
inline constexpr const ConventionPreset& d3d = detail::presetNamed("d3d");
inline constexpr const ConventionPreset& d3dRh = detail::presetNamed("d3d-rh");
inline constexpr const ConventionPreset& vulkan = detail::presetNamed("vulkan");
inline constexpr const ConventionPreset& metal = detail::presetNamed("metal");
inline constexpr const ConventionPreset& webgpu = detail::presetNamed("webgpu");
inline constexpr const ConventionPreset& unity = detail::presetNamed("unity");
inline constexpr const ConventionPreset& unreal = detail::presetNamed("unreal");
inline constexpr const ConventionPreset& opencv = detail::presetNamed("opencv");
inline constexpr const ConventionPreset& ps2 = detail::presetNamed("ps2");
}  // namespace conventions

/// All presets; the first is the default.
inline constexpr std::span<const ConventionPreset> conventionPresets() noexcept { return detail::kConventionPresets; }

/// The preset of that name, or null.
constexpr const ConventionPreset* findPreset(std::string_view name) noexcept {
  for (const ConventionPreset& preset : conventionPresets())
    if (preset.name == name) return &preset;
  return nullptr;
}

}  // namespace viewproj
