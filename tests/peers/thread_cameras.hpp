// The everyday camera that the thread tests share.
#pragma once

#include <string>

#include "camera/camera.hpp"
#include "measure.hpp"
#include "viewproj/viewproj.hpp"

namespace peers {

inline constexpr viewproj::Viewport kHd{1920, 1080};

/// Stands at (3, 2, 5) and looks at the origin.
inline viewproj::Pose somePose(viewproj::Handedness world = viewproj::Handedness::right) {
  return viewproj::lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, world);
}
/// At the origin, -Z ahead, Y up.
inline viewproj::Pose plainPose() {
  return viewproj::lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, viewproj::Handedness::right);
}
inline viewproj::Projection lens(double near = 0.1, double far = 1000) {
  return viewproj::perspective(60, kHd, near, far);
}

inline bool isNaN(const viewproj::Vec3& v) { return std::isnan(v.x) && std::isnan(v.y) && std::isnan(v.z); }

inline bool isFinite(const viewproj::Mat4& m) {
  for (const auto& row : m.m)
    for (double entry : row)
      if (!std::isfinite(entry)) return false;
  return true;
}

inline bool isUnit(const viewproj::Vec3& v) { return std::fabs(length(v) - 1) <= 4 * kRounding; }

inline constexpr viewproj::Vec2 kPixels[] = {{0, 0}, {960, 540}, {1920, 1080}, {123.25, 987.5}, {1919.5, 0.5}};

}  // namespace peers
