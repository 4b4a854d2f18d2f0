// The cameras that the rasterisers judge.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "rasteriser.hpp"

namespace rasterisers {

/// A camera file, and how its matrices are written and drawn.
struct CameraCase {
  int index = 0;
  nlohmann::json camera;
  std::string preset;  ///< the convention written
  bool reverseZ = false, infinite = false, orthographic = false;
  bool minusOneToOne = false;  ///< written so, whatever the preset has
  bool otherWay = false;       ///< the matrices have the other reverseZ than the file
  bool relativeToEye = false;  ///< float32 holds the points only so
  bool product = false;        ///< viewProjection in one matrix, else view and projection
  bool mirrored = false;
  DepthFormat format = DepthFormat::f32;

  std::string name() const;
};

constexpr int kCameras = 80;
CameraCase cameraCase(int index);

}  // namespace rasterisers
