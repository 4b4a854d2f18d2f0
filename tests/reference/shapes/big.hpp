// Numbers of as many bits as a verdict takes: MPFR says whether anything was rounded.
#pragma once

#include <mpfr.h>

#include <array>
#include <cmath>
#include <limits>

#include "viewproj/numbers/vectors.hpp"

namespace reference {

class Big {
 public:
  /// Of numbers made from here on.
  static inline mpfr_prec_t bits = 640;

  Big() : Big(0.0) {}
  Big(double value) {  // NOLINT: a double is exact
    mpfr_init2(value_, bits);
    mpfr_set_d(value_, value, MPFR_RNDN);
  }
  Big(const Big& other) {
    mpfr_init2(value_, mpfr_get_prec(other.value_));
    mpfr_set(value_, other.value_, MPFR_RNDN);
  }
  Big& operator=(const Big& other) {
    mpfr_set_prec(value_, mpfr_get_prec(other.value_));
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Big() { mpfr_clear(value_); }

  explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  int sign() const { return mpfr_sgn(value_); }

  friend Big operator+(const Big& a, const Big& b) { return with(a, b, mpfr_add); }
  friend Big operator-(const Big& a, const Big& b) { return with(a, b, mpfr_sub); }
  friend Big operator*(const Big& a, const Big& b) { return with(a, b, mpfr_mul); }
  friend Big operator/(const Big& a, const Big& b) { return with(a, b, mpfr_div); }
  friend Big operator-(const Big& a) { return Big(0) - a; }
  friend bool operator<(const Big& a, const Big& b) { return mpfr_cmp(a.value_, b.value_) < 0; }
  friend bool operator<=(const Big& a, const Big& b) { return !(b < a); }
  friend Big sqrt(const Big& a) {
    Big r;
    mpfr_sqrt(r.value_, a.value_, MPFR_RNDN);
    return r;
  }
  friend Big abs(const Big& a) { return a.sign() < 0 ? -a : a; }

 private:
  template <class F>
  static Big with(const Big& a, const Big& b, F f) {
    Big r;
    f(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }

  mpfr_t value_;
};

using Big3 = std::array<Big, 3>;

inline Big3 toBig(const viewproj::Vec3& v) { return {v.x, v.y, v.z}; }
inline Big dot(const Big3& a, const Big3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Big3 cross(const Big3& a, const Big3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Big3 operator+(const Big3& a, const Big3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Big3 operator-(const Big3& a, const Big3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Big3 operator*(const Big3& a, const Big& k) { return {a[0] * k, a[1] * k, a[2] * k}; }
inline Big length(const Big3& a) { return sqrt(dot(a, a)); }

/// Within `ulps` units in the last place (1 for subnormal numbers), or within `also`. What lies beyond the largest
/// double must be infinite.
inline bool isNear(double got, const Big& truth, double ulps, const Big& also) {
  const double nearest = double(truth);
  if (got == nearest) return true;
  if (!std::isfinite(got) || !std::isfinite(nearest)) return false;
  const double size = std::fabs(nearest);
  const Big ulp = Big(std::nextafter(size, std::numeric_limits<double>::infinity())) - Big(size);
  const Big error = abs(Big(got) - truth);
  return error <= ulp * Big(std::isnormal(nearest) ? ulps : 1) || error <= also;
}

}  // namespace reference
