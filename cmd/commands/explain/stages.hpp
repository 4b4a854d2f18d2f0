// Every stage of one point or pixel, for following it by hand.
#pragma once

#include "viewproj/clip.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// How far inside each side of the view a point lies in clip space, as the clip inequalities have it: w + x, w - x and
/// so on; negative outside. NaN: there is no such inequality.
struct ClipMargins {
  double left = 0, right = 0, bottom = 0, top = 0, near = 0, far = 0;
};

/// Every stage of one point or direction, for following it by hand. Each number is the double nearest the true value of
/// that stage, not the product of rounded ones; a sum of this stage that cancels to less than 2^-98 of its terms is 0.
struct PointStages {
  Vec3 world;     ///< the weight divided out; a direction as it is
  Vec3 relative;  ///< world - eye; a direction as it is
  Vec3 view;
  Vec4 clip;
  ClipMargins margins;  ///< infinite far has none
  Vec3 ndc;             ///< NaN where clip.w is not above 0
  ScreenPoint screen;   ///< as worldToScreen gives it, whatever the convention
};

/// NaN for input that is not finite. Takes microseconds: points are followed through exact rows.
PointStages pointStages(const Camera& camera, const Vec4& point, const Convention& convention) noexcept;

/// Every stage of one pixel's way back, for following it by hand. Each number is the double nearest the true value of
/// that stage; a sum that cancels to less than 2^-98 of its terms is 0.
struct PixelStages {
  Vec2 fromCenter;  ///< pixels from where the viewing axis meets the screen
  Vec2 window;      ///< window coordinates right and up: tangents, or in orthographic lengths
  Vec3 toward;      ///< in world axes the way to the plane at distance 1 along the view; in orthographic forward
  double length = 1;
  Ray ray;  ///< as screenToRay gives it, from the plane through the eye
};

PixelStages pixelStages(const Camera& camera, const Vec2& screen) noexcept;

/// From a window depth to the distance along the view: reciprocal is offset + scale depth, its inverse the distance; in
/// orthographic the sum is the distance itself.
struct DepthStages {
  double offset = 0, scale = 0;
  double sum = 0;
  double distance = 0;  ///< NaN unless point.status is point
  WorldPoint point;     ///< as screenToWorld gives it
};

DepthStages depthStages(const Camera& camera, const Vec2& screen, double depth) noexcept;

}  // namespace viewproj::cmd
