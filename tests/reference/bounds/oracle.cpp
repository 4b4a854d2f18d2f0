#include "reference/bounds/oracle.hpp"

#include <algorithm>
#include <limits>

#include "internals.hpp"

namespace reference {

using namespace viewproj;
using namespace viewproj::detail;

namespace {

constexpr mpfr_exp_t kNothing = std::numeric_limits<mpfr_exp_t>::min() / 4;

/// Bits that a few roundings take.
constexpr mpfr_exp_t kSlack = 8;

mpfr_exp_t exponentOf(mpfr_srcptr value) { return mpfr_zero_p(value) ? kNothing : mpfr_get_exp(value); }

}  // namespace

mpfr_ptr Oracle::number(const Real& value, mpfr_prec_t bits) {
  numbers_.push_back(std::make_unique<Number>(bits ? bits : bits_));
  mpfr_set(*numbers_.back(), value.value(), MPFR_RNDN);
  return *numbers_.back();
}

Oracle::Oracle(const Truth& t, mpfr_prec_t bits)
    : bits_(bits), orthographic_(t.lens.orthographic), infiniteFar_(std::isinf(t.scene.far)) {
  const Viewport& port = t.scene.viewport;
  const bool down = port.origin == Origin::topLeft;
  const Real perWindowX = Real(port.width) / (t.lens.right - t.lens.left);
  const Real up = Real(port.height) / (t.lens.top - t.lens.bottom);
  const Real perWindowY = down ? -up : up;
  const Truth::Screen center = t.screen({0, 0, 1});
  for (std::size_t i = 0; i < 3; ++i) {
    eye_[i] = number(t.pose.eye[i], Real::kBits);
    x_[i] = number(t.pose.right[i] * perWindowX);
    y_[i] = number(t.pose.up[i] * perWindowY);
    w_[i] = number(t.pose.forward[i]);
    rayRight_[i] = number(t.pose.rightColumn[i]);
    rayUp_[i] = number(t.pose.upColumn[i]);
    rayForward_[i] = number(t.pose.forwardColumn[i]);
    d_[i] = number(0);
    term_[i] = number(0);
  }
  centerX_ = number(center.x);
  centerY_ = number(center.y);
  const Truth::Window corner = t.window(0, 0);
  cornerRight_ = number(corner.right);
  cornerUp_ = number(corner.up);
  perPixelRight_ = number(Real(1) / perWindowX);
  perPixelUp_ = number(Real(1) / perWindowY);
  // Linear in the inverse of the distance, or in orthographic in the distance:
  //   depth = (atNear n (f - w) + atFar f (w - n)) / ((f - n) w),   (atNear (f - w) + atFar (w - n)) / (f - n)
  const bool reversed = t.scene.convention.reverseZ;
  const Real atNear = reversed ? port.depthSecond : port.depthFirst;
  const Real atFar = reversed ? port.depthFirst : port.depthSecond;
  const Real n = t.scene.near, f = infiniteFar_ ? 0 : t.scene.far;
  near_ = number(n);
  far_ = number(f);
  nearShare_ = number(infiniteFar_ ? atNear * n : atNear * (orthographic_ ? Real(1) : n) / (f - n));
  farShare_ = number(infiniteFar_ ? atFar : atFar * (orthographic_ ? Real(1) : f) / (f - n));
  for (mpfr_ptr* scratch : {&numeratorX_, &numeratorY_, &forward_, &inverse_, &a_, &b_, &rest_}) *scratch = number(0);
}

mpfr_exp_t Oracle::dot(mpfr_ptr* row, mpfr_ptr sum) {
  mpfr_exp_t largest = kNothing;
  for (int i = 0; i < 3; ++i) {
    mpfr_mul(term_[i], row[i], d_[i], MPFR_RNDN);
    largest = std::max(largest, exponentOf(term_[i]));
  }
  mpfr_add(sum, term_[0], term_[1], MPFR_RNDN);
  mpfr_add(sum, sum, term_[2], MPFR_RNDN);
  return largest;
}

TrueNumber Oracle::rounded(mpfr_ptr value, mpfr_exp_t noise) {
  if (exponentOf(value) <= noise) return {};
  TrueNumber n;
  n.hi = mpfr_get_d(value, MPFR_RNDN);
  if (!std::isfinite(n.hi)) return n;
  mpfr_sub_d(rest_, value, n.hi, MPFR_RNDN);
  n.lo = mpfr_get_d(rest_, MPFR_RNDN);
  return n;
}

/// center + numerator / W, or center + numerator in orthographic; terms: the largest exponent of the numerator's.
TrueNumber Oracle::screenCoordinate(mpfr_ptr center, mpfr_ptr numerator, mpfr_exp_t terms) {
  mpfr_exp_t noise = terms - bits_;
  if (!orthographic_) {
    mpfr_mul(numerator, numerator, inverse_, MPFR_RNDN);
    // The numerator's noise over W, and W's own.
    const mpfr_exp_t perW = exponentOf(inverse_);
    noise = std::max(noise + perW, exponentOf(numerator) + forwardNoise_ + perW);
  }
  noise = std::max(noise, exponentOf(center) - bits_);
  mpfr_add(numerator, center, numerator, MPFR_RNDN);
  return rounded(numerator, noise + kSlack);
}

Oracle::Answer Oracle::at(const Vec3& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    mpfr_sub_d(d_[i], eye_[i], point[i], MPFR_RNDN);
    mpfr_neg(d_[i], d_[i], MPFR_RNDN);
  }
  Answer answer;
  const mpfr_exp_t terms = dot(w_, forward_);
  forwardNoise_ = terms - bits_;
  if (terms != kNothing && exponentOf(forward_) < terms - bits_ / 2) {
    answer.undecided = true;
    if (!orthographic_) return answer;
  }
  answer.forward = rounded(forward_, forwardNoise_ + kSlack);
  answer.inFront = orthographic_ || mpfr_sgn(forward_) > 0;
  if (!answer.inFront) return answer;
  answer.undecided = false;
  if (!orthographic_) mpfr_ui_div(inverse_, 1, forward_, MPFR_RNDN);
  const mpfr_exp_t termsX = dot(x_, numeratorX_);
  answer.x = screenCoordinate(centerX_, numeratorX_, termsX);
  const mpfr_exp_t termsY = dot(y_, numeratorY_);
  answer.y = screenCoordinate(centerY_, numeratorY_, termsY);

