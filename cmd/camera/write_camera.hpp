// A camera document as text.
#pragma once

#include <string>

#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// {"world": ..., ...} with every field.
std::string jsonOf(const Convention& convention);

/// The camera's document as text, with its kind of pose and projection, in another convention: a preset, and the fields
/// that differ from it. Defaults of the document's old preset are written out if the new one has others. The convention
/// must have the camera's world. Throws InputError for a ps2 projection in a convention whose depth is not reversed.
std::string writeCamera(const CameraFile& camera, const ConventionPreset& preset, const Convention& convention);

}  // namespace viewproj::cmd
