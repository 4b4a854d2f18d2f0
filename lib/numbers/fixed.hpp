// Numbers of 224 bits behind the point: for sines, cosines and their products, whose own size does not matter but
// whose sums must cancel rightly.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "numbers/expansion.hpp"

namespace viewproj {

/// A multiple of kStep between -2^31 and 2^31. Sums are exact; products, quotients and conversions drop what is below a
/// step, towards zero.
class Fixed {
 public:
  static constexpr std::size_t kLimbs = 8;
  static constexpr double kStep = 0x1p-224;
  using Limbs = std::array<std::uint32_t, kLimbs>;

  Fixed() = default;
  /// Least significant first, two's complement; the last is the whole part.
  explicit consteval Fixed(const Limbs& limbs) : limbs_(limbs) {}  // uncounted: never at run time
  Fixed(double value) noexcept {  // NOLINT: a double with no bits below a step is exact
    double rest = std::fabs(value), unit = 1;
    for (std::size_t i = kLimbs; i-- > 0; unit *= 0x1p-32) {
      const double count = std::floor(rest / unit);
      limbs_[i] = static_cast<std::uint32_t>(count);
      rest -= count * unit;
    }
    if (value < 0) *this = -*this;
  }

  bool isZero() const noexcept { return limbs_ == Limbs{}; }
  bool isNegative() const noexcept { return limbs_.back() >> 31 != 0; }

  friend Fixed operator-(const Fixed& a) noexcept {
    Fixed negated;
    std::uint64_t carry = 1;
    for (std::size_t i = 0; i < kLimbs; ++i, carry >>= 32) {
      carry += static_cast<std::uint32_t>(~a.limbs_[i]);
      negated.limbs_[i] = static_cast<std::uint32_t>(carry);
    }
    return negated;
  }

  friend Fixed operator+(const Fixed& a, const Fixed& b) noexcept {
    Fixed sum;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < kLimbs; ++i, carry >>= 32) {
      carry += std::uint64_t{a.limbs_[i]} + b.limbs_[i];
      sum.limbs_[i] = static_cast<std::uint32_t>(carry);
    }
    return sum;
  }

  friend Fixed operator-(const Fixed& a, const Fixed& b) noexcept { return a + (-b); }

  friend Fixed operator*(const Fixed& a, const Fixed& b) noexcept {
    const Limbs x = a.magnitude().limbs_, y = b.magnitude().limbs_;
    std::array<std::uint32_t, 2 * kLimbs> full{};
    for (std::size_t i = 0; i < kLimbs; ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < kLimbs; ++j, carry >>= 32) {
        carry += std::uint64_t{x[i]} * y[j] + full[i + j];
        full[i + j] = static_cast<std::uint32_t>(carry);
      }
      full[i + kLimbs] = static_cast<std::uint32_t>(carry);
    }
    Fixed product;
    for (std::size_t i = 0; i < kLimbs; ++i) product.limbs_[i] = full[i + kLimbs - 1];
    return a.isNegative() != b.isNegative() ? -product : product;
  }

  Fixed dividedBy(std::uint32_t divisor) const noexcept {
    Fixed quotient = magnitude();
    std::uint64_t rest = 0;
    for (std::size_t i = kLimbs; i-- > 0;) {
      rest = rest << 32 | quotient.limbs_[i];
      quotient.limbs_[i] = static_cast<std::uint32_t>(rest / divisor);
      rest %= divisor;
    }
    return isNegative() ? -quotient : quotient;
  }

  /// Exact.
  Expansion<kLimbs> expansion() const noexcept {
    const Limbs parts = magnitude().limbs_;
    Expansion<kLimbs> sum;
    double unit = isNegative() ? -1 : 1;
    for (std::size_t i = kLimbs; i-- > 0; unit *= 0x1p-32)
      if (parts[i] != 0) sum.add(unit * parts[i]);
    return sum;
  }

 private:
  Fixed magnitude() const noexcept { return isNegative() ? -*this : *this; }

  Limbs limbs_{};
};

}  // namespace viewproj
