// A camera document as text.
#pragma once

#include <string>

#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// {"world": ..., every axis}.
std::string jsonOf(const Convention& convention);

/// The document of the camera, in the pose and the lens form that it was read in, and in this convention: that preset
/// with what differs from it. What the document leaves to its own preset is written where the other one has something
/// else. The convention has the world of the camera's. Throws InputError for a ps2 projection in a convention whose
/// depth is not reversed.
std::string writeCamera(const CameraFile& camera, const ConventionPreset& preset, const Convention& convention);

}  // namespace viewproj::cmd
