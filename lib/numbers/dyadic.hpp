// Exact sums and products of doubles: integers of many bits times a power of two.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "numbers/wide.hpp"

namespace viewproj::detail {

/// A sum of products of Degree doubles each. The doubles are below 2^320 in magnitude and may be as small as any
/// double, without loss. NaN if a sum needs more limbs than there are, or from an infinity or NaN. Has the interface of
/// Certified (certified.hpp), so that one formula can use both.
template <int Degree>
class Dyadic {
 public:
  Dyadic() noexcept {}
  Dyadic(const Dyadic& a) noexcept { copy(a); }
  Dyadic& operator=(const Dyadic& a) noexcept {
    copy(a);
    return *this;
  }
  template <int Other>
  requires(Other != Degree) explicit(Other > Degree)
      Dyadic(const Dyadic<Other>& a) noexcept {  // NOLINT: implicit if it always fits
    copy(a);
  }
  /// The sum of limbs[i] * 2^(32 (position + i)).
  Dyadic(int position, std::initializer_list<std::uint32_t> limbs) noexcept
      : size_(static_cast<int>(limbs.size())), position_(position) {
    std::copy(limbs.begin(), limbs.end(), limbs_.begin());
    trim();
  }
  Dyadic(double value) noexcept : negative_(value < 0) {  // NOLINT: a finite double is exact
    isNan_ = !std::isfinite(value);
    if (value == 0 || isNan_) return;
    auto bits = std::bit_cast<std::uint64_t>(std::fabs(value));
    const int exponent = static_cast<int>(bits >> 52), power = std::max(exponent, 1) - 1075;
    bits = (bits & 0xfffffffffffff) | std::uint64_t{exponent != 0} << 52;
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

  /// Relative error at most 2^-104.
  Wide rounded() const noexcept {
    if (isNan_) return {kNaN, 0};
    // The first five limbs. Each is below the last place of the one before.
    double part[5] = {}, power = 1;
    for (int i = size_ - 1, k = 0; i >= 0 && k < 5; --i, ++k, power *= 0x1p-32)
      part[k] = double(limbs_[std::size_t(i)]) * power;
    const DoubleDouble first = quickTwoSum(part[0], part[1]), second = quickTwoSum(part[2], part[3]);
    const DoubleDouble middle = twoSum(first.lo, second.hi), high = quickTwoSum(first.hi, middle.hi);
    const DoubleDouble sum = quickTwoSum(high.hi, high.lo + (middle.lo + (second.lo + part[4])));
    return {negative_ ? -sum : sum, 32 * (position_ + size_ - 1)};
  }

  /// Drops the digits below 2^(32 position): rounds towards zero.
  Dyadic truncated(int position) const noexcept {
    Dyadic result = *this;
    const int cut = std::clamp(position - position_, 0, size_);
    std::copy(limbs_.begin() + cut, limbs_.begin() + size_, result.limbs_.begin());
    result.size_ = size_ - cut;
    result.position_ = position_ + cut;
    result.trim();
    return result;
  }

  /// The quotient, truncated in the same way.
  Dyadic dividedBy(std::uint32_t divisor, int position) const noexcept {
    Dyadic quotient;
    quotient.negative_ = negative_;
    quotient.position_ = position;
    quotient.size_ = std::max(0, end() - position);
    if (isNan_ || quotient.size_ > kCapacity) return nan();
    std::uint64_t rest = 0;
    for (int p = end(); p-- > position; rest %= divisor) {
      rest = rest << 32 | (p < position_ ? 0 : limbs_[std::size_t(p - position_)]);
      quotient.limbs_[std::size_t(p - position)] = static_cast<std::uint32_t>(rest / divisor);
    }
    quotient.trim();
    return quotient;
  }

  friend Dyadic operator-(const Dyadic& a) noexcept {
    Dyadic negated = a;
    negated.negative_ = !a.negative_;
    return negated;
  }

  /// a + b, or a - b.
  template <int A, int B>
  static Dyadic sum(const Dyadic<A>& a, const Dyadic<B>& b, bool minus) noexcept {
    if (a.isNan_ || b.isNan_) return nan();
    const bool bNegative = b.negative_ != minus;
    if (a.size_ == 0 || b.size_ == 0) {
      Dyadic result = a.size_ == 0 ? Dyadic(b) : Dyadic(a);
      if (a.size_ == 0) result.negative_ = bNegative;
      return result;
    }
    const bool subtract = a.negative_ != bNegative;
    return subtract && isSmaller(a, b) ? combined(b, a, true, bNegative) : combined(a, b, subtract, a.negative_);
  }

  template <int A, int B>
  static Dyadic product(const Dyadic<A>& a, const Dyadic<B>& b) noexcept {
    Dyadic result;
    result.isNan_ = a.isNan_ || b.isNan_ || a.size_ + b.size_ > kCapacity;
    if (a.size_ == 0 || b.size_ == 0 || result.isNan_) return result;
    result.negative_ = a.negative_ != b.negative_;
    result.position_ = a.position_ + b.position_;
    result.size_ = a.size_ + b.size_;
    std::fill_n(result.limbs_.begin(), result.size_, 0u);
    for (int i = 0; i < a.size_; ++i) {
      std::uint64_t carry = 0;
      std::uint32_t* const at = &result.limbs_[std::size_t(i)];
      for (int j = 0; j < b.size_; ++j) {
        carry += std::uint64_t{a.limbs_[std::size_t(i)]} * b.limbs_[std::size_t(j)] + at[j];
        at[j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      at[b.size_] = static_cast<std::uint32_t>(carry);
    }
    result.trim();
    return result;
  }

 private:
  template <int Other>
  friend class Dyadic;

  // A double's bits lie in limbs -34 to 9. A sum may carry into more.
  static constexpr int kCapacity = 44 * Degree + 4;

  static Dyadic nan() noexcept { return Dyadic(kNaN); }

  template <int Other>
  void copy(const Dyadic<Other>& a) noexcept {
    isNan_ = a.isNan_ || a.size_ > kCapacity;
    size_ = isNan_ ? 0 : a.size_;
    position_ = a.position_;
    negative_ = a.negative_;
    std::copy_n(a.limbs_.begin(), size_, limbs_.begin());
  }

  int end() const noexcept { return position_ + size_; }

  /// |first| + |second|, or |first| - |second|, which must not be negative.
  template <int A, int B>
  static Dyadic combined(const Dyadic<A>& first, const Dyadic<B>& second, bool subtract, bool negative) noexcept {
    const int low = std::min(first.position_, second.position_), high = std::max(first.end(), second.end());
    if (high - low >= kCapacity) return nan();
    Dyadic result;
    result.negative_ = negative;
    result.position_ = low;
    result.size_ = high - low;
    const auto start = result.limbs_.begin();
    std::fill_n(start, first.position_ - low, 0u);
    std::copy_n(first.limbs_.begin(), first.size_, start + (first.position_ - low));
    std::fill_n(start + (first.end() - low), high - first.end(), 0u);
    std::int64_t carry = 0;
    int i = second.position_ - low;
    for (int j = 0; j < second.size_; ++j, ++i, carry >>= 32) {
      const auto limb = std::int64_t{second.limbs_[std::size_t(j)]};
      carry += std::int64_t{result.limbs_[std::size_t(i)]} + (subtract ? -limb : limb);
      result.limbs_[std::size_t(i)] = static_cast<std::uint32_t>(carry);
    }
    for (; carry != 0 && i < result.size_; ++i, carry >>= 32) {
      carry += result.limbs_[std::size_t(i)];
      result.limbs_[std::size_t(i)] = static_cast<std::uint32_t>(carry);
    }
    if (carry != 0) result.limbs_[std::size_t(result.size_++)] = static_cast<std::uint32_t>(carry);
    result.trim();
    return result;
  }

  /// Removes zero limbs at both ends.
  void trim() noexcept {
    while (size_ > 0 && limbs_[std::size_t(size_ - 1)] == 0) --size_;
    int zeros = 0;
    while (zeros < size_ && limbs_[std::size_t(zeros)] == 0) ++zeros;
    if (zeros == 0) return;
    std::copy(limbs_.begin() + zeros, limbs_.begin() + size_, limbs_.begin());
    size_ -= zeros;
    position_ += zeros;
  }

  /// Whether |a| < |b|.
  template <int A, int B>
  static bool isSmaller(const Dyadic<A>& a, const Dyadic<B>& b) noexcept {
    const auto endOfA = a.end(), endOfB = b.end();
    if (endOfA != endOfB) return endOfA < endOfB;
    const int common = std::min(a.size_, b.size_);
    for (int i = 1; i <= common; ++i) {
      const std::uint32_t ofA = a.limbs_[std::size_t(a.size_ - i)], ofB = b.limbs_[std::size_t(b.size_ - i)];
      if (ofA != ofB) return ofA < ofB;
    }
    return a.size_ < b.size_;  // neither has a zero limb at its end
  }

  std::array<std::uint32_t, kCapacity> limbs_;  // least significant first
  int size_ = 0;
  int position_ = 0;  // limbs_[0] counts multiples of 2^(32 position)
  bool negative_ = false, isNan_ = false;
};

template <int A, int B>
Dyadic<std::max(A, B)> operator+(const Dyadic<A>& a, const Dyadic<B>& b) noexcept {
  return Dyadic<std::max(A, B)>::sum(a, b, false);
}
template <int A, int B>
Dyadic<std::max(A, B)> operator-(const Dyadic<A>& a, const Dyadic<B>& b) noexcept {
  return Dyadic<std::max(A, B)>::sum(a, b, true);
}
template <int A, int B>
Dyadic<A + B> operator*(const Dyadic<A>& a, const Dyadic<B>& b) noexcept {
  return Dyadic<A + B>::product(a, b);
}

/// Adds one product after the other, so that only one is in memory.
template <int A, int B>
Dyadic<A + B> dot(const Vector3<Dyadic<A>>& a, const Vector3<Dyadic<B>>& b) noexcept {
  Dyadic<A + B> sum;
  for (std::size_t i = 0; i < 3; ++i) sum = sum + a[i] * b[i];
  return sum;
}

inline Vector3<Dyadic<1>> toDyadic(const Vec3& a) noexcept { return {a.x, a.y, a.z}; }

template <int Degree>
WideVec3 rounded(const Vector3<Dyadic<Degree>>& a) noexcept {
  return {a.x.rounded(), a.y.rounded(), a.z.rounded()};
}

}  // namespace viewproj::detail
