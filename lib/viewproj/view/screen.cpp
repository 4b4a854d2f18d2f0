#include "viewproj/view/screen.hpp"

#include <cmath>
#include <limits>

#include "viewproj/numbers/expansion.hpp"

namespace viewproj {
namespace {

/// w = forward . d in double is off by at most 5 * 2^-53 max|forward_i| times the sum of |d_i| (row, difference, product
/// and two sums each rounded once); this is rounded up generously.
constexpr double kSignOfWUncertainty = 0x1p-49;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ScreenPoint without(PointStatus status, double viewDistance) noexcept {
  ScreenPoint p;
  p.x = p.y = p.depth = kNaN;
  p.viewDistance = viewDistance;
  p.status = status;
  return p;
}

/// Beyond which sides of the picture and of near and far, judged on the numbers that are given out.
std::uint8_t sidesBeyond(const Camera& c, const ScreenPoint& p) noexcept {
  const double left = c.viewport.x + (c.viewport.pixelCenter - 0.5);
  const double start = c.viewport.y + (c.viewport.pixelCenter - 0.5);
  const bool down = c.viewport.origin == Origin::topLeft;
  unsigned sides = 0;
  if (p.x < left) sides |= sideLeft;
  if (p.x > left + c.viewport.width) sides |= sideRight;
  if (p.y < start) sides |= down ? sideTop : sideBottom;
  if (p.y > start + c.viewport.height) sides |= down ? sideBottom : sideTop;
  if (p.viewDistance < c.projection.near) sides |= sideNear;
  if (p.viewDistance > c.projection.far) sides |= sideFar;
  return static_cast<std::uint8_t>(sides);
}

/// center + scale * h, rounded once; the plain formula where double-double has no finite value.
double screenCoordinate(DoubleDouble center, DoubleDouble scale, DoubleDouble h) noexcept {
  const DoubleDouble value = sumOrZero(center, scale * h);
  // Adding 0 turns -0 into 0.
  return (std::isnan(value.hi) ? center.hi + scale.hi * h.hi : value.hi) + 0.0;
}

/// a / b, keeping an infinite quotient infinite.
DoubleDouble quotient(DoubleDouble a, DoubleDouble b) noexcept {
  const double approximate = a.hi / b.hi;
  return std::isfinite(approximate) ? a / b : DoubleDouble(approximate);
}

/// Window depth at distance w > 0, from the nearer end of the depth range: near's and far's shares of it are
///   perspective   n (f - w) / ((f - n) w)   and   f (w - n) / ((f - n) w)
///   orthographic  (f - w) / (f - n)         and   (w - n) / (f - n)
double windowDepth(const Camera& c, DoubleDouble w) noexcept {
  double n = c.projection.near, f = c.projection.far;
  DoubleDouble shareOfNear, shareOfFar;
  if (c.projection.orthographic) {
    shareOfNear = sumOrZero(f, -w) * c.farOverRange;
    shareOfFar = sumOrZero(w, -n) * c.farOverRange;
  } else {
    // Brought to the middle of the range first: only ratios count.
    const double scale = w.hi < 0x1p-400 ? 0x1p600 : w.hi > 0x1p400 ? 0x1p-600 : 1;
    const DoubleDouble ws = timesPowerOfTwo(w, scale);
    n *= scale;
    f *= scale;
    const DoubleDouble fromFar = f > ws.hi * 0x1p120 ? DoubleDouble(1) : sumOrZero(f, -ws) / DoubleDouble(f);
    shareOfNear = quotient(n, ws) * fromFar * c.farOverRange;
    shareOfFar = quotient(sumOrZero(ws, -n), ws) * c.farOverRange;
  }
  const DoubleDouble first = c.depthAtNear == 0 ? DoubleDouble(0) : DoubleDouble(c.depthAtNear) * shareOfNear;
  const DoubleDouble second = c.depthAtFar == 0 ? DoubleDouble(0) : DoubleDouble(c.depthAtFar) * shareOfFar;
  const DoubleDouble depth = first + second;
  // Next to the eye plane depth may overflow.
  return (std::isnan(depth.hi) ? c.rounded.depthOffset + c.rounded.depthScale / w.hi : depth.hi) + 0.0;
}

/// Orthographic: a direction runs out of the picture through these sides.
std::uint8_t sidesTowards(const EyePoint& e) noexcept {
  unsigned sides = 0;
  if (e.right.hi < 0) sides |= sideLeft;
  if (e.right.hi > 0) sides |= sideRight;
  if (e.up.hi < 0) sides |= sideBottom;
  if (e.up.hi > 0) sides |= sideTop;
  if (e.forward.hi < 0) sides |= sideNear;
  if (e.forward.hi > 0) sides |= sideFar;
  return static_cast<std::uint8_t>(sides);
}

/// A direction (w = 0), from its coordinates along the camera's axes.
ScreenPoint directionToScreen(const Camera& c, const EyePoint& e) noexcept {
  if (c.projection.orthographic) {
    ScreenPoint p = without(PointStatus::atInfinity, kNaN);
    p.outside = sidesTowards(e);
    return p;
  }
  if (!(e.forward.hi > 0)) return without(PointStatus::behind, kNaN);
  ScreenPoint p;
  p.x = screenCoordinate(c.screen.centerX, c.screen.scaleX, quotient(e.right, e.forward));
  p.y = screenCoordinate(c.screen.centerY, c.screen.scaleY, quotient(e.up, e.forward));
  p.depth = c.depthAtInfinity;
  p.viewDistance = kNaN;
  p.outside = sidesBeyond(c, p);
  if (std::isfinite(c.projection.far)) p.outside |= sideFar;
  return p;
}

ScreenPoint exactToScreen(const Camera& c, const Vec4& point) noexcept {
  const EyePoint e = toEye(c.pose, point);
  if (point.w == 0) return directionToScreen(c, e);
  const DoubleDouble perW = DoubleDouble(1) / DoubleDouble(point.w);
  const auto inWorld = [&](DoubleDouble a) {
    return scaleByPowerOfTwo(point.w == 1 ? a : a * perW, e.exponent);
  };
  const DoubleDouble distance = inWorld(e.forward);
  ScreenPoint p;
  p.viewDistance = distance.hi + 0.0;
  if (c.projection.orthographic) {
    p.x = screenCoordinate(c.screen.centerX, c.screen.scaleX, inWorld(e.right));
    p.y = screenCoordinate(c.screen.centerY, c.screen.scaleY, inWorld(e.up));
  } else {
    const bool inFront = point.w > 0 ? e.forward.hi > 0 : e.forward.hi < 0;
    if (!inFront) return without(PointStatus::behind, p.viewDistance);
    p.x = screenCoordinate(c.screen.centerX, c.screen.scaleX, quotient(e.right, e.forward));
    p.y = screenCoordinate(c.screen.centerY, c.screen.scaleY, quotient(e.up, e.forward));
  }
  p.depth = windowDepth(c, distance);
  p.outside = sidesBeyond(c, p);
  return p;
}

ScreenPoint standardToScreen(const Camera& c, const Vec3& point) noexcept {
  const auto& r = c.rounded;
  const Vec3 d{(point.x - r.eye.x) - r.eyeLow.x, (point.y - r.eye.y) - r.eyeLow.y, (point.z - r.eye.z) - r.eyeLow.z};
  const double x = r.x.x * d.x + r.x.y * d.y + r.x.z * d.z;
  const double y = r.y.x * d.x + r.y.y * d.y + r.y.z * d.z;
  const double w = r.w.x * d.x + r.w.y * d.y + r.w.z * d.z;
  // Out of the range in which doubles are safe, or so near the eye plane that the sign of w is not certain.
  const double reach = std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z);
  const bool signCertain = std::fabs(w) > kSignOfWUncertainty * reach;
  if (!(reach < 0x1p900 && std::fabs(x) < 0x1p1000 && std::fabs(y) < 0x1p1000 &&
        (c.projection.orthographic || (signCertain && std::fabs(w) > 0x1p-900))))
    return exactToScreen(c, {point.x, point.y, point.z, 1});
  ScreenPoint p;
  p.viewDistance = w;
  if (c.projection.orthographic) {
    p.x = r.centerX + x;
    p.y = r.centerY + y;
    p.depth = r.depthOffset + r.depthScale * w;
  } else {
    if (w < 0) return without(PointStatus::behind, w);
    const double perW = 1 / w;
    p.x = r.centerX + x * perW;
    p.y = r.centerY + y * perW;
    p.depth = r.depthOffset + r.depthScale * perW;
  }
  p.outside = sidesBeyond(c, p);
  return p;
}

/// value - w * eye, as a double-double of full relative precision: up to five terms, summed exactly.
DoubleDouble relativeToEye(double value, double w, DoubleDouble eye) noexcept {
  if (w == 1 && eye.lo == 0) return twoDiff(value, eye.hi);
  Expansion<8> sum;
  sum.addProduct(-eye.lo, w);
  sum.addProduct(-eye.hi, w);
  sum.add(value);
  return sum.rounded();
}

}  // namespace

