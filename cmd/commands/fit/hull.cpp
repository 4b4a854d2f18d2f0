#include "commands/fit/hull.hpp"

#include <cmath>

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

Hull::Place Hull::place(double turn) const {
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
  const auto middle = [&](const Push& high, const Push& low, const Wide& along) {
    const Wide from = high.most + toWide(high.edge) * along, to = toWide(low.edge) * along - low.most;
    return sumOrZero(from, to) * Wide(0.5);
  };
  const PoseParts& pose = camera_->pose;
  const Axes& axes = pose.columns;
  const auto eyeAt = [&](const Wide& along) {
    const WideVec3 moved = toWide(axes.right) * middle(right_, left_, along) +
                           toWide(axes.up) * middle(top_, bottom_, along) + toWide(axes.forward) * along;
    return rounded(toWide(unroundedEye(pose)) + moved);
  };
  // Rounded, the eye may leave something out: then it goes back, as little as helps.
  const auto holds = [&](const Vec3& eye) {
    const WideVec3 moved = toWide(toDoubleDouble(eye)) - toWide(unroundedEye(pose));
    const Wide forward = dot(toWide(pose.rows.forward), moved);
    const Wide off = Wide(turn) * (farthest_ - forward);
    for (const Push* push : {&right_, &left_, &top_, &bottom_}) {
      const Wide reach = dot(toWide(*push->row), moved) - toWide(push->edge) * forward;
      if (isLess(push->upwards ? reach : -reach, push->most + off * push->length * push->length)) return false;
    }
    return by != Place::By::near || !isLess(nearest_ - forward, Wide(camera_->projection.near) + off);
  };
  // (A lens so wide that a turn by a rounding leaves out what is seen is left as it is.)
  const Wide exact = z;
  Vec3 eye = eyeAt(exact);
  const double ulps = std::fabs(eye.x) + std::fabs(eye.y) + std::fabs(eye.z) + double(magnitude(farthest_ - exact));
  constexpr int kLast = -30;
  for (int doubled = -54; !holds(eye) && doubled <= kLast; ++doubled) {
    z = doubled < kLast ? exact - Wide(std::ldexp(ulps, doubled)) : exact;
    eye = eyeAt(z);
  }
  return Place{eye, {double(nearest_ - z), double(farthest_ - z)}, by};
}

Hull::Reach Hull::reach() const {
  return {toDoubleDouble(-left_.most), toDoubleDouble(right_.most), toDoubleDouble(-bottom_.most),
          toDoubleDouble(top_.most)};
}

}  // namespace viewproj::cmd
