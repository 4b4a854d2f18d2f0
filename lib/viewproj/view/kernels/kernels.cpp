#include "viewproj/view/kernels/kernels.hpp"

namespace viewproj {

extern const Kernels kPortableKernels;
#ifdef VIEWPROJ_X86_KERNELS
extern const Kernels kBaselineKernels;
extern const Kernels kV3Kernels;
extern const Kernels kV4Kernels;
#endif

std::span<const Kernels* const> allKernels() noexcept {
  static constexpr const Kernels* kAll[] = {
      &kPortableKernels,
#ifdef VIEWPROJ_X86_KERNELS
      &kBaselineKernels,
      &kV3Kernels,
      &kV4Kernels,
#endif
  };
  return kAll;
}

const Kernels& kernels() noexcept {
  static const Kernels& best = []() -> const Kernels& {
    const Kernels* chosen = &kPortableKernels;
    for (const Kernels* candidate : allKernels())
      if (candidate->supported()) chosen = candidate;
    return *chosen;
  }();
  return best;
}

}  // namespace viewproj
