#include "camera/lens.hpp"

namespace viewproj::detail {

NdcWindow ndcWindow(const ProjectionParts& p, const Convention& c) noexcept {
  const DoubleDouble width = p.right - p.left;
  const DoubleDouble height = p.top - p.bottom;
  const DoubleDouble up = c.ndcY == NdcY::up ? 1 : -1;
  return {DoubleDouble(2) / width, -(p.right + p.left) / width, up * DoubleDouble(2) / height,
          -(up * (p.top + p.bottom)) / height};
}

void requireDepth(const ProjectionParts& p) {
  if (!hasDepth(p)) throw CameraError("near", "needs near: without a near plane there is no depth, and no clip space");
}

Lens ndcLens(const ProjectionParts& p, const Convention& c) {
  requireDepth(p);
  const DoubleDouble up = c.ndcY == NdcY::up ? 1 : -1;
  const NdcWindow window = ndcWindow(p, c);
  const DepthEnds z = ndcDepths(c);
  const DepthLine inverse = inverseDepthLine(p, z);
  return {p.orthographic,
          window.scaleX,
          window.offsetX,
          window.scaleY,
          window.offsetY,
          timesPowerOfTwo(p.right - p.left, 0.5),
          timesPowerOfTwo(p.right + p.left, 0.5),
          up * timesPowerOfTwo(p.top - p.bottom, 0.5),
          timesPowerOfTwo(p.top + p.bottom, 0.5),
          depthLine(p, z),
          inverse.offset,
          inverse.scale};
}

}  // namespace viewproj::detail
