// What a projection does to coordinates along the camera's axes. Internal.
#pragma once

#include <cmath>

#include "camera/camera.hpp"
#include "numbers/wide.hpp"

namespace viewproj {

/// Two affine maps that a projection is made of: of the window's coordinates and of depth. In perspective
///   out.x = (scaleX X + offsetX W) / W,  out.y = (scaleY Y + offsetY W) / W,  out.z = (depth.offset W + depth.scale) /
///   W
/// and in orthographic
///   out.x = scaleX X + offsetX,          out.y = scaleY Y + offsetY,          out.z = depth.offset + depth.scale W
/// where out is NDC or the screen. The inverse map of x is X = (out.x - offsetX) / scaleX, and so on.
struct Lens {
  bool orthographic;
  DoubleDouble scaleX, offsetX, scaleY, offsetY;
  DoubleDouble inverseScaleX, inverseOffsetX, inverseScaleY, inverseOffsetY;
  DepthLine depth;
  DoubleDouble inverseDepthOffset, inverseDepthScale;  // 1/W or W = inverseDepthOffset + inverseDepthScale out.z
};

/// The inverse of depthLine: 1/W (perspective) or W (orthographic) = offset + scale * depth.
DepthLine inverseDepthLine(const Projection& projection, double atNear, double atFar) noexcept;

/// Near's and far's shares of window depth or of NDC z, times clip's w: what the two ends of the range count, to be
/// divided by the distance in perspective. Of a point at distance forward / weight, a direction has weight 0.
///   perspective   n (f weight - forward) / (f - n)   and   f (forward - n weight) / (f - n)
///   infinite far  n weight                           and   forward - n weight
///   orthographic  (f weight - forward) / (f - n)     and   (forward - n weight) / (f - n)
struct DepthShares {
  Wide ofNear, ofFar;
};

inline DepthShares depthShares(bool orthographic, double near, double far, const Wide& forward,
                               const Wide& weight) noexcept {
  const Wide n = near;
  const Wide fromNear = sumOrZero(forward, -(n * weight));
  if (std::isinf(far)) return {n * weight, fromNear};
  const Wide f = far;
  // Quotients first: at near and far they are 1, exactly.
  const Wide ofNear = sumOrZero(f * weight, -forward) / (f - n), ofFar = fromNear / (f - n);
  if (orthographic) return {ofNear, ofFar};
  return {n * ofNear, f * ofFar};
}

/// To normalised device coordinates of the convention.
Lens ndcLens(const Projection& projection, const Convention& convention) noexcept;

}  // namespace viewproj
