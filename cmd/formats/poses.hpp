// Poses without a lens: matrices and trajectories as text, as JSON, or as the pose of a calibration.
#pragma once

#include <string>
#include <vector>

#include "camera/camera_set.hpp"

namespace viewproj::cmd {

struct PosesOfFile {
  std::vector<CameraEntry> names;
  /// worldFromCamera or cameraFromWorld, as the field's value. Throws InputError, also for a pose that is lost.
  std::function<Json(std::size_t which)> pose;
  /// The direction, if the file's form has one: "worldFromCamera", "cameraFromWorld"; or empty.
  std::string direction;
};

/// Whether a file holds poses alone.
bool holdsPoses(const Node& root);
/// Throws InputError if it holds none.
PosesOfFile posesOf(const Node& root);

}  // namespace viewproj::cmd
