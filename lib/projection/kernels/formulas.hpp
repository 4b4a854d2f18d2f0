// The arithmetic of one point in each precision, written once for a double and for a vector of lanes.
//
// standard uses single IEEE operations in a fixed order, so a lane has the same bits as a double on every instruction
// set. exact may use fused multiply-add: its results are certified to be the doubles nearest the true values, so the
// last bits before rounding do not matter. Everything here has internal linkage: each kernel is compiled for its own
// processor, and the linker must not use one kernel's code in another.
#pragma once

#include <cmath>

#include "lens/inverse.hpp"
#include "projection/kernels/error_model.hpp"
#include "projection/kernels/kernels.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {
namespace {

/// The parts of a formula that a camera needs, and whether the distance is needed too (exact then certifies it).
template <bool IsOrthographic, bool HasResidual, bool WantsDistance = false, bool HasLens = false>
struct Traits {
  static constexpr bool orthographic = IsOrthographic, residual = HasResidual, distance = WantsDistance, lens = HasLens;
};

/// Calls `use` with the traits that the camera needs.
template <bool kDistance, class Use>
auto withTraits(const ProjectionConstants& k, const Use& use) noexcept {
  if (k.residualReach != 0)
    return k.orthographic ? use(Traits<true, true, kDistance>()) : use(Traits<false, true, kDistance>());
  return k.orthographic ? use(Traits<true, false, kDistance>()) : use(Traits<false, false, kDistance>());
}

/// standard: double, relative to the eye.
template <class L, class Traits>
class StandardFormula {
 public:
  using D = typename L::D;
  using M = typename L::M;

  explicit StandardFormula(const ProjectionConstants& camera)
      : camera_(camera), residualReach_(camera.residualReach * kSecondOrder) {}

  Projected<D, M> point(D px, D py, D pz) const {
    const D dx = px - camera_.eye.x, dy = py - camera_.eye.y, dz = pz - camera_.eye.z;
    D x = along(camera_.x, dx, dy, dz), y = along(camera_.y, dx, dy, dz), w = along(camera_.w, dx, dy, dz);
    D reach = L::absolute(dx) + L::absolute(dy) + L::absolute(dz);
    if constexpr (Traits::residual) {
      x = x + camera_.residual.x.hi;
      y = y + camera_.residual.y.hi;
      w = w + camera_.residual.z.hi;
      reach = reach + residualReach_;
    }
    Projected<D, M> r;
    r.distance = w;
    if constexpr (Traits::orthographic) {
      r.x = camera_.centerX.hi + x;
      r.y = camera_.centerY.hi + y;
      r.depth = camera_.depthOffset.hi + camera_.depthScale.hi * w;
      r.valid = all(reach < kFarthestPoint, kSmallestReach < reach);
      r.behind = reach < D{};
    } else {
      const D perW = 1.0 / w;
      r.x = camera_.centerX.hi + x * perW;
      r.y = camera_.centerY.hi + y * perW;
      r.depth = camera_.depthOffset.hi + camera_.depthScale.hi * perW;
      // Valid if w's sign is certain, not too near the eye plane, and nothing over- or underflows.
      const D least = L::larger(reach * kSignUncertainty, L::splat(kSmallestDistance));
      const M inRange = reach < kFarthestPoint;
      r.valid = all(inRange, w > least);
      r.behind = all(inRange, w < -least);
    }
    return r;
  }

 private:
  static D along(const DDVec3& row, D dx, D dy, D dz) { return row.x.hi * dx + row.y.hi * dy + row.z.hi * dz; }

  ProjectionConstants camera_;
  double residualReach_;
};

/// A number per lane as the sum of two. lo is small compared with the terms of the number, not always with hi.
template <class D>
struct Pair {
  D hi, lo;
};

/// exact: about 75 bits. Each number has a certificate: valid lanes are the doubles nearest the true values.
template <class L, class Traits>
class ExactFormula {
 public:
  using D = typename L::D;
  using M = typename L::M;

  explicit ExactFormula(const ProjectionConstants& camera)
      : camera_(camera),
        residualReach_(camera.residualReach * kSecondOrder),
        errorXY_(kZivMargin * (kExactDot + (camera.orthographic ? 0 : kExactQuotient)) * camera.sizeXY),
        errorW_(camera.forwardIsAxis ? 0 : kZivMargin * kExactDot * camera.sizeW),
        errorCenter_(kZivMargin * kExactParameter * (camera.reachX > camera.reachY ? camera.reachX : camera.reachY)),
        errorOffset_(kZivMargin * (kExactParameter * std::fabs(camera.depthOffset.hi) + kExactUnderflow)) {}

