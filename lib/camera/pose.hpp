// A pose's numbers, and poses of numbers with more digits than doubles have.
#pragma once

#include <array>

#include "camera/access.hpp"
#include "camera/exact_rows.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::detail {

/// Three vectors of the camera in world coordinates.
struct Axes {
  DDVec3 right, up, forward;
};

/// A pose. With d = point - eye, the point's distances along the camera's axes are
///   X = rows.right . d + residual.x,  Y = rows.up . d + residual.y,  W = rows.forward . d + residual.z
/// and the way back is
///   point = eye + (X - residual.x) columns.right + (Y - residual.y) columns.up + (W - residual.z) columns.forward.
/// Rows and columns are the same for a rotation; they differ for a matrix that is not quite orthogonal.
struct PoseParts {
  Vec3 eye;
  Axes rows;
  Axes columns;
  /// What rounding the eye left over: zero unless the pose came as cameraFromWorld, whose eye need not be a double.
  DDVec3 residual{};
  ExactRows exact;
};

inline const PoseParts& parts(const Pose& pose) noexcept { return *Access::shared(pose); }
Pose made(const PoseParts& parts);

/// The eye to double-double.
DDVec3 unroundedEye(const PoseParts& pose) noexcept;

/// The same with an up of unit length to more than double precision. Parallel is what its digits cannot tell from it.
Pose lookAlong(const Vec3& position, const Vec3& direction, const FineVec3& up, Handedness world);
Pose lookAt(const Vec3& position, const Vec3& target, const FineVec3& up, Handedness world);

/// Axes known to be orthogonal and of unit length.
Pose poseFromAxes(const Vec3& position, const FineVec3& right, const FineVec3& up, const FineVec3& forward);

/// The camera's x, y, z axes in the world and its eye where they come out of arithmetic in double-double. Names
/// "columns" and "position" where they are wrong. What the inverse of columns rounds to counts as exact from there on.
Pose poseFromColumns(const std::array<DDVec3, 3>& columns, const DDVec3& eye, CameraAxes axes, Handedness world);

}  // namespace viewproj::detail
