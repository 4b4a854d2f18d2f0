#include "viewproj/clip.hpp"

#include <limits>

#include "projection/clip_point.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Vec3 worldToView(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isInDomain(parts(camera).pose.eye, point)) return {kNaN, kNaN, kNaN};
  return toView(toAxes(parts(camera).pose, point), convention);
}

Vec4 worldToClip(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isInDomain(parts(camera).pose.eye, point)) return {kNaN, kNaN, kNaN, kNaN};
  return toVector(toClip(parts(camera), toAxes(parts(camera).pose, point), convention));
}

Vec3 worldToNdc(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isInDomain(parts(camera).pose.eye, point)) return {kNaN, kNaN, kNaN};
  return toNdc(toClip(parts(camera), toAxes(parts(camera).pose, point), convention));
}

}  // namespace viewproj
