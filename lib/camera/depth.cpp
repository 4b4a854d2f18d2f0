#include "camera/depth.hpp"

#include <cmath>

#include "numbers/dyadic.hpp"

namespace viewproj::detail {
namespace {

/// (f ofFar - n ofNear) / (f - n), within 2^-97 relative. Uses exact products if it cancels, as when ofFar : ofNear is
/// nearly n : f.
DoubleDouble depthOffset(const ProjectionParts& p, double ofFar, double ofNear) noexcept {
  const DoubleDouble range = twoDiff(p.far, p.near);
  const DoubleDouble first = DoubleDouble(p.far) / range * DoubleDouble(ofFar);
  const DoubleDouble second = DoubleDouble(p.near) / range * DoubleDouble(ofNear);
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
  const DoubleDouble range = twoDiff(p.far, p.near);
  if (p.orthographic) return {depthOffset(p, atNear, atFar), -step * (DoubleDouble(1) / range)};
  return {depthOffset(p, atFar, atNear), DoubleDouble(p.far) / range * DoubleDouble(p.near) * step};
}

DepthLine inverseDepthLine(const ProjectionParts& p, const DepthEnds& ends) noexcept {
  // perspective:   offset = (f atFar - n atNear) / (n f (atFar - atNear))   scale = (n - f) / (n f (atFar - atNear))
  // infinite far:  offset = atFar / (n (atFar - atNear))                    scale = -1 / (n (atFar - atNear))
  // orthographic:  offset = (n atFar - f atNear) / (atFar - atNear)         scale = (f - n) / (atFar - atNear)
  // Exact products, because the differences may cancel.
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

DepthShares depthShares(const ProjectionParts& p, const Wide& forward, const Wide& weight,
                        bool forwardIsExact) noexcept {
  const auto difference = [&](const Wide& a, const Wide& b) { return forwardIsExact ? a - b : sumOrZero(a, -b); };
  const Wide near = p.near, fromNear = difference(forward, near * weight);
  if (std::isinf(p.far)) return {near * weight, fromNear};
  // Divides first: at near and far the quotients are exactly 1.
  const Wide far = p.far, range = far - near;
  const Wide ofNear = difference(far * weight, forward) / range, ofFar = fromNear / range;
  if (p.orthographic) return {ofNear, ofFar};
  return {near * ofNear, far * ofFar};
}

}  // namespace viewproj::detail
