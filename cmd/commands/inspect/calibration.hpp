// The camera in a calibration: K, 3x3, or P = K [R | t], 3x4.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/matrix_numbers.hpp"

namespace viewproj::cmd {

/// In pixels, right and down from where the calibration counts them, and its x right, y down, z forward.
struct Calibration {
  double fx, fy, cx, cy, skew;
  std::optional<Vec3> eye;    ///< of P
  Vec3 right, down, forward;  ///< of P: in the world
  std::vector<std::string> notes;
};

/// Throws CameraError for what is none.
Calibration inspectCalibration(const WrittenMatrix& matrix);

}  // namespace viewproj::cmd
