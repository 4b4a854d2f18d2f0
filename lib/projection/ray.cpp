#include <algorithm>
#include <cmath>

#include "numbers/double_double.hpp"
#include "numbers/wide.hpp"
#include "projection/exact_point.hpp"
#include "projection/kernels/formulas.hpp"
#include "projection/through_lens.hpp"
#include "viewproj/screen.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr Vec3 kNoVector{kNaN, kNaN, kNaN};

/// Right and up of the viewing axis, on the plane at distance 1 from the eye, in orthographic on the plane through it.
/// Of a ray that points backwards: on the plane at distance 1, times the negative. NaN if no point has this pixel.
struct WindowPoint {
  DoubleDouble right, up;
  double sign = 1;  ///< of the ray's forward part; 0 for a ray along the eye plane
};

WindowPoint windowAt(const CameraParts& c, const Vec2& screen) noexcept {
  if (c.lens) {
    const Sight<DoubleDouble> at = sightOf(c, screen);
    const double forward = at.forward.hi;
    return {at.right / at.forward, -(at.down / at.forward), forward > 0 ? 1.0 : forward < 0 ? -1.0 : forward};
  }
  return {sumOrZero(screen.x, -c.screen.centerX) / c.screen.scaleX,
          sumOrZero(screen.y, -c.screen.centerY) / c.screen.scaleY};
}

/// The offset from the unrounded eye to the point at this distance.
DDVec3 offsetAt(const CameraParts& c, const WindowPoint& window, DoubleDouble distance) noexcept {
  const DoubleDouble &right = window.right, &up = window.up;
  const Axes& axes = c.pose.columns;
  const DoubleDouble spread = c.projection.orthographic ? DoubleDouble(1) : distance;
  const DDVec3 along{right * spread, up * spread, distance};
  DDVec3 offset;
  for (std::size_t i = 0; i < 3; ++i) offset[i] = dotOrZero({axes.right[i], axes.up[i], axes.forward[i]}, along);
  return offset;
}

Vec3 worldPointAt(const CameraParts& c, const WindowPoint& window, DoubleDouble distance) noexcept {
  return rounded(c.eye + offsetAt(c, window, distance));
}

/// Orthographic: sets the same point with a shorter sum. False if its rounding is not certain.
bool setOrigin(Vec3& origin, const CameraParts& c, const Vec2& screen, double distance) noexcept {
  constexpr double kShare = 0x1p-95;  // of the terms: more than the error of adding them in double-double in any order
  const DoubleDouble x = DoubleDouble(screen.x) - c.screen.centerX, y = DoubleDouble(screen.y) - c.screen.centerY;
  const double sizeX = std::fabs(screen.x) + std::fabs(c.screen.centerX.hi);
  const double sizeY = std::fabs(screen.y) + std::fabs(c.screen.centerY.hi);
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble forward = c.pose.columns.forward[i];
    DoubleDouble sum = c.eye[i] + c.perX[i] * x + c.perY[i] * y;
    if (distance != 0) sum += forward * DoubleDouble(distance);
    const double size = std::fabs(c.eye[i].hi) + std::fabs(c.perX[i].hi) * sizeX + std::fabs(c.perY[i].hi) * sizeY +
                        std::fabs(forward.hi * distance);
    if (size > 0 && !roundsAlike(sum, kShare * size)) return false;
    origin[i] = rounded(sum);
  }
  return true;
}

/// The bits of a batch.
Vec3 directionOf(const CameraParts& c, const Vec2& screen) noexcept {
  if (c.projection.orthographic && !c.lens) return c.direction;
  if (c.lens) {
    const Sight<DoubleDouble> at = sightOf(c, screen);
    const auto r = RayFormula<ScalarLanes>::along(c.constants, at.right.hi, at.down.hi, at.forward.hi);
    return {r.x, r.y, r.z};
  }
  const auto r = RayFormula<ScalarLanes>(c.constants)(screen.x, screen.y);
  return {r.x, r.y, r.z};
}

/// The point at a distance whose error is at most distanceError.
WorldPoint pointAt(const CameraParts& c, const WindowPoint& window, const Wide& distance,
                   const Wide& distanceError) noexcept {
  const Vec3 position = worldPointAt(c, window, toDoubleDouble(distance));
  if (!detail::isFinite(position)) return {kNoVector, DepthStatus::infinity};
  const PoseError& pose = c.pose.error;
  double bound = halfUlp(position.x) + halfUlp(position.y) + halfUlp(position.z) + pose.eye;
  if (pose.angle > 0) bound += pose.angle * double(lengthOf(toWide(offsetAt(c, window, toDoubleDouble(distance)))));
  if (!std::isfinite(distanceError.value.hi)) {
    bound = kInfinity;
  } else if (distanceError.sign() > 0) {
    // How far the point moves when its distance changes.
    const bool orthographic = c.projection.orthographic;
    const Wide slant = lengthOf(toWide(orthographic ? c.pose.columns.forward : offsetAt(c, window, 1)));
    bound += double(distanceError * slant);
  }
  return {position, DepthStatus::point, 1.01 * bound, double(distance)};
}

}  // namespace

