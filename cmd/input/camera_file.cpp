#include "input/camera_file.hpp"

#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "camera/viewport.hpp"
#include "geodesy/normal.hpp"
#include "input/adjusted.hpp"
#include "input/camera_fields.hpp"
#include "input/convention_fields.hpp"
#include "input/distortion_names.hpp"
#include "input/euler.hpp"
#include "input/geodetic.hpp"
#include "input/projection_types.hpp"
#include "input/viewport_fields.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

using namespace detail;

std::optional<Pose> readPose(const ObjectReader& camera, const Convention& convention, const ConventionPreset& preset) {
  const auto place = readPlace(camera, field::position);
  const auto position = readPosition(camera, field::position);
  const CameraAxes axes = camera.choice(field::cameraAxes, kCameraAxesNames).value_or(preset.cameraAxes);
  const Way* const way = camera.way(field::camera);
  if (!way) return std::nullopt;
  const Field* const key = way->keys.front();
  const Handedness world = convention.world;
  if (key == &field::heading) {
    if (!place) camera.fail(field::position, "needs lat, lon and height for a heading, pitch or roll");
    return poseFromHeadingPitchRoll(*place, readTurn(camera));
  }
  if (key == &field::target || key == &field::direction) {
    const auto up = camera.vec3(field::up);
    const auto targetPlace = readPlace(camera, field::target);
    if (place && targetPlace && !up) return lookAtPlace(*place, *targetPlace);
    const auto look = [&](const auto& upward) {
      if (const auto target = readPosition(camera, field::target)) return lookAt(*position, *target, upward, world);
      return lookAlong(*position, *camera.vec3(field::direction), upward, world);
    };
    if (up) return look(*up);
    if (worldIsEcef(camera)) return look(ellipsoidNormal(place ? *place : ecefToGeodetic(*position)));
    return look(preset.up);
  }
  if (key == &field::euler) return readEuler(camera, *position, axes, world);
  if (const auto q = camera.numbers(field::rotation, 4, 4))
    return poseFromRotation(*position, {(*q)[0], (*q)[1], (*q)[2], (*q)[3]}, axes, world);
  if (const auto matrix = camera.mat4(field::worldFromCamera)) return poseFromWorldFromCamera(*matrix, axes, world);
  return poseFromCameraFromWorld(*camera.mat4(field::cameraFromWorld), axes, world);
}

Path pathInCamera(const Document& document, const std::string& name) {
  Path path = undotted(name);
  for (const Field* field : field::camera.fields)
    if (field->name == path.front()) {
      path.front() = ObjectReader(document, document.root(), {}).pathOf(*field).front();
      return path;
    }
  path.insert(path.begin(), std::string(field::projection));
  return path;
}

namespace {

/// Throws for a document that has fields, and none that is a camera's, or near to one.
void requireCamera(const ObjectReader& camera) {
  const std::vector<std::string_view> names = namesOf(field::camera.fields);
  bool isOther = false;
  for (const auto& item : camera.json().items()) {
    const std::string& key = item.key();
    if (key == field::name.name || key == field::schema.name) continue;
    if (field::camera.has(key) || !nearestName(key, names).empty() || distortionName(key) != DistortionName::none)
      return;
    for (const Field* field : field::camera.fields)
      for (const std::string_view other : field->aliases())
        if (other == key) return;
    isOther = true;
  }
  if (isOther && !camera.document().isTyped())
    camera.fail(
        "is no camera file, and of no other kind that is known: viewproj help formats lists those, and --format FILE "
        "reads one more by a row of your own");
}

CameraFile readChecked(const Document& document, const CameraReading& reading) {
  const ObjectReader camera(document, document.root(), {});
  requireCamera(camera);
  camera.allow(field::camera);
  for (const Field* text : {&field::name, &field::schema}) (void)camera.string(*text);
  CameraFile file;
  file.name = document.name();

  const auto projection = camera.object(field::projection);
  const ProjectionType* const type = projection ? &requireProjectionType(*projection) : nullptr;

  const ConventionPreset* const own = type && type->preset ? findPreset(type->preset) : nullptr;
  const ConventionPreset& fallback = own ? *own : conventionPresets().front();
  const StatedConvention stated = readStated(camera, reading.readAs, fallback);
  file.convention = stated.convention;
  if (stated.preset->convention.world == stated.convention.world) file.cameraAxes = stated.preset->cameraAxes;
  if (type && type->isReversed && !file.convention.reverseZ)
    camera.fail(field::convention, "has reverseZ false, but a " + std::string(type->name) +
                                       " projection maps near to zMax: leave the convention out to read the file as " +
                                       std::string(fallback.name) + ", and --convention says how to write");

  file.worldIsEcef = worldIsEcef(camera);
  if (file.worldIsEcef && file.convention.world == Handedness::left)
    camera.fail(field::convention,
                "makes the world left-handed, but Earth-centred coordinates are right-handed: read the file in a "
                "right-handed convention, and --convention says how to write");
  file.pose = readPose(camera, file.convention, *stated.preset);
  if (reading.eye && file.pose) file.pose = movedTo(*file.pose, *reading.eye, file.convention.world);
  auto viewport = readViewport(camera, {.pixelCenter = stated.preset->pixelCenter});
  if (viewport && type && type->placeViewport) {
    type->placeViewport(camera, *projection, viewport->frame);
    validate(viewport->frame);
  }
  std::optional<Viewport> frame;
  if (viewport) frame = viewport->frame;
  if (type) {
    Projection read = readProjection(*projection, *type, frame, reading.allowStretch);
    if (reading.near || reading.far) read = withRange(read, reading.near, reading.far);
    if (viewport && viewport->crop) read = cropped(read, *frame, *viewport->crop);
    file.projection = read;
  }
  if (viewport) file.viewport = viewport->tile();
  return file;
}

}  // namespace

CameraFile readCamera(const Document& document, const CameraReading& reading) {
  try {
    const CameraFile file = readChecked(document, reading);
    document.requireSetsRead("this camera file");
    return file;
  } catch (const CameraError& e) {
    document.fail(pathInCamera(document, e.field()), e.message());
  }
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
  try {
    return makeCamera(*file.pose, *file.projection, *file.viewport, file.convention);
  } catch (const CameraError& e) {
    throw InputError(file.name + ": " + e.what());
  }
}

}  // namespace viewproj::cmd
