// Where a lens stops being one-to-one, from below.
//
// The map of brown is the gradient of a function, so that its Jacobian is symmetric. In radial and tangential axes,
// with P = hypot(p1, p2) and c, s the cosine and sine of the angle between (x, y) and (p2, p1), it is
//   q + 6 P r c    -2 P r s          q = d(r g)/dr = g + 2 u g'
//    -2 P r s     g + 2 P r c
// At c = -1 it is diag(q - 6 P r, g - 2 P r), and where q + 3 g >= 16 P r its determinant is least there. So it is
// positive definite on the disc up to the first r > 0 where
//   D = 0,  q - 6 P r = 0  or  q + 3 g - 16 P r = 0
// and a map of positive definite Jacobian on a convex set is one-to-one. With D^2 multiplied these are polynomials in
// r:
//   N D + 2 u (N' D - N D') - 6 P r D^2,  4 N D + 2 u (N' D - N D') - 16 P r D^2
// and of a fisheye one in the square of the angle, 1 + 3 k1 w + 5 k2 w^2 + 7 k3 w^3 + 9 k4 w^4.
//
// The sphere map keeps the azimuth, so it is one-to-one as far as the radius rises with the angle. With theta2 the
// angle of (R, k) and cos that of the angle,
//   dtheta2/dtheta = (1 + xi cos) / (1 + 2 xi cos + xi^2)
// is positive for |xi| < 1, and else up to cos = -1/xi. For beta = 1 the radius is sin2 / (alpha + (1 - alpha) cos2),
// whose slope has the sign of alpha cos2 + 1 - alpha; both that and the divisor are positive for cos2 > -w, with
//   w = (1 - alpha) / alpha  for alpha > 1/2, where the slope ends (a fold),  else  alpha / (1 - alpha)  (a pole)
// beta scales tan(theta2), which keeps the order. Brown's polynomials after it are one-to-one on their disc, and so is
// the composition.
#include <algorithm>
#include <cmath>
#include <vector>

#include "lens/inverse.hpp"
#include "numbers/degrees.hpp"

namespace viewproj::detail {
namespace {

/// By powers of the variable; with the size of what a coefficient is a sum of, which may cancel.
struct Coefficient {
  double value = 0, size = 0;
};
using Polynomial = std::vector<Coefficient>;

Polynomial sum(Polynomial a, const Polynomial& b, double factor) {
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < b.size(); ++i) {
    a[i].value += factor * b[i].value;
    a[i].size += std::fabs(factor) * b[i].size;
  }
  return a;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      c[i + j].value += a[i].value * b[j].value;
      c[i + j].size += a[i].size * b[j].size;
    }
  return c;
}

/// 1 + k[0] r^2 + k[1] r^4 + ..., with a coefficient times each.
Polynomial even(std::span<const double> k) {
  Polynomial a(2 * k.size() + 1);
  a[0] = {1, 1};
  for (std::size_t i = 0; i < k.size(); ++i) a[2 * i + 2] = {k[i], std::fabs(k[i])};
  return a;
}

/// 2 u da/du = r da/dr.
Polynomial timesDerivative(Polynomial a) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = {double(i) * a[i].value, double(i) * a[i].size};
  return a;
}

/// The numbers of both halves of [0, 1], by de Casteljau.
struct Halves {
  std::vector<double> left, right;
};
Halves halves(const std::vector<double>& bernstein) {
  Halves h{{}, bernstein};
  for (std::size_t n = bernstein.size(); n > 0; --n) {
    h.left.push_back(h.right.front());
    for (std::size_t i = 0; i + 1 < n; ++i) h.right[i] = (h.right[i] + h.right[i + 1]) / 2;
  }
  return h;
}

/// How far from start a polynomial is proven to be above `least`, by its Bernstein coefficients over start to start +
/// width: it lies between the smallest and the largest of them.
double provenUpTo(const std::vector<double>& bernstein, double least, double start, double width) {
  if (*std::min_element(bernstein.begin(), bernstein.end()) > least) return start + width;
  if (bernstein.front() <= least || width < 0x1p-48) return start;
  const auto [left, right] = halves(bernstein);
  const double middle = start + width / 2, proven = provenUpTo(left, least, start, width / 2);
  return proven < middle ? proven : provenUpTo(right, least, middle, width / 2);
}

