// The arithmetic of one point in each precision, written once for a double and for a vector of lanes.
//
// Every line is a sequence of single IEEE operations in a fixed order, so a lane gives the bits that a double gives, on
// every instruction set. Everything here has internal linkage: each kernel is compiled for its own processor, and a
// linker must not take one's code for another's.
#pragma once

#include <cmath>

#include "viewproj/camera/camera.hpp"
#include "viewproj/view/bounds.hpp"

namespace viewproj {
namespace {

/// What a kernel works in: D a double or a vector of doubles, F the float or vector of floats of as many lanes, M what
/// a comparison of two D gives.
struct ScalarLanes {
  using D = double;
  using F = float;
  using M = bool;
  static F toFloat(D a) { return static_cast<float>(a); }
  static D toDouble(F a) { return a; }
  static D absolute(D a) { return std::fabs(a); }
  static D squareRoot(D a) { return std::sqrt(a); }
  /// The rounding error of a * b, whose rounded value is product.
  static D productError(D a, D b, D product) {
    (void)product;
    return twoProd(a, b).lo;
  }
};

/// valid: the numbers are within the precision's bound. behind: certainly on or beyond the eye plane. A lane that is
/// neither is for the exact path to decide.
template <class L>
struct Projected {
  typename L::D x, y, depth, distance;
  typename L::M valid, behind;
};

/// Whether a camera's rows are in the range that a precision's bounds hold for.
inline bool rowsInRange(const ProjectionConstants& k, double largest) {
  return k.sizeXY < largest && k.sizeXY > 1 / largest && k.sizeW < 2 && k.sizeW > 0.25;
}

/// Results farther than this from the principal point are left to the exact path.
struct Band {
  double x = kNoBand, y = kNoBand;
};

template <class Row, class V>
inline V alongRow(const Row& row, V dx, V dy, V dz) {
  return row[0] * dx + row[1] * dy + row[2] * dz;
}

struct Row {
  double entry[3];
  explicit Row(const DDVec3& row) : entry{row.x.hi, row.y.hi, row.z.hi} {}
  double operator[](int i) const { return entry[i]; }
};

struct FloatRow {
  float entry[3];
  explicit FloatRow(const DDVec3& row)
      : entry{static_cast<float>(row.x.hi), static_cast<float>(row.y.hi), static_cast<float>(row.z.hi)} {}
  float operator[](int i) const { return entry[i]; }
};

/// standard: double, relative to the eye.
template <class L>
class StandardFormula {
 public:
  using D = typename L::D;
  using M = typename L::M;

  StandardFormula(const ProjectionConstants& k, Band band)
      : k_(k), x_(k.x), y_(k.y), w_(k.w), band_(band), reach_(rowsInRange(k, kLargestRow) ? kLargestReach : 0) {}

  Projected<L> operator()(D px, D py, D pz) const {
    const D dx = px - k_.eye.x, dy = py - k_.eye.y, dz = pz - k_.eye.z;
    const D x = alongRow(x_, dx, dy, dz) + k_.residual.x.hi;
    const D y = alongRow(y_, dx, dy, dz) + k_.residual.y.hi;
    const D w = alongRow(w_, dx, dy, dz) + k_.residual.z.hi;
    const D reach = L::absolute(dx) + L::absolute(dy) + L::absolute(dz) + k_.residualReach;
    Projected<L> r;
    r.distance = w;
    if (k_.orthographic) {
      r.x = k_.centerX.hi + x;
      r.y = k_.centerY.hi + y;
      r.depth = k_.depthOffset.hi + k_.depthScale.hi * w;
      r.valid = (reach < reach_) & (L::absolute(x) < band_.x) & (L::absolute(y) < band_.y);
      r.behind = reach < D{};
      return r;
    }
    const D perW = 1.0 / w;
    const D qx = x * perW, qy = y * perW;
    r.x = k_.centerX.hi + qx;
    r.y = k_.centerY.hi + qy;
    r.depth = k_.depthOffset.hi + k_.depthScale.hi * perW;
    const D size = L::absolute(w);
    const M certain = (size > kSignUncertainty * reach) & (size > kSmallestDistance) & (reach < reach_);
    r.behind = certain & (w < D{});
    r.valid = certain & (w > D{}) & (L::absolute(qx) < band_.x) & (L::absolute(qy) < band_.y);
    return r;
  }

 private:
  const ProjectionConstants& k_;
  Row x_, y_, w_;
  Band band_;
  double reach_;
};

/// fast: float32 after the eye is subtracted in double; the last sum in double again.
template <class L>
class FastFormula {
 public:
  using D = typename L::D;
  using F = typename L::F;
  using M = typename L::M;

  FastFormula(const ProjectionConstants& k, Band band)
      : k_(k),
        x_(k.x),
        y_(k.y),
        w_(k.w),
        rx_(static_cast<float>(k.residual.x.hi)),
        ry_(static_cast<float>(k.residual.y.hi)),
        rw_(static_cast<float>(k.residual.z.hi)),
        band_(band),
        reach_(rowsInRange(k, kLargestRowFast) ? kLargestReachFast : 0) {}

