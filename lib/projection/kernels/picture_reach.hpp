// How far a picture and its surroundings reach.
#pragma once

#include "camera/camera.hpp"

namespace viewproj::detail {

/// How far around the picture `auto` keeps its tolerance: the picture and one more on every side.
inline constexpr double kGuardBand = 3;

/// Farther than any point that is not left to the exact path anyway, in pixels.
inline constexpr double kNoBand = 0x1p1010;

/// How far from the principal point a picture enlarged band times about its middle reaches, in pixels.
struct PictureReach {
  double x = kNoBand, y = kNoBand;
};

PictureReach pictureReach(const CameraParts& camera, double band) noexcept;

}  // namespace viewproj::detail
