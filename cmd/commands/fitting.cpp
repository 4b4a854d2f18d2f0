#include "commands/fitting.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/change_camera.hpp"
#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using detail::DDVec3;
using detail::toDoubleDouble;
namespace {

DDVec3 difference(const Vec3& a, const Vec3& b) { return toDoubleDouble(a) + -toDoubleDouble(b); }
double along(const Vec3& normal, const DDVec3& v) { return dot(toDoubleDouble(normal), v).hi; }
double along(const Vec3& normal, const Vec3& v) { return along(normal, toDoubleDouble(v)); }
/// The camera, with the picture of another one.
CameraFile withPicture(CameraFile camera, const CameraFile& other) {
  camera.viewport = other.viewport;
  return camera;
}
double size(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

}  // namespace

Fitting::Window Fitting::windowWithin(double margin) const {
  const Projection& p = *file_.projection;
  const double x = margin * (p.right() - p.left()), y = margin * (p.top() - p.bottom());
  return {p.left() + x, p.right() - x, p.bottom() + y, p.top() - y};
}

// So that the eye can move and the axes stay, its position becomes a field of the document.
Fitting::Fitting(const CameraFile& camera, double margin, bool isFree)
    : file_(withPicture(readCamera(movedTo(camera, camera.pose->eye()), camera.reading), camera)),
      camera_(makeCamera(file_)),
      margin_(margin),
      isFree_(isFree),
      open_(camera_) {
  const Projection& p = *file_.projection;
  // The margin taken off, and near and far out of the way.
  const auto cameraWithin = [&](double share) {
    const auto [left, right, bottom, top] = windowWithin(share);
    return makeCamera(*file_.pose,
                      p.isOrthographic() ? orthographic(left, right, bottom, top, -kLargestNumber, kLargestNumber)
                                         : perspectiveWindow(left, right, bottom, top, kSmallestNumber, kInfiniteFar),
                      *file_.viewport, file_.convention);
  };
  open_ = cameraWithin(0);
  const Frustum inner = viewFrustum(cameraWithin(margin));
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec4 plane = inner.planes()[i].equation;
    (i < 4 ? sides_[i] : ahead_).normal = {plane.x, plane.y, plane.z};
  }
  const Vec3& n = ahead_.normal;
  unit_ = 1 / std::fabs(worldTo(camera_, Space::view, {n.x, n.y, n.z, 0}, file_.convention).z);
}

void Fitting::add(const Sphere& sphere) {
  const DDVec3 d = difference(sphere.center, camera_.pose().eye());
  const double rounding = 0x1p-52 * (size(rounded(d)) + sphere.radius);  // of the normals
  for (Side& side : sides_) side.room = std::min(side.room, along(side.normal, d) - sphere.radius - rounding);
  const double distance = along(ahead_.normal, d);
  ahead_.room = std::min(ahead_.room, distance - sphere.radius - rounding);
  nearest_ = std::min(nearest_, (distance - sphere.radius) / unit_);
  farthest_ = std::max(farthest_, (distance + sphere.radius) / unit_);
  const auto box = screenBox(open_, sphere);
  if (!box) return;
  const Intrinsics k = camera_.intrinsics();
  const double down = camera_.viewport().origin == Origin::topLeft ? 1 : -1;
  seen_.left = std::min(seen_.left, (box->left - k.cx) / k.fx);
  seen_.right = std::max(seen_.right, (box->right - k.cx) / k.fx);
  seen_.bottom = std::min(seen_.bottom, down * (k.cy - box->bottom) / k.fy);
  seen_.top = std::max(seen_.top, down * (k.cy - box->top) / k.fy);
}

void Fitting::add(const Box& box) {
  for (unsigned i = 0; i < 8; ++i)
    add(Vec3{i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
}

void Fitting::add(const Triangle& triangle) {
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) add(corner);
}

void Fitting::requireSomething() const {
  if (!(farthest_ >= nearest_)) throw InputError("there are no points or shapes to fit");
}

Document Fitting::byPlace() const {
  requireSomething();
  if (file_.projection->isOrthographic()) return box(true);
  const Pose pose = camera_.pose();
  const double near = unit_ * file_.projection->zNear();
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
    const double rounding = 0x1p-52 * size(rounded(way));  // of the normals
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return along(side.normal, way) + rounding <= side.room; }) &&
           along(ahead_.normal, way) + rounding <= ahead_.room - near;
  };
  // Rounded, the eye may leave something out: then it goes back, as little as helps, from the middle of the window.
  const Window w = windowWithin(margin_);
  const Vec3 middle = sum(sum(forward, (w.left + w.right) / 2, right), (w.bottom + w.top) / 2, up);
  Vec3 to = sum(eye, 1, moved);
  const double ulp = 0x1p-53 * (size(eye) + size(moved));
  for (double back = ulp; !holds(to) && back < 0x1p20 * ulp; back *= 2) to = sum(sum(eye, 1, moved), -back, middle);
  const double reach = farthest_ - along(ahead_.normal, difference(to, eye)) / unit_;
  if (reach > file_.projection->zFar())
    throw InputError(file_.name + ": some of it is then " + formatDigits(reach, 6) +
                     " away, beyond far; --far takes a larger one");
  return movedTo(file_, to);
}

