// Poses without a lens: matrices and trajectories as text, as JSON, or as the pose of a calibration.
#pragma once

#include <string>

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

}  // namespace viewproj::cmd
