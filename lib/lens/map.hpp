// The map of a lens, in any number type: double-double, lanes of it, dual numbers. And how far its result may be from
// the true one.
//
// Everything here has internal linkage: each kernel is compiled for its own processor.
#pragma once

#include "lens/lens.hpp"

namespace viewproj::detail {
namespace {

/// 1 + k[0] u + k[1] u^2 + ...
template <class Number>
[[gnu::always_inline]] inline Number series(std::span<const double> k, const Number& u) noexcept {
  if (k.empty()) return 1.0;
  Number sum = k.back();
  for (std::size_t i = k.size() - 1; i-- > 0;) sum = sum * u + Number(k[i]);
  return sum * u + Number(1.0);
}

/// first + (first + step) |k[0]| u + ...: more than the sizes of a series's terms, or of its derivative's.
template <class D>
[[gnu::always_inline]] inline D sizes(std::span<const double> k, D u, double first, double step) noexcept {
  D sum{};
  for (std::size_t i = k.size(); i-- > 0;) sum = (sum + (first + step * double(i + 1)) * std::fabs(k[i])) * u;
  return sum + first;
}

/// A number and its slopes along x and y.
template <class D>
struct Dual {
  D value, x, y;

  Dual(D v, D alongX, D alongY) : value(v), x(alongX), y(alongY) {}
  Dual(double a) : value(D{} + a), x(D{}), y(D{}) {}  // NOLINT: a constant

  [[gnu::always_inline]] friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.x + b.x, a.y + b.y};
  }
  [[gnu::always_inline]] friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.x + a.x * b.value, a.value * b.y + a.y * b.value};
  }
  [[gnu::always_inline]] friend Dual operator/(const Dual& a, const Dual& b) {
    const D inverse = 1.0 / b.value, q = a.value * inverse;
    return {q, (a.x - q * b.x) * inverse, (a.y - q * b.y) * inverse};
  }
};

/// Brown's polynomials of a radius's square u: the factor g of the radius.
template <class Number>
[[gnu::always_inline]] inline Number radialFactor(const LensParts& lens, const Number& u) noexcept {
  const Number g = series(lens.numerator(), u);
  return lens.isRational() ? g / series(lens.denominator(), u) : g;
}

template <class Number>
[[gnu::always_inline]] inline PlanePoint<Number> brownOf(const LensParts& lens, const PlanePoint<Number>& at) noexcept {
  const Number &x = at.x, &y = at.y, u = x * x + y * y, g = radialFactor(lens, u);
  if (lens.tangential == 0) return {x * g, y * g};
  // x (g + 2 p1 y + 2 p2 x) + p2 u: the terms of viewproj/lens.hpp in another order.
  const Number p1 = lens.p[0], p2 = lens.p[1], turned = p1 * y + p2 * x, along = g + (turned + turned);
  return {x * along + p2 * u, y * along + p1 * u};
}

/// D of the sphere map; square is R^2.
template <class Number>
[[gnu::always_inline]] inline Number sphereDivisor(const LensParts& lens, const Number& square,
                                                   const Number& forward) noexcept {
  Number k = forward;
  if (lens.xi != 0) k = forward + Number(lens.xi) * sqrt(square + forward * forward);
  if (lens.alpha == 0) return k;
  const Number root = sqrt((lens.beta == 1 ? square : Number(lens.beta) * square) + k * k);
  return Number(lens.alpha) * root + Number(lens.oneLessAlpha) * k;
}

/// On the plane, and what it is computed by: the sphere map's divisor D or the angle map's t, and R^2.
template <class Number>
struct Mapped {
  PlanePoint<Number> at;
  Number measure, square;
};

/// Of a direction that the lens sees. Before Brown's polynomials and `scale`.
template <class Number>
[[gnu::always_inline]] inline Mapped<Number> mapOf(const LensParts& lens, const Sight<Number>& s) noexcept {
  constexpr double kTiny = 0x1p-900;
  const Number square = s.right * s.right + s.down * s.down;
  if (!lens.isAngle) {
    const Number divisor = sphereDivisor(lens, square, s.forward);
    return {{s.right / divisor, s.down / divisor}, divisor, square};
  }
  const bool isAcross = lens.model == LensModel::fov;
  const Number r = sqrt(square), t = angleOf(isAcross ? Number(lens.across) * r : r, s.forward);
  const Number put = t * series(lens.numerator(), Number(t * t)) / r;
  // Where the square may have underflowed, t is its tangent.
  const Number factor = choose(high(square) < kTiny, Number(Number(lens.across) / s.forward), put);
  return {{s.right * factor, s.down * factor}, t, square};
}

/// The lens's map, from what mapOf gives.
template <class Number>
[[gnu::always_inline]] inline PlanePoint<Number> planeOf(const LensParts& lens, const Mapped<Number>& mapped) noexcept {
  const PlanePoint<Number> at = lens.isBrown ? brownOf(lens, mapped.at) : mapped.at;
  return lens.isScaled ? PlanePoint<Number>{Number(lens.scale) * at.x, Number(lens.scale) * at.y} : at;
}

/// Whether a lens sees this direction; only then has it a pixel. A direction within 2^-49 of the limit is not seen.
inline Seen isSeen(const LensParts& lens, const Sight<DoubleDouble>& at) noexcept {
  if (lens.limitCosine.hi <= 0 && at.forward.hi > 0) return {true, true};
  const DoubleDouble r = sqrt(at.right * at.right + at.down * at.down);
  const double length = std::sqrt(r.hi * r.hi + at.forward.hi * at.forward.hi);
  const double side = (at.forward * lens.limitSine - r * lens.limitCosine).hi, limit = 0x1p-49 * length;
  return {side > limit, std::fabs(side - limit) > 0x1p-94 * length};
}

