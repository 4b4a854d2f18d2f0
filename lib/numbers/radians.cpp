#include "numbers/radians.hpp"

#include "numbers/degrees.hpp"

namespace viewproj {

DoubleDouble tanHalfRadians(DoubleDouble radians) noexcept {
  constexpr DoubleDouble kDegreesPerRadian{0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49};
  constexpr double kRadiansPerHalfDegree = 0x1.1df46a2529d39p-7;
  const DoubleDouble degrees = radians * kDegreesPerRadian;
  // tan(a + b) = (tan a + tan b) / (1 - tan a tan b), where b, half the low part, is its own tangent.
  const DoubleDouble tangent = tanHalfDegrees(degrees.hi);
  const DoubleDouble rest = degrees.lo * kRadiansPerHalfDegree;
  return (tangent + rest) / (DoubleDouble(1) - tangent * rest);
}

}  // namespace viewproj
