// The axes of a plot: values to places, and the grid with its labels.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "output/svg.hpp"

namespace viewproj::cmd::svg {

struct Tick {
  double value;
  std::string label;
  bool minor = false;
};

class Axis {
 public:
  /// least and most come to lie at low and high. logarithmic: both are above 0.
  Axis(bool logarithmic, double least, double most, double low, double high);

  double operator()(double value) const;

  /// Decades, nine at most, or round numbers. finer: also 2 and 5 times these, where decades are few.
  std::vector<Tick> ticks(bool finer = false) const;

 private:
  double place(double value) const;

  bool logarithmic_;
  double least_, most_, low_, high_;
};

/// A line across the area with a label under it, or to its left.
std::string upright(const Box& area, double x, const Tick& tick);
std::string level(const Box& area, double y, const Tick& tick);

/// The area's frame, and what its axes are.
std::string frameWithTitles(const Box& area, std::string_view x, std::string_view y);

}  // namespace viewproj::cmd::svg
