#include "projection/kernels/kernels.hpp"

#include <atomic>

namespace viewproj::detail {

#ifdef VIEWPROJ_BASELINE_KERNEL
extern const Kernels kBaselineKernels;
#else
extern const Kernels kPortableKernels;
#endif
#ifdef VIEWPROJ_X86_KERNELS
extern const Kernels kV3Kernels;
extern const Kernels kV4Kernels;
#endif

namespace {

std::atomic<const Kernels*> forced = nullptr;

}  // namespace

std::span<const Kernels* const> allKernels() noexcept {
  static constexpr const Kernels* kAll[] = {
#ifdef VIEWPROJ_BASELINE_KERNEL
      &kBaselineKernels,
#else
      &kPortableKernels,
#endif
#ifdef VIEWPROJ_X86_KERNELS
      &kV3Kernels,
      &kV4Kernels,
#endif
  };
  return kAll;
}

bool isSupported([[maybe_unused]] const Kernels& kernels) noexcept {
#ifdef VIEWPROJ_X86_KERNELS
  if (&kernels == &kV3Kernels) return supportsV3();
  if (&kernels == &kV4Kernels)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("fma");
#endif
  return true;
}

const Kernels& kernels() noexcept {
  if (const Kernels* chosen = forced.load(std::memory_order_relaxed)) return *chosen;
  static const Kernels& best = []() -> const Kernels& {
    const Kernels* chosen = allKernels().front();
    for (const Kernels* candidate : allKernels())
      if (isSupported(*candidate)) chosen = candidate;
    return *chosen;
  }();
  return best;
}

void forceKernels(const Kernels* kernels) noexcept {
  forced.store(kernels, std::memory_order_relaxed);
  forcePointKernels(kernels ? &kernels->points : nullptr);
}

}  // namespace viewproj::detail
