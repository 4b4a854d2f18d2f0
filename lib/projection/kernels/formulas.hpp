// The arithmetic of one point in each precision, written once for a double and for a vector of lanes.
//
// fast and standard are single IEEE operations in a fixed order, so a lane gives the bits that a double gives, on every
// instruction set. exact may use a fused multiply-add where there is one: its results are certified to be the doubles
// nearest the true values, whatever their last bits before rounding were. Everything here has internal linkage: each
// kernel is compiled for its own processor, and a linker must not take one's code for another's.
#pragma once

#include <cmath>
#include <limits>

#include "projection/kernels/error_model.hpp"
#include "projection/kernels/kernels.hpp"
#include "projection/kernels/picture_reach.hpp"

namespace viewproj::detail {
namespace {

/// What formulas are written in terms of: D a double or a vector of doubles, F a float or a vector of floats, M and FM
/// what comparisons of two D and of two F give.
struct ScalarLanes {
  using D = double;
  using F = float;
  using M = bool;
  using FM = bool;
  static D splat(double a) { return a; }
  static D absolute(D a) { return std::fabs(a); }
  static F absolute(F a) { return std::fabs(a); }
  static D withSignOf(D size, D sign) { return std::copysign(size, sign); }
  static D larger(D a, D b) { return a > b ? a : b; }
  static F larger(F a, F b) { return a > b ? a : b; }
  static D squareRoot(D a) { return std::sqrt(a); }
  /// multiplyAdd: a * b + c, rounded once or twice. productError: the rounding error of a * b, whose rounded value is
  /// product. remainder: a - b * c to one rounding, for b * c near a.
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  static D multiplyAdd(D a, D b, D c) { return __builtin_fma(a, b, c); }
  static D productError(D a, D b, D product) { return __builtin_fma(a, b, -product); }
  static D remainder(D a, D b, D c) { return __builtin_fma(-b, c, a); }
#else
  static D multiplyAdd(D a, D b, D c) { return a * b + c; }
  static D productError(D a, D b, D) { return twoProd(a, b).lo; }
  static D remainder(D a, D b, D c) {
    const DoubleDouble product = twoProd(b, c);
    return (a - product.hi) - product.lo;
  }
#endif
};

/// The conjunction of conditions, lane by lane.
inline bool all(bool a, bool b) { return a && b; }
template <class A, class B>
inline A all(A a, B b) {
  return a & b;
}
template <class A, class B, class... More>
inline A all(A a, B b, More... more) {
  return all(all(a, b), more...);
}

/// Which parts of a formula a camera needs, and whether the distance is asked for (in exact, it has to be certain
/// then).
template <bool IsOrthographic, bool HasResidual, bool HasBand, bool WantsDistance = false>
struct Traits {
  static constexpr bool orthographic = IsOrthographic, residual = HasResidual, band = HasBand, distance = WantsDistance;
};

/// Whether a camera's numbers are in the range that a precision's bounds hold for.
inline bool isInRange(const ProjectionConstants& k, double largestRow, double largestRange) {
  return k.sizeXY < largestRow && k.sizeXY > 1 / largestRow && k.sizeW < 2 && k.sizeW > 0.25 && k.range < largestRange;
}

/// Results farther than this from the principal point are left to the exact path.
struct Band {
  double x = kNoBand, y = kNoBand;
};

/// A row of three, rounded to T.
template <class T>
struct Row {
  T x, y, z;
  explicit Row(const DDVec3& row)
      : x(static_cast<T>(row.x.hi)), y(static_cast<T>(row.y.hi)), z(static_cast<T>(row.z.hi)) {}

