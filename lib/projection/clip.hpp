// The stages between world and screen, in any convention: view space, clip space, NDC.
#pragma once

#include "camera/camera.hpp"
#include "projection/screen.hpp"

namespace viewproj {

// Points are homogeneous as for worldToScreen: w = 0 is a direction, other weights are divided out first. Computed in
// double-double from the camera's parameters, not through a matrix, and rounded once; NaN for input that is not finite.

/// View space, axes as the convention's. A direction stays one: its translation is left out.
Vec3 worldToView(const Camera& camera, const Vec4& point, const Convention& convention) noexcept;

/// Clip space, before the division by w.
Vec4 worldToClip(const Camera& camera, const Vec4& point, const Convention& convention) noexcept;

/// Normalised device coordinates; NaN on or behind the eye plane, and for a direction in an orthographic camera.
Vec3 worldToNdc(const Camera& camera, const Vec4& point, const Convention& convention) noexcept;

/// How far inside each side of the view a point lies in clip space, as the clip inequalities have it: w + x, w - x and
/// so on; negative outside. NaN: there is no such inequality.
struct ClipMargins {
  double left = 0, right = 0, bottom = 0, top = 0, near = 0, far = 0;
};

/// Every stage of one point or direction, for following it by hand. Each number is the double nearest the true value of
/// that stage, not the product of rounded ones; a sum of this stage that cancels to less than 2^-98 of its terms is 0.
struct PointStages {
  Vec3 world;     ///< the weight divided out; a direction as it is
  Vec3 relative;  ///< world - eye; a direction as it is
  Vec3 view;
  Vec4 clip;
  ClipMargins margins;  ///< infinite far has none
  Vec3 ndc;             ///< NaN where clip.w is not above 0
  ScreenPoint screen;   ///< as worldToScreen gives it, whatever the convention
};

/// NaN for input that is not finite. Takes microseconds: points are followed through exact rows.
PointStages pointStages(const Camera& camera, const Vec4& point, const Convention& convention) noexcept;

}  // namespace viewproj
