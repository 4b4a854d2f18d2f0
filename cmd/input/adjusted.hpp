// A camera's parts with one number changed, and nothing else.
#pragma once

#include <optional>

#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// The same turn elsewhere.
Pose movedTo(const Pose& pose, const Vec3& eye, Handedness world);

/// The same window with the ends that are given.
Projection withRange(const Projection& projection, std::optional<double> near, std::optional<double> far);

}  // namespace viewproj::cmd
