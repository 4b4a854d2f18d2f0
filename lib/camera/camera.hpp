// A camera, built once: pose, window, viewport and convention, and what projecting needs of them.
#pragma once

#include "camera/pose.hpp"
#include "camera/projection.hpp"
#include "camera/screen_map.hpp"
#include "camera/viewport.hpp"
#include "viewproj/convention.hpp"

namespace viewproj {

/// Which arithmetic a result is computed in: each rung costs more and promises more.
enum class Precision {
  fast,      ///< float32 after the eye is subtracted in double
  standard,  ///< double, relative to the eye
  exact,     ///< the double nearest the true value
};

/// What projecting a point needs of a camera. In perspective, with d = point - eye and q = (x . d) / (w . d),
///   screen x = centerX + q,  window depth = depthOffset + depthScale / (w . d)
/// and in orthographic
///   screen x = centerX + x . d,  window depth = depthOffset + depthScale (w . d).
struct ProjectionConstants {
  bool orthographic = false;
  Vec3 eye;
  DDVec3 x, y, w;   ///< rows scaled to pixels: scaleX right, scaleY up, forward
  DDVec3 residual;  ///< the pose's, scaled likewise, to be added to x . d, y . d, w . d
  DoubleDouble centerX, centerY, depthOffset, depthScale;

  /// forward is an axis of the world, and residual 0: W is a coordinate's difference to the eye, without an error.
  bool forwardIsAxis = false;

  double reachX = 0, reachY = 0;  ///< ScreenMap's
  /// Of the centre, the depth's offset and scale, near and far, the pixels for a unit of the window and their inverses,
  /// the largest; infinite where one is not a normal double.
  double range = 0;
  double sizeXY = 0, sizeW = 0;  ///< largest entry of x and y, and of w
  double farthest = 0;           ///< the larger of |near| and |far|
  double residualReach = 0;      ///< the residual's part in |d0| + |d1| + |d2|, as error bounds count it

  Vec3 rayX, rayY, rayW;  ///< columns: right / scaleX, up / scaleY, forward
};

/// Made by makeCamera; what follows the four parts is derived from them.
struct Camera {
  Pose pose;
  Projection projection;
  Viewport viewport;
  Convention convention;

  ScreenMap screen;

  double depthAtNear = 0;  ///< window depths of near and far, reverseZ taken into account
  double depthAtFar = 1;
  double depthAtInfinity = 1;  ///< perspective: the limit of window depth along the view, rounded
  DoubleDouble
      farOverRange;  ///< far / (far - near) in perspective (1 for infinite far), 1 / (far - near) in orthographic

  ProjectionConstants constants;
};

/// Throws CameraError where validate does of one of the parts (pose.hpp, projection.hpp, viewport.hpp), so where the
/// pose is not of the convention's handedness too, where arithmeticFault() has one, and where window and viewport leave
/// no doubles to tell pixels apart. Takes a few microseconds: build once, use for every point.
Camera makeCamera(const Pose& pose, const Projection& projection, const Viewport& viewport,
                  const Convention& convention = {});

/// offset + scale / W (perspective) or offset + scale * W (orthographic): the depth that is atNear at near, atFar at
/// far.
struct DepthLine {
  DoubleDouble offset, scale;
};

DepthLine depthLine(const Projection& projection, double atNear, double atFar) noexcept;

}  // namespace viewproj
