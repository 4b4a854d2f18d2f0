#include <algorithm>
#include <optional>

#include "lens/response.hpp"

namespace viewproj::detail {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Undistorted kNone{{kNaN, kNaN}, kNaN};

/// An answer that could be farther from the true one is none: a ray is proven to kRayDirectionBound.
constexpr double kWorstError = 0x1p-56;

/// Newton's steps double the digits, but next to a fold. They end with one of this share.
constexpr int kSteps = 100;
constexpr double kSettled = 0x1p-80;

/// Nearer to the axis than this, every lens leaves all digits as they are.
constexpr double kTiny = 0x1p-450;

double length(double x, double y) noexcept { return std::sqrt(x * x + y * y); }

/// The root of a function that rises over [low, high] and is below 0 at low and not at high. evaluate: its value and
/// slope there.
template <class Evaluate>
double risingRoot(double low, double high, double start, const Evaluate& evaluate) noexcept {
  double at = start;
  for (int i = 0; i < kSteps; ++i) {
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
  const auto slope = [&](const double* k) { return k[0] + u * (2 * k[1] + u * 3 * k[2]); };
  const double g = series(lens.numerator(), u), by = series(lens.denominator(), u);
  return {g / by, (slope(lens.k.data()) - g / by * slope(lens.k.data() + 3)) / by};
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

/// Newton's steps from the radial part's solution: slopes in double, what they miss in double-double.
std::optional<Tangents<DoubleDouble>> brownSolution(const LensParts& lens,
                                                    const Tangents<DoubleDouble>& target) noexcept {
  const double size = length(target.x.hi, target.y.hi), start = radialStart(lens, size);
  if (!(start >= 0)) return std::nullopt;
  const double inside = lens.end * (1 - 0x1p-40);
  const auto pulledBack = [&](const Tangents<DoubleDouble>& to) -> Tangents<DoubleDouble> {
    const double r = length(to.x.hi, to.y.hi), share = inside / r;
    return r > inside ? Tangents<DoubleDouble>{times(share, to.x), times(share, to.y)} : to;
  };
  const auto missed = [&](const Tangents<DoubleDouble>& to) -> Tangents<double> {
    const auto f = distort<DoubleDouble>(lens, to);
    return {(f.x - target.x).hi, (f.y - target.y).hi};
  };
  Tangents<DoubleDouble> at = pulledBack({times(start / size, target.x), times(start / size, target.y)});
  Tangents<double> miss = missed(at);
  for (int i = 0; i < kSteps; ++i) {
    const auto step = jacobian(lens, at.x.hi, at.y.hi).inverseTimes(miss.x, miss.y);
    const auto after = [&, from = at](double share) {
      return pulledBack({from.x - DoubleDouble(share * step.x), from.y - DoubleDouble(share * step.y)});
    };
    if (length(step.x, step.y) <= kSettled * length(at.x.hi, at.y.hi)) return after(1);
    // The map is the gradient of a convex function: a step that is short enough leads nearer, until rounding ends it.
    const double before = length(miss.x, miss.y);
    double share = 1;
    do {
      at = after(share);
      miss = missed(at);
      share /= 2;
    } while (!(length(miss.x, miss.y) < before) && share > 0x1p-20);
  }
  return at;
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
  const auto put = [&](const auto& t) { return t * series(lens.numerator(), t * t); };
  const auto slopeAt = [&](double t) {
    const double w = t * t, *const k = lens.k.data();
    return 1 + w * (3 * k[0] + w * (5 * k[1] + w * (7 * k[2] + w * 9 * k[3])));
  };
  const double root = risingRoot(0, end, std::min(size.hi, end), [&](double t) -> ValueAndSlope {
    return {put(t) - size.hi, slopeAt(t)};
  });
  DoubleDouble t = root;
  for (int i = 0; i < 6; ++i) {
    const double step = (put(t) - size).hi / slopeAt(t.hi);
    t = t - DoubleDouble(step);
    if (std::fabs(step) <= kSettled * t.hi) break;
  }
  const double residual =
      std::fabs((put(t) - size).hi) + kFineUnit * size.hi + kFineUnit * roughly(lens, t.hi, 0.0).rounding;
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
