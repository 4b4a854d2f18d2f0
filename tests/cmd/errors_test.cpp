// What measure makes of errors that are no numbers.
#include "commands/measure/errors.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("The largest error of results one of which is no number is no number, wherever it stands") {
  for (const auto& errors : {std::vector{kNaN, 1.0, kInfinity}, {1.0, kNaN, kInfinity}, {kInfinity, 1.0, kNaN}}) {
    ErrorTally tally;
    for (const double error : errors) tally.add(error);
    CHECK(std::isnan(tally.largest()));
    CHECK(std::isnan(tally.percentile99()));
    CHECK(tally.missing() == 2);
  }
  ErrorTally numbers;
  for (const double error : {3.0, kInfinity, 2.0}) numbers.add(error);
  CHECK(numbers.largest() == kInfinity);
}

TEST_CASE("A pixel one of whose coordinates is no number has no number for its error") {
  CHECK(std::isnan(errorInPixels({kNaN, 2}, {1, 0})));
  CHECK(std::isnan(errorInPixels({2, kNaN}, {0, 1})));
  CHECK(std::isnan(errorInUlps({kNaN, 2}, {1, 0})));
  CHECK(std::isnan(errorInUlps({2, kNaN}, {0, 1})));
  CHECK(errorInPixels({1, 5}, {2, 3}) == 2);
  CHECK(errorInUlps({1 + 0x1p-52, 2}, {1, 2}) == 1);
}
