// Geometry on the sheet, in its units: x to the right, y down.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

struct Rect {
  double left = 0, top = 0, right = 0, bottom = 0;
};

inline Rect grown(const Rect& a, double by) { return {a.left - by, a.top - by, a.right + by, a.bottom + by}; }
inline Rect around(const Vec2& at, double x, double y) { return {at.x - x, at.y - y, at.x + x, at.y + y}; }
inline Vec2 middleOf(const Rect& a) { return {(a.left + a.right) / 2, (a.top + a.bottom) / 2}; }
inline bool meet(const Rect& a, const Rect& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}
inline bool holds(const Rect& outer, const Rect& inner) {
  return outer.left <= inner.left && inner.right <= outer.right && outer.top <= inner.top &&
         inner.bottom <= outer.bottom;
}
inline bool holds(const Rect& box, const Vec2& at) { return holds(box, around(at, 0, 0)); }
/// NaN if there are no points.
Rect boundsOf(const std::vector<Vec2>& points);
inline double largerSide(const Rect& a) { return std::fmax(a.right - a.left, a.bottom - a.top); }

/// a + k b.
inline Vec2 sum(const Vec2& a, double k, const Vec2& b) { return {a.x + k * b.x, a.y + k * b.y}; }
inline double distance(const Vec2& a, const Vec2& b) { return std::hypot(b.x - a.x, b.y - a.y); }
inline Vec2 between(const Vec2& a, const Vec2& b, double t) { return sum(a, t, sum(b, -1, a)); }
/// The direction from a to b, of length 1.
inline Vec2 wayFrom(const Vec2& a, const Vec2& b) { return sum({}, 1 / distance(a, b), sum(b, -1, a)); }
double distanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b);
/// Length of a segment within a box (Liang-Barsky).
double lengthWithin(const Vec2& a, const Vec2& b, const Rect& box);
bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

using Line = std::vector<Vec2>;
double lengthOf(const Line& line);
/// Without the points that lie within 0.12 of the line of those that stay (Douglas-Peucker).
std::vector<Vec2> simplified(const std::vector<Vec2>& line);
/// The outlines of a part of the area within an edge. lines: what parts it, each closed or from edge to edge. isIn:
/// whether a place on the edge belongs to it.
std::vector<Line> outlinesWithin(const Line& edge, const std::vector<Line>& lines,
                                 const std::function<bool(const Vec2&)>& isIn);
/// The corners of the convex hull, in order (Andrew's chains).
std::vector<Vec2> hull(std::vector<Vec2> points);

/// Finds things on the sheet by their boxes, so that nobody looks at all of them.
template <class T>
class Cells {
 public:
  explicit Cells(const Rect& sheet) : sheet_(sheet) {}

  void add(const Rect& box, const T& thing) {
    const Range range = rangeOf(box);
    for (std::size_t y = range.top; y <= range.bottom; ++y)
      for (std::size_t x = range.left; x <= range.right; ++x) cells_[y * kAcross + x].push_back({range, thing});
  }

  /// Whether is(thing) holds for one of those whose box may meet this one. Each is asked once, in the first cell of
  /// both.
  template <class Is>
  bool any(const Rect& box, Is is) const {
    const Range range = rangeOf(box);
    for (std::size_t y = range.top; y <= range.bottom; ++y)
      for (std::size_t x = range.left; x <= range.right; ++x)
        for (const auto& [of, thing] : cells_[y * kAcross + x])
          if (x == std::max(of.left, range.left) && y == std::max(of.top, range.top) && is(thing)) return true;
    return false;
  }

 private:
  static constexpr std::size_t kAcross = 40;
  struct Range {
    std::size_t left, top, right, bottom;
  };
  /// What is off the sheet belongs to the cells at its edge.
  Range rangeOf(const Rect& box) const {
    const auto index = [](double at, double from, double to) {
      const double cell = (at - from) / (to - from) * kAcross;
      return !(cell > 0) ? 0 : cell >= kAcross ? kAcross - 1 : static_cast<std::size_t>(cell);
    };
    const Rect& s = sheet_;
    return {index(box.left, s.left, s.right), index(box.top, s.top, s.bottom), index(box.right, s.left, s.right),
            index(box.bottom, s.top, s.bottom)};
  }

  Rect sheet_;
  std::vector<std::vector<std::pair<Range, T>>> cells_ =
      std::vector<std::vector<std::pair<Range, T>>>(kAcross * kAcross);
};

}  // namespace viewproj::cmd