  Projected<L> operator()(D px, D py, D pz) const {
    const F dx = L::toFloat(px - k_.eye.x), dy = L::toFloat(py - k_.eye.y), dz = L::toFloat(pz - k_.eye.z);
    const F x = alongRow(x_, dx, dy, dz) + rx_;
    const F y = alongRow(y_, dx, dy, dz) + ry_;
    const F wSingle = alongRow(w_, dx, dy, dz) + rw_;
    const D w = L::toDouble(wSingle);
    const D reach =
        L::absolute(L::toDouble(dx)) + L::absolute(L::toDouble(dy)) + L::absolute(L::toDouble(dz)) + k_.residualReach;
    Projected<L> r;
    r.distance = w;
    if (k_.orthographic) {
      const D xWide = L::toDouble(x), yWide = L::toDouble(y);
      r.x = k_.centerX.hi + xWide;
      r.y = k_.centerY.hi + yWide;
      r.depth = k_.depthOffset.hi + k_.depthScale.hi * w;
      r.valid = (reach < reach_) & (L::absolute(xWide) < band_.x) & (L::absolute(yWide) < band_.y);
      r.behind = reach < D{};
      return r;
    }
    const F perW = 1.0f / wSingle;
    const D qx = L::toDouble(x * perW), qy = L::toDouble(y * perW);
    r.x = k_.centerX.hi + qx;
    r.y = k_.centerY.hi + qy;
    r.depth = k_.depthOffset.hi + k_.depthScale.hi * L::toDouble(perW);
    const D size = L::absolute(w);
    const M certain = (size > kSignUncertaintyFast * reach) & (size > kSmallestDistanceFast) & (reach < reach_);
    r.behind = certain & (w < D{});
    r.valid = certain & (w > D{}) & (L::absolute(qx) < band_.x) & (L::absolute(qy) < band_.y);
    return r;
  }

 private:
  const ProjectionConstants& k_;
  FloatRow x_, y_, w_;
  float rx_, ry_, rw_;
  Band band_;
  double reach_;
};

/// A double-double of lanes.
template <class D>
struct Pair {
  D hi, lo;
};

/// exact: double-double, with a certificate for every number: valid lanes are the doubles nearest the true values.
template <class L, bool HasResidual>
class ExactFormula {
 public:
  using D = typename L::D;
  using M = typename L::M;

  ExactFormula(const ProjectionConstants& k, Band band)
      : k_(k),
        band_(band),
        perT_(kExactDotX * k.sizeXY),
        perTq_(kExactDotW * k.sizeW),
        centerX_(kExactParameter * std::fabs(k.centerX.hi)),
        centerY_(kExactParameter * std::fabs(k.centerY.hi)),
        offset_(kExactParameter * std::fabs(k.depthOffset.hi)),
        reach_(rowsInRange(k, kLargestRow) ? kLargestReachExact : 0) {}

  Projected<L> operator()(D px, D py, D pz) const {
    const Pair<D> d[3] = {sum(px, D{} - k_.eye.x), sum(py, D{} - k_.eye.y), sum(pz, D{} - k_.eye.z)};
    const Pair<D> x = dot(k_.x, d, k_.residual.x);
    const Pair<D> y = dot(k_.y, d, k_.residual.y);
    const Pair<D> w = dot(k_.w, d, k_.residual.z);
    D reach = L::absolute(d[0].hi) + L::absolute(d[1].hi) + L::absolute(d[2].hi);
    if constexpr (HasResidual) reach = reach + k_.residualReach;
    const M inRange = (reach < reach_) & (reach > kSmallestReachExact);
    Projected<L> r;
    r.distance = w.hi;
    if (k_.orthographic) {
      const D error = perT_ * reach;
      const Pair<D> sx = add(k_.centerX, x), sy = add(k_.centerY, y);
      const Pair<D> scaled = times(k_.depthScale, w);
      const Pair<D> z = add(k_.depthOffset, scaled);
      const D depthError =
          offset_ + L::absolute(scaled.hi) * kExactParameter + std::fabs(k_.depthScale.hi) * (perTq_ * reach);
      r.x = sx.hi;
      r.y = sy.hi;
      r.depth = z.hi;
      r.valid = inRange & certain(sx, error + centerX_ + L::absolute(x.hi) * kExactParameter) &
                certain(sy, error + centerY_ + L::absolute(y.hi) * kExactParameter) & certain(z, depthError) &
                (L::absolute(x.hi) < band_.x) & (L::absolute(y.hi) < band_.y);
      r.behind = reach < D{};
      return r;
    }
    const D perW = 1.0 / w.hi;
    const D t = reach * L::absolute(perW);
    const Pair<D> qx = quotient(x, w, perW), qy = quotient(y, w, perW);
    const Pair<D> qz = quotient({D{} + k_.depthScale.hi, D{} + k_.depthScale.lo}, w, perW);
    const Pair<D> sx = add(k_.centerX, qx), sy = add(k_.centerY, qy), z = add(k_.depthOffset, qz);
    const D relativeW = t * perTq_;
    const D absX = L::absolute(qx.hi), absY = L::absolute(qy.hi), absZ = L::absolute(qz.hi);
    const D errorX = t * perT_ + absX * (relativeW + kExactParameter) + centerX_;
    const D errorY = t * perT_ + absY * (relativeW + kExactParameter) + centerY_;
    const D errorZ = absZ * (relativeW + kExactParameter) + offset_;
    r.x = sx.hi;
    r.y = sy.hi;
    r.depth = z.hi;
    const D size = L::absolute(w.hi);
    const M sure = inRange & (size > kSignUncertaintyExact * reach);
    r.behind = sure & (w.hi < D{});
    r.valid = sure & (w.hi > D{}) & certain(sx, errorX) & certain(sy, errorY) & certain(z, errorZ) & (absX < band_.x) &
              (absY < band_.y);
    return r;
  }

