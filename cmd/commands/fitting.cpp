#include "commands/fitting.hpp"

#include <algorithm>
#include <cmath>

#include "camera/change_camera.hpp"
#include "numbers/vectors.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using detail::DDVec3;
using detail::toDoubleDouble;
namespace {

/// The camera where its eye is a position of the document, so that it can move and keep its axes.
CameraFile withPosition(const CameraFile& file) { return readCamera(movedTo(file, file.pose->eye()), file.reading); }

/// The window without a share of it on each side, and near and far out of the way.
Camera withMargin(const CameraFile& file, double margin) {
  const Projection& p = *file.projection;
  const double x = margin * (p.right() - p.left()), y = margin * (p.top() - p.bottom());
  const Projection window =
      p.isOrthographic()
          ? orthographic(p.left() + x, p.right() - x, p.bottom() + y, p.top() - y, p.zNear(), p.zFar())
          : perspectiveWindow(p.left() + x, p.right() - x, p.bottom() + y, p.top() - y, kSmallestNumber, kInfiniteFar);
  return makeCamera(*file.pose, window, *file.viewport, file.convention);
}

DDVec3 difference(const Vec3& a, const Vec3& b) { return toDoubleDouble(a) + -toDoubleDouble(b); }
double along(const Vec3& normal, const DDVec3& v) { return dot(toDoubleDouble(normal), v).hi; }
double along(const Vec3& normal, const Vec3& v) { return along(normal, toDoubleDouble(v)); }
Vec3 sum(const Vec3& a, double k, const Vec3& b) { return {a.x + k * b.x, a.y + k * b.y, a.z + k * b.z}; }
double size(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

}  // namespace

Fitting::Fitting(const CameraFile& camera, double margin)
    : file_(withPosition(camera)),
      camera_(makeCamera(file_)),
      margin_(margin),
      open_(viewFrustum(withMargin(file_, 0))) {
  const auto normalOf = [](const FrustumPlane& plane) {
    return Vec3{plane.equation.x, plane.equation.y, plane.equation.z};
  };
  const Frustum inner = viewFrustum(withMargin(file_, margin));
  for (std::size_t i = 0; i < 4; ++i) sides_[i].normal = normalOf(inner.planes()[i]);
  ahead_.normal = normalOf(inner.planes()[4]);
}

void Fitting::add(const Sphere& sphere) {
  const DDVec3 d = difference(sphere.center, camera_.pose().eye());
  const double rounding = 0x1p-52 * (size(rounded(d)) + sphere.radius);  // of the normals
  for (Side& side : sides_) side.room = std::min(side.room, along(side.normal, d) - sphere.radius - rounding);
  const double distance = along(ahead_.normal, d);
  ahead_.room = std::min(ahead_.room, distance - sphere.radius - rounding);
  nearest_ = std::min(nearest_, distance - sphere.radius);
  farthest_ = std::max(farthest_, distance + sphere.radius);
  const auto box = screenBox(open_.camera(), sphere);
  if (!box) return;
  seen_.left = std::min(seen_.left, box->left);
  seen_.right = std::max(seen_.right, box->right);
  seen_.top = std::min({seen_.top, box->top, box->bottom});
  seen_.bottom = std::max({seen_.bottom, box->top, box->bottom});
}

void Fitting::add(const Box& box) {
  for (unsigned i = 0; i < 8; ++i)
    add(Vec3{i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
}

void Fitting::add(const Triangle& triangle) {
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) add(corner);
}

void Fitting::requireSomething() const {
  if (!(farthest_ >= nearest_)) throw InputError("there is nothing to fit");
}

Document Fitting::byPlace() const {
  requireSomething();
  const Pose pose = camera_.pose();
  const double near = file_.projection->zNear();
  const Vec3 right = pose.right(), up = pose.up(), forward = pose.forward();
  // The eye may move by m where normal . m <= room for each side. With m = x right + y up + z forward the sides across
  // from each other leave z a largest value, and x and y an interval each. Axes that are not quite at right angles, and
  // roundings, are worth another step or two.
  const auto limit = [&](const Side& low, const Side& high, const Vec3& across, const Vec3& moved) {
    const double a = along(low.normal, across), b = -along(high.normal, across);
    const double u = (low.room - along(low.normal, moved)) / a, v = (high.room - along(high.normal, moved)) / b;
    const double p = along(low.normal, forward) / a, q = along(high.normal, forward) / b;
    const double most = (u + v) / (p + q);
    return std::pair(most, [=](double z) { return (u - p * z - (v - q * z)) / 2; });
  };
  Vec3 moved;
  for (int step = 0; step < 12; ++step) {
    const auto [byWidth, x] = limit(sides_[0], sides_[1], right, moved);
    const auto [byHeight, y] = limit(sides_[2], sides_[3], up, moved);
    const double byNear = ahead_.room - near - along(ahead_.normal, moved);
    const double z = std::min({byWidth, byHeight, byNear});
    moved = sum(sum(sum(moved, x(z), right), y(z), up), z, forward);
  }
  const double distance = ahead_.room - along(ahead_.normal, moved);
  if (near == 0 && !(distance > 1e-9 * (std::fabs(ahead_.room) + size(moved))))
    throw InputError(file_.name +
                     ": all of it is one point, or fits from any distance: needs near, which says how close");
  const Vec3 eye = pose.eye();
  const auto holds = [&](const Vec3& to) {
    const DDVec3 way = difference(to, eye);
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return along(side.normal, way) <= side.room; }) &&
           along(ahead_.normal, way) <= ahead_.room - near;
  };
  // Rounded, the eye may leave something out: then it goes back, as little as helps.
  Vec3 to = sum(eye, 1, moved);
  const double ulp = 0x1p-53 * (size(eye) + size(moved));
  for (double back = ulp; !holds(to) && back < 0x1p20 * ulp; back *= 2) to = sum(sum(eye, 1, moved), -back, forward);
  const double reach = farthest_ - along(ahead_.normal, difference(to, eye));
  if (reach > file_.projection->zFar())
    throw InputError(file_.name + ": some of it is then " + formatDigits(reach, 6) +
                     " away, beyond far; --far takes a larger one");
  return movedTo(file_, to);
}

