#include "camera/camera.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

#include "camera/require.hpp"
#include "camera/viewport.hpp"
#include "numbers/arithmetic.hpp"

namespace viewproj {

using namespace detail;

namespace {

/// Of pixels for a unit of the window, and of where its axis lies: one more factor of 2^20 is a double still.
constexpr double kLargestScale = 0x1p1000;

/// near / (far - near), far / (far - near) and 1 / (far - near), for finite far.
struct RangeShares {
  DoubleDouble near, far, one;
};

RangeShares rangeShares(const ProjectionParts& p) noexcept {
  const double scale = std::max(std::fabs(p.near), std::fabs(p.far)) > 0x1p900 ? 0x1p-200 : 1;
  const double n = p.near * scale;
  const double f = p.far * scale;
  const DoubleDouble range = twoDiff(f, n);
  return {DoubleDouble(n) / range, DoubleDouble(f) / range, timesPowerOfTwo(DoubleDouble(1) / range, scale)};
}

/// Exactly: rows that are rounded to an axis do not count.
bool forwardIsAxis(const PoseParts& pose) noexcept {
  const ExactRows& exact = pose.exact;
  if (!exact.isNarrow) return false;
  int zeros = 0, ones = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble row = pose.rows.forward[i];
    if (exact.forward[i].size() == 0 && row.hi == 0) ++zeros;
    // A row made of unit length is 1 where its other parts are 0; one that was given has to be.
    const bool made = exact.translation[0].isZero() && exact.translation[1].isZero() && exact.translation[2].isZero();
    const bool given = exact.forward[i].size() == 1 && std::fabs(exact.forward[i].term(0)) == 1 &&
                       exact.forwardScale.hi == 1 && exact.forwardScale.lo == 0;
    if (std::fabs(row.hi) == 1 && row.lo == 0 && (made || given)) ++ones;
  }
  return exact.error == 0 && zeros == 2 && ones == 1 && pose.residual.x.hi == 0 && pose.residual.y.hi == 0 &&
         pose.residual.z.hi == 0;
}

const char* nameOf(Handedness world) noexcept { return world == Handedness::right ? "right" : "left"; }

double rangeOf(std::initializer_list<double> numbers) noexcept {
  double range = 1;
  for (const double number : numbers) {
    const double size = std::fabs(number);
    if (size == 0 || std::isinf(size)) continue;
    range = std::max({range, size, 1 / size});
  }
  return range;
}

}  // namespace

DepthLine detail::depthLine(const ProjectionParts& p, double atNear, double atFar) noexcept {
  // perspective:   offset = (f atFar - n atNear) / (f - n)     scale = f n (atNear - atFar) / (f - n)
  // infinite far:  offset = atFar                              scale = n (atNear - atFar)
  // orthographic:  offset = (f atNear - n atFar) / (f - n)     scale = (atFar - atNear) / (f - n)
  // f / (f - n) comes first, because f n may overflow.
  const DoubleDouble step = twoDiff(atNear, atFar);
  if (std::isinf(p.far)) return {atFar, DoubleDouble(p.near) * step};
  const RangeShares share = rangeShares(p);
  if (p.orthographic) return {share.far * DoubleDouble(atNear) - share.near * DoubleDouble(atFar), -step * share.one};
  return {share.far * DoubleDouble(atFar) - share.near * DoubleDouble(atNear), share.far * DoubleDouble(p.near) * step};
}

