// The stages between world and screen, in any convention: view space, clip space, NDC.
#pragma once

#include "viewproj/camera.hpp"

namespace viewproj {

// Points are homogeneous as for worldToScreen: w = 0 is a direction, other weights are divided out first. Computed in
// double-double from the camera's parameters, not through a matrix, and rounded once; NaN for a point out of range
// (screen.hpp).

/// View space, axes as the convention's. A direction stays one: its translation is left out.
Vec3 worldToView(const Camera& camera, const Vec4& point, const Convention& convention) noexcept;

/// Clip space, before the division by w. z is NaN of a camera without near plane, in NDC too.
Vec4 worldToClip(const Camera& camera, const Vec4& point, const Convention& convention) noexcept;

/// Normalised device coordinates; NaN on or behind the eye plane, and for a direction in an orthographic camera.
Vec3 worldToNdc(const Camera& camera, const Vec4& point, const Convention& convention) noexcept;

}  // namespace viewproj
