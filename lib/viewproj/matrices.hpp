// The matrices of a camera and of a model, and a point in the spaces between world and screen.
//
// Each is written from the camera's parameters, inverses too: none is a product of matrices, and none is inverted. All
// are for column vectors; laidOut and inStorageOrder apply a convention's vectors and storage.
#pragma once

#include <array>
#include <span>

#include "viewproj/camera.hpp"

namespace viewproj {

/// Where coordinates are counted. clip is before the division by w, ndc and screen (with window depth) after it: both
/// have the same matrices but for where they come out. Axes of view are the convention's.
enum class Space { model, world, view, clip, ndc, screen };

/// From one space to another by the camera's convention. Each entry is the double nearest the true one, or within 1e-26
/// of the terms that it is a sum of; the translation into view space is the nearest double however it cancels. An entry
/// too large for a double is infinite.
///
/// worldFromModel is affine, its entries are 0 or between 1e-90 and 1e90 in magnitude, and its last row is 0 0 0 1.
/// Throws CameraError naming "model" where there is none, where it is no such matrix and, on the way to it, where it
/// has no inverse (its axes lie in a plane; decided exactly) or one with entries beyond 1e100; naming "near" between
/// clip, ndc or screen and view, world or model where the camera has no near plane.
Mat4 matrix(const Camera& camera, Space to, Space from);
Mat4 matrix(const Camera& camera, Space to, Space from, const Mat4& worldFromModel);

/// The sixteen numbers of a matrix in the order in which the camera's convention keeps them in memory: what
/// glUniformMatrix4fv (with GL_FALSE) and its like take. Number is float or double; entries are rounded once: to the
/// nearest unless the true value lies within 2^-90 of its size from the middle of two.
template <class Number>
std::array<Number, 16> storedMatrix(const Camera& camera, Space to, Space from);

/// A world point in view, clip or ndc, in any convention; w of view is 1 or, of a direction, 0, and that of ndc 1.
/// Homogeneous as for worldToScreen: other weights are divided out first. In double-double, and rounded once. NaN for a
/// point out of range (screen.hpp), for ndc on or behind the eye plane and of an orthographic camera's direction, for z
/// of clip and ndc without a near plane, and for other spaces.
Vec4 worldTo(const Camera& camera, Space to, const Vec4& point, const Convention& convention) noexcept;

/// Distances of a point or, with w = 0, of a direction along the camera's right, up and forward, each within 2^-90 of
/// itself however it cancels; and the screen position of such distances, rounded once, of a perspective with forward
/// above 0. NaN for a point out of range.
SplitVec3 alongAxes(const Camera& camera, const Vec4& point) noexcept;
Vec2 screenAt(const Camera& camera, const SplitVec3& distances) noexcept;

/// The pose with its eye at the origin: what float32 at planet scale needs, with the eye subtracted beforehand.
Pose relativeToEye(const Pose& pose);

/// The matrix as the convention writes it on paper: transposed for row vectors.
Mat4 laidOut(const Mat4& matrix, const Convention& convention) noexcept;

/// The sixteen numbers in the convention's memory order, and the matrix for column vectors of such numbers.
std::array<double, 16> inStorageOrder(const Mat4& matrix, const Convention& convention) noexcept;
Mat4 fromStorageOrder(std::span<const double, 16> numbers, const Convention& convention) noexcept;
Mat4 fromStorageOrder(std::span<const float, 16> numbers, const Convention& convention) noexcept;

}  // namespace viewproj
