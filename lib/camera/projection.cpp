#include "camera/projection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "camera/require.hpp"
#include "camera/viewport.hpp"
#include "numbers/degrees.hpp"

namespace viewproj {

using namespace detail;
namespace {

DoubleDouble ratio(double a, double b) { return DoubleDouble(a) / DoubleDouble(b); }
DoubleDouble half(DoubleDouble a) { return timesPowerOfTwo(a, 0.5); }

void requireRange(bool orthographic, double near, double far) {
  if (orthographic) {
    requireNumber(near, "near");
    if (!std::isfinite(far)) throw CameraError("far", "must be a finite number in an orthographic projection");
  } else {
    if (near != 0) requirePositive(near, "near");
    if (!(far > 0)) throw CameraError("far", "must be a number above near, or infinite");
  }
  if (std::isfinite(far)) requireNumber(far, "far");
  if (near < far) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", near);
  throw CameraError("far", "must be greater than near, " + std::string(text) +
                               "; for reversed depth keep near < far and set reverseZ");
}

void requireSide(DoubleDouble low, DoubleDouble high, DoubleDouble width, double reach, const char* lowName,
                 const char* highName) {
  const double farthest = std::max({std::fabs(low.hi), std::fabs(high.hi), reach});
  if (!isFinite(low) || !isFinite(high) || !(farthest <= 2 * kLargestNumber))  // leaves room for rounding
    throw CameraError(highName, "makes a window that reaches beyond 1e45");
  if (!(width.hi > 0)) throw CameraError(highName, std::string("must be greater than ") + lowName);
  if (!(width.hi >= kSmallestNumber)) throw CameraError(highName, "makes a window smaller than 1e-45");
}

/// Throws unless the window's edges are in order and its size is in range.
void check(const ProjectionParts& p) {
  requireRange(p.orthographic, p.near, p.far);
  requireSide(p.left, p.right, windowWidth(p), p.reachX, "left", "right");
  requireSide(p.bottom, p.top, windowHeight(p), p.reachY, "bottom", "top");
}

Projection symmetric(DoubleDouble halfWidth, DoubleDouble halfHeight, double near, double far,
                     bool orthographic = false) {
  return made({orthographic, -halfWidth, halfWidth, -halfHeight, halfHeight, near, far});
}

/// A window that was shifted or cropped. Throws if the shift is so large that too many digits are lost.
Projection moved(const ProjectionParts& p, const char* fieldX, const char* fieldY) {
  constexpr double kLargestMove = 0x1p32;
  const auto require = [](double reach, DoubleDouble low, DoubleDouble high, const char* field) {
    if (reach > kLargestMove * std::max(std::fabs(low.hi), std::fabs(high.hi)))
      throw CameraError(field, "leaves less than 2e-10 of the window, or of its distance from the viewing axis");
  };
  check(p);
  require(p.reachX, p.left, p.right, fieldX);
  require(p.reachY, p.bottom, p.top, fieldY);
  return made(p);
}

/// The reach of edges computed from these.
double largest(double reach, DoubleDouble a, DoubleDouble b) {
  return std::max({reach, std::fabs(a.hi), std::fabs(b.hi)});
}

DoubleDouble tangentOfHalf(Angle angle, const char* field) {
  const DoubleDouble tangent = angle.isRadians ? tanHalfRadians(angle.value) : tanHalfDegrees(angle.value);
  if (!(tangent.hi > 0)) throw CameraError(field, "must be an angle between 0 and 180 degrees");
  return tangent;
}

void requireEdges(double left, double right, double bottom, double top) {
  requireNumber(left, "left");
  requireNumber(right, "right");
  requireNumber(bottom, "bottom");
  requireNumber(top, "top");
}

DoubleDouble ratioOf(Aspect aspect) {
  requirePositive(aspect.width, "aspect");
  requirePositive(aspect.height, "aspect");
  const DoubleDouble exact = ratio(aspect.width, aspect.height);
  requirePositive(exact.hi, "aspect");
  return exact;
}

/// A window of intrinsics, in pixels of a picture of this size.
Projection ofPixels(DoubleDouble fx, DoubleDouble fy, double cx, double cy, const Vec2& size, const Viewport& viewport,
                    double near, double far) {
  validate(viewport);
  requirePositive(fx.hi, "fx");
  requirePositive(fy.hi, "fy");
  requirePositive(size.x, "pixels");
  requirePositive(size.y, "pixels");
  requireNumber(cx, "cx");
  requireNumber(cy, "cy");
  const auto corner = [](double start, double pixels, double frame) {
    return pixels == frame ? DoubleDouble(start) : DoubleDouble(start) * ratio(pixels, frame);
  };
  const DoubleDouble left = corner(viewport.x, size.x, viewport.width);
  const DoubleDouble start = corner(viewport.y, size.y, viewport.height), half = twoDiff(0.5, viewport.pixelCenter);
  // From the picture's left edge, and from the edge where y starts. Differences of doubles are exact: they may cancel.
  const DoubleDouble fromLeft = DoubleDouble(cx) - left + half, fromStart = DoubleDouble(cy) - start + half;
  const DoubleDouble width = size.x, height = size.y, toEnd = height - fromStart;
  const bool down = viewport.origin == Origin::topLeft;
  return made({false, -(fromLeft / fx), (width - fromLeft) / fx, -((down ? toEnd : fromStart) / fy),
               (down ? fromStart : toEnd) / fy, near, far, width / fx, height / fy,
               size.x == viewport.width ? 0 : std::fabs((left / fx).hi),
               size.y == viewport.height ? 0 : std::fabs((start / fy).hi)});
}

}  // namespace

Projection detail::made(const ProjectionParts& parts) {
  check(parts);
  return Access::whole<Projection>(share(parts));
}

bool Projection::isOrthographic() const noexcept { return parts_->orthographic; }
double Projection::left() const noexcept { return parts_->left.hi; }
double Projection::right() const noexcept { return parts_->right.hi; }
double Projection::bottom() const noexcept { return parts_->bottom.hi; }
double Projection::top() const noexcept { return parts_->top.hi; }
double Projection::zNear() const noexcept { return parts_->near; }
double Projection::zFar() const noexcept { return parts_->far; }
double Projection::aspect() const noexcept { return (windowWidth(*parts_) / windowHeight(*parts_)).hi; }
double Projection::fov(Fov of) const noexcept {
  const ProjectionParts& p = *parts_;
  if (p.orthographic) return kNaN;
  if (of == Fov::vertical) return degreesAcross(p.bottom, p.top);
  if (of == Fov::horizontal) return degreesAcross(p.left, p.right);
  return std::max(degreesBetween(p.left, p.bottom, p.right, p.top), degreesBetween(p.left, p.top, p.right, p.bottom));
}

Projection perspective(Angle angle, Aspect aspect, double near, double far, Fov of) {
  const DoubleDouble shape = ratioOf(aspect);
  if (of == Fov::horizontal) {
    const DoubleDouble halfWidth = tangentOfHalf(angle, "fovX");
    return symmetric(halfWidth, halfWidth / shape, near, far);
  }
  DoubleDouble halfHeight = tangentOfHalf(angle, of == Fov::vertical ? "fovY" : "fovDiagonal");
  // halfWidth = shape * halfHeight and halfWidth^2 + halfHeight^2 = tangent^2
  if (of == Fov::diagonal) halfHeight = halfHeight / sqrt(shape * shape + DoubleDouble(1));
  return symmetric(halfHeight * shape, halfHeight, near, far);
}

Projection perspectiveFocalLength(double focalLength, const SensorSize& sensor, Aspect aspect, double near,
                                  double far) {
  requirePositive(focalLength, "focalLength");
  const auto& [width, height, diagonal] = sensor;
  if (width != 0) requirePositive(width, "sensorWidth");
  if (height != 0) requirePositive(height, "sensorHeight");
  if (diagonal != 0) requirePositive(diagonal, "sensorDiagonal");
  if (width == 0 && height == 0 && diagonal == 0)
    throw CameraError("focalLength", "needs sensorWidth, sensorHeight or sensorDiagonal, in the same unit");
  if (diagonal != 0 && (width != 0 || height != 0))
    throw CameraError("sensorDiagonal", "stands alone, without sensorWidth and sensorHeight");
  const auto halfTangent = [&](double size) { return half(ratio(size, focalLength)); };
  if (width != 0 && height != 0) return symmetric(halfTangent(width), halfTangent(height), near, far);
  const DoubleDouble shape = ratioOf(aspect);
  if (width != 0) return symmetric(halfTangent(width), halfTangent(width) / shape, near, far);
  const DoubleDouble halfHeight =
      height != 0 ? halfTangent(height) : halfTangent(diagonal) / sqrt(shape * shape + DoubleDouble(1));
  return symmetric(halfHeight * shape, halfHeight, near, far);
}

Projection frustum(double left, double right, double bottom, double top, double near, double far) {
  requireEdges(left, right, bottom, top);
  requirePositive(near, "near");
  requireRange(false, near, far);
  // Width and height from exact differences: the quotients may lose them.
  return made({false, ratio(left, near), ratio(right, near), ratio(bottom, near), ratio(top, near), near, far,
               twoDiff(right, left) / DoubleDouble(near), twoDiff(top, bottom) / DoubleDouble(near)});
}

Projection perspectiveWindow(double left, double right, double bottom, double top, double near, double far) {
  requireEdges(left, right, bottom, top);
  return made({false, left, right, bottom, top, near, far});
}

Projection orthographic(double left, double right, double bottom, double top, double near, double far) {
  requireEdges(left, right, bottom, top);
  return made({true, left, right, bottom, top, near, far});
}

Projection orthographicHeight(double height, Aspect aspect, double near, double far) {
  requirePositive(height, "height");
  return symmetric(DoubleDouble(height / 2) * ratioOf(aspect), height / 2, near, far, true);
}

Projection orthographicWidth(double width, Aspect aspect, double near, double far) {
  requirePositive(width, "width");
  return symmetric(width / 2, DoubleDouble(width / 2) / ratioOf(aspect), near, far, true);
}

Projection intrinsics(double focalX, double focalY, double cx, double cy, const Viewport& viewport, double near,
                      double far) {
  return intrinsics(focalX, focalY, cx, cy, Vec2{viewport.width, viewport.height}, viewport, near, far);
}

Projection intrinsics(double focalX, double focalY, double cx, double cy, const Vec2& size, const Viewport& viewport,
                      double near, double far) {
  return ofPixels(focalX, focalY, cx, cy, size, viewport, near, far);
}

Projection ps2Intrinsics(double scrz, double ax, double ay, double cx, double cy, const Viewport& viewport, double near,
                         double far) {
  requirePositive(scrz, "scrz");
  requirePositive(ax, "ax");
  requirePositive(ay, "ay");
  return ofPixels(twoProd(ax, scrz), twoProd(ay, scrz), cx, cy, {viewport.width, viewport.height}, viewport, near, far);
}

Projection shifted(const Projection& projection, double dx, double dy) {
  const ProjectionParts& p = parts(projection);
  if (!(std::isfinite(dx) && std::isfinite(dy))) throw CameraError("shift", "must be two finite numbers");
  requireNumber(dx, "shift");
  requireNumber(dy, "shift");
  const DoubleDouble width = windowWidth(p), height = windowHeight(p);
  const DoubleDouble x = DoubleDouble(dx) * half(width), y = DoubleDouble(dy) * half(height);
  return moved({p.orthographic, p.left - x, p.right - x, p.bottom - y, p.top - y, p.near, p.far, width, height,
                largest(p.reachX, p.left, p.right), largest(p.reachY, p.bottom, p.top)},
               "shift", "shift");
}

Projection cropped(const Projection& projection, const Viewport& viewport, const Crop& crop) {
  const ProjectionParts& p = parts(projection);
  validate(cropped(viewport, crop));
  const DoubleDouble width = windowWidth(p), height = windowHeight(p);
  const DoubleDouble pixelsAcross = viewport.width, pixelsAlong = viewport.height;
  const bool down = viewport.origin == Origin::topLeft;
  const auto across = [&](DoubleDouble x) { return p.left + width * (x / pixelsAcross); };
  const auto along = [&](DoubleDouble y) {
    return (down ? p.top : p.bottom) + (down ? -height : height) * (y / pixelsAlong);
  };
  const DoubleDouble first = along(crop.y), last = along(twoSum(crop.y, crop.height));
  return moved({p.orthographic, across(crop.x), across(twoSum(crop.x, crop.width)), down ? last : first,
                down ? first : last, p.near, p.far, width * (DoubleDouble(crop.width) / pixelsAcross),
                height * (DoubleDouble(crop.height) / pixelsAlong), largest(p.reachX, p.left, p.right),
                largest(p.reachY, p.bottom, p.top)},
               "viewport.crop.width", "viewport.crop.height");
}

}  // namespace viewproj
