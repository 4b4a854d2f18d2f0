#include "picture/flat.hpp"

#include <algorithm>
#include <utility>

namespace viewproj::cmd {
namespace {

/// On a closed line, by the number of the corner before it and the share of the way to the next.
Vec2 placeAt(const Line& edge, double at) {
  const auto corner = static_cast<std::size_t>(at);
  return between(edge[corner % edge.size()], edge[(corner + 1) % edge.size()], at - static_cast<double>(corner));
}

/// Where a closed line is nearest to a point.
double nearestOn(const Line& edge, const Vec2& p) {
  double least = HUGE_VAL, nearest = 0;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const Vec2 &a = edge[i], &b = edge[(i + 1) % edge.size()];
    const double away = distanceToSegment(p, a, b), length = distance(a, b);
    if (!(away < least)) continue;
    least = away;
    const double along = std::sqrt(std::max(0.0, distance(p, a) * distance(p, a) - away * away));
    nearest = static_cast<double>(i) + (length > 0 ? std::min(along / length, 1.0) : 0);
  }
  return nearest;
}

}  // namespace

Rect boundsOf(const std::vector<Vec2>& points) {
  Rect box{NAN, NAN, NAN, NAN};  // fmin and fmax prefer numbers
  for (const Vec2& p : points)
    box = {std::fmin(box.left, p.x), std::fmin(box.top, p.y), std::fmax(box.right, p.x), std::fmax(box.bottom, p.y)};
  return box;
}

double distanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double x = b.x - a.x, y = b.y - a.y, squared = x * x + y * y;
  const double t = squared > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / squared, 0.0, 1.0) : 0;
  return distance(p, between(a, b, t));
}

double lengthWithin(const Vec2& a, const Vec2& b, const Rect& box) {
  double enter = 0, leave = 1;
  for (const auto& [from, way, low, high] :
       {std::array{a.x, b.x - a.x, box.left, box.right}, std::array{a.y, b.y - a.y, box.top, box.bottom}}) {
    if (way == 0 && !(low <= from && from <= high)) return 0;
    if (way == 0) continue;
    const auto [first, second] = std::minmax({(low - from) / way, (high - from) / way});
    enter = std::max(enter, first);
    leave = std::min(leave, second);
  }
  return std::max(0.0, leave - enter) * distance(a, b);
}

bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

double lengthOf(const std::vector<Vec2>& line) {
  double total = 0;
  for (std::size_t i = 1; i < line.size(); ++i) total += distance(line[i - 1], line[i]);
  return total;
}

std::vector<Vec2> simplified(const std::vector<Vec2>& line) {
  constexpr double kTolerance = 0.12;
  if (line.size() < 3) return line;
  std::vector<bool> stays(line.size());
  stays.front() = stays.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = 0;
    double most = kTolerance;
    for (std::size_t i = first + 1; i < last; ++i)
      if (const double away = distanceToSegment(line[i], line[first], line[last]); away > most)
        most = away, farthest = i;
    if (farthest == 0) continue;
    stays[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (stays[i]) kept.push_back(line[i]);
  return kept;
}

/// Along the edge, what belongs to it and what does not take turns, and each line leads from one turn to another.
std::vector<Line> outlinesWithin(const Line& edge, const std::vector<Line>& lines,
                                 const std::function<bool(const Vec2&)>& isIn) {
  constexpr double kJoin = 1, kShortest = 4;
  struct End {
    double at;
    const Line* line;
    bool isLast;
  };
  std::vector<Line> outlines;
  std::vector<End> ends;
  for (const Line& line : lines) {
    if (lengthOf(line) < kShortest) continue;
    if (distance(line.front(), line.back()) <= kJoin)
      outlines.push_back(line);
    else
      for (const bool isLast : {false, true})
        ends.push_back({nearestOn(edge, isLast ? line.back() : line.front()), &line, isLast});
  }
  if (ends.empty() && isIn(edge[0])) outlines.push_back(simplified(edge));
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.at < b.at; });
  const auto count = static_cast<double>(edge.size());
  std::vector<Line> runs(ends.size());  // of the edge, from each end to the next; empty if it does not belong
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double from = ends[i].at, to = i + 1 < ends.size() ? ends[i + 1].at : ends[0].at + count;
    const double middle = (from + to) / 2, corner = std::round(middle);
    if (!isIn(placeAt(edge, corner > from && corner < to ? corner : middle))) continue;
    runs[i] = {placeAt(edge, from)};
    for (double k = std::floor(from) + 1; k < to; ++k) runs[i].push_back(placeAt(edge, k));
    runs[i].push_back(placeAt(edge, to));
    runs[i] = simplified(runs[i]);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Line outline;
    for (std::size_t k = i; !runs[k].empty();) {
      outline.insert(outline.end(), runs[k].begin(), runs[k].end());
      runs[k].clear();
      const End& end = ends[(k + 1) % ends.size()];
      Line line = *end.line;
      if (end.isLast) std::reverse(line.begin(), line.end());
      outline.insert(outline.end(), line.begin(), line.end());
      const auto other = std::find_if(ends.begin(), ends.end(), [&](const End& each) {
        return each.line == end.line && each.isLast != end.isLast;
      });
      k = static_cast<std::size_t>(other - ends.begin());
    }
    if (!outline.empty()) outlines.push_back(outline);
  }
  return outlines;
}

std::vector<Vec2> hull(std::vector<Vec2> points) {
  const auto isBefore = [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(points.begin(), points.end(), isBefore);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> corners;
  for (int half = 0; half < 2; ++half, std::reverse(points.begin(), points.end())) {
    const std::size_t first = corners.size();
    for (const Vec2& p : points) {
      const auto turnsLeft = [&] {
        const Vec2 &a = corners[corners.size() - 2], &b = corners.back();
        return (b.x - a.x) * (p.y - a.y) > (b.y - a.y) * (p.x - a.x);
      };
      while (corners.size() > first + 1 && !turnsLeft()) corners.pop_back();
      corners.push_back(p);
    }
    corners.pop_back();  // the other half begins with it
  }
  return corners;
}

}  // namespace viewproj::cmd
