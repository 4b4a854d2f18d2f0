#include <algorithm>
#include <optional>

#include "lens/response.hpp"

namespace viewproj::detail {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Undistorted kNone{{kNaN, kNaN}, kNaN};

/// An answer that could be farther from the true one is none: a ray is proven to kRayDirectionBound.
constexpr double kWorstError = 0x1p-56;

/// Nearer to the axis than this, every lens leaves all digits as they are.
constexpr double kTiny = 0x1p-450;

double length(double x, double y) noexcept { return std::sqrt(x * x + y * y); }

/// The root of a function that rises over [low, high] and is below 0 at low and not at high. evaluate: its value and
/// slope there.
template <class Evaluate>
double risingRoot(double low, double high, double start, const Evaluate& evaluate) noexcept {
  double at = start;
  for (int i = 0; i < 100; ++i) {
    const auto [value, slope] = evaluate(at);
    (value < 0 ? low : high) = at;
    double next = at - value / slope;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (!(next > low && next < high) || std::fabs(next - at) <= 0x1p-51 * at) return next;
    at = next;
  }
  return at;
}

struct ValueAndSlope {
  double value, slope;
};

/// J of brown: symmetric.
struct Jacobian {
  double xx, xy, yy;

  Tangents<double> inverseTimes(double a, double b) const noexcept {
    const double determinant = xx * yy - xy * xy;
    return {(yy * a - xy * b) / determinant, (xx * b - xy * a) / determinant};
  }
};

/// g and dg/du.
ValueAndSlope radial(const LensParts& lens, double u) noexcept {
  const std::span<const double> n = lens.numerator(), d = lens.denominator();
  const double slope = n[0] + u * (2 * n[1] + u * 3 * n[2]);
  if (!lens.isRational) return {series(n, u), slope};
  const double by = series(d, u), g = series(n, u) / by;
  return {g, (slope - g * (d[0] + u * (2 * d[1] + u * 3 * d[2]))) / by};
}

Jacobian jacobian(const LensParts& lens, double x, double y) noexcept {
  const auto [g, slope] = radial(lens, x * x + y * y);
  const double p1 = lens.p[0], p2 = lens.p[1];
  return {g + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x, 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y,
          g + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x};
}

/// The distance from the axis that the radial part alone puts there; end where it puts none. NaN: none is near enough.
double radialStart(const LensParts& lens, double target) noexcept {
  const auto above = [&](double r) -> ValueAndSlope {
    const auto [g, slope] = radial(lens, r * r);
    return {r * g - target, g + 2 * r * r * slope};
  };
  double end = std::min(lens.end, 1.0);
  while (end < lens.end && above(end).value < 0) end = std::min(2 * end, lens.end);
  if (above(end).value < 0) return lens.cause == LimitCause::none ? kNaN : end;
  return risingRoot(0, end, std::min(end, target), above);
}

/// Newton's steps in double, then in double-double, from the radial part's solution.
std::optional<Tangents<DoubleDouble>> brownSolution(const LensParts& lens,
                                                    const Tangents<DoubleDouble>& target) noexcept {
  const double size = length(target.x.hi, target.y.hi), start = radialStart(lens, size);
  if (!(start >= 0)) return std::nullopt;
  const double inside = lens.end * (1 - 0x1p-40);
  Tangents<double> at{target.x.hi * (start / size), target.y.hi * (start / size)};
  const auto pullBack = [&] {
    const double r = length(at.x, at.y);
    if (r > inside) at = {at.x * (inside / r), at.y * (inside / r)};
    return r;
  };
  pullBack();
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 30; ++i) {
    const Tangents<double> f = distort<double>(lens, at);
    const auto step = jacobian(lens, at.x, at.y).inverseTimes(f.x - target.x.hi, f.y - target.y.hi);
    at = {at.x - step.x, at.y - step.y};
    const double r = pullBack(), moved = length(step.x, step.y);
    if (moved <= 0x1p-51 * r || (moved >= last && moved < 1e-12 * (1 + r))) break;
    last = moved;
  }
  Tangents<DoubleDouble> fine{at.x, at.y};
  for (int i = 0; i < 2; ++i) {
    const auto f = distort<DoubleDouble>(lens, fine);
    const auto step = jacobian(lens, at.x, at.y).inverseTimes((f.x - target.x).hi, (f.y - target.y).hi);
    fine = {fine.x - DoubleDouble(step.x), fine.y - DoubleDouble(step.y)};
  }
  return fine;
}

