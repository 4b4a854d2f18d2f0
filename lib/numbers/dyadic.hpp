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
#include <initializer_list>

#include "numbers/expansion.hpp"
#include "numbers/wide.hpp"

namespace viewproj::detail {

/// An integer times a power of two. Has the interface of Certified (certified.hpp), so that one formula serves both.
class Dyadic {
 public:
  /// Products may have this many factors.
  static constexpr int kDegree = 6;

  Dyadic() noexcept {}
  /// The limbs that there are: a hundredth of all, mostly.
  Dyadic(const Dyadic& a) noexcept : size_(a.size_), position_(a.position_), negative_(a.negative_) {
    std::copy_n(a.limbs_.begin(), a.size_, limbs_.begin());
  }
  Dyadic& operator=(const Dyadic& a) noexcept {
    std::copy_n(a.limbs_.begin(), a.size_, limbs_.begin());
    size_ = a.size_;
    position_ = a.position_;
    negative_ = a.negative_;
    return *this;
  }
  /// The sum of limbs[i] 2^(32 (position + i)).
  Dyadic(int position, std::initializer_list<std::uint32_t> limbs) noexcept : position_(position) {
    for (const std::uint32_t limb : limbs) append(limb);
    trim();
  }
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

  /// Without what is below 2^(32 position): towards zero.
  Dyadic truncated(int position) const noexcept {
    Dyadic result;
    result.negative_ = negative_;
    result.position_ = std::max(position, position_);
    for (int p = result.position_; p < end(); ++p) result.append(limbAt(p));
    result.trim();
    return result;
  }

  /// The quotient, truncated likewise.
  Dyadic dividedBy(std::uint32_t divisor, int position) const noexcept {
    Dyadic quotient;
    quotient.negative_ = negative_;
    quotient.position_ = position;
    for (int p = position; p < end(); ++p) quotient.append(0);
    std::uint64_t rest = 0;
    for (int p = end(); p-- > position; rest %= divisor) {
      rest = rest << 32 | limbAt(p);
      quotient.limbs_[std::size_t(p - position)] = static_cast<std::uint32_t>(rest / divisor);
    }
    quotient.trim();
    return quotient;
  }

  /// Exact, of at most Terms limbs.
  template <std::size_t Terms>
  Expansion<Terms> expansion() const noexcept {
    Expansion<Terms> sum;
    for (int i = size_; i-- > 0;)
      sum.add(std::ldexp(negative_ ? -double(limbs_[std::size_t(i)]) : double(limbs_[std::size_t(i)]),
                         32 * (position_ + i)));
    return sum;
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

inline Vector3<Dyadic> toDyadic(const Vec3& a) noexcept { return {a.x, a.y, a.z}; }

}  // namespace viewproj::detail
