// Vectors of doubles for the instruction set this file is compiled for: 8 lanes in AVX-512, 4 in AVX2, 2 in SSE2 and
// NEON.
#pragma once

#if (defined(__x86_64__) || defined(__aarch64__)) && defined(__GNUC__) && !defined(VIEWPROJ_PORTABLE_KERNEL)
#define VIEWPROJ_HAS_LANES 1

#ifdef __aarch64__
#include <arm_neon.h>
#else
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstdint>

#include "projection/kernels/formulas.hpp"

namespace viewproj::detail {
namespace {

// One per instruction set, each in its own source file.
// NOLINTBEGIN(misc-definitions-in-headers)
#if defined(__AVX512F__) && defined(__AVX512DQ__)
constexpr int kLanes = 8;
#elif defined(__AVX2__) && defined(__FMA__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif
// NOLINTEND(misc-definitions-in-headers)

typedef double DoubleLanes __attribute__((vector_size(kLanes * 8)));
typedef std::int64_t MaskLanes __attribute__((vector_size(kLanes * 8)));
/// The same without alignment.
typedef double LooseLanes __attribute__((vector_size(kLanes * 8), aligned(8), may_alias));

struct VectorLanes {
  using D = DoubleLanes;
  using M = MaskLanes;

  static constexpr std::int64_t kSign = INT64_MIN;

  /// Not 0 + a, which would be an addition. a - 0 is a itself.
  static D splat(double a) { return a - D{}; }
  static D absolute(D a) { return (D)((M)a & ~kSign); }
  static D load(const double* p) { return *reinterpret_cast<const LooseLanes*>(p); }
  static void store(double* p, D a) { *reinterpret_cast<LooseLanes*>(p) = a; }
  template <class Function>
  static D map(D a, const Function& function) {
    D result;
    for (int i = 0; i < kLanes; ++i) result[i] = function(a[i]);
    return result;
  }

#if defined(__AVX512F__) && defined(__AVX512DQ__)
  static constexpr bool hasFusedMultiplyAdd = true;
  static D larger(D a, D b) { return (D)_mm512_max_pd((__m512d)a, (__m512d)b); }
  static D squareRoot(D a) { return (D)_mm512_sqrt_pd((__m512d)a); }
  static D multiplyAdd(D a, D b, D c) { return (D)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c); }
  static D productError(D a, D b, D product) { return (D)_mm512_fmsub_pd((__m512d)a, (__m512d)b, (__m512d)product); }
  static unsigned bits(M m) { return _mm512_movepi64_mask((__m512i)m); }

  static void loadPoints(const double* p, D& x, D& y, D& z) {
    const D a = load(p), b = load(p + 8), c = load(p + 16);
    x = __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, -1, -1), c, 0, 1, 2, 3, 4, 5, 10, 13);
    y = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, 10, 13, -1, -1, -1), c, 0, 1, 2, 3, 4, 8, 11,
                                14);
    z = __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 5, 8, 11, 14, -1, -1, -1), c, 0, 1, 2, 3, 4, 9, 12,
                                15);
  }
  static void storePoints(double* p, D x, D y, D z) {
    store(p,
          __builtin_shufflevector(__builtin_shufflevector(x, y, 0, 8, -1, 1, 9, -1, 2, 10), z, 0, 1, 8, 3, 4, 9, 6, 7));
    store(p + 8, __builtin_shufflevector(__builtin_shufflevector(x, y, -1, 3, 11, -1, 4, 12, -1, 5), z, 10, 1, 2, 11, 4,
                                         5, 12, 7));
    store(p + 16, __builtin_shufflevector(__builtin_shufflevector(x, y, 13, -1, 6, 14, -1, 7, 15, -1), z, 0, 13, 2, 3,
                                          14, 5, 6, 15));
  }
  static void loadPixels(const double* p, D& x, D& y) {
    const D a = load(p), b = load(p + 8);
    x = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    y = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
  }
