// The numbers of a pose, and poses from numbers with more digits than doubles have.
#pragma once

#include <array>

#include "camera/access.hpp"
#include "numbers/dyadic.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::detail {

/// The determinant of the matrix with these rows, or with these columns.
DoubleDouble determinant(const std::array<DDVec3, 3>& vectors) noexcept;
/// The columns of the inverse of the matrix with these rows; or the rows for these columns.
std::array<DDVec3, 3> inverse(const std::array<DDVec3, 3>& vectors) noexcept;

/// The camera's axes in world coordinates.
struct Axes {
  DDVec3 right, up, forward;
};

/// The exact numbers of a pose. With d = point - origin, a point's distances along right, up and forward are
///   scale (row . d + translation)
/// where rows have no rounding error and scales, common factors of a row, are within 2^-102.
struct ExactPose {
  using Row = Vector3<Dyadic<3>>;

  std::array<Row, 3> rows;
  std::array<Wide, 3> scale{1, 1, 1};
  Vec3 origin;
  Vec3 translation;
};

/// A pose. With d = point - eye, the point's distances along the camera's axes are
///   X = rows.right . d + residual.x,  Y = rows.up . d + residual.y,  W = rows.forward . d + residual.z
/// and the way back is
///   point = eye + (X - residual.x) columns.right + (Y - residual.y) columns.up + (W - residual.z) columns.forward.
/// Rows and columns are equal for a rotation. They differ for a matrix that is not quite orthogonal.
struct PoseParts {
  Vec3 eye;
  Axes rows;
  Axes columns;
  /// The remainder of rounding the eye. Zero unless the pose was given as cameraFromWorld, whose eye need not be a
  /// double, or as columns.
  DDVec3 residual{};
  Shared<ExactPose> exact;
  PoseError error{};
};

inline const PoseParts& parts(const Pose& pose) noexcept { return *Access::shared(pose); }
Pose made(const PoseParts& parts);

/// A pose with these rows, and with columns equal to them.
Pose orthogonal(const ExactPose& exact);

/// The rows of the pose, within 2^-100.
Axes roundedRows(const ExactPose& exact) noexcept;

/// The index of the row's only entry that is not 0; 3 if there is none or more than one.
std::size_t onlyEntry(const ExactPose::Row& row) noexcept;

/// Sets a row that scale makes unit length. If it has only one entry, that entry becomes 1 or -1 and the scale 1.
void setUnitRow(ExactPose& exact, std::size_t index, ExactPose::Row row, Wide scale);

/// Whether forward is exactly an axis of the world, so that W is a coordinate minus the eye's.
bool forwardIsAxis(const PoseParts& pose) noexcept;

/// The eye in double-double.
DDVec3 unroundedEye(const PoseParts& pose) noexcept;

/// For each of a camera's axes x, y, z: its index in (right, up, forward), and its sign.
struct AxisMap {
  std::array<std::size_t, 3> along;
  std::array<double, 3> sign;
};
AxisMap axisMap(CameraAxes axes) noexcept;

/// A vector with more digits than doubles have. They count as exact.
using FineVec3 = Vector3<Dyadic<1>>;

/// lookAlong and lookAt with such an up.
Pose lookAlongWithUp(const Vec3& position, const Vec3& direction, const FineVec3& up, Handedness world);
Pose lookAtWithUp(const Vec3& position, const Vec3& target, const FineVec3& up, Handedness world);

/// A pose from its axes right, up, forward, which must be orthogonal and of unit length.
Pose poseFromAxes(const Vec3& position, const std::array<FineVec3, 3>& axes);

/// The camera's x, y, z axes and its eye in the world, from double-double arithmetic. Throws naming "columns" or
/// "position". The rounded inverse of the columns counts as exact afterwards.
Pose poseFromColumns(const std::array<DDVec3, 3>& columns, const DDVec3& eye, CameraAxes axes);

}  // namespace viewproj::detail
