#include "viewproj/camera/viewport.hpp"

#include "viewproj/camera/error.hpp"

namespace viewproj {
void validate(const Viewport& v) {
  requirePositive(v.width, "viewport.width");
  requirePositive(v.height, "viewport.height");
  requireFinite(v.x, "viewport.x");
  requireFinite(v.y, "viewport.y");
  requireFinite(v.pixelCenter, "viewport.pixelCenter");
  requireFinite(v.depthFirst, "viewport.depthRange");
  requireFinite(v.depthSecond, "viewport.depthRange");
  if (v.depthFirst == v.depthSecond) throw CameraError("viewport.depthRange", "must span more than one value");
}

Viewport cropped(const Viewport& viewport, const Crop& crop) {
  validate(viewport);
  requirePositive(crop.width, "viewport.crop.width");
  requirePositive(crop.height, "viewport.crop.height");
  requireFinite(crop.x, "viewport.crop.x");
  requireFinite(crop.y, "viewport.crop.y");
  Viewport tile = viewport;
  tile.width = crop.width;
  tile.height = crop.height;
  tile.x = tile.y = 0;
  return tile;
}

}  // namespace viewproj
