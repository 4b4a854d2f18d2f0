// Units in the last place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/double_double.hpp"

namespace viewproj::detail {

/// Half a unit in the last place of numbers up to this size, or the smallest double; infinite for a size that is not
/// finite.
inline double halfUlp(double size) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  size = std::fabs(size);
  if (!std::isfinite(size)) return kInfinity;
  if (size == std::numeric_limits<double>::max()) return (size - std::nextafter(size, 0)) / 2;
  return std::max((std::nextafter(size, kInfinity) - size) / 2, std::numeric_limits<double>::denorm_min());
}

/// The double next to a number, not above and not below it.
inline double lowerDouble(const DoubleDouble& x) noexcept {
  return x.lo < 0 ? std::nextafter(x.hi, -std::numeric_limits<double>::infinity()) : x.hi;
}
inline double upperDouble(const DoubleDouble& x) noexcept { return -lowerDouble(-x); }

}  // namespace viewproj::detail
