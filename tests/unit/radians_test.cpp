#include "numbers/radians.hpp"

#include <cmath>

#include "catch.hpp"

using namespace viewproj;

TEST_CASE("The tangent of half an angle outside 0 to pi is NaN") {
  for (double radians : {0.0, -1.0, 3.1415926535897936, 7.0, double(NAN), double(INFINITY)}) {
    INFO(radians);
    CHECK(std::isnan(tanHalfRadians(radians).hi));
  }
}