  template <class V>
  V along(V dx, V dy, V dz) const {
    return x * dx + y * dy + z * dz;
  }
};

/// The window coordinates of a point, times pixels, and what they are certain of. T is double or float, V as many
/// lanes.
template <class T, class Traits>
class WindowFormula {
 public:
  WindowFormula(const ProjectionConstants& k, Band band, double largestRange = kLargestRange)
      : x_(k.x),
        y_(k.y),
        w_(k.w),
        residual_(k.residual),
        residualReach_(static_cast<T>(k.residualReach * kSecondOrder)),
        bandX_(static_cast<T>(band.x < kLargestBand ? band.x : kLargestBand)),
        bandY_(static_cast<T>(band.y < kLargestBand ? band.y : kLargestBand)),
        farthest_(band.x < kNoBand ? static_cast<T>(k.farthest) : std::numeric_limits<T>::max()),
        reach_(isInRange(k, isDouble ? kLargestRow : kLargestRowFast, largestRange)
                   ? static_cast<T>(isDouble ? kLargestReach : kLargestReachFast)
                   : 0) {}

  /// In perspective x and y are X/W and Y/W, and depth is 1/W; in orthographic they are X, Y and W.
  template <class L, class V, class Mask>
  Projected<V, Mask> at(V dx, V dy, V dz) const {
    V x = x_.along(dx, dy, dz), y = y_.along(dx, dy, dz), w = w_.along(dx, dy, dz);
    V reach = L::absolute(dx) + L::absolute(dy) + L::absolute(dz);
    if constexpr (Traits::residual) {
      x = x + residual_.x;
      y = y + residual_.y;
      w = w + residual_.z;
      reach = reach + residualReach_;
    }
    Projected<V, Mask> r;
    r.distance = w;
    if constexpr (Traits::orthographic) {
      r.x = x;
      r.y = y;
      r.depth = w;
      r.valid = all(reach < reach_, kSmallest < reach);
      // The bound of a band is that of points between near and far.
      if constexpr (Traits::band) r.valid = all(r.valid, L::absolute(w) <= farthest_);
      r.behind = reach < V{};
    } else {
      const V perW = T(1) / w;
      r.x = x * perW;
      r.y = y * perW;
      r.depth = perW;
      // Not so near the eye plane that the sign of w is uncertain, and where nothing over- or underflows.
      const V least = L::larger(reach * kSign, kSmallest - V{});
      const Mask inRange = reach < reach_;
      r.valid = all(inRange, w > least);
      r.behind = all(inRange, w < -least);
    }
    if constexpr (Traits::band) r.valid = all(r.valid, L::absolute(r.x) < bandX_, L::absolute(r.y) < bandY_);
    return r;
  }

 private:
  static constexpr bool isDouble = sizeof(T) == sizeof(double);
  static constexpr T kSign = static_cast<T>(isDouble ? kSignUncertainty : kSignUncertaintyFast);
  static constexpr T kSmallest = static_cast<T>(isDouble ? kSmallestDistance : kSmallestDistanceFast);
  /// No valid point of this type is farther from the principal point.
  static constexpr double kLargestBand = isDouble ? kNoBand : 0x1p100;

  Row<T> x_, y_, w_, residual_;
  T residualReach_, bandX_, bandY_, farthest_, reach_;
};

/// From window coordinates times pixels, as WindowFormula gives them, to the screen.
struct ScreenSums {
  double centerX, centerY, depthOffset, depthScale;
  explicit ScreenSums(const ProjectionConstants& k)
      : centerX(k.centerX.hi), centerY(k.centerY.hi), depthOffset(k.depthOffset.hi), depthScale(k.depthScale.hi) {}

  template <class D>
  D x(D window) const {
    return centerX + window;
  }
  template <class D>
  D y(D window) const {
    return centerY + window;
  }
  template <class D>
  D depth(D window) const {
    return depthOffset + depthScale * window;
  }
};

/// standard: double, relative to the eye.
template <class L, class Traits>
class StandardFormula {
 public:
  using D = typename L::D;
  using M = typename L::M;

  StandardFormula(const ProjectionConstants& k, Band band) : window_(k, band), screen_(k), eye_(k.eye) {}

