#include <cmath>

#include "catch.hpp"
#include "internals.hpp"
#include "numbers/degrees.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

Real real(DoubleDouble a) { return Real(a.hi) + Real(a.lo); }

Real tanOf(const Real& a) { return tanDegrees(a * Real(180) / Real::pi()); }

double relativeError(DoubleDouble got, const Real& truth) { return double(abs(real(got) - truth) / abs(truth)); }

}  // namespace

TEST_CASE("The tangent of half an angle in radians is within its bound from 1e-200 to 3.1, of double-doubles too") {
  int small = 0, large = 0, withLow = 0;
  double worst = 0;
  for (unsigned trial = 0; trial < 100000; ++trial) {
    Random random(trial);
    const double angle = trial % 2 ? random.uniform(0, 3.1) : random.logUniform(1e-200, 1);
    const double low = trial % 3 ? 0 : angle * random.uniform(-0.5, 0.5) * 0x1p-53;
    const DoubleDouble radians(angle, low);
    (angle < 1e-8 ? small : large) += 1;
    withLow += low != 0;
    INFO(angle << " + " << low);
    const double error = relativeError(tanHalfRadians(radians), tanOf(real(radians) / Real(2)));
    worst = std::max(worst, error);
    REQUIRE(error <= kTanHalfRadiansBound);
  }
  CAPTURE(std::log2(worst));
  CHECK(worst > kTanHalfRadiansBound / 64);
  CHECK(small > 10000);
  CHECK(large > 10000);
  CHECK(withLow > 10000);
}

TEST_CASE("An angle in degrees is the double nearest that of its half's tangent, up to the last one below 180") {
  int below[3] = {}, straight = 0;
  for (std::uint64_t trial = 0; trial < 60000; ++trial) {
    Random random(trial);
    const double size = trial % 2 ? random.logUniform(1e12, 1e17) : random.logUniform(1e-200, 1e12);
    const DoubleDouble tangent = quickTwoSum(size, size * random.uniform(-0x1p-54, 0x1p-54));
    Real truth = Real(tangent.hi) + Real(tangent.lo);
    mpfr_t angle;
    mpfr_init2(angle, Real::kBits);
    mpfr_atan(angle, truth.value(), MPFR_RNDN);
    mpfr_mul_ui(angle, angle, 360, MPFR_RNDN);
    mpfr_div(angle, angle, Real::pi().value(), MPFR_RNDN);
    const double nearest = mpfr_get_d(angle, MPFR_RNDN);
    mpfr_clear(angle);
    CAPTURE(trial, size, nearest);
    REQUIRE(degreesOfHalfTangent(tangent) == nearest);
    if (nearest < 180)
      ++below[nearest > 180 - 0x1p-40 ? 2 : nearest > 90];
    else
      ++straight;
  }
  CHECK(std::min({below[0], below[1], below[2], straight}) > 3000);
}
