#include "camera/change_camera.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/plain_camera.hpp"
#include "camera/read_pose.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

Json vectorOf(const Vec3& v) { return {v.x, v.y, v.z}; }

Vec3 mappedVector(const Vec3& v, const AxisMap& map, double scale = 1) {
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = scale * map.signs[i] * v[map.from[i]] + 0.0;  // no -0
  return result;
}

/// From one set of camera axes to another, both by their letters.
AxisMap mapOfLetters(std::string_view from, std::string_view to) {
  constexpr std::string_view kOpposite[] = {"RL", "UD", "FB"};
  AxisMap map;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (const std::string_view line : kOpposite)
        if (line.find(to[i]) != std::string_view::npos && line.find(from[j]) != std::string_view::npos)
          map.from[i] = j, map.signs[i] = to[i] == from[j] ? 1 : -1;
  return map;
}

/// A pose matrix with its rows and columns mapped. Exact, except for the scale of its translation.
Mat4 mappedMatrix(const Mat4& m, const AxisMap& rows, const AxisMap& columns, double scale) {
  Mat4 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      result[i][j] = rows.signs[i] * columns.signs[j] * m[rows.from[i]][columns.from[j]] + 0.0;
    result[i][3] = scale * rows.signs[i] * m[rows.from[i]][3] + 0.0;
  }
  result[3] = {0, 0, 0, 1};
  return result;
}

/// Whether the document's pose is a matrix, which maps exactly.
bool mapMatrix(Json& root, const FieldValues& values, const CameraFile& camera, const AxisMap& map, double scale) {
  for (const FieldId field : {FieldId("worldFromCamera"), FieldId("cameraFromWorld")}) {
    const auto* const value = values.find<RigidTransform>(field);
    const Mat4* const matrix = value ? std::get_if<Mat4>(&value->rotation) : nullptr;
    if (!matrix) continue;
    const std::string_view name = nameOf(kCameraAxesNames, cameraAxesOf(values, *camera.preset));
    const std::string_view other = mapOfLetters(name, "RUB").mirrors() ? "RUB" : "RUF";
    const AxisMap axes = map.mirrors() ? mapOfLetters(name, other) : AxisMap{};
    const bool isInverse = field->path == "cameraFromWorld";
    root[std::string(field->path)] =
        isInverse ? mappedMatrix(*matrix, axes, map, scale).m : mappedMatrix(*matrix, map, axes, scale).m;
    if (map.mirrors()) root["cameraAxes"] = other;
    return true;
  }
  return false;
}

void mapPose(Json& root, const FieldValues& values, const CameraFile& camera, const AxisMap& map, double scale) {
  const Pose& pose = *camera.pose;
  const Json eye = vectorOf(mappedVector(pose.eye(), map, scale));
  root.erase("world");
  if (mapMatrix(root, values, camera, map, scale)) {
    if (values.has("position")) root["position"] = eye;
    return;
  }
  const auto* const target = values.find<Position>("target");
  const auto* const direction = values.find<Vec3>("direction");
  if (!camera.worldIsEcef && (target || direction)) {
    const Vec3 usual = camera.worldIsEnu ? Vec3{0, 0, 1} : camera.preset->up;
    root["up"] = vectorOf(mappedVector(values.valueOr("up", usual), map));
    if (target) root["target"] = vectorOf(mappedVector(target->point, map, scale));
    if (direction) root["direction"] = vectorOf(mappedVector(*direction, map));
  } else if (map != AxisMap{} || !(values.has("rotation") || values.has("euler"))) {
    const bool isRight = (camera.convention.world == Handedness::right) != map.mirrors();
    const auto in = [&](const Vec3& axis) { return mappedVector(axis, map); };
    putRotation(root, {{}, in(pose.right()), in(pose.up()), in(pose.forward())},
                isRight ? Handedness::right : Handedness::left);
  }
  root["position"] = eye;
}

Projection withLengths(const Projection& p, double scale) {
  return p.isOrthographic()
             ? orthographic(p.left() * scale, p.right() * scale, p.bottom() * scale, p.top() * scale, p.zNear() * scale,
                            p.zFar() * scale)
             : perspectiveWindow(p.left(), p.right(), p.bottom(), p.top(), p.zNear() * scale, p.zFar() * scale);
}

}  // namespace

