#include "input/readings/matrix_parts.hpp"

#include <cmath>
#include <limits>

#include "numbers/ulp.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Entries = std::array<std::array<DoubleDouble, 4>, 4>;

Entries entriesOf(const Mat4& m) noexcept {
  Entries e;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) e[i][j] = m[i][j];
  return e;
}

DDVec3 axisPart(const std::array<DoubleDouble, 4>& row) noexcept { return {row[0], row[1], row[2]}; }

DoubleDouble length(const DDVec3& a) noexcept {
  const int k = exponentToUnit(a);
  const DDVec3 scaled = scaleByPowerOfTwo(a, k);
  return scaleByPowerOfTwo(sqrt(dot(scaled, scaled)), -k);
}

DDVec3 divided(const DDVec3& a, DoubleDouble by) noexcept {
  return {quotient(a.x, by), quotient(a.y, by), quotient(a.z, by)};
}

/// The point whose distances along the three vectors are these.
DDVec3 pointAt(const DDVec3& right, const DDVec3& up, const DDVec3& forward, const DDVec3& distances) noexcept {
  const DDVec3 a = cross(up, forward), b = cross(forward, right), c = cross(right, up);
  const DDVec3 sum = a * distances.x + b * distances.y + c * distances.z;
  return divided(sum, dot(right, a));
}

/// What the uncertainty is told of, in this order: scaleX, offsetX, scaleY, offsetY, depthOffset, depthScale, eye;
/// then the axes and the residual.
constexpr std::size_t kNumbers = 19, kResidual = 18;

struct Solved {
  std::array<DoubleDouble, kNumbers> numbers;
  DDVec3 right, ndcUp, forward;
  double scale = 1, residual = 0;

  void addAxes() noexcept {
    const DDVec3* const axes[] = {&right, &ndcUp, &forward};
    for (std::size_t k = 0; k < 9; ++k) numbers[9 + k] = (*axes[k / 3])[k % 3];
    numbers[kResidual] = residual;
  }
};

/// | scaleX right + offsetX forward       ... |
/// | scaleY ndcUp + offsetY forward       ... |
/// | depthOffset forward   depthOffset along + depthScale |
/// | forward               along              |
std::optional<Solved> solvePerspective(const Entries& m) noexcept {
  const DDVec3 w = axisPart(m[3]);
  if (maxAbs(w) == 0) return std::nullopt;
  const DoubleDouble scale = length(w);
  std::array<DDVec3, 3> rows;
  std::array<DoubleDouble, 4> last;
  for (std::size_t i = 0; i < 4; ++i) {
    last[i] = quotient(m[i][3], scale);
    if (i < 3) rows[i] = divided(axisPart(m[i]), scale);
  }
  Solved s;
  s.scale = scale.hi;
  s.forward = divided(w, scale);
  const auto across = [&](const DDVec3& row, DoubleDouble offset) { return row + s.forward * -offset; };
  const DoubleDouble offsetX = dot(rows[0], s.forward), offsetY = dot(rows[1], s.forward);
  const DoubleDouble depthOffset = dot(rows[2], s.forward);
  const DDVec3 x = across(rows[0], offsetX), y = across(rows[1], offsetY), z = across(rows[2], depthOffset);
  if (maxAbs(x) == 0 || maxAbs(y) == 0) return std::nullopt;
  const DoubleDouble scaleX = length(x), scaleY = length(y);
  s.right = divided(x, scaleX);
  s.ndcUp = divided(y, scaleY);
  // Distances of the world's origin.
  const DDVec3 along{quotient(last[0] - offsetX * last[3], scaleX), quotient(last[1] - offsetY * last[3], scaleY),
                     last[3]};
  const DDVec3 eye = pointAt(s.right, s.ndcUp, s.forward, -along);
  s.numbers = {scaleX, offsetX, scaleY, offsetY, depthOffset, last[2] - depthOffset * last[3], eye.x, eye.y, eye.z};
  s.residual = std::max(std::fabs(dot(s.right, s.ndcUp).hi), maxAbs(z) / std::max(1.0, maxAbs(rows[2])));
  s.addAxes();
  return s;
}

/// | scaleX right         offsetX     |
/// | scaleY ndcUp         offsetY     |
/// | depthScale forward   depthOffset |
/// | 0                    1           |
std::optional<Solved> solveOrthographic(const Entries& m) noexcept {
  Solved s;
  const DoubleDouble scale = m[3][3];
  s.scale = scale.hi;
  std::array<DoubleDouble, 3> scales;
  DDVec3* const axes[] = {&s.right, &s.ndcUp, &s.forward};
  for (std::size_t i = 0; i < 3; ++i) {
    const DDVec3 row = axisPart(m[i]);
    if (maxAbs(row) == 0) return std::nullopt;
    scales[i] = length(row);
    *axes[i] = divided(row, scales[i]);
    scales[i] = quotient(scales[i], scale);
  }
  const auto offset = [&](std::size_t i) { return quotient(m[i][3], scale); };
  s.numbers = {scales[0], offset(0), scales[1], offset(1), offset(2), scales[2], 0, 0, 0};
  s.residual = std::max({std::fabs(dot(s.right, s.ndcUp).hi), std::fabs(dot(s.ndcUp, s.forward).hi),
                         std::fabs(dot(s.forward, s.right).hi)});
  s.addAxes();
  return s;
}

