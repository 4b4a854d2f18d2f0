// Double-double with a bound on its error.
//
// Running error analysis (Higham, Accuracy and Stability of Numerical Algorithms, 3.3) with the bounds of
// double_double.hpp. A number that overflowed on the way is NaN and never certain. Underflow is part of the bound.
#pragma once

#include "numbers/wide.hpp"

namespace viewproj::detail {

/// A number is certain if its error is at most this share of it. Then its sign and digits are reliable.
inline constexpr double kCertainShare = 0x1p-75;

struct Certified {
  DoubleDouble value;
  double error = 0;  ///< |value - true number| is at most this

  Certified() = default;
  Certified(double a) noexcept : value(a) {}  // NOLINT: a double is exact
  Certified(DoubleDouble a, double e) noexcept : value(a), error(e) {}

  /// a - b exactly.
  static Certified difference(double a, double b) noexcept { return {twoDiff(a, b), 0}; }

  bool isExactlyZero() const noexcept { return value.hi == 0 && error == 0; }
  /// Whether the error is a small share of size.
  bool isWithin(double size) const noexcept {
    return std::isfinite(value.hi) && std::isfinite(size) && error <= kCertainShare * size;
  }
  bool isCertain() const noexcept { return isWithin(std::fabs(value.hi)); }
  /// Only for a certain number.
  int sign() const noexcept { return value.hi > 0 ? 1 : value.hi < 0 ? -1 : 0; }
  Wide rounded() const noexcept { return {value, 0}; }
};

inline Certified operator-(const Certified& a) noexcept { return {-a.value, a.error}; }

inline Certified operator+(const Certified& a, const Certified& b) noexcept {
  constexpr double up = 1 + 0x1p-50;  // for the rounding of the bound itself
  const DoubleDouble sum = a.value + b.value;
  return {sum, (a.error + b.error + 0x1p-104 * std::fabs(sum.hi)) * up};
}

inline Certified operator-(const Certified& a, const Certified& b) noexcept { return a + (-b); }

inline Certified operator*(const Certified& a, const Certified& b) noexcept {
  constexpr double up = 1 + 0x1p-50;
  constexpr double underflow = 0x1p-1060;
  if (a.isExactlyZero() || b.isExactlyZero()) return {};
  const DoubleDouble product = a.value * b.value;
  const double fromFactors = std::fabs(a.value.hi) * b.error + std::fabs(b.value.hi) * a.error + a.error * b.error;
  return {product, (fromFactors + 0x1p-103 * std::fabs(product.hi)) * up + underflow};
}

}  // namespace viewproj::detail
