// A viewport, checked.
#pragma once

#include "viewproj/camera.hpp"

namespace viewproj::detail {

/// Throws CameraError naming the number that is none of a viewport.
void validate(const Viewport& viewport);

}  // namespace viewproj::detail