std::vector<double> bernstein(const std::vector<double>& powers) {
  const std::size_t degree = powers.size() - 1;
  std::vector<double> b(powers.size());
  for (std::size_t j = 0; j <= degree; ++j) {
    double share = 1;  // of binomials: j over i, degree over i
    for (std::size_t i = 0; i <= j; ++i) {
      b[j] += share * powers[i];
      share *= double(j - i) / double(degree - i);
    }
  }
  return b;
}

/// A polynomial that is positive at 0 is so up to here at least; infinite if everywhere, or beyond kLargestRadius.
double firstZero(Polynomial a) {
  while (a.size() > 1 && a.back().size == 0) a.pop_back();
  // In units of powers of two: from 0 to the first, in which no coefficient is larger than that of 1, then octaves.
  const auto scaled = [](double value, std::size_t power, int exponent) {
    return std::ldexp(value, static_cast<int>(power) * exponent);
  };
  int exponent = 0;
  for (std::size_t i = 1; i < a.size(); ++i)
    while (scaled(a[i].size, i, exponent) > a[0].size) --exponent;
  for (double start = 0; std::ldexp(1, exponent) <= kLargestRadius; ++exponent, start = 0.5) {
    std::vector<double> powers;
    double size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      powers.push_back(scaled(a[i].value, i, exponent));
      size += scaled(a[i].size, i, exponent);
    }
    // Rounding: of 14 coefficients by 13 x 48 halvings, and by 64 units of products and the change of basis.
    const double least = 0x1p-40 * size;
    std::vector<double> here = bernstein(powers);
    if (start > 0) here = halves(here).right;
    const double proven = provenUpTo(here, least, start, 1 - start);
    if (proven < 1) return std::ldexp(proven, exponent);
    // All the rest, in 1 / r.
    std::reverse(powers.begin(), powers.end());
    const std::vector<double> beyond = bernstein(powers);
    if (*std::min_element(beyond.begin(), beyond.end()) > least) break;
  }
  return kInfinity;
}

/// Where Brown's polynomials end, and why.
struct Limit {
  double value;
  LimitCause cause;
};
Limit limitOfBrown(const LensParts& lens) {
  const Polynomial n = even(lens.numerator()), d = even(lens.denominator());
  const Polynomial nd = product(n, d), dd = product(d, d);
  const Polynomial slope = sum(product(timesDerivative(n), d), product(n, timesDerivative(d)), -1);
  Polynomial tangential = dd;  // times r
  tangential.insert(tangential.begin(), Coefficient{});
  const double fold = std::min(firstZero(sum(sum(nd, slope, 1), tangential, -6 * lens.tangential)),
                               firstZero(sum(sum(slope, nd, 4), tangential, -16 * lens.tangential)));
  const double pole = firstZero(d);
  if (pole <= fold && pole < kLargestRadius) return {pole, LimitCause::pole};
  return fold < kLargestRadius ? Limit{fold, LimitCause::fold} : Limit{kInfinity, LimitCause::none};
}

/// The angle of a fisheye.
Limit limitOfAngles(const LensParts& lens) {
  Polynomial slope(5);
  slope[0] = {1, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    const double term = double(2 * i + 3) * lens.k[i];
    slope[i + 1] = {term, std::fabs(term)};
  }
  const double angle = std::nextafter(std::sqrt(firstZero(slope)), 0);
  return angle < kHalfTurn.hi ? Limit{angle, LimitCause::fold} : Limit{kInfinity, LimitCause::none};
}

/// A direction by its sine and cosine, times any length.
struct Cone {
  DoubleDouble sine, cosine;
  LimitCause cause;
  double radius = kInfinity;  ///< there, before Brown's polynomials
};

bool isWider(const Cone& a, const Cone& b) { return (a.sine * b.cosine - a.cosine * b.sine).hi > 0; }

/// The sphere map's.
Cone coneOfSphere(const LensParts& lens) {
  if (lens.xi == 0 && lens.alpha == 0) return {1, 0, LimitCause::none};  // the pinhole's
  const DoubleDouble one = 1, alpha = lens.alpha, xi = lens.xi;
  const bool isFold = lens.alpha > 0.5;
  const DoubleDouble w = isFold ? lens.oneLessAlpha / alpha : alpha / lens.oneLessAlpha;
  const DoubleDouble across = sqrt((one - w * w) / DoubleDouble(lens.beta)), length = sqrt(across * across + w * w);
  const Cone inner{across / length, -w / length, isFold ? LimitCause::fold : LimitCause::pole,
                   isFold ? (one / sqrt(DoubleDouble(lens.beta) * (alpha + alpha - one))).hi : kInfinity};
  if (lens.xi >= 1) {
    const DoubleDouble t = sqrt(one - one / (xi * xi));
    // The inner angle ends at (1/xi, t).
    if ((inner.sine * t - inner.cosine / xi).hi >= 0) {
      const double by = (xi * (alpha + lens.oneLessAlpha * t)).hi;
      return {t, -one / xi, lens.xi > 1 ? LimitCause::fold : LimitCause::none, by > 0 ? 1 / by : kInfinity};
    }
  }
  const DoubleDouble q = xi * inner.cosine + sqrt(one - xi * xi * inner.sine * inner.sine);
  Cone cone{q * inner.sine, q * inner.cosine - xi, inner.cause, inner.radius};
  if (!(cone.sine.hi > 0)) cone = {0, -1, LimitCause::none, inner.radius};  // it ends straight back
  return cone;
}

