// From window coordinates to screen positions: the one affine map of the screen.
#pragma once

#include <cmath>

#include "camera/projection.hpp"
#include "camera/screen_corner.hpp"

namespace viewproj {

/// screen x = centerX + scaleX * h and screen y = centerY + scaleY * v, where (h, v) are the window coordinates right
/// and up: X/W and Y/W in perspective, X and Y in orthographic. (centerX, centerY) is where the viewing axis meets the
/// screen.
struct ScreenMap {
  DoubleDouble centerX, centerY, scaleX, scaleY;
  double reachX = 0, reachY = 0;  ///< the centre is within 2^-97 of this: what it is a sum of, which may cancel
};

/// scaleY is negative where screen y runs downwards.
inline ScreenMap screenMap(const Projection& p, const Viewport& v) noexcept {
  const ScreenCorner corner = screenCorner(v);
  const DoubleDouble width = windowWidth(p);
  const DoubleDouble height = windowHeight(p);
  const bool down = v.origin == Origin::topLeft;
  // The share of the window comes first: it is exactly 1/2 for a symmetric one, which keeps the middle exact.
  const DoubleDouble shareX = -p.left / width;
  const DoubleDouble shareY = (down ? p.top : -p.bottom) / height;
  const DoubleDouble up = DoubleDouble(v.height) / height;
  const auto reach = [](double start, double center, double size, double share, double edges, double window) {
    return 2 * (std::fabs(start) + std::fabs(center) + 0.5 + size * (1 + std::fabs(share) + edges / window));
  };
  return {sumOrZero(corner.x, DoubleDouble(v.width) * shareX),
          sumOrZero(corner.y, DoubleDouble(v.height) * shareY),
          DoubleDouble(v.width) / width,
          down ? -up : up,
          reach(v.x, v.pixelCenter, v.width, shareX.hi, p.reachX, width.hi),
          reach(v.y, v.pixelCenter, v.height, shareY.hi, p.reachY, height.hi)};
}

}  // namespace viewproj