  [[gnu::always_inline]] Projected<D, M> point(D px, D py, D pz) const {
    const Pair<D> d[3] = {sum(px, L::splat(-camera_.eye.x)), sum(py, L::splat(-camera_.eye.y)),
                          sum(pz, L::splat(-camera_.eye.z))};
    D reach = L::absolute(d[0].hi) + L::absolute(d[1].hi) + L::absolute(d[2].hi);
    if constexpr (Traits::residual) reach = reach + residualReach_;
    const D grid = reach * kSplit;
    const SplitLanes s[3] = {split(d[0], grid), split(d[1], grid), split(d[2], grid)};
    const Pair<D> x = dot(camera_.splitX, s, camera_.residual.x);
    const Pair<D> y = dot(camera_.splitY, s, camera_.residual.y);
    // Along an axis of the world, w is a difference without error.
    const Pair<D> w =
        camera_.forwardIsAxis ? along(camera_.splitW.high, d) : dot(camera_.splitW, s, camera_.residual.z);
    const M inRange = all(reach < kFarthestPoint, kSmallestReach < reach);
    Projected<D, M> r;
    r.distance = w.hi + w.lo;
    if constexpr (Traits::orthographic) {
      const Pair<D> z = times(camera_.depthScale, w);
      const D error = errorXY_ * reach + errorCenter_;
      const D errorZ = errorOffset_ + L::absolute(z.hi) * (kZivMargin * kExactParameter) +
                       std::fabs(camera_.depthScale.hi) * (errorW_ * reach);
      const M xIsNearest = isNearestSum(camera_.centerX, x, error, r.x),
              yIsNearest = isNearestSum(camera_.centerY, y, error, r.y);
      r.valid = all(inRange, xIsNearest, yIsNearest, isNearestSum(camera_.depthOffset, z, errorZ, r.depth));
      r.behind = reach < D{};
    } else {
      const Divisor by(w, r.distance);
      const Pair<D> z = quotient({L::splat(camera_.depthScale.hi), L::splat(camera_.depthScale.lo)}, by);
      // Negative if w is; then the lane has no depth, whatever the errors.
      const D t = reach * by.inverse;
      const D errorZ =
          L::multiplyAdd(by.inverse,
                         L::multiplyAdd(t, L::splat(errorW_ * std::fabs(camera_.depthScale.hi)),
                                        L::splat(kZivMargin * kExactQuotient * std::fabs(camera_.depthScale.hi))),
                         L::splat(errorOffset_));
      const D least = reach * kSignUncertaintyExact;
      const M isForward = r.distance > least, isBackward = r.distance < -least;
      // A depth that does not exist is NaN, and certain.
      const D offset = L::splat(camera_.depthOffset.hi);
      // NOLINTNEXTLINE(misc-redundant-expression): only a NaN differs from itself
      const M zIsNearest = isNearestSum(camera_.depthOffset, z, by.inverse, errorZ, r.depth) | (offset != offset);
      if constexpr (Traits::lens) {
        const Sighted at =
            throughLens({Fine<L>::twoSum(x.hi, x.lo), Fine<L>::twoSum(y.hi, y.lo), Fine<L>::twoSum(w.hi, w.lo)},
                        (errorXY_ > errorW_ ? errorXY_ : errorW_) * reach, r);
        const D none = L::splat(NAN);
        r.x = at.isSeen ? r.x : none;
        r.y = at.isSeen ? r.y : none;
        r.depth = isForward ? r.depth : none;
        r.behind = all(inRange, at.isUnseen, isBackward);
        r.valid = all(inRange, either(all(isForward, zIsNearest), isBackward),
                      either(at.isSeen, all(at.isUnseen, isForward)));
      } else {
        // |X/W| is at most t times the largest entry of a row.
        const D error = L::multiplyAdd(t, L::multiplyAdd(t, L::splat(errorW_ * camera_.sizeXY), L::splat(errorXY_)),
                                       L::splat(errorCenter_));
        const M xIsNearest = isNearestSum(camera_.centerX, quotient(x, by), by.inverse, error, r.x);
        const M yIsNearest = isNearestSum(camera_.centerY, quotient(y, by), by.inverse, error, r.y);
        r.valid = all(inRange, isForward, xIsNearest, yIsNearest, zIsNearest);
        r.behind = all(inRange, isBackward);
      }
    }
    if constexpr (Traits::distance) {
      const D error = errorW_ * reach;
      r.distance = w.hi + (w.lo + error);
      const M settled = r.distance == w.hi + (w.lo - error);
      r.valid = all(r.valid, settled);
      r.behind = all(r.behind, settled);
    }
    return r;
  }

 private:
  /// Covers the roundings of Ziv's test and the others listed in error_model.hpp.
  static constexpr double kZivMargin = 2;
  /// Adding and subtracting this times |d| rounds a coordinate of d to 27 bits of |d|, multiples of one number.
  static constexpr double kSplit = 0x1p27;
  /// Nearer to the limit of a lens than this angle, the exact path decides.
  static constexpr double kLimitMargin = 0x1p-40;

