// A viewport, checked.
#pragma once

#include "viewproj/camera.hpp"

namespace viewproj::detail {

/// Throws CameraError unless every number is finite, width and height are positive, and all are within the range that
/// kSmallestWindow and kLargestWindow state.
void validate(const Viewport& viewport);

}  // namespace viewproj::detail
