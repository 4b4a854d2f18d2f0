#include "input/field_of_view.hpp"

#include "numbers/degrees.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// Of the angle whose sine and cosine are these times the product of the lengths: tan(angle / 2) = sin / (1 + cos), or
/// (1 - cos) / sin, whichever does not cancel.
double degreesOf(DoubleDouble sine, DoubleDouble cosine, DoubleDouble lengths) noexcept {
  return degreesOfHalfTangent(cosine.hi >= 0 ? sine / (lengths + cosine) : (lengths - cosine) / sine);
}

}  // namespace

double degreesAcross(DoubleDouble from, DoubleDouble to) noexcept {
  const DoubleDouble one(1);
  return degreesOf(to - from, one + from * to, sqrt((one + from * from) * (one + to * to)));
}

double degreesBetween(DoubleDouble x0, DoubleDouble y0, DoubleDouble x1, DoubleDouble y1) noexcept {
  const DoubleDouble one(1), u = y0 - y1, v = x1 - x0, w = x0 * y1 - y0 * x1;
  return degreesOf(sqrt(u * u + v * v + w * w), one + x0 * x1 + y0 * y1,
                   sqrt((one + x0 * x0 + y0 * y0) * (one + x1 * x1 + y1 * y1)));
}

}  // namespace viewproj::cmd
