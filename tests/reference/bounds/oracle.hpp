// The truth for many points of one camera: what scene.hpp's Truth says, with the camera's part done once.
//
// Truth's rows, eye and window, in 480 bits, are rounded to `bits` here. Every step keeps the exponents of its terms,
// so that what is left after a cancellation is known to be noise or not: a number below its noise is 0, and a distance
// that cancels by more than half of the bits is undecided, and to be asked of an oracle of more bits. 256 bits
// therefore cost nothing: a decided W has 128 true bits, twice what the bounds under test distinguish.
#pragma once

#include <mpfr.h>

#include <memory>
#include <vector>

#include "reference/scene.hpp"

namespace reference {

/// A true value: the nearest double, and the double nearest the rest.
struct TrueNumber {
  double hi = 0, lo = 0;
};

/// |got - truth|: to 51 bits, because a got other than hi is at least twice as far from it as lo.
inline double errorOf(double got, const TrueNumber& truth) {
  if (got == truth.hi) return std::isfinite(got) ? std::fabs(truth.lo) : 0;
  const double error = std::fabs((got - truth.hi) - truth.lo);
  return std::isnan(error) ? INFINITY : error;
}

class Oracle {
 public:
  Oracle(const Truth& truth, mpfr_prec_t bits);

  struct Answer {
    bool undecided = false;  ///< forward cancels by more than half of the bits: the rest is not filled in
    bool inFront = false;
    TrueNumber x, y, depth, forward;
  };
  Answer at(const viewproj::Vec3& point);

  /// The unit direction of the ray through a screen position.
  std::array<TrueNumber, 3> direction(const viewproj::Vec2& pixel);

 private:
  class Number {
   public:
    explicit Number(mpfr_prec_t bits) { mpfr_init2(value_, bits); }
    Number(const Number&) = delete;
    Number& operator=(const Number&) = delete;
    ~Number() { mpfr_clear(value_); }
    operator mpfr_ptr() { return value_; }

   private:
    mpfr_t value_;
  };

  /// sum = row . d_; the largest exponent of the three terms.
  mpfr_exp_t dot(mpfr_ptr* row, mpfr_ptr sum);
  TrueNumber rounded(mpfr_ptr value, mpfr_exp_t noise);
  TrueNumber screenCoordinate(mpfr_ptr center, mpfr_ptr numerator, mpfr_exp_t terms);
  mpfr_ptr number(const Real& value, mpfr_prec_t bits = 0);

  mpfr_prec_t bits_;
  std::vector<std::unique_ptr<Number>> numbers_;
  bool orthographic_, infiniteFar_;
  mpfr_ptr eye_[3], x_[3], y_[3], w_[3], centerX_, centerY_, near_, far_, nearShare_, farShare_;
  mpfr_ptr rayRight_[3], rayUp_[3], rayForward_[3], cornerRight_, cornerUp_, perPixelRight_, perPixelUp_;
  mpfr_ptr d_[3], term_[3], numeratorX_, numeratorY_, forward_, inverse_, a_, b_, rest_;
  mpfr_exp_t forwardNoise_ = 0;
};

/// +1, 0 or -1: the exact side of the eye plane that the point lies on, for poses of kind target, direction and
/// cameraFromWorld: a polynomial of doubles in as many bits as it can need. 2 for the other kinds.
int exactSide(const Scene& scene, const viewproj::Vec3& point);

}  // namespace reference
