#include "commands/fit/hull.hpp"

#include "camera/projection.hpp"
#include "scene/view_space.hpp"

namespace viewproj::cmd {

using namespace detail;
Hull::Hull(const Camera& camera, const Room& room) : camera_(&parts(camera)), owner_(camera) {
  const ProjectionParts& p = camera_->projection;
  const PoseParts& pose = camera_->pose;
  const auto push = [&](bool across, double share, bool upwards) {
    const DDVec3& row = across ? pose.rows.right : pose.rows.up;
    const DoubleDouble from = across ? p.left : p.bottom, to = across ? p.right : p.top;
    const DoubleDouble edge = p.orthographic ? DoubleDouble() : from + (to - from) * DoubleDouble(share);
    return Push{&row, across ? pose.residual.x : pose.residual.y, edge, upwards,
                lengthOf(toWide(row) - toWide(pose.rows.forward) * toWide(edge))};
  };
  right_ = push(true, room.right, true);
  left_ = push(true, room.left, false);
  top_ = push(false, room.top, true);
  bottom_ = push(false, room.bottom, false);
  forwardLength_ = lengthOf(toWide(pose.rows.forward));
}

void Hull::add(const Vec3& middle, double radius) {
  const PoseParts& pose = camera_->pose;
  const WideVec3 d = fromEye(pose, middle);
  const Wide w = alongAxis(pose.rows.forward, pose.residual.z, d), r = radius;
  for (Push* push : {&right_, &left_, &top_, &bottom_}) {
    const Wide along = alongAxis(*push->row, push->residual, d) - toWide(push->edge) * w;
    const Wide reach = (push->upwards ? along : -along) + r * push->length;
    if (isEmpty_ || isLess(push->most, reach)) push->most = reach;
  }
  const Wide near = w - r * forwardLength_, far = w + r * forwardLength_;
  if (isEmpty_ || isLess(near, nearest_)) nearest_ = near;
  if (isEmpty_ || isLess(farthest_, far)) farthest_ = far;
  isEmpty_ = false;
}

void Hull::add(const Box& box) {
  for (unsigned i = 0; i < 8; ++i)
    add(Vec3{i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
}

void Hull::add(const Triangle& triangle) {
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) add(corner);
}

Hull::Place Hull::place() const {
  const auto farthestOn = [](const Push& high, const Push& low) {
    return -(high.most + low.most) / (toWide(high.edge) - toWide(low.edge));
  };
  const Wide byWidth = farthestOn(right_, left_), byHeight = farthestOn(top_, bottom_);
  Wide z = isLess(byWidth, byHeight) ? byWidth : byHeight;
  // What is left of the nearest thing's distance by cancellation is none.
  constexpr double kNone = 0x1p-90;
  Place::By by = isLess(byWidth, byHeight) ? Place::By::width : Place::By::height;
  if (!isLess((magnitude(nearest_) + magnitude(z)) * Wide(kNone), nearest_ - z)) by = Place::By::near;
  if (by == Place::By::near) z = nearest_ - Wide(camera_->projection.near);
  const auto middle = [&](const Push& high, const Push& low) {
    const Wide from = high.most + toWide(high.edge) * z, to = toWide(low.edge) * z - low.most;
    return sumOrZero(from, to) * Wide(0.5);
  };
  const Wide x = middle(right_, left_), y = middle(top_, bottom_);
  const Axes& axes = camera_->pose.columns;
  const WideVec3 moved = toWide(axes.right) * x + toWide(axes.up) * y + toWide(axes.forward) * z;
  return Place{rounded(toWide(unroundedEye(camera_->pose)) + moved), {double(nearest_ - z), double(farthest_ - z)}, by};
}

Hull::Reach Hull::reach() const {
  return {toDoubleDouble(-left_.most), toDoubleDouble(right_.most), toDoubleDouble(-bottom_.most),
          toDoubleDouble(top_.most)};
}

}  // namespace viewproj::cmd
