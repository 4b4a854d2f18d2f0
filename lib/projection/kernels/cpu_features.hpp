// What a compiler may use beyond the first x86-64 processors, as it says itself: a kernel is used where the processor
// has all that the options it is compiled with allow, whether or not it came to use it.
#pragma once

#include <string_view>

// X(what g++ and clang++ define, whether the processor has it, and the system its registers)
#define VIEWPROJ_CPU_FEATURES(X)                                          \
  X(__SSE3__, __builtin_cpu_supports("sse3"))                             \
  X(__SSSE3__, __builtin_cpu_supports("ssse3"))                           \
  X(__SSE4_1__, __builtin_cpu_supports("sse4.1"))                         \
  X(__SSE4_2__, __builtin_cpu_supports("sse4.2"))                         \
  X(__POPCNT__, __builtin_cpu_supports("popcnt"))                         \
  X(__AVX__, __builtin_cpu_supports("avx"))                               \
  X(__AVX2__, __builtin_cpu_supports("avx2"))                             \
  X(__FMA__, __builtin_cpu_supports("fma"))                               \
  X(__BMI__, __builtin_cpu_supports("bmi"))                               \
  X(__BMI2__, __builtin_cpu_supports("bmi2"))                             \
  X(__AVX512F__, __builtin_cpu_supports("avx512f"))                       \
  X(__AVX512DQ__, __builtin_cpu_supports("avx512dq"))                     \
  X(__AVX512VL__, __builtin_cpu_supports("avx512vl"))                     \
  X(__AVX512BW__, __builtin_cpu_supports("avx512bw"))                     \
  X(__AVX512CD__, __builtin_cpu_supports("avx512cd"))                     \
  /* clang++ 14 does not know these by name. f16c has avx's registers. */ \
  X(__F16C__, __builtin_cpu_supports("avx") && cpuidBit(1, 29))           \
  X(__MOVBE__, cpuidBit(1, 22))                                           \
  X(__LZCNT__, cpuidBit(0x80000001, 5))

namespace viewproj {
namespace {

// A macro that is not defined is its own text, one that is defined is 1.
#define VIEWPROJ_TEXT(x) #x
#define VIEWPROJ_COMPILED_FEATURE(macro, supported)               \
  if (std::string_view(VIEWPROJ_TEXT(macro)) == "1") bits |= bit; \
  bit <<= 1;

/// Those of the file that includes this, a bit for each row.
consteval unsigned compiledFeatures() noexcept {
  unsigned bits = 0, bit = 1;
  VIEWPROJ_CPU_FEATURES(VIEWPROJ_COMPILED_FEATURE)
  return bits;
}

#undef VIEWPROJ_COMPILED_FEATURE
#undef VIEWPROJ_TEXT

}  // namespace
}  // namespace viewproj
