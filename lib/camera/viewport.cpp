#include "camera/viewport.hpp"

#include <algorithm>
#include <cmath>

#include "camera/require.hpp"
#include "camera/screen_corner.hpp"

namespace viewproj {

using namespace detail;
namespace {

void requireSize(double value, const char* field) {
  requirePositive(value, field);
  if (!(value > kSmallestWindow && value < kLargestWindow))
    throw CameraError(field, "must be between 1.2e-271 and 8.4e270");
}

void requirePlace(double value, const char* field) {
  requireFinite(value, field);
  if (!(std::fabs(value) < kLargestWindow)) throw CameraError(field, "must be between -8.4e270 and 8.4e270");
}

/// So far away, positions in the picture would have lost too many digits.
void requireCorner(double value, double size, const char* field) {
  requirePlace(value, field);
  if (!(std::fabs(value) <= kLargestCorner * size))
    throw CameraError(field, "is more than 1.1e12 times the viewport's size away");
}

}  // namespace

void detail::validate(const Viewport& v) {
  requireSize(v.width, "viewport.width");
  requireSize(v.height, "viewport.height");
  requireCorner(v.x, v.width, "viewport.x");
  requireCorner(v.y, v.height, "viewport.y");
  requireCorner(v.pixelCenter - 0.5, std::min(v.width, v.height), "viewport.pixelCenter");
  requirePlace(v.depthFirst, "viewport.depthRange");
  requirePlace(v.depthSecond, "viewport.depthRange");
  if (v.depthFirst == v.depthSecond) throw CameraError("viewport.depthRange", "must span more than one value");
  if (!(std::fabs(v.depthSecond - v.depthFirst) > kSmallestWindow))
    throw CameraError("viewport.depthRange", "must span more than 1.2e-271");
}

Viewport cropped(const Viewport& viewport, const Crop& crop) {
  validate(viewport);
  requireSize(crop.width, "viewport.crop.width");
  requireSize(crop.height, "viewport.crop.height");
  requirePlace(crop.x, "viewport.crop.x");
  requirePlace(crop.y, "viewport.crop.y");
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
