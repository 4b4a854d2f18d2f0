// The bounds of error_model.hpp as numbers, for a camera or a point.
#pragma once

#include "projection/error_model.hpp"
#include "projection/picture_reach.hpp"

namespace viewproj {

/// The largest error of screen x and y, in pixels, and of window depth. Infinite where nothing is promised.
struct ErrorBound {
  double screen = 0;
  double depth = 0;
};

/// For every point whose true pixel lies in the picture enlarged band times about its middle, between near and far in
/// orthographic (and whose depth lies between near and far, for the depth's bound).
ErrorBound boundInPicture(const Camera& camera, Precision precision, double band = 1) noexcept;

/// For one point, wherever it lies.
ErrorBound boundOfPoint(const Camera& camera, const Vec3& point, Precision precision) noexcept;

/// Homogeneous: weights other than 1 have the bound of exact, whatever the precision, as worldToScreen works on them.
ErrorBound boundOfPoint(const Camera& camera, const Vec4& point, Precision precision) noexcept;

/// The cheapest precision that is within tolerance pixels in the whole picture and one more picture on every side of it
/// (band 3). exact where none is.
Precision precisionWithin(const Camera& camera, double tolerance) noexcept;

}  // namespace viewproj
