// A camera that looks at a screen: an eye before a picture that stands in the world, as in a CAVE or on an LED wall.
#pragma once

#include "camera/values.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// The pose, whose axes are the screen's, and the screen's edges as tangents.
struct ScreenView {
  Pose pose;
  double left, right, bottom, top;
};

/// Of a document whose projection is of type screen. Throws InputError naming a field where there is no position, the
/// screen is no rectangle, or the eye is not in front of it.
ScreenView readScreen(const FieldValues& values, Handedness world);

}  // namespace viewproj::cmd
