// What the peer tests measure with: errors against bounds, cases visited, and plain 4x4 arithmetic.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "catch.hpp"
#include "viewproj/viewproj.hpp"

namespace peers {

/// Half a unit in the last place of 1: the most that one rounding changes a number by, relative.
inline constexpr double kRounding = 0x1p-53;

/// The largest error seen, in units of its bound. NaN counts as infinite; an error of 0 always fits.
class Worst {
 public:
  void see(std::uint64_t trial, double error, double bound) {
    const double size = std::fabs(error);
    const double ratio = size == 0 ? 0 : size <= bound ? size / bound : size > bound ? size / bound : kHuge;
    if (ratio <= ratio_) return;
    ratio_ = ratio;
    trial_ = trial;
  }

  double ratio() const { return ratio_; }
  std::uint64_t trial() const { return trial_; }

 private:
  static constexpr double kHuge = std::numeric_limits<double>::infinity();
  double ratio_ = 0;
  std::uint64_t trial_ = 0;
};

/// How often each case came up, so that a random test shows what it has visited.
class Tally {
 public:
  void count(const std::string& name, bool happened = true) { counts_[name] += happened ? 1 : 0; }

  std::vector<std::string> notVisited() const {
    std::vector<std::string> names;
    for (const auto& [name, count] : counts_)
      if (count == 0) names.push_back(name);
    return names;
  }

 private:
  std::map<std::string, int> counts_;
};

inline viewproj::Vec4 times(const viewproj::Mat4& m, const viewproj::Vec4& v) {
  const auto row = [&](std::size_t i) { return m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z + m[i][3] * v.w; };
  return {row(0), row(1), row(2), row(3)};
}

/// The same with every term taken positive: what rounding errors of such a product are relative to.
inline viewproj::Vec4 sizes(const viewproj::Mat4& m, const viewproj::Vec4& v) {
  viewproj::Mat4 a = m;
  for (auto& row : a.m)
    for (double& entry : row) entry = std::fabs(entry);
  return times(a, {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z), std::fabs(v.w)});
}

inline viewproj::Vec4 point(const viewproj::Vec3& p) { return {p.x, p.y, p.z, 1}; }
inline viewproj::Vec3 minus(const viewproj::Vec3& a, const viewproj::Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double dot(const viewproj::Vec3& a, const viewproj::Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(const viewproj::Vec3& a) { return std::hypot(a.x, a.y, a.z); }

inline viewproj::Vec3 cross(const viewproj::Vec3& a, const viewproj::Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline viewproj::Convention preset(std::string_view name) { return *viewproj::findPreset(name); }

/// error <= bound, failing for NaN, with the worst trial told.
#define CHECK_WITHIN_BOUND(worst)               \
  do {                                          \
    INFO("worst of trial " << (worst).trial()); \
    CHECK((worst).ratio() <= 1);                \
  } while (false)

#define CHECK_ALL_VISITED(tally) CHECK((tally).notVisited() == std::vector<std::string>{})

}  // namespace peers
