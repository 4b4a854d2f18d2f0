// Conventions as data: which way the axes of each space point, and how a matrix is laid out.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace viewproj {

/// Handedness of the world's numbers, as LookAtRH and LookAtLH mean it.
enum class Handedness { right, left };

/// Where x, y, z of view space point: Right, Up or Down, Forward or Back.
enum class ViewAxes { RUB, RUF, RDF };

/// Range of NDC z between near and far.
enum class NdcZ { minusOneToOne, zeroToOne };

/// Where NDC y points in the picture.
enum class NdcY { up, down };

/// Column vectors (M v) or row vectors (v M).
enum class Vectors { column, row };

/// The order in which a matrix's sixteen numbers lie in memory.
enum class Storage { columnMajor, rowMajor };

struct Convention {
  Handedness world = Handedness::right;
  ViewAxes view = ViewAxes::RUB;
  NdcZ ndcZ = NdcZ::minusOneToOne;
  bool reverseZ = false;  ///< near and far exchange their NDC z and their window depth
  NdcY ndcY = NdcY::up;
  Vectors vectors = Vectors::column;
  Storage storage = Storage::columnMajor;

  friend constexpr bool operator==(const Convention&, const Convention&) = default;
};

struct ConventionPreset {
  std::string_view name;
  Convention convention;
};

namespace detail {
/// To add a preset, add its row here and its constant below; tests ask for the rest.
/// Sources: the OpenGL, Direct3D, Vulkan, Metal and WebGPU specifications; Unity's Camera.worldToCameraMatrix and
/// projectionMatrix; Unreal's FReversedZPerspectiveMatrix; OpenCV's calib3d; ps2sdk's create_view_screen.
inline constexpr ConventionPreset kConventionPresets[] = {
    {"opengl", {}},
    {"opengl-lh", {Handedness::left, ViewAxes::RUF}},
    {"d3d", {Handedness::left, ViewAxes::RUF, NdcZ::zeroToOne, false, NdcY::up, Vectors::row, Storage::rowMajor}},
    {"d3d-rh", {Handedness::right, ViewAxes::RUB, NdcZ::zeroToOne, false, NdcY::up, Vectors::row, Storage::rowMajor}},
    {"vulkan", {Handedness::right, ViewAxes::RUB, NdcZ::zeroToOne, false, NdcY::down}},
    {"metal", {Handedness::right, ViewAxes::RUB, NdcZ::zeroToOne}},
    {"webgpu", {Handedness::right, ViewAxes::RUB, NdcZ::zeroToOne}},
    {"unity", {Handedness::left, ViewAxes::RUB}},
    {"unreal", {Handedness::left, ViewAxes::RUF, NdcZ::zeroToOne, true, NdcY::up, Vectors::row, Storage::rowMajor}},
    {"opencv",
     {Handedness::right, ViewAxes::RDF, NdcZ::zeroToOne, false, NdcY::up, Vectors::column, Storage::rowMajor}},
    {"ps2", {Handedness::right, ViewAxes::RDF, NdcZ::zeroToOne, true, NdcY::down, Vectors::row, Storage::rowMajor}},
};

/// A name that is no preset's does not compile.
consteval Convention presetNamed(std::string_view name) {
  for (const ConventionPreset& preset : kConventionPresets)
    if (preset.name == name) return preset.convention;
  throw "no such convention";
}
}  // namespace detail

/// The presets as constants: viewproj::conventions::d3d.
namespace conventions {
inline constexpr Convention opengl = detail::presetNamed("opengl");
inline constexpr Convention openglLh = detail::presetNamed("opengl-lh");
inline constexpr Convention d3d = detail::presetNamed("d3d");
inline constexpr Convention d3dRh = detail::presetNamed("d3d-rh");
inline constexpr Convention vulkan = detail::presetNamed("vulkan");
inline constexpr Convention metal = detail::presetNamed("metal");
inline constexpr Convention webgpu = detail::presetNamed("webgpu");
inline constexpr Convention unity = detail::presetNamed("unity");
inline constexpr Convention unreal = detail::presetNamed("unreal");
inline constexpr Convention opencv = detail::presetNamed("opencv");
inline constexpr Convention ps2 = detail::presetNamed("ps2");
}  // namespace conventions

/// All of them by name; the first is the default.
inline constexpr std::span<const ConventionPreset> conventionPresets() noexcept { return detail::kConventionPresets; }

/// The preset of that name, or nothing.
constexpr std::optional<Convention> conventionPreset(std::string_view name) noexcept {
  for (const ConventionPreset& preset : conventionPresets())
    if (preset.name == name) return preset.convention;
  return std::nullopt;
}

}  // namespace viewproj
