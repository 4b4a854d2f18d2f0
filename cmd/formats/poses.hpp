// Poses without a lens: matrices and trajectories as text, as JSON, or as the pose of a calibration.
#pragma once

#include <string>

#include "camera/camera_set.hpp"

namespace viewproj::cmd {

struct PosesOfFile {
  Import poses;  ///< each a camera without a lens
  /// "worldFromCamera" or "cameraFromWorld", the field of the pose.
  std::string field;
  bool isDirected;  ///< the file's form has this direction; else no number tells it
};

/// Whether a file holds poses alone.
bool holdsPoses(const Node& root);
/// Throws InputError if it holds none.
PosesOfFile posesOf(const Node& root);

}  // namespace viewproj::cmd
