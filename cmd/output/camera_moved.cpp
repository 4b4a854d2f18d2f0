// How far apart two cameras show the same points, in double-double.
#include <algorithm>
#include <cmath>
#include <limits>

#include "camera/camera.hpp"
#include "camera/screen_map.hpp"
#include "output/camera_text.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Place {
  DoubleDouble x, y, w;
};

Place placeOf(const DDVec3& offset, const PoseParts& pose, const ProjectionParts& p, const ScreenMap& map) {
  const DoubleDouble x = dot(pose.rows.right, offset), y = dot(pose.rows.up, offset);
  const DoubleDouble w = dot(pose.rows.forward, offset);
  if (p.orthographic) return {map.centerX + map.scaleX * x, map.centerY + map.scaleY * y, w};
  if (!(w.hi > 0)) return {kInfinity, kInfinity, w};
  return {map.centerX + map.scaleX * (x / w), map.centerY + map.scaleY * (y / w), w};
}

/// Between the depths at two distances, given over that distance in perspective.
double depthBetween(DoubleDouble a, DoubleDouble b, double distance, const ProjectionParts& p) {
  if (p.orthographic) return ((b - a) / twoDiff(p.far, p.near)).hi;
  if (!(p.near > 0)) return 0;
  const double farOverRange = std::isinf(p.far) ? 1 : p.far / (p.far - p.near);
  return ((b - a) / (a * b)).hi * farOverRange * (p.near / distance);
}

void raise(double& most, double value) {
  const double size = std::isnan(value) ? kInfinity : std::fabs(value);
  if (size > most) most = size;
}

CameraFile completed(CameraFile file) {
  if (!file.pose) file.pose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, file.convention.world);
  if (!file.projection) file.projection = frustum(-1, 1, -1, 1, 1, kInfiniteFar);
  if (!file.viewport) file.viewport = Viewport{.width = 1920, .height = 1080};
  return file;
}

}  // namespace

Moved movedBetween(const CameraFile& first, const CameraFile& second) {
  const CameraFile from = completed(first), to = completed(second);
  const ProjectionParts& p = parts(*from.projection);
  const PoseParts &fromPose = parts(*from.pose), &toPose = parts(*to.pose);
  const ScreenMap fromMap = screenMap(p, *from.viewport), toMap = screenMap(parts(*to.projection), *to.viewport);
  const DDVec3 step = unroundedEye(fromPose) + -unroundedEye(toPose);
  const Axes& axes = fromPose.columns;
  Moved most;
  for (double across : {0.0, 0.5, 1.0})
    for (double along : {0.0, 0.5, 1.0}) {
      const DoubleDouble x = p.left + (p.right - p.left) * DoubleDouble(across);
      const DoubleDouble y = p.bottom + (p.top - p.bottom) * DoubleDouble(along);
      const bool hasNear = p.orthographic || p.near > 0;
      for (double distance : {hasNear ? p.near : 1, p.far}) {
        // In perspective the offsets over the distance: at infinity the eyes' distance counts for nothing.
        const DoubleDouble ahead = p.orthographic ? DoubleDouble(distance) : DoubleDouble(1);
        const DDVec3 offset = axes.right * x + axes.up * y + axes.forward * ahead;
        const DoubleDouble share = p.orthographic         ? DoubleDouble(1)
                                   : std::isinf(distance) ? DoubleDouble(0)
                                                          : DoubleDouble(1) / DoubleDouble(distance);
        const Place a = placeOf(offset, fromPose, p, fromMap);
        const Place b = placeOf(offset + step * share, toPose, parts(*to.projection), toMap);
        raise(most.pixels, (a.x - b.x).hi);
        raise(most.pixels, (a.y - b.y).hi);
        raise(most.depth, depthBetween(a.w, b.w, distance, p));
      }
    }
  return most;
}

}  // namespace viewproj::cmd
