#include "camera/read_projection.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/read_screen.hpp"
#include "text/number.hpp"
#include "viewproj/cameras_of.hpp"

namespace viewproj::cmd {
namespace {

/// Puts the field's value in place of a number, if the document has the field.
void read(const FieldValues& values, FieldId field, double& number) { number = values.valueOr(field, number); }

void requireShape(const FieldValues& values, double aspect, const Viewport& viewport, std::string_view at,
                  const ReadOptions& options, const std::string& fix) {
  if (options.allowStretch || !options.needsPicture || hasShape(viewport, aspect)) return;
  values.failAt(at, "the aspect is " + formatDigits(aspect, 6) + ", but the viewport's is " +
                        formatDigits(viewport.width / viewport.height, 6) + "; " + fix + "give --allow-stretch");
}

/// One function for each type of projection.
struct ProjectionReader {
  const FieldValues& values;
  const DocumentConvention& convention;
  const std::optional<PictureFrame>& picture;
  const ReadOptions& options;
  double near = 0, far = kInfiniteFar;

  [[noreturn]] void fail(const std::string& message) const { values.failAt("projection", message); }
  bool has(FieldId field) const { return values.has(field); }
  double number(FieldId field) const { return values.require<double>(field); }

  void requireNear(const std::string& why) const {
    if (near == 0) fail("needs near" + why);
  }

  const Viewport& viewport(const std::string& why) const {
    static constexpr Viewport kAny{.width = 1, .height = 1};
    if (!picture && !options.needsPicture) return kAny;
    if (!picture) fail("needs a viewport" + why + "; --viewport WIDTHxHEIGHT gives one");
    return picture->frame;
  }

  Aspect aspect() const {
    const auto* const stated = values.find<Aspect>("projection.aspect");
    return stated ? *stated : Aspect(viewport(" or an aspect"));
  }

  void requireNoAspect(const std::string& from) const {
    if (has("projection.aspect"))
      values.fail("projection.aspect", "follows from " + from + "; leave one of the three out");
  }

  Projection perspective() const {
    for (const auto& [field, of] : {std::pair(FieldId("projection.fovY"), Fov::vertical),
                                    {FieldId("projection.fovX"), Fov::horizontal},
                                    {FieldId("projection.fovDiagonal"), Fov::diagonal}})
      if (const auto* const angle = values.find<Angle>(field))
        return viewproj::perspective(*angle, aspect(), near, far, of);
    if (has("projection.nearWidth") || has("projection.nearHeight")) {
      requireNear(" for a window on it");
      const double right = number("projection.nearWidth") / 2, top = number("projection.nearHeight") / 2;
      return viewproj::frustum(-right, right, -top, top, near, far);
    }
    const FieldId width = "projection.sensorWidth", height = "projection.sensorHeight";
    const FieldId side = has(width) ? width : has(height) ? height : FieldId("projection.sensorDiagonal");
    if (has("projection.focalLength") || has(side)) return ofSensor(side);
    fail("needs one of fovY, fovX, fovDiagonal, nearWidth with nearHeight, focalLength with a sensor's side");
  }

  /// side: a side that the sensor has, if it has one.
  Projection ofSensor(FieldId side) const {
    if (!has("projection.focalLength")) values.fail(side, "needs focalLength beside it");
    if (!has(side))
      values.fail("projection.focalLength", "needs sensorWidth, sensorHeight or sensorDiagonal beside it");
    const SensorSize sensor{values.valueOr("projection.sensorWidth", 0.0),
                            values.valueOr("projection.sensorHeight", 0.0),
                            values.valueOr("projection.sensorDiagonal", 0.0)};
    const bool isWhole = sensor.width > 0 && sensor.height > 0;
    if (isWhole) requireNoAspect("sensorWidth and sensorHeight");
    return perspectiveFocalLength(number("projection.focalLength"), sensor, isWhole ? Aspect(1) : aspect(), near, far);
  }

  /// left, right, bottom, top. Braces evaluate the calls in this order.
  std::array<double, 4> edges() const {
    return {number("projection.left"), number("projection.right"), number("projection.bottom"),
            number("projection.top")};
  }

  Projection frustum() const {
    requireNear("");
    const auto [left, right, bottom, top] = edges();
    return viewproj::frustum(left, right, bottom, top, near, far);
  }

