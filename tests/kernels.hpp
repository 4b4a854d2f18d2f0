// Each kernel of the batches in turn.
#pragma once

#include "projection/kernels/kernels.hpp"

/// Calls f with the kernels that this processor supports, forced one after the other, and says how many these are.
template <class F>
int withEachKernel(const F& f) {
  int count = 0;
  for (const viewproj::Kernels* kernels : viewproj::allKernels()) {
    if (!viewproj::isSupported(*kernels)) continue;
    viewproj::forceKernels(kernels);
    f(*kernels);
    ++count;
  }
  viewproj::forceKernels(nullptr);
  return count;
}
