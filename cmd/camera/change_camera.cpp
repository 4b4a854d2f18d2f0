#include "camera/change_camera.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/check.hpp"
#include "camera/read_pose.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {
namespace {

/// The rows of a matrix as JSON.
Json rowsOf(const Mat4& matrix) { return matrix.m; }

Json listOf(const Vec3& v) { return {v.x, v.y, v.z}; }

Vec3 mappedVector(const Vec3& v, const AxisMap& map, double scale = 1) {
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = scale * map.signs[i] * v[map.from[i]] + 0.0;  // no -0
  return result;
}

Vec3 opposite(const Vec3& v) { return {-v.x, -v.y, -v.z}; }

/// The quaternion x, y, z, w of the rotation with these columns.
std::array<double, 4> quaternionOf(const std::array<Vec3, 3>& c) {
  const std::array<double, 4> squares = {1 + c[0].x - c[1].y - c[2].z, 1 - c[0].x + c[1].y - c[2].z,
                                         1 - c[0].x - c[1].y + c[2].z, 1 + c[0].x + c[1].y + c[2].z};
  const double xy = c[1].x + c[0].y, xz = c[2].x + c[0].z, yz = c[2].y + c[1].z;
  const double xw = c[1].z - c[2].y, yw = c[2].x - c[0].z, zw = c[0].y - c[1].x;
  // Products with the largest component, times four. Dividing by it gives the quaternion.
  const std::array<std::array<double, 4>, 4> products = {
      {{squares[0], xy, xz, xw}, {xy, squares[1], yz, yw}, {xz, yz, squares[2], zw}, {xw, yw, zw, squares[3]}}};
  const auto largest = std::max_element(squares.begin(), squares.end());
  std::array<double, 4> q = products[static_cast<std::size_t>(largest - squares.begin())];
  for (double& part : q) part = part / (2 * std::sqrt(*largest)) + 0.0;
  return q;
}

/// Replaces all fields that orient the camera by a rotation.
void setRotation(Json& root, const Vec3& right, const Vec3& up, const Vec3& forward, Handedness world) {
  for (const char* name :
       {"target", "direction", "up", "euler", "heading", "pitch", "roll", "worldFromCamera", "cameraFromWorld"})
    root.erase(name);
  const bool isRight = world == Handedness::right;
  root["cameraAxes"] = isRight ? "RUB" : "RUF";
  root["rotation"] = quaternionOf({right, up, isRight ? opposite(forward) : forward});
}

CameraAxes axesOf(const Document& document) {
  const Json* const stated = valueAt(*document.root, "cameraAxes");
  return stated ? valueOf(kCameraAxesNames, stated->get<std::string>()) : readConvention(document).preset->cameraAxes;
}

/// For a world of the other handedness: a map from the camera's axes to another set of axes, and that set's name.
std::pair<AxisMap, const char*> mirroredAxes(CameraAxes axes) {
  switch (axes) {
    case CameraAxes::RUB:
      return {{{0, 1, 2}, {1, 1, -1}}, "RUF"};
    case CameraAxes::RUF:
      return {{{0, 1, 2}, {1, 1, -1}}, "RUB"};
    case CameraAxes::RDF:
      return {{{0, 1, 2}, {1, -1, 1}}, "RUF"};
    case CameraAxes::FRU:
      break;
  }
  return {{{1, 2, 0}, {1, 1, -1}}, "RUB"};
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

// cppcheck-suppress constParameter  // what it points to changes
void mapPose(Document& document, const CameraFile& camera, const AxisMap& map, double scale, Handedness newWorld) {
  Json& root = *document.root;
  const Node node(document);
  root.erase("world");
  const Json eye = listOf(mappedVector(camera.pose->eye(), map, scale));
  const auto replace = [&](const char* name, double size = 1) {
    if (const auto value = node.find(name)) root[name] = listOf(mappedVector(value->vec3(), map, size));
  };
  for (const char* name : {"worldFromCamera", "cameraFromWorld"})
    if (const auto value = node.find(name))
      if (const auto matrix = rigidMatrix(*value)) {
        const auto [turned, axesName] = mirroredAxes(axesOf(document));
        const AxisMap& axes = map.mirrors() ? turned : AxisMap{};
        root[name] =
            rowsOf(*name == 'c' ? mappedMatrix(*matrix, axes, map, scale) : mappedMatrix(*matrix, map, axes, scale));
        if (map.mirrors()) root["cameraAxes"] = axesName;
        if (node.find("position")) root["position"] = eye;
        return;
      }
  if (!camera.worldIsEcef && (node.find("target") || node.find("direction"))) {
    if (!node.find("up")) root["up"] = listOf(readConvention(document).preset->up);
    replace("up");
    replace("direction");
    replace("target", scale);
  } else if (map != AxisMap{} || !(node.find("rotation") || node.find("euler"))) {
    const Pose& pose = *camera.pose;
    setRotation(root, mappedVector(pose.right(), map), mappedVector(pose.up(), map), mappedVector(pose.forward(), map),
                newWorld);
  }
  root["position"] = eye;
}

/// Multiplies a number of the projection by a factor, if it is there.
void multiply(Json& root, const char* name, double factor) {
  Json& projection = root["projection"];
  const auto value = projection.find(name);
  if (value != projection.end() && value->is_number()) *value = value->get<double>() * factor;
}

/// A projection with lengths times scale, and in perspective with a window times factor.
Projection resized(const Projection& p, double scale, double factor) {
  return p.isOrthographic() ? orthographic(p.left() * scale, p.right() * scale, p.bottom() * scale, p.top() * scale,
                                           p.zNear() * scale, p.zFar() * scale)
                            : perspectiveWindow(p.left() * factor, p.right() * factor, p.bottom() * factor,
                                                p.top() * factor, p.zNear() * scale, p.zFar() * scale);
}

}  // namespace

bool AxisMap::mirrors() const {
  const bool isTurn = (from[0] + 1) % 3 == from[1];
  return (signs[0] * signs[1] * signs[2] > 0) != isTurn;
}

Document copied(const Document& document) {
  Document copy = document;
  copy.root = std::make_shared<Json>(*document.root);
  return copy;
}

Document mapped(const CameraFile& camera, const AxisMap& map, double scale) {
  Document document = copied(camera.document);
  if (map == AxisMap{} && scale == 1) return document;
  Json& root = *document.root;
  Handedness world = camera.convention.world;
  if (map.mirrors()) world = world == Handedness::right ? Handedness::left : Handedness::right;
  if (camera.pose) mapPose(document, camera, map, scale, world);
  if (valueAt(root, "projection")) {
    for (const char* name :
         {"near", "far", "left", "right", "bottom", "top", "width", "height", "nearWidth", "nearHeight"})
      multiply(root, name, scale);
    if (valueAt(root, "projection.matrix") && scale != 1)
      setLensMatrix(document, resized(uncroppedProjection(camera.document), scale, 1), camera.convention);
  }
  if (map.mirrors()) root["convention"]["world"] = nameOf(kWorldNames, world);
  return document;
}

Document movedTo(const CameraFile& camera, const Vec3& eye) {
  Document document = copied(camera.document);
  Json& root = *document.root;
  const Node node(camera.document);
  const Pose& pose = *camera.pose;
  if (camera.worldIsEcef) {
    root["world"] = nameOf(kWorlds, true);
    if (!node.find("rotation") && !node.find("euler") && !node.find("worldFromCamera") && !node.find("cameraFromWorld"))
      setRotation(root, pose.right(), pose.up(), pose.forward(), camera.convention.world);
  } else if (const auto target = node.find("target")) {
    const Vec3 from = node.require("position").vec3(), to = target->vec3();
    root.erase("target");
    root["direction"] = {to.x - from.x, to.y - from.y, to.z - from.z};
  }
  root["position"] = listOf(eye);
  return document;
}

Document opened(const CameraFile& camera, double factor) {
  Document document = copied(camera.document);
  Json& root = *document.root;
  const Projection wider = resized(uncroppedProjection(camera.document), 1, factor);
  for (const auto& [name, of] :
       {std::pair("fovY", Fov::vertical), {"fovX", Fov::horizontal}, {"fovDiagonal", Fov::diagonal}})
    if (valueAt(root["projection"], name)) root["projection"][name] = wider.fov(of);
  for (const char* name : {"left", "right", "bottom", "top", "nearWidth", "nearHeight"}) multiply(root, name, factor);
  for (const char* name : {"focalLength", "fx", "fy", "scrz"}) multiply(root, name, 1 / factor);
  if (valueAt(root, "projection.matrix")) setLensMatrix(document, wider, camera.convention);
  return document;
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

Projection uncroppedProjection(const Document& document) {
  Document uncropped = copied(document);
  (*uncropped.root)["projection"].erase("shift");
  if (valueAt(*uncropped.root, "viewport")) (*uncropped.root)["viewport"].erase("crop");
  return *readCamera(uncropped, {.allowStretch = true}).projection;
}

// cppcheck-suppress constParameter  // what it points to changes
void setLensMatrix(Document& document, const Projection& projection, const Convention& convention) {
  (*document.root)["projection"]["matrix"] =
      rowsOf(laidOut(matrix(cameraIn(convention, {}, projection), Space::clip, Space::view), convention));
}

}  // namespace viewproj::cmd
