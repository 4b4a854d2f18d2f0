// The matrices of a camera's parts: of a camera that has them, and others of no account.
#pragma once

#include "viewproj/matrices.hpp"

namespace viewproj {

inline Camera cameraOfParts(const Pose& pose, const Projection& projection, const Viewport& viewport, Convention c) {
  c.world = pose.world();
  return makeCamera(pose, projection, viewport, c);
}
inline Camera cameraOfParts(const Pose& pose, const Convention& c) {
  return cameraOfParts(pose, orthographic(-1, 1, -1, 1, 0, 1), {1, 1}, c);
}
inline Pose anyPose(const Convention& c) { return lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, c.world); }
inline Camera cameraOfParts(const Projection& p, const Convention& c, const Viewport& v = {1, 1}) {
  return cameraOfParts(anyPose(c), p, v, c);
}

inline Mat4 viewFromWorld(const Pose& p, const Convention& c) {
  return matrix(cameraOfParts(p, c), Space::view, Space::world);
}
inline Mat4 worldFromView(const Pose& p, const Convention& c) {
  return matrix(cameraOfParts(p, c), Space::world, Space::view);
}
inline Mat4 clipFromView(const Projection& p, const Convention& c) {
  return matrix(cameraOfParts(p, c), Space::clip, Space::view);
}
inline Mat4 viewFromClip(const Projection& p, const Convention& c) {
  return matrix(cameraOfParts(p, c), Space::view, Space::clip);
}
inline Mat4 clipFromWorld(const Pose& pose, const Projection& p, const Convention& c) {
  return matrix(cameraOfParts(pose, p, {1, 1}, c), Space::clip, Space::world);
}
inline Mat4 worldFromClip(const Pose& pose, const Projection& p, const Convention& c) {
  return matrix(cameraOfParts(pose, p, {1, 1}, c), Space::world, Space::clip);
}
inline Mat4 screenFromWorld(const Pose& pose, const Projection& p, const Viewport& v, const Convention& c) {
  return matrix(cameraOfParts(pose, p, v, c), Space::screen, Space::world);
}
inline Mat4 screenFromNdc(const Viewport& v, const Convention& c) {
  return matrix(cameraOfParts(orthographic(-1, 1, -1, 1, 0, 1), c, v), Space::screen, Space::ndc);
}
inline Vec3 worldToNdc(const Camera& camera, const Vec4& point, const Convention& c) {
  const Vec4 p = worldTo(camera, Space::ndc, point, c);
  return {p.x, p.y, p.z};
}
inline Vec3 worldToView(const Camera& camera, const Vec4& point, const Convention& c) {
  const Vec4 p = worldTo(camera, Space::view, point, c);
  return {p.x, p.y, p.z};
}

}  // namespace viewproj
