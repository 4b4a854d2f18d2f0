// Units in the last place.
#pragma once

#include <cmath>
#include <limits>

namespace viewproj {

/// Half a unit in the last place of numbers up to this size; infinite for a size that is not finite.
inline double halfUlp(double size) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  size = std::fabs(size);
  return std::isfinite(size) ? (std::nextafter(size, kInfinity) - size) / 2 : kInfinity;
}

}  // namespace viewproj
