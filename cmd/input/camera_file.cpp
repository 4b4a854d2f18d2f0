#include "input/camera_file.hpp"

#include "camera/camera.hpp"
#include "camera/viewport.hpp"
#include "geodesy/normal.hpp"
#include "input/convention_fields.hpp"
#include "input/convention_names.hpp"
#include "input/geodetic.hpp"
#include "input/projection_types.hpp"
#include "input/viewport_fields.hpp"
#include "text/error.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

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
  const ProjectionType* const type = projection ? &requireProjectionType(*projection) : nullptr;

  const std::string fallback(type ? type->preset : "opengl");
  StatedConvention stated{*conventionPreset(reading.readAs.empty() ? fallback : reading.readAs), reading.readAs};
  if (reading.readAs.empty())
    if (const auto own = readConvention(camera, stated.convention)) stated = *own;
  const std::string preset = stated.preset.empty() ? fallback : stated.preset;
  file.convention = stated.convention;
  if (type && type->isReversed && !file.convention.reverseZ)
    camera.fail("convention", "has reverseZ false, but a " + std::string(type->name) +
                                  " projection maps near to zMax: leave the convention out to read the file as " +
                                  fallback + ", and --convention says how to write");

  file.worldIsEcef = worldIsEcef(camera);
  if (file.worldIsEcef && file.convention.world == Handedness::left)
    camera.fail("convention",
                "makes the world left-handed, but Earth-centred coordinates are right-handed: read the file in a "
                "right-handed convention, and --convention says how to write");
  file.pose = readPose(camera, file.convention, preset);
  const double pixelCenter = preset == "opencv" ? 0 : 0.5;
  auto viewport = readViewport(camera, {.pixelCenter = pixelCenter});
  if (viewport && type && type->placeViewport) {
    type->placeViewport(camera, *projection, viewport->frame);
    validate(viewport->frame);
  }
  std::optional<Viewport> frame;
  if (viewport) frame = viewport->frame;
  if (type) {
    ReadProjection read = type->read(*projection, frame);
    if (frame && read.hasOwnShape && !read.hasOwnPixelShape && !reading.allowStretch)
      requireShape(windowAspect(parts(read.projection)), *frame, *projection);
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
