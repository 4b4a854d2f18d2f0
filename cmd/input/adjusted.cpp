#include "input/adjusted.hpp"

#include "camera/camera.hpp"

namespace viewproj::cmd {

using namespace detail;

Pose movedTo(const Pose& pose, const Vec3& eye, Handedness world) {
  const Axes& axes = parts(pose).columns;
  return poseFromColumns({axes.right, axes.up, axes.forward}, toDoubleDouble(eye), CameraAxes::RUF, world);
}

bool WorldMap::mirrors() const {
  const bool isTurn = (from[0] + 1) % 3 == from[1];
  return (signs[0] * signs[1] * signs[2] > 0) != isTurn;
}

Pose mappedTo(const Pose& pose, const WorldMap& map, double scale, Handedness newWorld) {
  const auto mapped = [&](const DDVec3& v) {
    DDVec3 result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = map.signs[i] < 0 ? -v[map.from[i]] : v[map.from[i]];
    return result;
  };
  const Axes& axes = parts(pose).columns;
  return poseFromColumns({mapped(axes.right), mapped(axes.up), mapped(axes.forward)},
                         mapped(unroundedEye(parts(pose))) * DoubleDouble(scale), CameraAxes::RUF, newWorld);
}

Projection scaledBy(const Projection& projection, double scale) {
  ProjectionParts p = parts(projection);
  p.near *= scale;
  p.far *= scale;
  if (p.orthographic) {
    for (DoubleDouble* edge : {&p.left, &p.right, &p.bottom, &p.top, &p.width, &p.height})
      *edge = *edge * DoubleDouble(scale);
    p.reachX *= scale;
    p.reachY *= scale;
  }
  return made(p);
}

Projection withRange(const Projection& projection, std::optional<double> near, std::optional<double> far) {
  ProjectionParts p = parts(projection);
  p.near = near.value_or(p.near);
  p.far = far.value_or(p.far);
  return made(p);
}

bool isCentred(const Projection& projection) {
  const ProjectionParts& p = parts(projection);
  return (p.left + p.right).hi == 0 && (p.bottom + p.top).hi == 0;
}

Projection withAspect(const Projection& projection, double aspect) {
  const ProjectionParts& p = parts(projection);
  const DoubleDouble half = p.top * DoubleDouble(aspect);
  return p.orthographic ? orthographic(-half, half, p.bottom, p.top, p.near, p.far)
                        : perspectiveWindow(-half, half, p.bottom, p.top, p.near, p.far);
}

}  // namespace viewproj::cmd