  Projection orthographic() const {
    const bool mayLack = options.boxMayLack != BoxLack::nothing;
    const bool hasNear = has("projection.near"), hasFar = has("projection.far");
    if (!hasNear && !mayLack) fail("needs near");
    if (!hasFar && !mayLack) fail("needs far");
    const double zNear = hasNear || !hasFar ? near : far - 1, zFar = hasFar ? far : zNear + 1;
    const double width = values.valueOr("projection.width", 0.0), height = values.valueOr("projection.height", 0.0);
    if (width > 0 && height > 0) {
      requireNoAspect("width and height");
      return viewproj::orthographic(-width / 2, width / 2, -height / 2, height / 2, zNear, zFar);
    }
    if (height > 0) return orthographicHeight(height, aspect(), zNear, zFar);
    if (width > 0) return orthographicWidth(width, aspect(), zNear, zFar);
    if (!has("projection.left") && !has("projection.right") && !has("projection.bottom") && !has("projection.top")) {
      const bool hasShape = picture || has("projection.aspect");
      if (options.boxMayLack == BoxLack::sizeToo)
        return orthographicHeight(1, hasShape ? aspect() : Aspect(1), zNear, zFar);
      fail("needs left, right, bottom and top, or width or height");
    }
    const auto [left, right, bottom, top] = edges();
    return viewproj::orthographic(left, right, bottom, top, zNear, zFar);
  }

  /// fx, fy, cx, cy count pixels of a picture with the viewport's corners. Without cx, cy the viewing axis meets its
  /// middle.
  Projection intrinsics() const {
    const double fx = number("projection.fx"), fy = values.valueOr("projection.fy", fx);
    const Viewport& frame = viewport(", whose pixels fx, fy, cx, cy count");
    if (const auto* const size = values.find<Vec2>("projection.pixels"))
      requireShape(values, size->x / size->y, frame, "projection.pixels", options, "crop one of the pictures or ");
    const Viewport whole = pictureOfIntrinsics(values, frame);
    const Vec2 pixels{whole.width, whole.height};
    const double cx = values.valueOr("projection.cx", whole.x + (whole.width - 1) / 2 + whole.pixelCenter);
    const double cy = values.valueOr("projection.cy", whole.y + (whole.height - 1) / 2 + whole.pixelCenter);
    return viewproj::intrinsics(fx, fy, cx, cy, pixels, frame, near, far);
  }

  /// x = cx + ax scrz X/Z, y = cy + ay scrz Y/Z, in a picture around (cx, cy).
  Projection ps2() const {
    requireNear("");
    const double scrz = number("projection.scrz"), ax = number("projection.ax"), ay = number("projection.ay");
    const double cx = number("projection.cx"), cy = number("projection.cy");
    return ps2Intrinsics(scrz, ax, ay, cx, cy, viewport(" around cx, cy"), near, far);
  }

  Projection screen() const {
    const ScreenView view = readScreen(values, convention.convention.world);
    return perspectiveWindow(view.left, view.right, view.bottom, view.top, near, far);
  }

