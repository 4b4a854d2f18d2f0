#include "numbers/degrees.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace viewproj::detail {
namespace {

constexpr DoubleDouble kRadiansPerDegree{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
constexpr std::size_t kTerms = 15;

/// 1/first!, -1/(first+2)!, 1/(first+4)!, ... : the Taylor coefficients of cos (first = 0) and of sin(x)/x (first = 1).
consteval std::array<DoubleDouble, kTerms> alternatingInverseFactorials(int first) {
  std::array<DoubleDouble, kTerms> coefficients;
  DoubleDouble value = 1;
  for (std::size_t k = 0; k < kTerms; ++k) {
    coefficients[k] = value;
    const int n = first + 2 * static_cast<int>(k);
    value = -(value / DoubleDouble(double(n + 1) * double(n + 2)));
  }
  return coefficients;
}

constexpr auto kCosine = alternatingInverseFactorials(0);
constexpr auto kSineOverX = alternatingInverseFactorials(1);

/// Sine and cosine of an angle in (0, 45] degrees.
struct DoubleDoubleSinCos {
  DoubleDouble sine, cosine;
};

DoubleDoubleSinCos sinCosUpTo45(DoubleDouble degrees) noexcept {
  const DoubleDouble x = degrees * kRadiansPerDegree;
  const DoubleDouble xx = x * x;
  DoubleDouble sine = kSineOverX[kTerms - 1];
  DoubleDouble cosine = kCosine[kTerms - 1];
  for (std::size_t k = kTerms - 1; k-- > 0;) {
    sine = sine * xx + kSineOverX[k];
    cosine = cosine * xx + kCosine[k];
  }
  return {sine * x, cosine};
}

/// kSinCosStep as an exponent of limbs.
constexpr int kStep = -7;
static_assert(kSinCosStep == 0x1p-224);

}  // namespace

DoubleDouble tanHalfDegrees(double degrees) noexcept {
  if (!(degrees > 0 && degrees < 180)) return kNaN;
  const double half = degrees / 2;
  if (half <= 45) {
    // Below 1e-60 degrees sin/cos is x itself to far more than 106 bits.
    if (half < 1e-60) return DoubleDouble(half) * kRadiansPerDegree;
    const DoubleDoubleSinCos s = sinCosUpTo45(half);
    return s.sine / s.cosine;
  }
  const DoubleDoubleSinCos s = sinCosUpTo45(twoDiff(90, half));
  return s.cosine / s.sine;
}

DoubleDouble tanHalfRadians(DoubleDouble radians) noexcept {
  constexpr DoubleDouble kDegreesPerRadian{0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49};
  constexpr double kRadiansPerHalfDegree = 0x1.1df46a2529d39p-7;
  const DoubleDouble degrees = radians * kDegreesPerRadian;
  // tan(a + b) = (tan a + tan b) / (1 - tan a tan b). Half the low part, b, is so small that it is its own tangent.
  const DoubleDouble tangent = tanHalfDegrees(degrees.hi), rest = degrees.lo * kRadiansPerHalfDegree;
  return (tangent + rest) / (DoubleDouble(1) - tangent * rest);
}

double degreesOfHalfTangent(DoubleDouble tangent) noexcept {
  constexpr double kDegreesPerRadian = 57.29577951308232;
  double angle = 2 * std::atan(tangent.hi) * kDegreesPerRadian;
  if (!(angle > 0)) return std::isnan(angle) ? angle : 0;
  if (tangent.hi > 1e17) return 180;
  angle = std::min(angle, 0x1.67fffffffffffp+7);  // the last double below 180
  // The remainder is an angle too, so small that it is its tangent: tan(a - b) = (tan a - tan b) / (1 + tan a tan b).
  const DoubleDouble there = tanHalfDegrees(angle);
  const DoubleDouble rest = (tangent - there) / (DoubleDouble(1) + tangent * there);
  return (DoubleDouble(angle) + rest * DoubleDouble(2 * kDegreesPerRadian)).hi;
}

namespace {

/// The angle whose sine and cosine are these divided by lengths, the product of the vectors' lengths. tan(angle / 2) is
/// sin / (1 + cos) or (1 - cos) / sin: the one that does not cancel.
double degreesOfRatio(DoubleDouble sine, DoubleDouble cosine, DoubleDouble lengths) noexcept {
  return degreesOfHalfTangent(cosine.hi >= 0 ? sine / (lengths + cosine) : (lengths - cosine) / sine);
}

}  // namespace

double degreesAcross(DoubleDouble from, DoubleDouble to) noexcept {
  const DoubleDouble one(1);
  return degreesOfRatio(to - from, one + from * to, sqrt((one + from * from) * (one + to * to)));
}

double degreesBetween(DoubleDouble x0, DoubleDouble y0, DoubleDouble x1, DoubleDouble y1) noexcept {
  const DoubleDouble one(1), u = y0 - y1, v = x1 - x0, w = x0 * y1 - y0 * x1;
  return degreesOfRatio(sqrt(u * u + v * v + w * w), one + x0 * x1 + y0 * y1,
                        sqrt((one + x0 * x0 + y0 * y0) * (one + x1 * x1 + y1 * y1)));
}

Dyadic<1> sinCosProduct(const Dyadic<1>& a, const Dyadic<1>& b) noexcept { return Dyadic<1>((a * b).truncated(kStep)); }

namespace {

/// A quarter of half a turn, pi / 4, with 32 bits more than a step.
Dyadic<1> eighthTurn() noexcept {
  return {kStep - 1, {0x3b139b22, 0x20bbea6, 0x8a67cc74, 0x29024e08, 0x80dc1cd1, 0xc4c6628b, 0x2168c234, 0xc90fdaa2}};
}

/// Of the angle x, up to about pi / 4, and so many quarter turns. The Taylor series, with x^n / n! after
/// x^(n-1) / (n-1)!.
SinCos sinCosOf(const Dyadic<1>& x, int quarters) noexcept {
  const auto product = sinCosProduct;
  const Dyadic<1> xx = product(x, x);
  Dyadic<1> sine = x, cosine = 1, term = x;
  for (std::uint32_t n = 2; term.sign() != 0; n += 2) {
    const Dyadic<1> even = product(term, x).dividedBy(n, kStep);
    term = product(term, xx).dividedBy(n * (n + 1), kStep);
    const bool minus = n % 4 == 2;
    cosine = minus ? cosine - even : cosine + even;
    sine = minus ? sine - term : sine + term;
  }
  if (quarters & 2) sine = -sine, cosine = -cosine;
  return quarters & 1 ? SinCos{cosine, -sine} : SinCos{sine, cosine};
}

}  // namespace

SinCos sinCosDegrees(double degrees) noexcept {
  const double turned = std::remainder(degrees, 360), quarters = std::round(turned / 90);
  const Dyadic<1> rest = turned - 90 * quarters;  // exact, and so is the remainder
  return sinCosOf(sinCosProduct(rest.truncated(kStep).dividedBy(45, kStep), eighthTurn()), static_cast<int>(quarters));
}

SinCos sinCosRadians(double radians) noexcept {
  const double quarters = std::round(radians * (2 / std::numbers::pi));
  const Dyadic<1> rest(Dyadic<1>(radians) - Dyadic<1>(2 * quarters) * eighthTurn());
  return sinCosOf(rest.truncated(kStep), static_cast<int>(quarters));
}

}  // namespace viewproj::detail
