// Points and pixels of cameras with a lens: the pinhole's, bent. Internal; of viewproj/screen.hpp, where a camera has
// one.
#pragma once

#include "camera/camera.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// Tangents right and up of the viewing axis.
struct WindowPoint {
  DoubleDouble right, up;
};
/// What a pixel is before the lens; NaN where no point has it.
WindowPoint beforeLens(const CameraParts& c, const Vec2& screen) noexcept;

ScreenPoint throughLens(const Camera& camera, const Vec4& point, Precision precision) noexcept;

ErrorBound boundThroughLens(const Camera& camera, const Vec4& point, Precision precision) noexcept;
ErrorBound boundInPictureThroughLens(const Camera& camera, Precision precision) noexcept;

// ---- Of bounds.cpp

/// How far from the principal point the picture reaches, in pixels.
Vec2 pictureReach(const CameraParts& c) noexcept;

/// boundInPicture of the pinhole for a picture that reaches so far.
ErrorBound boundWithin(const CameraParts& c, const Vec2& reach, Precision precision) noexcept;

}  // namespace viewproj::detail