  Projected<D, M> point(D px, D py, D pz) const {
    Projected<D, M> r = window_.template at<L, D, M>(px - eye_.x, py - eye_.y, pz - eye_.z);
    r.x = screen_.x(r.x);
    r.y = screen_.y(r.y);
    r.depth = screen_.depth(r.depth);
    return r;
  }

 private:
  WindowFormula<double, Traits> window_;
  ScreenSums screen_;
  Vec3 eye_;
};

/// fast: float32 after the eye is subtracted in double; the last sums in double again.
template <class L, class Traits>
class FastFormula {
 public:
  using D = typename L::D;
  using F = typename L::F;

  FastFormula(const ProjectionConstants& k, Band band) : window_(k, band), screen(k), eye(k.eye) {}

  /// From the difference to the eye, in float.
  Projected<F, typename L::FM> window(F dx, F dy, F dz) const {
    return window_.template at<L, F, typename L::FM>(dx, dy, dz);
  }

  /// All of it for one point (D a double).
  Projected<D, typename L::M> point(D px, D py, D pz) const {
    const auto r = window(static_cast<F>(px - eye.x), static_cast<F>(py - eye.y), static_cast<F>(pz - eye.z));
    return {screen.x(D(r.x)), screen.y(D(r.y)), screen.depth(D(r.depth)), r.distance, r.valid, r.behind};
  }

 private:
  WindowFormula<float, Traits> window_;

 public:
  const ScreenSums screen;
  const Vec3 eye;
};

/// The difference of a float32 to a coordinate of the eye, by its high and low part: of a float32 next to the eye the
/// first difference is exact, of any other low is nothing; two roundings in all.
struct FloatEye {
  float high, low;
  explicit FloatEye(double eye) : high(static_cast<float>(eye)), low(static_cast<float>(eye - double{high})) {}

  template <class F>
  F to(F coordinate) const {
    return (coordinate - high) - low;
  }
};

/// fast from float32 to float32: all of it in float.
template <class L, class Traits>
class FloatFormula {
 public:
  using F = typename L::F;

  explicit FloatFormula(const ProjectionConstants& k)
      : window_(k, {}, kLargestRangeFloat),
        eyeX_(k.eye.x),
        eyeY_(k.eye.y),
        eyeZ_(k.eye.z),
        centerX_(static_cast<float>(k.centerX.hi)),
        centerY_(static_cast<float>(k.centerY.hi)),
        depthOffset_(static_cast<float>(k.depthOffset.hi)),
        depthScale_(static_cast<float>(k.depthScale.hi)) {}

  Projected<F, typename L::FM> point(F px, F py, F pz) const {
    auto r = window_.template at<L, F, typename L::FM>(eyeX_.to(px), eyeY_.to(py), eyeZ_.to(pz));
    r.x = centerX_ + r.x;
    r.y = centerY_ + r.y;
    r.depth = depthOffset_ + depthScale_ * r.depth;
    return r;
  }

 private:
  WindowFormula<float, Traits> window_;
  FloatEye eyeX_, eyeY_, eyeZ_;
  float centerX_, centerY_, depthOffset_, depthScale_;
};

/// A double-double of lanes.
template <class D>
struct Pair {
  D hi, lo;
};

/// exact: double-double, with a certificate for every number: valid lanes are the doubles nearest the true values.
template <class L, class Traits>
class ExactFormula {
 public:
  using D = typename L::D;
  using M = typename L::M;

