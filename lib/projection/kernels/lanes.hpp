// Vectors of lanes of the instruction set this file is compiled for: 8 doubles in AVX-512, 4 in AVX2, 2 in SSE2 and
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
#include <utility>

#include "projection/kernels/formulas.hpp"

namespace viewproj::detail {
namespace {

// One for each instruction set, each in its own source.
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
typedef float FloatLanes __attribute__((vector_size(kLanes * 8)));
typedef std::int64_t MaskLanes __attribute__((vector_size(kLanes * 8)));
typedef std::int32_t FloatMaskLanes __attribute__((vector_size(kLanes * 8)));
/// The same, at any address.
typedef double LooseLanes __attribute__((vector_size(kLanes * 8), aligned(8), may_alias));
typedef float LooseFour __attribute__((vector_size(16), aligned(1), may_alias));
typedef float LooseFloatLanes __attribute__((vector_size(kLanes * 8), aligned(4), may_alias));

/// F has twice as many lanes as D: those of a lower and an upper D.
struct VectorLanes {
  using D = DoubleLanes;
  using F = FloatLanes;
  using M = MaskLanes;
  using FM = FloatMaskLanes;

  static constexpr std::int64_t kSign = INT64_MIN;

  /// Not 0 + a, which is an addition; a - 0 is a itself.
  static D splat(double a) { return a - D{}; }
  static D absolute(D a) { return (D)((M)a & ~kSign); }
  static F absolute(F a) { return (F)((FM)a & 0x7fffffff); }
  static D load(const double* p) { return *reinterpret_cast<const LooseLanes*>(p); }
  static void store(double* p, D a) { *reinterpret_cast<LooseLanes*>(p) = a; }
  static F load(const float* p) { return *reinterpret_cast<const LooseFloatLanes*>(p); }
  static void store(float* p, F a) { *reinterpret_cast<LooseFloatLanes*>(p) = a; }

  /// x, y and z of vertices so many bytes apart; a fourth float of each is read too.
  template <int lanes = kLanes>
  static void loadVertices(const float* p, std::size_t strideBytes, F& x, F& y, F& z) {
    const auto four = [&](auto i) {
      return *reinterpret_cast<const LooseFour*>(reinterpret_cast<const char*>(p) + i * strideBytes);
    };
    const auto everyFourth = [&](auto i) {
      // uncounted: each of these is of another processor
      if constexpr (lanes == 2) {
        return F(four(i));
      } else if constexpr (lanes == 4) {
        return F(__builtin_shufflevector(four(i), four(i + 4), 0, 1, 2, 3, 4, 5, 6, 7));
      } else {
        const auto lower = __builtin_shufflevector(four(i), four(i + 4), 0, 1, 2, 3, 4, 5, 6, 7);
        const auto upper = __builtin_shufflevector(four(i + 8), four(i + 12), 0, 1, 2, 3, 4, 5, 6, 7);
        return F(__builtin_shufflevector(lower, upper, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
      }
    };

    // Four by four they are transposed.
    const F a = everyFourth(std::size_t{0}), b = everyFourth(std::size_t{1}), c = everyFourth(std::size_t{2}),
            d = everyFourth(std::size_t{3});
    const auto every = std::make_integer_sequence<int, 2 * kLanes>();
    const F xyOfAb = inTurn<0>(a, b, every), xyOfCd = inTurn<0>(c, d, every);
    x = inPairs<0>(xyOfAb, xyOfCd, every);
    y = inPairs<2>(xyOfAb, xyOfCd, every);
    z = inPairs<0>(inTurn<2>(a, b, every), inTurn<2>(c, d, every), every);
  }

  /// Of each four lanes two of a's and two of b's, from this one of the four on: a b a b, or a a b b.
  template <int first, int... lane>
  static F inTurn(F a, F b, std::integer_sequence<int, lane...>) {
    return __builtin_shufflevector(a, b, (lane % 2 * 2 * kLanes + lane / 4 * 4 + first + lane % 4 / 2)...);
  }
  template <int first, int... lane>
  static F inPairs(F a, F b, std::integer_sequence<int, lane...>) {
    return __builtin_shufflevector(a, b, (lane % 4 / 2 * 2 * kLanes + lane / 4 * 4 + first + lane % 2)...);
  }

#if defined(__AVX512F__) && defined(__AVX512DQ__)
  static constexpr bool hasFusedMultiplyAdd = true;
  static D larger(D a, D b) { return (D)_mm512_max_pd((__m512d)a, (__m512d)b); }
  static F larger(F a, F b) { return (F)_mm512_max_ps((__m512)a, (__m512)b); }
  static D squareRoot(D a) { return (D)_mm512_sqrt_pd((__m512d)a); }
  static D multiplyAdd(D a, D b, D c) { return (D)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c); }
  static D productError(D a, D b, D product) { return (D)_mm512_fmsub_pd((__m512d)a, (__m512d)b, (__m512d)product); }
  static unsigned bits(M m) { return _mm512_movepi64_mask((__m512i)m); }
  static unsigned floatBits(FM m) { return _mm512_movepi32_mask((__m512i)m); }

  static F toFloat(D lower, D upper) {
    return (F)_mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps((__m512d)lower)),
                                 _mm512_cvtpd_ps((__m512d)upper), 1);
  }
  static D lowerToDouble(F a) { return (D)_mm512_cvtps_pd(_mm512_castps512_ps256((__m512)a)); }
  static D upperToDouble(F a) { return (D)_mm512_cvtps_pd(_mm512_extractf32x8_ps((__m512)a, 1)); }

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
  static void loadPoints(const float* p, F& x, F& y, F& z) {
    const F a = load(p), b = load(p + 16), c = load(p + 32);
    x = __builtin_shufflevector(
        __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, -1, -1, -1, -1, -1), c, 0, 1, 2, 3, 4, 5,
        6, 7, 8, 9, 10, 17, 20, 23, 26, 29);
    y = __builtin_shufflevector(
        __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 16, 19, 22, 25, 28, 31, -1, -1, -1, -1, -1), c, 0, 1, 2, 3, 4, 5,
        6, 7, 8, 9, 10, 18, 21, 24, 27, 30);
    z = __builtin_shufflevector(
        __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 17, 20, 23, 26, 29, -1, -1, -1, -1, -1, -1), c, 0, 1, 2, 3, 4, 5,
        6, 7, 8, 9, 16, 19, 22, 25, 28, 31);
  }
  static void storePoints(float* p, F x, F y, F z) {
    store(p, __builtin_shufflevector(
                 __builtin_shufflevector(x, y, 0, 16, -1, 1, 17, -1, 2, 18, -1, 3, 19, -1, 4, 20, -1, 5), z, 0, 1, 16,
                 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15));
    store(p + 16, __builtin_shufflevector(
                      __builtin_shufflevector(x, y, 21, -1, 6, 22, -1, 7, 23, -1, 8, 24, -1, 9, 25, -1, 10, 26), z, 0,
                      21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12, 25, 14, 15));
    store(p + 32, __builtin_shufflevector(
                      __builtin_shufflevector(x, y, -1, 11, 27, -1, 12, 28, -1, 13, 29, -1, 14, 30, -1, 15, 31, -1), z,
                      26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30, 13, 14, 31));
  }
  static void loadPixels(const double* p, D& x, D& y) {
    const D a = load(p), b = load(p + 8);
    x = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    y = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
  }
