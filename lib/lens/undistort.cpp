// The direction of a point of the plane: what lens/inverse.hpp certifies, and what it leaves, by a slower way.
#include <algorithm>
#include <optional>

#include "lens/inverse.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::detail {
namespace {

constexpr Undistorted kNone{{kNaN, kNaN, kNaN}, kNaN};

/// Newton's steps double the digits, but next to a fold. They end with one of this share.
constexpr int kSteps = 100;
constexpr double kLastStep = 0x1p-80;

/// Nearer to the axis than this, every lens leaves all digits as they are.
constexpr double kTiny = 0x1p-450;

/// The root of a function that rises over [low, high] and is below 0 at low and not at high. evaluate: its value and
/// slope there.
template <class Evaluate>
double risingRoot(double low, double high, double start, const Evaluate& evaluate) noexcept {
  double at = start;
  for (int i = 0; i < kSteps; ++i) {
    const Dual<double> f = evaluate(at);
    (f.value < 0 ? low : high) = at;
    double next = at - f.value / f.x;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (!(next > low && next < high) || std::fabs(next - at) <= 0x1p-51 * at) return next;
    at = next;
  }
  return at;
}

/// The radius that the polynomials without p1 and p2 put there; the end where they put none. NaN: none is near enough.
double radialStart(const LensParts& lens, double target) noexcept {
  const auto above = [&](double radius) {
    const Dual<double> r(radius, 1, 0);
    return r * radialFactor(lens, r * r) + Dual<double>(-target);
  };
  const double last = lens.brownEnd;
  double end = std::min(last, 1.0);
  while (end < last && above(end).value < 0) end = std::min(2 * end, last);
  if (above(end).value < 0) return last < kLargestRadius ? end : kNaN;
  return risingRoot(0, end, std::min(end, target), above);
}

struct Unbent {
  PlanePoint<DoubleDouble> at;
  double error;
};

/// Undoes Brown's polynomials: Newton's steps from radialStart, slopes in double, what they miss in double-double.
std::optional<Unbent> unbent(const LensParts& lens, const PlanePoint<DoubleDouble>& target) noexcept {
  const double size = length(target.x.hi, target.y.hi), start = radialStart(lens, size);
  if (!(start >= 0)) return std::nullopt;
  const double inside = lens.brownEnd * (1 - 0x1p-40);
  const auto pulledBack = [&](const PlanePoint<DoubleDouble>& to) -> PlanePoint<DoubleDouble> {
    const double r = length(to.x.hi, to.y.hi), share = inside / r;
    return r > inside ? PlanePoint<DoubleDouble>{times(share, to.x), times(share, to.y)} : to;
  };
  const auto missed = [&](const PlanePoint<DoubleDouble>& to) -> PlanePoint<double> {
    const auto f = brownOf<DoubleDouble>(lens, to);
    return {(f.x - target.x).hi, (f.y - target.y).hi};
  };
  /// J^-1 times what is missed, and the least slope; J is symmetric.
  struct Step {
    PlanePoint<double> by;
    double leastSlope;
    double size() const noexcept { return length(by.x, by.y); }
  };
  const auto stepAt = [&](const PlanePoint<DoubleDouble>& to, const PlanePoint<double>& miss) -> Step {
    const auto f = brownOf<Dual<double>>(lens, {{to.x.hi, 1, 0}, {to.y.hi, 0, 1}});
    const double xx = f.x.x, xy = f.x.y, yy = f.y.y, determinant = xx * yy - xy * xy;
    return {{(yy * miss.x - xy * miss.y) / determinant, (xx * miss.y - xy * miss.x) / determinant},
            (xx + yy) / 2 - length((xx - yy) / 2, xy)};
  };
  PlanePoint<DoubleDouble> at = pulledBack({times(start / size, target.x), times(start / size, target.y)});
  PlanePoint<double> miss = missed(at);
  for (int i = 0; i < kSteps; ++i) {
    const PlanePoint<double> step = stepAt(at, miss).by;
    const auto after = [&, from = at](double share) {
      return pulledBack({from.x - DoubleDouble(share * step.x), from.y - DoubleDouble(share * step.y)});
    };
    if (length(step.x, step.y) <= kLastStep * length(at.x.hi, at.y.hi)) {
      at = after(1);
      miss = missed(at);
      break;
    }
    // The map is the gradient of a convex function: a step that is short enough leads nearer, until rounding ends it.
    const double before = length(miss.x, miss.y);
    double share = 1;
    do {
      at = after(share);
      miss = missed(at);
      share /= 2;
    } while (!(length(miss.x, miss.y) < before) && share > 0x1p-20);
  }
  // Newton-Kantorovich, as in inverse.hpp, with the curvature of this place.
  const Step last = stepAt(at, miss);
  const double r = length(at.x.hi, at.y.hi), near = 0x1p-40 * r, from = r - near, to = r + near;
  const double ofResidual = brownResponse(lens, from, to).rounding * kFineUnit / last.leastSlope;
  const double step = 1.01 * (last.size() + ofResidual), around = 2 * step;
  const bool isUnique = last.leastSlope > 0 && step * curvature(lens, from, to) <= last.leastSlope / 4 &&
                        around < near && r * (1 + 0x1p-45) + around < lens.brownEnd;
  return isUnique ? std::optional(Unbent{at, around}) : std::nullopt;
}

Undistorted fromSphere(const LensParts& lens, const PlanePoint<DoubleDouble>& target) noexcept {
  constexpr double kFarFromZero = 0x1p-56;
  Unbent plane{target, 0x1p-95 * (1 + length(target.x.hi, target.y.hi))};
  if (lens.isBrown && length(target.x.hi, target.y.hi) > kTiny) {
    const auto found = unbent(lens, target);
    if (!found) return kNone;
    plane = *found;
  }
  const auto [at, growth, least] = sphereSight<DoubleDouble>(lens, plane.at);
  if (!(least > kFarFromZero)) return kNone;  // also a NaN, beyond the fold
  return {at, growth * plane.error + 0x1p-60};
}

/// The root of the angle's polynomial, and its sine and cosine.
Undistorted fromAngle(const LensParts& lens, const PlanePoint<DoubleDouble>& target) noexcept {
  const DoubleDouble size = sqrt(target.x * target.x + target.y * target.y);
  if (size.hi < kTiny) return {{target.x / lens.across, target.y / lens.across, 1}, 0x1p-60};
  const auto put = [&](const auto& t) { return t * series(lens.numerator(), t * t); };
  const auto slopeAt = [&](double t) { return put(Dual<double>(t, 1, 0)); };
  const double root = risingRoot(0, lens.angleEnd, std::min(size.hi, lens.angleEnd),
                                 [&](double t) { return slopeAt(t) + Dual<double>(-size.hi); });
  DoubleDouble t = root;
  double step = 0;
  for (int i = 0; i < 6; ++i) {
    step = (put(t) - size).hi / slopeAt(t.hi).x;
    t = t - DoubleDouble(step);
    if (std::fabs(step) <= kLastStep * t.hi) break;
  }
  // Newton-Kantorovich; the curvature is below these sizes of the terms, over t.
  const double slope = slopeAt(t.hi).x, of = sizes(lens.numerator(), t.hi * t.hi, 1, 30);
  const double around = 2 * (std::fabs(step) + 4 * kAngleUnits * kFineUnit * t.hi * of / slope);
  if (!(slope > 0 && around * of * 72 <= slope * t.hi / 8 && t.hi * (1 + 0x1p-50) + around < lens.angleEnd))
    return kNone;
  const Direction along = directionOf(t);
  const DoubleDouble sine = along.across / lens.across,
                     by = DoubleDouble(1) / sqrt(sine * sine + along.along * along.along);
  const DoubleDouble across = sine * by / size;
  const double c = lens.across.hi;
  return {{target.x * across, target.y * across, along.along * by}, around * std::max(c, 1 / c) + 0x1p-60};
}

}  // namespace

