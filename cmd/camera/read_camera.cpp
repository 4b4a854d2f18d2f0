#include "camera/read_camera.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "camera/check.hpp"
#include "camera/read_pose.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/cameras_of.hpp"

namespace viewproj::cmd {
namespace {

double numberOr(const Node& object, std::string_view key, double fallback) {
  const auto value = object.find(key);
  return value ? value->number() : fallback;
}

/// The picture, and the tile of it that the camera has.
struct Picture {
  Viewport frame;
  std::optional<Crop> crop;
};

/// pixels: the picture's size if the viewport does not state it.
std::optional<Picture> readViewport(const Node& root, double pixelCenter, const std::optional<Vec2>& pixels) {
  const auto viewport = root.find("viewport");
  if (!viewport && !pixels) return std::nullopt;
  Picture picture;
  Viewport& v = picture.frame;
  v.pixelCenter = pixelCenter;
  if (pixels) {
    v.width = pixels->x;
    v.height = pixels->y;
  }
  if (!viewport) return picture;
  for (const auto& [key, side] : {std::pair("width", &v.width), std::pair("height", &v.height)})
    *side = pixels ? numberOr(*viewport, key, *side) : viewport->require(key).number();
  v.x = numberOr(*viewport, "x", 0);
  v.y = numberOr(*viewport, "y", 0);
  v.pixelCenter = numberOr(*viewport, "pixelCenter", pixelCenter);
  if (const auto origin = viewport->find("origin")) v.origin = valueOf(kOriginNames, origin->text());
  if (const auto range = viewport->find("depthRange")) {
    v.depthFirst = range->numbers(2)[0];
    v.depthSecond = range->numbers(2)[1];
  }
  if (const auto crop = viewport->find("crop"))
    picture.crop = Crop{crop->require("x").number(), crop->require("y").number(), crop->require("width").number(),
                        crop->require("height").number()};
  return picture;
}

void requireShape(double aspect, const Viewport& viewport, const Node& at, const ReadOptions& reading,
                  const std::string& fix) {
  if (reading.allowStretch || hasShape(viewport, aspect)) return;
  at.fail("the aspect is " + formatDigits(aspect, 6) + ", but the viewport's is " +
          formatDigits(viewport.width / viewport.height, 6) + "; " + fix + " or give --allow-stretch");
}

/// Reads the fields of a projection.
struct LensReader {
  const Document& document;
  Node fields;
  std::optional<Picture> picture;
  const DocumentConvention& convention;
  const ReadOptions& reading;
  double near, far;

  std::optional<double> find(std::string_view key) const {
    const auto value = fields.find(key);
    return value ? std::optional(value->number()) : std::nullopt;
  }
  double require(std::string_view key) const { return fields.require(key).number(); }

  void requireNear(std::string_view why) const {
    if (near == 0) fields.fail("needs near" + std::string(why));
  }

  const Viewport& viewport(const char* why) const {
    if (!picture) fields.fail("needs a viewport" + std::string(why) + "; --viewport WIDTHxHEIGHT gives one");
    return picture->frame;
  }

  Aspect aspect() const {
    const auto stated = fields.find("aspect");
    return stated ? ratioOf(*stated) : Aspect(viewport(" or an aspect"));
  }

  void requireNoAspect(bool follows, const char* from) const {
    const auto stated = fields.find("aspect");
    if (stated && follows) stated->fail(std::string("follows from ") + from + "; leave one of the three out");
  }

  Projection perspective() const {
    for (const auto& [key, of] :
         {std::pair("fovY", Fov::vertical), {"fovX", Fov::horizontal}, {"fovDiagonal", Fov::diagonal}})
      if (const auto angle = fields.find(key)) return viewproj::perspective(angleOf(*angle), aspect(), near, far, of);
    if (fields.find("nearWidth") || fields.find("nearHeight")) {
      requireNear(" for a window on it");
      const double width = require("nearWidth"), height = require("nearHeight");
      return perspectiveNearSize(width, height, near, far);
    }
    if (!fields.find("focalLength") && !fields.find("sensorWidth") && !fields.find("sensorHeight"))
      fields.fail("needs one of fovY, fovX, fovDiagonal, nearWidth with nearHeight, focalLength with a sensor's side");
    const double focalLength = require("focalLength");
    const auto width = find("sensorWidth"), height = find("sensorHeight");
    if (!width && !height) fields.fail("needs sensorWidth or sensorHeight beside focalLength");
    requireNoAspect(width && height, "sensorWidth and sensorHeight");
    return perspectiveFocalLength(focalLength, width.value_or(0), height.value_or(0),
                                  width && height ? Aspect(1) : aspect(), near, far);
  }

