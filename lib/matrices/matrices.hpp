// The matrices of a camera, each written directly from its parameters, its inverse too.
//
// Named destinationFromSource. All are returned as matrices for column vectors, whatever the convention's vectors and
// storage say: laidOut and inStorageOrder apply those at the end. Entries are computed in double-double and rounded
// once; an entry too large for a double comes out infinite.
//
// Parts are as validate takes them (pose.hpp, projection.hpp, viewport.hpp), or a camera's; of others the entries mean
// nothing.
#pragma once

#include <array>

#include "camera/camera.hpp"

namespace viewproj {

/// World to view space; its axes are the convention's.
Mat4 viewFromWorld(const Pose& pose, const Convention& convention) noexcept;
Mat4 worldFromView(const Pose& pose, const Convention& convention) noexcept;

/// View space to clip space.
Mat4 clipFromView(const Projection& projection, const Convention& convention) noexcept;
Mat4 viewFromClip(const Projection& projection, const Convention& convention) noexcept;

/// World to clip space: not the rounded product of the two, but its own closed form.
Mat4 clipFromWorld(const Pose& pose, const Projection& projection, const Convention& convention) noexcept;
Mat4 worldFromClip(const Pose& pose, const Projection& projection, const Convention& convention) noexcept;

/// Normalised device coordinates to screen x, screen y and window depth, as a graphics API's viewport transform maps
/// them: NDC z of the low end goes to depthFirst.
Mat4 screenFromNdc(const Viewport& viewport, const Convention& convention) noexcept;
Mat4 ndcFromScreen(const Viewport& viewport, const Convention& convention) noexcept;

/// clipFromView with the viewport folded in: division by w then gives screen x, screen y and window depth.
Mat4 screenFromView(const Projection& projection, const Viewport& viewport, const Convention& convention) noexcept;
Mat4 viewFromScreen(const Projection& projection, const Viewport& viewport, const Convention& convention) noexcept;
Mat4 screenFromWorld(const Pose& pose, const Projection& projection, const Viewport& viewport,
                     const Convention& convention) noexcept;
Mat4 worldFromScreen(const Pose& pose, const Projection& projection, const Viewport& viewport,
                     const Convention& convention) noexcept;

/// The pose with its eye at the origin: what float32 at planet scale needs, with the eye subtracted beforehand.
Pose relativeToEye(const Pose& pose) noexcept;

/// The matrix as the convention writes it on paper: transposed for row vectors.
Mat4 laidOut(const Mat4& matrix, const Convention& convention) noexcept;

/// The sixteen numbers in the convention's memory order.
std::array<double, 16> inStorageOrder(const Mat4& matrix, const Convention& convention) noexcept;

}  // namespace viewproj