Undistorted undistortSlowly(const LensParts& lens, const PlanePoint<DoubleDouble>& target) noexcept {
  if (!(length(target.x.hi, target.y.hi) <= lens.edge)) return kNone;  // also a NaN
  const Undistorted found = lens.isAngle ? fromAngle(lens, target) : fromSphere(lens, target);
  return found.error <= kWorstSightError && isSeen(lens, found.at).isSeen ? found : kNone;
}

Undistorted undistort(const LensParts& lens, const PlanePoint<DoubleDouble>& target) noexcept {
  using Number = Fine<ScalarLanes>;
  const auto [at, error, isSettled, hasNone] = LensInverse<ScalarLanes>(lens)({Number(target.x), Number(target.y)});
  if (hasNone) return kNone;
  if (!isSettled) return undistortSlowly(lens, target);
  const auto pair = [](const Number& a) { return DoubleDouble(a.hi, a.lo); };
  return {{pair(at.right), pair(at.down), pair(at.forward)}, error};
}

/// The second derivative of
///   x g(u):  2 g' (v (x.w) + w (x.v) + x (v.w)) + 4 g'' x (x.v) (x.w),  and of what p1 and p2 add
/// from the sizes of all terms.
double curvature(const LensParts& lens, double from, double to) noexcept {
  const double u = to * to, low = from * from;
  /// Sizes of a series, of its first and its second derivative in u.
  struct Sizes {
    double value = 1, first = 0, second = 0;
  };
  const auto sizesAt = [](std::span<const double> k, double at) {
    Sizes s;
    double power = 1;  // of at, by i
    for (std::size_t i = 0; i < k.size(); ++i, power *= at) {
      const double size = std::fabs(k[i]), n = double(i + 1);
      s.value += size * power * at;
      s.first += n * size * power;
      if (i > 0) s.second += n * (n - 1) * size * power / at;
    }
    return s;
  };
  const Sizes n = sizesAt(lens.numerator(), u), d = sizesAt(lens.denominator(), u);
  const double least = series(lens.denominator(), low) - (d.value - sizesAt(lens.denominator(), low).value);
  if (!(least > 0)) return kInfinity;
  const double g = n.value / least, g1 = (n.first + g * d.first) / least;
  const double g2 = (n.second + 2 * g1 * d.first + g * d.second) / least;
  return 1.01 * (6 * g1 * to + 4 * g2 * to * u + 6 * lens.tangential);
}

}  // namespace viewproj::detail
