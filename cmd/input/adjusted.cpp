#include "input/adjusted.hpp"

#include "camera/camera.hpp"

namespace viewproj::cmd {

using namespace detail;

Pose movedTo(const Pose& pose, const Vec3& eye, Handedness world) {
  const Axes& axes = parts(pose).columns;
  return poseFromColumns({axes.right, axes.up, axes.forward}, toDoubleDouble(eye), CameraAxes::RUF, world);
}

Projection withRange(const Projection& projection, std::optional<double> near, std::optional<double> far) {
  ProjectionParts p = parts(projection);
  p.near = near.value_or(p.near);
  p.far = far.value_or(p.far);
  return made(p);
}

}  // namespace viewproj::cmd
