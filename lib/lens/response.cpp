// First-order bounds in units of the rounding unit, which the factor 1.01 makes whole. Each product and sum of
//   g = N / D, x g + 2 p1 x y + p2 (u + 2 x^2)
// rounds once, u = x^2 + y^2 three times, with the x = X / Z that it is made of four: a coefficient k_j u^j is off by
// 7, 13, 19 units, N by their sum aN = 1 + 7 |k1| u + 13 |k2| u^2 + 19 |k3| u^3, D by aD likewise, g by |g| (aN / |N| +
// aD / |D| + 1), x g by |x| (that + 4 |g|), and the tangential terms by at most 24 (|p1| + |p2|) u. A fisheye's t (1 +
// k1 w + ...) / r x has a = 1 + 12 |k1| w + 23 |k2| w^2 + 34 |k3| w^3 + 45 |k4| w^4, and is off by t a + 9 |rho|.
#include "lens/response.hpp"

#include <algorithm>

namespace viewproj::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A little wider than computed.
Range outwards(double low, double high) noexcept {
  constexpr double kUnit = 0x1p-52, kLeast = 0x1p-400;  // products of it are no subnormal numbers
  return {low - (std::fabs(low) * kUnit + kLeast), high + (std::fabs(high) * kUnit + kLeast)};
}

Range operator+(const Range& a, const Range& b) noexcept { return outwards(a.low + b.low, a.high + b.high); }
Range operator-(const Range& a, const Range& b) noexcept { return outwards(a.low - b.high, a.high - b.low); }
Range operator*(const Range& a, const Range& b) noexcept {
  const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return outwards(low, high);
}
/// b above 0.
Range operator/(const Range& a, const Range& b) noexcept { return a * outwards(1 / b.high, 1 / b.low); }
double size(const Range& a) noexcept { return std::max(std::fabs(a.low), std::fabs(a.high)); }

Range exactly(double a) noexcept { return {a, a}; }

/// factor(0) + factor(1) k[0] u + factor(2) k[1] u^2 + ...
template <class Factor>
Range series(std::span<const double> k, const Range& u, const Factor& factor) noexcept {
  Range sum = exactly(0);
  for (std::size_t i = k.size(); i-- > 0;) sum = (sum + exactly(factor(i + 1)) * exactly(k[i])) * u;
  return sum + exactly(factor(0));
}

double one(std::size_t) noexcept { return 1; }
double twice(std::size_t i) noexcept { return 2 * double(i); }

Response brown(const LensParts& lens, const Range& r) noexcept {
  const Range u = outwards(r.low * r.low, r.high * r.high);
  const Range n = series(lens.numerator(), u, one), d = series(lens.denominator(), u, one);
  if (!(d.low > 0)) return {{-kInfinity, kInfinity}, {-kInfinity, kInfinity}, kInfinity, 0, kInfinity};
  Response result;
  // 2 u times the derivatives.
  const Range dn = series(lens.numerator(), u, twice), dd = series(lens.denominator(), u, twice);
  const Range g = lens.isRational() ? n / d : n;
  result.tangential = g;
  result.radial = g + (lens.isRational() ? (dn - g * dd) / d : dn);
  const double ofN = sizes(lens.numerator(), u.high, 1, 6), ofD = sizes(lens.denominator(), u.high, 1, 6);
  const double ofG = lens.isRational() ? (ofN + size(g) * ofD) / d.low + size(g) : ofN;
  result.rounding = r.high * (ofG + 4 * size(g)) + 24 * (std::fabs(lens.p[0]) + std::fabs(lens.p[1])) * u.high;
  return result;
}

Response fisheye(const LensParts& lens, const Range& r) noexcept {
  constexpr double kMargin = 0x1p-50;
  const double from = arctangent(r.low), to = arctangent(r.high);
  const Range t = {from * (1 - kMargin), to * (1 + kMargin)};
  const Range factor = series(lens.numerator(), t * t, one);
  // t / r falls from 1.
  const double least = r.high > 0 ? to / r.high : 1, most = r.low > 0 ? from / r.low : 1;
  Response result;
  result.tangential = factor * Range{least * (1 - kMargin), most * (1 + kMargin)};
  result.radial = slopeOver(lens, t) / (exactly(1) + outwards(r.low * r.low, r.high * r.high));
  result.rounding = t.high * (sizes(lens.numerator(), t.high * t.high, 1, 11) + 9 * size(factor));
  return result;
}

}  // namespace

Range slopeOver(const LensParts& lens, const Range& angle) noexcept {
  return series(lens.numerator(), angle * angle, [](std::size_t i) { return 2 * double(i) + 1; });
}

Response responseOver(const LensParts& lens, const Range& r) noexcept {
  Response result = lens.model == LensModel::brown ? brown(lens, r) : fisheye(lens, r);
  const Range &q = result.radial, &g = result.tangential;
  const double turning = lens.tangential * r.high * (1 + 0x1p-40);
  result.stretch = 1.01 * (std::max(size(q), size(g)) + 6 * turning);
  // The Jacobian less m is positive definite by what limit.cpp says, and g > 2 P r.
  const double least = std::min({q.low - 6 * turning, g.low - 2 * turning, (q.low + 3 * g.low - 16 * turning) / 4});
  result.least = std::max(0.0, least * (1 - 0x1p-40));
  result.rounding *= 1.01;
  return result;
}

}  // namespace viewproj::detail
