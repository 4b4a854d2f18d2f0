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

struct Solved {
  DoubleDouble scaleX, offsetX, scaleY, offsetY, depthOffset, depthScale;
  DDVec3 right, ndcUp, forward, eye;
  double scale = 1, residual = 0;
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
  s.eye = pointAt(s.right, s.ndcUp, s.forward, -along);
  s.scaleX = scaleX;
  s.offsetX = offsetX;
  s.scaleY = scaleY;
  s.offsetY = offsetY;
  s.depthOffset = depthOffset;
  s.depthScale = last[2] - depthOffset * last[3];
  s.residual = std::max(std::fabs(dot(s.right, s.ndcUp).hi), maxAbs(z) / std::max(1.0, maxAbs(rows[2])));
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
  DoubleDouble* const scales[] = {&s.scaleX, &s.scaleY, &s.depthScale};
  DoubleDouble* const offsets[] = {&s.offsetX, &s.offsetY, &s.depthOffset};
  DDVec3* const axes[] = {&s.right, &s.ndcUp, &s.forward};
  for (std::size_t i = 0; i < 3; ++i) {
    const DDVec3 row = axisPart(m[i]);
    if (maxAbs(row) == 0) return std::nullopt;
    const DoubleDouble size = length(row);
    *axes[i] = divided(row, size);
    *scales[i] = quotient(size, scale);
    *offsets[i] = quotient(m[i][3], scale);
  }
  s.residual = std::max({std::fabs(dot(s.right, s.ndcUp).hi), std::fabs(dot(s.ndcUp, s.forward).hi),
                         std::fabs(dot(s.forward, s.right).hi)});
  return s;
}

using Solve = std::optional<Solved> (*)(const Entries&) noexcept;

/// The numbers whose errors count: the depth's two, the scales and the residual.
using Errors = std::array<double, 5>;

Errors changes(const Solved& a, const Solved& b) noexcept {
  return {std::fabs((a.depthOffset - b.depthOffset).hi), std::fabs((a.depthScale - b.depthScale).hi),
          std::fabs((a.scaleX - b.scaleX).hi), std::fabs((a.scaleY - b.scaleY).hi),
          std::fabs((DoubleDouble(a.residual) - DoubleDouble(b.residual)).hi)};
}

/// How far each of the numbers moves when each entry moves to the ends of its interval.
Errors errorsOf(const Mat4& matrix, const EntryErrors& errors, const Solved& solved, Solve solve) noexcept {
  Errors result{};
  Entries entries = entriesOf(matrix);
  const auto& w = matrix[3];
  const bool wIsExact = w[0] == 0 && w[1] == 0 && std::fabs(w[2]) + std::fabs(w[3]) == 1 && w[2] * w[3] == 0;
  for (std::size_t i = 0; i < (wIsExact ? 3 : 4); ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      DoubleDouble& entry = entries[i][j];
      const DoubleDouble kept = entry;
      const HalfSteps steps = halfSteps(kept.hi, errors.precision, errors.within[i][j]);
      Errors most{};
      for (double step : {-steps.down, steps.up}) {
        entry = kept + DoubleDouble(step);
        const auto moved = solve(entries);
        for (std::size_t k = 0; k < most.size(); ++k) {
          const double change = moved ? changes(*moved, solved)[k] : kInfinity;
          if (!(change <= most[k])) most[k] = change;
        }
      }
      entry = kept;
      for (std::size_t k = 0; k < most.size(); ++k) result[k] += most[k];
    }
  return result;
}

std::optional<ClipParts> partsOf(const Mat4& matrix, const EntryErrors& errors, Solve solve, bool orthographic) {
  const auto solved = solve(entriesOf(matrix));
  if (!solved) return std::nullopt;
  const Solved& s = *solved;
  const auto [ofOffset, ofDepth, ofX, ofY, ofResidual] = errorsOf(matrix, errors, s, solve);
  if (!orthographic && !(s.scaleX.hi > ofX && s.scaleY.hi > ofY)) return std::nullopt;
  return ClipParts{orthographic,
                   s.scale,
                   s.scaleX,
                   s.offsetX,
                   s.scaleY,
                   s.offsetY,
                   {s.depthOffset, ofOffset},
                   {s.depthScale, ofDepth},
                   s.right,
                   s.ndcUp,
                   s.forward,
                   s.eye,
                   s.residual,
                   ofResidual};
}

}  // namespace

std::optional<ClipParts> perspectiveParts(const Mat4& matrix, const EntryErrors& errors) noexcept {
  return partsOf(matrix, errors, solvePerspective, false);
}

std::optional<ClipParts> orthographicParts(const Mat4& matrix, const EntryErrors& errors) noexcept {
  return partsOf(matrix, errors, solveOrthographic, true);
}

DDVec3 eyeOfView(const Mat4& matrix) noexcept {
  const Entries m = entriesOf(matrix);
  return pointAt(axisPart(m[0]), axisPart(m[1]), axisPart(m[2]), {-m[0][3], -m[1][3], -m[2][3]});
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
