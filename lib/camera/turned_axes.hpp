// Axes that are turned by angles in degrees, to more digits than doubles have. Internal.
#pragma once

#include <array>
#include <cstddef>

#include "camera/pose.hpp"

namespace viewproj::detail {

/// What sums of products of sines and cosines may be off by in a row of unit length.
inline constexpr double kTurnedRowBound = 0x1p-206;

class TurnedAxes {
 public:
  explicit TurnedAxes(const std::array<Vector3<Dyadic<1>>, 3>& axes) : axes_(axes) {}

  /// Turns two of them in their plane:
  ///   | a' |   | cos  -sin | | a |
  ///   | b' | = | sin   cos | | b |
  void turn(std::size_t a, std::size_t b, double degrees) noexcept;

  /// One of them, or what is opposite to it.
  FineVec3 axis(std::size_t index, bool opposite = false) const noexcept;

 private:
  std::array<Vector3<Dyadic<1>>, 3> axes_;
  bool exact_ = true;  ///< turned by right angles only
};

}  // namespace viewproj::detail
