// Pairs of a point and its pixel as they come, by how much they miss, and what explains it; of one camera, or of a set.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "camera/read_camera.hpp"
#include "commands/check/judge.hpp"
#include "commands/check/mend.hpp"
#include "output/report.hpp"

namespace viewproj::cmd::mistakes {

/// What a report keeps: its size does not grow with the pairs.
struct Kept {
  std::size_t exact = 10'000;  ///< misses; more are counted in steps of a thousandth
  std::size_t pairs = 4096;    ///< on which explanations are sought: the first, and every 2^j-th after it
};

/// Distances of pixels.
class Misses {
 public:
  explicit Misses(std::size_t exact) : most_(exact) {}
  void add(double miss, std::size_t line);

  double largest() const { return largest_; }
  /// rmsMiss, meanMiss, medianMiss, miss95 (the smallest that at least 95 % do not exceed), largestMiss, and worst: the
  /// line of the largest. Null where there is none.
  OrderedJson statistics() const;

 private:
  /// The miss that so many are below, of all in order.
  double at(std::size_t rank) const;

  std::size_t most_, count_ = 0, worst_ = 0;
  double sum_ = 0, squares_ = 0, largest_ = 0;
  std::vector<double> exact_;
  std::map<int, std::size_t> steps_;
};

/// Of one camera.
class PairReport {
 public:
  /// within: the largest miss, in pixels, that still agrees.
  PairReport(const CameraFile& file, double within, const Kept& kept = {});

  /// pixel: nothing where the record says that the point has none. Returns by how much it misses, where both have one.
  std::optional<double> add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line);

  std::size_t records() const { return records_; }
  std::size_t noPixel() const { return noPixel_; }
  bool agrees() const { return noPixel_ == 0 && misses_.largest() <= within_; }
  OrderedJson statistics() const;
  /// Every member is always there; what has no value is null.
  OrderedJson report() const;

  // ---- For a set

  std::size_t judged() const { return pairs_.size(); }
  /// The lines of the pairs that alone disagree.
  std::vector<std::size_t> wrongLines() const;
  std::vector<Explanation> explanations() const;
  Mend mendOf(const Explanation& explanation) const;
  OrderedJson asJson(const Explanation& explanation, const Mend& mend) const;
  /// Whether the mend, as it stands, brings these pairs within.
  bool isMendedBy(const Mend& mend, const Hypothesis& hypothesis) const;
  /// Whether the explanation of another camera's pairs, made anew for this one, brings these within.
  bool isMendedBy(const PairReport& other, const Explanation& explanation) const;

 private:
  bool isWithin(const PlainCamera& camera, const Hypothesis& hypothesis, const PixelMap& pixels) const;
  std::vector<std::size_t> linesOf(const std::vector<std::size_t>& pairs) const;
  OrderedJson pixelOrderExplained() const;

  CameraFile file_;
  Camera camera_;
  double within_;
  std::size_t most_, records_ = 0, noPixel_ = 0, stride_ = 1;
  Misses misses_;
  std::vector<Pair> pairs_;
  std::vector<std::size_t> lines_;
};

/// Of the cameras of a set, each with the pairs that name it.
class SetReport {
 public:
  explicit SetReport(double within) : within_(within) {}

  /// camera: its place in the file. read: makes it, when it is first used.
  void add(std::size_t camera, const std::function<std::pair<std::string, CameraFile>()>& read, const Vec4& point,
           const std::optional<Vec2>& pixel, std::size_t line);

  std::size_t records() const { return records_; }
  bool agrees() const;
  OrderedJson report() const;

 private:
  struct Named {
    std::string name;
    PairReport report;
  };

  double within_;
  std::size_t records_ = 0;
  Misses misses_{Kept{}.exact};
  std::map<std::size_t, Named> cameras_;
};

}  // namespace viewproj::cmd::mistakes
