// A pose's rows as exact integers times powers of two, whatever the magnitudes of what they were made of. Internal.
#pragma once

#include "camera/exact_rows.hpp"
#include "numbers/dyadic.hpp"

namespace viewproj::detail {

/// The distances along the axes are scale (row . d + translation), as in ExactRows.
struct ExactSource {
  Vector3<Dyadic> right, up, forward;
  Wide rightScale, upScale, forwardScale;
};

/// Tens of microseconds at worst.
ExactSource exactSource(const PoseSource& source) noexcept;

}  // namespace viewproj::detail