/// The cone of a radius before Brown's polynomials.
Cone coneOfRadius(const LensParts& lens, const Limit& limit) {
  if (!(limit.value < kInfinity)) return {1, 0, LimitCause::none};
  const auto at = sphereSight<DoubleDouble>(lens, {limit.value, 0.0}).at;
  return {at.right, at.forward, limit.cause, limit.value};
}

/// The angle that a calibration states, exact at multiples of 90 degrees.
Cone coneOfDegrees(double degrees) {
  const SinCos s = sinCosDegrees(std::min(degrees, 180.0));
  return {toDoubleDouble(s.sine.rounded()), toDoubleDouble(s.cosine.rounded()), LimitCause::stated};
}

/// How far the curvature and the sizes of the terms are below kGentle.
double gentleEnd(const LensParts& lens) {
  if (lens.isAngle) {
    const double c = lens.across.hi, bend = 2 * std::max(c * c, 1 / (c * c));
    double gentle = 0;
    for (double t = 0x1p-8; t <= 4 && bend * sizes(lens.numerator(), t * t, 1, 30) <= 0x1p10; t += 0x1p-8) gentle = t;
    return gentle;
  }
  if (!lens.isBrown) return kLargestRadius;
  double gentle = 0;
  for (double step = 0x1p-4; step > 0x1p-12 && gentle < kLargestRadius;) {
    const double to = std::max(gentle, 0x1p-20) * (1 + step);
    const double terms = to + brownResponse(lens, gentle, to).rounding;
    const bool isGentle = curvature(lens, gentle, to) <= kGentle && terms <= kGentle;
    if (isGentle) gentle = to;
    step = isGentle ? std::min(2 * step, 0x1p-4) : step / 2;
  }
  return gentle;
}

}  // namespace

void setLimits(LensParts& lens) {
  Cone cone{0, -1, LimitCause::none};
  if (lens.isAngle) {
    const Limit limit = limitOfAngles(lens);
    if (limit.value < kInfinity) {
      const Direction at = directionOf(limit.value);
      cone = {at.across, at.along, limit.cause};
      lens.angleEnd = limit.value;
    }
  } else {
    Limit brown = limitOfBrown(lens);
    if (lens.statedRadius < brown.value) brown = {lens.statedRadius, LimitCause::stated};
    lens.brownEnd = std::min(brown.value, kLargestRadius);
    cone = coneOfSphere(lens);
    lens.planeEnd =
        std::min(cone.radius, lens.isBrown || brown.cause == LimitCause::stated ? lens.brownEnd : kInfinity);
    if (brown.value < cone.radius) cone = coneOfRadius(lens, brown);
  }
  if (const Cone end = coneOfDegrees(lens.statedDegrees); isWider(cone, end)) cone = end;
  lens.cause = cone.cause;
  if (cone.cause != LimitCause::none) lens.limitDegrees = (angleOf(cone.sine, cone.cosine) * kDegreesPerRadian).hi;
  const DoubleDouble length = sqrt(cone.sine * cone.sine + cone.cosine * cone.cosine);
  lens.limitSine = cone.sine / length;
  lens.limitCosine = cone.cosine / length;
  lens.gentleEnd = gentleEnd(lens);
  if (lens.isAngle) {
    const DoubleDouble end = lens.angleEnd;
    lens.edge = (end * series(lens.numerator(), end * end)).hi * (1 + 0x1p-50);
  } else if (lens.planeEnd < kLargestRadius) {
    const DoubleDouble r = lens.planeEnd, u = r * r;
    const double outer = ((r * radialFactor(lens, u)).hi + 3 * lens.tangential * u.hi) * (1 + 0x1p-30);
    if (outer > 0) lens.edge = outer;  // next to a pole there is none
  }
}

}  // namespace viewproj::detail
