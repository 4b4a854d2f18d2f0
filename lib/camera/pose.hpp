// A pose's numbers, and poses of numbers with more digits than doubles have.
#pragma once

#include <array>
#include <memory>

#include "camera/access.hpp"
#include "numbers/dyadic.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::detail {

/// Of the matrix with these rows, or with these columns.
DoubleDouble determinant(const std::array<DDVec3, 3>& vectors) noexcept;
/// The columns of its inverse, or the rows.
std::array<DDVec3, 3> inverse(const std::array<DDVec3, 3>& vectors) noexcept;

/// Three vectors of the camera in world coordinates.
struct Axes {
  DDVec3 right, up, forward;
};

/// The truth of a pose: with d = point - origin, a point's distances along right, up and forward are
///   scale (row . d + translation)
/// where rows are without any rounding and scales, common factors of a row, within 2^-102.
struct ExactPose {
  using Row = Vector3<Dyadic<3>>;

  std::array<Row, 3> rows;
  std::array<Wide, 3> scale{1, 1, 1};
  Vec3 origin;
  Vec3 translation;
  /// Of an entry once scaled, and of a translation relative to the largest: 0 unless the pose was made of sines and
  /// cosines.
  double error = 0;
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
  /// What rounding the eye left over: zero unless the pose came as cameraFromWorld, whose eye need not be a double, or
  /// as columns.
  DDVec3 residual{};
  std::shared_ptr<const ExactPose> exact;
};

inline const PoseParts& parts(const Pose& pose) noexcept { return *Access::shared(pose); }
Pose made(const PoseParts& parts);

/// Of an exact pose its rows, and columns that are the same.
Pose orthogonal(const ExactPose& exact);

/// The rows, rounded to 2^-100.
Axes roundedRows(const ExactPose& exact) noexcept;

/// Of a row the one entry that is not 0; 3 where there are none or several.
std::size_t onlyEntry(const ExactPose::Row& row) noexcept;

/// Of a row that scale makes one of unit length: where it has one entry alone, this becomes 1 or -1, and its scale 1.
void setUnitRow(ExactPose& exact, std::size_t index, ExactPose::Row row, Wide scale);

/// Whether forward is an axis of the world, exactly, so that W is a coordinate's difference to the eye.
bool forwardIsAxis(const PoseParts& pose) noexcept;

/// The eye to double-double.
DDVec3 unroundedEye(const PoseParts& pose) noexcept;

/// Of right, up, forward: which one each of a camera's axes x, y, z lies along, and its sign.
struct AxisMap {
  std::array<std::size_t, 3> along;
  std::array<double, 3> sign;
};
AxisMap axisMap(CameraAxes axes) noexcept;

/// A vector to more digits than doubles have: each component is within error of this one's.
struct FineVec3 {
  Vector3<Dyadic<1>> value;
  double error = 0;

  FineVec3() = default;
  FineVec3(const Vector3<Dyadic<1>>& v, double e) : value(v), error(e) {}  // {1, 2, 3} is a Vec3
};

/// lookAlong and lookAt with an up of unit length, at positions as small as any double. Parallel is what its digits
/// cannot tell from it.
Pose lookAlong(const Vec3& position, const Vec3& direction, const FineVec3& up, Handedness world);
Pose lookAt(const Vec3& position, const Vec3& target, const FineVec3& up, Handedness world);

/// Axes right, up, forward that are known to be orthogonal and of unit length.
Pose poseFromAxes(const Vec3& position, const std::array<FineVec3, 3>& axes);

/// The camera's x, y, z axes in the world and its eye where they come out of arithmetic in double-double. Names
/// "columns" and "position" where they are wrong. What the inverse of columns rounds to counts as exact from there on.
Pose poseFromColumns(const std::array<DDVec3, 3>& columns, const DDVec3& eye, CameraAxes axes, Handedness world);

}  // namespace viewproj::detail
