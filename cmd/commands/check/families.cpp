#include "commands/check/families.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "text/error.hpp"

namespace viewproj::cmd::mistakes {

using detail::crossOf;
using detail::dot;
namespace {

// clang-format off
/// What a parameter changes. Factors less 1; pixels / 1000; radians; parts of the pairs' distance.
enum class By : std::uint8_t {
  f, fx, fy,      // focal lengths
  s, sx, sy,      // focal lengths and centre, about the picture's corner
  cx, cy,         // the centre
  h, p, r,        // a turn about up, the horizontal right, forward
  wx, wy, wz,     // a turn about an axis of the world
  rx, ry, rz,     // any turn
  X, Y, Z, up,    // the eye
  u,              // the eye's distance from the origin
  k1, k2, p1, p2  // the lens
};

/// value: its numbers. f g: factors of the focal lengths; x y: pixels; d: degrees; X Y Z u: the eye's way, and up; s: the
/// factor of its distance from the origin; k l p q: the lens.
struct Family {
  const char* mistake;
  std::vector<By> by;
  std::string_view value;
};

const std::vector<Family>& familiesOf(Table table) {
  using enum By;
  static const std::vector<Family> kSimple = {
      {"focal-length", {f}, "f"}, {"focal-lengths", {fx}, "fg"}, {"focal-lengths", {fy}, "fg"}, {"pixel-ratio", {s}, "f"},
      {"principal-point", {cx}, "xy"}, {"principal-point", {cy}, "xy"}, {"heading", {h}, "d"}, {"pitch", {p}, "d"},
      {"roll", {r}, "d"}, {"height", {up}, "u"}, {"unit", {u}, "s"}, {"lens", {k1}, "k"},
      {"focal-lengths", {fx, fy}, "fg"}, {"resized", {sx, sy}, "fg"}, {"principal-point", {cx, cy}, "xy"},
      {"lens", {k1, k2}, "kl"}, {"rotation", {rx, ry, rz}, "d"}, {"eye", {X, Y, Z}, "XYZ"},
      {"scale-and-offset", {f, cx, cy}, "fxy"}, {"scales-and-offset", {fx, fy, cx, cy}, "fgxy"},
      {"lens", {k1, k2, p1, p2}, "klpq"}, {"rotation", {wx}, "d"}, {"rotation", {wy}, "d"}, {"rotation", {wz}, "d"},
      {"eye", {X}, "XYZ"}, {"eye", {Y}, "XYZ"}, {"eye", {Z}, "XYZ"}};
  static const std::vector<Family> kPoses = {
      {"pan-tilt-zoom", {rx, ry, rz, f}, "df"},
      {"pose", {rx, ry, rz, X, Y, Z}, "dXYZ"},
      {"pose-and-focal-length", {rx, ry, rz, X, Y, Z, f}, "dXYZ"},
      {"another-camera", {rx, ry, rz, X, Y, Z, fx, fy, cx, cy}, "dXYZ"}};
  return table == Table::simple ? kSimple : kPoses;
}
// clang-format on

bool isBetween(By by, By first, By last) { return by >= first && by <= last; }
std::size_t offsetOf(By by, By first) { return static_cast<std::size_t>(by) - static_cast<std::size_t>(first); }

/// The axis of a heading, a pitch or a roll in the world.
Vec3 axisOf(const PlainCamera& camera, const Vec3& up, By by) {
  if (by == By::h) return up;
  if (by == By::r) return camera.axes[2];
  const Vec3 right = crossOf(camera.axes[2], up);
  const double size = length(right);
  if (size < 1e-6) return camera.axes[0];
  return scaled(right, (dot(right, camera.axes[0]) < -1e-9 ? -1 : 1) / size);
}

class Solver {
 public:
  Solver(const Fit& fit, const Family& family, double size, std::size_t wrong)
      : fit_(fit), by_(family.by), size_(size), wrong_(wrong) {}

  struct Solution {
    PlainCamera camera;
    double cost = HUGE_VAL;
  };
  Solution solve(PlainCamera camera, int steps) const;

 private:
  using Numbers = std::vector<double>;

  PlainCamera moved(const PlainCamera& from, const Numbers& values) const;
  /// x and y of each pair, NaN without a pixel.
  Numbers misses(const PlainCamera& camera) const;
  double costOf(const Numbers& misses, const Numbers& weights) const;
  Numbers distances(const Numbers& misses) const;

