#include "records/scene.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "camera/check.hpp"
#include "camera/read_pose.hpp"
#include "text/names.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

/// [x, y, z], or a place where the camera stands on the Earth.
Vec3 pointOf(const Node& value, bool worldIsEcef) {
  checkValue(value, *findField("position"));
  if (isPlaceValue(value) && !worldIsEcef) value.fail("is a place, which needs a camera that stands on the Earth");
  return positionOf(value);
}

decltype(SceneObject::shape) shapeOf(const Node& value, std::string_view name, bool worldIsEcef) {
  const auto point = [&](std::string_view key) { return pointOf(value.require(key), worldIsEcef); };
  if (name == "plane") {
    allowMembers(value, {"point", "normal"});
    const Plane plane{point("point"), point("normal")};
    if (!isValid(plane)) value.require("normal").fail("must not be all 0");
    return plane;
  }
  if (name == "sphere") {
    allowMembers(value, {"center", "radius"});
    const Sphere sphere{point("center"), value.require("radius").number()};
    if (const auto fault = faultOf(sphere); !fault.empty()) value.require("radius").fail(std::string(fault));
    return sphere;
  }
  if (name == "box") {
    allowMembers(value, {"min", "max"});
    const Box box{point("min"), point("max")};
    if (const auto fault = faultOf(box, worldIsEcef); !fault.empty()) value.require("max").fail(std::string(fault));
    return box;
  }
  if (value.size() != 3) value.fail("expected three corners");
  const Triangle triangle{pointOf(value[0], worldIsEcef), pointOf(value[1], worldIsEcef),
                          pointOf(value[2], worldIsEcef)};
  if (!isValid(triangle)) value.fail("has a coordinate that is not finite");
  return triangle;
}

decltype(SceneObject::shape) ellipsoidOf(const Node& object) {
  if (const Node name = object.require("ellipsoid"); name.text() != "WGS84") name.fail("is not known; known is WGS84");
  const auto height = object.find("height");
  if (!height || height->number() == 0) return kWgs84;
  if (!(height->number() >= kLeastCrossedHeight)) height->fail("must not be below -1000000 metres");
  return HeightSurface{height->number()};
}

/// A text or a number as JSON.
std::optional<std::string> labelOf(const Node& object, std::string_view key) {
  const auto value = object.find(key);
  if (!value) return std::nullopt;
  if (!value->json().is_number() && !value->json().is_string()) value->fail("expected a text or a number");
  return value->json().dump(-1, ' ', false, Json::error_handler_t::replace);
}

SceneObject readObject(const Node& fields, std::size_t index, bool worldIsEcef) {
  for (const char* other : {"aabb", "bbox"})
    if (const auto value = fields.find(other))
      value->fail("is called box here: {\"min\": [x, y, z], \"max\": [x, y, z]}");
  allowMembers(fields, {"id", "name", "plane", "sphere", "box", "triangle", "ellipsoid", "height"});
  SceneObject object;
  const auto name = labelOf(fields, "name");
  object.id = labelOf(fields, "id").value_or(name.value_or(std::to_string(index)));
  std::vector<std::string_view> shapes;
  for (const char* shape : {"plane", "sphere", "box", "triangle", "ellipsoid"})
    if (fields.find(shape)) shapes.emplace_back(shape);
  if (shapes.empty()) fields.fail("needs a shape: plane, sphere, box, triangle or ellipsoid");
  if (shapes.size() > 1) fields.fail("has " + together(shapes) + "; expected one of them");
  const bool isEllipsoid = shapes.front() == "ellipsoid";
  if (const auto height = fields.find("height"); height && !isEllipsoid) height->fail("goes with ellipsoid alone");
  object.shape =
      isEllipsoid ? ellipsoidOf(fields) : shapeOf(fields.require(shapes.front()), shapes.front(), worldIsEcef);
  return object;
}

}  // namespace

Hits intersect(const Ray& ray, const HeightSurface& surface) {
  Hits hits;
  const HeightCrossings crossings = crossingsOfHeight(ray, surface.height);
  for (int i = 0; i < crossings.count; ++i) {
    Hit& hit = hits.hits[static_cast<std::size_t>(hits.count++)];
    hit.distance = crossings.distances[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 3; ++k) hit.point[k] = ray.origin[k] + hit.distance * ray.direction[k];
    hit.normal = ellipsoidNormal(ecefToGeodetic(hit.point));
  }
  return hits;
}

std::string_view faultOf(const Sphere& sphere) { return isValid(sphere) ? "" : "must not be below 0"; }

std::string_view faultOf(const Box& box, bool ofTheEarth) {
  if (isValid(box)) return "";
  return ofTheEarth ? "must not be below min in any coordinate: on the Earth those are x, y and z of ECEF, for corners "
                      "by lat, lon, height too"
                    : "must not be below min in any coordinate";
}

std::vector<SceneObject> readScene(const std::string& source, bool worldIsEcef) {
  const Document document = load(source, "--scene");
  const Node scene(document);
  if (!scene.json().is_object() || !scene.find("objects"))
    scene.fail("needs objects: {\"objects\": [{\"id\": ..., \"sphere\": {...}}, ...]}");
  allowMembers(scene, {"$schema", "name", "objects"});
  for (const char* key : {"$schema", "name"})
    if (const auto text = scene.find(key)) (void)text->text();
  const Node all = scene.require("objects");
  std::vector<SceneObject> objects;
  for (std::size_t i = 0; i < all.size(); ++i) objects.push_back(readObject(all[i], i, worldIsEcef));
  return objects;
}

}  // namespace viewproj::cmd
