#include <cmath>

#include "catch.hpp"
#include "internals.hpp"
#include "numbers/degrees.hpp"

using namespace viewproj;
using namespace viewproj::detail;

TEST_CASE("The tangent of half an angle outside 0 to pi is NaN") {
  for (double radians : {0.0, -1.0, 3.1415926535897936, 7.0, double(NAN), double(INFINITY)}) {
    INFO(radians);
    CHECK(std::isnan(tanHalfRadians(radians).hi));
  }
}
