// To add a way to describe a camera: a function here that reads its fields and ends in a Projection (or a Pose), and a
// row in kProjectionTypes (or a branch in readPose).
#include "input/camera_file.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "input/convention_fields.hpp"
#include "input/convention_names.hpp"
#include "input/error.hpp"
#include "input/geodetic.hpp"
#include "input/names.hpp"
#include "input/viewport_fields.hpp"
#include "output/number.hpp"
#include "viewproj/camera/error.hpp"

namespace viewproj::cmd {
namespace {

struct ReadProjection {
  Projection projection;
  bool hasOwnShape = false;       ///< width : height follows from the file's projection, not from the viewport
  bool hasOwnPixelShape = false;  ///< the file says itself how wide a pixel is
};

struct Context {
  const ObjectReader& fields;
  const std::optional<Viewport>& viewport;
};

double readFar(const ObjectReader& fields) { return fields.number("far").value_or(kInfiniteFar); }

DoubleDouble viewportAspect(const Viewport& v) { return DoubleDouble(v.width) / DoubleDouble(v.height); }

const Viewport& requireViewport(const Context& in, const char* why) {
  if (!in.viewport) in.fields.fail(std::string("needs a viewport ") + why + "; --viewport WIDTHxHEIGHT gives one");
  return *in.viewport;
}

ReadProjection readPerspective(Context in) {
  const ObjectReader& f = in.fields;
  f.allow({"type", "fovY", "fovX", "fovDiagonal", "nearWidth", "nearHeight", "focalLength", "sensorWidth",
           "sensorHeight", "aspect", "near", "far", "shift"});
  static constexpr std::string_view kWays[] = {"fovY", "fovX", "fovDiagonal", "nearWidth", "focalLength"};
  std::string given;
  int ways = 0;
  for (std::string_view way : kWays)
    if (f.has(way) || (way == "nearWidth" && f.has("nearHeight"))) {
      ++ways;
      given += (given.empty() ? "" : " and ") + std::string(way);
    }
  const double near = f.requireNumber("near");
  const double far = readFar(f);
  const auto ownAspect = f.number("aspect");
  const auto sensorWidth = f.number("sensorWidth");
  const auto sensorHeight = f.number("sensorHeight");
  if (ways != 1)
    f.fail((ways == 0 ? "has no opening" : "has " + given) +
           "; one of fovY, fovX, fovDiagonal, nearWidth with nearHeight, focalLength with sensorWidth or "
           "sensorHeight is expected");
  if ((sensorWidth || sensorHeight) && !f.has("focalLength"))
    f.fail(sensorWidth ? "sensorWidth" : "sensorHeight", "goes with focalLength");

  if (f.has("nearWidth") || f.has("nearHeight")) {
    if (ownAspect) f.fail("aspect", "is already given by nearWidth and nearHeight");
    return {perspectiveNearSize(f.requireNumber("nearWidth"), f.requireNumber("nearHeight"), near, far), true};
  }
  const bool bothSides = sensorWidth && sensorHeight;
  if (bothSides && ownAspect) f.fail("aspect", "is already given by sensorWidth and sensorHeight");
  if (sensorWidth && !(*sensorWidth > 0)) f.fail("sensorWidth", "must be above 0");
  if (sensorHeight && !(*sensorHeight > 0)) f.fail("sensorHeight", "must be above 0");
  const DoubleDouble aspect = bothSides   ? DoubleDouble(1)
                              : ownAspect ? DoubleDouble(*ownAspect)
                                          : viewportAspect(requireViewport(in, "or an aspect"));
  const bool ownShape = ownAspect || bothSides;
  if (const auto fov = f.number("fovY")) return {perspectiveFovY(*fov, aspect, near, far), ownShape};
  if (const auto fov = f.number("fovX")) return {perspectiveFovX(*fov, aspect, near, far), ownShape};
  if (const auto fov = f.number("fovDiagonal")) return {perspectiveFovDiagonal(*fov, aspect, near, far), ownShape};
  return {perspectiveFocalLength(f.requireNumber("focalLength"), sensorWidth.value_or(0), sensorHeight.value_or(0),
                                 aspect, near, far),
          ownShape};
}

ReadProjection readFrustum(Context in) {
  const ObjectReader& f = in.fields;
  f.allow({"type", "left", "right", "bottom", "top", "near", "far", "shift"});
  const double left = f.requireNumber("left"), right = f.requireNumber("right");
  const double bottom = f.requireNumber("bottom"), top = f.requireNumber("top");
  const double near = f.requireNumber("near");
  return {frustum(left, right, bottom, top, near, readFar(f)), true};
}

ReadProjection readOrthographic(Context in) {
  const ObjectReader& f = in.fields;
  f.allow({"type", "left", "right", "bottom", "top", "width", "height", "near", "far", "shift"});
  const auto width = f.number("width");
  const auto height = f.number("height");
  const bool hasEdges = f.has("left") || f.has("right") || f.has("bottom") || f.has("top");
  const double near = f.requireNumber("near");
  const double far = f.requireNumber("far");
  if (width || height) {
    if (hasEdges) f.fail("has both edges and a width or height; either left, right, bottom, top or width, height");
    const double w = f.requireNumber("width") / 2, h = f.requireNumber("height") / 2;
    if (!(w > 0)) f.fail("width", "must be above 0");
    if (!(h > 0)) f.fail("height", "must be above 0");
    return {orthographic(-w, w, -h, h, near, far), true};
  }
  if (!hasEdges) f.fail("needs left, right, bottom, top or width, height");
  const double left = f.requireNumber("left"), right = f.requireNumber("right");
  const double bottom = f.requireNumber("bottom"), top = f.requireNumber("top");
  return {orthographic(left, right, bottom, top, near, far), true};
}

ReadProjection readIntrinsics(Context in) {
  const ObjectReader& f = in.fields;
  f.allow({"type", "fx", "fy", "cx", "cy", "skew", "near", "far", "shift"});
  const double fx = f.requireNumber("fx"), fy = f.requireNumber("fy");
  const double cx = f.requireNumber("cx"), cy = f.requireNumber("cy");
  if (f.numberOr("skew", 0) != 0) f.fail("skew", "must be 0: pixels of a skewed grid are not modelled");
  const double near = f.requireNumber("near");
  return {intrinsics(fx, fy, cx, cy, requireViewport(in, "whose pixels fx, fy, cx, cy count"), near, readFar(f)), true,
          true};
}

/// x = cx + ax scrz X/Z, y = cy + ay scrz Y/Z. zMin and zMax, and where the picture lies, are the viewport's: see
/// readPs2Viewport.
ReadProjection readPs2(Context in) {
  const ObjectReader& f = in.fields;
  f.allow({"type", "scrz", "ax", "ay", "cx", "cy", "zMin", "zMax", "near", "far", "shift"});
  const double scrz = f.requireNumber("scrz");
  const double ax = f.requireNumber("ax"), ay = f.requireNumber("ay");
  const double cx = f.requireNumber("cx"), cy = f.requireNumber("cy");
  f.requireNumber("zMin");
  f.requireNumber("zMax");
  const double near = f.requireNumber("near");
  for (const char* name : {"scrz", "ax", "ay"})
    if (!(f.requireNumber(name) > 0)) f.fail(name, "must be above 0");
  const DoubleDouble fx = twoProd(ax, scrz), fy = twoProd(ay, scrz);
  for (const auto& [name, focal] : {std::pair("ax", fx), std::pair("ay", fy)})
    if (!(focal.hi > 0 && std::isfinite(focal.hi))) f.fail(name, "times scrz leaves the range of doubles");
  return {intrinsics(fx, fy, cx, cy, requireViewport(in, "around cx, cy"), near, readFar(f)), true, true};
}

using ProjectionReader = ReadProjection (*)(Context);
constexpr std::pair<std::string_view, ProjectionReader> kProjectionTypes[] = {
    {"perspective", readPerspective},   {"frustum", readFrustum}, {"intrinsics", readIntrinsics},
    {"orthographic", readOrthographic}, {"ps2", readPs2},
};

/// A ps2 projection says itself where the picture lies.
std::optional<ReadViewport> readPs2Viewport(const ObjectReader& camera, const ObjectReader& projection,
                                            double pixelCenter) {
  if (const auto fields = camera.object("viewport"))
    for (const char* name : {"x", "y", "depthRange"})
      if (fields->has(name)) fields->fail(name, "is already given by the ps2 projection's cx, cy, zMin and zMax");
  auto read = readViewport(camera, {.pixelCenter = pixelCenter});
  if (!read) return std::nullopt;
  Viewport& v = read->frame;
  v.x = projection.requireNumber("cx") - v.width / 2;
  v.y = projection.requireNumber("cy") - v.height / 2;
  v.depthFirst = projection.requireNumber("zMin");
  v.depthSecond = projection.requireNumber("zMax");
  validate(v);
  return read;
}

std::optional<Pose> readPose(const ObjectReader& camera, const Convention& convention, const std::string& preset) {
  static constexpr std::string_view kWays[] = {"target", "direction", "rotation", "worldFromCamera", "cameraFromWorld"};
  std::string given;
  int ways = 0;
  const auto count = [&](std::string_view way) {
    ++ways;
    given += (given.empty() ? "" : " and ") + std::string(way);
  };
  for (std::string_view way : kWays)
    if (camera.has(way)) count(way);
  const char* const turn = turnOf(camera);
  if (turn) count(turn);
  const auto place = readPlace(camera, "position");
  const auto position = readPosition(camera, "position");
  const auto up = camera.vec3("up");
  const auto axes = camera.choice("cameraAxes", kCameraAxesNames);
  if (ways > 1) camera.fail("has " + given + "; one of them is expected");
  if (ways == 0) {
    if (place) camera.fail("position", "needs a heading, a target, a direction or a rotation beside it");
    if (position) camera.fail("position", "needs a target, a direction or a rotation beside it");
    if (up) camera.fail("up", "needs a position and a target or direction beside it");
    if (axes) camera.fail("cameraAxes", "needs a rotation or a pose matrix beside it");
    return std::nullopt;
  }
  const bool isMatrix = camera.has("worldFromCamera") || camera.has("cameraFromWorld");
  if (isMatrix && position) camera.fail("position", "is already given by the matrix");
  if (!isMatrix && !position) camera.fail("needs position beside " + given);
  const bool looks = camera.has("target") || camera.has("direction");
  if (!looks && up) camera.fail("up", "goes with target or direction");
  if (axes && (looks || turn)) camera.fail("cameraAxes", "goes with rotation, worldFromCamera or cameraFromWorld");
  if (turn && !place) camera.fail(turn, "goes with a position by lat, lon and height");

  if (turn) return poseFromHeadingPitchRoll(*place, readTurn(camera));
  const CameraAxes cameraAxes = axes.value_or(CameraAxes::RUB);
  const Handedness world = convention.world;
  if (looks) {
    const auto targetPlace = readPlace(camera, "target");
    if (place && targetPlace && !up) return lookAtPlace(*place, *targetPlace);
    const auto look = [&](const auto& upward) {
      if (const auto target = readPosition(camera, "target")) return lookAt(*position, *target, upward, world);
      return lookAlong(*position, *camera.vec3("direction"), upward, world);
    };
    if (up) return look(*up);
    if (worldIsEcef(camera)) return look(ellipsoidNormal(place ? *place : ecefToGeodetic(*position)));
    return look(preset == "unreal" ? Vec3{0, 0, 1} : Vec3{0, 1, 0});
  }
  if (const auto q = camera.numbers("rotation", 4, 4))
    return poseFromRotation(*position, {(*q)[0], (*q)[1], (*q)[2], (*q)[3]}, cameraAxes, world);
  if (const auto matrix = camera.mat4("worldFromCamera")) return poseFromWorldFromCamera(*matrix, cameraAxes, world);
  return poseFromCameraFromWorld(*camera.mat4("cameraFromWorld"), cameraAxes, world);
}

/// Where a field that the library complains about stands in the file.
Path pathOf(const std::string& field) {
  static constexpr std::string_view kPoseFields[] = {
      "position",        "target",          "direction", "up",    "rotation",
      "worldFromCamera", "cameraFromWorld", "heading",   "pitch", "roll"};
  for (std::string_view pose : kPoseFields)
    if (field == pose) return {field};
  if (field == "projection") return {field};
  if (field.starts_with("viewport.crop.")) return {"viewport", "crop", field.substr(14)};
  if (field.starts_with("viewport.")) return {"viewport", field.substr(9)};
  return {"projection", field};
}

CameraFile readChecked(const Document& document, const CameraReading& reading) {
  const ObjectReader camera(document, document.root(), {});
  camera.allow({"convention", "position", "target", "direction", "up", "rotation", "worldFromCamera", "cameraFromWorld",
                "cameraAxes", "heading", "pitch", "roll", "world", "projection", "viewport", "name", "$schema"});
  for (const char* key : {"name", "$schema"}) (void)camera.string(key);
  CameraFile file;
  file.name = document.name();

  const auto projection = camera.object("projection");
  ProjectionReader readType = nullptr;
  if (projection) {
    const auto type = projection->choice("type", kProjectionTypes);
    if (!type) projection->fail("needs a type: perspective, frustum, intrinsics, orthographic or ps2");
    readType = *type;
  }
  const bool isPs2 = readType == readPs2;

  const std::string fallback = isPs2 ? "ps2" : "opengl";
  StatedConvention stated{*conventionPreset(reading.readAs.empty() ? fallback : reading.readAs), reading.readAs};
  if (reading.readAs.empty())
    if (const auto own = readConvention(camera, stated.convention)) stated = *own;
  const std::string preset = stated.preset.empty() ? fallback : stated.preset;
  file.convention = stated.convention;
  if (isPs2 && !file.convention.reverseZ)
    camera.fail("convention",
                "has reverseZ false, but a ps2 projection maps near to zMax: leave the convention out "
                "to read the file as ps2, and --convention says how to write");

  file.worldIsEcef = worldIsEcef(camera);
  if (file.worldIsEcef && file.convention.world == Handedness::left)
    camera.fail("convention",
                "makes the world left-handed, but Earth-centred coordinates are right-handed: read the file in a "
                "right-handed convention, and --convention says how to write");
  file.pose = readPose(camera, file.convention, preset);
  const double pixelCenter = preset == "opencv" ? 0 : 0.5;
  const auto viewport =
      isPs2 ? readPs2Viewport(camera, *projection, pixelCenter) : readViewport(camera, {.pixelCenter = pixelCenter});
  std::optional<Viewport> frame;
  if (viewport) frame = viewport->frame;
  if (projection) {
    ReadProjection read = readType({*projection, frame});
    if (frame && read.hasOwnShape && !read.hasOwnPixelShape && !reading.allowStretch)
      requireShape(windowAspect(read.projection), *frame, *projection);
    if (const auto shift = projection->numbers("shift", 2, 2))
      read.projection = shifted(read.projection, (*shift)[0], (*shift)[1]);
    if (viewport && viewport->crop) read.projection = cropped(read.projection, *frame, *viewport->crop);
    file.projection = read.projection;
  }
  if (viewport) file.viewport = viewport->tile();
  return file;
}

}  // namespace

CameraFile readCamera(const Document& document, const CameraReading& reading) {
  try {
    return readChecked(document, reading);
  } catch (const CameraError& e) {
    document.fail(pathOf(e.field()), e.message());
  }
}

Camera makeCamera(const CameraFile& file) {
  const auto lacks = [&](const char* part) { return InputError(file.name + ": the camera has no " + part); };
  if (!file.pose) throw lacks("pose; give a position with a target, a direction or a rotation");
  if (!file.projection) throw lacks("projection");
  if (!file.viewport) throw lacks("viewport; --viewport WIDTHxHEIGHT gives one");
  try {
    return makeCamera(*file.pose, *file.projection, *file.viewport, file.convention);
  } catch (const CameraError& e) {
    throw InputError(file.name + ": " + e.what());
  }
}

}  // namespace viewproj::cmd