#elif defined(__AVX2__) && defined(__FMA__)
  static constexpr bool hasFusedMultiplyAdd = true;
  static D larger(D a, D b) { return (D)_mm256_max_pd((__m256d)a, (__m256d)b); }
  static D squareRoot(D a) { return (D)_mm256_sqrt_pd((__m256d)a); }
  static D multiplyAdd(D a, D b, D c) { return (D)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c); }
  static D productError(D a, D b, D product) { return (D)_mm256_fmsub_pd((__m256d)a, (__m256d)b, (__m256d)product); }
  static unsigned bits(M m) { return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m)); }

  /// Loads halves that are three apart into one register, so that no shuffle crosses its middle.
  static __m256d halves(const double* low, const double* high) {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high), 1);
  }
  static void loadPoints(const double* p, D& x, D& y, D& z) {
    const __m256d xy = halves(p, p + 6), zx = halves(p + 2, p + 8), yz = halves(p + 4, p + 10);
    x = (D)_mm256_blend_pd(xy, zx, 0b1010);
    y = (D)_mm256_shuffle_pd(xy, yz, 0b0101);
    z = (D)_mm256_blend_pd(zx, yz, 0b1010);
  }
  static void storePoints(double* p, D x, D y, D z) {
    const __m256d xy = _mm256_unpacklo_pd((__m256d)x, (__m256d)y);
    const __m256d zx = _mm256_blend_pd((__m256d)z, (__m256d)x, 0b1010);
    const __m256d yz = _mm256_unpackhi_pd((__m256d)y, (__m256d)z);
    store(p, (D)_mm256_permute2f128_pd(xy, zx, 0x20));
    store(p + 4, (D)_mm256_permute2f128_pd(yz, xy, 0x30));
    store(p + 8, (D)_mm256_permute2f128_pd(zx, yz, 0x31));
  }
  static void loadPixels(const double* p, D& x, D& y) {
    const D a = load(p), b = load(p + 4);
    x = __builtin_shufflevector(a, b, 0, 2, 4, 6);
    y = __builtin_shufflevector(a, b, 1, 3, 5, 7);
  }
#else
#ifdef __aarch64__
  static constexpr bool hasFusedMultiplyAdd = true;
  static D larger(D a, D b) { return a > b ? a : b; }
  static D squareRoot(D a) { return (D)vsqrtq_f64((float64x2_t)a); }
  static D multiplyAdd(D a, D b, D c) { return (D)vfmaq_f64((float64x2_t)c, (float64x2_t)a, (float64x2_t)b); }
  static D productError(D a, D b, D product) { return multiplyAdd(a, b, -product); }
  static unsigned bits(M m) { return static_cast<unsigned>((m[0] & 1) | (m[1] & 2)); }
#else
  static constexpr bool hasFusedMultiplyAdd = false;
  static D larger(D a, D b) { return (D)_mm_max_pd((__m128d)a, (__m128d)b); }
  static D squareRoot(D a) { return (D)_mm_sqrt_pd((__m128d)a); }
  static D multiplyAdd(D a, D b, D c) { return a * b + c; }
  static unsigned bits(M m) { return static_cast<unsigned>(_mm_movemask_pd((__m128d)m)); }
  /// Dekker's product, as in twoProd.
  static D productError(D a, D b, D product) {
    constexpr double splitter = 0x1p27 + 1;
    const D aScaled = splitter * a, bScaled = splitter * b;
    const D aHigh = aScaled - (aScaled - a), bHigh = bScaled - (bScaled - b);
    const D aLow = a - aHigh, bLow = b - bHigh;
    return ((aHigh * bHigh - product) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
  }
#endif

  static void loadPoints(const double* p, D& x, D& y, D& z) {
    const D a = load(p), b = load(p + 2), c = load(p + 4);
    x = __builtin_shufflevector(a, b, 0, 3);
    y = __builtin_shufflevector(a, c, 1, 2);
    z = __builtin_shufflevector(b, c, 0, 3);
  }
  static void storePoints(double* p, D x, D y, D z) {
    store(p, __builtin_shufflevector(x, y, 0, 2));
    store(p + 2, __builtin_shufflevector(z, x, 0, 3));
    store(p + 4, __builtin_shufflevector(y, z, 1, 3));
  }
  static void loadPixels(const double* p, D& x, D& y) {
    const D a = load(p), b = load(p + 2);
    x = __builtin_shufflevector(a, b, 0, 2);
    y = __builtin_shufflevector(a, b, 1, 3);
  }
#endif
};

}  // namespace
}  // namespace viewproj::detail

#endif
