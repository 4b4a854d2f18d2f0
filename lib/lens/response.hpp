// What a lens does to small differences and to rounding errors, between two distances from the axis. Internal.
#pragma once

#include "lens/lens.hpp"

namespace viewproj::detail {

struct Range {
  double low, high;
};

/// Proven bounds over a range of distances r from the axis, before the lens.
struct Response {
  Range radial, tangential;  ///< stretching along and across, without p1 and p2
  double stretch = 0;        ///< the largest factor of a difference, with p1 and p2
  double least = 0;          ///< the least, or 0
  double rounding = 0;       ///< of distort, in units of kFineUnit
};
Response responseOver(const LensParts& lens, const Range& r) noexcept;

/// The slope of a fisheye's distances, over a range of angles.
Range slopeOver(const LensParts& lens, const Range& angle) noexcept;

/// Operations of double-double are within 10 2^-106, of lanes of it 2^-101, an arctangent within 2^-94.
inline constexpr double kFineUnit = 0x1p-94;

/// first + (first + step) k[0] u + ..., of magnitudes.
template <class D>
[[gnu::always_inline]] inline D sizes(std::span<const double> k, D u, double first, double step) noexcept {
  D sum{};
  for (std::size_t i = k.size(); i-- > 0;) sum = (sum + (first + step * double(i + 1)) * std::fabs(k[i])) * u;
  return sum + 1.0;
}

/// More than stretch and rounding are within error of r, in a few operations: for certificates that have digits to
/// spare. Infinite next to a pole. D: a double, or lanes.
template <class D>
struct Roughly {
  D stretch, rounding;
};
template <class D>
[[gnu::always_inline]] inline Roughly<D> roughly(const LensParts& lens, D r, D error) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kSmallest = 0x1p-30;
  const D outer = r * (1 + 0x1p-40) + 2.0 * error;
  if (lens.model == LensModel::fisheye) {
    const D largest = D{} + 1.6, t = outer < largest ? outer : largest;
    const D most = 2.0 * sizes(lens.numerator(), D(t * t), 1, 2);
    return {most, 20.0 * most * t};
  }
  const D u = outer * outer, ofN = sizes(lens.numerator(), u, 1, 2);
  D most = 2.0 * ofN;
  if (lens.isRational()) {
    D d{};
    for (std::size_t i = lens.denominatorTerms; i-- > 0;) d = (d + lens.denominator()[i]) * u;
    d = d + 1.0;
    const D ofD = sizes(lens.denominator(), u, 1, 2), infinite = D{} + kInfinity;
    most = 2.0 * (ofN / d) * (1.0 + ofD / d);
    // Within the error it is hardly less than this.
    const auto isBounded = (d > kSmallest * ofD) & ((error < kSmallest * kSmallest * r) | (ofD < 1.5));
    most = isBounded ? most : infinite;
  }
  const double p = std::fabs(lens.p[0]) + std::fabs(lens.p[1]);
  return {most + 6 * p * outer, 20.0 * most * outer + 24 * p * u};
}

}  // namespace viewproj::detail