  /// Braces evaluate the calls in this order.
  std::array<double, 4> edges() const { return {require("left"), require("right"), require("bottom"), require("top")}; }

  Projection frustum() const {
    requireNear("");
    const auto [left, right, bottom, top] = edges();
    return viewproj::frustum(left, right, bottom, top, near, far);
  }

  Projection orthographic() const {
    if (!fields.find("near")) fields.fail("needs near");
    if (!fields.find("far")) fields.fail("needs far");
    const auto width = find("width"), height = find("height");
    if (width && height) {
      requireNoAspect(true, "width and height");
      return viewproj::orthographic(-*width / 2, *width / 2, -*height / 2, *height / 2, near, far);
    }
    if (height) return orthographicHeight(*height, aspect(), near, far);
    if (width) return orthographicWidth(*width, aspect(), near, far);
    if (!fields.find("left") && !fields.find("right") && !fields.find("bottom") && !fields.find("top"))
      fields.fail("needs left, right, bottom and top, or width or height");
    const auto [left, right, bottom, top] = edges();
    return viewproj::orthographic(left, right, bottom, top, near, far);
  }

  /// fx, fy, cx, cy count pixels of a picture with the viewport's corners.
  Projection intrinsics() const {
    const double fx = require("fx"), fy = require("fy"), cx = require("cx"), cy = require("cy");
    if (!picture && !reading.needsPicture) return perspectiveWindow(-1, 1, -1, 1, near, far);
    Viewport frame = viewport(", whose pixels fx, fy, cx, cy count");
    if (const auto pixels = fields.find("pixels")) {
      const std::vector<double> size = pixels->numbers(2);
      requireShape(size[0] / size[1], frame, *pixels, reading, "crop one of the pictures");
      // Converts the corner to the scale of these pixels: cx' = (cx - c + 0.5) W/w + c - 0.5, with c the pixel centre.
      frame.x *= size[0] / frame.width;
      frame.y *= size[1] / frame.height;
      frame.width = size[0];
      frame.height = size[1];
    }
    return viewproj::intrinsics(fx, fy, cx, cy, frame, near, far);
  }

  /// x = cx + ax scrz X/Z, y = cy + ay scrz Y/Z, in a picture around (cx, cy).
  Projection ps2() const {
    requireNear("");
    const double scrz = require("scrz"), ax = require("ax"), ay = require("ay"), cx = require("cx"), cy = require("cy");
    return viewproj::intrinsics(ax * scrz, ay * scrz, cx, cy, viewport(" around cx, cy"), near, far);
  }

