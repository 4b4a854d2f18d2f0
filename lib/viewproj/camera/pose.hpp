// Where a camera stands and how it is turned.
#pragma once

#include "viewproj/camera/convention.hpp"
#include "viewproj/numbers/vectors.hpp"

namespace viewproj {

/// Three vectors of the camera in world coordinates.
struct Axes {
  DDVec3 right, up, forward;
};

/// A pose. With d = point - eye, the point's distances along the camera's axes are
///   X = rows.right . d,  Y = rows.up . d,  W = rows.forward . d
/// and the way back is
///   point = eye + X columns.right + Y columns.up + W columns.forward.
/// Rows and columns are the same for a rotation; they differ for a matrix that is not quite orthogonal.
struct Pose {
  DDVec3 eye;
  Axes rows;
  Axes columns;
};

/// Where x, y, z of a rotation or pose matrix point.
enum class CameraAxes { RUB, RUF, RDF, FRU };

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

/// A rotation from the camera's axes to the world. Throws if axes has not the world's handedness.
Pose poseFromRotation(const Vec3& position, const Quaternion& worldFromCamera, CameraAxes axes, Handedness world);

/// A matrix from the camera's axes to the world, column vectors, last row 0 0 0 1. Used as given and inverted exactly.
Pose poseFromWorldFromCamera(const Mat4& worldFromCamera, CameraAxes axes, Handedness world);

/// The inverse of the above: a view matrix.
Pose poseFromCameraFromWorld(const Mat4& cameraFromWorld, CameraAxes axes, Handedness world);

}  // namespace viewproj
