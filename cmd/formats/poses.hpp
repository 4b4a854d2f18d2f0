// Poses without a lens: matrices and trajectories as text, as JSON, or as the pose of a calibration.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
/// The rows of the poses that a text has, and their names, as a program prints them; of the two layouts the one whose
/// last row is 0 0 0 1. None where one of its matrices is no pose.
std::vector<std::pair<std::string, Json>> printedPoses(std::string_view text);
/// The rows of the only rigid matrix that the file has at this path, or under its last name.
std::optional<Json> poseAt(const Document& file, const std::string& path);
/// The rows of a pose at the origin by the 9 numbers of a text, which has no three others that may be a place.
std::optional<Json> printedRotation(std::string_view text);
/// The poses of a file of no form, where it names one quaternion and one place: in the direction of its names, or in
/// this one.
std::optional<PosesOfFile> namedPose(const Document& file, const std::string& field);
/// Of a URDF the origin of the joint that has this name, or of the only one; or the poses of the fixed joints from the
/// root to the link of this name. Throws InputError for another name.
std::optional<Json> jointPose(const Document& file, const std::optional<std::string>& name);

}  // namespace viewproj::cmd