Sight<DoubleDouble> detail::sightOf(const CameraParts& c, const Vec2& screen) noexcept {
  const ProjectionConstants& k = c.constants;
  const LensSight found = pointKernels().lensSight(k, screen);
  if (found.isSettled) return found.hasNone ? Sight<DoubleDouble>{kNaN, kNaN, kNaN} : found.at;
  return undistortSlowly(*c.lens,
                         {sumOrZero(screen.x, -k.centerX) * k.perScaleX, sumOrZero(screen.y, -k.centerY) * k.perScaleY})
      .at;
}

Ray screenToRay(const Camera& camera, const Vec2& screen, RayOrigin origin) noexcept {
  const CameraParts& c = parts(camera);
  if (!isInDomain(screen)) return {kNoVector, kNoVector};
  Ray ray{c.pose.eye, directionOf(c, screen)};
  const bool isAtNear = origin == RayOrigin::nearPlane;
  const double distance = isAtNear ? c.projection.near : 0;
  if (c.projection.orthographic ? !setOrigin(ray.origin, c, screen, distance) : isAtNear) {
    const WindowPoint window = windowAt(c, screen);
    if (window.sign > 0)
      ray.origin = worldPointAt(c, window, distance);
    else if (distance > 0 || std::isnan(window.sign))
      ray.origin = kNoVector;  // a ray that points backwards does not meet the near plane
  }
  return ray;
}

WorldPoint screenToWorld(const Camera& camera, const Vec2& screen, double depth, double depthError) noexcept {
  const CameraParts& c = parts(camera);
  if (!isInDomain(screen) || !std::isfinite(depth) || !(depthError >= 0)) return {kNoVector, DepthStatus::notFinite};
  const WindowPoint window = windowAt(c, screen);
  if (std::isnan(window.sign)) return {kNoVector, DepthStatus::noRay};
  const ProjectionParts& p = c.projection;
  if (!hasDepth(p) || !(window.sign > 0)) return {kNoVector, DepthStatus::beyond};
  // The depth's differences to near's and far's depth, as shares of the range.
  const Wide near = p.near, far = p.far, atNear = c.depthAtNear, atFar = c.depthAtFar, range = atFar - atNear;
  const Wide fromNear = (Wide(depth) - atNear) / range, fromFar = (atFar - Wide(depth)) / range;
  const Wide shareError = Wide(halfUlp(depth) + depthError) / magnitude(range);
  if (p.orthographic) return pointAt(c, window, near * fromFar + far * fromNear, (far - near) * shareError);
  if (depth == c.depthAtInfinity) return {kNoVector, DepthStatus::infinity};
  const Wide nearOverDistance = std::isfinite(p.far) ? fromFar + fromNear * (near / far) : fromFar;
  if (!(nearOverDistance.sign() > 0)) return {kNoVector, DepthStatus::beyond};
  const Wide distance = near / nearOverDistance;
  // The distance grows most towards infinity: the divisor changes by shareError at most.
  const Wide farthest = nearOverDistance - shareError;
  return pointAt(c, window, distance, farthest.sign() > 0 ? distance * (shareError / farthest) : Wide(kInfinity));
}

WorldPoint screenToWorldAtDistance(const Camera& camera, const Vec2& screen, double viewDistance) noexcept {
  const CameraParts& c = parts(camera);
  if (!isInDomain(screen) || !std::isfinite(viewDistance)) return {kNoVector, DepthStatus::notFinite};
  const WindowPoint window = windowAt(c, screen);
  if (std::isnan(window.sign)) return {kNoVector, DepthStatus::noRay};
  if (!c.projection.orthographic && !(viewDistance * window.sign > 0)) return {kNoVector, DepthStatus::beyond};
  return pointAt(c, window, viewDistance, 0);
}

Vec2 pixelSize(const Camera& camera, double viewDistance) noexcept {
  const CameraParts& c = parts(camera);
  const DoubleDouble span = c.projection.orthographic ? 1 : viewDistance > 0 ? viewDistance : kNaN;
  return {std::fabs((span / c.screen.scaleX).hi), std::fabs((span / c.screen.scaleY).hi)};
}

LensShift lensShift(const Camera& camera) noexcept {
  const CameraParts& c = parts(camera);
  if (!c.lens) return {};
  constexpr int kSteps = 16;
  LensShift shift;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const auto between = [](double first, double last, int step) { return first + (last - first) * step / kSteps; };
      const Vec2 pixel{between(c.corners.first.x, c.corners.last.x, i),
                       between(c.corners.first.y, c.corners.last.y, j)};
      shift.behind += sightOf(c, pixel).forward.hi <= 0;
      const Vec3 ray = screenToRay(camera, pixel).direction;
      const ScreenPoint pinhole = worldToScreen(withoutLens(camera), Vec4{ray.x, ray.y, ray.z, 0});
      shift.largest =
          std::fmax(shift.largest, length(pinhole.x - pixel.x, pinhole.y - pixel.y));  // a NaN counts as nothing
    }
  return shift;
}

}  // namespace viewproj