  const Fit& fit_;
  const std::vector<By>& by_;
  double size_;
  std::size_t wrong_;
};

PlainCamera Solver::moved(const PlainCamera& from, const Numbers& values) const {
  PlainCamera to = from;
  Vec3 turned{};  // in the camera's axes
  const auto& corner = fit_.corner;
  for (std::size_t i = 0; i < by_.size(); ++i) {
    const By by = by_[i];
    const double v = values[i];
    if (by == By::f || by == By::fx || by == By::s || by == By::sx) to.focal.x *= 1 + v;
    if (by == By::f || by == By::fy || by == By::s || by == By::sy) to.focal.y *= 1 + v;
    if (by == By::s || by == By::sx) to.centre.x = corner.x + (to.centre.x - corner.x) * (1 + v);
    if (by == By::s || by == By::sy) to.centre.y = corner.y + (to.centre.y - corner.y) * (1 + v);
    if (by == By::cx) to.centre.x += v * 1000;
    if (by == By::cy) to.centre.y += v * 1000;
    if (isBetween(by, By::h, By::r)) turned = sum(turned, v, from.axes * axisOf(from, fit_.up, by));
    if (isBetween(by, By::wx, By::wz)) turned = sum(turned, v, column(from.axes, offsetOf(by, By::wx)));
    if (isBetween(by, By::rx, By::rz)) turned[offsetOf(by, By::rx)] += v;
    if (isBetween(by, By::X, By::Z)) to.eye[offsetOf(by, By::X)] += v * size_;
    if (by == By::up) to.eye = sum(to.eye, v * size_, fit_.up);
    if (by == By::u) to.eye = scaled(to.eye, 1 + v);
    if (by >= By::k1 && !to.trial) {
      to.trial = TrialLens{};
      if (from.lens) to.trial = TrialLens{{from.lens->k()[0], from.lens->k()[1], from.lens->k()[2]}, from.lens->p()};
    }
    if (isBetween(by, By::k1, By::k2)) to.trial->k[offsetOf(by, By::k1)] += v;
    if (isBetween(by, By::p1, By::p2)) to.trial->p[offsetOf(by, By::p1)] += v;
  }
  if (turned != Vec3{}) to.axes = turn(turned) * from.axes;
  return to;
}

Solver::Numbers Solver::misses(const PlainCamera& camera) const {
  Numbers all;
  all.reserve(2 * fit_.pairs.size());
  for (const Pair& pair : fit_.pairs) {
    const Vec2 at = pixelOf(camera, pair.point);
    all.push_back(at.x - pair.pixel.x);
    all.push_back(at.y - pair.pixel.y);
  }
  return all;
}

double Solver::costOf(const Numbers& misses, const Numbers& weights) const {
  double cost = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0) cost += weights[i] * (misses[2 * i] * misses[2 * i] + misses[2 * i + 1] * misses[2 * i + 1]);
  return std::isfinite(cost) ? cost : HUGE_VAL;
}

Solver::Numbers Solver::distances(const Numbers& misses) const {
  Numbers all;
  for (std::size_t i = 0; i < misses.size(); i += 2) {
    const double distance = length(Vec2{misses[i], misses[i + 1]});
    all.push_back(std::isfinite(distance) ? distance : 1e9);
  }
  return all;
}

/// Solves a system with a positive definite matrix in place (Cholesky); false if there is no solution.
bool solveSystem(std::vector<std::vector<double>> a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
      if (i == j && !(a[i][i] > 0)) return false;
      a[i][j] = i == j ? std::sqrt(a[i][i]) : a[i][j] / a[j][j];
    }
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return std::all_of(b.begin(), b.end(), [](double x) { return std::isfinite(x); });
}

