#include <cmath>
#include <limits>
#include <optional>

#include "camera/depth.hpp"
#include "numbers/ulp.hpp"
#include "projection/kernels/formulas.hpp"
#include "projection/window_point.hpp"
#include "viewproj/screen.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 kNoVector{kNaN, kNaN, kNaN};

/// Of a ray's origin, next to the sizes of what it is a sum of: more than any way to compute it in double-double is
/// off.
constexpr double kOriginShare = 0x1p-95;

/// Written so that NaN fails.
bool isInDomain(const Vec2& v) noexcept { return std::fabs(v.x) < kFarthestPoint && std::fabs(v.y) < kFarthestPoint; }

bool hasRay(const CameraParts& c, const Vec2& screen) noexcept {
  return !c.lens || !std::isnan(toWindow<DoubleDouble>(c, screen).up.hi);
}

/// The world point at a screen position and distance.
Vec3 worldPointAt(const CameraParts& c, const Vec2& screen, DoubleDouble distance) noexcept {
  return rounded(unroundedEye(c.pose) + offsetAt(c, toWindow<DoubleDouble>(c, screen), distance));
}

Vec3 exactDirection(const CameraParts& c, const Vec2& screen) noexcept {
  if (c.projection.orthographic) return c.rays.direction;
  return rounded(normalized(offsetAt(c, toWindow<DoubleDouble>(c, screen), DoubleDouble(1))));
}

/// Orthographic, with certified rounding; nothing where that fails.
std::optional<Vec3> certainOrigin(const CameraParts& c, const Vec2& screen, double distance) noexcept {
  const DoubleDouble x = DoubleDouble(screen.x) - c.screen.centerX, y = DoubleDouble(screen.y) - c.screen.centerY;
  const double sizeX = std::fabs(screen.x) + std::fabs(c.screen.centerX.hi);
  const double sizeY = std::fabs(screen.y) + std::fabs(c.screen.centerY.hi);
  const DDVec3 &perX = c.rays.perX, &perY = c.rays.perY, &forward = c.pose.columns.forward;
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    DoubleDouble sum = c.rays.start[i] + perX[i] * x + perY[i] * y;
    if (distance != 0) sum += forward[i] * DoubleDouble(distance);
    const double size = std::fabs(c.rays.start[i].hi) + std::fabs(perX[i].hi) * sizeX + std::fabs(perY[i].hi) * sizeY +
                        std::fabs(forward[i].hi * distance);
    if (size > 0 && !roundsAlike(sum, kOriginShare * size)) return std::nullopt;
    result[i] = rounded(sum);
  }
  return result;
}

Vec3 originAt(const CameraParts& c, const Vec2& screen, RayOrigin origin) noexcept {
  const double distance = origin == RayOrigin::nearPlane ? c.projection.near : 0;
  if (c.projection.orthographic)
    if (const auto certain = certainOrigin(c, screen, distance)) return *certain;
  return worldPointAt(c, screen, distance);
}

Vec3 standardDirection(const CameraParts& c, const Vec2& screen) noexcept {
  if (c.projection.orthographic) return c.rays.direction;
  if (c.lens) return exactDirection(c, screen);
  const auto r = RayFormula<ScalarLanes>(c.constants)(screen.x, screen.y);
  if (!(r.squaredLength < kLargestSquaredLength)) return exactDirection(c, screen);
  return {r.x, r.y, r.z};
}

/// The length of the offset from the eye for a unit of view distance.
Wide slant(const CameraParts& c, const Vec2& screen) noexcept {
  if (c.projection.orthographic) return lengthOf(toWide(c.pose.columns.forward));
  return lengthOf(offsetAt(c, toWindow<Wide>(c, screen), Wide(1)));
}

/// The point at a distance that is off by at most distanceError.
WorldPoint pointAt(const CameraParts& c, const Vec2& screen, const Wide& distance, const Wide& distanceError) noexcept {
  const Vec3 position = worldPointAt(c, screen, toDoubleDouble(distance));
  if (!detail::isFinite(position)) return {kNoVector, DepthStatus::infinity};
  const double rounding = halfUlp(position.x) + halfUlp(position.y) + halfUlp(position.z);
  const bool hasError = distanceError.sign() > 0 || !std::isfinite(distanceError.value.hi);
  return {position, DepthStatus::point,
          1.01 * (hasError ? double(distanceError * slant(c, screen)) + rounding : rounding), double(distance)};
}

}  // namespace

Ray screenToRay(const Camera& camera, const Vec2& screen, Precision precision, RayOrigin origin) noexcept {
  const CameraParts& c = parts(camera);
  if (!isInDomain(screen)) return {kNoVector, kNoVector};
  const bool originIsEye = origin == RayOrigin::eye && !c.projection.orthographic;
  const Vec3 direction = precision == Precision::exact ? exactDirection(c, screen) : standardDirection(c, screen);
  if (std::isnan(direction.x)) return {kNoVector, kNoVector};
  return {originIsEye ? c.pose.eye : originAt(c, screen, origin), direction};
}

WorldPoint screenToWorld(const Camera& camera, const Vec2& screen, double depth) noexcept {
  const CameraParts& c = parts(camera);
  if (!isInDomain(screen) || !std::isfinite(depth)) return {kNoVector, DepthStatus::notFinite};
  if (!hasRay(c, screen)) return {kNoVector, DepthStatus::noRay};
  const ProjectionParts& p = c.projection;
  const auto at = depthFraction<Wide>(depth, {c.depthAtNear, c.depthAtFar});
  const Wide shareError = Wide(halfUlp(depth)) / magnitude(Wide(c.depthAtFar) - Wide(c.depthAtNear));
  if (p.orthographic)
    return pointAt(c, screen, orthographicDistance(p.near, p.far, at), (Wide(p.far) - Wide(p.near)) * shareError);
  if (!hasDepth(p)) return {kNoVector, DepthStatus::beyond};
  if (depth == c.depthAtInfinity) return {kNoVector, DepthStatus::infinity};
  const Wide divisor = nearOverDistance(p.near, p.far, at);
  if (!(divisor.sign() > 0)) return {kNoVector, DepthStatus::beyond};
  const Wide distance = Wide(p.near) / divisor;
  // Towards infinity the distance changes most: by shareError in the divisor, at most.
  const Wide farthest = divisor - shareError;
  return pointAt(
      c, screen, distance,
      farthest.sign() > 0 ? distance * (shareError / farthest) : Wide(std::numeric_limits<double>::infinity()));
}

WorldPoint screenToWorldAtDistance(const Camera& camera, const Vec2& screen, double viewDistance) noexcept {
  const CameraParts& c = parts(camera);
  if (!isInDomain(screen) || !std::isfinite(viewDistance)) return {kNoVector, DepthStatus::notFinite};
  if (!hasRay(c, screen)) return {kNoVector, DepthStatus::noRay};
  if (!c.projection.orthographic && !(viewDistance > 0)) return {kNoVector, DepthStatus::beyond};
  return pointAt(c, screen, viewDistance, 0);
}

Vec2 pixelSize(const Camera& camera, double viewDistance) noexcept {
  const CameraParts& c = parts(camera);
  const DoubleDouble span = c.projection.orthographic ? 1 : viewDistance > 0 ? viewDistance : kNaN;
  return {std::fabs((span / c.screen.scaleX).hi), std::fabs((span / c.screen.scaleY).hi)};
}

}  // namespace viewproj
