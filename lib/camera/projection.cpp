#include "camera/projection.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "camera/require.hpp"
#include "camera/screen_corner.hpp"
#include "camera/viewport.hpp"
#include "numbers/degrees.hpp"
#include "numbers/radians.hpp"

namespace viewproj {

using namespace detail;
namespace {

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
  const std::string nearText(text, std::to_chars(text, text + sizeof text, near).ptr);
  throw CameraError("far",
                    "must be greater than near, " + nearText + "; for reversed depth keep near < far and set reverseZ");
}

/// The window checked: edges in order, and its size in the domain.
void check(const ProjectionParts& p) {
  requireRange(p.orthographic, p.near, p.far);
  constexpr double kLargest = 2 * kLargestNumber;  // rounding up to here
  const auto requireSide = [](DoubleDouble low, DoubleDouble high, double width, double reach, const char* lowName,
                              const char* highName) {
    if (!isFinite(low) || !isFinite(high) || !(std::max({std::fabs(low.hi), std::fabs(high.hi), reach}) <= kLargest))
      throw CameraError(highName, "makes a window that reaches beyond 1e90");
    if (!(width > 0)) throw CameraError(highName, std::string("must be greater than ") + lowName);
    if (!(width >= kSmallestNumber)) throw CameraError(highName, "makes a window smaller than 1e-90");
  };
  requireSide(p.left, p.right, windowWidth(p).hi, p.reachX, "left", "right");
  requireSide(p.bottom, p.top, windowHeight(p).hi, p.reachY, "bottom", "top");
}

Projection symmetric(DoubleDouble halfWidth, DoubleDouble halfHeight, double near, double far,
                     bool orthographic = false) {
  return made({orthographic, -halfWidth, halfWidth, -halfHeight, halfHeight, near, far});
}

/// (high - low) / by, where the quotients of high and low may have lost it.
DoubleDouble differenceOver(double low, double high, double by) { return twoDiff(high, low) / DoubleDouble(by); }
DoubleDouble ratio(double a, double b) { return DoubleDouble(a) / DoubleDouble(b); }

/// Beyond this many of its own sizes off the axis, a window that was moved or cut out has lost too many digits.
constexpr double kLargestMove = 0x1p32;

Projection moved(const ProjectionParts& p, const char* fieldX, const char* fieldY) {
  const auto require = [](double reach, DoubleDouble low, DoubleDouble high, const char* field) {
    if (reach > kLargestMove * std::max(std::fabs(low.hi), std::fabs(high.hi)))
      throw CameraError(field, "leaves less than 2e-10 of the window, or of its way off the viewing axis");
  };
  check(p);
  require(p.reachX, p.left, p.right, fieldX);
  require(p.reachY, p.bottom, p.top, fieldY);
  return made(p);
}

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

}  // namespace

Projection detail::made(const ProjectionParts& parts) {
  check(parts);
  return Access::whole<Projection, ProjectionParts>(std::make_shared<const ProjectionParts>(parts));
}

