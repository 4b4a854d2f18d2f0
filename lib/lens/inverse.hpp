// The direction that a lens puts on a point of its plane, with a certificate: many at a time, or one.
//
// The sphere map's inverse is a closed form, computed in double-double. Brown's polynomials and the angle map are
// inverted by Newton's steps in double, and one step from a residual in double-double. Newton-Kantorovich: where the
// least slope is `least` or more, the curvature kGentle or less and that step s short, |s| kGentle / least < 1/2, there
// is a solution within 2 |s|. After the step it is within |s|^2 kGentle / least. In the disc where the map is
// one-to-one it is the only one.
//
// A lane's result does not depend on the other lanes, and no multiplication is fused with an addition: every kernel has
// the same bits. Everything here has internal linkage.
#pragma once

#include "lens/map.hpp"
#include "numbers/fine_lanes.hpp"

namespace viewproj::detail {
namespace {

inline constexpr double kLeastSlope = 0x1p-10, kLongestStep = 0x1p-40;

/// A direction that is farther from the true one is not certified: a ray is proven to kRayDirectionBound.
inline constexpr double kWorstSightError = 0x1p-56;

/// After a step, with the roundings of the slopes and of the residual.
template <class D>
[[gnu::always_inline]] inline D errorAfter(D step) noexcept {
  return step * (step * (kGentle / kLeastSlope) + 0x1p-20) + 0x1p-70;
}

/// at: of unit length. growth: of an error of the plane, up to an angle in radians. least: of the numbers that must not
/// be near 0.
template <class Number, class D>
struct SphereSight {
  Sight<Number> at;
  D growth, least;
};

/// From the plane before Brown's polynomials.
template <class Number>
[[gnu::always_inline]] inline auto sphereSight(const LensParts& lens, const PlanePoint<Number>& m) noexcept {
  using D = decltype(high(m.x));
  const Number one = 1.0, square = m.x * m.x + m.y * m.y;
  Sight<Number> v{m.x, m.y, one};
  D growth = D{} + 1.0, least = D{} + 1.0;
  const auto keepLeast = [&](D value) { least = value < least ? value : least; };
  if (lens.alpha != 0) {
    const Number u = lens.beta == 1 ? square : Number(lens.beta) * square, alpha = lens.alpha, rest = lens.oneLessAlpha;
    const Number under = one - Number(DoubleDouble(twoSum(2 * lens.alpha, -1.0))) * u, root = sqrt(under);
    const Number restU = rest * u, forward = (root - alpha * restU) / (one + rest * restU);
    const Number divisor = alpha + rest * forward;
    v = {m.x * divisor, m.y * divisor, forward};
    keepLeast(high(under));
    keepLeast(high(divisor));
    growth = (high(divisor) / high(root) + high(divisor)) * (lens.beta > 1 ? lens.beta : 1);
  }
  if (lens.alpha == 0 || lens.beta != 1) {
    const Number length = sqrt(v.right * v.right + v.down * v.down + v.forward * v.forward), by = one / length;
    v = {v.right * by, v.down * by, v.forward * by};
  }
  if (lens.xi != 0) {
    const Number xi = lens.xi, aside = v.right * v.right + v.down * v.down;
    const Number under = one - Number(DoubleDouble(twoProd(lens.xi, lens.xi))) * aside, root = sqrt(under);
    const Number q = xi * v.forward + root;
    v = {q * v.right, q * v.down, q * v.forward - xi};
    keepLeast(high(under));
    keepLeast(high(q));
    growth = growth * high(q) * (1.0 + 1.0 / high(root));
  }
  return SphereSight<Number, D>{v, growth, least};
}

/// Undoes a lens in lanes.
template <class L>
class LensInverse {
 public:
  using D = typename L::D;
  using M = typename L::M;
  using Number = Fine<L>;

  explicit LensInverse(const LensParts& lens) : lens_(lens) {}

  /// isSettled: at is within error of the true direction and of unit length; or hasNone, and no direction is put there.
  struct Result {
    Sight<Number> at;
    D error;
    M isSettled, hasNone;
  };

