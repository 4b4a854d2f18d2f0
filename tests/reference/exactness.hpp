// What exact promises, as a check.
#pragma once

#include "projection/kernels/error_model.hpp"
#include "reference/real.hpp"
#include "viewproj/screen.hpp"

namespace reference {

/// Within 0.51 ulp, or within 1e-26 of the size that a cancelling number is to be measured by.
inline bool isExact(double got, const Real& truth, double size) {
  return ulps(got, truth) <= viewproj::kExactUlps || distance(got, truth) <= viewproj::kExactAbsolute * size;
}

}  // namespace reference
