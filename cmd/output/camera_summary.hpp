// A camera as a page for a person.
#pragma once

#include <string>

#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// What it has of a pose, a projection and a viewport. axes: those of the rotation that is told. digits: significant.
std::string summaryOf(const CameraFile& camera, CameraAxes axes, int digits);

}  // namespace viewproj::cmd
