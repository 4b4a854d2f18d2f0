#include "commands/check/families.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

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

/// value: its numbers. f g: factors of the focal lengths; x y: pixels; a b: what the pixel 0, 0 becomes; d: degrees;
/// X Y Z U: the eye's way, and up; u: the factor of its distance from the origin; k l p q: the lens.
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
      {"roll", {r}, "d"}, {"height", {up}, "U"}, {"unit", {u}, "u"}, {"lens", {k1}, "k"},
      {"focal-lengths", {fx, fy}, "fg"}, {"resized", {sx, sy}, "fg"}, {"principal-point", {cx, cy}, "xy"},
      {"lens", {k1, k2}, "kl"}, {"rotation", {rx, ry, rz}, "d"}, {"eye", {X, Y, Z}, "XYZ"},
      {"scale-and-offset", {f, cx, cy}, "fab"}, {"scales-and-offset", {fx, fy, cx, cy}, "fgab"},
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

/// The axis of a turn, in the camera.
Vec3 axisOf(const Fit& fit, const PlainCamera& camera, By by) {
  const Rows& axes = camera.axes;
  if (by == By::h) return axes * fit.up;
  if (by == By::r) return {0, 0, 1};
  if (isBetween(by, By::wx, By::wz)) return axes * fit.world[offsetOf(by, By::wx)];
  if (isBetween(by, By::rx, By::rz)) return kUnit[offsetOf(by, By::rx)];
  const Vec3 right = crossOf(axes[2], fit.up);
  if (length(right) < 1e-6) return {1, 0, 0};
  return axes * scaled(right, (dot(right, axes[0]) < -1e-9 ? -1 : 1) / length(right));
}

/// size: the median distance of the pairs.
PlainCamera moved(const Fit& fit, double size, const PlainCamera& from, const std::vector<By>& by,
                  const std::vector<double>& values) {
  PlainCamera to = from;
  Vec3 turned{};  // in the camera's axes
  for (std::size_t i = 0; i < by.size(); ++i) {
    const By one = by[i];
    const double v = values[i];
    const bool isScale = isBetween(one, By::s, By::sy);
    if (one == By::f || one == By::fx || one == By::s || one == By::sx) to.focal.x *= 1 + v;
    if (one == By::f || one == By::fy || one == By::s || one == By::sy) to.focal.y *= 1 + v;
    if (isScale && one != By::sy) to.centre.x += v * (to.centre.x - fit.corner.x);
    if (isScale && one != By::sx) to.centre.y += v * (to.centre.y - fit.corner.y);
    if (one == By::cx) to.centre.x += v * 1000;
    if (one == By::cy) to.centre.y += v * 1000;
    if (isBetween(one, By::h, By::rz)) turned = sum(turned, v, axisOf(fit, from, one));
    if (isBetween(one, By::X, By::Z)) to.eye = sum(to.eye, v * size, fit.world[offsetOf(one, By::X)]);
    if (one == By::up) to.eye = sum(to.eye, v * size, fit.up);
    if (one == By::u) to.eye = scaled(to.eye, 1 + v);
    if (one >= By::k1) {
      if (!to.lens) to.lens.emplace();
      to.lens->limitCosine = 0;
      (one >= By::p1 ? to.lens->p[offsetOf(one, By::p1)] : to.lens->k[offsetOf(one, By::k1)]) += v;
    }
  }
  if (turned != Vec3{}) to.axes = turn(turned) * from.axes;
  return to;
}

// ---- The solver: damped Gauss-Newton (Levenberg), with derivatives by differences

using Numbers = std::vector<double>;

/// Equations of a positive definite matrix, each with its right side behind it; nothing if they have no solution.
std::optional<Numbers> solved(std::vector<Numbers> rows) {
  const std::size_t n = rows.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(rows[i][i] > 0)) return std::nullopt;
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = n + 1; k-- > i;) rows[j][k] -= rows[j][i] / rows[i][i] * rows[i][k];
  }
  Numbers x(n);
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) rows[i][n] -= rows[i][j] * x[j];
    x[i] = rows[i][n] / rows[i][i];
    if (!std::isfinite(x[i])) return std::nullopt;
  }
  return x;
}

double medianOf(Numbers all) {
  std::sort(all.begin(), all.end());
  return (all[(all.size() - 1) / 2] + all[all.size() / 2]) / 2;
}

struct Solution {
  PlainCamera camera;
  double cost = HUGE_VAL;
};

class Solver {
 public:
  /// wrong: how many pairs may be.
  Solver(const Fit& fit, double size, const std::vector<By>& by, std::size_t wrong)
      : fit_(fit), size_(size), by_(by), wrong_(wrong) {}

