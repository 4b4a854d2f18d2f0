// Where a camera stands and how it is turned.
#pragma once

#include <array>

#include "camera/exact_rows.hpp"
#include "numbers/vectors.hpp"
#include "viewproj/convention.hpp"

namespace viewproj {

/// Three vectors of the camera in world coordinates.
struct Axes {
  DDVec3 right, up, forward;
};

/// A pose. With d = point - eye, the point's distances along the camera's axes are
///   X = rows.right . d + residual.x,  Y = rows.up . d + residual.y,  W = rows.forward . d + residual.z
/// and the way back is
///   point = eye + (X - residual.x) columns.right + (Y - residual.y) columns.up + (W - residual.z) columns.forward.
/// Rows and columns are the same for a rotation; they differ for a matrix that is not quite orthogonal.
struct Pose {
  Vec3 eye;
  Axes rows;
  Axes columns;
  /// What rounding the eye left over: zero unless the pose came as cameraFromWorld, whose eye need not be a double.
  DDVec3 residual{};
  ExactRows exact;
};

/// The eye to double-double.
DDVec3 unroundedEye(const Pose& pose) noexcept;

/// Throws CameraError naming "pose" unless it is one that the functions below or a reading gave, of a world of this
/// handedness: numbers finite, axes of unit length and at right angles as kPoseOrthogonality has it of a matrix, and
/// the parts of one pose. Neither a default Pose nor one whose eye was changed is.
void validate(const Pose& pose, Handedness world);

/// x, y, z, w; need not be of unit length.
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

/// How far a pose matrix's 3x3 may be from orthogonal: the largest entry of M^T M - I.
inline constexpr double kPoseOrthogonality = 1e-3;

// Each of these throws CameraError naming the parameter that is not finite, zero or degenerate. Degeneracy is decided
// exactly, without an epsilon: a direction that differs from up by the last bit gives a valid camera. The axes come out
// within 2^-100 of the true ones, whatever the magnitudes.

/// Looks along direction, with up upwards in the picture. The sign of the right axis follows the world's handedness:
/// direction x up in a right-handed world, up x direction in a left-handed one.
Pose lookAlong(const Vec3& position, const Vec3& direction, const Vec3& up, Handedness world);

/// Looks at target; the difference target - position is exact.
Pose lookAt(const Vec3& position, const Vec3& target, const Vec3& up, Handedness world);

/// The same with an up of unit length to more than double precision. Parallel is what its digits cannot tell from it.
Pose lookAlong(const Vec3& position, const Vec3& direction, const FineVec3& up, Handedness world);
Pose lookAt(const Vec3& position, const Vec3& target, const FineVec3& up, Handedness world);

/// Axes known to be orthogonal and of unit length.
Pose poseFromAxes(const Vec3& position, const FineVec3& right, const FineVec3& up, const FineVec3& forward);

/// A rotation from the camera's axes to the world. Throws if axes has not the world's handedness.
Pose poseFromRotation(const Vec3& position, const Quaternion& worldFromCamera, CameraAxes axes, Handedness world);

/// A matrix from the camera's axes to the world, column vectors, last row 0 0 0 1. Used as given and inverted exactly.
Pose poseFromWorldFromCamera(const Mat4& worldFromCamera, CameraAxes axes, Handedness world);

/// The inverse of the above: a view matrix.
Pose poseFromCameraFromWorld(const Mat4& cameraFromWorld, CameraAxes axes, Handedness world);

/// The camera's x, y, z axes in the world and its eye where they come out of arithmetic in double-double. Names
/// "columns" and "position" where they are wrong. What the inverse of columns rounds to counts as exact from there on.
Pose poseFromColumns(const std::array<DDVec3, 3>& columns, const DDVec3& eye, CameraAxes axes, Handedness world);

}  // namespace viewproj