// ---- How far it may be from the true one

/// Operations of double-double are within 10 2^-106, of lanes of it 2^-101.
inline constexpr double kFineUnit = 0x1p-101;
/// An angle is within 128 2^-101.
inline constexpr double kAngleUnits = 128;

/// stretch: of the plane, by an angle in radians between directions. rounding: of the map, where each operation is
/// within one unit.
template <class D>
struct Response {
  D stretch, rounding;
};

/// More than a series in u and than 2 u times its slope, in magnitude, and less than the series, for all u from `low`
/// to `high`. A sum is what it is at `low`, and changes by less than its terms do. terms: more than their sizes.
template <class D>
struct SeriesRange {
  D most, slope, least, terms;

  [[gnu::always_inline]] SeriesRange(std::span<const double> k, D low, D high) noexcept {
    D value{}, steep{}, before{}, after{}, steepBefore{}, steepAfter{};
    for (std::size_t i = k.size(); i-- > 0;) {
      const double a = k[i], by = 2 * double(i + 1), size = std::fabs(a);
      value = (value + a) * low;
      steep = (steep + by * a) * low;
      before = (before + size) * low;
      after = (after + size) * high;
      steepBefore = (steepBefore + by * size) * low;
      steepAfter = (steepAfter + by * size) * high;
    }
    const auto magnitude = [](D a) { return a < 0.0 ? -a : a; };
    value = value + 1.0;
    most = magnitude(value) + (after - before);
    slope = magnitude(steep) + (steepAfter - steepBefore);
    least = value - (after - before);
    terms = 1.0 + after + steepAfter;
  }
};

/// Of Brown's polynomials, more than for all radii from `from` to `to`. Infinite next to a pole.
template <class D>
[[gnu::always_inline]] inline Response<D> brownResponse(const LensParts& lens, D from, D to) noexcept {
  constexpr double kSmallest = 0x1p-30;
  const D low = from * from, u = to * to;
  // x g(u) with g = n / d stretches by g, and along x by g + 2 u (n' - g d') / d.
  const SeriesRange<D> n(lens.numerator(), low, u);
  D stretch = 2.0 * (n.most + n.slope), rough = 2.0 * n.terms;
  if (lens.isRational()) {
    const SeriesRange<D> d(lens.denominator(), low, u);
    const D infinite = D{} + kInfinity, g = n.most / d.least;
    const auto isFar = d.least > kSmallest * d.terms;
    stretch = isFar ? D(2.0 * (g + (n.slope + g * d.slope) / d.least)) : infinite;
    rough = isFar ? D(rough / d.least * (1.0 + d.terms / d.least)) : infinite;
  }
  const double p = std::fabs(lens.p[0]) + std::fabs(lens.p[1]);
  return {stretch + 6 * p * to, 20.0 * rough * to + 24 * p * u};
}

/// Of the sphere map before Brown's polynomials; by is D / d1.
template <class D>
[[gnu::always_inline]] inline Response<D> sphereResponse(const LensParts& lens, D radius, D by) noexcept {
  const double a = std::fabs(lens.alpha) + std::fabs(lens.oneLessAlpha.hi), b = lens.beta > 1 ? lens.beta : 1;
  const double xi = std::fabs(lens.xi), rounding = a * (1 + 4.5 * xi + 5.5 * b * (1 + xi));
  const D inverse = 1.0 / by;
  if (lens.xi == 0 && lens.alpha == 0) return {inverse * inverse, radius * 2.0};  // tangents
  return {inverse * (1.0 + radius * (a * (b + 1))), radius * (rounding * inverse + 1.0)};
}

/// Of the angle map at t and all smaller angles. perSine: d1 / R.
template <class D>
[[gnu::always_inline]] inline Response<D> angleResponse(const LensParts& lens, D t, D perSine) noexcept {
  const double c = lens.across.hi, steepest = c > 1 ? c : 1 / c;
  const D of = sizes(lens.numerator(), D(t * t), 1, 2), along = steepest * of, across = t * of * perSine;
  return {along > across ? along : across, (2 * kAngleUnits) * (t * of)};
}

/// How far x and y may be from the true ones. The direction is one of length d1, by R off the axis, and within
/// angleError of the true one; mapOf gives the radius before Brown's polynomials, and the measure.
template <class D>
[[gnu::always_inline]] inline D errorOf(const LensParts& lens, D r, D d1, D measure, D angleError,
                                        double unit) noexcept {
  D error{};
  if (lens.isAngle) {
    const auto [stretch, rounding] = angleResponse(lens, measure, D(d1 / r));
    error = stretch * angleError + rounding * unit;
  } else {
    const D radius = r / measure;
    const auto [stretch, rounding] = sphereResponse(lens, radius, D(measure / d1));
    error = stretch * angleError + rounding * unit;
    if (lens.isBrown) {
      const D around = 2.0 * error + 0x1p-40 * radius, low = radius - around;
      const Response<D> brown = brownResponse(lens, low > 0.0 ? low : D{}, D(radius + around));
      error = brown.stretch * error + brown.rounding * unit;
    }
  }
  return (1.01 * lens.scale.hi) * error;
}

}  // namespace
}  // namespace viewproj::detail