  Solution from(PlainCamera camera, int steps) const {
    Numbers now = misses(camera), weight = weights(now, 0);
    const auto n = static_cast<double>(fit_.pairs.size()), count = static_cast<double>(by_.size());
    if (2 * std::accumulate(weight.begin(), weight.end(), 0.0) < std::max(2.0, count)) return {camera};
    double damping = 1e-6;
    for (int step = 0; step < steps; ++step) {
      weight = weights(now, step);  // points behind the start count once they are seen
      const double cost = costOf(now, weight);
      const auto rows = equations(camera, now, weight);
      if (!std::isfinite(cost) || !rows) return {camera};
      PlainCamera next = camera;
      Numbers then = now;
      double left = HUGE_VAL;
      for (int attempt = 0; attempt < 14 && !(left < cost); ++attempt) {  // the damping grows where a step fails
        std::vector<Numbers> damped = *rows;
        for (std::size_t a = 0; a < by_.size(); ++a) damped[a][a] += damping * std::max(damped[a][a], 1e-300);
        if (const auto values = solved(std::move(damped))) {
          next = changed(camera, *values);
          then = misses(next);
          left = costOf(then, weight);
        }
        if (!(left < cost)) damping = std::max(damping, 1e-9) * 10;
      }
      if (!(left < cost)) break;
      camera = next;
      now = then;
      damping /= 10;
      if (wrong_ == 0 && step > 0 && (cost - left < 1e-10 * cost || left < 1e-18 * n)) break;
    }
    return {camera, costOf(now, wrong_ == 0 ? Numbers(fit_.pairs.size(), 1) : weight)};
  }

 private:
  PlainCamera changed(const PlainCamera& camera, const Numbers& values) const {
    return moved(fit_, size_, camera, by_, values);
  }
  /// x and y of each pair, NaN without a pixel.
  Numbers misses(const PlainCamera& camera) const {
    Numbers all;
    for (const Pair& pair : fit_.pairs) {
      const Vec2 miss = pixelOf(camera, pair.point) - pair.pixel;
      all.insert(all.end(), {miss.x, miss.y});
    }
    return all;
  }

  /// Of each pair: 0 without a pixel, else 1; or less, if pairs may be wrong, the more it misses beside the others.
  Numbers weights(const Numbers& misses, int step) const {
    Numbers distances, weights;
    for (std::size_t i = 0; i < misses.size(); i += 2) {
      const double distance = length(Vec2{misses[i], misses[i + 1]});
      weights.push_back(std::isfinite(distance) ? 1 : 0);
      distances.push_back(std::isfinite(distance) ? distance : 1e9);
    }
    if (wrong_ == 0) return weights;
    Numbers sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    const double sigma = std::max({std::ldexp(sorted[sorted.size() - wrong_ - 1], -step), medianOf(sorted), 1e-4});
    for (std::size_t i = 0; i < distances.size(); ++i)
      weights[i] /= std::pow(1 + distances[i] * distances[i] / (sigma * sigma), 2);
    return weights;
  }

  static double costOf(const Numbers& misses, const Numbers& weights) {
    double cost = 0;
    for (std::size_t i = 0; i < misses.size(); ++i)
      if (weights[i / 2] > 0) cost += weights[i / 2] * misses[i] * misses[i];
    return std::isfinite(cost) ? cost : HUGE_VAL;
  }

  std::optional<std::vector<Numbers>> equations(const PlainCamera& camera, const Numbers& now,
                                                const Numbers& weights) const {
    constexpr double kStep = 1e-6;
    const std::size_t count = by_.size();
    std::vector<Numbers> columns, rows(count, Numbers(count + 1));  // what each parameter changes, and what is to be
    for (std::size_t j = 0; j <= count; ++j) {
      Numbers values(count), column(now.size());
      if (j < count) {
        values[j] = kStep;
        column = misses(changed(camera, values));
      }
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double weight = weights[i / 2];
        column[i] = weight > 0 ? std::sqrt(weight) * (column[i] - now[i]) / (j < count ? kStep : 1) : 0;
        if (!std::isfinite(column[i])) return std::nullopt;
      }
      columns.push_back(std::move(column));
    }
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b <= count; ++b)
        rows[a][b] = std::inner_product(columns[a].begin(), columns[a].end(), columns[b].begin(), 0.0);
    return rows;
  }

  const Fit& fit_;
  double size_;
  const std::vector<By>& by_;
  std::size_t wrong_;
};