  /// Of a target before `scale`.
  [[gnu::always_inline]] Result operator()(const PlanePoint<Number>& target) const {
    const D size = L::squareRoot(target.x.hi * target.x.hi + target.y.hi * target.y.hi);
    const M isOutside = size > lens_.edge * (1 + 0x1p-40);
    Result r = lens_.isAngle ? fromAngle(target, isOutside) : fromSphere(target, size, isOutside);
    const Sight<Number>& v = r.at;
    const D aside = L::squareRoot(v.right.hi * v.right.hi + v.down.hi * v.down.hi);
    const D side = v.forward.hi * lens_.limitSine.hi - aside * lens_.limitCosine.hi;
    const D inFront = lens_.limitCosine.hi <= 0 ? v.forward.hi : L::splat(-1);
    const M isCertified = all(r.isSettled, r.error <= kWorstSightError);
    r.hasNone = either(r.hasNone, either(isOutside, all(isCertified, side < -kMargin, inFront <= 0.0)));
    r.isSettled = either(r.hasNone, all(isCertified, either(side > kMargin, inFront > 0.0)));
    return r;
  }

 private:
  static constexpr double kMargin = 0x1p-40, kFarFromZero = 0x1p-20;
  static constexpr int kSteps = 10;
  /// Newton's steps end with one whose square is this share.
  static constexpr double kShortStep = 0x1p-56;

  static bool any(M m) { return L::bits(m) != 0; }

  struct Unbent {
    PlanePoint<Number> at;
    D error;
    M isUnique, isPastSphere;
  };

  using Slope = Dual<D>;
  struct Step {
    D x, y, xx, xy, yy;

    /// J^-1 (F - target); J is symmetric.
    Step(const PlanePoint<Slope>& f, D missX, D missY) : xx(f.x.x), xy(f.x.y), yy(f.y.y) {
      const D inverse = 1.0 / (xx * yy - xy * xy);
      x = (yy * missX - xy * missY) * inverse;
      y = (xx * missY - xy * missX) * inverse;
    }
    D leastSlope() const {
      const D half = 0.5 * (xx - yy);
      return 0.5 * (xx + yy) - L::squareRoot(half * half + xy * xy);
    }
  };

  [[gnu::always_inline]] PlanePoint<Slope> slopesAt(D x, D y) const {
    const D one = L::splat(1);
    return brownOf<Slope>(lens_, {{x, one, D{}}, {y, D{}, one}});
  }

  /// Undoes Brown's polynomials.
  [[gnu::always_inline]] Unbent unbent(const PlanePoint<Number>& target, M isOutside) const {
    D x = target.x.hi, y = target.y.hi;
    D moving = isOutside ? D{} : L::splat(1);
    for (int i = 0; i < kSteps; ++i) {
      const PlanePoint<Slope> f = slopesAt(x, y);
      const Step s(f, f.x.value - target.x.hi, f.y.value - target.y.hi);
      x = moving > 0.0 ? x - s.x : x;
      y = moving > 0.0 ? y - s.y : y;
      moving = s.x * s.x + s.y * s.y > kShortStep * (x * x + y * y) ? moving : D{};
      if (!any(moving > 0.0)) break;
    }
    const PlanePoint<Number> f = brownOf<Number>(lens_, {x, y});
    const Step s(slopesAt(x, y), (f.x - target.x).hi, (f.y - target.y).hi);
    const D length = L::absolute(s.x) + L::absolute(s.y), r = L::squareRoot(x * x + y * y), around = 2.0 * length;
    const double end = lens_.brownEnd < lens_.gentleEnd ? lens_.brownEnd : lens_.gentleEnd;
    const M isUnique = all(s.leastSlope() > kLeastSlope, length < kLongestStep, r + around < end * (1 - kMargin));
    return {{Number::twoSum(x, -s.x), Number::twoSum(y, -s.y)},
            errorAfter(length),
            all(isUnique, r + around < lens_.planeEnd * (1 - kMargin)),
            all(isUnique, r - around > lens_.planeEnd * (1 + kMargin))};
  }

  [[gnu::always_inline]] Result fromSphere(const PlanePoint<Number>& target, D size, M isOutside) const {
    const Unbent plane =
        lens_.isBrown ? unbent(target, isOutside) : Unbent{target, 0x1p-90 * (1.0 + size), size >= 0.0, size < 0.0};
    const auto [at, growth, least] = sphereSight<Number>(lens_, plane.at);
    return {at, growth * plane.error + 0x1p-70, all(plane.isUnique, least > kFarFromZero), plane.isPastSphere};
  }

