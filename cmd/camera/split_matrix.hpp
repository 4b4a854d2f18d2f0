// Splits P = K [R | t] into its parts.
#pragma once

#include <array>
#include <span>

#include "numbers/vectors.hpp"

namespace viewproj::cmd {

struct SplitMatrix {
  detail::DoubleDouble fx, fy, cx, cy, skew;
  std::array<detail::DDVec3, 3> columns;  ///< the camera's axes (right, down, forward) in the world
  detail::DDVec3 eye;
};

/// Splits twelve numbers by rows. Throws CameraError if they are not of the form K [R | t].
SplitMatrix splitMatrix(std::span<const double> p);

/// Whether the pixels form a skewed grid, beyond the rounding of seven digits.
bool hasSkew(const SplitMatrix& split);
/// Throws CameraError if hasSkew.
void requireNoSkew(const SplitMatrix& split);

}  // namespace viewproj::cmd
