// Pairs of a point and its pixel as they come, by how much they miss, and what explains it; of one camera, or of a set.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "commands/check/hypothesis.hpp"
#include "output/report.hpp"

namespace viewproj::cmd::mistakes {

/// Distances of pixels. Their number does not grow with the pairs: of too many, they are counted in steps of a
/// thousandth.
class Misses {
 public:
  explicit Misses(std::size_t exact) : exact_(exact) {}
  void add(double miss, std::size_t line);

  double largest() const { return largest_; }
  /// rmsMiss, meanMiss, medianMiss, miss95 (the smallest that at least 95 % do not exceed), largestMiss, and worst: the
  /// line of the largest. Null where there is none.
  OrderedJson statistics() const;

 private:
  /// The miss that so many are below, of all in order.
  double at(std::size_t rank) const;

  std::size_t exact_, count_ = 0, worst_ = 0;
  double sum_ = 0, squares_ = 0, largest_ = 0;
  bool isInSteps_ = false;
  std::map<double, std::size_t> counts_;
};

/// A camera with the pairs that are of it.
class CheckedCamera {
 public:
  /// exact, most: so many misses and pairs are kept.
  CheckedCamera(const CameraFile& file, double within, std::size_t exact, std::size_t most);

  /// Returns by how much the pair misses, where both have a pixel.
  std::optional<double> add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line);

  const CameraFile& file() const { return file_; }
  std::size_t noPixel() const { return noPixel_; }
  bool agrees() const { return noPixel_ == 0 && misses_.largest() <= within_; }
  /// Those on which explanations are sought: the first, and every 2^j-th after it.
  const std::vector<Pair>& pairs() const { return pairs_; }
  /// The lines of the pairs that alone disagree: at most a quarter, of four or more. Else none.
  std::vector<std::size_t> wrongLines() const;
  /// Which line has the pixel of which, if each has the pixel of another. Else empty.
  std::string pixelOrder() const;
  /// records, noPixel, and those of the misses.
  OrderedJson statistics() const;

 private:
  CameraFile file_;
  Camera camera_;
  double within_;
  std::size_t most_, records_ = 0, noPixel_ = 0, stride_ = 1;
  Misses misses_;
  std::vector<Pair> pairs_;
};

class PairReport {
 public:
  /// Of a set of cameras. within: the largest miss, in pixels, that still agrees.
  explicit PairReport(double within) : within_(within) {}
  /// Of one camera.
  PairReport(const CameraFile& file, double within);

  /// pixel: nothing where the record says that the point has none. camera: its place in the set. read: makes it, with
  /// its name, when it is first used.
  void add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line, std::size_t camera = 0,
           const std::function<std::pair<std::string, CameraFile>()>& read = nullptr);

  std::size_t records() const { return records_; }
  bool agrees() const;
  /// Every member is always there; what has no value is null.
  OrderedJson report() const;

 private:
  OrderedJson explanations(const CheckedCamera& of) const;

  double within_;
  bool isSet_ = true;
  std::size_t records_ = 0;
  Misses misses_{kExact};
  std::map<std::size_t, std::pair<std::string, CheckedCamera>> cameras_;

  static constexpr std::size_t kExact = 10'000, kPairs = 4096;           // of one camera
  static constexpr std::size_t kExactOfEach = 1000, kPairsOfEach = 512;  // of each camera of a set
};

}  // namespace viewproj::cmd::mistakes