// Damped Gauss-Newton (Levenberg): derivatives by differences; the damping grows where a step fails.
Solver::Solution Solver::solve(PlainCamera camera, int steps) const {
  constexpr double kStep = 1e-6;
  const std::size_t n = fit_.pairs.size(), count = by_.size();
  const auto seenBy = [&](const PlainCamera& by) {
    Numbers weights;
    const Numbers all = misses(by);
    for (std::size_t i = 0; i < n; ++i) weights.push_back(std::isfinite(all[2 * i] + all[2 * i + 1]) ? 1 : 0);
    return weights;
  };
  Numbers weights = seenBy(camera);  // points behind the start count from the second step on
  if (std::accumulate(weights.begin(), weights.end(), 0.0) < std::max<double>(1, static_cast<double>((count + 1) / 2)))
    return {camera};
  double damping = 1e-6, sigma = 0;
  for (int step = 0; step < steps; ++step) {
    const Numbers now = misses(camera);
    if (wrong_ > 0) {
      Numbers sorted = distances(now);
      const Numbers all = sorted;
      std::sort(sorted.begin(), sorted.end());
      const double median = (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
      sigma = sigma == 0 ? sorted[n - wrong_ - 1] : std::max({sigma / 2, median, 1e-4});
      for (std::size_t i = 0; i < n; ++i) {
        const double share = all[i] / std::max(sigma, 1e-4);
        weights[i] = std::isfinite(now[2 * i]) ? 1 / ((1 + share * share) * (1 + share * share)) : 0;
      }
    } else if (step == 1) {
      weights = seenBy(camera);
    }
    const double cost = costOf(now, weights);
    if (!std::isfinite(cost)) return {camera};
    std::vector<Numbers> slopes(count);
    for (std::size_t j = 0; j < count; ++j) {
      Numbers values(count);
      values[j] = kStep;
      slopes[j] = misses(moved(camera, values));
      for (std::size_t i = 0; i < 2 * n; ++i) {
        slopes[j][i] = weights[i / 2] > 0 ? (slopes[j][i] - now[i]) / kStep : 0;
        if (!std::isfinite(slopes[j][i])) return {camera};
      }
    }
    std::vector<Numbers> normal(count, Numbers(count));
    Numbers gradient(count);
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t i = 0; i < 2 * n; ++i)
        if (weights[i / 2] > 0) gradient[a] -= weights[i / 2] * slopes[a][i] * now[i];
      for (std::size_t b = 0; b <= a; ++b) {
        for (std::size_t i = 0; i < 2 * n; ++i) normal[a][b] += weights[i / 2] * slopes[a][i] * slopes[b][i];
        normal[b][a] = normal[a][b];
      }
    }
    PlainCamera next = camera;
    double then = HUGE_VAL;
    for (int attempt = 0; attempt < 14 && !(then < cost); ++attempt) {
      std::vector<Numbers> damped = normal;
      for (std::size_t a = 0; a < count; ++a) damped[a][a] += damping * std::max(normal[a][a], 1e-300);
      Numbers change = gradient;
      if (solveSystem(std::move(damped), change)) {
        next = moved(camera, change);
        then = costOf(misses(next), weights);
      }
      if (!(then < cost)) damping = std::max(damping, 1e-9) * 10;
    }
    if (!(then < cost)) break;
    camera = next;
    damping /= 10;
    if (wrong_ == 0 && step > 0 && (cost - then < 1e-10 * cost || then < 1e-18 * static_cast<double>(n))) break;
  }
  return {camera, costOf(misses(camera), wrong_ == 0 ? Numbers(n, 1) : weights)};
}

/// Of the given pixels, in the camera's axes; 0 where the lens has none.
std::vector<Vec3> raysOf(const PlainCamera& camera, const std::vector<Pair>& pairs) {
  std::vector<Vec3> rays;
  for (const Pair& pair : pairs) {
    const Vec2 at{(pair.pixel.x - camera.centre.x) / camera.focal.x, (pair.pixel.y - camera.centre.y) / camera.focal.y};
    const Vec3 ray = camera.lens ? undistorted(*camera.lens, at) : Vec3{at.x, at.y, 1};
    rays.push_back(std::isfinite(ray.x + ray.y) ? scaled(ray, 1 / length(ray)) : Vec3{});
  }
  return rays;
}

/// The turned cameras whose rays agree best with the points: about an axis of the camera's, or any.
std::vector<PlainCamera> startsOf(const Fit& fit, const std::optional<Vec3>& axis, std::size_t count) {
  std::vector<Rows> turns;
  if (axis) {
    for (int quarter = 0; quarter < 4; ++quarter) turns.push_back(turn(scaled(*axis, quarter * std::numbers::pi / 2)));
  } else {
    for (const auto& [name, rows] : signedAxes())
      if (determinant(rows) > 0) turns.push_back(rows);
  }
  const std::vector<Vec3> rays = raysOf(fit.camera, fit.pairs);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    double agreement = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Vec4& p = fit.pairs[i].point;
      const Vec3 way = fit.camera.axes * sum({p.x, p.y, p.z}, -p.w, fit.camera.eye);
      agreement += dot(turns[t] * way, rays[i]) / length(way);
    }
    order.emplace_back(-agreement, t);
  }
  std::sort(order.begin(), order.end());
  std::vector<PlainCamera> starts;
  for (std::size_t i = 0; i < std::min(count, order.size()); ++i) {
    starts.push_back(fit.camera);
    starts.back().axes = turns[order[i].second] * fit.camera.axes;
  }
  return starts;
}

double medianDistance(const Fit& fit) {
  std::vector<double> all;
  for (const Pair& pair : fit.pairs) {
    const Vec4& p = pair.point;
    const double weight = p.w == 0 ? 1 : p.w;
    all.push_back(length(sum({p.x / weight, p.y / weight, p.z / weight}, p.w == 0 ? 0 : -1, fit.camera.eye)));
  }
  std::sort(all.begin(), all.end());
  return (all[(all.size() - 1) / 2] + all[all.size() / 2]) / 2;
}

