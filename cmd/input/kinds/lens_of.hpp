// The lens and the picture of a camera as the row of its kind describes them.
#pragma once

#include <optional>
#include <string>

#include "camera/camera.hpp"
#include "input/kinds/distortion.hpp"
#include "input/kinds/lookup.hpp"

namespace viewproj::cmd {

struct PictureSize {
  std::optional<double> width, height;
};

PictureSize sizeOf(const CameraPlace& camera);

/// In pixels.
struct LensOf {
  detail::DoubleDouble fx, fy;
  double cx, cy;
  std::string_view word;  ///< of the row, for what is wrong with fx, fy, cx or cy
};

/// pixels: the picture in which the lens counts. Throws InputError.
LensOf lensOf(const CameraPlace& camera, const Viewport& pixels);

/// False where the file has more numbers of the lens than a pinhole.
bool isPinhole(const CameraPlace& camera);

/// Whether that is known without a size of the picture.
bool countsInPixels(const CameraPlace& camera);

}  // namespace viewproj::cmd