  // a_ is far's part of the depth, b_ near's.
  mpfr_sub(a_, forward_, near_, MPFR_RNDN);
  const mpfr_exp_t noise = std::max(forwardNoise_, exponentOf(near_) - bits_);
  if (exponentOf(a_) <= noise + kSlack) mpfr_set_zero(a_, 1);
  mpfr_mul(a_, a_, farShare_, MPFR_RNDN);
  if (infiniteFar_) {
    mpfr_set(b_, nearShare_, MPFR_RNDN);
  } else {
    mpfr_sub(b_, far_, forward_, MPFR_RNDN);
    if (exponentOf(b_) <= std::max(forwardNoise_, exponentOf(far_) - bits_) + kSlack) mpfr_set_zero(b_, 1);
    mpfr_mul(b_, b_, nearShare_, MPFR_RNDN);
  }
  if (!orthographic_) {
    mpfr_mul(a_, a_, inverse_, MPFR_RNDN);
    mpfr_mul(b_, b_, inverse_, MPFR_RNDN);
  }
  const mpfr_exp_t parts = std::max(exponentOf(a_), exponentOf(b_));
  mpfr_add(a_, a_, b_, MPFR_RNDN);
  answer.depth = rounded(a_, parts - bits_ / 2);
  return answer;
}

std::array<TrueNumber, 3> Oracle::direction(const Vec2& pixel) {
  if (orthographic_) {
    mpfr_set_zero(numeratorX_, 1);
    mpfr_set_zero(numeratorY_, 1);
  } else {
    mpfr_mul_d(numeratorX_, perPixelRight_, pixel.x, MPFR_RNDN);
    mpfr_add(numeratorX_, numeratorX_, cornerRight_, MPFR_RNDN);
    mpfr_mul_d(numeratorY_, perPixelUp_, pixel.y, MPFR_RNDN);
    mpfr_add(numeratorY_, numeratorY_, cornerUp_, MPFR_RNDN);
  }
  mpfr_set_zero(a_, 1);
  mpfr_exp_t noise[3];
  for (int i = 0; i < 3; ++i) {
    mpfr_mul(d_[i], rayRight_[i], numeratorX_, MPFR_RNDN);
    mpfr_mul(b_, rayUp_[i], numeratorY_, MPFR_RNDN);
    noise[i] = std::max({exponentOf(d_[i]), exponentOf(b_), exponentOf(rayForward_[i])}) - bits_ / 2;
    mpfr_add(d_[i], d_[i], b_, MPFR_RNDN);
    mpfr_add(d_[i], d_[i], rayForward_[i], MPFR_RNDN);
    if (exponentOf(d_[i]) <= noise[i]) mpfr_set_zero(d_[i], 1);
    mpfr_sqr(b_, d_[i], MPFR_RNDN);
    mpfr_add(a_, a_, b_, MPFR_RNDN);
  }
  mpfr_rec_sqrt(a_, a_, MPFR_RNDN);
  std::array<TrueNumber, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    mpfr_mul(d_[i], d_[i], a_, MPFR_RNDN);
    result[i] = rounded(d_[i], kNothing);
  }
  return result;
}

int exactSide(const Scene& s, const Vec3& point) {
  // A difference of doubles fits in 2100 bits, a product of two in 4200, a sum of four in 4202.
  constexpr mpfr_prec_t kEnough = 4400;
  mpfr_t row, difference, sum;
  mpfr_inits2(kEnough, row, difference, sum, static_cast<mpfr_ptr>(nullptr));
  mpfr_set_zero(sum, 1);
  const bool isMatrix = s.poseKind == PoseKind::cameraFromWorld;
  const bool isKnown = isMatrix || s.poseKind == PoseKind::target || s.poseKind == PoseKind::direction;
  const std::size_t forward = s.axes == CameraAxes::FRU ? 0 : 2;
  for (std::size_t i = 0; i < 3; ++i) {
    mpfr_set_d(row, isMatrix ? s.matrix[forward][i] : s.target[i], MPFR_RNDN);
    if (s.poseKind == PoseKind::target) mpfr_sub_d(row, row, s.position[i], MPFR_RNDN);
    mpfr_set_d(difference, point[i], MPFR_RNDN);
    if (!isMatrix) mpfr_sub_d(difference, difference, s.position[i], MPFR_RNDN);
    mpfr_mul(row, row, difference, MPFR_RNDN);
    mpfr_add(sum, sum, row, MPFR_RNDN);
  }
  if (isMatrix) mpfr_add_d(sum, sum, s.matrix[forward][3], MPFR_RNDN);
  const int sign = mpfr_sgn(sum) > 0 ? 1 : mpfr_sgn(sum) < 0 ? -1 : 0;
  mpfr_clears(row, difference, sum, static_cast<mpfr_ptr>(nullptr));
  if (!isKnown) return 2;
  return isMatrix && s.axes == CameraAxes::RUB ? -sign : sign;
}

}  // namespace reference
