// The numbers of a camera: pose, window, viewport and convention, and the constants for projecting.
#pragma once

#include "camera/pose.hpp"
#include "camera/projection.hpp"

namespace viewproj::detail {

/// screen x = centerX + scaleX * h and screen y = centerY + scaleY * v, where (h, v) are the window coordinates right
/// and up: X/W and Y/W in perspective, X and Y in orthographic. (centerX, centerY) is where the viewing axis meets the
/// screen. scaleY is negative where screen y runs downwards.
struct ScreenMap {
  DoubleDouble centerX, centerY, scaleX, scaleY;
  double reachX = 0, reachY = 0;  ///< the centre's error is below 2^-97 of this, the size of the terms it is the sum of
};

/// A row of three in two parts: high has 25 bits of the largest entry, multiples of one power of two; low has the rest.
struct SplitRow {
  Vec3 high, low;
};

struct LensParts;

/// The constants for projecting a point. In perspective, with d = point - eye and q = (x . d) / (w . d),
///   screen x = centerX + q,  window depth = depthOffset + depthScale / (w . d)
/// in orthographic
///   screen x = centerX + x . d,  window depth = depthOffset + depthScale (w . d)
/// and through a lens, which puts the distances at (h, v)
///   screen x = centerX + scaleX h.
struct ProjectionConstants {
  bool orthographic = false;
  Vec3 eye;
  DDVec3 x, y, w;                   ///< rows scaled to pixels: scaleX right, scaleY up, forward; unscaled with a lens
  SplitRow splitX, splitY, splitW;  ///< the same rows, split
  DDVec3 residual;                  ///< the pose's residual, scaled likewise, added to x . d, y . d, w . d
  DoubleDouble centerX, centerY, depthOffset, depthScale;  ///< depthOffset: NaN without depth

  /// forward is an axis of the world and residual is 0: W is a coordinate minus the eye's, without error.
  bool forwardIsAxis = false;

  double reachX = 0, reachY = 0;  ///< copied from ScreenMap
  double sizeXY = 0, sizeW = 0;   ///< largest entry of x and y, and of w
  double residualReach = 0;       ///< the residual's part of |d0| + |d1| + |d2| in error bounds

  Vec3 rayX, rayY, rayW;  ///< columns: right / scaleX, up / scaleY, forward; with a lens right, down, forward

  const LensParts* lens = nullptr;
  DoubleDouble scaleX, scaleY;        ///< of a lens, scaleY of what is down
  DoubleDouble perScaleX, perScaleY;  ///< 1 / (scaleX times the lens's own scale)
};

/// Made by makeCamera. The first four parts are the input, the rest is derived from them.
struct CameraParts {
  PoseParts pose;
  ProjectionParts projection;
  Viewport viewport;
  Convention convention;

  ScreenMap screen;

  double depthAtNear = NAN, depthAtFar = NAN;  ///< window depths, with reverseZ applied
  double depthAtInfinity = NAN;  ///< perspective: the limit of window depth along the viewing axis, rounded

  PictureCorners corners;  ///< outwards where a tie of two doubles is rounded

  DDVec3 eye;  ///< unrounded
  /// Orthographic: the ray of a screen position starts at eye + (x - centerX) perX + (y - centerY) perY.
  DDVec3 perX, perY;
  Vec3 direction;

  ProjectionConstants constants;

  /// Null without a lens. With a lens, everything above belongs to the camera without it, which is pinhole, except the
  /// rows in constants.
  Shared<LensParts> lens;
  Shared<CameraParts> pinhole;
};

/// The same camera with this lens, of this scale. pinhole must have none.
Camera withLens(const Camera& pinhole, const Shared<LensParts>& lens, DoubleDouble scale);

inline const CameraParts& parts(const Camera& camera) noexcept { return *Access::shared(camera); }

}  // namespace viewproj::detail
