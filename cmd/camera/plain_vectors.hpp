// Sums, lengths and units of plain vectors, in double. Nothing is -0.
#pragma once

#include <cmath>

#include "numbers/vectors.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// a + k b.
inline Vec3 sum(const Vec3& a, double k, const Vec3& b) { return {a.x + k * b.x, a.y + k * b.y, a.z + k * b.z}; }
inline Vec3 scaled(const Vec3& a, double k) { return sum({}, k, a); }
inline double length(const Vec3& a) { return detail::hypotenuse(a.x, a.y, a.z); }
inline double apart(const Vec3& a, const Vec3& b) { return length(sum(a, -1, b)); }
inline Vec3 unit(const Vec3& a) { return scaled(a, 1 / length(a)); }

}  // namespace viewproj::cmd