  struct SineCosine {
    D sine, cosine;
  };
  /// Of 0 <= t <= pi, to a few units of 2^-53: fdlibm's polynomials.
  [[gnu::always_inline]] static SineCosine sineCosine(D t) {
    const D one = L::splat(1);
    const M isSecond = t > 0.78539816339744828, isThird = t > 2.3561944901923448;
    const D quarters = (isSecond ? one : D{}) + (isThird ? one : D{});
    const D z = (t - quarters * kQuarterTurn.hi) - quarters * kQuarterTurn.lo, w = z * z;
    D sine = L::splat(1.58969099521155010221e-10), cosine = L::splat(-1.13596475577881948265e-11);
    for (const double k : {-2.50507602534068634195e-08, 2.75573137070700676789e-06, -1.98412698298579493134e-04,
                           8.33333333332248946124e-03, -1.66666666666666324348e-01})
      sine = sine * w + k;
    for (const double k : {2.08757232129817482790e-09, -2.75573143513906633035e-07, 2.48015872894767294178e-05,
                           -1.38888888888741095749e-03, 4.16666666666666019037e-02, -0.5})
      cosine = cosine * w + k;
    sine = z + z * (w * sine);
    cosine = 1.0 + w * cosine;
    return {isThird ? -sine : isSecond ? cosine : sine, isThird ? -cosine : isSecond ? -sine : cosine};
  }

  /// rho and its slope.
  [[gnu::always_inline]] Slope putAt(D t) const {
    const Slope at(t, L::splat(1), D{});
    return at * series<Slope>(lens_.numerator(), at * at);
  }

  /// Newton in double; then the direction is put back in double-double, and turned by what it misses. That corrects the
  /// error of the sine and cosine too.
  [[gnu::always_inline]] Result fromAngle(const PlanePoint<Number>& target, M isOutside) const {
    const Number size = sqrt(target.x * target.x + target.y * target.y);
    const double end = lens_.angleEnd < lens_.gentleEnd ? lens_.angleEnd : lens_.gentleEnd;
    D t = size.hi < lens_.angleEnd ? size.hi : L::splat(lens_.angleEnd);
    if (lens_.numeratorTerms > 0) {
      D moving = isOutside ? D{} : L::splat(1);
      for (int i = 0; i < kSteps; ++i) {
        const Slope put = putAt(t);
        const D step = (put.value - size.hi) / put.x;
        t = moving > 0.0 ? t - step : t;
        moving = step * step > kShortStep * t * t ? moving : D{};
        if (!any(moving > 0.0)) break;
      }
    }
    const M isInRange = all(t >= 0.0, t <= kHalfTurn.hi);
    t = isInRange ? t : L::splat(1);
    auto [sine, cosine] = sineCosine(t);
    const double c = lens_.across.hi;
    if (lens_.model == LensModel::fov) {
      const D across = sine / c, inverse = 1.0 / L::squareRoot(across * across + cosine * cosine);
      sine = across * inverse;
      cosine = cosine * inverse;
    }
    const bool isAcross = lens_.model == LensModel::fov;
    const Number back = angleOf(isAcross ? Number(lens_.across) * Number(sine) : Number(sine), Number(cosine));
    const Number put = back * series(lens_.numerator(), Number(back * back));
    // dt/dtheta = c / (c^2 sin^2 + cos^2)
    const D slope = putAt(t).x * (c / (c * c * sine * sine + cosine * cosine));
    const D step = (size - put).hi / slope, length = L::absolute(step);
    // Its length is not quite 1: by the squares' sum.
    const Number across = Number::twoSum(sine, cosine * step), along = Number::twoSum(cosine, -(sine * step));
    const D excess = 0.5 * (across * across + along * along - Number(1.0)).hi;
    const Number unit = Number::twoSum(L::splat(1), -excess), by = across * unit / size;
    const M isUnique = all(isInRange, slope > kLeastSlope, length<kLongestStep, size.hi> 0x1p-400,
                           t + 2.0 * length * (c > 1 ? c : 1 / c) < end * (1 - kMargin));
    return {{target.x * by, target.y * by, along * unit}, errorAfter(length), isUnique, isOutside};
  }

  LensParts lens_;
};

}  // namespace
}  // namespace viewproj::detail
