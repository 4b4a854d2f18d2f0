// A camera, built once: pose, window, viewport and convention, and what projecting needs of them.
#pragma once

#include "viewproj/camera/convention.hpp"
#include "viewproj/camera/pose.hpp"
#include "viewproj/camera/projection.hpp"
#include "viewproj/camera/screen_map.hpp"
#include "viewproj/camera/viewport.hpp"

namespace viewproj {

/// Which arithmetic a result is computed in.
enum class Precision {
  standard,  ///< double, relative to the eye
  exact,     ///< double-double
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

  /// For double arithmetic: the rows scaled to pixels, and window depth = depthOffset + depthScale / W (perspective) or
  /// depthOffset + depthScale * W (orthographic).
  struct Rounded {
    Vec3 eye;
    Vec3 x, y, w;   ///< scaleX * right, scaleY * up, forward
    Vec3 residual;  ///< the pose's, scaled likewise
    double centerX = 0, centerY = 0;
    double depthOffset = 0, depthScale = 0;
    Vec3 rayX, rayY, rayW;  ///< columns: right / scaleX, up / scaleY, forward
  } rounded;
};

/// Throws CameraError where the parts do not make a camera. Takes a microsecond or two: build once, use for every
/// point.
Camera makeCamera(const Pose& pose, const Projection& projection, const Viewport& viewport,
                  const Convention& convention = {});

/// offset + scale / W (perspective) or offset + scale * W (orthographic): the depth that is atNear at near, atFar at
/// far.
struct DepthLine {
  DoubleDouble offset, scale;
};

DepthLine depthLine(const Projection& projection, double atNear, double atFar) noexcept;

}  // namespace viewproj
