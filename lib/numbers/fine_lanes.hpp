// Lanes of doubles and of double-doubles, for many points at a time: what a DoubleDouble is to a double.
//
// Everything here has internal linkage: each kernel is compiled for its own processor.
#pragma once

#include <cmath>
#include <type_traits>

#include "numbers/arctangent.hpp"

namespace viewproj::detail {
namespace {

/// The operations that formulas use. D is a double or a vector of doubles, M the result of comparing two D.
struct ScalarLanes {
  using D = double;
  using M = bool;
  static D splat(double a) { return a; }
  static D absolute(D a) { return std::fabs(a); }
  static D larger(D a, D b) { return a > b ? a : b; }
  static D squareRoot(D a) { return std::sqrt(a); }
  /// A bit for each lane.
  static unsigned bits(M m) { return m; }
  /// Calls a function for each lane.
  template <class Function>
  static D map(D a, const Function& function) {
    return function(a);
  }
  /// multiplyAdd: a * b + c, rounded once or twice. productError: the error of the rounded product of a * b.
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  static constexpr bool hasFusedMultiplyAdd = true;
  static D multiplyAdd(D a, D b, D c) { return __builtin_fma(a, b, c); }
  static D productError(D a, D b, D product) { return __builtin_fma(a, b, -product); }
#else
  static constexpr bool hasFusedMultiplyAdd = false;
  static D multiplyAdd(D a, D b, D c) { return a * b + c; }
  static D productError(D a, D b, D) { return twoProd(a, b).lo; }
#endif
};

/// Whether all conditions hold, lane by lane.
inline bool all(bool a, bool b) { return a && b; }
template <class A, class B>
inline A all(A a, B b) {
  return a & b;
}
template <class A, class B, class... More>
inline A all(A a, B b, More... more) {
  return all(all(a, b), more...);
}
/// Whether one of them does.
inline bool either(bool a, bool b) { return a || b; }
template <class A, class B>
inline A either(A a, B b) {
  return a | b;
}

/// |lo| <= ulp(hi)/2. Each result is within 2^-101 of the true one, of a sum relative to the sizes of its terms; an
/// angle within 2^-94.
template <class L>
struct Fine {
  using D = typename L::D;
  D hi, lo;

  Fine(D high, D low = D{}) : hi(high), lo(low) {}                            // NOLINT: exact, as of doubles
  Fine(double a) requires(!std::is_same_v<D, double>) : Fine(L::splat(a)) {}  // NOLINT: exact
  Fine(const DoubleDouble& a) : hi(L::splat(a.hi)), lo(L::splat(a.lo)) {}     // NOLINT: exact

  static Fine twoSum(D a, D b) {
    const D sum = a + b, part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
  }
  /// |a| >= |b|.
  static Fine quickTwoSum(D a, D b) {
    const D sum = a + b;
    return {sum, b - (sum - a)};
  }

  friend D high(const Fine& a) { return a.hi; }
  friend Fine choose(typename L::M condition, const Fine& a, const Fine& b) {
    return {condition ? a.hi : b.hi, condition ? a.lo : b.lo};
  }
  template <class Entry>
  friend Fine entryAt(const Fine& position, const Entry& entry) {
    return {L::map(position.hi, [&](double i) { return DoubleDouble(entry(static_cast<int>(i))).hi; }),
            L::map(position.hi, [&](double i) { return DoubleDouble(entry(static_cast<int>(i))).lo; })};
  }
  friend Fine operator-(const Fine& a) { return {-a.hi, -a.lo}; }
  friend Fine operator+(const Fine& a, const Fine& b) {
    const Fine sum = twoSum(a.hi, b.hi);
    return quickTwoSum(sum.hi, sum.lo + (a.lo + b.lo));
  }
  friend Fine operator-(const Fine& a, const Fine& b) { return a + (-b); }
  friend Fine operator*(const Fine& a, const Fine& b) {
    const D product = a.hi * b.hi;
    return quickTwoSum(product, L::productError(a.hi, b.hi, product) + (a.hi * b.lo + a.lo * b.hi));
  }
  friend Fine operator/(const Fine& a, const Fine& b) {
    const D inverse = 1.0 / b.hi, q = a.hi * inverse, product = q * b.hi;
    const D rest = ((a.hi - product) - L::productError(q, b.hi, product)) + (a.lo - q * b.lo);
    return quickTwoSum(q, rest * inverse);
  }
  friend Fine sqrt(const Fine& a) {
    const D root = L::squareRoot(a.hi), square = root * root;
    const D rest = ((a.hi - square) - L::productError(root, root, square)) + a.lo;
    return quickTwoSum(root, rest / (2.0 * root));
  }
};

}  // namespace
}  // namespace viewproj::detail
