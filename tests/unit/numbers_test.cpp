#include <random>

#include "catch.hpp"
#include "internals.hpp"
#include "numbers/certified.hpp"
#include "numbers/dyadic.hpp"
#include "numbers/expansion.hpp"
#include "viewproj/vectors.hpp"

using namespace viewproj;
using namespace viewproj::detail;

TEST_CASE("A sum and a product split into the rounded result and its error") {
  const DoubleDouble sum = twoSum(1, 0x1p-60);
  CHECK(sum.hi == 1);
  CHECK(sum.lo == 0x1p-60);
  const DoubleDouble product = twoProd(1 + 0x1p-30, 1 - 0x1p-30);
  CHECK(product.hi == 1);
  CHECK(product.lo == -0x1p-60);
}

TEST_CASE("An expansion that sums to zero is empty") {
  Expansion<16> e;
  e.addProduct(0x1p80 + 1, 3);
  e.addProduct(1e-30, 1e-30);
  CHECK_FALSE(e.isZero());
  e.addProduct(-(0x1p80 + 1), 3);
  e.addProduct(-1e-30, 1e-30);
  CHECK(e.isZero());
  CHECK(e.rounded().hi == 0);
}

TEST_CASE("An expansion holds what a double-double cannot") {
  Expansion<8> e{1, 0x1p-200, 0x1p-400};
  e.add(-1);
  CHECK(e.rounded().hi == 0x1p-200);
  CHECK(e.rounded().lo == 0x1p-400);
  e.add(-0x1p-200);
  CHECK(e.rounded().hi == 0x1p-400);
}

TEST_CASE("The products of expansions are exact") {
  for (unsigned trial = 0; trial < 1000; ++trial) {
    std::mt19937_64 random(trial);
    const auto integer = [&] { return double(std::int64_t(random() >> 32)) - 0x1p31; };
    const double a = integer(), b = integer(), c = integer(), d = integer();
    Expansion<2> left{a * 0x1p60, b}, right{c, d * 0x1p-60};
    Expansion<16> product;
    product.addProduct(left, right);
    product.addProduct(-a * 0x1p60, c);
    product.addProduct(-a, d);
    product.addProduct(-b, c);
    product.addProduct(-b, d * 0x1p-60);
    INFO("trial " << trial);
    CHECK(product.isZero());
  }
}

TEST_CASE("Double-double division and square root undo multiplication to 2^-100") {
  for (unsigned trial = 0; trial < 1000; ++trial) {
    std::mt19937_64 random(trial);
    std::uniform_real_distribution<double> uniform(0.1, 10);
    const DoubleDouble a = twoSum(uniform(random), uniform(random) * 0x1p-55);
    const DoubleDouble b = twoSum(uniform(random), uniform(random) * 0x1p-55);
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

TEST_CASE("The length of a vector neither overflows nor underflows") {
  for (double size : {0x1p-1000, 1.0, 0x1p1000}) {
    INFO(size);
    const DDVec3 v = normalized(toDoubleDouble({3 * size, 0, 4 * size}));
    CHECK(v.x.hi == 0.6);
    CHECK(v.z.hi == 0.8);
  }
}

TEST_CASE("Dyadic numbers add and multiply exactly, over the whole range of doubles") {
  const double values[] = {0,      1,         -1,    3,       0.1,    -0x1.fffffffffffffp1023,
                           5e-324, 0x1p-1022, 1e150, -1e-150, 0x1p32, 0x1p-32};
  for (double a : values)
    for (double b : values) {
      const Dyadic x(a), y(b);
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
  CHECK((Dyadic(1) + Dyadic(0x1p-100)).rounded().value.lo == 0x1p-100);
}

TEST_CASE("Certified numbers know when they do not know") {
  const Certified near = Certified(0.1) * Certified(3.0) - Certified(0.25);
  CHECK(near.isCertain());
  // What is left of 0.1 * 3 - 0.3 is a rounding error: right up to its own error, but with few certain digits.
  const Certified cancelled = Certified(0.1) * Certified(3.0) - Certified(0.3);
  const double truth = double((Dyadic(0.1) * Dyadic(3.0) - Dyadic(0.3)).rounded());
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

TEST_CASE("The leading terms of an expansion leave out less than the last of them holds") {
  Expansion<16> many;
  for (int i = 0; i < 12; ++i) many.add((i % 2 ? -1.25 : 1.5) * std::ldexp(1, -60 * i));
  CHECK(many.leading<12>().size() == many.size());
  const Expansion<4> few = many.leading<4>();
  REQUIRE(few.size() == 4);
  Expansion<24> rest;
  for (std::size_t i = 0; i < many.size(); ++i) rest.add(many.term(i));
  for (std::size_t i = 0; i < few.size(); ++i) rest.add(-few.term(i));
  CHECK(rest.rounded().hi != 0);
  CHECK(std::fabs(rest.rounded().hi) <= 0x1p-230);
}

TEST_CASE("Integers times powers of two are cut off and divided towards zero, to within a step") {
  constexpr int kPosition = -7;
  constexpr double kStep = 0x1p-224;
  const auto roundedOf = [](const Dyadic& a) { return a.expansion<16>().rounded().hi; };
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    std::mt19937_64 random(trial);
    std::uniform_real_distribution<double> uniform(-1000, 1000);
    const double a = uniform(random), b = uniform(random);
    INFO(a << " " << b);
    const Dyadic product = Dyadic(a) * Dyadic(b), cut = product.truncated(-2);
    REQUIRE((product - product.truncated(kPosition)).sign() == 0);  // two doubles of these sizes have no bits below
    const double lost = roundedOf(product - cut);
    REQUIRE(std::fabs(lost) < 0x1p-64);
    REQUIRE((lost == 0 || (lost < 0) == (cut.sign() < 0)));
    Expansion<32> difference;
    difference.addProduct(-a, b);
    const auto terms = product.expansion<16>();
    for (std::size_t i = 0; i < terms.size(); ++i) difference.add(terms.term(i));
    REQUIRE(difference.isZero());
    const Dyadic third = Dyadic(a).dividedBy(3, kPosition);
    const Dyadic rest = Dyadic(a) - third - third - third;
    REQUIRE(std::fabs(roundedOf(rest)) <= 2 * kStep);
    REQUIRE((rest.sign() == 0 || (rest.sign() < 0) == (a < 0)));
  }
  CHECK(Dyadic(0x1p-225).truncated(kPosition).sign() == 0);
  CHECK(roundedOf(Dyadic(-0x1p-224).truncated(kPosition)) == -kStep);
  CHECK(roundedOf(Dyadic(kPosition, {0, 0, 0, 0, 0, 0, 0, 5})) == 5);
}
