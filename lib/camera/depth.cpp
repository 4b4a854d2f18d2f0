#include "camera/depth.hpp"

#include <algorithm>

#include "numbers/dyadic.hpp"

namespace viewproj::detail {

RangeShares rangeShares(double near, double far) noexcept {
  const double scale = std::max(std::fabs(near), std::fabs(far)) > 0x1p900 ? 0x1p-200 : 1;
  const double n = near * scale;
  const double f = far * scale;
  const DoubleDouble range = twoDiff(f, n);
  return {DoubleDouble(n) / range, DoubleDouble(f) / range, timesPowerOfTwo(DoubleDouble(1) / range, scale)};
}

namespace {

/// (f ofFar - n ofNear) / (f - n), within 2^-97 of itself: where it cancels, as for depths that are to each other as
/// near and far are, from exact products.
DoubleDouble depthOffset(const ProjectionParts& p, const RangeShares& share, double ofFar, double ofNear) noexcept {
  const DoubleDouble first = share.far * DoubleDouble(ofFar), second = share.near * DoubleDouble(ofNear);
  const DoubleDouble offset = first - second;
  if (8 * std::fabs(offset.hi) >= std::fabs(first.hi) + std::fabs(second.hi)) return offset;
  const Dyadic near = p.near, far = p.far;
  return toDoubleDouble((far * Dyadic(ofFar) - near * Dyadic(ofNear)).rounded() / (far - near).rounded());
}

}  // namespace

DepthLine depthLine(const ProjectionParts& p, const DepthEnds& ends) noexcept {
  // perspective:   offset = (f atFar - n atNear) / (f - n)     scale = f n (atNear - atFar) / (f - n)
  // infinite far:  offset = atFar                              scale = n (atNear - atFar)
  // orthographic:  offset = (f atNear - n atFar) / (f - n)     scale = (atFar - atNear) / (f - n)
  // f / (f - n) comes first, because f n may overflow.
  const auto [atNear, atFar] = ends;
  const DoubleDouble step = twoDiff(atNear, atFar);
  if (std::isinf(p.far)) return {atFar, DoubleDouble(p.near) * step};
  const RangeShares share = rangeShares(p.near, p.far);
  if (p.orthographic) return {depthOffset(p, share, atNear, atFar), -step * share.one};
  return {depthOffset(p, share, atFar, atNear), share.far * DoubleDouble(p.near) * step};
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
