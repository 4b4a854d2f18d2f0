// How far results lie from the exact ones.
#pragma once

#include <cstddef>
#include <vector>

#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// Errors of many results. NaN counts as larger than infinity, and both as larger than any number, so that a result
/// that is none shows in the largest error.
class ErrorTally {
 public:
  /// error: in any unit, NaN where the result is not a number.
  void add(double error);

  double largest() const;
  /// The error that 99 of 100 results do not exceed.
  double percentile99();
  /// How many are not finite.
  std::size_t missing() const { return missing_; }

 private:
  std::vector<double> errors_;
  std::size_t missing_ = 0;
};

/// The larger error of x and y, in pixels.
double errorInPixels(const Vec2& result, const Vec2& exact);

/// The larger error of x and y, each in units in the last place of its exact value; infinite for an error of a zero.
double errorInUlps(const Vec2& result, const Vec2& exact);

/// The angle between unit vectors in radians, to about 1e-16.
double angleBetween(const Vec3& a, const Vec3& b);

}  // namespace viewproj::cmd
