// Poses of files and texts, of which the product is a camera's pose.
#pragma once

#include <string>

#include "formats/import_file.hpp"

namespace viewproj::cmd {

/// Each camera at the pose, or one camera at each pose: in a folder of the name that picked it. name: of the cameras'
/// file, or of the first poses' where options are the camera; several poses set it to their own.
Import atPoses(Import cameras, const Opening& opening, std::string& name, bool hasFile = true);

/// The last pose on the way to the camera.
inline const std::string& innermost(const Opening& opening) {
  return opening.direction == "worldFromCamera" ? opening.poses.back() : opening.poses.front();
}

/// The one pose that a file or a text gives, as a field's value: what takes its coordinates to the world.
Json poseOf(const std::string& source);

/// Whether a camera's document has another pose than that of a file which gives none.
bool hasPose(const Json& camera);

}  // namespace viewproj::cmd