Vec4 withUnitWeight(const Vec4& p) noexcept {
  if (p.w == 0 || p.w == 1) return p;
  const int k = -std::ilogb(p.w);
  const Vec4 scaled{std::ldexp(p.x, k), std::ldexp(p.y, k), std::ldexp(p.z, k), std::ldexp(p.w, k)};
  if (isFinite(Vec3{scaled.x, scaled.y, scaled.z})) return scaled;
  return p.w > 0 ? Vec4{p.x, p.y, p.z, 0} : Vec4{-p.x, -p.y, -p.z, 0};
}

EyePoint toEye(const Pose& pose, const Vec4& point) noexcept {
  // An eighth keeps the difference of the largest doubles finite.
  const double largest = std::max(maxAbs(Vec3{point.x, point.y, point.z}), maxAbs(pose.eye));
  const bool huge = largest > 0x1p900;
  const double scale = huge ? 0x1p-200 : 1;
  DDVec3 d;
  const Vec3 p{point.x * scale, point.y * scale, point.z * scale};
  for (std::size_t i = 0; i < 3; ++i) d[i] = relativeToEye(p[i], point.w, timesPowerOfTwo(pose.eye[i], scale));
  const int k = exponentToUnit(d);
  d = scaleByPowerOfTwo(d, k);
  return {dotOrZero(pose.rows.right, d), dotOrZero(pose.rows.up, d), dotOrZero(pose.rows.forward, d), -k + (huge ? 200 : 0)};
}

ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  const Vec3 xyz{point.x, point.y, point.z};
  if (!isFinite(xyz) || !std::isfinite(point.w) || (maxAbs(xyz) == 0 && point.w == 0))
    return without(PointStatus::notFinite, kNaN);
  if (precision == Precision::standard && point.w == 1) return standardToScreen(camera, xyz);
  return exactToScreen(camera, withUnitWeight(point));
}

ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision) noexcept {
  if (precision == Precision::exact) return worldToScreen(camera, Vec4{point.x, point.y, point.z, 1}, precision);
  if (!isFinite(point)) return without(PointStatus::notFinite, kNaN);
  return standardToScreen(camera, point);
}

}  // namespace viewproj
