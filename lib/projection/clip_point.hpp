// A point's coordinates along the camera's axes, and in clip space, before they are rounded. Internal.
#pragma once

#include <limits>

#include "camera/convention.hpp"
#include "camera/lens.hpp"
#include "projection/exact_point.hpp"

namespace viewproj::detail {

/// Coordinates along right, up, forward, and 1 for a point or 0 for a direction.
template <class Number>
struct AxisPoint {
  Number right, up, forward, weight;
};

/// In double-double. A distance that cancels to less than its own error is 0.
inline AxisPoint<DoubleDouble> toAxes(const PoseParts& pose, const Vec4& p) noexcept {
  const Vec3 xyz{p.x, p.y, p.z};
  DDVec3 d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = DoubleDouble(xyz[i]) + twoProd(-pose.eye[i], p.w);
  const DoubleDouble perW = p.w == 0 ? DoubleDouble(1) : DoubleDouble(1) / DoubleDouble(p.w);
  const auto along = [&](const DDVec3& axis, DoubleDouble residual) {
    return sumOrZero(dotOrZero(axis, d), residual * DoubleDouble(p.w)) * perW;
  };
  return {along(pose.rows.right, pose.residual.x), along(pose.rows.up, pose.residual.y),
          along(pose.rows.forward, pose.residual.z), p.w == 0 ? 0.0 : 1.0};
}

/// From the exact rows.
inline AxisPoint<Wide> toAxesExactly(const PoseParts& pose, const Vec4& p) noexcept {
  const AxisDistances e = exactDistances(pose, p);
  const Wide w = p.w == 0 ? 1 : p.w;
  return {e.right / w, e.up / w, e.forward / w, p.w == 0 ? 0.0 : 1.0};
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
