#include "input/viewport_fields.hpp"

#include <cmath>

#include "camera/camera.hpp"
#include "camera/viewport.hpp"
#include "input/camera_fields.hpp"
#include "input/value_form.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// Shapes that differ by no more than this share are one.
constexpr double kAspectTolerance = 1e-3;

}  // namespace

std::optional<ReadViewport> readViewport(const ObjectReader& file, const ViewportDefaults& defaults) {
  Viewport v;
  v.pixelCenter = defaults.pixelCenter;
  if (file.isArray(field::viewport)) {
    const auto numbers = coordinatesIn(*file.find(field::viewport), 4, 4);
    if (!numbers) file.fail(field::viewport, "expected an object or [x, y, width, height]");
    v.x = (*numbers)[0];
    v.y = (*numbers)[1];
    v.width = (*numbers)[2];
    v.height = (*numbers)[3];
    validate(v);
    return ReadViewport{v, std::nullopt};
  }
  const auto fields = file.object(field::viewport);
  if (!fields) {
    if (!defaults.width || !defaults.height) return std::nullopt;
    v.width = *defaults.width;
    v.height = *defaults.height;
    validate(v);
    return ReadViewport{v, std::nullopt};
  }
  fields->allow(field::picture);
  const auto size = [&](const Field& field, std::optional<double> fallback) {
    return fields->has(field) || !fallback ? fields->requireNumber(field) : *fallback;
  };
  v.width = size(field::pixelWidth, defaults.width);
  v.height = size(field::pixelHeight, defaults.height);
  v.x = fields->numberOr(field::x, 0);
  v.y = fields->numberOr(field::y, 0);
  v.pixelCenter = fields->numberOr(field::pixelCenter, defaults.pixelCenter);
  v.origin = fields->choice(field::origin, kOriginNames).value_or(Origin::topLeft);
  if (const auto range = fields->numbers(field::depthRange, 2, 2)) {
    v.depthFirst = (*range)[0];
    v.depthSecond = (*range)[1];
  }
  std::optional<Crop> crop;
  if (const auto tile = fields->object(field::crop)) {
    tile->allow(field::tile);
    crop = Crop{tile->requireNumber(field::cropX), tile->requireNumber(field::cropY),
                tile->requireNumber(field::cropWidth), tile->requireNumber(field::cropHeight)};
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
