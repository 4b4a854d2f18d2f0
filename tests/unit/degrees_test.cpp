#include "numbers/degrees.hpp"

#include "catch.hpp"
#include "internals.hpp"

using namespace viewproj;
using namespace viewproj::detail;

TEST_CASE("The tangent of half an angle outside 0 to 180 degrees is NaN") {
  for (double degrees : {0.0, -1.0, 180.0, 200.0, double(NAN), double(INFINITY)}) {
    INFO(degrees);
    CHECK(std::isnan(tanHalfDegrees(degrees).hi));
  }
}

TEST_CASE("A tangent that is no angle's gives an end of the range, or NaN") {
  CHECK(degreesOfHalfTangent(0) == 0);
  CHECK(degreesOfHalfTangent(-1) == 0);
  CHECK(degreesOfHalfTangent(1e300) == 180);
  CHECK(degreesOfHalfTangent(double(INFINITY)) == 180);
  CHECK(std::isnan(degreesOfHalfTangent(double(NAN))));
}

TEST_CASE("Sines and cosines of right angles are exact, however many turns lie between") {
  const double sines[] = {0, 1, 0, -1};
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const SinCos s = sinCosDegrees(90.0 * quarter);
    INFO(quarter);
    CHECK((s.sine - Dyadic<1>(sines[(quarter + 12) % 4])).sign() == 0);
    CHECK((s.cosine - Dyadic<1>(sines[(quarter + 13) % 4])).sign() == 0);
  }
}
