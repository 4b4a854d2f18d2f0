// Vectors of expansions: how poses' rows are made of numbers. Internal.
#pragma once

#include <cmath>

#include "camera/exact_rows.hpp"
#include "camera/require.hpp"

namespace viewproj::detail {

inline DDVec3 rounded(const ExactVec3& v) { return {v[0].rounded(), v[1].rounded(), v[2].rounded()}; }

inline void requireFinite(const FineVec3& v, const char* field) { requireFinite(rounded(rounded(v.terms)), field); }

inline ExactVec3 exactly(const Vec3& v) { return {Expansion<8>{v.x}, Expansion<8>{v.y}, Expansion<8>{v.z}}; }

/// a and b are scaled to unit magnitude first. Exact for a b of doubles; of a fine one what does not fit into eight
/// terms is far below b's own error.
inline ExactVec3 exactCross(const DDVec3& a, const ExactVec3& b) {
  ExactVec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    Expansion<64> sum;
    for (std::size_t t = 0; t < b[k].size(); ++t) sum.addProduct(a[j], b[k].term(t));
    for (std::size_t t = 0; t < b[j].size(); ++t) sum.addProduct(a[k], -b[j].term(t));
    result[i] = sum.leading<8>();
  }
  return result;
}

/// Numbers of about unit size whose products have all their digits: of those of two of them, terms come out no smaller
/// than kSmallestTerm.
inline constexpr double kSmallestFactor = 0x1p-450;

inline bool isAbove(double number, double smallest) { return number == 0 || std::fabs(number) >= smallest; }

template <std::size_t Terms>
bool isAbove(const Expansion<Terms>& number, double smallest) {
  for (std::size_t i = 0; i < number.size(); ++i)
    if (!isAbove(number.term(i), smallest)) return false;
  return true;
}

inline bool isAbove(const ExactVec3& v, double smallest) {
  return isAbove(v[0], smallest) && isAbove(v[1], smallest) && isAbove(v[2], smallest);
}

/// Whether no component is smaller than that, next to the largest.
inline bool isAbove(const DDVec3& v, double smallest) {
  const double least = maxAbs(v) * smallest;
  for (std::size_t i = 0; i < 3; ++i)
    if (!isAbove(v[i].hi, least) || !isAbove(v[i].lo, least)) return false;
  return true;
}

}  // namespace viewproj::detail
