// Vectors of lanes of the instruction set this file is compiled for: 8 doubles in AVX-512, 4 in AVX2, 2 in SSE2.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#define VIEWPROJ_HAS_LANES 1

#include <immintrin.h>

#include "viewproj/view/kernels/formulas.hpp"

namespace viewproj {
namespace {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
constexpr int kLanes = 8;
#elif defined(__AVX2__) && defined(__FMA__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif

typedef double DoubleLanes __attribute__((vector_size(kLanes * 8)));
typedef float FloatLanes __attribute__((vector_size(kLanes * 4)));
typedef long long MaskLanes __attribute__((vector_size(kLanes * 8)));
/// The same, at any address.
typedef double LooseLanes __attribute__((vector_size(kLanes * 8), aligned(8), may_alias));

struct VectorLanes {
  using D = DoubleLanes;
  using F = FloatLanes;
  using M = MaskLanes;

  static F toFloat(D a) { return __builtin_convertvector(a, F); }
  static D toDouble(F a) { return __builtin_convertvector(a, D); }
  static D absolute(D a) { return (D)((M)a & 0x7fffffffffffffffLL); }

  static D load(const double* p) { return *reinterpret_cast<const LooseLanes*>(p); }
  static void store(double* p, D a) { *reinterpret_cast<LooseLanes*>(p) = a; }

#if defined(__AVX512F__) && defined(__AVX512DQ__)
  static D squareRoot(D a) { return (D)_mm512_sqrt_pd((__m512d)a); }
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
  static D squareRoot(D a) { return (D)_mm256_sqrt_pd((__m256d)a); }
  static D productError(D a, D b, D product) { return (D)_mm256_fmsub_pd((__m256d)a, (__m256d)b, (__m256d)product); }
  static unsigned bits(M m) { return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m)); }

  static void loadPoints(const double* p, D& x, D& y, D& z) {
    const D a = load(p), b = load(p + 4), c = load(p + 8);
    x = __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 3, 6, -1), c, 0, 1, 2, 5);
    y = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, -1), c, 0, 1, 2, 6);
    z = __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 5, -1, -1), c, 0, 1, 4, 7);
  }
  static void storePoints(double* p, D x, D y, D z) {
    store(p, __builtin_shufflevector(__builtin_shufflevector(x, y, 0, 4, -1, 1), z, 0, 1, 4, 3));
    store(p + 4, __builtin_shufflevector(__builtin_shufflevector(x, y, 5, -1, 2, 6), z, 0, 5, 2, 3));
    store(p + 8, __builtin_shufflevector(__builtin_shufflevector(x, y, -1, 3, 7, -1), z, 6, 1, 2, 7));
  }
  static void loadPixels(const double* p, D& x, D& y) {
    const D a = load(p), b = load(p + 4);
    x = __builtin_shufflevector(a, b, 0, 2, 4, 6);
    y = __builtin_shufflevector(a, b, 1, 3, 5, 7);
  }
#else
  static D squareRoot(D a) { return (D)_mm_sqrt_pd((__m128d)a); }
  static unsigned bits(M m) { return static_cast<unsigned>(_mm_movemask_pd((__m128d)m)); }
  /// Dekker's, as twoProd.
  static D productError(D a, D b, D product) {
    constexpr double splitter = 0x1p27 + 1;
    const D aScaled = splitter * a, bScaled = splitter * b;
    const D aHigh = aScaled - (aScaled - a), bHigh = bScaled - (bScaled - b);
    const D aLow = a - aHigh, bLow = b - bHigh;
    return ((aHigh * bHigh - product) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
  }

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

  static constexpr unsigned kAll = (1u << kLanes) - 1;
};

}  // namespace
}  // namespace viewproj

#endif
