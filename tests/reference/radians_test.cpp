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

TEST_CASE("Sines and cosines of up to 1e6 radians are within their bound") {
  double worst = 0;
  for (std::uint64_t trial = 0; trial < 5000; ++trial) {
    Random r(trial);
    const double quarters = std::floor(r.uniform(-6e5, 6e5)) * 1.5707963267948966;
    const double angle = trial % 3 == 0 ? quarters : r.sign() * r.logUniform(1e-300, 1e6);
    const SinCos got = sinCosRadians(angle);
    const auto errorOf = [](const Dyadic<1>& a, const Real& truth) {
      Real sum = -truth;
      Dyadic<1> rest = a;
      for (int i = 0; i < 8 && rest.sign() != 0; ++i) {
        const double part = double(rest.rounded());
        sum = sum + Real(part);
        rest = rest - Dyadic<1>(part);
      }
      return double(abs(sum));
    };
    INFO(angle);
    worst = std::max({worst, errorOf(got.sine, sine(Real(angle))), errorOf(got.cosine, cosine(Real(angle)))});
    REQUIRE(worst <= kSinCosBound);
  }
  CHECK(worst > kSinCosBound / 1024);
}

TEST_CASE("Intrinsics in another picture's pixels and ps2's products are not rounded before the window's edges") {
  double worst = 0;
  for (std::uint64_t trial = 0; trial < 3000; ++trial) {
    Random r(trial);
    const double fx = r.logUniform(10, 1e5), fy = r.logUniform(10, 1e5), cx = r.uniform(-5e3, 5e3),
                 cy = r.uniform(-5e3, 5e3);
    const Viewport v{.width = r.uniform(100, 5000),
                     .height = r.uniform(100, 5000),
                     .x = r.uniform(-1e6, 1e6),
                     .y = r.uniform(-1e6, 1e6),
                     .pixelCenter = r.coin() ? 0.5 : 0};
    const bool isPs2 = r.coin();
    const Vec2 size = isPs2 ? Vec2{v.width, v.height} : Vec2{r.uniform(100, 5000), r.uniform(100, 5000)};
    const double scrz = r.logUniform(.1, 10);
    const Projection p =
        isPs2 ? ps2Intrinsics(scrz, fx, fy, cx, cy, v, 1, 9) : intrinsics(fx, fy, cx, cy, size, v, 1, 9);
    const Real perX = Real(1) / (isPs2 ? Real(fx) * Real(scrz) : Real(fx)),
               perY = Real(1) / (isPs2 ? Real(fy) * Real(scrz) : Real(fy));
    const Real half = Real(0.5) - Real(v.pixelCenter);
    const Real fromLeft = Real(cx) - Real(v.x) * Real(size.x) / Real(v.width) + half;
    const Real fromTop = Real(cy) - Real(v.y) * Real(size.y) / Real(v.height) + half;
    const ProjectionParts& q = parts(p);
    const auto check = [&](DoubleDouble got, const Real& truth, double reach, DoubleDouble a, DoubleDouble b) {
      const double largest = std::max({reach, std::fabs(a.hi), std::fabs(b.hi)});
      worst = std::max(worst, double(abs(real(got) - truth)) / largest);
    };
    check(q.left, -fromLeft * perX, q.reachX, q.left, q.right);
    check(q.right, (Real(size.x) - fromLeft) * perX, q.reachX, q.left, q.right);
    check(q.top, fromTop * perY, q.reachY, q.bottom, q.top);
    check(q.bottom, (fromTop - Real(size.y)) * perY, q.reachY, q.bottom, q.top);
    INFO(trial);
    REQUIRE(worst <= 0x1p-98);
  }
  CHECK(worst > 0x1p-110);
}
