// Error-free transforms: a sum or a product of two doubles as the rounded result and its exact error.
//
// Valid while no intermediate overflows and no product's error underflows: |a|, |b| < 2^996 and |a*b| > 2^-969 (or
// zero). Sources: Knuth (twoSum), Dekker 1971 (split, twoProd). They need strict IEEE arithmetic without contraction,
// so the build passes -ffp-contract=off. The compiler's other settings are checked here as far as it defines macros for
// them; arithmetic.hpp checks what only a running thread can know.
#pragma once

#include <cfloat>
#include <limits>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "viewproj needs IEEE arithmetic: -ffast-math and -funsafe-math-optimizations destroy its error-free transforms"
#endif
#if defined(__NO_SIGNED_ZEROS__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "viewproj needs IEEE arithmetic, with signed zeros, infinities and NaN: -ffinite-math-only leaves them out"
#endif
#if FLT_EVAL_METHOD != 0
#error \
    "viewproj needs double arithmetic in doubles: on x86 of 32 bits -msse2 -mfpmath=sse; no -funsafe-math-optimizations"
#endif

// clang++ up to 14 defines no macro for -funsafe-math-optimizations, but this pragma turns it off here.
#ifdef __clang__
#pragma float_control(precise, on, push)
#endif

namespace viewproj::detail {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An unevaluated sum hi + lo with |lo| <= ulp(hi)/2: about 106 bits.
struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : hi(value) {}  // NOLINT: a double is an exact double-double
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
};

/// a + b exactly.
constexpr DoubleDouble twoSum(double a, double b) noexcept {
  const double sum = a + b;
  const double bPart = sum - a;
  return {sum, (a - (sum - bPart)) + (b - bPart)};
}

/// a - b exactly.
constexpr DoubleDouble twoDiff(double a, double b) noexcept { return twoSum(a, -b); }

/// a + b exactly, given |a| >= |b| or a == 0.
constexpr DoubleDouble quickTwoSum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a * b exactly.
constexpr DoubleDouble twoProd(double a, double b) noexcept {
  const double product = a * b;
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  if (!__builtin_is_constant_evaluated()) return {product, __builtin_fma(a, b, -product)};
#endif
  constexpr double splitter = 0x1p27 + 1;
  const double aScaled = splitter * a;
  const double bScaled = splitter * b;
  const double aHigh = aScaled - (aScaled - a);
  const double bHigh = bScaled - (bScaled - b);
  const double aLow = a - aHigh;
  const double bLow = b - bHigh;
  return {product, ((aHigh * bHigh - product) + aHigh * bLow + aLow * bHigh) + aLow * bLow};
}

#ifdef __clang__
#pragma float_control(pop)
#endif

}  // namespace viewproj::detail