Document Fitting::byWindow() const {
  requireSomething();
  const Projection& p = *file_.projection;
  if (p.isOrthographic()) return box(false);
  if (!(nearest_ > 0))
    throw InputError("something of it lies on or behind the plane through the eye; no lens shows that");
  if (nearest_ < p.zNear() || farthest_ > p.zFar()) failCut();
  return openedPerspective();
}

void Fitting::failCut() const {
  throw InputError(file_.name + ": it lies from " + formatDigits(nearest_, 6) + " to " + formatDigits(farthest_, 6) +
                   " along the view, which near and far cut; --near and --far give others");
}

double Fitting::rounding(double share) const {
  const auto [left, right, bottom, top] = windowWithin(0);
  const Intrinsics k = camera_.intrinsics();
  return 0x1p-51 * (std::fabs(k.cx) / k.fx + std::fabs(k.cy) / k.fy +
                    (1 + share) * (std::fabs(left) + std::fabs(right) + std::fabs(bottom) + std::fabs(top)));
}

Document Fitting::openedPerspective() const {
  const auto [left, right, bottom, top] = windowWithin(margin_);
  if (!(left < 0 && 0 < right && bottom < 0 && 0 < top))
    throw InputError("the viewing axis lies outside the part of the picture to fill; --by fov opens the lens about it");
  double k = std::max({seen_.left / left, seen_.right / right, seen_.bottom / bottom, seen_.top / top});
  if (!(k > 0 && std::isfinite(k)))
    throw InputError("all of it lies on the viewing axis, or is one point: any lens shows it");
  k += rounding(k) / std::min({-left, right, -bottom, top});
  // Lest the rounding of its angle leave some out.
  const double tangent = k * std::max({-left, right, -bottom, top});
  k *= 1 + 0x1p-50 + 0x1p-52 * std::atan(tangent) * (tangent + 1 / tangent);
  return opened(file_, k);
}

Document Fitting::box(bool movesEye) const {
  const Projection& p = *file_.projection;
  const auto isTyped = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      const auto& labels = file_.document.labels;
      return labels.contains("projection") || labels.contains("projection." + name);
    });
  };
  const bool keepsNear = isTyped({"near"}), keepsFar = isTyped({"far"});
  if ((keepsNear && nearest_ < p.zNear()) || (keepsFar && farthest_ > p.zFar())) failCut();
  const auto [left, right, bottom, top] = windowWithin(margin_);
  const Window full = windowWithin(0);
  double across = (seen_.right - seen_.left) / (right - left), upwards = (seen_.top - seen_.bottom) / (top - bottom);
  double share = std::max(across, upwards);
  const bool keepsSize = isTyped({"left", "right", "bottom", "top", "width", "height"});
  if (keepsSize && share > 1)
    throw InputError(file_.name + ": all of it needs a window of " + formatDigits(share * (full.right - full.left), 6) +
                     " by " + formatDigits(share * (full.top - full.bottom), 6));
  if (keepsSize) share = 1;
  if (!isFree_ || keepsSize || !(std::min(across, upwards) > 0)) across = upwards = share;
  if (!(share > 0)) throw InputError("all of it is one point of the picture: it fits at any scale");
  const Vec3 eye = camera_.pose().eye();
  double x = (seen_.left + seen_.right) / 2, y = (seen_.bottom + seen_.top) / 2;
  // How far the things may be from the eye and the origin.
  const double reach = size(eye) + std::fabs(x) + std::fabs(y) + std::max(std::fabs(nearest_), std::fabs(farthest_));
  const double spare = keepsSize ? 0 : rounding(share) + 0x1p-50 * reach;
  const double toSide = (full.right - full.left) * across / 2 + spare,
               toTop = (full.top - full.bottom) * upwards / 2 + spare;
  const double deep = 0x1p-48 * (std::fabs(nearest_) + std::fabs(farthest_) + size(eye));
  const double least = farthest_ > nearest_ ? deep : deep + toTop;  // of a flat thing
  CameraFile there = file_;
  if (movesEye) {
    x -= keepsSize ? (full.left + full.right) / 2 : 0;
    y -= keepsSize ? (full.bottom + full.top) / 2 : 0;
    there = readCamera(movedTo(file_, sum(sum(eye, x, camera_.pose().right()), y, camera_.pose().up())), file_.reading);
    x = y = 0;
  }
  Document fitted = keepsSize ? withWindow(there, full.left, full.right, full.bottom, full.top)
                              : withWindow(there, x - toSide, x + toSide, y - toTop, y + toTop);
  Json& projection = (*fitted.root)["projection"];
  if (!keepsNear) projection["near"] = nearest_ - least;
  if (!keepsFar) projection["far"] = farthest_ + least;
  return fitted;
}

}  // namespace viewproj::cmd
