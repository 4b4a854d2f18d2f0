// Sums of plain vectors.
#pragma once

#include <cmath>

#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

inline double along(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double lengthOf(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }
inline Vec3 sum(const Vec3& a, double k, const Vec3& b) { return {a.x + k * b.x, a.y + k * b.y, a.z + k * b.z}; }
inline double apart(const Vec3& a, const Vec3& b) { return lengthOf(sum(a, -1, b)); }

}  // namespace viewproj::cmd
