// Checks of a camera's numbers. NaN fails each of them.
#pragma once

#include <cmath>

#include "numbers/vectors.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::detail {

inline bool isInDomain(double value) noexcept {
  const double size = std::fabs(value);
  return size == 0 || (size >= kSmallestNumber && size <= kLargestNumber);
}

inline void requireFinite(double value, const char* field) {
  if (!std::isfinite(value)) throw CameraError(field, "must be a finite number");
}

/// For a turn: far more radians are not known to their last digits.
inline void requireTurn(const Angle& angle, const char* field) {
  requireFinite(angle.value, field);
  if (angle.isRadians && std::fabs(angle.value) > 1e6) throw CameraError(field, "must be up to 1e6 radians");
}

inline void requireNumber(double value, const char* field) {
  requireFinite(value, field);
  if (!isInDomain(value)) throw CameraError(field, "must be 0, or between 1e-90 and 1e90 in magnitude");
}

inline void requireNumber(const Vec3& v, const char* field) {
  if (!isFinite(v)) throw CameraError(field, "has a component that is not a finite number");
  if (!(isInDomain(v.x) && isInDomain(v.y) && isInDomain(v.z)))
    throw CameraError(field, "has a component that is neither 0 nor between 1e-90 and 1e90 in magnitude");
}

inline void requirePositive(double value, const char* field) {
  if (!(value > 0 && std::isfinite(value))) throw CameraError(field, "must be a finite number above 0");
  requireNumber(value, field);
}

}  // namespace viewproj::detail
