// A screen position in window coordinates, and the world's point there, before they are rounded. Internal.
#pragma once

#include "camera/camera.hpp"
#include "lens/lens.hpp"
#include "numbers/wide.hpp"

namespace viewproj::detail {

/// A screen position in window coordinates, right and up.
template <class Number>
struct WindowPoint {
  Number right, up;
};

/// Before the camera's lens, if it has one; NaN where no point has this pixel.
template <class Number>
WindowPoint<Number> toWindow(const CameraParts& c, const Vec2& screen) noexcept {
  if (c.lens) {
    const WindowPoint<DoubleDouble> bent = toWindow<DoubleDouble>(*c.pinhole, screen);
    const Tangents<DoubleDouble> at = undistort(*c.lens, {bent.right, -bent.up}).at;
    return {as<Number>(at.x), as<Number>(-at.y)};
  }
  return {sumOrZero(as<Number>(screen.x), -as<Number>(c.screen.centerX)) / as<Number>(c.screen.scaleX),
          sumOrZero(as<Number>(screen.y), -as<Number>(c.screen.centerY)) / as<Number>(c.screen.scaleY)};
}

/// The offset from the unrounded eye of the point at a window position and distance.
template <class Number>
Vector3<Number> offsetAt(const CameraParts& c, const WindowPoint<Number>& at, Number distance) noexcept {
  const Axes& axes = c.pose.columns;
  const Number spread = c.projection.orthographic ? as<Number>(1) : distance;
  const Vector3<Number> along{at.right * spread, at.up * spread, distance};
  const auto part = [&](std::size_t i) {
    return dotOrZero(as<Number>(DDVec3{axes.right[i], axes.up[i], axes.forward[i]}), along);
  };
  return {part(0), part(1), part(2)};
}

}  // namespace viewproj::detail
