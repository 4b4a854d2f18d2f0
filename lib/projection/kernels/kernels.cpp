#include "projection/kernels/kernels.hpp"

#include <atomic>

#include "projection/kernels/cpu_features.hpp"

#ifdef VIEWPROJ_X86_KERNELS
#include <cpuid.h>
#endif

namespace viewproj::detail {

extern const Kernels kPortableKernels;
#ifdef VIEWPROJ_BASELINE_KERNEL
extern const Kernels kBaselineKernels;
#endif
#ifdef VIEWPROJ_X86_KERNELS
extern const Kernels kV3Kernels;
extern const Kernels kV4Kernels;
#endif

namespace {

std::atomic<const Kernels*> forced = nullptr;

#ifdef VIEWPROJ_X86_KERNELS
/// A bit of ecx.
bool cpuidBit(unsigned leaf, unsigned bit) noexcept {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(leaf, &a, &b, &c, &d) != 0 && (c >> bit & 1) != 0;
}

/// As compiledFeatures numbers them.
unsigned processorFeatures() noexcept {
  unsigned bits = 0, bit = 1;
#define VIEWPROJ_PROCESSOR_FEATURE(macro, supported) \
  if (supported) bits |= bit;                        \
  bit <<= 1;
  VIEWPROJ_CPU_FEATURES(VIEWPROJ_PROCESSOR_FEATURE)
#undef VIEWPROJ_PROCESSOR_FEATURE
  return bits;
}
#endif

}  // namespace

std::span<const Kernels* const> allKernels() noexcept {
  static constexpr const Kernels* kAll[] = {
      &kPortableKernels,
#ifdef VIEWPROJ_BASELINE_KERNEL
      &kBaselineKernels,
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
  return (kernels.features & ~processorFeatures()) == 0;
#else
  return true;
#endif
}

const Kernels& kernels() noexcept {
  if (const Kernels* chosen = forced.load(std::memory_order_relaxed)) return *chosen;
  static const Kernels& best = []() -> const Kernels& {
    const Kernels* chosen = &kPortableKernels;
    for (const Kernels* candidate : allKernels())
      if (isSupported(*candidate)) chosen = candidate;
    return *chosen;
  }();
  return best;
}

void forceKernels(const Kernels* kernels) noexcept { forced.store(kernels, std::memory_order_relaxed); }

}  // namespace viewproj::detail
