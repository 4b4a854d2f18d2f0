// Points and pixels of cameras with a lens: the pinhole's, bent. Internal; of viewproj/screen.hpp, where a camera has
// one.
#pragma once

#include "camera/camera.hpp"
#include "lens/lens.hpp"
#include "numbers/wide.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// Tangents right and up of the viewing axis.
struct WindowPoint {
  DoubleDouble right, up;
};
/// What a pixel is before the lens; NaN where no point has it.
WindowPoint beforeLens(const CameraParts& c, const Vec2& screen) noexcept;

/// Each of the two is within error of the true one.
struct BoundedTangents {
  Tangents<DoubleDouble> at;
  double error;

  double radius() const noexcept { return std::sqrt(at.x.hi * at.x.hi + at.y.hi * at.y.hi); }
};

struct NearestPixel {
  NearestDouble x, y;
};
/// Where a lens puts tangents; NaN from its limit on.
NearestPixel bentPixel(const CameraParts& c, const BoundedTangents& tangents) noexcept;

/// The bound of a point's pixel, whose pixel without the lens is known to `shift`.
double boundThroughLens(const Camera& camera, const Vec4& point, double shift) noexcept;
ErrorBound boundInPictureThroughLens(const CameraParts& c) noexcept;

// ---- Of bounds.cpp

/// How far from the principal point the picture reaches, in pixels.
Vec2 pictureReach(const CameraParts& c) noexcept;

/// boundInPicture of the pinhole for a picture that reaches so far.
ErrorBound boundWithin(const CameraParts& c, const Vec2& reach, Precision precision) noexcept;

}  // namespace viewproj::detail
