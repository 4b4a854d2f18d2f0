// Numbers that are known to the last place of what they were made of.
#pragma once

#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// What the numbers are true to: half a unit in the last place of a double or of a float32. For float32 each number is
/// rounded to one first.
enum class EntryPrecision { float64, float32 };

/// How well the entries of a matrix are known.
struct EntryErrors {
  EntryPrecision precision = EntryPrecision::float64;
  Mat4 within{};  ///< each may be off by this, and at least by what the precision rounds; row by row as the matrix
};

/// A number and the interval in which the entries leave it. May be infinite: an upper end that is says "not
/// determined".
struct Estimate {
  double value = 0, low = 0, high = 0;
};

}  // namespace viewproj::cmd
