// The lens of a clip matrix, and how far the errors of its entries move it.
#pragma once

#include <array>
#include <cstddef>

#include "camera/projection.hpp"
#include "cameras_of/clip_parts.hpp"
#include "viewproj/cameras_of.hpp"

namespace viewproj::detail {

/// Of the first three entries.
double lengthOf(const std::array<double, 4>& row) noexcept;

/// Half a unit in the last place of each entry.
Mat4 roundingErrors(const Mat4& m) noexcept;

/// What the second order adds to errors of the first.
double secondOrder(const Mat4& m, const Mat4& errors) noexcept;

/// Of the point where three rows are 0: |M^-1| (E |point| + E_last).
Vec3 pointErrors(const Mat4& m, const Mat4& errors, const std::array<std::size_t, 3>& rows, const Vec3& point) noexcept;

/// Of the angle between the edges of x (row 0) or y (row 1), in degrees. With k = scale and o = offset of the row's
/// line, the edges are (+-1 - o) / k.
double fovError(const Mat4& errors, const ClipParts& parts, std::size_t row) noexcept;

/// The total change of depth's offset and scale when each entry changes by its error.
struct DepthErrors {
  double offset = 0, scale = 0;
};
DepthErrors depthErrors(const Mat4& m, const Mat4& entryErrors, const ClipParts& parts) noexcept;

/// Solves z / w = A + B / w, which is atNear at near: near = B / (atNear - A), and likewise far, with 1 / near > 1 /
/// far >= 0. False if there is no such near and far.
bool setPerspectiveDepth(MatrixLens& lens, DepthLine depth, DepthErrors errors, DepthEnds z) noexcept;

/// Solves z = A + B W, with B > 0 along the parts' forward. The camera's forward is opposite if depth is reversed.
void setOrthographicDepth(MatrixLens& lens, DepthLine depth, DepthErrors errors, DepthEnds z) noexcept;

/// Sets the window, and the projection if one can be made.
void setWindow(MatrixLens& lens, const ClipParts& p, NdcY ndcY);

}  // namespace viewproj::detail
