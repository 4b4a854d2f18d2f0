// The --model option: the transformation of a model to the world.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

/// The product of a chain, base first: of each a file name, the JSON itself or a pose. Four rows of four numbers for
/// column vectors, with last row 0 0 0 1, or an object of translation, rotation [x, y, z, w] and scale. Throws
/// InputError with the place of the error, and UsageError for a list of numbers that is neither.
Mat4 readModel(const std::vector<std::string>& chain);

/// translation * rotation * scale, as in a glTF node. The quaternion is normalised. Each entry is the double nearest
/// the true one. Throws CameraError naming translation, rotation or scale if one is out of a camera's range, or if the
/// rotation is zero.
Mat4 worldFromLocal(const Vec3& translation, const Quaternion& rotation, const Vec3& scale);

/// The inverse of an affine matrix, in double-double, each entry rounded; nothing of one that has none.
std::optional<Mat4> inverseOfAffine(const Mat4& m);

/// An affine matrix times a homogeneous point: each coordinate is the double nearest the exact sum of products, and
/// counts as exact afterwards. The weight stays. NaN if a number is not finite, infinite if the sum is beyond all
/// doubles.
Vec4 toWorld(const Mat4& worldFromLocal, const Vec4& local) noexcept;

}  // namespace viewproj::cmd
