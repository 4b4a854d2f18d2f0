// Numbers of 480 bits, or as many as a verdict takes: what the tests call true.
#pragma once

#include <mpfr.h>

#include <array>
#include <cmath>
#include <vector>

namespace reference {

class Real {
 public:
  static constexpr mpfr_prec_t kBits = 480;
  /// Of numbers made from here on.
  static inline mpfr_prec_t bits = kBits;

  Real() : Real(0.0) {}
  Real(double value) : Real(Unset{bits}) {  // NOLINT: a double is exact
    mpfr_set_d(value_, value, MPFR_RNDN);
  }
  Real(const Real& other) : Real(Unset{mpfr_get_prec(other.value_)}) { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Real& operator=(const Real& other) {
    mpfr_set_prec(value_, mpfr_get_prec(other.value_));
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Real() {
    if (mpfr_get_prec(value_) == kBits)
      spare().push_back(*value_);
    else
      mpfr_clear(value_);
  }

  /// The nearest double.
  explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }

  mpfr_srcptr value() const { return value_; }
  int sign() const { return mpfr_sgn(value_); }

  friend Real operator+(const Real& a, const Real& b) { return with(a, b, mpfr_add); }
  friend Real operator-(const Real& a, const Real& b) { return with(a, b, mpfr_sub); }
  friend Real operator*(const Real& a, const Real& b) { return with(a, b, mpfr_mul); }
  friend Real operator/(const Real& a, const Real& b) { return with(a, b, mpfr_div); }
  friend Real operator-(const Real& a) { return Real(0) - a; }
  friend bool operator<(const Real& a, const Real& b) { return mpfr_cmp(a.value_, b.value_) < 0; }
  friend bool operator>(const Real& a, const Real& b) { return b < a; }
  friend bool operator<=(const Real& a, const Real& b) { return !(b < a); }

  friend Real sqrt(const Real& a) { return with(a, mpfr_sqrt); }
  friend Real abs(const Real& a) { return with(a, mpfr_abs); }

  static Real pi() {
    Real r(Unset{bits});
    mpfr_const_pi(r.value_, MPFR_RNDN);
    return r;
  }
  friend Real arctangent2(const Real& b, const Real& a) { return with(b, a, mpfr_atan2); }
  friend Real sine(const Real& a) { return with(a, mpfr_sin); }
  friend Real cosine(const Real& a) { return with(a, mpfr_cos); }
  friend Real tanDegrees(const Real& a) { return with(a * pi() / Real(180), mpfr_tan); }
  /// What the rounding of pi leaves of a zero counts as 0.
  friend Real sinDegrees(const Real& a) { return withoutNoise(with(within(a, 360) * pi() / Real(180), mpfr_sin), a); }
  friend Real cosDegrees(const Real& a) { return withoutNoise(with(within(a, 360) * pi() / Real(180), mpfr_cos), a); }

 private:
  struct Unset {
    mpfr_prec_t bits;
  };
  explicit Real(Unset of) {
    if (of.bits != kBits || spare().empty()) {
      mpfr_init2(value_, of.bits);
      return;
    }
    *value_ = spare().back();
    spare().pop_back();
  }
  /// Numbers of kBits that are not in use: most of the time would go into asking for memory.
  static std::vector<__mpfr_struct>& spare() {
    static auto* numbers = new std::vector<__mpfr_struct>;
    return *numbers;
  }

  template <class F>
  static Real with(const Real& a, const Real& b, F f) {
    Real r(Unset{bits});
    f(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }
  template <class F>
  static Real with(const Real& a, F f) {
    Real r(Unset{bits});
    f(r.value_, a.value_, MPFR_RNDN);
    return r;
  }

  /// What is left of whole turns: exact.
  static Real within(const Real& a, const Real& turn) { return with(a, turn, mpfr_remainder); }

  static Real withoutNoise(const Real& value, const Real& degrees) {
    return mpfr_zero_p(within(degrees, 90).value_) && abs(value) < Real(0.5) ? Real(0) : value;
  }

  mpfr_t value_;
};

Real sinDegrees(const Real& a);
Real cosDegrees(const Real& a);

using Real3 = std::array<Real, 3>;

inline Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Real3 cross(const Real3& a, const Real3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real3 operator+(const Real3& a, const Real3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Real3 operator-(const Real3& a, const Real3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Real3 operator*(const Real3& a, const Real& k) { return {a[0] * k, a[1] * k, a[2] * k}; }
inline Real length(const Real3& a) { return sqrt(dot(a, a)); }
inline Real3 unit(const Real3& a) { return a * (Real(1) / length(a)); }

/// |a - b| in radians, for small angles.
inline double angle(const Real3& a, const Real3& b) { return double(length(cross(unit(a), unit(b)))); }

/// |got - truth| in units of the spacing of doubles at truth.
inline double ulps(double got, const Real& truth) {
  const double nearest = std::fabs(double(truth));
  const double spacing = std::nextafter(nearest, INFINITY) - nearest;
  return double(abs(Real(got) - truth) / Real(spacing));
}

inline double distance(double got, const Real& truth) { return double(abs(Real(got) - truth)); }

}  // namespace reference
