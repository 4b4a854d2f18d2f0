// Rotations with a translation, composed in double-double.
#pragma once

#include <array>
#include <span>

#include "camera/document.hpp"
#include "camera/values.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::cmd {

/// x -> R x + t.
struct Rigid {
  std::array<detail::DDVec3, 3> columns{detail::DDVec3{1, 0, 0}, detail::DDVec3{0, 1, 0}, detail::DDVec3{0, 0, 1}};
  detail::DDVec3 origin{};
};

/// Of 3 or 4 rows of 4.
Rigid rigidOf(std::span<const double> byRows);
/// Of 9 numbers by rows, and 3.
Rigid rigidOf(std::span<const double> rotation, const detail::DDVec3& translation);

/// Of worldFromCamera or cameraFromWorld.
Rigid rigidOf(const RigidTransform& transform);
/// The columns of the rotation x, y, z, w of any length but 0.
std::array<detail::DDVec3, 3> rotationColumns(const Quaternion& quaternion);

/// b, then a.
Rigid operator*(const Rigid& a, const Rigid& b);
/// The inverse, if the columns are orthogonal.
Rigid inverse(const Rigid& a);

/// 4 rows of 4, each entry rounded once.
Mat4 matrixOf(const Rigid& a);
Json rowsOf(const Rigid& a);

}  // namespace viewproj::cmd
