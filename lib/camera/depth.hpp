// The law of depth: between a distance along the view and window depth or NDC z. Internal.
#pragma once

#include <cmath>

#include "camera/projection.hpp"
#include "numbers/wide.hpp"

namespace viewproj::detail {

/// Depth of the near and the far plane.
struct DepthEnds {
  double atNear, atFar;
};

constexpr DepthEnds ndcDepths(const Convention& c) noexcept {
  const double low = c.ndcZ == NdcZ::minusOneToOne ? -1 : 0;
  return c.reverseZ ? DepthEnds{1, low} : DepthEnds{low, 1};
}

constexpr DepthEnds windowDepths(const Viewport& v, bool reverseZ) noexcept {
  return reverseZ ? DepthEnds{v.depthSecond, v.depthFirst} : DepthEnds{v.depthFirst, v.depthSecond};
}

/// near / (far - near), far / (far - near) and 1 / (far - near), for finite far.
struct RangeShares {
  DoubleDouble near, far, one;
};

RangeShares rangeShares(double near, double far) noexcept;

/// offset + scale / W (perspective) or offset + scale * W (orthographic).
struct DepthLine {
  DoubleDouble offset, scale;
};

DepthLine depthLine(const ProjectionParts& projection, const DepthEnds& ends) noexcept;

/// The inverse: 1/W (perspective) or W (orthographic) = offset + scale * depth.
DepthLine inverseDepthLine(const ProjectionParts& projection, const DepthEnds& ends) noexcept;

/// Near's and far's shares of window depth or of NDC z, times clip's w: what the two ends of the range count, to be
/// divided by the distance in perspective. Of a point at distance forward / weight, a direction has weight 0.
///   perspective   n (f weight - forward) / (f - n)   and   f (forward - n weight) / (f - n)
///   infinite far  n weight                           and   forward - n weight
///   orthographic  (f weight - forward) / (f - n)     and   (forward - n weight) / (f - n)
template <class Number>
struct DepthShares {
  Number ofNear, ofFar;
};

/// forwardIsExact: a difference of it to near or far that cancels is no noise.
template <class Number>
DepthShares<Number> depthShares(bool orthographic, double near, double far, const Number& forward, const Number& weight,
                                bool forwardIsExact = false) noexcept {
  const auto difference = [&](const Number& a, const Number& b) { return forwardIsExact ? a + -b : sumOrZero(a, -b); };
  const Number n = near;
  const Number fromNear = difference(forward, n * weight);
  if (std::isinf(far)) return {n * weight, fromNear};
  const Number f = far;
  // Quotients first: at near and far they are 1, exactly.
  const Number ofNear = difference(f * weight, forward) / (f - n), ofFar = fromNear / (f - n);
  if (orthographic) return {ofNear, ofFar};
  return {n * ofNear, f * ofFar};
}

/// The way back: how far a depth is from near's and from far's, as shares of the range; they sum to 1.
///   perspective   fromNear = (1 - n/w) f/(f - n)
///   orthographic  fromNear = (w - n)/(f - n)
template <class Number>
struct DepthFraction {
  Number fromNear, fromFar;
};

template <class Number>
DepthFraction<Number> depthFraction(double depth, const DepthEnds& ends) noexcept {
  const Number range = Number(ends.atFar) - Number(ends.atNear);
  return {(Number(depth) - Number(ends.atNear)) / range, (Number(ends.atFar) - Number(depth)) / range};
}

/// Perspective: near over the distance.
template <class Number>
Number nearOverDistance(double near, double far, const DepthFraction<Number>& at) noexcept {
  return std::isfinite(far) ? at.fromFar + at.fromNear * (Number(near) / Number(far)) : at.fromFar;
}

template <class Number>
Number orthographicDistance(double near, double far, const DepthFraction<Number>& at) noexcept {
  return Number(near) * at.fromFar + Number(far) * at.fromNear;
}

}  // namespace viewproj::detail
