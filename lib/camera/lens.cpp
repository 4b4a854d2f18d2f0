#include "camera/lens.hpp"

namespace viewproj {

DepthLine inverseDepthLine(const Projection& p, double atNear, double atFar) noexcept {
  const DoubleDouble step = twoDiff(atFar, atNear);
  const DoubleDouble near = p.orthographic ? DoubleDouble(p.near) : DoubleDouble(1) / DoubleDouble(p.near);
  const DoubleDouble far = p.orthographic      ? DoubleDouble(p.far)
                           : std::isinf(p.far) ? DoubleDouble(0)
                                               : DoubleDouble(1) / DoubleDouble(p.far);
  return {(near * DoubleDouble(atFar) - far * DoubleDouble(atNear)) / step, (far - near) / step};
}

Lens ndcLens(const Projection& p, const Convention& c) noexcept {
  const DoubleDouble width = p.right - p.left;
  const DoubleDouble height = p.top - p.bottom;
  const DoubleDouble up = c.ndcY == NdcY::up ? 1 : -1;
  const NdcDepths z = ndcDepths(c);
  const DepthLine inverse = inverseDepthLine(p, z.atNear, z.atFar);
  return {p.orthographic,
          DoubleDouble(2) / width,
          -(p.right + p.left) / width,
          up * DoubleDouble(2) / height,
          -(up * (p.top + p.bottom)) / height,
          timesPowerOfTwo(width, 0.5),
          timesPowerOfTwo(p.right + p.left, 0.5),
          up * timesPowerOfTwo(height, 0.5),
          timesPowerOfTwo(p.top + p.bottom, 0.5),
          depthLine(p, z.atNear, z.atFar),
          inverse.offset,
          inverse.scale};
}

}  // namespace viewproj
