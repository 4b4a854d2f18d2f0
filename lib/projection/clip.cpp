#include "viewproj/clip.hpp"

#include <cmath>
#include <limits>

#include "projection/clip_point.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool isUsable(const Vec4& p) noexcept { return isFinite(Vec3{p.x, p.y, p.z}) && std::isfinite(p.w); }

}  // namespace

Vec3 worldToView(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN};
  return withAxes(parts(camera), point, toEye, [&](const auto& a) { return toView(a, convention); });
}

Vec4 worldToClip(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN, kNaN};
  return withAxes(parts(camera), point, toEye,
                  [&](const auto& a) { return toVector(toClip(parts(camera), a, convention)); });
}

Vec3 worldToNdc(const Camera& camera, const Vec4& point, const Convention& convention) noexcept {
  if (!isUsable(point)) return {kNaN, kNaN, kNaN};
  return withAxes(parts(camera), point, toEye,
                  [&](const auto& a) { return toNdc(toClip(parts(camera), a, convention)); });
}

}  // namespace viewproj