Document Fitting::byWindow() const {
  requireSomething();
  const Projection& p = *file_.projection;
  if (!p.isOrthographic() && !(nearest_ > 0))
    throw InputError("something of it lies on or behind the plane through the eye; no lens shows that");
  if (nearest_ < p.zNear() || farthest_ > p.zFar())
    throw InputError(file_.name + ": it lies from " + formatDigits(nearest_, 6) + " to " + formatDigits(farthest_, 6) +
                     " along the view, which near and far cut; --near and --far give others");
  return p.isOrthographic() ? orthographicAround() : openedPerspective();
}

Document Fitting::openedPerspective() const {
  const Viewport& v = *file_.viewport;
  const Intrinsics center = camera_.intrinsics();
  const auto [first, last] = pictureCorners(v);
  // What is off the axis counts to the next double: a screen box is rounded.
  const auto factor = [](double end, double side, double middle) {
    const double share = (end - middle) / (side - middle);
    return share > 0 ? (std::nextafter(end, side < middle ? -HUGE_VAL : HUGE_VAL) - middle) / (side - middle) : share;
  };
  const double x = margin_ * v.width, y = margin_ * v.height;
  const double top = std::min(first.y, last.y) + y, bottom = std::max(first.y, last.y) - y;
  if (!(first.x + x < center.cx && center.cx < last.x - x && top < center.cy && center.cy < bottom))
    throw InputError("the viewing axis lies outside the part of the picture to fill; --by fov opens the lens about it");
  double k = std::max({factor(seen_.left, first.x + x, center.cx), factor(seen_.right, last.x - x, center.cx),
                       factor(seen_.top, top, center.cy), factor(seen_.bottom, bottom, center.cy)});
  if (!(k > 0 && std::isfinite(k)))
    throw InputError("all of it lies on the viewing axis, or is one point: any lens shows it");
  // Lest the rounding of its angle leave some out.
  const Projection& p = *file_.projection;
  const double tangent = k * std::max({-p.left(), p.right(), -p.bottom(), p.top()});
  k *= 1 + 0x1p-50 + 0x1p-52 * std::atan(tangent) * (tangent + 1 / tangent);
  return opened(file_, k);
}

Document Fitting::orthographicAround() const {
  const Viewport& v = *file_.viewport;
  const Projection& p = *file_.projection;
  const auto [first, last] = pictureCorners(v);
  const double across = (p.right() - p.left()) / v.width, up = (p.top() - p.bottom()) / v.height;
  const bool down = v.origin == Origin::topLeft;
  const double left = p.left() + (seen_.left - first.x) * across, right = p.left() + (seen_.right - first.x) * across;
  const double bottom = down ? p.top() - (seen_.bottom - first.y) * up : p.bottom() + (seen_.top - first.y) * up;
  const double top = down ? p.top() - (seen_.top - first.y) * up : p.bottom() + (seen_.bottom - first.y) * up;
  const double inner = 1 - 2 * margin_, width = p.right() - p.left(), height = p.top() - p.bottom();
  const double share = std::max((right - left) / (width * inner), (top - bottom) / (height * inner));
  if (!(share > 0)) throw InputError("all of it is one point of the picture: it fits at any scale");
  const double toSide = width * share / 2, toTop = height * share / 2;
  // Lest the rounding of a screen box leave some out.
  const double spare = 0x1p-52 * (std::fabs(left + right) + std::fabs(bottom + top) + (1 + share) * (width + height));
  return withWindow(file_, (left + right) / 2 - toSide - spare, (left + right) / 2 + toSide + spare,
                    (bottom + top) / 2 - toTop - spare, (bottom + top) / 2 + toTop + spare);
}

}  // namespace viewproj::cmd
