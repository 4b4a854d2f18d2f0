#include "camera/attempts.hpp"

namespace viewproj {

using namespace detail;

Result<Pose> tryLookAlong(const Vec3& position, const Vec3& direction, const Vec3& up, Handedness world) noexcept {
  return attempt([&] { return lookAlong(position, direction, up, world); });
}

Result<Pose> tryLookAt(const Vec3& position, const Vec3& target, const Vec3& up, Handedness world) noexcept {
  return attempt([&] { return lookAt(position, target, up, world); });
}

Result<Pose> tryPoseFromRotation(const Vec3& position, const Quaternion& worldFromCamera, CameraAxes axes,
                                 Handedness world) noexcept {
  return attempt([&] { return poseFromRotation(position, worldFromCamera, axes, world); });
}

Result<Pose> tryPoseFromWorldFromCamera(const Mat4& worldFromCamera, CameraAxes axes, Handedness world) noexcept {
  return attempt([&] { return poseFromWorldFromCamera(worldFromCamera, axes, world); });
}

Result<Pose> tryPoseFromCameraFromWorld(const Mat4& cameraFromWorld, CameraAxes axes, Handedness world) noexcept {
  return attempt([&] { return poseFromCameraFromWorld(cameraFromWorld, axes, world); });
}

Result<Projection> tryPerspectiveFovY(double degrees, double aspect, double zNear, double zFar) noexcept {
  return attempt([&] { return perspectiveFovY(degrees, aspect, zNear, zFar); });
}

Result<Projection> tryPerspectiveFovX(double degrees, double aspect, double zNear, double zFar) noexcept {
  return attempt([&] { return perspectiveFovX(degrees, aspect, zNear, zFar); });
}

Result<Projection> tryPerspectiveFovDiagonal(double degrees, double aspect, double zNear, double zFar) noexcept {
  return attempt([&] { return perspectiveFovDiagonal(degrees, aspect, zNear, zFar); });
}

Result<Projection> tryPerspectiveNearSize(double nearWidth, double nearHeight, double zNear, double zFar) noexcept {
  return attempt([&] { return perspectiveNearSize(nearWidth, nearHeight, zNear, zFar); });
}

Result<Projection> tryPerspectiveFocalLength(double focalLength, double sensorWidth, double sensorHeight, double aspect,
                                             double zNear, double zFar) noexcept {
  return attempt([&] { return perspectiveFocalLength(focalLength, sensorWidth, sensorHeight, aspect, zNear, zFar); });
}

Result<Projection> tryFrustum(double left, double right, double bottom, double top, double zNear,
                              double zFar) noexcept {
  return attempt([&] { return frustum(left, right, bottom, top, zNear, zFar); });
}

Result<Projection> tryPerspectiveWindow(double left, double right, double bottom, double top, double zNear,
                                        double zFar) noexcept {
  return attempt([&] { return perspectiveWindow(left, right, bottom, top, zNear, zFar); });
}

Result<Projection> tryOrthographic(double left, double right, double bottom, double top, double zNear,
                                   double zFar) noexcept {
  return attempt([&] { return orthographic(left, right, bottom, top, zNear, zFar); });
}

Result<Projection> tryIntrinsics(double fx, double fy, double cx, double cy, const Viewport& viewport, double zNear,
                                 double zFar) noexcept {
  return attempt([&] { return intrinsics(fx, fy, cx, cy, viewport, zNear, zFar); });
}

Result<Projection> tryShifted(const Projection& projection, double dx, double dy) noexcept {
  return attempt([&] { return shifted(projection, dx, dy); });
}

Result<Projection> tryCropped(const Projection& projection, const Viewport& viewport, const Crop& crop) noexcept {
  return attempt([&] { return cropped(projection, viewport, crop); });
}

Result<Camera> tryMakeCamera(const Pose& pose, const Projection& projection, const Viewport& viewport,
                             const Convention& convention) noexcept {
  return attempt([&] { return makeCamera(pose, projection, viewport, convention); });
}

}  // namespace viewproj
