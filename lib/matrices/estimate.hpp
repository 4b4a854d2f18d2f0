// Numbers that are known to the last place of what they were made of.
#pragma once

namespace viewproj {

/// What the numbers are true to: half a unit in the last place of a double or of a float32. For float32 each number is
/// rounded to one first.
enum class EntryPrecision { float64, float32 };

/// A number and the interval in which the entries leave it. May be infinite: an upper end that is says "not
/// determined".
struct Estimate {
  double value = 0, low = 0, high = 0;
};

}  // namespace viewproj
