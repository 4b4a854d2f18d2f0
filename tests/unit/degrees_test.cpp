#include "viewproj/numbers/degrees.hpp"

#include "catch.hpp"

using namespace viewproj;

TEST_CASE("The tangent of half of 90 degrees is exactly 1") {
  CHECK(tanHalfDegrees(90).hi == 1);
  CHECK(std::fabs(tanHalfDegrees(90).lo) <= kTanHalfDegreesBound);
}

TEST_CASE("The tangent of half an angle outside 0 to 180 degrees is NaN") {
  for (double degrees : {0.0, -1.0, 180.0, 200.0, double(NAN), double(INFINITY)}) {
    INFO(degrees);
    CHECK(std::isnan(tanHalfDegrees(degrees).hi));
  }
}
