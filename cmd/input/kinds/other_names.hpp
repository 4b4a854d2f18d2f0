// What a camera says under names that the row of its kind does not read: other numbers of the lens, and a pose.
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

/// Notes what may be poses among the fields around the cameras of a file.
void notePosesAround(const Document& document, std::span<const Found> fields, const Kind& kind);

/// Notes planes and conventions that the row does not read.
void noteUnreadMeaning(const CameraPlace& camera);

/// Notes focal lengths, a centre or a size that are not those that count.
void noteOtherLens(const CameraPlace& camera, const LensOf& lens, const Viewport& pixels);

/// Throws at a crop, a binning or a flip of the picture, and notes a region of it. pixels: the picture, where its size
/// is known.
void requireWholePicture(const CameraPlace& camera, const std::optional<Viewport>& pixels);

/// Throws at a pose where none is read, and notes it beside one that is, or where its name leaves open what it is.
void requirePoseRead(const CameraPlace& camera, const CameraReading& reading);

}  // namespace viewproj::cmd
