#include "input/viewport_fields.hpp"

#include <cmath>

#include "input/convention_names.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {
namespace {

/// Shapes that differ by no more than this share are one.
constexpr double kAspectTolerance = 1e-3;

}  // namespace

std::optional<ReadViewport> readViewport(const ObjectReader& file, const ViewportDefaults& defaults) {
  const auto fields = file.object("viewport");
  Viewport v;
  v.pixelCenter = defaults.pixelCenter;
  if (!fields) {
    if (!defaults.width || !defaults.height) return std::nullopt;
    v.width = *defaults.width;
    v.height = *defaults.height;
    validate(v);
    return ReadViewport{v, std::nullopt};
  }
  fields->allow({"width", "height", "x", "y", "depthRange", "origin", "pixelCenter", "crop"});
  v.width = fields->has("width") || !defaults.width ? fields->requireNumber("width") : *defaults.width;
  v.height = fields->has("height") || !defaults.height ? fields->requireNumber("height") : *defaults.height;
  v.x = fields->numberOr("x", 0);
  v.y = fields->numberOr("y", 0);
  v.pixelCenter = fields->numberOr("pixelCenter", defaults.pixelCenter);
  v.origin = fields->choice("origin", kOriginNames).value_or(Origin::topLeft);
  if (const auto range = fields->numbers("depthRange", 2, 2)) {
    v.depthFirst = (*range)[0];
    v.depthSecond = (*range)[1];
  }
  std::optional<Crop> crop;
  if (const auto tile = fields->object("crop")) {
    tile->allow({"x", "y", "width", "height"});
    crop = Crop{tile->requireNumber("x"), tile->requireNumber("y"), tile->requireNumber("width"),
                tile->requireNumber("height")};
  }
  validate(v);
  const ReadViewport read{v, crop};
  validate(read.tile());
  return read;
}

Viewport ReadViewport::tile() const {
  if (!crop) return frame;
  Viewport tile = cropped(frame, *crop);
  tile.x = frame.x;
  tile.y = frame.y;
  return tile;
}

DoubleDouble viewportAspect(const Viewport& viewport) {
  return DoubleDouble(viewport.width) / DoubleDouble(viewport.height);
}

bool hasShape(const Viewport& viewport, DoubleDouble shape) {
  const double picture = viewportAspect(viewport).hi;
  return std::fabs(shape.hi - picture) <= kAspectTolerance * picture;
}

void requireShape(DoubleDouble shape, const Viewport& viewport, const ObjectReader& projection,
                  const std::string& mend) {
  if (hasShape(viewport, shape)) return;
  projection.fail("is " + formatNumber(shape.hi) + " times as wide as high, but the viewport " +
                  formatNumber(viewportAspect(viewport).hi) + " times; change one of them, " + mend +
                  "or give --allow-stretch");
}

}  // namespace viewproj::cmd
