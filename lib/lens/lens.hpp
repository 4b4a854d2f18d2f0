// A lens's numbers, and its map in double or double-double.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "camera/access.hpp"
#include "numbers/arctangent.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::detail {

/// Tangents are below this: what is farther aside is beyond every lens.
inline constexpr double kLargestTangent = 0x1p60;

struct LensParts {
  LensModel model = LensModel::brown;
  std::array<double, 6> k{};
  std::array<double, 2> p{};
  std::size_t numeratorTerms = 0, denominatorTerms = 0;  ///< without zeros at the end; of a fisheye's k the first
  double tangential = 0;                                 ///< hypot(p1, p2), rounded up

  /// Points from here on have no pixel, a radius of brown, an angle of fisheye; and what gives it. Below it the map is
  /// proven one-to-one. Infinite for none.
  double limit = std::numeric_limits<double>::infinity();
  LimitCause cause = LimitCause::none;
  /// What the functions here go by: kLargestTangent in place of an infinite radius, 2 of an angle past a quarter turn.
  double end = kLargestTangent;
  /// Points are put nearer to the axis than this.
  double outerEdge = std::numeric_limits<double>::infinity();

  /// k1, k2, ...
  std::span<const double> numerator() const noexcept { return {k.data(), numeratorTerms}; }
  /// k4, k5, ...
  std::span<const double> denominator() const noexcept { return {k.data() + 3, denominatorTerms}; }
  bool isRational() const noexcept { return denominatorTerms > 0; }
};

inline const LensParts& parts(const Lens& lens) noexcept { return *Access::shared(lens); }

/// The limit of a lens's own numbers, and its cause: lib/lens/limit.cpp.
struct Limit {
  double value;
  LimitCause cause;
};
Limit limitOf(const LensParts& lens);

/// 1 + k[0] u + k[1] u^2 + ...
template <class Number>
Number series(std::span<const double> k, const Number& u) noexcept {
  if (k.empty()) return 1;
  Number sum = k.back();
  for (std::size_t i = k.size() - 1; i-- > 0;) sum = sum * u + Number(k[i]);
  return sum * u + Number(1);
}

inline double high(double a) noexcept { return a; }
inline double arctangent(double r) noexcept { return arctangent(DoubleDouble(r)).hi; }

template <class Number>
struct Tangents {
  Number x, y;
};

/// What radial distances are multiplied by; and the square of what the lens's end counts, of brown's radius or of a
/// fisheye's angle. Of numbers, or of lanes of them (projection/kernels/fine_lanes.hpp).
template <class Number>
struct Radial {
  Number factor, square;
};

/// Of a squared radius, wherever it is.
template <class Number>
Radial<Number> radial(const LensParts& lens, const Number& u) noexcept {
  using std::sqrt;
  constexpr double kTiny = 0x1p-900;
  if (lens.model == LensModel::brown) {
    const Number numerator = series(lens.numerator(), u);
    return {lens.isRational() ? numerator / series(lens.denominator(), u) : numerator, u};
  }
  const Number r = sqrt(u), angle = arctangent(r), square = angle * angle;
  return {choose(high(u) < kTiny, Number(1), Number(angle * series(lens.numerator(), square) / r)), square};
}

/// radial's factor; NaN from the limit on.
template <class Number>
Number radialFactor(const LensParts& lens, const Number& u) noexcept {
  constexpr double kCloser = 1 + 0x1p-49;
  const Radial<Number> at = radial(lens, u);
  const bool isBefore = high(u) < kLargestTangent * kLargestTangent && high(at.square) * kCloser < lens.end * lens.end;
  return isBefore ? at.factor : Number(std::numeric_limits<double>::quiet_NaN());
}

/// Tangents of the squared radius u and this factor, bent.
template <class Number>
Tangents<Number> bend(const LensParts& lens, const Tangents<Number>& at, const Number& u, const Number& g) noexcept {
  const Number &x = at.x, &y = at.y;
  if (lens.tangential == 0) return {x * g, y * g};
  // x (g + 2 p1 y + 2 p2 x) + p2 u: the terms of the header in another order.
  const Number p1 = lens.p[0], p2 = lens.p[1], turned = p1 * y + p2 * x, along = g + (turned + turned);
  return {x * along + p2 * u, y * along + p1 * u};
}

template <class Number>
Tangents<Number> distort(const LensParts& lens, const Tangents<Number>& at) noexcept {
  const Number u = at.x * at.x + at.y * at.y;
  return bend(lens, at, u, radialFactor(lens, u));
}

/// The tangents that are put there, and how far they may be from the true ones, as an angle in radians; a NaN where
/// none are proven to be the only ones: lib/lens/undistort.cpp.
struct Undistorted {
  Tangents<DoubleDouble> at;
  double error;
};
Undistorted undistort(const LensParts& lens, const Tangents<DoubleDouble>& target) noexcept;

}  // namespace viewproj::detail
