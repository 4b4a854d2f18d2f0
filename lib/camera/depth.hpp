// A convention as numbers, and the relation between distance along the viewing axis and window depth or NDC z.
#pragma once

#include "camera/projection.hpp"
#include "numbers/wide.hpp"
#include "viewproj/convention.hpp"

namespace viewproj::detail {

/// +1 if the axis of view space points along up (or forward), -1 if it points the opposite way.
struct AxisSigns {
  double up, forward;
};

constexpr AxisSigns axisSigns(ViewAxes axes) noexcept {
  return {axes == ViewAxes::RDF ? -1.0 : 1.0, axes == ViewAxes::RUB ? -1.0 : 1.0};
}

/// Depth at the near and at the far plane.
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

/// offset + scale / W (perspective) or offset + scale * W (orthographic).
struct DepthLine {
  DoubleDouble offset, scale;
};

DepthLine depthLine(const ProjectionParts& projection, const DepthEnds& ends) noexcept;

/// The inverse: 1/W (perspective) or W (orthographic) = offset + scale * depth.
DepthLine inverseDepthLine(const ProjectionParts& projection, const DepthEnds& ends) noexcept;

/// The weights of near's and of far's depth in window depth or NDC z, times clip's w. In perspective, divide them by
/// the distance. The point is at distance forward / weight; a direction has weight 0.
///   perspective   n (f weight - forward) / (f - n)   and   f (forward - n weight) / (f - n)
///   infinite far  n weight                           and   forward - n weight
///   orthographic  (f weight - forward) / (f - n)     and   (forward - n weight) / (f - n)
struct DepthShares {
  Wide ofNear, ofFar;
};

/// forwardIsExact: a difference to near or far that cancels is exact, not noise.
DepthShares depthShares(const ProjectionParts& projection, const Wide& forward, const Wide& weight,
                        bool forwardIsExact = false) noexcept;

}  // namespace viewproj::detail
