// The matrices of a camera and of a model, a camera's each written directly from its parameters, its inverse too.
//
// Named destinationFromSource. All are returned as matrices for column vectors, whatever the convention's vectors and
// storage say: laidOut and inStorageOrder apply those at the end. Entries are computed in double-double and rounded
// once; an entry too large for a double comes out infinite.
//
// Those to and from clip space and the screen throw CameraError naming "near" for a projection without near plane.
//
// A viewport is one that makeCamera takes; of another the entries mean nothing.
#pragma once

#include <array>
#include <span>

#include "viewproj/camera.hpp"

namespace viewproj {

/// Where coordinates are counted. clip is before the division by w, ndc and screen (with window depth) after it: both
/// have the same matrices but for where they come out.
enum class Space { model, world, view, clip, ndc, screen };

/// From one space to another, for column vectors, by the camera's convention: laidOut and inStorageOrder apply its
/// vectors and storage. Written from the camera's parameters, not as a product of matrices, inverses too. Each entry is
/// the double nearest the true one, or within 1e-26 of the terms that it is a sum of; the translation into view space
/// is the nearest double however it cancels. An entry too large for a double is infinite.
///
/// model: worldFromModel, affine, with entries that are 0 or between 1e-90 and 1e90 in magnitude and the last row 0 0
/// 0 1. Throws CameraError naming "model" where there is none, where it is no such matrix and, on the way to it, where
/// it has no inverse (its axes lie in a plane; decided exactly) or one with entries beyond 1e100; naming "near" between
/// clip, ndc or screen and view, world or model where the camera has no near plane.
Mat4 matrix(const Camera& camera, Space to, Space from);
Mat4 matrix(const Camera& camera, Space to, Space from, const Mat4& worldFromModel);

/// The sixteen numbers of a matrix in the order in which the camera's convention keeps them in memory: what
/// glUniformMatrix4fv (with GL_FALSE) and its like take. Number is float or double; entries are rounded once: to the
/// nearest unless the true value lies within 2^-90 of its size from the middle of two.
template <class Number>
std::array<Number, 16> storedMatrix(const Camera& camera, Space to, Space from);

// ---- The same of a camera's parts

/// World to view space; its axes are the convention's.
Mat4 viewFromWorld(const Pose& pose, const Convention& convention) noexcept;
Mat4 worldFromView(const Pose& pose, const Convention& convention) noexcept;

/// View space to clip space.
Mat4 clipFromView(const Projection& projection, const Convention& convention);
Mat4 viewFromClip(const Projection& projection, const Convention& convention);

/// World to clip space: not the rounded product of the two, but its own closed form.
Mat4 clipFromWorld(const Pose& pose, const Projection& projection, const Convention& convention);
Mat4 worldFromClip(const Pose& pose, const Projection& projection, const Convention& convention);

/// Normalised device coordinates to screen x, screen y and window depth, as a graphics API's viewport transform maps
/// them: NDC z of the low end goes to depthFirst.
Mat4 screenFromNdc(const Viewport& viewport, const Convention& convention) noexcept;
Mat4 ndcFromScreen(const Viewport& viewport, const Convention& convention) noexcept;

/// clipFromView with the viewport folded in: division by w then gives screen x, screen y and window depth.
Mat4 screenFromView(const Projection& projection, const Viewport& viewport, const Convention& convention);
Mat4 viewFromScreen(const Projection& projection, const Viewport& viewport, const Convention& convention);
Mat4 screenFromWorld(const Pose& pose, const Projection& projection, const Viewport& viewport,
                     const Convention& convention);
Mat4 worldFromScreen(const Pose& pose, const Projection& projection, const Viewport& viewport,
                     const Convention& convention);

/// The pose with its eye at the origin: what float32 at planet scale needs, with the eye subtracted beforehand.
Pose relativeToEye(const Pose& pose);

/// The matrix as the convention writes it on paper: transposed for row vectors.
Mat4 laidOut(const Mat4& matrix, const Convention& convention) noexcept;

/// The sixteen numbers in the convention's memory order.
std::array<double, 16> inStorageOrder(const Mat4& matrix, const Convention& convention) noexcept;
/// The other way: the matrix, for column vectors, of sixteen numbers that stand in the convention's memory order.
Mat4 fromStorageOrder(std::span<const double, 16> numbers, const Convention& convention) noexcept;
Mat4 fromStorageOrder(std::span<const float, 16> numbers, const Convention& convention) noexcept;

// ---- A model's own coordinates

/// translation * rotation * scale, column vectors, as a glTF node has them. The quaternion is normalised. Each entry is
/// the double nearest the true one. Throws CameraError naming translation, rotation or scale where one is not finite or
/// the rotation is zero.
Mat4 worldFromLocal(const Vec3& translation, const Quaternion& rotation, const Vec3& scale);

/// A model's own coordinates to view, clip and screen space, and back: matrix() of the parts of a camera.
Mat4 viewFromLocal(const Pose& pose, const Mat4& worldFromLocal, const Convention& convention);
Mat4 localFromView(const Pose& pose, const Mat4& worldFromLocal, const Convention& convention);
Mat4 clipFromLocal(const Pose& pose, const Projection& projection, const Mat4& worldFromLocal,
                   const Convention& convention);
Mat4 localFromClip(const Pose& pose, const Projection& projection, const Mat4& worldFromLocal,
                   const Convention& convention);
Mat4 screenFromLocal(const Pose& pose, const Projection& projection, const Viewport& viewport,
                     const Mat4& worldFromLocal, const Convention& convention);
Mat4 localFromScreen(const Pose& pose, const Projection& projection, const Viewport& viewport,
                     const Mat4& worldFromLocal, const Convention& convention);

/// An affine matrix (last row 0 0 0 1) times a homogeneous point: each coordinate the double nearest the exact sum of
/// products; the weight stays. From there on the world point counts as exact. NaN where a number is not finite,
/// infinite where the sum leaves the doubles.
Vec4 toWorld(const Mat4& worldFromLocal, const Vec4& local) noexcept;

}  // namespace viewproj
