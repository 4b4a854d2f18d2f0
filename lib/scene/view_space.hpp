// A camera's map from the world to its view, and on to the screen, of numbers that lose no digits.
#pragma once

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// Written so that NaN fails.
inline bool isInRange(const Vec3& v) noexcept { return maxAbs(v) <= kFarthestPoint && isFinite(v); }

/// Distances from the eye along right, up and forward.
struct ViewPoint {
  Wide right, up, forward;
};

inline WideVec3 fromEye(const PoseParts& pose, const Vec3& point) noexcept { return toWide(point) - toWide(pose.eye); }

/// One of the three, of what fromEye gives.
inline Wide alongAxis(const DDVec3& row, DoubleDouble residual, const WideVec3& fromEye) noexcept {
  return dot(toWide(row), fromEye) + Wide(residual);
}

inline ViewPoint toView(const PoseParts& pose, const WideVec3& fromEye) noexcept {
  return {alongAxis(pose.rows.right, pose.residual.x, fromEye), alongAxis(pose.rows.up, pose.residual.y, fromEye),
          alongAxis(pose.rows.forward, pose.residual.z, fromEye)};
}

/// On the window at unit distance, or in orthographic in space: what the screen is an affine map of.
struct WindowXY {
  Wide x, y;
};

inline WindowXY onWindow(const CameraParts& c, const ViewPoint& p) noexcept {
  if (c.projection.orthographic) return {p.right, p.up};
  return {p.right / p.forward, p.up / p.forward};
}

inline double screenX(const ScreenMap& m, const Wide& x) noexcept {
  return double(sumOrZero(Wide(m.centerX), Wide(m.scaleX) * x));
}

inline double screenY(const ScreenMap& m, const Wide& y) noexcept {
  return double(sumOrZero(Wide(m.centerY), Wide(m.scaleY) * y));
}

}  // namespace viewproj::detail
