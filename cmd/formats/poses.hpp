// Poses without a lens: matrices and trajectories as text, as JSON, or as the pose of a calibration.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "camera/camera_set.hpp"

namespace viewproj::cmd {

struct PosesOfFile {
  Import poses{};           ///< each a camera without a lens; none if the file is of no form of poses
  std::string field{};      ///< "worldFromCamera" or "cameraFromWorld"
  bool isDirected = false;  ///< the file's form has this direction; else no number tells it
};

/// Whether a file holds poses alone.
bool holdsPoses(const Node& root);
/// The poses of a file, which may hold more.
PosesOfFile posesOf(const Node& root);
/// The rows of the one pose that a text has, as a program prints it; of the two layouts the one whose last row is 0 0
/// 0 1.
std::optional<Json> printedPose(std::string_view text);

}  // namespace viewproj::cmd
