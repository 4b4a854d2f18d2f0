// Pairs of a point and its pixel as they come, by how much they miss, and what explains it.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "camera/read_camera.hpp"
#include "commands/check/hypothesis.hpp"
#include "output/report.hpp"

namespace viewproj::cmd::mistakes {

/// Distances of pixels: exact for the first ten thousand, then in steps of a thousandth.
class Misses {
 public:
  void add(double miss, std::size_t line);

  std::size_t count() const { return count_; }
  double rms() const;
  double mean() const;
  double largest() const { return largest_; }
  std::size_t worst() const { return worst_; }  ///< line of the largest
  double median() const;
  double most() const;  ///< the smallest that at least 95 % do not exceed

 private:
  /// The miss that so many are below, of all in order.
  double at(std::size_t rank) const;

  std::size_t count_ = 0, worst_ = 0;
  double sum_ = 0, squares_ = 0, largest_ = 0;
  std::vector<double> exact_;
  std::map<int, std::size_t> steps_;
};

/// Its size does not grow with the pairs.
class PairReport {
 public:
  /// within: the largest miss, in pixels, that still agrees.
  PairReport(const CameraFile& file, double within);

  /// pixel: nothing where the record says that the point has none.
  void add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line);

  std::size_t records() const { return records_; }
  bool agrees() const { return noPixel_ == 0 && misses_.largest() <= within_; }
  /// Every member is always there; what has no value is null.
  OrderedJson report() const;

 private:
  OrderedJson explanations(OrderedJson& wrong) const;

  CameraFile file_;
  Camera camera_;
  double within_;
  std::size_t records_ = 0, noPixel_ = 0, stride_ = 1;
  Misses misses_;
  std::vector<Pair> pairs_;  ///< the first, and every stride-th after it
  std::vector<std::size_t> lines_;
};

}  // namespace viewproj::cmd::mistakes
