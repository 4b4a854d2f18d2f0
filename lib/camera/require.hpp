// Numbers of a camera, checked.
#pragma once

#include <cmath>

#include "numbers/vectors.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::detail {

/// Written so that NaN fails.
inline void requirePositive(double value, const char* field) {
  if (!(value > 0 && std::isfinite(value))) throw CameraError(field, "must be a finite number above 0");
}

inline void requireFinite(double value, const char* field) {
  if (!std::isfinite(value)) throw CameraError(field, "must be a finite number");
}

inline void requireFinite(const Vec3& v, const char* field) {
  if (!isFinite(v)) throw CameraError(field, "has a component that is not a finite number");
}

}  // namespace viewproj::detail
