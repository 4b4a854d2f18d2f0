// Reads the pose of a camera document.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "camera/read_convention.hpp"
#include "camera/values.hpp"
#include "numbers/vectors.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// What world coordinates are: any; Earth-centred, Earth-fixed metres; or east, north and up.
World worldOf(const FieldValues& values);
/// The axes that turns are of in a world: the order's own, or else these.
CameraAxes axesOfOrder(const EulerOrder& order, Handedness world, CameraAxes otherwise);
/// The axes of a rotation: those of the order of euler, if it has its own; cameraAxes; or the preset's.
CameraAxes cameraAxesOf(const FieldValues& values, const ConventionPreset& preset);
/// Why angles of this order cannot describe the camera: an order may have axes of its own. Empty if they can.
std::string faultOfOrder(const NameRow<EulerOrder>& order, const FieldValues& values, Handedness world);

/// The pose; nothing without an orientation. Throws InputError, or CameraError naming a field.
std::optional<Pose> readPose(const FieldValues& values, const DocumentConvention& convention);

/// The eye of worldFromCamera or, if isInverse, of cameraFromWorld. Throws CameraError.
Vec3 eyeOf(const RigidTransform& transform, bool isInverse);

/// How far the axes are from unit vectors at right angles.
double rotationError(const Pose& pose);

}  // namespace viewproj::cmd
