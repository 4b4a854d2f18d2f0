// The rows of a clip matrix as those of a pose, before any rounding. Internal.
#pragma once

#include "camera/pose.hpp"

namespace viewproj::cmd {

/// With clip = (scaleX X + offsetX W, scaleY Y + offsetY W, ., W) or (scaleX X + offsetX, scaleY Y + offsetY, ., 1), up
/// to a factor of the whole matrix.
struct ClipRows {
  detail::ExactRows rows;  ///< X, Y and W of a point
  detail::DoubleDouble scaleX, offsetX, scaleY, offsetY;
};

/// Of a matrix that acts on column vectors. Y grows with NDC's y or, where up is -1, against it; in orthographic
/// forward is 1 or -1 likewise.
ClipRows perspectiveRows(const Mat4& clipFromWorld, double up) noexcept;
ClipRows orthographicRows(const Mat4& clipFromWorld, double up, double forward) noexcept;

}  // namespace viewproj::cmd
