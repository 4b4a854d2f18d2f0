// A model's own coordinates: the matrix that places it in the world.
#pragma once

#include "camera/pose.hpp"

namespace viewproj {

/// translation * rotation * scale, column vectors, as a glTF node has them. The quaternion is normalised. Each entry is
/// the double nearest the true one. Throws CameraError naming translation, rotation or scale where one is not finite or
/// the rotation is zero.
Mat4 worldFromLocal(const Vec3& translation, const Quaternion& rotation, const Vec3& scale);

/// An affine matrix (last row 0 0 0 1) times a homogeneous point: each coordinate the double nearest the exact sum of
/// products; the weight stays. From there on the world point counts as exact. Infinite where it leaves the doubles.
Vec4 toWorld(const Mat4& worldFromLocal, const Vec4& local) noexcept;

}  // namespace viewproj
