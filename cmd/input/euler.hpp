// A camera turned about its own axes, one after the other.
#pragma once

#include "input/document.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// The field "euler" of a camera. axes: where its x, y, z point. Throws InputError, or CameraError for axes that have
/// not the world's handedness.
Pose readEuler(const ObjectReader& camera, const Vec3& position, CameraAxes axes, Handedness world);

}  // namespace viewproj::cmd
