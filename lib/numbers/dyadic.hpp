// Exact sums and products of doubles over their whole range.
//
// An expansion (expansion.hpp) is exact while no product overflows or underflows. A discriminant multiplies six
// coordinates, any of which may be 1e150 or 1e-150: here they are integers of up to 12,700 bits with an exponent.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "numbers/wide.hpp"

namespace viewproj {

/// An integer times a power of two. Has the interface of Certified (certified.hpp), so that one formula serves both.
class Dyadic {
 public:
  /// Products may have this many factors.
  static constexpr int kDegree = 6;

  Dyadic() = default;
  Dyadic(double value) noexcept : negative_(value < 0) {  // NOLINT: a finite double is exact
    if (value == 0) return;
    int power = 0;
    const auto bits = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::fabs(value), &power), 53));
    power -= 53;
    const int shift = ((power % 32) + 32) % 32;
    position_ = (power - shift) / 32;
    const std::uint64_t low = bits << shift;
    limbs_[0] = static_cast<std::uint32_t>(low);
    limbs_[1] = static_cast<std::uint32_t>(low >> 32);
    limbs_[2] = static_cast<std::uint32_t>(shift == 0 ? 0 : bits >> (64 - shift));
    size_ = 3;
    trim();
  }

  static Dyadic difference(double a, double b) noexcept { return Dyadic(a) - Dyadic(b); }

  static bool isWithin(double) noexcept { return true; }
  static bool isCertain() noexcept { return true; }
  int sign() const noexcept { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

  /// Within 2^-104 relative.
  Wide rounded() const noexcept {
    DoubleDouble sum;
    int power = 0;
    for (int i = size_ - 1; i >= 0 && i >= size_ - 5; --i, power -= 32)
      sum += DoubleDouble(std::ldexp(double(limbs_[std::size_t(i)]), power));
    return {negative_ ? -sum : sum, 32 * (position_ + size_ - 1)};
  }

  friend Dyadic operator-(const Dyadic& a) noexcept {
    Dyadic negated = a;
    negated.negative_ = !a.negative_;
    return negated;
  }

  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) noexcept {
    if (a.size_ == 0) return b;
    if (b.size_ == 0) return a;
    const bool subtract = a.negative_ != b.negative_;
    const bool swap = subtract && isSmaller(a, b);
    const Dyadic& first = swap ? b : a;
    const Dyadic& second = swap ? a : b;
    Dyadic sum;
    sum.negative_ = first.negative_;
    sum.position_ = std::min(a.position_, b.position_);
    const int end = std::max(a.end(), b.end());
    std::int64_t carry = 0;
    for (int p = sum.position_; p < end; ++p) {
      const auto limb = std::int64_t{second.limbAt(p)};
      carry += std::int64_t{first.limbAt(p)} + (subtract ? -limb : limb);
      sum.append(static_cast<std::uint32_t>(carry));
      carry >>= 32;
    }
    if (carry != 0) sum.append(static_cast<std::uint32_t>(carry));
    sum.trim();
    return sum;
  }

  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) noexcept { return a + (-b); }

  friend Dyadic operator*(const Dyadic& a, const Dyadic& b) noexcept {
    Dyadic product;
    if (a.size_ == 0 || b.size_ == 0) return product;
    product.negative_ = a.negative_ != b.negative_;
    product.position_ = a.position_ + b.position_;
    for (int i = 0; i < a.size_ + b.size_; ++i) product.append(0);
    for (int i = 0; i < a.size_; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; j < b.size_; ++j) {
        std::uint32_t& limb = product.limbs_[std::size_t(i + j)];
        carry += std::uint64_t{a.limbs_[std::size_t(i)]} * b.limbs_[std::size_t(j)] + limb;
        limb = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      product.limbs_[std::size_t(i + b.size_)] = static_cast<std::uint32_t>(carry);
    }
    product.trim();
    return product;
  }

 private:
  // A double's bits lie in limbs -34 to 31, and a sum may carry.
  static constexpr int kCapacity = 66 * kDegree + 4;

  int end() const noexcept { return position_ + size_; }

  std::uint32_t limbAt(int position) const noexcept {
    return position < position_ || position >= end() ? 0 : limbs_[std::size_t(position - position_)];
  }

  void append(std::uint32_t limb) noexcept { limbs_[std::size_t(size_++)] = limb; }

  /// Without zeros at either end.
  void trim() noexcept {
    while (size_ > 0 && limbs_[std::size_t(size_ - 1)] == 0) --size_;
    int zeros = 0;
    while (zeros < size_ && limbs_[std::size_t(zeros)] == 0) ++zeros;
    if (zeros == 0) return;
    for (int i = zeros; i < size_; ++i) limbs_[std::size_t(i - zeros)] = limbs_[std::size_t(i)];
    size_ -= zeros;
    position_ += zeros;
  }

  /// |a| < |b|.
  static bool isSmaller(const Dyadic& a, const Dyadic& b) noexcept {
    if (a.end() != b.end()) return a.end() < b.end();
    for (int p = a.end() - 1; p >= std::min(a.position_, b.position_); --p)
      if (a.limbAt(p) != b.limbAt(p)) return a.limbAt(p) < b.limbAt(p);
    return false;
  }

  std::array<std::uint32_t, kCapacity> limbs_;  // least significant first
  int size_ = 0;
  int position_ = 0;  // limbs_[0] counts 2^(32 position)
  bool negative_ = false;
};

}  // namespace viewproj
