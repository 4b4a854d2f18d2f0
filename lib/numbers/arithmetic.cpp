#include "numbers/arithmetic.hpp"

#include "numbers/error_free.hpp"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace viewproj::detail {

const char* arithmeticFault() noexcept {
  constexpr const char* kRounding = "floating-point arithmetic does not round to the nearest here";
  constexpr const char* kFlushing = "floating-point arithmetic flushes subnormal numbers to 0 here";
#ifdef __SSE2__
  constexpr unsigned kRoundingMode = 0x6000, kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  const unsigned control = _mm_getcsr();
  if (control & kRoundingMode) return kRounding;
  if (control & (kFlushToZero | kDenormalsAreZero)) return kFlushing;
#else
  volatile double one = 1, small = 0x1p-60, least = 0x1p-1022, subnormal = 0x1p-1074;
  if (one + small != one || one - small != one) return kRounding;
  if (least / 2 == 0 || subnormal * 0x1p100 == 0) return kFlushing;
#endif
  // Detects what a compiler may have done to the library itself.
  volatile double large = 1, low = 0x1p-60;
  if (twoSum(large, low).lo != low) return "this library was compiled to reorder its floating-point arithmetic";
  return nullptr;
}

}  // namespace viewproj::detail
