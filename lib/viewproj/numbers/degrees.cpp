#include "viewproj/numbers/degrees.hpp"

#include <array>
#include <limits>

namespace viewproj {
namespace {

constexpr DoubleDouble kRadiansPerDegree{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
constexpr std::size_t kTerms = 15;

/// 1/first!, -1/(first+2)!, 1/(first+4)!, ... : the Taylor coefficients of cos (first = 0) and of sin(x)/x (first = 1).
constexpr std::array<DoubleDouble, kTerms> alternatingInverseFactorials(int first) {
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
struct SinCos {
  DoubleDouble sine, cosine;
};

SinCos sinCosUpTo45(DoubleDouble degrees) noexcept {
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

}  // namespace

DoubleDouble tanHalfDegrees(double degrees) noexcept {
  if (!(degrees > 0 && degrees < 180)) return std::numeric_limits<double>::quiet_NaN();
  const double half = degrees / 2;
  if (half <= 45) {
    // Below 1e-60 degrees sin/cos is x itself to far more than 106 bits.
    if (half < 1e-60) return DoubleDouble(half) * kRadiansPerDegree;
    const SinCos s = sinCosUpTo45(half);
    return s.sine / s.cosine;
  }
  const SinCos s = sinCosUpTo45(twoDiff(90, half));
  return s.cosine / s.sine;
}

double degreesOfHalfTangent(DoubleDouble tangent) noexcept {
  constexpr double kDegreesPerRadian = 57.29577951308232;
  double angle = 2 * std::atan(tangent.hi) * kDegreesPerRadian;
  // Newton's steps: the first leaves an ulp, unless the angle is within a few thousand ulps of 180.
  for (int step = 0; step < 3; ++step) {
    if (!(angle > 0)) return std::isnan(angle) ? angle : 0;
    if (!(angle < 180)) return 180;
    const DoubleDouble there = tanHalfDegrees(angle);
    angle += ((tangent - there) / (DoubleDouble(1) + there * there)).hi * 2 * kDegreesPerRadian;
  }
  return angle < 180 ? angle : 180;
}

}  // namespace viewproj
