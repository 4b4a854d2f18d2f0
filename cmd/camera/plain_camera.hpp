// Plain numbers put into a document: the pose and the projection of a camera, in the forms that the document has.
#pragma once

#include <array>
#include <cmath>

#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// A copy with its own value. Plain copies of a document share theirs.
Document copied(const Document& document);

/// The projection that a camera's fx and fy state: with the focal lengths of its lens's own formula.
Projection asCalibrated(const CameraFile& camera, const Projection& projection);

/// Position and axes of a camera, the axes as unit vectors.
struct PlainPose {
  Vec3 eye, right, up, forward;
};
PlainPose plainPose(const Pose& pose);

/// East, north and up at a place, in double. (ellipsoidNormal has more digits, and takes a hundred times as long.)
struct LocalAxes {
  Vec3 east{1, 0, 0}, north{0, 1, 0}, up{0, 0, 1};
};
LocalAxes localAxes(const Geodetic& place);

/// The columns of a rotation, and a translation: x -> c[0] x + c[1] y + c[2] z + translation.
using PlainColumns = std::array<Vec3, 3>;
struct PlainRigid {
  PlainColumns columns;
  Vec3 translation;
};
PlainRigid worldFromCamera(const PlainPose& pose, CameraAxes axes);
PlainRigid cameraFromWorld(const PlainPose& pose, CameraAxes axes);
/// The quaternion x, y, z, w of a rotation, with w >= 0.
std::array<double, 4> quaternionOf(const PlainColumns& columns);

/// Where a direction points from the eye, in degrees, in a world of east, north and up or, if worldIsEcef, at the eye's
/// place on the Earth: clockwise from north, from 0 to 360, and above the level plane. Straight up or down the azimuth
/// is NaN, and both are of no direction.
struct Bearing {
  double azimuth, elevation;
};
Bearing bearingOf(const Vec3& direction, const Vec3& eye, bool worldIsEcef);

/// In degrees, in a world of east, north and up or, if worldIsEcef, at the eye's place on the Earth: heading clockwise
/// from north, pitch above the horizon, roll right side down. Straight up or down roll is 0. They compose to the axes.
HeadingPitchRoll headingPitchRollOf(const PlainPose& pose, bool worldIsEcef);

/// The angles that this order lists, in degrees, for a camera whose x, y, z are these axes. The middle turn is -90 to
/// 90 (0 to 180 where the first axis returns, as in ZXZ); where the first and last turn are about one line, the last is
/// 0.
Vec3 eulerDegreesOf(const PlainPose& pose, const EulerOrder& order, CameraAxes axes);
/// Places and axes are rounded: what is left of an angle is certain to about 1e-13 degrees.
inline double certainDegrees(double angle) { return std::round(angle * 1e12) / 1e12 + 0.0; }

/// The camera with this pose, in the document's form of pose: a target at its old distance, and up if it changed; a
/// direction; a rotation; euler angles in their order; heading, pitch and roll (also for a target on the Earth); or a
/// matrix, a quaternion or a rotation vector, in the direction that the document has. A position stays a place on the
/// Earth. The camera must have a pose. Throws InputError for a pose that its world does not have.
Document withPose(const CameraFile& camera, const PlainPose& pose);

/// The camera with this projection of its whole picture, before shift and crop. Keeps the document's form if it can
/// say it: an angle, a focal length or a near size for a window that is centred and of the old shape, edges, fx ... cy,
/// a matrix; a screen becomes a frustum and a rotation. Else the projection becomes intrinsics (without shift), or
/// edges for an orthographic one. near and far stay as written unless they change. A perspective without a viewport
/// keeps only what its form can say, and throws InputError for anything else.
Document withProjection(const CameraFile& camera, const Projection& projection);
/// The same camera, with a frustum and a rotation in place of a screen.
Document withoutScreen(const CameraFile& camera);
/// The projection before shift and crop.
Projection frameProjection(const CameraFile& camera);
/// The projection of the whole picture, before the document's shift, whose tile has fx, fy, cx, cy.
Projection frameProjection(const CameraFile& camera, const Intrinsics& ofTile, double zNear, double zFar);

// ---- Parts of a document

/// Removes what else orients the camera, and sets the field.
void orient(Json& root, FieldId field, Json value);
/// Orients the camera by a rotation.
void putRotation(Json& root, const PlainPose& pose, Handedness world);
/// For column vectors. Without near its z row is 0 0 0 0.
Mat4 clipFromView(const Projection& projection, const Convention& convention);
/// Sets projection.matrix, as the convention writes it; near and far are in it.
void putMatrix(Json& root, const Projection& projection, const Convention& convention);

}  // namespace viewproj::cmd
