// The kernels of the batches that this processor supports.
#pragma once

#include <vector>

#include "projection/kernels/kernels.hpp"

namespace viewproj::detail {
extern const Kernels kPortableKernels;
}

inline const std::vector<const viewproj::detail::Kernels*>& supportedKernels() {
  // Asked once: in a virtual machine the question costs microseconds.
  static const std::vector<const viewproj::detail::Kernels*> supported = [] {
    std::vector<const viewproj::detail::Kernels*> found;
    if (viewproj::detail::allKernels().front() != &viewproj::detail::kPortableKernels)
      found.push_back(&viewproj::detail::kPortableKernels);
    for (const viewproj::detail::Kernels* kernels : viewproj::detail::allKernels())
      if (viewproj::detail::isSupported(*kernels)) found.push_back(kernels);
    return found;
  }();
  return supported;
}

/// Calls f with these kernels, forced.
template <class F>
void withKernels(const viewproj::detail::Kernels& kernels, const F& f) {
  viewproj::detail::forceKernels(&kernels);
  f(kernels);
  viewproj::detail::forceKernels(nullptr);
}

/// Calls f with each in turn, and says how many these are.
template <class F>
int withEachKernel(const F& f) {
  for (const viewproj::detail::Kernels* kernels : supportedKernels()) withKernels(*kernels, f);
  return static_cast<int>(supportedKernels().size());
}
