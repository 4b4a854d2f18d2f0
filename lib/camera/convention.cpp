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

// Sources: the OpenGL, Direct3D, Vulkan, Metal and WebGPU specifications; Unity's Camera.worldToCameraMatrix and
// projectionMatrix; Unreal's FReversedZPerspectiveMatrix; OpenCV's calib3d; ps2sdk's create_view_screen.
// To add a preset, add its row here; tests ask for the rest.
// clang-format off
constexpr ConventionPreset kPresets[] = {
    //             world  view  ndcZ reverseZ ndcY  vectors storage
    {"opengl",    {R,     RUB,  NO,  false,   up,   column, columns}},
    {"opengl-lh", {L,     RUF,  NO,  false,   up,   column, columns}},
    {"d3d",       {L,     RUF,  ZO,  false,   up,   row,    rows}},
    {"d3d-rh",    {R,     RUB,  ZO,  false,   up,   row,    rows}},
    {"vulkan",    {R,     RUB,  ZO,  false,   down, column, columns}},
    {"metal",     {R,     RUB,  ZO,  false,   up,   column, columns}},
    {"webgpu",    {R,     RUB,  ZO,  false,   up,   column, columns}},
    {"unity",     {L,     RUB,  NO,  false,   up,   column, columns}},
    {"unreal",    {L,     RUF,  ZO,  true,    up,   row,    rows}},
    {"opencv",    {R,     RDF,  ZO,  false,   up,   column, rows}},
    {"ps2",       {R,     RDF,  ZO,  true,    down, row,    rows}},
};
// clang-format on

}  // namespace

std::span<const ConventionPreset> conventionPresets() noexcept { return kPresets; }

std::optional<Convention> conventionPreset(std::string_view name) noexcept {
  for (const ConventionPreset& preset : kPresets)
    if (preset.name == name) return preset.convention;
  return std::nullopt;
}

}  // namespace viewproj