bool Projection::isOrthographic() const noexcept { return parts_->orthographic; }
double Projection::left() const noexcept { return parts_->left.hi; }
double Projection::right() const noexcept { return parts_->right.hi; }
double Projection::bottom() const noexcept { return parts_->bottom.hi; }
double Projection::top() const noexcept { return parts_->top.hi; }
double Projection::zNear() const noexcept { return parts_->near; }
double Projection::zFar() const noexcept { return parts_->far; }
double Projection::aspect() const noexcept { return windowAspect(*parts_).hi; }
double Projection::fov(Fov of) const noexcept {
  const ProjectionParts& p = *parts_;
  if (p.orthographic) return std::numeric_limits<double>::quiet_NaN();
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

Projection perspectiveNearSize(double nearWidth, double nearHeight, double near, double far) {
  requirePositive(nearWidth, "nearWidth");
  requirePositive(nearHeight, "nearHeight");
  requirePositive(near, "near");
  requireRange(false, near, far);
  return symmetric(timesPowerOfTwo(ratio(nearWidth, near), 0.5), timesPowerOfTwo(ratio(nearHeight, near), 0.5), near,
                   far);
}

Projection perspectiveFocalLength(double focalLength, double sensorWidth, double sensorHeight, Aspect aspect,
                                  double near, double far) {
  requirePositive(focalLength, "focalLength");
  if (sensorWidth == 0 && sensorHeight == 0)
    throw CameraError("focalLength", "needs sensorWidth or sensorHeight, in the same unit");
  if (sensorWidth != 0) requirePositive(sensorWidth, "sensorWidth");
  if (sensorHeight != 0) requirePositive(sensorHeight, "sensorHeight");
  DoubleDouble halfWidth = timesPowerOfTwo(ratio(sensorWidth, focalLength), 0.5);
  DoubleDouble halfHeight = timesPowerOfTwo(ratio(sensorHeight, focalLength), 0.5);
  if (sensorWidth == 0 || sensorHeight == 0) {
    const DoubleDouble shape = ratioOf(aspect);
    if (sensorWidth == 0) halfWidth = halfHeight * shape;
    if (sensorHeight == 0) halfHeight = halfWidth / shape;
  }
  return symmetric(halfWidth, halfHeight, near, far);
}

Projection frustum(double left, double right, double bottom, double top, double near, double far) {
  requireEdges(left, right, bottom, top);
  requirePositive(near, "near");
  requireRange(false, near, far);
  return made({false, ratio(left, near), ratio(right, near), ratio(bottom, near), ratio(top, near), near, far,
               differenceOver(left, right, near), differenceOver(bottom, top, near)});
}

Projection detail::perspectiveWindow(DoubleDouble left, DoubleDouble right, DoubleDouble bottom, DoubleDouble top,
                                     double near, double far) {
  return made({false, left, right, bottom, top, near, far});
}

Projection detail::orthographic(DoubleDouble left, DoubleDouble right, DoubleDouble bottom, DoubleDouble top,
                                double near, double far) {
  return made({true, left, right, bottom, top, near, far});
}

Projection intrinsics(double focalX, double focalY, double cx, double cy, const Viewport& viewport, double near,
                      double far) {
  validate(viewport);
  requirePositive(focalX, "fx");
  requirePositive(focalY, "fy");
  requireNumber(cx, "cx");
  requireNumber(cy, "cy");
  // From the picture's left edge and from its edge where y starts: of exact differences, because the three may cancel.
  const auto from = [&](double start, double c) { return twoDiff(c, start) + twoDiff(0.5, viewport.pixelCenter); };
  const DoubleDouble fromLeft = from(viewport.x, cx);
  const DoubleDouble fromStart = from(viewport.y, cy);
  const DoubleDouble fx = focalX, fy = focalY, width = viewport.width, height = viewport.height;
  const DoubleDouble toEnd = height - fromStart;
  const bool down = viewport.origin == Origin::topLeft;
  return made({false, -(fromLeft / fx), (width - fromLeft) / fx, -((down ? toEnd : fromStart) / fy),
               (down ? fromStart : toEnd) / fy, near, far, width / fx, height / fy});
}

Projection perspectiveWindow(double left, double right, double bottom, double top, double near, double far) {
  requireEdges(left, right, bottom, top);
  return perspectiveWindow(DoubleDouble(left), right, bottom, top, near, far);
}

Projection orthographic(double left, double right, double bottom, double top, double near, double far) {
  requireEdges(left, right, bottom, top);
  return orthographic(DoubleDouble(left), right, bottom, top, near, far);
}

Projection orthographicHeight(double height, Aspect aspect, double near, double far) {
  requirePositive(height, "height");
  const DoubleDouble half = height / 2;
  return symmetric(half * ratioOf(aspect), half, near, far, true);
}

Projection orthographicWidth(double width, Aspect aspect, double near, double far) {
  requirePositive(width, "width");
  const DoubleDouble half = width / 2;
  return symmetric(half, half / ratioOf(aspect), near, far, true);
}

Projection shifted(const Projection& projection, double dx, double dy) {
  const ProjectionParts& p = parts(projection);
  if (!(std::isfinite(dx) && std::isfinite(dy))) throw CameraError("shift", "must be two finite numbers");
  requireNumber(dx, "shift");
  requireNumber(dy, "shift");
  ProjectionParts window = p;
  window.width = windowWidth(p);
  window.height = windowHeight(p);
  const DoubleDouble x = DoubleDouble(dx) * timesPowerOfTwo(window.width, 0.5);
  const DoubleDouble y = DoubleDouble(dy) * timesPowerOfTwo(window.height, 0.5);
  window.reachX = largest(p.reachX, p.left, p.right);
  window.reachY = largest(p.reachY, p.bottom, p.top);
  window.left = p.left - x;
  window.right = p.right - x;
  window.bottom = p.bottom - y;
  window.top = p.top - y;
  return moved(window, "shift", "shift");
}

Projection cropped(const Projection& projection, const Viewport& viewport, const Crop& crop) {
  const ProjectionParts& p = parts(projection);
  validate(cropped(viewport, crop));
  const DoubleDouble xEnd = twoSum(crop.x, crop.width);
  const DoubleDouble yEnd = twoSum(crop.y, crop.height);
  const DoubleDouble width = windowWidth(p), height = windowHeight(p);
  const DoubleDouble shareX = DoubleDouble(crop.width) / DoubleDouble(viewport.width);
  const DoubleDouble shareY = DoubleDouble(crop.height) / DoubleDouble(viewport.height);
  const auto across = [&](DoubleDouble x) { return p.left + width * (x / DoubleDouble(viewport.width)); };
  const bool down = viewport.origin == Origin::topLeft;
  const DoubleDouble start = down ? p.top : p.bottom;
  const DoubleDouble downwards = down ? -height : height;
  const auto along = [&](DoubleDouble y) { return start + downwards * (y / DoubleDouble(viewport.height)); };
  const DoubleDouble first = along(crop.y);
  const DoubleDouble last = along(yEnd);
  return moved(
      {p.orthographic, across(crop.x), across(xEnd), down ? last : first, down ? first : last, p.near, p.far,
       width * shareX, height * shareY, largest(p.reachX, p.left, p.right), largest(p.reachY, p.bottom, p.top)},
      "viewport.crop.width", "viewport.crop.height");
}

}  // namespace viewproj
