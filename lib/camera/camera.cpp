#include "camera/camera.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

#include "camera/depth.hpp"
#include "camera/require.hpp"
#include "camera/viewport.hpp"
#include "numbers/arithmetic.hpp"

namespace viewproj {

using namespace detail;

namespace {

/// Of pixels for a unit of the window, and of where its axis lies: one more factor of 2^20 is a double still.
constexpr double kLargestScale = 0x1p1000;

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
    if (size == 0 || !std::isfinite(size)) continue;
    range = std::max({range, size, 1 / size});
  }
  return range;
}

/// A row whose largest entry is not a normal double stays whole: exact leaves such cameras to numbers of wider range.
SplitRow splitRow(const DDVec3& row) noexcept {
  constexpr int kBits = 25;
  SplitRow split{rounded(row), {}};
  const double largest = maxAbs(row);
  if (!std::isnormal(largest)) return split;
  const double grid = std::ldexp(1.5, std::ilogb(largest) + 1 - kBits + 52);
  for (std::size_t i = 0; i < 3; ++i) {
    split.high[i] = (row[i].hi + grid) - grid;
    split.low[i] = (row[i].hi - split.high[i]) + row[i].lo;
  }
  return split;
}

}  // namespace

Camera makeCamera(const Pose& pose, const Projection& projection, const Viewport& viewport,
                  const Convention& convention) {
  if (const char* fault = arithmeticFault()) throw CameraError("arithmetic", fault);
  validate(viewport);
  const Handedness world = pose.world();
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

  const DepthEnds ends = windowDepths(viewport, convention.reverseZ);
  DepthLine depth{NAN, 1};  // a scale in the range of every bound
  if (hasDepth(c.projection)) {
    c.depthAtNear = ends.atNear;
    c.depthAtFar = ends.atFar;
    depth = depthLine(c.projection, ends);
  }
  if (!c.projection.orthographic) c.depthAtInfinity = depth.offset.hi;

  ProjectionConstants& k = c.constants;
  k.forwardIsAxis = forwardIsAxis(c.pose);
  const ScreenMap& map = c.screen;
  k.orthographic = c.projection.orthographic;
  k.eye = c.pose.eye;
  k.x = c.pose.rows.right * map.scaleX;
  k.y = c.pose.rows.up * map.scaleY;
  k.w = c.pose.rows.forward;
  k.splitX = splitRow(k.x);
  k.splitY = splitRow(k.y);
  k.splitW = splitRow(k.w);
  k.residual = {c.pose.residual.x * map.scaleX, c.pose.residual.y * map.scaleY, c.pose.residual.z};
  k.centerX = map.centerX;
  k.centerY = map.centerY;
  k.depthOffset = depth.offset;
  k.depthScale = depth.scale;
  k.reachX = map.reachX;
  k.reachY = map.reachY;
  const RangeShares shares = rangeShares(c.projection.near, c.projection.far);
  const double farOverRange = c.projection.orthographic      ? shares.one.hi
                              : std::isinf(c.projection.far) ? 1
                                                             : shares.far.hi;
  const double depths[] = {hasDepth(c.projection) ? depth.offset.hi : 1, depth.scale.hi, farOverRange};
  const bool depthsAreNumbers = std::isfinite(depths[0]) && std::isfinite(depths[1]) && depths[1] != 0 &&
                                std::isfinite(depths[2]) && depths[2] != 0;
  k.range = !depthsAreNumbers ? std::numeric_limits<double>::infinity()
                              : rangeOf({map.reachX, map.reachY, map.centerX.hi, map.centerY.hi, map.scaleX.hi,
                                         map.scaleY.hi, depths[0], depths[1], depths[2], c.depthAtNear, c.depthAtFar,
                                         c.depthAtFar - c.depthAtNear, c.projection.near, c.projection.far});
  k.sizeXY = std::max(maxAbs(k.x), maxAbs(k.y));
  k.sizeW = maxAbs(k.w);
  k.residualReach = std::max(std::max(std::fabs(k.residual.x.hi), std::fabs(k.residual.y.hi)) / k.sizeXY,
                             std::fabs(k.residual.z.hi) / k.sizeW);
  // A residual that is there counts, however small: whether it does is told from this.
  const auto isZero = [](DoubleDouble a) { return a.hi == 0; };
  if (k.residualReach == 0 && !(isZero(k.residual.x) && isZero(k.residual.y) && isZero(k.residual.z)))
    k.residualReach = std::numeric_limits<double>::min();
  const Axes& columns = c.pose.columns;
  c.rays.perX = columns.right * (DoubleDouble(1) / map.scaleX);
  c.rays.perY = columns.up * (DoubleDouble(1) / map.scaleY);
  if (k.orthographic) {
    c.rays.start = unroundedEye(c.pose);
    c.rays.direction = rounded(normalized(columns.forward));
  }
  k.rayX = rounded(c.rays.perX);
  k.rayY = rounded(c.rays.perY);
  k.rayW = rounded(columns.forward);
  c.corners = pictureCorners(viewport);
  return Access::whole<Camera, CameraParts>(made);
}

Pose Camera::pose() const noexcept { return Access::whole<Pose, PoseParts>({parts_, &parts_->pose}); }
Projection Camera::projection() const noexcept {
  return Access::whole<Projection, ProjectionParts>({parts_, &parts_->projection});
}
const Viewport& Camera::viewport() const noexcept { return parts_->viewport; }
const Convention& Camera::convention() const noexcept { return parts_->convention; }

Intrinsics Camera::intrinsics() const noexcept {
  const ScreenMap& map = parts_->screen;
  return {map.scaleX.hi, std::fabs(map.scaleY.hi), map.centerX.hi, map.centerY.hi};
}

WindowDepths Camera::depths() const noexcept {
  return {parts_->depthAtNear, parts_->depthAtFar, parts_->depthAtInfinity};
}

Camera cropped(const Camera& camera, const Crop& crop) {
  const Viewport& whole = camera.viewport();
  return makeCamera(camera.pose(), cropped(camera.projection(), whole, crop), cropped(whole, crop),
                    camera.convention());
}

}  // namespace viewproj
