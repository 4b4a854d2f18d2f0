// The rows of a pose before any rounding.
#pragma once

#include <array>

#include "numbers/expansion.hpp"
#include "numbers/vectors.hpp"

namespace viewproj {

using ExactVec3 = std::array<Expansion<8>, 3>;

/// A vector to more digits than doubles have: each component is within error of the sum of its terms.
struct FineVec3 {
  ExactVec3 terms;
  double error = 0;
};

/// What the directions of a pose's rows were made of, for where products of the numbers leave the range of doubles.
struct PoseSource {
  enum class Kind {
    rows,      ///< the exact rows themselves, which lost nothing
    look,      ///< from, to, up
    rotation,  ///< the quaternion's x, y, z; then w
    columns,   ///< x, y, z of a worldFromCamera
  };
  Kind kind = Kind::rows;
  std::array<Vec3, 3> numbers{};
  bool leftHanded = false;     ///< look
  std::array<int, 3> along{};  ///< rotation, columns: the row of right, up, forward that x, y, z lie along
  std::array<double, 3> sign{};
};

inline constexpr double kSmallestTerm = 0x1p-250;

/// The rows of a pose before any rounding, for points whose distances cancel beyond double-double. With
/// d = point - origin, the distances along the camera's axes are
///   X = rightScale (right . d + translation.x)   and so on,
/// where only the scales, common factors of a row, are rounded.
struct ExactRows {
  ExactVec3 right, forward;
  ExactVec3 up;            ///< unused if upIsCross
  bool upIsCross = false;  ///< up is right x forward of these two, not computed until it is needed
  DoubleDouble rightScale = 1, upScale = 1, forwardScale = 1;
  Vec3 origin;
  ExactVec3 translation;
  /// Of an entry once scaled, and of a translation relative to the largest: 0 unless the pose was made of sines and
  /// cosines, or of products of entries that are too many magnitudes apart.
  double error = 0;
  /// Whether no term is so small (below kSmallestTerm) that a product with it could underflow. Where one is, right, up
  /// and forward may have lost such terms, and source is what counts.
  bool isNarrow = true;
  PoseSource source{};
};

}  // namespace viewproj
