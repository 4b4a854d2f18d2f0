// A library to preload that changes a program's floating-point arithmetic before it begins, as one does that was linked
// with -ffast-math. VIEWPROJ_ARITHMETIC: upward, downward, zero, flush, denormals or nearest.
#include <cfenv>
#include <cstdlib>
#include <string_view>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

__attribute__((constructor)) static void change() {
  const char* given = std::getenv("VIEWPROJ_ARITHMETIC");
  const std::string_view how = given ? given : "";
  if (how == "upward") std::fesetround(FE_UPWARD);
  if (how == "downward") std::fesetround(FE_DOWNWARD);
  if (how == "zero") std::fesetround(FE_TOWARDZERO);
#ifdef __SSE2__
  if (how == "flush") _mm_setcsr(_mm_getcsr() | 0x8000);
  if (how == "denormals") _mm_setcsr(_mm_getcsr() | 0x0040);
#endif
}
