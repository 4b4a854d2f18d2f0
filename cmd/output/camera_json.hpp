// The forms of a pose in a camera file. Internal to camera_text.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "input/camera_file.hpp"
#include "text/json_build.hpp"

namespace viewproj::cmd {

inline std::string jsonOf(const Vec3& v) { return jsonListOf(std::array{v.x, v.y, v.z}); }
/// The nearer half.
inline std::string jsonOf(DoubleDouble number) { return jsonOf(number.hi); }

/// A pose in the forms that a file has for one, what people read most easily first. Any rotation fits into that but for
/// its last bits, which count in a very narrow field of view; the others hold to the last bit what was given in their
/// form. One empty form where the camera has no pose.
std::vector<std::string> poseForms(const CameraFile& camera, const ConventionPreset& preset);

}  // namespace viewproj::cmd