  /// A coordinate. high has the bits that kSplit leaves, low the rest, and hi is the hi of Pair.
  struct SplitLanes {
    D high, low, hi;
  };

  /// The divisor w and the inverse of its rounded value. high and low are used if there is no fused multiply-add.
  struct Divisor {
    Pair<D> w;
    D rounded, inverse, high, low;
    Divisor(const Pair<D>& parts, D value) : w(parts), rounded(value), inverse(1.0 / value), high(), low() {
      if constexpr (!L::hasFusedMultiplyAdd) {
        high = upperHalf(w.hi);
        low = (w.hi - high) + w.lo;
      }
    }
  };

  /// a with 26 bits (Veltkamp).
  static D upperHalf(D a) {
    const D scaled = (0x1p27 + 1) * a;
    return scaled - (scaled - a);
  }

  static Pair<D> sum(D a, D b) {
    const D s = a + b;
    const D part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }

  static SplitLanes split(const Pair<D>& d, D grid) {
    const D high = (d.hi + grid) - grid;
    return {high, (d.hi - high) + d.lo, d.hi};
  }

  /// row . d + residual, within kExactDot of the terms. The products of high parts and their sums are exact.
  static Pair<D> dot(const SplitRow& row, const SplitLanes* d, const DoubleDouble& residual) {
    const D high = L::multiplyAdd(L::splat(row.high.x), d[0].high,
                                  L::multiplyAdd(L::splat(row.high.y), d[1].high, row.high.z * d[2].high));
    D low = row.low.x * d[0].hi;
    low = L::multiplyAdd(L::splat(row.low.y), d[1].hi, low);
    low = L::multiplyAdd(L::splat(row.low.z), d[2].hi, low);
    low = L::multiplyAdd(L::splat(row.high.x), d[0].low, low);
    low = L::multiplyAdd(L::splat(row.high.y), d[1].low, low);
    low = L::multiplyAdd(L::splat(row.high.z), d[2].low, low);
    if constexpr (!Traits::residual) return {high, low};
    const Pair<D> shifted = sum(high, L::splat(residual.hi));
    return {shifted.hi, shifted.lo + (low + residual.lo)};
  }

  /// axis . d, for a row with one entry of 1 or -1 and zeros.
  static Pair<D> along(const Vec3& axis, const Pair<D>* d) {
    return {axis.x * d[0].hi + axis.y * d[1].hi + axis.z * d[2].hi,
            axis.x * d[0].lo + axis.y * d[1].lo + axis.z * d[2].lo};
  }

  /// a / w as q and the remainder. The remainder times the inverse is to be added to q.
  static Pair<D> quotient(const Pair<D>& a, const Divisor& by) {
    const D q = (a.hi + a.lo) * by.inverse;
    if constexpr (L::hasFusedMultiplyAdd) {
      return {q, L::multiplyAdd(-q, by.w.hi, a.hi) + L::multiplyAdd(-q, by.w.lo, a.lo)};
    } else {
      const D high = upperHalf(q);
      return {q, (a.hi - high * by.high) + (a.lo - (high * by.low + (q - high) * by.rounded))};
    }
  }

  static Pair<D> times(const DoubleDouble& a, const Pair<D>& b) {
    const D high = L::splat(a.hi);
    const D p = high * b.hi;
    return {p, L::productError(high, b.hi, p) + (a.hi * b.lo + a.lo * b.hi)};
  }

