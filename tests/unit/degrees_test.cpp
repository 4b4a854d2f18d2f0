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

TEST_CASE("Sines and cosines of right angles are exact, however many turns lie between") {
  const double sines[] = {0, 1, 0, -1};
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const SinCos s = sinCosDegrees(90.0 * quarter);
    INFO(quarter);
    CHECK(s.sine.expansion().rounded().hi == sines[(quarter + 12) % 4]);
    CHECK(s.sine.expansion().rounded().lo == 0);
    CHECK(s.cosine.expansion().rounded().hi == sines[(quarter + 13) % 4]);
    CHECK(isRightAngle(90.0 * quarter));
  }
  CHECK_FALSE(isRightAngle(90 + 1e-13));
}

TEST_CASE("Sine and cosine change sign with the angle and the quadrant, to the last bit") {
  const SinCos s = sinCosDegrees(33.3), opposite = sinCosDegrees(-33.3), behind = sinCosDegrees(33.3 - 180);
  CHECK((s.sine + opposite.sine).isZero());
  CHECK((s.cosine - opposite.cosine).isZero());
  CHECK(std::fabs((s.cosine + behind.cosine).expansion().rounded().hi) < 1e-15);  // 33.3 - 180 is a rounded number
  CHECK(behind.sine.isNegative());
}
