// The arithmetic of one point in each precision, written once for a double and for a vector of lanes.
//
// standard uses single IEEE operations in a fixed order, so a lane has the same bits as a double on every instruction
// set. exact may use fused multiply-add: its results are certified to be the doubles nearest the true values, so the
// last bits before rounding do not matter. Everything here has internal linkage: each kernel is compiled for its own
// processor, and the linker must not use one kernel's code in another.
#pragma once

#include <cmath>

#include "lens/response.hpp"
#include "projection/kernels/error_model.hpp"
#include "projection/kernels/fine_lanes.hpp"
#include "projection/kernels/kernels.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {
namespace {

/// The operations that formulas use. D is a double or a vector of doubles, M the result of comparing two D.
struct ScalarLanes {
  using D = double;
  using M = bool;
  static D splat(double a) { return a; }
  static D absolute(D a) { return std::fabs(a); }
  static D larger(D a, D b) { return a > b ? a : b; }
  static D squareRoot(D a) { return std::sqrt(a); }
  /// Calls a function for each lane.
  template <class Function>
  static D map(D a, const Function& function) {
    return function(a);
  }
  /// multiplyAdd: a * b + c, rounded once or twice. productError: the error of the rounded product of a * b.
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  static constexpr bool hasFusedMultiplyAdd = true;
  static D multiplyAdd(D a, D b, D c) { return __builtin_fma(a, b, c); }
  static D productError(D a, D b, D product) { return __builtin_fma(a, b, -product); }
#else
  static constexpr bool hasFusedMultiplyAdd = false;
  static D multiplyAdd(D a, D b, D c) { return a * b + c; }
  static D productError(D a, D b, D) { return twoProd(a, b).lo; }
#endif
};

/// Whether all conditions hold, lane by lane.
inline bool all(bool a, bool b) { return a && b; }
template <class A, class B>
inline A all(A a, B b) {
  return a & b;
}
template <class A, class B, class... More>
inline A all(A a, B b, More... more) {
  return all(all(a, b), more...);
}

/// The parts of a formula that a camera needs, and whether the distance is needed too (exact then certifies it).
template <bool IsOrthographic, bool HasResidual, bool WantsDistance = false, bool HasLens = false>
struct Traits {
  static constexpr bool orthographic = IsOrthographic, residual = HasResidual, distance = WantsDistance, lens = HasLens;
};

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
      // Negative if w is; then the lane is not valid, whatever the errors.
      const D t = reach * by.inverse;
      // |X/W| is at most t times the largest entry of a row.
      const D error = L::multiplyAdd(t, L::multiplyAdd(t, L::splat(errorW_ * camera_.sizeXY), L::splat(errorXY_)),
                                     Traits::lens ? D{} : L::splat(errorCenter_));
      M xyAreNearest;
      if constexpr (Traits::lens) {
        xyAreNearest = areNearestBent(quotient(x, by), quotient(y, by), by.inverse, error, r);
      } else {
        const M xIsNearest = isNearestSum(camera_.centerX, quotient(x, by), by.inverse, error, r.x);
        const M yIsNearest = isNearestSum(camera_.centerY, quotient(y, by), by.inverse, error, r.y);
        xyAreNearest = all(xIsNearest, yIsNearest);
      }
      const D errorZ =
          L::multiplyAdd(by.inverse,
                         L::multiplyAdd(t, L::splat(errorW_ * std::fabs(camera_.depthScale.hi)),
                                        L::splat(kZivMargin * kExactQuotient * std::fabs(camera_.depthScale.hi))),
                         L::splat(errorOffset_));
      const D least = reach * kSignUncertaintyExact;
      // A depth that does not exist is NaN, and certain.
      const D offset = L::splat(camera_.depthOffset.hi);
      // NOLINTNEXTLINE(misc-redundant-expression): only a NaN differs from itself
      const M zIsNearest = isNearestSum(camera_.depthOffset, z, by.inverse, errorZ, r.depth) | (offset != offset);
      r.valid = all(inRange, r.distance > least, xyAreNearest, zIsNearest);
      r.behind = all(inRange, r.distance < -least);
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

  /// Bends tangents from quotient(), each within error, and puts them on the screen. Returns whether both numbers are
  /// the nearest doubles, or the point is certainly beyond the lens: then they are NaN. bentPixel() decides the others.
  M areNearestBent(const Pair<D>& tangentX, const Pair<D>& tangentY, D factor, D error, Projected<D, M>& r) const {
    using Number = Fine<L>;
    const LensParts& lens = *camera_.lens;
    const Number x = Number::twoSum(tangentX.hi, tangentX.lo * factor);
    const Number y = Number::twoSum(tangentY.hi, tangentY.lo * factor);
    const Number u = x * x + y * y;
    const Radial<Number> at = radial(lens, u);
    const Tangents<Number> bent = bend(lens, {x, y}, u, at.factor);
    const Number stepX = Number(camera_.scaleX) * bent.x, stepY = Number(camera_.scaleY) * bent.y;
    // The error as in bentPixel(); errorCenter_ has its margin already.
    const auto [stretch, rounding] = roughly(lens, L::squareRoot(u.hi), error);
    const D scale = L::splat(std::fmax(std::fabs(camera_.scaleX.hi), std::fabs(camera_.scaleY.hi)));
    const D shift = L::absolute(stepX.hi) + L::absolute(stepY.hi);
    const D ofPixel = scale * (1.5 * stretch * error + kZivMargin * kFineUnit * rounding) +
                      (errorCenter_ + 4 * kZivMargin * kExactParameter * shift);
    const M xIsNearest = isNearestSum(camera_.centerX, Pair<D>{stepX.hi, stepX.lo}, ofPixel, r.x);
    const M yIsNearest = isNearestSum(camera_.centerY, Pair<D>{stepY.hi, stepY.lo}, ofPixel, r.y);
    const D extent = L::squareRoot(at.square.hi), none = L::splat(NAN);
    const M isBefore = extent + 2.0 * error < lens.end * (1 - 0x1p-40);
    const M isBeyond = extent - 2.0 * error > lens.end * (1 + 0x1p-40);
    r.x = isBeyond ? none : r.x;
    r.y = isBeyond ? none : r.y;
    return all(u.hi < kLargestTangent * kLargestTangent / 2, all(isBefore, xIsNearest, yIsNearest) | isBeyond);
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
    D x, y, z, squaredLength;
  };

  Direction operator()(D px, D py) const {
    const D a = offsetFrom(camera_.centerX, px);
    const D b = offsetFrom(camera_.centerY, py);
    const D x = camera_.rayW.x + (a * camera_.rayX.x + b * camera_.rayY.x);
    const D y = camera_.rayW.y + (a * camera_.rayX.y + b * camera_.rayY.y);
    const D z = camera_.rayW.z + (a * camera_.rayX.z + b * camera_.rayY.z);
    const D squared = x * x + y * y + z * z;
    const D length = L::squareRoot(squared);
    return {x / length, y / length, z / length, squared};
  }

 private:
  /// value - center, rounded once.
  static D offsetFrom(const DoubleDouble& center, D value) {
    const D difference = value - center.hi;
    const D part = difference - value;
    const D error = (value - (difference - part)) + ((L::splat(-center.hi)) - part);
    return difference + (error - center.lo);
  }

  ProjectionConstants camera_;
};

}  // namespace
}  // namespace viewproj::detail
