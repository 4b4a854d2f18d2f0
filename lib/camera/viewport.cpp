#include "camera/viewport.hpp"

#include <algorithm>
#include <cmath>

#include "camera/require.hpp"

namespace viewproj {

using namespace detail;
namespace {

/// Farther away, positions in the picture would lose too many digits.
void requireCorner(double value, double size, const char* field) {
  requireFinite(value, field);
  if (!(std::fabs(value) <= kLargestCorner * size))
    throw CameraError(field, "is more than 1.1e12 times the viewport's size away");
}

}  // namespace

void detail::validate(const Viewport& v) {
  requirePositive(v.width, "viewport.width");
  requirePositive(v.height, "viewport.height");
  requireNumber(v.x, "viewport.x");
  requireNumber(v.y, "viewport.y");
  requireNumber(v.pixelCenter, "viewport.pixelCenter");
  requireCorner(v.x, v.width, "viewport.x");
  requireCorner(v.y, v.height, "viewport.y");
  requireCorner(v.pixelCenter - 0.5, std::min(v.width, v.height), "viewport.pixelCenter");
  requireNumber(v.depthFirst, "viewport.depthRange");
  requireNumber(v.depthSecond, "viewport.depthRange");
  if (v.depthFirst == v.depthSecond) throw CameraError("viewport.depthRange", "must span more than one value");
}

Viewport cropped(const Viewport& viewport, const Crop& crop) {
  validate(viewport);
  requirePositive(crop.width, "viewport.crop.width");
  requirePositive(crop.height, "viewport.crop.height");
  requireNumber(crop.x, "viewport.crop.x");
  requireNumber(crop.y, "viewport.crop.y");
  Viewport tile = viewport;
  tile.width = crop.width;
  tile.height = crop.height;
  return tile;
}

PictureCorners pictureCorners(const Viewport& viewport) noexcept {
  const ScreenCorner corner = screenCorner(viewport);
  const Vec2 first{corner.x.hi, corner.y.hi};
  return {first, {first.x + viewport.width, first.y + viewport.height}};
}

}  // namespace viewproj
