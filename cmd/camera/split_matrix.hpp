// P = K [R | t], taken apart.
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

/// Of twelve numbers by rows. Throws CameraError for what is no such matrix.
SplitMatrix splitMatrix(std::span<const double> p);

/// Whether its pixels are of a skewed grid, up to what rounding to seven digits leaves.
bool hasSkew(const SplitMatrix& split);
/// Throws CameraError where they are.
void requireNoSkew(const SplitMatrix& split);

}  // namespace viewproj::cmd
