// worldToScreen: where a point of the world lies in the picture.
#pragma once

#include "camera/camera.hpp"
#include "projection/screen_point.hpp"

namespace viewproj {

/// Projects a point, as near the true value as view/bounds.hpp says of the precision; points that fast or standard
/// cannot bound are projected exactly. Subtracts the eye first (exactly, in exact), then three dot products and one
/// division: no matrix.
ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision = Precision::exact) noexcept;

/// Homogeneous: (x/w, y/w, z/w), negative w included; with w = 0 a direction, whose vanishing point is given. Weights
/// other than 1 are worked on in double-double whatever the precision.
ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision = Precision::exact) noexcept;

/// A single point as the batch of this name (view/batch.hpp) projects it, bit for bit: in the precision chosen where
/// its pixel lies in the picture or one more picture on any side of it, exactly elsewhere. chosen is
/// precisionWithin(camera, tolerance), found once for all points; tolerance is in pixels.
ScreenPoint worldToScreenWithin(const Camera& camera, Precision chosen, const Vec3& point) noexcept;
ScreenPoint worldToScreenWithin(const Camera& camera, Precision chosen, const Vec4& point) noexcept;

}  // namespace viewproj
