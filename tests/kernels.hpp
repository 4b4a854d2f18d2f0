// Each kernel of the batches in turn.
#pragma once

#include "projection/kernels/kernels.hpp"

/// Calls f with the kernels that this processor supports, forced one after the other, and says how many these are.
template <class F>
int withEachKernel(const F& f) {
  int count = 0;
  for (const viewproj::detail::Kernels* kernels : viewproj::detail::allKernels()) {
    if (!viewproj::detail::isSupported(*kernels)) continue;
    viewproj::detail::forceKernels(kernels);
    f(*kernels);
    ++count;
  }
  viewproj::detail::forceKernels(nullptr);
  return count;
}