  ExactFormula(const ProjectionConstants& k, Band)
      : eye_(k.eye),
        x_(k.x),
        y_(k.y),
        w_(k.w),
        residual_(k.residual),
        centerX_(k.centerX),
        centerY_(k.centerY),
        offset_(k.depthOffset),
        scale_(k.depthScale),
        residualReach_(k.residualReach * kSecondOrder),
        errorXY_(kZivMargin * kExactDotX * k.sizeXY),
        errorW_(k.forwardIsAxis ? 0 : kZivMargin * kExactDotW * k.sizeW),
        errorCenterX_(kZivMargin * kExactParameter * k.reachX),
        errorCenterY_(kZivMargin * kExactParameter * k.reachY),
        errorOffset_(kZivMargin * (kExactParameter * std::fabs(k.depthOffset.hi) + kExactUnderflow)),
        reach_(isInRange(k, kLargestRow, kLargestRangeExact) && std::fabs(k.depthScale.hi) > kSmallestReachExact
                   ? kLargestReachExact
                   : 0) {}

  Projected<D, M> point(D px, D py, D pz) const {
    const Pair<D> d[3] = {sum(px, L::splat(-eye_.x)), sum(py, L::splat(-eye_.y)), sum(pz, L::splat(-eye_.z))};
    const Pair<D> x = dot(x_, d, residual_.x);
    const Pair<D> y = dot(y_, d, residual_.y);
    const Pair<D> w = dot(w_, d, residual_.z);
    D reach = L::absolute(d[0].hi) + L::absolute(d[1].hi) + L::absolute(d[2].hi);
    if constexpr (Traits::residual) reach = reach + residualReach_;
    const M inRange = all(reach < reach_, kSmallestReachExact < reach);
    constexpr double kParameter = kZivMargin * kExactParameter;
    Projected<D, M> r;
    r.distance = w.hi;
    if constexpr (Traits::orthographic) {
      const Pair<D> sx = add(centerX_, x), sy = add(centerY_, y);
      const Pair<D> scaled = times(scale_, w);
      const Pair<D> z = add(offset_, scaled);
      const D error = errorXY_ * reach;
      const D errorZ = errorOffset_ + L::absolute(scaled.hi) * kParameter + std::fabs(scale_.hi) * (errorW_ * reach);
      r.x = sx.hi;
      r.y = sy.hi;
      r.depth = z.hi;
      // Of a distance without an error, the product with scale might have underflowed.
      const D size = L::absolute(w.hi);
      const M hasDigits = (size > kSmallestDistanceExact) | (size == D{});
      r.valid = all(inRange, hasDigits, certain(sx, error + (errorCenterX_ + L::absolute(x.hi) * kParameter)),
                    certain(sy, error + (errorCenterY_ + L::absolute(y.hi) * kParameter)), certain(z, errorZ));
      r.behind = reach < D{};
    } else {
      const D perW = 1.0 / w.hi;
      const Pair<D> qx = quotient(x, w, perW), qy = quotient(y, w, perW);
      const Pair<D> qz = quotient({L::splat(scale_.hi), L::splat(scale_.lo)}, w, perW);
      const Pair<D> sx = add(centerX_, qx), sy = add(centerY_, qy), z = add(offset_, qz);
      const D t = reach * L::absolute(perW);
      const D relative = t * errorW_ + kParameter;
      const D error = t * errorXY_;
      r.x = sx.hi;
      r.y = sy.hi;
      r.depth = z.hi;
      const D least = reach * kSignUncertaintyExact;
      r.valid = all(inRange, w.hi > least, certain(sx, L::absolute(qx.hi) * relative + (error + errorCenterX_)),
                    certain(sy, L::absolute(qy.hi) * relative + (error + errorCenterY_)),
                    certain(z, L::absolute(qz.hi) * relative + errorOffset_));
      r.behind = all(inRange, w.hi < -least);
    }
    if constexpr (Traits::distance) {
      const M settled = certain(w, errorW_ * reach);
      r.valid = all(r.valid, settled);
      r.behind = all(r.behind, settled);
    }
    return r;
  }

 private:
  /// Errors are taken four times as large, so that one side of Ziv's test is enough: what rounds safely on lo's side by
  /// this much is at least half of that away from the border on the other, at powers of two as well.
  static constexpr double kZivMargin = 4;

