// Apart from kernels.cpp: a program that has no batches links none of their code.
#include <atomic>

#include "projection/kernels/kernels.hpp"

namespace viewproj::detail {

extern const PointKernels kBaselinePoints;
#ifdef VIEWPROJ_X86_KERNELS
extern const PointKernels kV3Points;
#endif

namespace {

std::atomic<const PointKernels*> forced = nullptr;

}  // namespace

bool supportsV3() noexcept {
#ifdef VIEWPROJ_X86_KERNELS
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

const PointKernels& pointKernels() noexcept {
  if (const PointKernels* chosen = forced.load(std::memory_order_relaxed)) return *chosen;
#ifdef VIEWPROJ_X86_KERNELS
  static const PointKernels& best = supportsV3() ? kV3Points : kBaselinePoints;
  return best;
#else
  return kBaselinePoints;
#endif
}

void forcePointKernels(const PointKernels* kernels) noexcept { forced.store(kernels, std::memory_order_relaxed); }

}  // namespace viewproj::detail
