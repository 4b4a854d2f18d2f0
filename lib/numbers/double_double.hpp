// Double-double arithmetic: each result within a few 2^-106 of the true value, relative.
//
// Source: Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of double-word
// arithmetic", 2017. The bounds hold inside the range that error_free.hpp states; an infinite operand gives NaN.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "numbers/error_free.hpp"

#ifdef __clang__  // as in error_free.hpp
#pragma float_control(precise, on, push)
#endif

namespace viewproj::detail {

constexpr DoubleDouble operator-(DoubleDouble a) noexcept { return {-a.hi, -a.lo}; }

/// Relative error at most 3 * 2^-106.
constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble high = twoSum(a.hi, b.hi);
  const DoubleDouble low = twoSum(a.lo, b.lo);
  const DoubleDouble partial = quickTwoSum(high.hi, high.lo + low.hi);
  return quickTwoSum(partial.hi, low.lo + partial.lo);
}

constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) noexcept { return a + (-b); }

/// Relative error at most 5 * 2^-106.
constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble product = twoProd(a.hi, b.hi);
  const double cross = a.hi * b.lo + a.lo * b.hi;
  return quickTwoSum(product.hi, product.lo + (cross + a.lo * b.lo));
}

/// Relative error at most 2 * 2^-106.
constexpr DoubleDouble times(double a, DoubleDouble b) noexcept {
  const DoubleDouble product = twoProd(a, b.hi);
  return quickTwoSum(product.hi, product.lo + a * b.lo);
}

/// Relative error at most 10 * 2^-106.
constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) noexcept {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - b * DoubleDouble(first);
  const double second = rest.hi / b.hi;
  const DoubleDouble last = rest - b * DoubleDouble(second);
  return quickTwoSum(first, second) + DoubleDouble(last.hi / b.hi);
}

constexpr DoubleDouble& operator+=(DoubleDouble& a, DoubleDouble b) noexcept { return a = a + b; }

/// Terms with a relative error of up to 2^-99 that cancel to less than this share leave only noise.
inline constexpr double kCancellation = 0x1p-98;

/// a + b, or 0 if the terms cancel to less than their own error.
constexpr DoubleDouble sumOrZero(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble sum = a + b;
  const double size = sum.hi < 0 ? -sum.hi : sum.hi;
  const double of = a.hi < 0 ? -a.hi : a.hi;
  return size <= of * kCancellation ? DoubleDouble() : sum;
}

/// 2^k for |k| <= 1000.
inline double powerOfTwo(int k) noexcept { return std::bit_cast<double>(std::uint64_t(1023 + k) << 52); }

/// a * factor, where factor is a power of two: exact unless the low part underflows.
constexpr DoubleDouble timesPowerOfTwo(DoubleDouble a, double factor) noexcept {
  return {a.hi * factor, a.lo * factor};
}

/// a * 2^exponent, exact unless the low part underflows.
inline DoubleDouble scaleByPowerOfTwo(DoubleDouble a, int exponent) noexcept {
  if (exponent >= -1000 && exponent <= 1000) return timesPowerOfTwo(a, powerOfTwo(exponent));
  return {std::ldexp(a.hi, exponent), std::ldexp(a.lo, exponent)};
}

/// Relative error at most 4 * 2^-106. sqrt(0) is 0.
inline DoubleDouble sqrt(DoubleDouble a) noexcept {
  if (a.hi == 0) return {};
  const double root = std::sqrt(a.hi);
  const DoubleDouble rest = a - twoProd(root, root);
  return quickTwoSum(root, rest.hi / (2 * root));
}

/// Whether all numbers within error of a round to the same double (Ziv's test).
constexpr bool roundsAlike(DoubleDouble a, double error) noexcept {
  return a.hi + (a.lo + error) == a.hi && a.hi + (a.lo - error) == a.hi;
}

/// Half a unit in the last place of numbers of this size, at least the smallest double. Infinite for a size that is not
/// finite.
inline double halfUlp(double size) noexcept {
  size = std::fabs(size);
  if (!std::isfinite(size)) return kInfinity;
  if (size == std::numeric_limits<double>::max()) return (size - std::nextafter(size, 0)) / 2;
  return std::max((std::nextafter(size, kInfinity) - size) / 2, std::numeric_limits<double>::denorm_min());
}

/// The largest double not above x, and the smallest not below it.
inline double lowerDouble(const DoubleDouble& x) noexcept { return x.lo < 0 ? std::nextafter(x.hi, -kInfinity) : x.hi; }
inline double upperDouble(const DoubleDouble& x) noexcept { return -lowerDouble(-x); }

inline bool isFinite(DoubleDouble a) noexcept { return std::isfinite(a.hi) && std::isfinite(a.lo); }

}  // namespace viewproj::detail

#ifdef __clang__
#pragma float_control(pop)
#endif
