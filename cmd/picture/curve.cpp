#include "picture/curve.hpp"

#include <algorithm>
#include <numbers>

#include "numbers/vectors.hpp"

namespace viewproj::cmd {
namespace {

enum class State { outside, seen, hidden };

struct Sample {
  double t = 0;
  State state = State::outside;
  Vec2 at;
};

class Tracer {
 public:
  Tracer(const View& view, const std::function<Vec4(double)>& at, const CurveOptions& options)
      : view_(view), at_(at), options_(options) {}

  Pieces pieces(int steps) {
    Sample last = sampleAt(0);
    if (last.state != State::outside) begin(last);
    for (int i = 1; i <= steps; ++i) {
      const Sample next = sampleAt(static_cast<double>(i) / steps);
      walk(last, next, kHalvings);
      last = next;
    }
    for (Piece& piece : pieces_) piece.line = simplified(piece.line);
    return std::move(pieces_);
  }

 private:
  static constexpr int kHalvings = 20, kLeastHalvings = 14;
  static constexpr double kLongest = 24, kLeast = 1.5, kBend = 0.06;

  Sample sampleAt(double t) const {
    const Vec4 p = at_(t);
    const auto at = view_.place(p, options_.extent);
    if (!at) return {t, State::outside, {}};
    // What the lens does not show of a line without the lens is seen.
    const auto real = options_.extent == Extent::withoutLens ? view_.place(p) : at;
    const auto point = positionOf(p);
    const bool isHidden = options_.findsHidden && point && real && view_.hides(*point, *real, options_.except);
    return {t, isHidden ? State::hidden : State::seen, *at};
  }

  void begin(const Sample& from) { pieces_.push_back({from.state == State::hidden, {from.at}}); }

  /// Goes on from a, which is drawn, to b.
  void walk(const Sample& a, const Sample& b, int halvings) {
    const bool changes = a.state != b.state;
    if (!changes && a.state == State::outside) return;
    const double gap = distance(a.at, b.at);
    const bool isNear = gap <= kLongest, mayBend = gap > kLeast && halvings > kLeastHalvings;
    if (halvings > 0 && (changes || !isNear || mayBend)) {
      const Sample middle = sampleAt((a.t + b.t) / 2);
      if (changes || !isNear || middle.state != a.state || distanceToSegment(middle.at, a.at, b.at) >= kBend) {
        walk(a, middle, halvings - 1);
        return walk(middle, b, halvings - 1);
      }
    }
    if (b.state == State::outside) return;
    const bool joins = a.state != State::outside && isNear;
    if (joins) pieces_.back().line.push_back(b.at);
    if (changes || !joins) begin(b);
  }

  const View& view_;
  const std::function<Vec4(double)>& at_;
  CurveOptions options_;
  Pieces pieces_;
};

/// The part of a segment within the planes of the view without its lens, from and to in t.
std::pair<double, double> clipped(const View& view, const Vec3& a, const Vec3& b) {
  double from = 0, to = 1;
  for (const FrustumPlane& plane : view.frustum().planes()) {
    const Vec4& e = plane.equation;
    const double atA = e.x * a.x + e.y * a.y + e.z * a.z + e.w, atB = e.x * b.x + e.y * b.y + e.z * b.z + e.w;
    if (atA < 0 && atB < 0) return {1, 0};
    if (atA < 0) from = std::max(from, atA / (atA - atB));
    if (atB < 0) to = std::min(to, atA / (atA - atB));
  }
  return {from, to};
}

}  // namespace

std::vector<Vec2> pointsOf(const Pieces& pieces) {
  std::vector<Vec2> points;
  for (const Piece& piece : pieces) points.insert(points.end(), piece.line.begin(), piece.line.end());
  return points;
}

std::vector<Line> joined(const Pieces& pieces) {
  constexpr double kJoin = 1;
  std::vector<Line> lines;
  for (const auto& [isHidden, line] : pieces) {
    if (lines.empty() || distance(lines.back().back(), line.front()) > kJoin) lines.emplace_back();
    lines.back().insert(lines.back().end(), line.begin(), line.end());
  }
  if (lines.size() < 2 || distance(lines.back().back(), lines.front().front()) > kJoin) return lines;
  lines.back().insert(lines.back().end(), lines.front().begin(), lines.front().end());
  lines.erase(lines.begin());
  return lines;
}

Pieces piecesOf(const View& view, const std::function<Vec4(double)>& at, int steps, const CurveOptions& options) {
  return Tracer(view, at, options).pieces(steps);
}

Pieces piecesOf(const View& view, const Vec3& a, const Vec3& b, const CurveOptions& options) {
  constexpr double kStepsOfPicture = 80, kFewest = 4, kMost = 2000;
  const bool isStraight = !view.hasLens() || options.extent == Extent::withoutLens;
  const auto [from, to] = isStraight ? clipped(view, a, b) : std::pair(0.0, 1.0);
  if (!(from <= to)) return {};
  const Vec3 start = pointAlong(a, b, from), end = pointAlong(a, b, to);
  const Vec3 u = sum(start, -1, view.eye()), v = sum(end, -1, view.eye());
  const double angle = std::atan2(length(detail::crossOf(u, v)), detail::dot(u, v));
  const bool isEven = view.isParallel() || angle < 1e-9;
  const double toStart = length(u), toEnd = length(v);
  const auto at = [&](double t) {
    const double x = toStart * std::sin(t * angle), y = toEnd * std::sin((1 - t) * angle);
    return pointOf(pointAlong(start, end, isEven ? t : x / (x + y)));
  };
  const double fov = view.camera().projection().fov(Fov::diagonal) * std::numbers::pi / 180;
  const double steps = view.isParallel() ? kStepsOfPicture : std::ceil(kStepsOfPicture * angle / fov);
  return piecesOf(view, at, static_cast<int>(std::clamp(steps, kFewest, kMost)), options);
}

}  // namespace viewproj::cmd
