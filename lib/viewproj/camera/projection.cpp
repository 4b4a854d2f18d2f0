#include "viewproj/camera/projection.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "viewproj/camera/error.hpp"
#include "viewproj/camera/screen_map.hpp"
#include "viewproj/numbers/degrees.hpp"

namespace viewproj {
namespace {

void requireRange(bool orthographic, double near, double far) {
  if (orthographic) {
    requireFinite(near, "near");
    if (!std::isfinite(far) || (near < far && !std::isfinite(far - near)))
      throw CameraError("far", "must be a finite number in an orthographic projection");
  } else {
    requirePositive(near, "near");
    if (!(far > 0)) throw CameraError("far", "must be a number above near, or infinite");
  }
  if (!(near < far))
    throw CameraError("far", "must be greater than near; for reversed depth keep near < far and set reverseZ");
}

/// The window checked: edges in order, and wide enough for its inverse to be a double.
Projection checked(bool orthographic, DoubleDouble left, DoubleDouble right, DoubleDouble bottom, DoubleDouble top,
                   double near, double far) {
  requireRange(orthographic, near, far);
  const auto requireSide = [](DoubleDouble low, DoubleDouble high, const char* lowName, const char* highName) {
    if (!(isFinite(low) && isFinite(high))) throw CameraError(highName, "makes a window too large for doubles");
    const double width = (high - low).hi;
    if (!(width > 0)) throw CameraError(highName, std::string("must be greater than ") + lowName);
    if (!(width > kSmallestWindow && std::max(std::fabs(low.hi), std::fabs(high.hi)) < kLargestWindow))
      throw CameraError(highName, "makes a window too small or too large for doubles");
  };
  requireSide(left, right, "left", "right");
  requireSide(bottom, top, "bottom", "top");
  return {orthographic, left, right, bottom, top, near, far};
}

Projection symmetric(DoubleDouble halfWidth, DoubleDouble halfHeight, double near, double far) {
  return checked(false, -halfWidth, halfWidth, -halfHeight, halfHeight, near, far);
}

DoubleDouble tangent(double degrees, const char* field) {
  if (!(degrees > 0 && degrees < 180)) throw CameraError(field, "must be an angle between 0 and 180 degrees");
  return tanHalfDegrees(degrees);
}

void requireAspect(DoubleDouble aspect) { requirePositive(aspect.hi, "aspect"); }

}  // namespace

void validate(const Projection& p) {
  const struct {
    DoubleDouble edge;
    const char* name;
  } edges[] = {{p.left, "left"}, {p.right, "right"}, {p.bottom, "bottom"}, {p.top, "top"}};
  for (const auto& [edge, name] : edges) {
    if (!isFinite(edge)) throw CameraError(name, "must be a finite number");
    if (edge.hi + edge.lo != edge.hi)
      throw CameraError(name, "is a double-double whose low part is not below its high");
  }
  checked(p.orthographic, p.left, p.right, p.bottom, p.top, p.near, p.far);
}

Projection perspectiveFovY(double degrees, DoubleDouble aspect, double near, double far) {
  requireAspect(aspect);
  const DoubleDouble halfHeight = tangent(degrees, "fovY");
  return symmetric(halfHeight * aspect, halfHeight, near, far);
}

Projection perspectiveFovX(double degrees, DoubleDouble aspect, double near, double far) {
  requireAspect(aspect);
  const DoubleDouble halfWidth = tangent(degrees, "fovX");
  return symmetric(halfWidth, halfWidth / aspect, near, far);
}

Projection perspectiveFovDiagonal(double degrees, DoubleDouble aspect, double near, double far) {
  requireAspect(aspect);
  // halfWidth = aspect * halfHeight and halfWidth^2 + halfHeight^2 = tangent^2
  const DoubleDouble halfHeight = tangent(degrees, "fovDiagonal") / sqrt(aspect * aspect + DoubleDouble(1));
  return symmetric(halfHeight * aspect, halfHeight, near, far);
}

Projection perspectiveNearSize(double nearWidth, double nearHeight, double near, double far) {
  requirePositive(nearWidth, "nearWidth");
  requirePositive(nearHeight, "nearHeight");
  requireRange(false, near, far);
  return symmetric(timesPowerOfTwo(ratio(nearWidth, near), 0.5), timesPowerOfTwo(ratio(nearHeight, near), 0.5), near,
                   far);
}

Projection perspectiveFocalLength(double focalLength, double sensorWidth, double sensorHeight, DoubleDouble aspect,
                                  double near, double far) {
  requirePositive(focalLength, "focalLength");
  if (sensorWidth == 0 && sensorHeight == 0)
    throw CameraError("focalLength", "needs sensorWidth or sensorHeight, in the same unit");
  if (sensorWidth != 0) requirePositive(sensorWidth, "sensorWidth");
  if (sensorHeight != 0) requirePositive(sensorHeight, "sensorHeight");
  DoubleDouble halfWidth = timesPowerOfTwo(ratio(sensorWidth, focalLength), 0.5);
  DoubleDouble halfHeight = timesPowerOfTwo(ratio(sensorHeight, focalLength), 0.5);
  if (sensorWidth == 0 || sensorHeight == 0) {
    requireAspect(aspect);
    if (sensorWidth == 0) halfWidth = halfHeight * aspect;
    if (sensorHeight == 0) halfHeight = halfWidth / aspect;
  }
  return symmetric(halfWidth, halfHeight, near, far);
}

Projection frustum(double left, double right, double bottom, double top, double near, double far) {
  requireRange(false, near, far);
  return checked(false, ratio(left, near), ratio(right, near), ratio(bottom, near), ratio(top, near), near, far);
}

Projection perspectiveWindow(DoubleDouble left, DoubleDouble right, DoubleDouble bottom, DoubleDouble top, double near,
                             double far) {
  return checked(false, left, right, bottom, top, near, far);
}

Projection orthographic(DoubleDouble left, DoubleDouble right, DoubleDouble bottom, DoubleDouble top, double near,
                        double far) {
  return checked(true, left, right, bottom, top, near, far);
}

Projection intrinsics(DoubleDouble fx, DoubleDouble fy, double cx, double cy, const Viewport& viewport, double near,
                      double far) {
  validate(viewport);
  requirePositive(fx.hi, "fx");
  requirePositive(fy.hi, "fy");
  requireFinite(cx, "cx");
  requireFinite(cy, "cy");
  // Screen position of the picture's left edge and of its edge where y starts.
  const ScreenCorner corner = screenCorner(viewport);
  const DoubleDouble fromLeft = DoubleDouble(cx) - corner.x;
  const DoubleDouble fromStart = DoubleDouble(cy) - corner.y;
  const DoubleDouble toEnd = DoubleDouble(viewport.height) - fromStart;
  const bool down = viewport.origin == Origin::topLeft;
  return checked(false, -(fromLeft / fx), (DoubleDouble(viewport.width) - fromLeft) / fx,
                 -((down ? toEnd : fromStart) / fy), (down ? fromStart : toEnd) / fy, near, far);
}

Projection shifted(const Projection& p, double dx, double dy) {
  if (!(std::isfinite(dx) && std::isfinite(dy))) throw CameraError("shift", "must be two finite numbers");
  const DoubleDouble x = DoubleDouble(dx) * timesPowerOfTwo(p.right - p.left, 0.5);
  const DoubleDouble y = DoubleDouble(dy) * timesPowerOfTwo(p.top - p.bottom, 0.5);
  return checked(p.orthographic, p.left - x, p.right - x, p.bottom - y, p.top - y, p.near, p.far);
}

Projection cropped(const Projection& p, const Viewport& viewport, const Crop& crop) {
  validate(cropped(viewport, crop));
  const DoubleDouble xEnd = twoSum(crop.x, crop.width);
  const DoubleDouble yEnd = twoSum(crop.y, crop.height);
  const auto across = [&](DoubleDouble x) { return p.left + (p.right - p.left) * (x / DoubleDouble(viewport.width)); };
  const DoubleDouble start = viewport.origin == Origin::topLeft ? p.top : p.bottom;
  const DoubleDouble end = viewport.origin == Origin::topLeft ? p.bottom : p.top;
  const auto along = [&](DoubleDouble y) { return start + (end - start) * (y / DoubleDouble(viewport.height)); };
  const DoubleDouble first = along(crop.y);
  const DoubleDouble last = along(yEnd);
  const bool down = viewport.origin == Origin::topLeft;
  return checked(p.orthographic, across(crop.x), across(xEnd), down ? last : first, down ? first : last, p.near, p.far);
}

DoubleDouble windowAspect(const Projection& p) { return (p.right - p.left) / (p.top - p.bottom); }

}  // namespace viewproj