Camera makeCamera(const Pose& pose, const Projection& projection, const Viewport& viewport,
                  const Convention& convention) {
  if (const char* fault = arithmeticFault()) throw CameraError("arithmetic", fault);
  validate(viewport);
  const Handedness world = worldOf(parts(pose));
  if (world != convention.world)
    throw CameraError("pose", std::string("is of a ") + nameOf(world) + "-handed world, and the convention's is " +
                                  nameOf(convention.world) + "-handed");
  const auto made = std::make_shared<CameraParts>();
  CameraParts& c = *made;
  c.pose = parts(pose);
  c.projection = parts(projection);
  c.viewport = viewport;
  c.convention = convention;
  c.screen = screenMap(c.projection, viewport);
  const auto isInRange = [](DoubleDouble center, DoubleDouble scale, double reach) {
    const double size = std::fabs(scale.hi);
    return isFinite(center) && isFinite(scale) && reach < kLargestScale && size > 1 / kLargestScale &&
           size < kLargestScale;
  };
  if (!isInRange(c.screen.centerX, c.screen.scaleX, c.screen.reachX) ||
      !isInRange(c.screen.centerY, c.screen.scaleY, c.screen.reachY))
    throw CameraError("projection", "has a window too small for doubles to tell its pixels apart");

  c.depthAtNear = convention.reverseZ ? viewport.depthSecond : viewport.depthFirst;
  c.depthAtFar = convention.reverseZ ? viewport.depthFirst : viewport.depthSecond;
  if (c.projection.orthographic)
    c.farOverRange = rangeShares(c.projection).one;
  else
    c.farOverRange = std::isinf(c.projection.far) ? DoubleDouble(1) : rangeShares(c.projection).far;
  const DepthLine depth = depthLine(c.projection, c.depthAtNear, c.depthAtFar);
  c.depthAtInfinity = depth.offset.hi;

  ProjectionConstants& k = c.constants;
  k.forwardIsAxis = forwardIsAxis(c.pose);
  const ScreenMap& map = c.screen;
  k.orthographic = c.projection.orthographic;
  k.eye = c.pose.eye;
  k.x = c.pose.rows.right * map.scaleX;
  k.y = c.pose.rows.up * map.scaleY;
  k.w = c.pose.rows.forward;
  k.residual = {c.pose.residual.x * map.scaleX, c.pose.residual.y * map.scaleY, c.pose.residual.z};
  k.centerX = map.centerX;
  k.centerY = map.centerY;
  k.depthOffset = depth.offset;
  k.depthScale = depth.scale;
  k.reachX = map.reachX;
  k.reachY = map.reachY;
  const double depths[] = {depth.offset.hi, depth.scale.hi, c.farOverRange.hi};
  const bool depthsAreNumbers = std::isfinite(depths[0]) && std::isfinite(depths[1]) && depths[1] != 0 &&
                                std::isfinite(depths[2]) && depths[2] != 0;
  k.range = !depthsAreNumbers ? std::numeric_limits<double>::infinity()
                              : rangeOf({map.reachX, map.reachY, map.centerX.hi, map.centerY.hi, map.scaleX.hi,
                                         map.scaleY.hi, depths[0], depths[1], depths[2], c.depthAtNear, c.depthAtFar,
                                         c.depthAtFar - c.depthAtNear, c.projection.near, c.projection.far});
  k.sizeXY = std::max(maxAbs(k.x), maxAbs(k.y));
  k.sizeW = maxAbs(k.w);
  k.farthest = std::max(std::fabs(c.projection.near), std::fabs(c.projection.far));
  k.residualReach = std::max(std::max(std::fabs(k.residual.x.hi), std::fabs(k.residual.y.hi)) / k.sizeXY,
                             std::fabs(k.residual.z.hi) / k.sizeW);
  // A residual that is there counts, however small: whether it does is told from this.
  const auto isZero = [](DoubleDouble a) { return a.hi == 0; };
  if (k.residualReach == 0 && !(isZero(k.residual.x) && isZero(k.residual.y) && isZero(k.residual.z)))
    k.residualReach = std::numeric_limits<double>::min();
  k.rayX = rounded(c.pose.columns.right * (DoubleDouble(1) / map.scaleX));
  k.rayY = rounded(c.pose.columns.up * (DoubleDouble(1) / map.scaleY));
  k.rayW = rounded(c.pose.columns.forward);
  return Access::whole<Camera, CameraParts>(made);
}

Pose Camera::pose() const noexcept { return Access::whole<Pose, PoseParts>({parts_, &parts_->pose}); }
Projection Camera::projection() const noexcept {
  return Access::whole<Projection, ProjectionParts>({parts_, &parts_->projection});
}
const Viewport& Camera::viewport() const noexcept { return parts_->viewport; }
const Convention& Camera::convention() const noexcept { return parts_->convention; }

}  // namespace viewproj
