// Conventions as data: which way the axes of each space point, and how a matrix is laid out.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "viewproj/vectors.hpp"

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

/// +1 where the axis of view space points as right, up, forward do, -1 where it points the other way.
struct AxisSigns {
  double up, forward;
};

constexpr AxisSigns axisSigns(ViewAxes axes) noexcept {
  return {axes == ViewAxes::RDF ? -1.0 : 1.0, axes == ViewAxes::RUB ? -1.0 : 1.0};
}

/// NDC z of the near and the far plane.
struct NdcDepths {
  double atNear, atFar;
};

constexpr NdcDepths ndcDepths(const Convention& c) noexcept {
  const double low = c.ndcZ == NdcZ::minusOneToOne ? -1 : 0;
  return c.reverseZ ? NdcDepths{1, low} : NdcDepths{low, 1};
}

/// Where x, y, z of a rotation or pose matrix point.
enum class CameraAxes { RUB, RUF, RDF, FRU };

/// All that a name means.
struct ConventionPreset {
  std::string_view name;
  Convention convention;
  CameraAxes cameraAxes = CameraAxes::RUB;  ///< of poses
  Vec3 up{0, 1, 0};                         ///< of the world
  double pixelCenter = 0.5;                 ///< of viewports
};

/// opengl, opengl-lh, d3d, d3d-rh, vulkan, metal, webgpu, unity, unreal, opencv, ps2: the first is the default.
std::span<const ConventionPreset> conventionPresets() noexcept;

/// The row of that name, or null.
const ConventionPreset* findPreset(std::string_view name) noexcept;

/// The convention of that name, or nothing.
std::optional<Convention> conventionPreset(std::string_view name) noexcept;

}  // namespace viewproj
