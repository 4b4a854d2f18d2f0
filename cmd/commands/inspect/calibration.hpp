// The camera in a calibration: K, 3x3, or P = K [R | t], 3x4.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "input/matrix_numbers.hpp"
#include "input/readings/estimate.hpp"

namespace viewproj::cmd {

/// In pixels, right and down from where the calibration counts them, and its x right, y down, z forward.
struct Calibration {
  Estimate fx, fy, cx, cy, skew;
  std::optional<std::array<Estimate, 3>> eye;  ///< of P
  Vec3 right, down, forward;                   ///< of P: in the world
  std::vector<std::string> notes;
};

/// Each number true to its digits (`within`) and no better than half an ulp; what each moves adds up. Throws
/// CameraError for what is none.
Calibration inspectCalibration(const WrittenMatrix& matrix, EntryPrecision precision, bool isExact);

}  // namespace viewproj::cmd
