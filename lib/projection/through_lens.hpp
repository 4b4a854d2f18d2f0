// Projection and rays through a lens, from distances along the camera's axes in double-double: what the kernel leaves,
// and bounds.
#pragma once

#include "camera/camera.hpp"
#include "lens/lens.hpp"
#include "numbers/wide.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// The direction that a pixel shows, of unit length; NaN where there is none.
Sight<DoubleDouble> sightOf(const CameraParts& c, const Vec2& screen) noexcept;

/// Where a lens puts a direction whose distances are within 2^-98 of the true ones. NaN if it does not see it; isSeen
/// tells whether that is certain.
struct LensPixel {
  NearestDouble x, y;
  Seen seen;
};
LensPixel bentPixel(const CameraParts& c, const Sight<DoubleDouble>& sight) noexcept;

/// The bound of the pixel of a point that may be pointError from the true one.
double boundThroughLens(const Camera& camera, const Vec4& point, double pointError) noexcept;
ErrorBound boundInPictureThroughLens(const CameraParts& c) noexcept;

// ---- Of bounds.cpp

/// How far from the principal point the picture reaches, in pixels.
Vec2 pictureReach(const CameraParts& c) noexcept;

/// boundInPicture of the pinhole for a picture that reaches so far.
ErrorBound boundWithin(const CameraParts& c, const Vec2& reach, Precision precision) noexcept;

}  // namespace viewproj::detail
