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
  if (!isInDomain(value)) throw CameraError(field, "must be 0, or between 1e-45 and 1e45 in magnitude");
}

/// An entry of a vector, a rotation or a lens: 0 if it is below kSmallestNumber.
inline double checkedEntry(double value, const char* field, const char* fault = "must be a finite number up to 1e45") {
  if (!(std::fabs(value) <= kLargestNumber)) throw CameraError(field, fault);
  return std::fabs(value) < kSmallestNumber ? 0 : value;
}

inline Vec3 checkedEntries(const Vec3& v, const char* field) {
  const auto entry = [&](double a) {
    return checkedEntry(a, field, "has a component that is not a finite number up to 1e45");
  };
  return {entry(v.x), entry(v.y), entry(v.z)};
}

inline Mat4 checkedEntries(Mat4 matrix, const char* field) {
  for (auto& row : matrix.m)
    for (double& entry : row) entry = checkedEntry(entry, field, "has an entry that is not a finite number up to 1e45");
  return matrix;
}

inline void requirePositive(double value, const char* field) {
  if (!(value > 0 && std::isfinite(value))) throw CameraError(field, "must be a finite number above 0");
  requireNumber(value, field);
}

}  // namespace viewproj::detail
