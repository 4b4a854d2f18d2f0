#include "viewproj/convention.hpp"

namespace viewproj {
namespace {

constexpr auto R = Handedness::right;
constexpr auto L = Handedness::left;
constexpr auto RUB = ViewAxes::RUB;
constexpr auto RUF = ViewAxes::RUF;
constexpr auto RDF = ViewAxes::RDF;
constexpr auto NO = NdcZ::minusOneToOne;
constexpr auto ZO = NdcZ::zeroToOne;
constexpr auto up = NdcY::up;
constexpr auto down = NdcY::down;
constexpr auto column = Vectors::column;
constexpr auto row = Vectors::row;
constexpr auto columns = Storage::columnMajor;
constexpr auto rows = Storage::rowMajor;
constexpr Vec3 kUpY{0, 1, 0}, kUpZ{0, 0, 1};

// Sources: the OpenGL, Direct3D, Vulkan, Metal and WebGPU specifications; Unity's Camera.worldToCameraMatrix and
// projectionMatrix; Unreal's FReversedZPerspectiveMatrix; OpenCV's calib3d; ps2sdk's create_view_screen.
// To add a preset, add its row here; tests ask for the rest.
// clang-format off
constexpr ConventionPreset kPresets[] = {
    //             world  view  ndcZ reverseZ ndcY  vectors storage     a pose's, up, a pixel's centre
    {"opengl",    {R,     RUB,  NO,  false,   up,   column, columns}, CameraAxes::RUB},
    {"opengl-lh", {L,     RUF,  NO,  false,   up,   column, columns}, CameraAxes::RUF},
    {"d3d",       {L,     RUF,  ZO,  false,   up,   row,    rows}, CameraAxes::RUF},
    {"d3d-rh",    {R,     RUB,  ZO,  false,   up,   row,    rows}, CameraAxes::RUB},
    {"vulkan",    {R,     RUB,  ZO,  false,   down, column, columns}, CameraAxes::RUB},
    {"metal",     {R,     RUB,  ZO,  false,   up,   column, columns}, CameraAxes::RUB},
    {"webgpu",    {R,     RUB,  ZO,  false,   up,   column, columns}, CameraAxes::RUB},
    {"unity",     {L,     RUB,  NO,  false,   up,   column, columns}, CameraAxes::RUF},
    {"unreal",    {L,     RUF,  ZO,  true,    up,   row,    rows}, CameraAxes::FRU, kUpZ},
    {"opencv",    {R,     RDF,  ZO,  false,   up,   column, rows}, CameraAxes::RDF, kUpY, 0},
    {"ps2",       {R,     RDF,  ZO,  true,    down, row,    rows}, CameraAxes::RDF},
};
// clang-format on

}  // namespace

std::span<const ConventionPreset> conventionPresets() noexcept { return kPresets; }

const ConventionPreset* findPreset(std::string_view name) noexcept {
  for (const ConventionPreset& preset : kPresets)
    if (preset.name == name) return &preset;
  return nullptr;
}

std::optional<Convention> conventionPreset(std::string_view name) noexcept {
  const ConventionPreset* const preset = findPreset(name);
  return preset ? std::optional(preset->convention) : std::nullopt;
}

}  // namespace viewproj
