#include "camera/depth.hpp"

#include <algorithm>

namespace viewproj::detail {

RangeShares rangeShares(double near, double far) noexcept {
  const double scale = std::max(std::fabs(near), std::fabs(far)) > 0x1p900 ? 0x1p-200 : 1;
  const double n = near * scale;
  const double f = far * scale;
  const DoubleDouble range = twoDiff(f, n);
  return {DoubleDouble(n) / range, DoubleDouble(f) / range, timesPowerOfTwo(DoubleDouble(1) / range, scale)};
}

DepthLine depthLine(const ProjectionParts& p, const DepthEnds& ends) noexcept {
  // perspective:   offset = (f atFar - n atNear) / (f - n)     scale = f n (atNear - atFar) / (f - n)
  // infinite far:  offset = atFar                              scale = n (atNear - atFar)
  // orthographic:  offset = (f atNear - n atFar) / (f - n)     scale = (atFar - atNear) / (f - n)
  // f / (f - n) comes first, because f n may overflow.
  const auto [atNear, atFar] = ends;
  const DoubleDouble step = twoDiff(atNear, atFar);
  if (std::isinf(p.far)) return {atFar, DoubleDouble(p.near) * step};
  const RangeShares share = rangeShares(p.near, p.far);
  if (p.orthographic) return {share.far * DoubleDouble(atNear) - share.near * DoubleDouble(atFar), -step * share.one};
  return {share.far * DoubleDouble(atFar) - share.near * DoubleDouble(atNear), share.far * DoubleDouble(p.near) * step};
}

DepthLine inverseDepthLine(const ProjectionParts& p, const DepthEnds& ends) noexcept {
  const auto [atNear, atFar] = ends;
  const DoubleDouble step = twoDiff(atFar, atNear);
  const DoubleDouble near = p.orthographic ? DoubleDouble(p.near) : DoubleDouble(1) / DoubleDouble(p.near);
  const DoubleDouble far = p.orthographic      ? DoubleDouble(p.far)
                           : std::isinf(p.far) ? DoubleDouble(0)
                                               : DoubleDouble(1) / DoubleDouble(p.far);
  return {(near * DoubleDouble(atFar) - far * DoubleDouble(atNear)) / step, (far - near) / step};
}

}  // namespace viewproj::detail