bool AxisMap::mirrors() const {
  const bool isTurn = (from[0] + 1) % 3 == from[1];
  return (signs[0] * signs[1] * signs[2] > 0) != isTurn;
}

Document mapped(const CameraFile& camera, const AxisMap& map, double scale) {
  if (map == AxisMap{} && scale == 1) return copied(camera.document);
  Document document = withoutScreen(camera);
  Json& root = *document.root;
  if (camera.pose) mapPose(root, readValues(document), camera, map, scale);
  for (const Field& field : kFields)
    if (const Json* const value = field.isLength ? valueAt(root, field.path) : nullptr; value && value->is_number())
      root["projection"][std::string(shortName(field))] = value->get<double>() * scale;
  if (valueAt(root, "projection.matrix") && scale != 1)
    putMatrix(root, withLengths(frameProjection(camera), scale), camera.convention);
  const bool isRight = (camera.convention.world == Handedness::right) != map.mirrors();
  if (map.mirrors()) root["convention"]["world"] = nameOf(kWorldNames, isRight ? Handedness::right : Handedness::left);
  return document;
}

Document movedTo(const CameraFile& camera, const Vec3& eye) {
  Document document = withoutScreen(camera);
  Json& root = *document.root;
  const FieldValues values = readValues(document);
  const auto* const target = values.find<Position>("target");
  const bool isMatrix = values.has("worldFromCamera") || values.has("cameraFromWorld");
  if (camera.worldIsEcef) {
    root["world"] = nameOf(kWorlds, World::ecef);
    if (!values.has("rotation") && !values.has("euler") && !isMatrix)
      putRotation(root, plainPose(*camera.pose), Handedness::right);
  } else if (target) {
    const Vec3 from = values.find<Position>("position")->point, to = target->point;
    orient(root, "direction", {to.x - from.x, to.y - from.y, to.z - from.z});
  }
  root["position"] = vectorOf(eye);
  return document;
}

Document opened(const CameraFile& camera, double factor) {
  const Projection p = frameProjection(camera);
  return withProjection(camera, perspectiveWindow(p.left() * factor, p.right() * factor, p.bottom() * factor,
                                                  p.top() * factor, p.zNear(), p.zFar()));
}

Document withWindow(const CameraFile& camera, double left, double right, double bottom, double top) {
  Document document = copied(camera.document);
  Json& root = *document.root;
  root["projection"] = {{"type", "orthographic"},
                        {"left", left},
                        {"right", right},
                        {"bottom", bottom},
                        {"top", top},
                        {"near", camera.projection->zNear()},
                        {"far", camera.projection->zFar()}};
  if (valueAt(root, "viewport.crop")) {
    root["viewport"]["width"] = camera.viewport->width;
    root["viewport"]["height"] = camera.viewport->height;
    root["viewport"].erase("crop");
  }
  return document;
}

Document inConvention(const CameraFile& camera, const ConventionPreset& preset, const Convention& convention) {
  Document document = copied(camera.document);
  Json& root = *document.root;
  const FieldValues values = readValues(camera.document);
  const ConventionPreset& from = *camera.preset;
  const bool looks = values.has("target") || values.has("direction");
  if (from.up != preset.up && looks && !values.has("up") && !camera.worldIsEcef && !camera.worldIsEnu)
    root["up"] = vectorOf(from.up);
  const bool isTurned =
      values.has("rotation") || values.has("euler") || values.has("worldFromCamera") || values.has("cameraFromWorld");
  const CameraAxes axes = cameraAxesOf(values, from);
  if (isTurned && axes != cameraAxesOf(values, preset)) root["cameraAxes"] = nameOf(kCameraAxesNames, axes);
  if (from.pixelCenter != preset.pixelCenter && valueAt(root, "viewport") && !values.has("viewport.pixelCenter"))
    root["viewport"]["pixelCenter"] = from.pixelCenter;
  if (typeOf(values) == kPs2 && !convention.reverseZ)
    throw InputError(camera.name +
                     ": a ps2 projection has no form in a convention whose depth is not reversed; "
                     "--reverse-z or --convention ps2 reverses it");
  if (values.has("projection.matrix") && convention != camera.convention)
    putMatrix(root, frameProjection(camera), convention);
  return document;
}

}  // namespace viewproj::cmd
