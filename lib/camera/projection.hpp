// What part of space a camera sees: four window edges, near and far.
//
// Every way to describe a lens is a function here that ends in those six numbers. To add one, add a function that
// computes the edges, and a branch to the camera file's reader.
#pragma once

#include <limits>

#include "camera/viewport.hpp"
#include "numbers/double_double.hpp"

namespace viewproj {

/// Edges are distances along the right and the up axis: in perspective on the plane at distance 1 from the eye
/// (tangents), in orthographic anywhere. near and far are distances along the viewing axis.
struct Projection {
  bool orthographic = false;
  DoubleDouble left, right, bottom, top;
  double near = 0;
  double far = 0;  ///< may be infinite in perspective

  /// right - left and top - bottom to 2^-98 of themselves, which edges that lie far off the axis do not give; 0: they
  /// do.
  DoubleDouble width{}, height{};
  /// The largest number that left and right, and that bottom and top, were computed from: each is within 2^-98 of it.
  /// 0: the larger of the two edges.
  double reachX = 0, reachY = 0;
};

inline DoubleDouble windowWidth(const Projection& p) noexcept { return p.width.hi > 0 ? p.width : p.right - p.left; }
inline DoubleDouble windowHeight(const Projection& p) noexcept { return p.height.hi > 0 ? p.height : p.top - p.bottom; }

inline constexpr double kInfiniteFar = std::numeric_limits<double>::infinity();

// Each function throws CameraError naming the parameter at fault. Perspective needs 0 < near < far <= infinity,
// orthographic finite near < far. Edges come out within 2^-98 of the true ones, relative to the wider of the two.

/// The same of one that was put together by hand: edges normalised (hi + lo rounds to hi), in order and within the
/// limits of a window, near and far as above.
void validate(const Projection& projection);

/// degrees: the full vertical, horizontal or diagonal angle, between 0 and 180; aspect: width / height of the picture.
Projection perspectiveFovY(double degrees, DoubleDouble aspect, double near, double far);
Projection perspectiveFovX(double degrees, DoubleDouble aspect, double near, double far);
Projection perspectiveFovDiagonal(double degrees, DoubleDouble aspect, double near, double far);

/// The window's width and height on the near plane (XMMatrixPerspectiveLH).
Projection perspectiveNearSize(double nearWidth, double nearHeight, double near, double far);

/// focalLength and the sensor's sides in one unit; a sensor side of 0 follows from the other and aspect.
Projection perspectiveFocalLength(double focalLength, double sensorWidth, double sensorHeight, DoubleDouble aspect,
                                  double near, double far);

/// Edges on the near plane (glFrustum).
Projection frustum(double left, double right, double bottom, double top, double near, double far);

/// Edges on the plane at distance 1 from the eye: tangents.
Projection perspectiveWindow(DoubleDouble left, DoubleDouble right, DoubleDouble bottom, DoubleDouble top, double near,
                             double far);

/// Edges anywhere along the view (glOrtho); near may be negative.
Projection orthographic(DoubleDouble left, DoubleDouble right, DoubleDouble bottom, DoubleDouble top, double near,
                        double far);

/// Focal lengths and principal point in pixels of the viewport, as its origin and pixelCenter count them.
Projection intrinsics(DoubleDouble fx, DoubleDouble fy, double cx, double cy, const Viewport& viewport, double near,
                      double far);

/// The picture moved right by dx and up by dy half-widths and half-heights (lens shift, jitter).
Projection shifted(const Projection& projection, double dx, double dy);

/// The window of a tile of the viewport's picture; its viewport is cropped(viewport, crop).
Projection cropped(const Projection& projection, const Viewport& viewport, const Crop& crop);

/// Width / height of the window.
DoubleDouble windowAspect(const Projection& projection);

}  // namespace viewproj