  Projection ofType(std::uint8_t type) const {
    switch (type) {
      case kPerspective:
        return perspective();
      case kFrustum:
        return frustum();
      case kIntrinsics:
        return intrinsics();
      case kOrthographic:
        return orthographic();
      case kPs2:
        return ps2();
      case kScreen:
        return screen();
      default:
        return readProjectionMatrix(values, convention);
    }
  }
};

/// A ps2 projection sets the viewport's corner and depth range.
void placePs2(const FieldValues& values, const DocumentConvention& convention, std::optional<PictureFrame>& picture) {
  if (!convention.convention.reverseZ)
    values.failAt("", "a ps2 projection is reversed, but the convention has reverseZ false");
  if (!picture) return;
  for (const FieldId field : {FieldId("viewport.x"), FieldId("viewport.y"), FieldId("viewport.depthRange")})
    if (values.has(field)) values.fail(field, "follows from cx, cy, zMin and zMax of the ps2 projection; leave it out");
  Viewport& v = picture->frame;
  v.x = values.require<double>("projection.cx") - v.width / 2;
  v.y = values.require<double>("projection.cy") - v.height / 2;
  v.depthFirst = values.require<double>("projection.zMin");
  v.depthSecond = values.require<double>("projection.zMax");
}

}  // namespace

std::uint8_t typeOf(const FieldValues& values) {
  const auto* const type = values.find<std::string_view>("projection.type");
  return type ? valueOf(kTypeNames, *type) : 0;
}

std::optional<PictureFrame> readPicture(const FieldValues& values, const DocumentConvention& convention,
                                        const ReadOptions& options) {
  const bool isStated = valueAt(*values.document().root, "viewport") != nullptr;
  const auto* const pixels = values.find<Vec2>("projection.pixels");
  const bool mayBeAny = options.sizeMayLack && typeOf(values) == kIntrinsics && values.has("projection.cx") &&
                        values.has("projection.cy") && !values.has("viewport.width") &&
                        !values.has("viewport.height") && !values.has("projection.shift");
  const auto side = [&](FieldId field, FieldId center) {
    if (mayBeAny) return std::max(1.0, 2 * values.require<double>(center));
    return options.needsPicture ? values.require<double>(field) : 1;
  };
  std::optional<PictureFrame> picture;
  if (isStated || pixels || mayBeAny) {
    picture.emplace().isSizeAssumed = mayBeAny && !pixels;
    Viewport& v = picture->frame;
    v.width = pixels ? pixels->x : side("viewport.width", "projection.cx");
    v.height = pixels ? pixels->y : side("viewport.height", "projection.cy");
    v.pixelCenter = convention.preset->pixelCenter;
    read(values, "viewport.width", v.width);
    read(values, "viewport.height", v.height);
    read(values, "viewport.x", v.x);
    read(values, "viewport.y", v.y);
    read(values, "viewport.pixelCenter", v.pixelCenter);
    if (const auto* const origin = values.find<std::string_view>("viewport.origin"))
      v.origin = valueOf(kOriginNames, *origin);
    const Vec2 range = values.valueOr("viewport.depthRange", Vec2{v.depthFirst, v.depthSecond});
    v.depthFirst = range.x;
    v.depthSecond = range.y;
    if (valueAt(*values.document().root, "viewport.crop"))
      picture->crop =
          Crop{values.require<double>("viewport.crop.x"), values.require<double>("viewport.crop.y"),
               values.require<double>("viewport.crop.width"), values.require<double>("viewport.crop.height")};
    constexpr double kLeast = 1e-6;
    if (const auto& c = picture->crop; c && !(c->x >= -kLeast && c->x + c->width <= v.width + kLeast &&
                                              c->y >= -kLeast && c->y + c->height <= v.height + kLeast))
      values.fail("viewport.crop.width", "reaches out of the picture of " + formatNumber(v.width) + "x" +
                                             formatNumber(v.height) + ", the viewport's, in whose pixels it is");
  }
  if (typeOf(values) == kPs2) placePs2(values, convention, picture);
  return picture;
}

Viewport pictureOfIntrinsics(const FieldValues& values, Viewport frame) {
  const auto* const size = values.find<Vec2>("projection.pixels");
  if (!size) return frame;
  // Converts the corner to the scale of these pixels: cx' = (cx - c + 0.5) W/w + c - 0.5, with c the pixel centre.
  frame.x *= size->x / frame.width;
  frame.y *= size->y / frame.height;
  frame.width = size->x;
  frame.height = size->y;
  return frame;
}

std::optional<Projection> readProjection(const FieldValues& values, const DocumentConvention& convention,
                                         const std::optional<PictureFrame>& picture, const ReadOptions& options) {
  const std::uint8_t type = typeOf(values);
  if (type == 0) return std::nullopt;
  ProjectionReader reader{values, convention, picture, options};
  read(values, "projection.near", reader.near);
  read(values, "projection.far", reader.far);
  if (values.has("projection.near") && type != kOrthographic && !(reader.near > 0))
    values.fail("projection.near", "expected a number above 0");
  const Projection projection = reader.ofType(type);
  // A window in pixels may have another shape than the viewport.
  if (picture && type != kIntrinsics && type != kPs2) {
    const bool isStated = values.has("projection.aspect");
    const auto label = values.document().labels.find("projection.aspect");
    const bool isOfOther = label != values.document().labels.end() && !label->second.starts_with("--");
    requireShape(values, projection.aspect(), picture->frame, isStated ? "projection.aspect" : "projection", options,
                 isOfOther  ? "where its pixels are not square, "
                 : isStated ? "change it by --aspect or "
                            : "change one of them or ");
  }
  const auto* const shift = values.find<Vec2>("projection.shift");
  return shift ? shifted(projection, shift->x, shift->y) : projection;
}

Projection readProjectionMatrix(const FieldValues& values, const DocumentConvention& convention) {
  const auto& [rows, isStored] = values.require<MatrixNumbers>("projection.matrix");
  const Node value = values.node("projection.matrix");
  if (!convention.isStated)
    value.fail("needs a convention; state it, or give --read-as NAME (viewproj info lists those that fit)");
  const Convention& c = convention.convention;
  const bool isTransposed = (isStored && c.storage == Storage::columnMajor) != (c.vectors == Vectors::row);
  const MatrixCameras found =
      camerasOf(isTransposed ? transposed(rows) : rows, {.kind = MatrixKind::projection, .convention = c});
  if (found.cameras.empty()) value.fail("is not a projection matrix of this convention: " + found.fault);
  const MatrixLens& lens = *found.cameras.front().lens;
  if (!lens.projection) value.fail("does not determine near and far");
  const Projection& p = *lens.projection;
  double near = 0, far = kInfiniteFar;
  read(values, "projection.near", near);
  read(values, "projection.far", far);
  for (const FieldId field : {FieldId("projection.near"), FieldId("projection.far")})
    if (values.has(field) && (p.isOrthographic() || p.zNear() > 0))
      values.fail(field, "follows from the matrix; leave it out");
  return near > 0 ? perspectiveWindow(p.left(), p.right(), p.bottom(), p.top(), near, far) : p;
}

bool hasShape(const Viewport& viewport, double aspect) {
  const double picture = viewport.width / viewport.height;
  return std::fabs(aspect - picture) <= 1e-3 * picture;
}

}  // namespace viewproj::cmd
