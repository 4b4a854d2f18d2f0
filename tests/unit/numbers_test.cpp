#include "catch.hpp"
#include "internals.hpp"
#include "numbers/certified.hpp"
#include "numbers/dyadic.hpp"
#include "random.hpp"
#include "viewproj/vectors.hpp"

using namespace viewproj;
using namespace viewproj::detail;

TEST_CASE("Double-double division and square root undo multiplication to 2^-100") {
  for (unsigned trial = 0; trial < 1000; ++trial) {
    Random random(trial);
    const auto any = [&] { return random.uniform(0.1, 10); };
    const DoubleDouble a = twoSum(any(), any() * 0x1p-55), b = twoSum(any(), any() * 0x1p-55);
    const auto relative = [](DoubleDouble x, DoubleDouble y) { return std::fabs(((x - y) / y).hi); };
    INFO("trial " << trial);
    CHECK(relative(a / b * b, a) < 0x1p-100);
    CHECK(relative(sqrt(a) * sqrt(a), a) < 0x1p-100);
  }
}

TEST_CASE("A sum that cancels to less than its terms' error is zero") {
  CHECK_FALSE(std::signbit(rounded(DDVec3{-0.0, 1, 2}).x));
  CHECK_FALSE(std::signbit(rounded(DDVec3{1, -0.0, 2}).y));
  CHECK_FALSE(std::signbit(rounded(DDVec3{1, 2, -0.0}).z));
  const DoubleDouble third = DoubleDouble(1) / DoubleDouble(3);
  CHECK(sumOrZero(third * DoubleDouble(3), -1).hi == 0);
  CHECK(sumOrZero(1, DoubleDouble(-1, 0x1p-100)).hi == 0);
  CHECK(sumOrZero(1, DoubleDouble(-1, 0x1p-90)).hi == 0x1p-90);
}

TEST_CASE("Dyadic numbers add and multiply exactly, of doubles from the smallest to 2^320") {
  const double values[] = {0, 1, -1, 3, 0.1, -0x1.fffffffffffffp319, 5e-324, 0x1p-1022, 1e90, -1e-150, 0x1p32, 0x1p-32};
  for (double a : values)
    for (double b : values) {
      const Dyadic<1> x(a), y(b);
      INFO(a << " " << b);
      CHECK(((x + y) * (x - y) - (x * x - y * y)).sign() == 0);
      CHECK((x * y * x * y * x * y - (x * x * x) * (y * y * y)).sign() == 0);
      CHECK((x - y).sign() == (a > b) - (a < b));
      CHECK(double((x - y + y).rounded()) == a);
      if (a != 0 && b != 0) {
        const Wide quotient = (x * x * y).rounded() / Wide(a) / Wide(a);
        CHECK(double(quotient) == b);
      }
    }
  CHECK((Dyadic<1>(1) + Dyadic<1>(0x1p-100)).rounded().value.lo == 0x1p-100);
}

TEST_CASE(
    "A dyadic number that would take more limbs than it has, or is made of no number, is NaN, and so is what it "
    "makes") {
  const auto isNan = [](const auto& a) { return a.sign() == 0 && std::isnan(double(a.rounded())); };
  const Dyadic<1> tooMany = Dyadic<1>(0x1p500) + Dyadic<1>(0x1p-1074);
  CHECK(isNan(tooMany));
  CHECK(isNan(Dyadic<1>(0x1p-1074) - Dyadic<1>(0x1p1000)));
  CHECK(isNan(Dyadic<1>(NAN)));
  CHECK(isNan(Dyadic<1>(-INFINITY)));
  CHECK(isNan(tooMany * Dyadic<1>(0.0)));
  CHECK(isNan(Dyadic<2>(1) + tooMany));
  CHECK(isNan(Dyadic<1>(Dyadic<1>(0x1p319) * Dyadic<1>(0x1p319) + Dyadic<1>(0x1p-1074))));
  CHECK_FALSE(isNan(Dyadic<1>(0x1p319) + Dyadic<1>(0x1p-1074)));
}

TEST_CASE("Certified numbers know when they do not know") {
  const Certified near = Certified(0.1) * Certified(3.0) - Certified(0.25);
  CHECK(near.isCertain());
  // What is left of 0.1 * 3 - 0.3 is a rounding error: right up to its own error, but with few certain digits.
  const Certified cancelled = Certified(0.1) * Certified(3.0) - Certified(0.3);
  const double truth = double((Dyadic<1>(0.1) * Dyadic<1>(3.0) - Dyadic<1>(0.3)).rounded());
  CHECK_FALSE(cancelled.isCertain());
  CHECK(cancelled.error > 0);
  CHECK(std::fabs(cancelled.value.hi - truth) <= cancelled.error);
  CHECK((Certified(1e200) * Certified(1e200)).isCertain() == false);
  CHECK((Certified(1e-200) * Certified(1e-200)).isCertain() == false);
  CHECK((Certified(0.0) * Certified(1e-200)).isCertain());
  CHECK(Certified::difference(1, 1).isCertain());
  const Certified third(DoubleDouble(1) / DoubleDouble(3), 1e-33);
  CHECK((third + Certified(1)).error > 1.1e-33);  // its own rounding comes on top
  const Certified rough(DoubleDouble(1) / DoubleDouble(3), 1e-20);
  CHECK((rough * Certified(4)).error >= 4e-20);
  CHECK((Certified(4) * rough).error >= 4e-20);
}

TEST_CASE("Integers times powers of two are cut off and divided towards zero, to within a step") {
  constexpr int kPosition = -7;
  constexpr double kStep = 0x1p-224;
  const auto roundedOf = [](const auto& a) { return double(a.rounded()); };
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const double a = random.uniform(-1000, 1000), b = random.uniform(-1000, 1000);
    INFO(a << " " << b);
    const Dyadic<2> product = Dyadic<1>(a) * Dyadic<1>(b), cut = product.truncated(-2);
    REQUIRE((product - product.truncated(kPosition)).sign() == 0);  // two doubles of these sizes have no bits below
    const double lost = roundedOf(product - cut);
    REQUIRE(std::fabs(lost) < 0x1p-64);
    REQUIRE((lost == 0 || (lost < 0) == (cut.sign() < 0)));
    const DoubleDouble parts = twoProd(a, b);
    REQUIRE((product - Dyadic<1>(parts.hi) - Dyadic<1>(parts.lo)).sign() == 0);
    const Dyadic<1> third = Dyadic<1>(a).dividedBy(3, kPosition);
    const Dyadic<1> rest = Dyadic<1>(a) - third - third - third;
    REQUIRE(std::fabs(roundedOf(rest)) <= 2 * kStep);
    REQUIRE((rest.sign() == 0 || (rest.sign() < 0) == (a < 0)));
  }
  CHECK(Dyadic<1>(0x1p-225).truncated(kPosition).sign() == 0);
  CHECK(roundedOf(Dyadic<1>(-0x1p-224).truncated(kPosition)) == -kStep);
  CHECK(roundedOf(Dyadic<1>(kPosition, {0, 0, 0, 0, 0, 0, 0, 5})) == 5);
}
