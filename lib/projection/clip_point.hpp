// A point's coordinates along the camera's axes, and in clip space, before they are rounded. Internal.
#pragma once

#include <cstdlib>
#include <limits>

#include "camera/camera.hpp"
#include "camera/convention.hpp"
#include "camera/lens.hpp"
#include "projection/eye_point.hpp"
#include "projection/kernels/error_model.hpp"

namespace viewproj::detail {

// Number is DoubleDouble, or Wide where products may leave the range of doubles.

/// Coordinates along right, up, forward, and 1 for a point or 0 for a direction.
template <class Number>
struct AxisPoint {
  Number right, up, forward, weight;
};

inline AxisPoint<DoubleDouble> toAxes(const EyePoint& e, const Vec4& p) noexcept {
  const DoubleDouble perW = p.w == 0 ? DoubleDouble(1) : DoubleDouble(1) / DoubleDouble(p.w);
  const auto inWorld = [&](DoubleDouble a) { return scaleByPowerOfTwo(a * perW, e.exponent); };
  return {inWorld(e.right), inWorld(e.up), inWorld(e.forward), p.w == 0 ? 0.0 : 1.0};
}

inline AxisPoint<Wide> toAxes(const WideEyePoint& e, const Vec4& p) noexcept {
  const Wide w = p.w == 0 ? 1 : p.w;
  return {e.right / w, e.up / w, e.forward / w, p.w == 0 ? 0.0 : 1.0};
}

/// Gives the point's coordinates to use, in what has the range for them.
template <class Use>
auto withAxes(const CameraParts& camera, const Vec4& point, EyePoint (*toEyePoint)(const PoseParts&, const Vec4&),
              const Use& use) noexcept {
  const Vec4 p = withUnitWeight(point);
  const EyePoint e = toEye(camera.pose, p);
  const bool isNarrow = camera.constants.range < kLargestRangeExact && std::abs(e.exponent) <= kLargestExponent &&
                        (p.w == 0) == (point.w == 0);
  if (!isNarrow) return use(toAxes(toEyeWidely(camera.pose, point), point));
  return use(toAxes(toEyePoint == toEye ? e : toEyePoint(camera.pose, p), p));
}

template <class Number>
struct ClipPoint {
  Number x, y, z, w;
};

template <class Number>
ClipPoint<Number> toClip(const CameraParts& camera, const AxisPoint<Number>& a, const Convention& convention) noexcept {
  const ProjectionParts& p = camera.projection;
  const NdcWindow l = ndcWindow(p, convention);
  const Number& w = p.orthographic ? a.weight : a.forward;
  const DepthEnds ends = hasDepth(p) ? ndcDepths(convention) : DepthEnds{NAN, NAN};
  const auto shares = depthShares(p.orthographic, p.near, p.far, a.forward, a.weight);
  return {sumOrZero(as<Number>(l.scaleX) * a.right, as<Number>(l.offsetX) * w),
          sumOrZero(as<Number>(l.scaleY) * a.up, as<Number>(l.offsetY) * w),
          Number(ends.atNear) * shares.ofNear + Number(ends.atFar) * shares.ofFar, w};
}

inline bool isAboveZero(DoubleDouble a) noexcept { return a.hi > 0; }
inline bool isAboveZero(const Wide& a) noexcept { return a.sign() > 0; }

template <class Number>
Vec3 toView(const AxisPoint<Number>& a, const Convention& convention) noexcept {
  const AxisSigns sign = axisSigns(convention.view);
  return {rounded(a.right), sign.up * rounded(a.up) + 0.0, sign.forward * rounded(a.forward) + 0.0};
}

template <class Number>
Vec4 toVector(const ClipPoint<Number>& c) noexcept {
  return {rounded(c.x), rounded(c.y), rounded(c.z), rounded(c.w)};
}

template <class Number>
Vec3 toNdc(const ClipPoint<Number>& c) noexcept {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (!isAboveZero(c.w)) return {kNaN, kNaN, kNaN};
  return {rounded(c.x / c.w), rounded(c.y / c.w), rounded(c.z / c.w)};
}

}  // namespace viewproj::detail