/// The map is strongly monotone: with a residual and the least factor m of differences in the ball around a point, of
/// radius d >= residual / m within the disc, the ball's image covers the target; and the disc has no second such point.
Undistorted undistortBrown(const LensParts& lens, const Tangents<DoubleDouble>& target) noexcept {
  const double size = length(target.x.hi, target.y.hi);
  if (!(size < lens.outerEdge)) return kNone;  // also a NaN
  if (size < kTiny) return {target, kFineUnit};
  const auto at = brownSolution(lens, target);
  if (!at) return kNone;
  const auto f = distort<DoubleDouble>(lens, *at);
  const double r = length(at->x.hi, at->y.hi);
  const Response here = responseOver(lens, {r, r});
  const double residual = 1.01 * length((f.x - target.x).hi, (f.y - target.y).hi) + 2 * here.rounding * kFineUnit;
  double least = here.least;
  for (int i = 0; i < 2; ++i) {
    const double d = 2 * residual / least;
    if (!(r * (1 + 0x1p-40) + d < lens.end)) return kNone;  // also a NaN
    const double reach = d + 0x1p-50 * r;
    const double m = responseOver(lens, {std::max(0.0, r - reach), r + reach}).least;
    if (residual <= m * d) {
      const double error = residual / m;
      return error <= kWorstError ? Undistorted{*at, error} : kNone;
    }
    least = m;
  }
  return kNone;
}

/// Of the angle alone: its slope in a range around a point in place of m.
Undistorted undistortFisheye(const LensParts& lens, const Tangents<DoubleDouble>& target) noexcept {
  const DoubleDouble square = target.x * target.x + target.y * target.y;
  const DoubleDouble size = sqrt(square);
  if (!(size.hi < lens.outerEdge * (1 - 0x1p-51))) return kNone;
  if (size.hi < kTiny) return {target, kFineUnit};
  const double end = std::min(lens.end, kQuarterTurn.hi);
  const auto put = [&](const auto& t) { return t * series(lens.angular(), t * t); };
  const auto slopeAt = [&](double t) { return slopeOver(lens, {t, t}).low; };
  const double root = risingRoot(0, end, std::min(size.hi, end), [&](double t) -> ValueAndSlope {
    return {put(t) - size.hi, slopeAt(t)};
  });
  DoubleDouble t = root;
  for (int i = 0; i < 2; ++i) t = t - DoubleDouble((put(t) - size).hi / slopeAt(root));
  const double residual =
      std::fabs((put(t) - size).hi) + kFineUnit * size.hi + kFineUnit * roughly(lens, t.hi).rounding;
  const double d = 2 * residual / slopeAt(t.hi), reach = d + 0x1p-50 * t.hi;
  const double m = slopeOver(lens, {std::max(0.0, t.hi - reach), t.hi + reach}).low;
  if (!(m > 0 && residual <= m * d && t.hi + reach < lens.end)) return kNone;
  const Direction direction = directionOf(t);
  const DoubleDouble factor = direction.across / (direction.along * size);
  const double error = residual / m + kFineUnit * 4;
  if (!(error <= kWorstError && direction.across.hi < direction.along.hi * kLargestTangent)) return kNone;
  return {{target.x * factor, target.y * factor}, error};
}

}  // namespace

Undistorted undistort(const LensParts& lens, const Tangents<DoubleDouble>& target) noexcept {
  return lens.model == LensModel::brown ? undistortBrown(lens, target) : undistortFisheye(lens, target);
}

}  // namespace viewproj::detail
