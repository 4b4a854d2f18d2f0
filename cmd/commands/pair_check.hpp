// Points and the pixels that somebody has for them, compared with what the camera says.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "commands/mistakes.hpp"
#include "numbers/double_double.hpp"
#include "output/report.hpp"

namespace viewproj::cmd {

/// Takes pairs one by one; its size does not grow with them.
class PairCheck {
 public:
  /// within: the largest miss, in pixels, that still agrees.
  PairCheck(const Camera& camera, std::vector<Hypothesis> hypotheses, double within);

  /// line: of the record.
  void add(const Vec4& point, const Vec2& pixel, std::size_t line);

  bool agrees() const { return noPixel_ == 0 && misses_.largest <= within_; }
  std::size_t records() const { return records_; }
  /// Agreement, misses, explanations and fit. All members are always there; what has no value is null.
  OrderedJson report() const;

 private:
  struct Misses {
    double largest = 0, sum = 0;
    std::size_t worst = 0;  ///< line of the largest
    void add(double miss, std::size_t line);
  };
  struct Trial {
    Hypothesis hypothesis;
    Misses misses;
  };
  /// Of one axis: sums over the pairs that have a pixel, of computed and given positions from the first pair's.
  struct AxisSums {
    detail::DoubleDouble computed, given, computedSquared, givenSquared, product;
  };

  OrderedJson explanations() const;
  OrderedJson fit() const;

  Camera camera_;
  double within_;
  std::size_t records_ = 0, noPixel_ = 0;
  Misses misses_;
  std::vector<Trial> trials_;  ///< those that every pair so far agrees with
  std::array<AxisSums, 2> sums_;
  std::array<double, 2> origin_{};
};

}  // namespace viewproj::cmd
