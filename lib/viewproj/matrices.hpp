// The matrices of a camera and of a model, and points in the spaces between world and screen.
//
// Every matrix, inverses too, is computed from the camera's parameters, not by multiplying or inverting matrices. All
// are for column vectors; laidOut and inStorageOrder apply a convention's vectors and storage.
//
// Example:
//   const Viewport picture{.width = 640, .height = 480};
//   const Camera camera = makeCamera(lookAlong({0, 0, 5}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
//                                    perspective(90, picture, 1, 100), picture);
//   const auto m = storedMatrix<float>(camera, Space::clip, Space::world);  // for glUniformMatrix4fv
//   const Camera again = cameraFromMatrices(matrix(camera, Space::view, Space::world),
//                                           matrix(camera, Space::clip, Space::view), picture, conventions::opengl);
//   std::printf("%g %g %g", m[0], m[15], again.projection().zFar());  // prints 0.75 5 100
#pragma once

#include <array>
#include <span>

#include "viewproj/camera.hpp"

namespace viewproj {

/// The spaces of coordinates. clip is before the division by w; ndc and screen (with window depth) are after it. clip
/// and ndc have the same matrices. Axes of view are the convention's.
enum class Space { model, world, view, clip, ndc, screen };

/// The matrix from one space to another in the camera's convention. Each entry is the double nearest the true one, or
/// within 1e-26 of the terms that it is the sum of. The translation into view space is always the nearest double. An
/// entry too large for a double is infinite.
///
/// worldFromModel must be affine with last row 0 0 0 1; its entries are up to 1e45, and 0 if below 1e-45.
/// Throws CameraError naming "model" if it is missing or invalid, or if the matrix is to model space and worldFromModel
/// has no inverse (decided exactly) or one with entries beyond 1e100. Throws CameraError naming "near" between clip,
/// ndc or screen and view, world or model if the camera has no near plane.
Mat4 matrix(const Camera& camera, Space to, Space from);
Mat4 matrix(const Camera& camera, Space to, Space from, const Mat4& worldFromModel);

/// The sixteen numbers of a matrix in memory order, in the camera's convention: the argument of glUniformMatrix4fv
/// (with GL_FALSE) and similar functions. Number is float or double. Entries are rounded once, to the nearest unless
/// the true value is within 2^-90 of its size from the middle of two.
template <class Number>
std::array<Number, 16> storedMatrix(const Camera& camera, Space to, Space from);

/// A world point in view, clip or ndc, in any convention. The result's w is 1 in view (0 for a direction) and 1 in ndc.
/// Weights other than 0 and 1 are divided out first. Computed in double-double and rounded once. NaN for a point out of
/// range (screen.hpp), for ndc on or behind the eye plane or for a direction in orthographic, for z of clip and ndc
/// without a near plane, and for other spaces.
Vec4 worldTo(const Camera& camera, Space to, const Vec4& point, const Convention& convention) noexcept;

/// Distances of a point (or of a direction, if w = 0) along the camera's right, up and forward axes, each within 2^-90
/// relative even if it cancels. NaN if out of range.
SplitVec3 alongAxes(const Camera& camera, const Vec4& point) noexcept;

/// The matrix as the convention writes it: transposed for row vectors.
Mat4 laidOut(const Mat4& matrix, const Convention& convention) noexcept;

/// The sixteen numbers in the convention's memory order, and the matrix for column vectors from such numbers.
std::array<double, 16> inStorageOrder(const Mat4& matrix, const Convention& convention) noexcept;
Mat4 fromStorageOrder(std::span<const double, 16> numbers, const Convention& convention) noexcept;
Mat4 fromStorageOrder(std::span<const float, 16> numbers, const Convention& convention) noexcept;

// ---- A camera from matrices

/// The camera of a view and a projection matrix, for column vectors. Screen x, y and the distance W are those of the
/// entries taken as exact, as far as a camera's numbers have them (camera.hpp). near and far are the doubles nearest to
/// what the depth row says, so that depth is within 2^-52 of it; far is infinite where the row does not tell it from
/// that. Bounds and `certain` of screen.hpp are of this camera's depth, not of the row's. All of the projection may be
/// multiplied by a number above 0. Throws CameraError naming "viewFromWorld" if it is not within kPoseOrthogonality of
/// a rotation with a translation or mirrors, "clipFromView" if it is no projection of this convention or has a skew.
Camera cameraFromMatrices(const Mat4& viewFromWorld, const Mat4& clipFromView, const Viewport& viewport,
                          const Convention& convention);

/// The same from sixteen numbers each, as they lie in memory in this convention, or from pointers to them:
/// glm::value_ptr(m), m.data() of an Eigen::Matrix4f, &m.m[0][0] of an XMFLOAT4X4.
Camera cameraFromMatrices(std::span<const double, 16> viewFromWorld, std::span<const double, 16> clipFromView,
                          const Viewport& viewport, const Convention& convention);
Camera cameraFromMatrices(std::span<const float, 16> viewFromWorld, std::span<const float, 16> clipFromView,
                          const Viewport& viewport, const Convention& convention);
Camera cameraFromMatrices(const double* viewFromWorld, const double* clipFromView, const Viewport& viewport,
                          const Convention& convention);
Camera cameraFromMatrices(const float* viewFromWorld, const float* clipFromView, const Viewport& viewport,
                          const Convention& convention);

}  // namespace viewproj