Json valueOf(const Family& family, const Fit& fit, const PlainCamera& to) {
  const PlainCamera& from = fit.camera;
  const Rows turned = to.axes * transposed(from.axes);
  const Vec3 way = sum(to.eye, -1, from.eye), skew = skewOf(turned);
  double degrees = angleOf(turned) * 180 / std::numbers::pi;
  if (isBetween(family.by[0], By::h, By::r) && dot(skew, to.axes * axisOf(from, fit.up, family.by[0])) < 0)
    degrees = -degrees;
  const TrialLens lens = to.trial.value_or(TrialLens{});  // no step has made one: its numbers are 0
  const std::pair<char, double> numbers[] = {{'f', to.focal.x / from.focal.x},
                                             {'g', to.focal.y / from.focal.y},
                                             {'x', to.centre.x - from.centre.x},
                                             {'y', to.centre.y - from.centre.y},
                                             {'d', degrees},
                                             {'X', way.x},
                                             {'Y', way.y},
                                             {'Z', way.z},
                                             {'u', dot(way, fit.up)},
                                             {'s', dot(to.eye, from.eye) / dot(from.eye, from.eye)},
                                             {'k', lens.k[0]},
                                             {'l', lens.k[1]},
                                             {'p', lens.p[0]},
                                             {'q', lens.p[1]}};
  Json value = Json::array();
  for (const char letter : family.value)
    for (const auto& [name, number] : numbers)
      if (name == letter) value.push_back(number);
  return value.size() == 1 && family.value != "k" ? value[0] : value;
}

}  // namespace

std::size_t countOf(Table table) { return familiesOf(table).size(); }

std::vector<Hypothesis> families(const Fit& fit, Table table, std::size_t wrong) {
  const double size = medianDistance(fit);
  std::vector<Hypothesis> all;
  for (const Family& family : familiesOf(table)) {
    const By first = family.by[0];
    const std::size_t count = family.by.size();
    if (2 * fit.pairs.size() < count + 1) continue;
    const auto& lens = fit.camera.lens;
    const bool isPolynomial =
        !lens || (lens->model() == LensModel::brown && lens->k()[3] == 0 && lens->k()[4] == 0 && lens->k()[5] == 0);
    if (first >= By::k1 && (fit.camera.isOrthographic || !isPolynomial)) continue;
    const bool isWorldAxis = isBetween(first, By::wx, By::wz) || (count == 1 && isBetween(first, By::X, By::Z));
    if (fit.isOnEarth && (isWorldAxis || first == By::u)) continue;
    if (first == By::u && !(length(fit.camera.eye) > 0)) continue;
    std::vector<PlainCamera> starts{fit.camera};
    if (!fit.camera.isOrthographic) {
      if (isBetween(first, By::wx, By::wz)) starts = startsOf(fit, column(fit.camera.axes, offsetOf(first, By::wx)), 2);
      if (isBetween(first, By::h, By::r))
        starts = startsOf(fit, fit.camera.axes * axisOf(fit.camera, fit.up, first), 2);
      if (first == By::rx) starts = startsOf(fit, std::nullopt, count < 6 ? 3 : 6);
    }
    const Solver solver(fit, family, size, wrong);
    Solver::Solution best{fit.camera};
    for (const PlainCamera& start : starts) {
      const auto solution = solver.solve(start, count >= 6 ? 40 : wrong > 0 ? 16 : 12);
      // A mirrored twin costs the same.
      if (!(solution.camera.focal.x * fit.camera.focal.x > 0 && solution.camera.focal.y * fit.camera.focal.y > 0))
        continue;
      if (solution.cost < best.cost) best = solution;
      if (best.cost < 1e-12 * static_cast<double>(fit.pairs.size())) break;
    }
    if (!std::isfinite(best.cost)) continue;
    Hypothesis solved{.mistake = family.mistake, .camera = best.camera};
    solved.value = valueOf(family, fit, best.camera);
    solved.isSolved = true;
    solved.parameters = static_cast<int>(count);
    if (first == By::s || first == By::sx)
      solved.scale = best.camera.focal.x * best.camera.focal.y / (fit.camera.focal.x * fit.camera.focal.y);
    const double times = first == By::u ? solved.value.get<double>() : 0;
    if (first == By::u) solved.value = {"position", times};
    all.push_back(solved);
    if (times > 0) {
      const double factor = 1 / times;
      Hypothesis points{.mistake = family.mistake, .value = {"points", factor}, .camera = fit.camera};
      points.points = {Vec3{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}};
      points.parameters = 1;
      all.push_back(std::move(points));
    }
  }
  return all;
}

}  // namespace viewproj::cmd::mistakes
