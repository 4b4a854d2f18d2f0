// The truth of scene.hpp for points that may cancel: what is left below the noise of 480 bits is 0, and the side of the
// eye plane is exact.
#pragma once

#include <utility>

#include "reference/scene.hpp"

namespace reference {

/// A true value: the nearest double, and the double nearest the rest.
struct TrueNumber {
  TrueNumber() = default;
  explicit TrueNumber(const Real& value) : hi(double(value)) {
    if (std::isfinite(hi)) lo = double(value - Real(hi));
  }
  double hi = 0, lo = 0;
};

/// |got - truth|: to 51 bits, because a got other than hi is at least twice as far from it as lo.
inline double errorOf(double got, const TrueNumber& truth) {
  if (got == truth.hi) return std::isfinite(got) ? std::fabs(truth.lo) : 0;
  const double error = std::fabs((got - truth.hi) - truth.lo);
  return std::isnan(error) ? INFINITY : error;
}

/// +1, 0 or -1: the exact side of the eye plane that the point lies on, for poses of kind target, direction and
/// cameraFromWorld: a polynomial of doubles in as many bits as it can need. 2 for the other kinds.
inline int exactSide(const Scene& s, const viewproj::Vec3& point) {
  const bool isMatrix = s.poseKind == PoseKind::cameraFromWorld;
  if (!isMatrix && s.poseKind != PoseKind::target && s.poseKind != PoseKind::direction) return 2;
  // A difference of doubles fits in 2100 bits, a product of two in 4200, a sum of four in 4202.
  const mpfr_prec_t before = std::exchange(Real::bits, 4400);
  const std::size_t row = s.axes == viewproj::CameraAxes::FRU ? 0 : 2;
  Real3 way = toReal(s.target), offset = toReal(point);
  if (s.poseKind == PoseKind::target) way = way - toReal(s.position);
  if (isMatrix)
    way = {s.matrix[row][0], s.matrix[row][1], s.matrix[row][2]};
  else
    offset = offset - toReal(s.position);
  const Real sum = dot(way, offset) + Real(isMatrix ? s.matrix[row][3] : 0);
  Real::bits = before;
  const int sign = sum.sign() > 0 ? 1 : sum.sign() < 0 ? -1 : 0;
  return isMatrix && s.axes == viewproj::CameraAxes::RUB ? -sign : sign;
}

class Oracle {
 public:
  explicit Oracle(const Truth& truth) : t_(truth) {}

  struct Answer {
    bool undecided = false;  ///< so near the eye plane that exactSide tells the side, and the rest is not filled in
    bool inFront = false;
    int side = 0;
    TrueNumber x, y, depth, forward;
  };

  Answer at(const viewproj::Vec3& point) const {
    const Real3 d = toReal(point) - t_.pose.eye;
    Truth::View view = t_.view(toReal(point));
    const Real terms = sizeOf(t_.pose.forward, d);
    Answer answer;
    const bool isDecided = !(abs(view.forward) < terms * kNoise);
    if (!isDecided && !t_.lens.orthographic) {
      answer.undecided = true;
      answer.side = exactSide(t_.scene, point);
      answer.inFront = answer.side > 0;
      return answer;
    }
    if (!isDecided) view.forward = 0;
    answer.forward = TrueNumber(view.forward);
    answer.inFront = t_.lens.orthographic || view.forward.sign() > 0;
    if (!answer.inFront) return answer;
    const Real w = t_.lens.orthographic ? Real(1) : view.forward;
    const Truth::Screen screen = t_.screen(view), center = t_.screen({0, 0, Real(1)}),
                        unit = t_.screen({w, w, view.forward});
    const auto coordinate = [&](const Real& value, const Real& middle, const Real& perWindow, const Real3& axis) {
      return TrueNumber(orZero(value, abs(middle) + abs((perWindow - middle) / w) * (sizeOf(axis, d) + terms)));
    };
    answer.x = coordinate(screen.x, center.x, unit.x, t_.pose.right);
    answer.y = coordinate(screen.y, center.y, unit.y, t_.pose.up);
    answer.depth = TrueNumber(depth(view.forward, terms));
    return answer;
  }

  /// The unit direction of the ray through a screen position.
  std::array<TrueNumber, 3> direction(const viewproj::Vec2& pixel) const {
    const Truth::Window w = t_.lens.orthographic ? Truth::Window{0, 0} : t_.window(pixel.x, pixel.y);
    const TruePose& pose = t_.pose;
    Real3 d = t_.direction(w);
    for (std::size_t i = 0; i < 3; ++i)
      d[i] =
          orZero(d[i], abs(pose.rightColumn[i] * w.right) + abs(pose.upColumn[i] * w.up) + abs(pose.forwardColumn[i]));
    d = unit(d);
    return {TrueNumber(d[0]), TrueNumber(d[1]), TrueNumber(d[2])};
  }

 private:
  static constexpr double kNoise = 0x1p-400;

  static Real sizeOf(const Real3& a, const Real3& b) { return abs(a[0] * b[0]) + abs(a[1] * b[1]) + abs(a[2] * b[2]); }
  static Real orZero(const Real& value, const Real& size) { return abs(value) < size * Real(kNoise) ? Real(0) : value; }

  /// In two parts, near's and far's, of which each keeps its digits.
  Real depth(const Real& w, const Real& terms) const {
    const viewproj::Viewport& port = t_.scene.viewport;
    const bool reversed = t_.scene.convention.reverseZ;
    const Real atNear = reversed ? port.depthSecond : port.depthFirst,
               atFar = reversed ? port.depthFirst : port.depthSecond;
    const bool isInfinite = std::isinf(t_.scene.far);
    const Real n = t_.scene.near, f = isInfinite ? 0 : t_.scene.far;
    const Real beyondNear = orZero(w - n, terms + abs(n)), beforeFar = orZero(f - w, terms + abs(f));
    const Real scale = t_.lens.orthographic ? f - n : isInfinite ? w : (f - n) * w;
    const Real farPart = atFar * beyondNear * (t_.lens.orthographic || isInfinite ? Real(1) : f) / scale;
    const Real nearPart = atNear * (isInfinite ? n : t_.lens.orthographic ? beforeFar : n * beforeFar) / scale;
    return orZero(farPart + nearPart, abs(farPart) + abs(nearPart));
  }

  const Truth& t_;
};

}  // namespace reference
