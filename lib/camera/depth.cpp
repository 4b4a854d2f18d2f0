#include "camera/depth.hpp"

#include <algorithm>

#include "numbers/dyadic.hpp"

namespace viewproj::detail {

RangeShares rangeShares(double near, double far) noexcept {
  const DoubleDouble range = twoDiff(far, near);
  return {DoubleDouble(near) / range, DoubleDouble(far) / range, DoubleDouble(1) / range};
}

namespace {

/// (f ofFar - n ofNear) / (f - n), within 2^-97 of itself: where it cancels, as for depths that are to each other as
/// near and far are, from exact products.
DoubleDouble depthOffset(const ProjectionParts& p, const RangeShares& share, double ofFar, double ofNear) noexcept {
  const DoubleDouble first = share.far * DoubleDouble(ofFar), second = share.near * DoubleDouble(ofNear);
  const DoubleDouble offset = first - second;
  if (8 * std::fabs(offset.hi) >= std::fabs(first.hi) + std::fabs(second.hi)) return offset;
  const Dyadic<1> near = p.near, far = p.far;
  return toDoubleDouble((far * Dyadic<1>(ofFar) - near * Dyadic<1>(ofNear)).rounded() / (far - near).rounded());
}

}  // namespace

DepthLine depthLine(const ProjectionParts& p, const DepthEnds& ends) noexcept {
  // perspective:   offset = (f atFar - n atNear) / (f - n)     scale = f n (atNear - atFar) / (f - n)
  // infinite far:  offset = atFar                              scale = n (atNear - atFar)
  // orthographic:  offset = (f atNear - n atFar) / (f - n)     scale = (atFar - atNear) / (f - n)
  const auto [atNear, atFar] = ends;
  const DoubleDouble step = twoDiff(atNear, atFar);
  if (std::isinf(p.far)) return {atFar, DoubleDouble(p.near) * step};
  const RangeShares share = rangeShares(p.near, p.far);
  if (p.orthographic) return {depthOffset(p, share, atNear, atFar), -step * share.one};
  return {depthOffset(p, share, atFar, atNear), share.far * DoubleDouble(p.near) * step};
}

DepthLine inverseDepthLine(const ProjectionParts& p, const DepthEnds& ends) noexcept {
  // perspective:   offset = (f atFar - n atNear) / (n f (atFar - atNear))   scale = (n - f) / (n f (atFar - atNear))
  // infinite far:  offset = atFar / (n (atFar - atNear))                    scale = -1 / (n (atFar - atNear))
  // orthographic:  offset = (n atFar - f atNear) / (atFar - atNear)         scale = (f - n) / (atFar - atNear)
  // Of exact products: they may cancel.
  const auto [atNear, atFar] = ends;
  const Dyadic<1> near = p.near, step = Dyadic<1>::difference(atFar, atNear);
  const auto line = [](const Dyadic<2>& offset, const Dyadic<1>& scale, const Dyadic<3>& divisor) {
    const Wide by = divisor.rounded();
    return DepthLine{toDoubleDouble(offset.rounded() / by), toDoubleDouble(scale.rounded() / by)};
  };
  if (std::isinf(p.far)) return line(atFar, -1.0, near * step);
  const Dyadic<1> far = p.far;
  if (p.orthographic) return line(near * Dyadic<1>(atFar) - far * Dyadic<1>(atNear), far - near, step);
  return line(far * Dyadic<1>(atFar) - near * Dyadic<1>(atNear), near - far, near * far * step);
}

}  // namespace viewproj::detail