  Projection matrix() const {
    const Node value = fields.require("matrix");
    if (!convention.isStated)
      value.fail("needs a convention; state it, or give --read-as NAME (viewproj info lists those that fit)");
    const Convention& c = convention.convention;
    // Rows of 4 are the matrix as written; 16 numbers are in memory order.
    const bool isStored = value.size() == 16 && c.storage == Storage::columnMajor;
    const bool isTransposed = isStored != (c.vectors == Vectors::row);
    const MatrixCameras found = camerasOf(isTransposed ? transposed(value.mat4()) : value.mat4(),
                                          {.kind = MatrixKind::projection, .convention = c});
    if (found.cameras.empty()) value.fail("is not a projection matrix of this convention: " + found.fault);
    const MatrixLens& lens = *found.cameras.front().lens;
    if (!lens.projection) value.fail("does not determine near and far");
    return *lens.projection;
  }
};

/// The types whose window may have another shape than the viewport.
bool hasOwnPixelShape(std::uint8_t type) { return type == kIntrinsics || type == kPs2; }

Projection readProjection(const LensReader& lens, std::uint8_t type) {
  const Projection read = type == kPerspective    ? lens.perspective()
                          : type == kFrustum      ? lens.frustum()
                          : type == kIntrinsics   ? lens.intrinsics()
                          : type == kOrthographic ? lens.orthographic()
                          : type == kPs2          ? lens.ps2()
                                                  : lens.matrix();
  if (lens.picture && !hasOwnPixelShape(type)) {
    const auto aspect = lens.fields.find("aspect");
    requireShape(read.aspect(), lens.picture->frame, aspect ? *aspect : lens.fields, lens.reading,
                 aspect ? "leave it out, change it by --aspect," : "change one of them");
  }
  const auto shift = lens.fields.find("shift");
  return shift ? shifted(read, shift->numbers(2)[0], shift->numbers(2)[1]) : read;
}

double readFar(const Node& projection) {
  const auto far = projection.find("far");
  return far && far->json().is_number() ? far->number() : kInfiniteFar;
}

/// Notes angles in degrees that look like radians: half a turn is 3.14 radians, and few lenses see less than 3 degrees.
void noteRadians(const Node& projection, std::vector<std::string>& notes) {
  for (const char* key : {"fovY", "fovX", "fovDiagonal"}) {
    const auto angle = projection.find(key);
    if (!angle || !angle->json().is_number() || !(angle->number() >= 0.05 && angle->number() < 3.2)) continue;
    notes.push_back(angle->place().first + ": is " + formatNumber(angle->number()) + " degrees; \"" +
                    formatNumber(angle->number()) + "rad\" would be " +
                    formatDigits(angle->number() * 180 / std::numbers::pi, 6) + " degrees");
  }
}

/// The coefficients of a member. Missing ones are 0.
template <std::size_t Count>
std::array<double, Count> coefficients(const Node& distortion, std::string_view key) {
  std::array<double, Count> all{};
  const auto member = distortion.find(key);
  if (!member || member->size() == 0) return all;
  const std::vector<double> numbers = member->numbers();
  std::copy(numbers.begin(), numbers.end(), all.begin());
  return all;
}

Lens readLens(const Node& distortion) {
  const auto limit = distortion.find("limit");
  if (distortion.require("model").text() == "fisheye")
    return fisheyeLens(coefficients<4>(distortion, "k"), limit ? limit->require("degrees").number() : kInfiniteFar);
  return brownLens(coefficients<6>(distortion, "k"), coefficients<2>(distortion, "p"),
                   limit ? limit->require("radius").number() : kInfiniteFar);
}

CameraFile readChecked(const Document& document, const ReadOptions& reading) {
  const Node root(document);
  CameraFile file;
  file.name = document.name;
  file.isTyped = document.isTyped;
  file.document = document;
  file.reading = reading;
  const DocumentConvention stated = readConvention(document);
  file.convention = stated.convention;
  file.statesConvention = stated.isStated;
  const bool isPresetsWorld = stated.preset->convention.world == stated.convention.world;
  file.cameraAxes = isPresetsWorld                               ? stated.preset->cameraAxes
                    : file.convention.world == Handedness::right ? CameraAxes::RUB
                                                                 : CameraAxes::RUF;
  file.worldIsEcef = worldIsEcef(document);
  if (file.worldIsEcef && file.convention.world == Handedness::left)
    root.fail(
        "the convention's world is left-handed, but Earth-centred coordinates are right-handed; --convention says "
        "how to write");
  file.pose = readPose(document);
  if (const auto target = Node(document).find("target"); target && file.pose) {
    const Vec3 eye = file.pose->eye(), at = positionOf(*target);
    file.targetDistance = std::hypot(at.x - eye.x, at.y - eye.y, at.z - eye.z);
  }
  const auto projection = root.find("projection");
  const std::uint8_t type = projection ? valueOf(kTypeNames, projection->require("type").text()) : 0;
  std::optional<Vec2> pixels;
  if (projection)
    if (const auto size = projection->find("pixels")) pixels = Vec2{size->numbers(2)[0], size->numbers(2)[1]};
  auto picture = readViewport(root, stated.preset->pixelCenter, pixels);
  if (type == kPs2) {
    if (!file.convention.reverseZ) root.fail("a ps2 projection is reversed, but the convention has reverseZ false");
    if (picture) {
      for (const char* key : {"viewport.x", "viewport.y", "viewport.depthRange"})
        if (const Json* const value = valueAt(*document.root, key))
          Node(document, *value, key).fail("follows from cx, cy, zMin and zMax of the ps2 projection; leave it out");
      Viewport& v = picture->frame;
      v.x = projection->require("cx").number() - v.width / 2;
      v.y = projection->require("cy").number() - v.height / 2;
      v.depthFirst = projection->require("zMin").number();
      v.depthSecond = projection->require("zMax").number();
    }
  }
  if (projection) {
    const auto near = projection->find("near");
    if (near && type != kOrthographic && !(near->number() > 0)) near->fail("expected a number above 0");
    file.projection = readProjection(
        {document, *projection, picture, stated, reading, near ? near->number() : 0, readFar(*projection)}, type);
    noteRadians(*projection, file.notes);
  }
  if (picture && picture->crop) {
    if (file.projection) file.projection = cropped(*file.projection, picture->frame, *picture->crop);
    picture->frame = cropped(picture->frame, *picture->crop);
  }
  if (picture) file.viewport = picture->frame;
  if (const auto distortion = root.find("distortion")) {
    if (type == kOrthographic) distortion->fail("goes with a perspective, not with an orthographic projection");
    file.lens = readLens(*distortion);
  }
  (void)cameraIn(file.convention, file.pose, file.projection,
                 file.viewport);  // throws if the parts do not fit together
  return file;
}

/// The value in the document that an error of the library is about.
Node nodeOf(const Document& document, const std::string& field) {
  for (const std::string& path : {field, "projection." + field, "viewport." + field})
    if (const Json* value = valueAt(*document.root, path)) return {document, *value, path};
  if (field == "rotation" || field == "columns")
    for (const char* path : {"euler", "worldFromCamera", "cameraFromWorld"})
      if (const Json* value = valueAt(*document.root, path)) return {document, *value, path};
  return Node(document, *document.root, "");
}

}  // namespace

DocumentConvention readConvention(const Document& document) {
  const Node root(document);
  const Json* const type = valueAt(*document.root, "projection.type");
  DocumentConvention result{type && *type == "ps2" ? &conventions::ps2 : &conventions::opengl, {}, false};
  const auto fields = root.find("convention");
  result.isStated = fields && !fields->json().empty();
  if (fields)
    if (const auto preset = fields->find("preset")) result.preset = findPreset(preset->text());
  Convention& c = result.convention = result.preset->convention;
  if (!fields) return result;
  const auto read = [&](const char* key, const auto& names, auto& axis) {
    if (const auto value = fields->find(key)) axis = valueOf(names, value->text());
  };
  read("world", kWorldNames, c.world);
  read("view", kViewNames, c.view);
  read("ndcZ", kNdcZNames, c.ndcZ);
  read("ndcY", kNdcYNames, c.ndcY);
  read("vectors", kVectorsNames, c.vectors);
  read("storage", kStorageNames, c.storage);
  if (const auto value = fields->find("reverseZ")) c.reverseZ = value->flag();
  return result;
}

namespace {

CameraFile readNormalized(const Document& document, const ReadOptions& reading) {
  check(document);
  try {
    return readChecked(document, reading);
  } catch (const CameraError& e) {
    const Node at = nodeOf(document, e.field());
    at.fail((at.path().empty() ? e.field() + ": " : "") + e.message());
  }
}

/// The largest shift of pixels by the lens. Nothing if the lens is not known, or a part of the camera is missing.
std::optional<double> lensShift(const Document& document, const ReadOptions& reading) {
  try {
    const CameraFile file = readNormalized(document, reading);
    return file.lens ? largestShift(makeCamera(file)) : 0;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace

CameraFile readCamera(Document document, const ReadOptions& reading) {
  normalize(document);
  if (!reading.ignoreDistortion || !valueAt(*document.root, "distortion")) return readNormalized(document, reading);
  const std::optional<double> shift = lensShift(document, reading);
  document.root = std::make_shared<Json>(*document.root);
  document.root->erase("distortion");
  CameraFile file = readNormalized(document, reading);
  if (!shift || *shift != 0)
    file.notes.push_back(file.name + ": the lens distortion is ignored" +
                         (shift ? ", up to " + formatDigits(*shift, 3) + " pixels" : ""));
  return file;
}

bool hasShape(const Viewport& viewport, double aspect) {
  const double picture = viewport.width / viewport.height;
  return std::fabs(aspect - picture) <= 1e-3 * picture;
}

void requireNear(const CameraFile& file, const std::string& what) {
  if (!file.projection || hasDepth(*file.projection)) return;
  const std::string message = what + " needs near, which " + file.name + " does not have; --near gives it";
  if (file.isTyped) throw UsageError(message);
  throw InputError(message);
}

void requireStraightEdges(const CameraFile& file, const std::string& what) {
  if (file.lens)
    throw InputError(what + " needs straight edges, which the lens of " + file.name +
                     " bends; --ignore-distortion ignores its distortion");
}

Camera makeCamera(const CameraFile& file) {
  const auto require = [&](bool good, const char* part) {
    const std::string message = file.name + ": the camera has no " + part;
    if (!good && file.isTyped) throw UsageError(message);
    if (!good) throw InputError(message);
  };
  require(file.pose.has_value(), "pose; give a position with a target, a direction or a rotation");
  require(file.projection.has_value(), "projection");
  require(file.viewport.has_value(), "viewport; --viewport WIDTHxHEIGHT gives one");
  const Camera camera = makeCamera(*file.pose, *file.projection, *file.viewport, file.convention);
  return file.lens ? withLens(camera, *file.lens) : camera;
}

Camera cameraIn(Convention convention, const std::optional<Pose>& pose, const std::optional<Projection>& projection,
                const std::optional<Viewport>& viewport) {
  if (pose) convention.world = pose->world();
  return makeCamera(pose ? *pose : lookAlong({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, convention.world),
                    projection ? *projection : orthographic(-1, 1, -1, 1, 0, 1), viewport.value_or(Viewport{1, 1}),
                    convention);
}

}  // namespace viewproj::cmd