#elif defined(__AVX2__) && defined(__FMA__)
  static constexpr bool hasFusedMultiplyAdd = true;
  static D larger(D a, D b) { return (D)_mm256_max_pd((__m256d)a, (__m256d)b); }
  static F larger(F a, F b) { return (F)_mm256_max_ps((__m256)a, (__m256)b); }
  static D squareRoot(D a) { return (D)_mm256_sqrt_pd((__m256d)a); }
  static D multiplyAdd(D a, D b, D c) { return (D)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c); }
  static D productError(D a, D b, D product) { return (D)_mm256_fmsub_pd((__m256d)a, (__m256d)b, (__m256d)product); }
  static unsigned bits(M m) { return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m)); }
  static unsigned floatBits(FM m) { return static_cast<unsigned>(_mm256_movemask_ps((__m256)m)); }

  static F toFloat(D lower, D upper) {
    return (F)_mm256_set_m128(_mm256_cvtpd_ps((__m256d)upper), _mm256_cvtpd_ps((__m256d)lower));
  }
  static D lowerToDouble(F a) { return (D)_mm256_cvtps_pd(_mm256_castps256_ps128((__m256)a)); }
  static D upperToDouble(F a) { return (D)_mm256_cvtps_pd(_mm256_extractf128_ps((__m256)a, 1)); }

  /// Halves that are three apart go into one register, so that no shuffle crosses its middle.
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
  static __m256 halves(const float* low, const float* high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
  }
  static void loadPoints(const float* p, F& x, F& y, F& z) {
    const __m256 xyzx = halves(p, p + 12), yzxy = halves(p + 4, p + 16), zxyz = halves(p + 8, p + 20);
    const __m256 xy = _mm256_shuffle_ps(yzxy, zxyz, _MM_SHUFFLE(2, 1, 3, 2));
    const __m256 yz = _mm256_shuffle_ps(xyzx, yzxy, _MM_SHUFFLE(1, 0, 2, 1));
    x = (F)_mm256_shuffle_ps(xyzx, xy, _MM_SHUFFLE(2, 0, 3, 0));
    y = (F)_mm256_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0));
    z = (F)_mm256_shuffle_ps(yz, zxyz, _MM_SHUFFLE(3, 0, 3, 1));
  }
  static void storePoints(float* p, F x, F y, F z) {
    const __m256 xy = _mm256_shuffle_ps((__m256)x, (__m256)y, _MM_SHUFFLE(2, 0, 2, 0));
    const __m256 yz = _mm256_shuffle_ps((__m256)y, (__m256)z, _MM_SHUFFLE(3, 1, 3, 1));
    const __m256 zx = _mm256_shuffle_ps((__m256)z, (__m256)x, _MM_SHUFFLE(3, 1, 2, 0));
    const __m256 xyzx = _mm256_shuffle_ps(xy, zx, _MM_SHUFFLE(2, 0, 2, 0));
    const __m256 yzxy = _mm256_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0));
    const __m256 zxyz = _mm256_shuffle_ps(zx, yz, _MM_SHUFFLE(3, 1, 3, 1));
    store(p, (F)_mm256_permute2f128_ps(xyzx, yzxy, 0x20));
    store(p + 8, (F)_mm256_permute2f128_ps(zxyz, xyzx, 0x30));
    store(p + 16, (F)_mm256_permute2f128_ps(yzxy, zxyz, 0x31));
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
  static F larger(F a, F b) { return a > b ? a : b; }
  static D squareRoot(D a) { return (D)vsqrtq_f64((float64x2_t)a); }
  static D multiplyAdd(D a, D b, D c) { return (D)vfmaq_f64((float64x2_t)c, (float64x2_t)a, (float64x2_t)b); }
  static D productError(D a, D b, D product) { return multiplyAdd(a, b, -product); }
  static unsigned bits(M m) { return static_cast<unsigned>((m[0] & 1) | (m[1] & 2)); }
  static unsigned floatBits(FM m) { return vaddvq_u32((uint32x4_t)(m & FM{1, 2, 4, 8})); }

  static F toFloat(D lower, D upper) {
    return (F)vcvt_high_f32_f64(vcvt_f32_f64((float64x2_t)lower), (float64x2_t)upper);
  }
  static D lowerToDouble(F a) { return (D)vcvt_f64_f32(vget_low_f32((float32x4_t)a)); }
  static D upperToDouble(F a) { return (D)vcvt_high_f64_f32((float32x4_t)a); }