/// The camera turned by quarters about an axis of its own, or about any: so many whose rays agree best with the points.
std::vector<PlainCamera> startsOf(const Fit& fit, const std::optional<Vec3>& axis, std::size_t count) {
  std::vector<std::pair<double, Rows>> turns;  // with how badly they agree
  for (int quarter = 0; axis && quarter < 4; ++quarter)
    turns.emplace_back(0, turn(scaled(*axis, quarter * std::numbers::pi / 2)));
  if (!axis)
    for (const auto& [name, rows] : signedAxes())
      if (determinant(rows) > 0) turns.emplace_back(0, rows);
  for (const Pair& pair : fit.pairs) {
    const Vec3 ray = rayOf(fit.camera, pair.pixel), way = unit(fit.camera.axes * wayTo(fit.camera, pair.point));
    for (auto& [agreement, rows] : turns) agreement -= dot(rows * way, ray);
  }
  std::stable_sort(turns.begin(), turns.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PlainCamera> starts;
  for (std::size_t i = 0; i < count; ++i) {
    starts.push_back(fit.camera);
    starts.back().axes = turns[i].second * fit.camera.axes;
  }
  return starts;
}

std::vector<PlainCamera> startsOf(const Fit& fit, const std::vector<By>& by) {
  if (fit.camera.isOrthographic || !isBetween(by[0], By::h, By::rz)) return {fit.camera};
  if (by[0] == By::rx) return startsOf(fit, std::nullopt, by.size() < 6 ? 3 : 6);
  return startsOf(fit, axisOf(fit, fit.camera, by[0]), 2);
}

/// Whether it can be of these pairs.
bool applies(const Fit& fit, const std::vector<By>& by) {
  const bool hasOtherLens = fit.camera.lens && !fit.camera.lens->isBrown();
  if (by[0] >= By::k1 && (fit.camera.isOrthographic || hasOtherLens)) return false;
  if (by[0] == By::u && (fit.isOnEarth || !(length(fit.camera.eye) > 0))) return false;
  return 2 * fit.pairs.size() >= by.size() + 1;
}

Json valueOf(const Family& family, const Fit& fit, const PlainCamera& to) {
  const PlainCamera& from = fit.camera;
  const Rows turned = to.axes * transposed(from.axes);
  const Vec3 way = fit.world * sum(to.eye, -1, from.eye);
  double degrees = angleOf(turned) * 180 / std::numbers::pi;
  // The camera turns against its points; heading is clockwise, against up.
  const bool isAlong = dot(skewOf(turned), axisOf(fit, to, family.by[0])) >= 0;
  if (isBetween(family.by[0], By::h, By::r) && isAlong != (family.by[0] == By::h)) degrees = -degrees;
  const PlainLens lens = to.lens.value_or(PlainLens{});  // no step has made one: its numbers are 0
  const std::pair<char, double> numbers[] = {{'f', to.focal.x / from.focal.x},
                                             {'g', to.focal.y / from.focal.y},
                                             {'x', to.centre.x - from.centre.x},
                                             {'y', to.centre.y - from.centre.y},
                                             {'a', to.centre.x - to.focal.x / from.focal.x * from.centre.x},
                                             {'b', to.centre.y - to.focal.y / from.focal.y * from.centre.y},
                                             {'d', degrees},
                                             {'X', way.x},
                                             {'Y', way.y},
                                             {'Z', way.z},
                                             {'U', dot(sum(to.eye, -1, from.eye), fit.up)},
                                             {'u', dot(to.eye, from.eye) / dot(from.eye, from.eye)},
                                             {'k', lens.k[0]},
                                             {'l', lens.k[1]},
                                             {'p', lens.p[0]},
                                             {'q', lens.p[1]}};
  Json value = Json::array();
  for (const char letter : family.value)
    value.push_back(std::find_if(std::begin(numbers), std::end(numbers), [&](const auto& each) {
                      return each.first == letter;
                    })->second);
  return value.size() == 1 && family.value != "k" ? value[0] : value;
}

}  // namespace

std::size_t countOf(Table table) { return familiesOf(table).size(); }

std::vector<Hypothesis> families(const Fit& fit, Table table, std::size_t wrong) {
  Numbers distances;
  for (const Pair& pair : fit.pairs) distances.push_back(length(wayTo(fit.camera, pair.point)));
  const double size = medianOf(distances);
  const Vec2 focal = fit.camera.focal;
  std::vector<Hypothesis> all;
  for (const Family& family : familiesOf(table)) {
    const std::vector<By>& by = family.by;
    if (!applies(fit, by)) continue;
    const Solver solver(fit, size, by, wrong);
    Solution best;
    for (const PlainCamera& start : startsOf(fit, by)) {
      const Solution one = solver.from(start, by.size() >= 6 ? 40 : wrong > 0 ? 16 : 12);
      const bool isMirrored = !(one.camera.focal.x * focal.x > 0 && one.camera.focal.y * focal.y > 0);
      if (!isMirrored && one.cost < best.cost) best = one;  // a mirrored twin costs the same
      if (best.cost < 1e-12 * static_cast<double>(fit.pairs.size())) break;
    }
    if (!std::isfinite(best.cost)) continue;
    Hypothesis found{.mistake = family.mistake,
                     .value = valueOf(family, fit, best.camera),
                     .camera = best.camera,
                     .parameters = static_cast<int>(by.size())};
    found.isResized = isBetween(by[0], By::s, By::sy);
    if (found.isResized || (by.size() > 2 && by.back() == By::cy))
      found.scale = best.camera.focal.x * best.camera.focal.y / (focal.x * focal.y);
    if (by[0] == By::u) found.value = {"position", found.value};
    all.push_back(std::move(found));
  }
  return all;
}

}  // namespace viewproj::cmd::mistakes