 private:
  static Pair<D> sum(D a, D b) {
    const D s = a + b;
    const D part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  static Pair<D> quickSum(D a, D b) {
    const D s = a + b;
    return {s, b - (s - a)};
  }
  static Pair<D> product(D a, D b) {
    const D p = a * b;
    return {p, L::productError(a, b, p)};
  }

  /// row . d + residual, to 128 u^2 of the sum of sizes.
  static Pair<D> dot(const DDVec3& row, const Pair<D>* d, const DoubleDouble& residual) {
    const Pair<D> p0 = product(D{} + row.x.hi, d[0].hi);
    const Pair<D> p1 = product(D{} + row.y.hi, d[1].hi);
    const Pair<D> p2 = product(D{} + row.z.hi, d[2].hi);
    const Pair<D> s = sum(p0.hi, p1.hi);
    const Pair<D> t = sum(s.hi, p2.hi);
    const D errors = ((p0.lo + p1.lo) + s.lo) + (p2.lo + t.lo);
    const D crossed = (row.x.hi * d[0].lo + row.x.lo * d[0].hi) + (row.y.hi * d[1].lo + row.y.lo * d[1].hi) +
                      (row.z.hi * d[2].lo + row.z.lo * d[2].hi);
    const Pair<D> result = quickSum(t.hi, errors + crossed);
    if constexpr (!HasResidual) return result;
    const Pair<D> shifted = sum(result.hi, D{} + residual.hi);
    return quickSum(shifted.hi, shifted.lo + (result.lo + residual.lo));
  }

  /// a / w, given 1 / w.hi.
  static Pair<D> quotient(const Pair<D>& a, const Pair<D>& w, D perW) {
    const D q = a.hi * perW;
    const Pair<D> back = product(q, w.hi);
    const D rest = ((a.hi - back.hi) - back.lo) + (a.lo - q * w.lo);
    return quickSum(q, rest * perW);
  }

  static Pair<D> times(const DoubleDouble& a, const Pair<D>& b) {
    const Pair<D> p = product(D{} + a.hi, b.hi);
    return quickSum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
  }

  static Pair<D> add(const DoubleDouble& a, const Pair<D>& b) {
    const Pair<D> s = sum(D{} + a.hi, b.hi);
    return quickSum(s.hi, s.lo + (b.lo + a.lo));
  }

  /// Ziv's test: every number within the error rounds to the same double.
  static M certain(const Pair<D>& value, D error) {
    return (value.hi + (value.lo + error) == value.hi) & (value.hi + (value.lo - error) == value.hi);
  }

  const ProjectionConstants& k_;
  Band band_;
  double perT_, perTq_, centerX_, centerY_, offset_, reach_;
};

/// The unit direction of the ray through a screen position, in double.
template <class L>
class RayFormula {
 public:
  using D = typename L::D;

  explicit RayFormula(const ProjectionConstants& k) : k_(k) {}

  struct Direction {
    D x, y, z, squaredLength;
  };

  Direction operator()(D px, D py) const {
    const D a = offsetFrom(k_.centerX, px);
    const D b = offsetFrom(k_.centerY, py);
    const D x = k_.rayW.x + (a * k_.rayX.x + b * k_.rayY.x);
    const D y = k_.rayW.y + (a * k_.rayX.y + b * k_.rayY.y);
    const D z = k_.rayW.z + (a * k_.rayX.z + b * k_.rayY.z);
    const D squared = x * x + y * y + z * z;
    const D length = L::squareRoot(squared);
    return {x / length, y / length, z / length, squared};
  }

 private:
  /// value - center, rounded once.
  static D offsetFrom(const DoubleDouble& center, D value) {
    const D difference = value - center.hi;
    const D part = difference - value;
    const D error = (value - (difference - part)) + ((D{} - center.hi) - part);
    return difference + (error - center.lo);
  }

  const ProjectionConstants& k_;
};

}  // namespace
}  // namespace viewproj
