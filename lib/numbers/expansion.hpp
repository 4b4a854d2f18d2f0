// Exact sums of products of doubles.
//
// Source: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997
// (grow-expansion with zero elimination). Exact inside the range that error_free.hpp states.
#pragma once

#include <cstddef>
#include <initializer_list>

#include "numbers/double_double.hpp"

namespace viewproj {

/// A number held exactly as the sum of up to Capacity non-overlapping doubles, smallest first.
template <std::size_t Capacity>
class Expansion {
 public:
  Expansion() = default;
  Expansion(std::initializer_list<double> values) noexcept {  // NOLINT: the sum of the values
    for (double value : values) add(value);
  }

  void add(double value) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const DoubleDouble sum = twoSum(value, terms_[i]);
      value = sum.hi;
      if (sum.lo != 0) terms_[kept++] = sum.lo;
    }
    if (value != 0) terms_[kept++] = value;
    count_ = kept;
  }

  void addProduct(double a, double b) noexcept {
    const DoubleDouble product = twoProd(a, b);
    add(product.lo);
    add(product.hi);
  }

  void addProduct(DoubleDouble a, double b) noexcept {
    addProduct(a.lo, b);
    addProduct(a.hi, b);
  }

  /// Adds factor times another expansion.
  template <std::size_t Other>
  void addScaled(const Expansion<Other>& other, double factor) noexcept {
    for (std::size_t i = 0; i < other.size(); ++i) addProduct(other.term(i), factor);
  }

  std::size_t size() const noexcept { return count_; }
  double term(std::size_t i) const noexcept { return terms_[i]; }

  /// Adds the product with another expansion.
  template <std::size_t Other, std::size_t Another>
  void addProduct(const Expansion<Other>& a, const Expansion<Another>& b) noexcept {
    for (std::size_t i = 0; i < b.size(); ++i) addScaled(a, b.term(i));
  }

  /// Exact: zero means zero.
  bool isZero() const noexcept { return count_ == 0; }

  /// The same number in fewer terms, without what does not fit; the first 53 bits at least of each term are right.
  template <std::size_t Fewer>
  Expansion<Fewer> leading() const noexcept {
    Expansion<Fewer> result;
    if (count_ <= Fewer) {
      result.count_ = count_;
      for (std::size_t i = 0; i < count_; ++i) result.terms_[i] = terms_[i];
      return result;
    }
    // From the largest down, as many bits into each term as it holds (Shewchuk's compression).
    double found[Fewer];
    std::size_t kept = 0;
    double sum = terms_[count_ - 1];
    for (std::size_t i = count_ - 1; i-- > 0 && kept < Fewer;) {
      const DoubleDouble next = quickTwoSum(sum, terms_[i]);
      sum = next.hi;
      if (next.lo == 0) continue;
      found[kept++] = sum;
      sum = next.lo;
    }
    if (kept < Fewer && sum != 0) found[kept++] = sum;
    for (std::size_t i = 0; i < kept; ++i) result.terms_[i] = found[kept - 1 - i];
    result.count_ = kept;
    return result;
  }

  /// The nearest double-double, up to 2^-106 relative.
  DoubleDouble rounded() const noexcept {
    DoubleDouble sum;
    for (std::size_t i = 0; i < count_; ++i) sum += DoubleDouble(terms_[i]);
    return sum;
  }

 private:
  template <std::size_t Other>
  friend class Expansion;

  double terms_[Capacity];
  std::size_t count_ = 0;
};

}  // namespace viewproj
