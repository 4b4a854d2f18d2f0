// Axes turned by angles in degrees, with more digits than doubles have. Internal.
#pragma once

#include <array>
#include <cstddef>

#include "camera/pose.hpp"

namespace viewproj::detail {

/// Error in a row of unit length from sums of products of sines and cosines.
inline constexpr double kTurnedRowBound = 0x1p-206;

class TurnedAxes {
 public:
  explicit TurnedAxes(const std::array<Vector3<Dyadic<1>>, 3>& axes) : axes_(axes) {}

  /// Turns two of the axes in their plane:
  ///   | a' |   | cos  -sin | | a |
  ///   | b' | = | sin   cos | | b |
  void turn(std::size_t a, std::size_t b, const Angle& angle) noexcept;

  /// One of the axes, or its opposite.
  FineVec3 axis(std::size_t index, bool opposite = false) const noexcept;

 private:
  std::array<Vector3<Dyadic<1>>, 3> axes_;
};

}  // namespace viewproj::detail