/// The eye alone.
std::optional<Solved> solveView(const Entries& m) noexcept {
  Solved s;
  const DDVec3 eye = pointAt(axisPart(m[0]), axisPart(m[1]), axisPart(m[2]), {-m[0][3], -m[1][3], -m[2][3]});
  s.numbers[6] = eye.x;
  s.numbers[7] = eye.y;
  s.numbers[8] = eye.z;
  return s;
}

using Solve = std::optional<Solved> (*)(const Entries&) noexcept;

/// How far each of the numbers moves when each entry moves to the ends of its interval.
std::array<Uncertain, kNumbers> withErrors(const Mat4& matrix, const EntryErrors& errors, const Solved& solved,
                                           Solve solve) noexcept {
  std::array<Uncertain, kNumbers> result;
  for (std::size_t k = 0; k < kNumbers; ++k) result[k].value = solved.numbers[k];
  Entries entries = entriesOf(matrix);
  const auto& w = matrix[3];
  const bool wIsExact = w[0] == 0 && w[1] == 0 && std::fabs(w[2]) + std::fabs(w[3]) == 1 && w[2] * w[3] == 0;
  for (std::size_t i = 0; i < (wIsExact ? 3 : 4); ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      DoubleDouble& entry = entries[i][j];
      const DoubleDouble kept = entry;
      const HalfSteps steps = halfSteps(kept.hi, errors.precision, errors.within[i][j]);
      std::array<double, kNumbers> most{};
      for (double step : {-steps.down, steps.up}) {
        entry = kept + DoubleDouble(step);
        const auto moved = solve(entries);
        for (std::size_t k = 0; k < kNumbers; ++k) {
          const double change = moved ? std::fabs((moved->numbers[k] - solved.numbers[k]).hi) : kInfinity;
          if (!(change <= most[k])) most[k] = change;
        }
      }
      entry = kept;
      for (std::size_t k = 0; k < kNumbers; ++k) result[k].error += most[k];
    }
  return result;
}

ClipParts parts(const Mat4& matrix, const EntryErrors& errors, const Solved& s, Solve solve,
                bool orthographic) noexcept {
  const std::array<Uncertain, kNumbers> n = withErrors(matrix, errors, s, solve);
  ClipParts p{orthographic, s.scale,    n[0],
              n[1],         n[2],       n[3],
              n[4],         n[5],       s.right,
              s.ndcUp,      s.forward,  {n[6], n[7], n[8]},
              {},           s.residual, n[kResidual].error};
  for (std::size_t k = 0; k < 9; ++k)
    if (n[9 + k].error > kCancellation) p.axisErrors[k / 3] = std::max(p.axisErrors[k / 3], n[9 + k].error);
  return p;
}

}  // namespace

std::optional<ClipParts> perspectiveParts(const Mat4& matrix, const EntryErrors& errors) noexcept {
  const auto solved = solvePerspective(entriesOf(matrix));
  if (!solved) return std::nullopt;
  return parts(matrix, errors, *solved, solvePerspective, false);
}

std::optional<ClipParts> orthographicParts(const Mat4& matrix, const EntryErrors& errors) noexcept {
  const auto solved = solveOrthographic(entriesOf(matrix));
  if (!solved) return std::nullopt;
  return parts(matrix, errors, *solved, solveOrthographic, true);
}

std::array<Uncertain, 3> eyeOfView(const Mat4& matrix, const EntryErrors& errors) noexcept {
  const auto solved = solveView(entriesOf(matrix));
  const auto n = withErrors(matrix, errors, *solved, solveView);
  return {n[6], n[7], n[8]};
}

HalfSteps halfSteps(double value, EntryPrecision precision, double within) noexcept {
  // The structure's zeros and ones are exact: half a step of 0 underflows.
  double below = 0, above = 0;
  if (precision == EntryPrecision::float32) {
    const auto narrow = static_cast<float>(value);
    constexpr float kFar = std::numeric_limits<float>::infinity();
    below = static_cast<double>(std::nextafter(narrow, -kFar));
    above = static_cast<double>(std::nextafter(narrow, kFar));
  } else {
    below = std::nextafter(value, -kInfinity);
    above = std::nextafter(value, kInfinity);
  }
  if (value == 0) return {within, within};
  const bool atTheEnd = !std::isfinite(above) || !std::isfinite(below);
  const double down = atTheEnd ? halfUlp(value) : (value - below) / 2, up = atTheEnd ? down : (above - value) / 2;
  return {std::max(down, within), std::max(up, within)};
}

DoubleDouble quotient(DoubleDouble a, DoubleDouble b) noexcept {
  if (a.hi == 0 || b.hi == 0 || !std::isfinite(a.hi) || !std::isfinite(b.hi)) return a.hi / b.hi;
  const int ka = std::ilogb(a.hi), kb = std::ilogb(b.hi);
  return scaleByPowerOfTwo(scaleByPowerOfTwo(a, -ka) / scaleByPowerOfTwo(b, -kb), ka - kb);
}

Interval quotient(Interval a, Interval b) noexcept {
  const bool reachesZero = !(b.low.hi > 0);
  const auto end = [&](DoubleDouble of, bool outwards) -> DoubleDouble {
    if (!outwards) return quotient(of, b.high);
    return reachesZero ? DoubleDouble(of.hi < 0 ? -kInfinity : of.hi > 0 ? kInfinity : 0) : quotient(of, b.low);
  };
  return {end(a.low, a.low.hi < 0), end(a.high, a.high.hi > 0)};
}

Estimate estimate(DoubleDouble value, Interval in) noexcept {
  return {value.hi + 0.0, lowerDouble(in.low) + 0.0, upperDouble(in.high) + 0.0};
}

}  // namespace viewproj::cmd
