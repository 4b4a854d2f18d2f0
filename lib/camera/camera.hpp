// A camera's numbers: pose, window, viewport and convention, and what projecting needs of them.
#pragma once

#include "camera/pose.hpp"
#include "camera/projection.hpp"

namespace viewproj::detail {

/// screen x = centerX + scaleX * h and screen y = centerY + scaleY * v, where (h, v) are the window coordinates right
/// and up: X/W and Y/W in perspective, X and Y in orthographic. (centerX, centerY) is where the viewing axis meets the
/// screen. scaleY is negative where screen y runs downwards.
struct ScreenMap {
  DoubleDouble centerX, centerY, scaleX, scaleY;
  double reachX = 0, reachY = 0;  ///< the centre is within 2^-97 of this: what it is a sum of, which may cancel
};

/// A row of three in two parts: high has 25 bits of the largest entry, all multiples of one power of two, low the rest.
struct SplitRow {
  Vec3 high, low;
};

struct LensParts;

/// What projecting a point needs of a camera. In perspective, with d = point - eye and q = (x . d) / (w . d),
///   screen x = centerX + q,  window depth = depthOffset + depthScale / (w . d)
/// in orthographic
///   screen x = centerX + x . d,  window depth = depthOffset + depthScale (w . d)
/// and through a lens, where q is a tangent
///   screen x = centerX + scaleX bent(q).
struct ProjectionConstants {
  bool orthographic = false;
  Vec3 eye;
  DDVec3 x, y, w;  ///< rows scaled to pixels: scaleX right, scaleY up, forward; of a lens right and down
  SplitRow splitX, splitY, splitW;  ///< of the same rows
  DDVec3 residual;                  ///< the pose's, scaled likewise, to be added to x . d, y . d, w . d
  DoubleDouble centerX, centerY, depthOffset, depthScale;  ///< depthOffset: NaN where there is no depth

  /// forward is an axis of the world, and residual 0: W is a coordinate's difference to the eye, without an error.
  bool forwardIsAxis = false;

  double reachX = 0, reachY = 0;  ///< ScreenMap's
  double sizeXY = 0, sizeW = 0;   ///< largest entry of x and y, and of w
  double residualReach = 0;       ///< the residual's part in |d0| + |d1| + |d2|, as error bounds count it

  Vec3 rayX, rayY, rayW;  ///< columns: right / scaleX, up / scaleY, forward

  const LensParts* lens = nullptr;
  DoubleDouble scaleX, scaleY;  ///< of a lens, scaleY of what is down
};

/// Made by makeCamera; what follows the four parts is derived from them.
struct CameraParts {
  PoseParts pose;
  ProjectionParts projection;
  Viewport viewport;
  Convention convention;

  ScreenMap screen;

  double depthAtNear = NAN, depthAtFar = NAN;  ///< window depths, reverseZ taken into account
  double depthAtInfinity = NAN;                ///< perspective: the limit of window depth along the view, rounded

  PictureCorners corners;  ///< a tie of two doubles is rounded outwards

  DDVec3 eye;  ///< unrounded
  /// Orthographic: the ray of a screen position starts at eye + (x - centerX) perX + (y - centerY) perY.
  DDVec3 perX, perY;
  Vec3 direction;

  ProjectionConstants constants;

  /// Null without a lens. With one, all of the above but the rows in constants is that of the camera without it:
  /// pinhole.
  std::shared_ptr<const LensParts> lens;
  std::shared_ptr<const CameraParts> pinhole;
};

/// Of a camera without a lens.
Camera withLens(const Camera& pinhole, std::shared_ptr<const LensParts> lens);

inline const CameraParts& parts(const Camera& camera) noexcept { return *Access::shared(camera); }

}  // namespace viewproj::detail
