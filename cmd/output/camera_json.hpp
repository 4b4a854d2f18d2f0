// The forms of a pose in a camera file. Internal to camera_text.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "camera/read_camera.hpp"
#include "text/json_text.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

inline std::string jsonOf(const Vec3& v) { return jsonListOf(std::array{v.x, v.y, v.z}); }
/// The nearer half.
inline std::string jsonOf(detail::DoubleDouble number) { return jsonOf(number.hi); }

/// {"world": ..., every axis}.
std::string jsonOf(const Convention& convention);

/// A preset's name, with the axes that differ from it.
std::string conventionAsJson(const Convention& convention, const ConventionPreset& preset);

std::string matrixAsJson(const Mat4& matrix);

/// World from camera, of unit length: x, y, z, w.
std::array<detail::DoubleDouble, 4> rotationOf(const Pose& pose, CameraAxes axes);

/// A pose in the forms that a file has for one, what people read most easily first. Any rotation fits into that but for
/// its last bits, which count in a very narrow field of view; the others hold to the last bit what was given in their
/// form. One empty form where the camera has no pose.
std::vector<std::string> poseForms(const CameraFile& camera, const ConventionPreset& preset);

}  // namespace viewproj::cmd
