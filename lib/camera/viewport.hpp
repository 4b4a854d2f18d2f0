// A viewport, checked, and where its picture lies.
#pragma once

#include "numbers/double_double.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::detail {

/// Throws CameraError naming the number that is none of a viewport.
void validate(const Viewport& viewport);

/// Screen position of the corner of the picture that screen numbers are counted from.
struct ScreenCorner {
  DoubleDouble x, y;
};

/// A picture's corner lies half a pixel before the centre of its first pixel.
constexpr ScreenCorner screenCorner(const Viewport& v) noexcept {
  const DoubleDouble halfPixel = twoDiff(v.pixelCenter, 0.5);
  return {DoubleDouble(v.x) + halfPixel, DoubleDouble(v.y) + halfPixel};
}

}  // namespace viewproj::detail
