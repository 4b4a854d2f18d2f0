// What a camera says under names that the row of its kind does not read: a skew, a crop, a pose.
#pragma once

#include <optional>
#include <string>

#include "input/camera_file.hpp"
#include "input/kinds/lens_of.hpp"
#include "input/kinds/lookup.hpp"

namespace viewproj::cmd {

/// Throws at a skew under its name.
void refuseSkew(const CameraPlace& camera);
/// Throws where beside K stands a P that is none, without which the file would be of another kind.
void refuseOddP(const CameraPlace& camera);

/// Throws at a crop, a binning or a flip of the picture. pixels: the picture, where its size is known.
void requireWholePicture(const CameraPlace& camera, const std::optional<Viewport>& pixels);

/// Throws at a pose where none is read.
void requirePoseRead(const CameraPlace& camera, const CameraReading& reading);

}  // namespace viewproj::cmd