#else
  static constexpr bool hasFusedMultiplyAdd = false;
  static D larger(D a, D b) { return (D)_mm_max_pd((__m128d)a, (__m128d)b); }
  static F larger(F a, F b) { return (F)_mm_max_ps((__m128)a, (__m128)b); }
  static D squareRoot(D a) { return (D)_mm_sqrt_pd((__m128d)a); }
  static D multiplyAdd(D a, D b, D c) { return a * b + c; }
  static unsigned bits(M m) { return static_cast<unsigned>(_mm_movemask_pd((__m128d)m)); }
  static unsigned floatBits(FM m) { return static_cast<unsigned>(_mm_movemask_ps((__m128)m)); }
  /// Dekker's, as twoProd.
  static D productError(D a, D b, D product) {
    constexpr double splitter = 0x1p27 + 1;
    const D aScaled = splitter * a, bScaled = splitter * b;
    const D aHigh = aScaled - (aScaled - a), bHigh = bScaled - (bScaled - b);
    const D aLow = a - aHigh, bLow = b - bHigh;
    return ((aHigh * bHigh - product) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
  }

  static F toFloat(D lower, D upper) {
    return (F)_mm_movelh_ps(_mm_cvtpd_ps((__m128d)lower), _mm_cvtpd_ps((__m128d)upper));
  }
  static D lowerToDouble(F a) { return (D)_mm_cvtps_pd((__m128)a); }
  static D upperToDouble(F a) { return (D)_mm_cvtps_pd(_mm_movehl_ps((__m128)a, (__m128)a)); }
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
  static void loadPoints(const float* p, F& x, F& y, F& z) {
    const F a = load(p), b = load(p + 4), c = load(p + 8);
    x = __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 3, 6, -1), c, 0, 1, 2, 5);
    y = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, -1), c, 0, 1, 2, 6);
    z = __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 5, -1, -1), c, 0, 1, 4, 7);
  }
  static void storePoints(float* p, F x, F y, F z) {
    store(p, __builtin_shufflevector(__builtin_shufflevector(x, y, 0, 4, -1, 1), z, 0, 1, 4, 3));
    store(p + 4, __builtin_shufflevector(__builtin_shufflevector(x, y, 5, -1, 2, 6), z, 0, 5, 2, 3));
    store(p + 8, __builtin_shufflevector(__builtin_shufflevector(x, y, -1, 3, 7, -1), z, 6, 1, 2, 7));
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