  /// isSeen: the lens sees the direction, and both numbers are the nearest doubles. isUnseen: it does not. Neither:
  /// bentPixel() decides.
  struct Sighted {
    M isSeen, isUnseen;
  };
  /// Puts a point, each of its distances within error, on the screen.
  Sighted throughLens(const Sight<Fine<L>>& at, D error, Projected<D, M>& r) const {
    using Number = Fine<L>;
    const LensParts& lens = *camera_.lens;
    const D forward = at.forward.hi;
    const Mapped<Number> mapped = mapOf(lens, at);
    const D aside = L::squareRoot(mapped.square.hi), length = L::squareRoot(mapped.square.hi + forward * forward);
    // Relative to the limit of the lens. Its sine and cosine are of a unit vector.
    const D side = forward * lens.limitSine.hi - aside * lens.limitCosine.hi, margin = kLimitMargin * length;
    const M isInFront = (lens.limitCosine.hi <= 0 ? forward : -margin) > 0x1p-60 * length;
    // Brown's polynomials are proven up to here.
    const D divisor = lens.isAngle ? length : mapped.measure.hi;
    const M isProven = aside < kLargestRadius / 2 * divisor;
    const M isSeen = all(either(isInFront, side > margin), isProven, 2.0 * error < margin);
    const M isUnseen = all(side < -margin, 2.0 * error < margin);
    const PlanePoint<Number> put = planeOf(lens, mapped);
    const Number stepX = Number(camera_.scaleX) * put.x, stepY = Number(camera_.scaleY) * put.y;
    // The error as in bentPixel(); errorCenter_ has its margin already.
    const D scale = L::splat(std::fmax(std::fabs(camera_.scaleX.hi), std::fabs(camera_.scaleY.hi)));
    const D shift = L::absolute(stepX.hi) + L::absolute(stepY.hi);
    const D ofPixel =
        scale * errorOf(lens, aside, length, mapped.measure.hi, D(1.8 * error / length), kZivMargin * kFineUnit) +
        (errorCenter_ + 4 * kZivMargin * kExactParameter * shift);
    const M xIsNearest = isNearestSum(camera_.centerX, Pair<D>{stepX.hi, stepX.lo}, ofPixel, r.x);
    const M yIsNearest = isNearestSum(camera_.centerY, Pair<D>{stepY.hi, stepY.lo}, ofPixel, r.y);
    return {all(isSeen, xIsNearest, yIsNearest), isUnseen};
  }

  /// Sets nearest to start + q + rest * factor, with q and rest from quotient(). Returns whether every number within
  /// error rounds to the same double (Ziv's test).
  static M isNearestSum(const DoubleDouble& start, const Pair<D>& quotient, D factor, D error, D& nearest) {
    const Pair<D> s = sum(L::splat(start.hi), quotient.hi);
    const D low = L::multiplyAdd(quotient.lo, factor, s.lo + start.lo);
    nearest = s.hi + (low + error);
    return nearest == s.hi + (low - error);
  }
  static M isNearestSum(const DoubleDouble& start, const Pair<D>& value, D error, D& nearest) {
    const Pair<D> s = sum(L::splat(start.hi), value.hi);
    const D low = s.lo + (value.lo + start.lo);
    nearest = s.hi + (low + error);
    return nearest == s.hi + (low - error);
  }

  ProjectionConstants camera_;
  double residualReach_, errorXY_, errorW_, errorCenter_, errorOffset_;
};

/// The unit direction of the ray through a screen position, in double.
template <class L>
class RayFormula {
 public:
  using D = typename L::D;

  explicit RayFormula(const ProjectionConstants& camera) : camera_(camera) {}

  struct Direction {
    D x, y, z;
  };

  Direction operator()(D px, D py) const {
    const Fine<L> a = offset(px, camera_.centerX), b = offset(py, camera_.centerY);
    return along(camera_, a.hi + a.lo, b.hi + b.lo, L::splat(1));
  }

  /// x, y and z along the columns rayX, rayY, rayW.
  static Direction along(const ProjectionConstants& camera, D a, D b, D c) {
    const D x = c * camera.rayW.x + (a * camera.rayX.x + b * camera.rayY.x);
    const D y = c * camera.rayW.y + (a * camera.rayX.y + b * camera.rayY.y);
    const D z = c * camera.rayW.z + (a * camera.rayX.z + b * camera.rayY.z);
    const D length = L::squareRoot(x * x + y * y + z * z);  // below 1e280 in the domain
    return {x / length, y / length, z / length};
  }

  /// value - center. hi + lo is rounded once.
  static Fine<L> offset(D value, const DoubleDouble& center) {
    const Fine<L> difference = Fine<L>::twoSum(value, L::splat(-center.hi));
    return {difference.hi, difference.lo - center.lo};
  }

 private:
  ProjectionConstants camera_;
};

/// The directions of rays through a lens.
template <class L>
class LensRayFormula {
 public:
  using D = typename L::D;
  using M = typename L::M;

  explicit LensRayFormula(const ProjectionConstants& camera) : camera_(camera), inverse_(*camera.lens) {}

  typename LensInverse<L>::Result operator()(D px, D py) const {
    return inverse_({offset(px, camera_.centerX) * Fine<L>(camera_.perScaleX),
                     offset(py, camera_.centerY) * Fine<L>(camera_.perScaleY)});
  }

  const ProjectionConstants& camera() const { return camera_; }

 private:
  /// 0 where the terms cancel to less than the center's own error, as in sumOrZero.
  static Fine<L> offset(D value, const DoubleDouble& center) {
    const Fine<L> difference = RayFormula<L>::offset(value, center);
    const Fine<L> sum = Fine<L>::twoSum(difference.hi, difference.lo);
    return choose(L::absolute(sum.hi) <= kCancellation * L::absolute(value), Fine<L>(D{}), sum);
  }

  ProjectionConstants camera_;
  LensInverse<L> inverse_;
};

}  // namespace
}  // namespace viewproj::detail
