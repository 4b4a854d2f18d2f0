// Checks a viewport and gives the position of its picture.
#pragma once

#include "numbers/double_double.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::detail {

/// Throws CameraError naming the number that is invalid.
void validate(const Viewport& viewport);

/// Screen position of the picture's corner that x and y are counted from.
struct ScreenCorner {
  DoubleDouble x, y;
};

/// The picture's corner lies half a pixel before the centre of its first pixel.
constexpr ScreenCorner screenCorner(const Viewport& v) noexcept {
  const DoubleDouble halfPixel = twoDiff(v.pixelCenter, 0.5);
  return {DoubleDouble(v.x) + halfPixel, DoubleDouble(v.y) + halfPixel};
}

}  // namespace viewproj::detail
