// The --model option: where a model stands in the world.
#pragma once

#include <string>

#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

/// source: a file name or the JSON itself. Four rows of four numbers for column vectors, of which the last is 0 0 0 1,
/// or an object of translation, rotation [x, y, z, w] and scale. Throws InputError with the place of what is wrong, and
/// UsageError for numbers that are neither.
Mat4 readModel(const std::string& source);

/// translation * rotation * scale, as a glTF node has them. The quaternion is normalised. Each entry is the double
/// nearest the true one. Throws CameraError naming translation, rotation or scale where one is out of the range of a
/// camera's numbers or the rotation is zero.
Mat4 worldFromLocal(const Vec3& translation, const Quaternion& rotation, const Vec3& scale);

/// An affine matrix times a homogeneous point: each coordinate the double nearest the exact sum of products; the weight
/// stays. From there on the world point counts as exact. NaN where a number is not finite, infinite where the sum
/// leaves the doubles.
Vec4 toWorld(const Mat4& worldFromLocal, const Vec4& local) noexcept;

}  // namespace viewproj::cmd
