#include "camera/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "camera/depth.hpp"
#include "camera/require.hpp"
#include "camera/viewport.hpp"
#include "numbers/arithmetic.hpp"

namespace viewproj {

using namespace detail;

namespace {

const char* nameOf(Handedness world) noexcept { return world == Handedness::right ? "right" : "left"; }

SplitRow splitRow(const DDVec3& row) noexcept {
  constexpr int kBits = 25;
  SplitRow split{rounded(row), {}};
  const double grid = std::ldexp(1.5, std::ilogb(maxAbs(row)) + 1 - kBits + 52);
  for (std::size_t i = 0; i < 3; ++i) {
    split.high[i] = (row[i].hi + grid) - grid;
    split.low[i] = (row[i].hi - split.high[i]) + row[i].lo;
  }
  return split;
}

ScreenMap screenMap(const ProjectionParts& p, const Viewport& v) noexcept {
  const ScreenCorner corner = screenCorner(v);
  const DoubleDouble width = windowWidth(p), height = windowHeight(p);
  const bool down = v.origin == Origin::topLeft;
  // Divides by the window first: the share of a symmetric window is exactly 1/2, which keeps the centre exact.
  const DoubleDouble shareX = -p.left / width, shareY = (down ? p.top : -p.bottom) / height;
  const DoubleDouble up = DoubleDouble(v.height) / height;
  const auto reach = [&](double start, double size, double share, double edges, double window) {
    return 2 * (std::fabs(start) + std::fabs(v.pixelCenter) + 0.5 + size * (1 + std::fabs(share) + edges / window));
  };
  return {sumOrZero(corner.x, DoubleDouble(v.width) * shareX),
          sumOrZero(corner.y, DoubleDouble(v.height) * shareY),
          DoubleDouble(v.width) / width,
          down ? -up : up,
          reach(v.x, v.width, shareX.hi, p.reachX, width.hi),
          reach(v.y, v.height, shareY.hi, p.reachY, height.hi)};
}

/// The corners, moved outwards where an edge is a tie of two doubles: a point on that edge may round outwards too.
PictureCorners outwards(const Viewport& v, const ScreenMap& map) noexcept {
  const ScreenCorner corner = screenCorner(v);
  const auto at = [](DoubleDouble edge, double step) { return edge.hi == 0 ? 0 : edge.hi + (edge.lo + step); };
  const double x = 0x1p-96 * map.reachX, y = 0x1p-96 * map.reachY;
  return {{at(corner.x, -x), at(corner.y, -y)},
          {at(corner.x + DoubleDouble(v.width), x), at(corner.y + DoubleDouble(v.height), y)}};
}

/// Sets the rows of the pose and its residual, scaled to the screen.
void setRows(ProjectionConstants& k, const PoseParts& pose, DoubleDouble scaleX, DoubleDouble scaleY) noexcept {
  k.x = pose.rows.right * scaleX;
  k.y = pose.rows.up * scaleY;
  k.w = pose.rows.forward;
  k.splitX = splitRow(k.x);
  k.splitY = splitRow(k.y);
  k.splitW = splitRow(k.w);
  k.residual = {pose.residual.x * scaleX, pose.residual.y * scaleY, pose.residual.z};
  k.sizeXY = std::max(maxAbs(k.x), maxAbs(k.y));
  k.sizeW = maxAbs(k.w);
  k.residualReach = std::max(std::max(std::fabs(k.residual.x.hi), std::fabs(k.residual.y.hi)) / k.sizeXY,
                             std::fabs(k.residual.z.hi) / k.sizeW);
  // A residual that is not zero must count even if this quotient underflows to 0.
  const auto isZero = [](DoubleDouble a) { return a.hi == 0; };
  if (k.residualReach == 0 && !(isZero(k.residual.x) && isZero(k.residual.y) && isZero(k.residual.z)))
    k.residualReach = std::numeric_limits<double>::min();
}

Camera withLensOf(const Camera& camera, const Camera& pinhole) {
  const CameraParts& c = parts(camera);
  if (!c.lens) return pinhole;
  return withLens(pinhole, c.lens, DoubleDouble(1) / (c.constants.scaleX * c.constants.perScaleX));
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
  CameraParts c;
  c.pose = parts(pose);
  c.projection = parts(projection);
  c.viewport = viewport;
  c.convention = convention;
  c.screen = screenMap(c.projection, viewport);
  const DepthEnds ends = windowDepths(viewport, convention.reverseZ);
  DepthLine depth{NAN, 1};
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
  setRows(k, c.pose, map.scaleX, map.scaleY);
  k.centerX = map.centerX;
  k.centerY = map.centerY;
  k.depthOffset = depth.offset;
  k.depthScale = depth.scale;
  k.reachX = map.reachX;
  k.reachY = map.reachY;
  const Axes& columns = c.pose.columns;
  c.eye = unroundedEye(c.pose);
  c.perX = columns.right * (DoubleDouble(1) / map.scaleX);
  c.perY = columns.up * (DoubleDouble(1) / map.scaleY);
  if (k.orthographic) c.direction = rounded(normalized(columns.forward));
  k.rayX = rounded(c.perX);
  k.rayY = rounded(c.perY);
  k.rayW = rounded(columns.forward);
  c.corners = outwards(viewport, map);
  return Access::whole<Camera>(share(c));
}

Pose Camera::pose() const noexcept { return Access::whole<Pose>(Shared(parts_, parts_->pose)); }
Projection Camera::projection() const noexcept { return Access::whole<Projection>(Shared(parts_, parts_->projection)); }
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
  const Viewport& viewport = camera.viewport();
  return withLensOf(camera, makeCamera(camera.pose(), cropped(camera.projection(), viewport, crop),
                                       cropped(viewport, crop), camera.convention()));
}

Camera withPose(const Camera& camera, const Pose& pose) {
  return withLensOf(camera, makeCamera(pose, camera.projection(), camera.viewport(), camera.convention()));
}

Camera detail::withLens(const Camera& pinhole, const Shared<LensParts>& lens, DoubleDouble lensScale) {
  CameraParts made = parts(pinhole);
  ProjectionConstants& k = made.constants;
  setRows(k, made.pose, 1, -1);
  k.scaleX = made.screen.scaleX;
  k.scaleY = -made.screen.scaleY;
  k.perScaleX = DoubleDouble(1) / (k.scaleX * lensScale);
  k.perScaleY = DoubleDouble(1) / (k.scaleY * lensScale);
  k.rayX = rounded(made.pose.columns.right);
  k.rayY = rounded(-made.pose.columns.up);
  k.rayW = rounded(made.pose.columns.forward);
  k.lens = lens.get();
  made.lens = lens;
  made.pinhole = Access::shared(pinhole);
  return Access::whole<Camera>(share(made));
}

}  // namespace viewproj