  static Pair<D> sum(D a, D b) {
    const D s = a + b;
    const D part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  static Pair<D> quickSum(D a, D b) {
    const D s = a + b;
    return {s, b - (s - a)};
  }

  /// row . d + residual, to 128 u^2 of the sum of sizes.
  static Pair<D> dot(const DDVec3& row, const Pair<D>* d, const DoubleDouble& residual) {
    const D r0 = L::splat(row.x.hi), r1 = L::splat(row.y.hi), r2 = L::splat(row.z.hi);
    const D p0 = r0 * d[0].hi, p1 = r1 * d[1].hi, p2 = r2 * d[2].hi;
    const Pair<D> s = sum(p0, p1);
    const Pair<D> t = sum(s.hi, p2);
    // Short chains, side by side: waiting for one another is what costs here.
    const D crossed0 = L::multiplyAdd(r0, d[0].lo, row.x.lo * d[0].hi);
    const D crossed1 = L::multiplyAdd(r1, d[1].lo, row.y.lo * d[1].hi);
    const D crossed2 = L::multiplyAdd(r2, d[2].lo, row.z.lo * d[2].hi);
    const D errors =
        (L::productError(r0, d[0].hi, p0) + L::productError(r1, d[1].hi, p1)) + L::productError(r2, d[2].hi, p2);
    const D low = ((crossed0 + crossed1) + (crossed2 + errors)) + (s.lo + t.lo);
    const Pair<D> result = quickSum(t.hi, low);
    if constexpr (Traits::residual) {
      const Pair<D> shifted = sum(result.hi, L::splat(residual.hi));
      return quickSum(shifted.hi, shifted.lo + (result.lo + residual.lo));
    } else {
      return result;
    }
  }

  /// a / w, given 1 / w.hi; lo is a few units of hi, not brought below half of one.
  static Pair<D> quotient(const Pair<D>& a, const Pair<D>& w, D perW) {
    const D q = a.hi * perW;
    const D rest = L::remainder(a.hi, q, w.hi) + L::multiplyAdd(-q, w.lo, a.lo);
    return {q, rest * perW};
  }

  static Pair<D> times(const DoubleDouble& a, const Pair<D>& b) {
    const D high = L::splat(a.hi);
    const D p = high * b.hi;
    return quickSum(p, L::productError(high, b.hi, p) + (a.hi * b.lo + a.lo * b.hi));
  }

  static Pair<D> add(const DoubleDouble& a, const Pair<D>& b) {
    const Pair<D> s = sum(L::splat(a.hi), b.hi);
    return quickSum(s.hi, s.lo + (b.lo + a.lo));
  }

  /// Ziv's test: every number within the error rounds to the same double.
  static M certain(const Pair<D>& value, D error) {
    return value.hi + (value.lo + L::withSignOf(error, value.lo)) == value.hi;
  }

  Vec3 eye_;
  DDVec3 x_, y_, w_, residual_;
  DoubleDouble centerX_, centerY_, offset_, scale_;
  double residualReach_, errorXY_, errorW_, errorCenterX_, errorCenterY_, errorOffset_, reach_;
};

/// The unit direction of the ray through a screen position, in double.
template <class L>
class RayFormula {
 public:
  using D = typename L::D;

  explicit RayFormula(const ProjectionConstants& k)
      : x_(k.rayX), y_(k.rayY), w_(k.rayW), centerX_(k.centerX), centerY_(k.centerY) {}

  struct Direction {
    D x, y, z, squaredLength;
  };

  Direction operator()(D px, D py) const {
    const D a = offsetFrom(centerX_, px);
    const D b = offsetFrom(centerY_, py);
    const D x = w_.x + (a * x_.x + b * y_.x);
    const D y = w_.y + (a * x_.y + b * y_.y);
    const D z = w_.z + (a * x_.z + b * y_.z);
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

  Vec3 x_, y_, w_;
  DoubleDouble centerX_, centerY_;
};

}  // namespace
}  // namespace viewproj::detail
