#include "input/scene.hpp"

#include <optional>

#include "input/document.hpp"

namespace viewproj::cmd {
namespace {

Vec3 requireVec3(const ObjectReader& fields, std::string_view key) {
  const auto v = fields.vec3(key);
  if (!v) fields.fail("has no " + std::string(key) + "; expected [x, y, z]");
  return *v;
}

Plane readPlane(const ObjectReader& fields) {
  fields.allow({"point", "normal"});
  const Plane plane{requireVec3(fields, "point"), requireVec3(fields, "normal")};
  if (!isValid(plane)) fields.fail("normal", "is no direction");
  return plane;
}

Sphere readSphere(const ObjectReader& fields) {
  fields.allow({"center", "radius"});
  const Sphere sphere{requireVec3(fields, "center"), fields.requireNumber("radius")};
  if (const auto fault = faultOf(sphere); !fault.empty()) fields.fail("radius", std::string(fault));
  return sphere;
}

Box readBox(const ObjectReader& fields) {
  fields.allow({"min", "max"});
  const Box box{requireVec3(fields, "min"), requireVec3(fields, "max")};
  if (const auto fault = faultOf(box); !fault.empty()) fields.fail("max", std::string(fault));
  return box;
}

Triangle readTriangle(const ObjectReader& fields) {
  const std::vector<Vec3> corners = *fields.vec3s("triangle", 3);
  const Triangle triangle{corners[0], corners[1], corners[2]};
  if (!isValid(triangle)) fields.fail("triangle", "has a coordinate that is not finite");
  return triangle;
}

Ellipsoid readEllipsoid(const ObjectReader& fields) {
  if (fields.string("ellipsoid") != "WGS84") fields.fail("ellipsoid", "is not known; expected \"WGS84\"");
  return kWgs84;
}

SceneObject readObject(const ObjectReader& fields, std::size_t index) {
  fields.allow({"id", "name", "plane", "sphere", "box", "triangle", "ellipsoid"});
  (void)fields.string("name");
  SceneObject object;
  object.id = fields.label("id").value_or(std::to_string(index));
  int shapes = 0;
  for (const char* shape : {"plane", "sphere", "box", "triangle", "ellipsoid"}) shapes += fields.has(shape);
  if (shapes != 1)
    fields.fail(std::string(shapes == 0 ? "has no shape" : "has more than one shape") +
                "; expected one of plane, sphere, box, triangle, ellipsoid");
  if (const auto plane = fields.object("plane")) object.shape = readPlane(*plane);
  if (const auto sphere = fields.object("sphere")) object.shape = readSphere(*sphere);
  if (const auto box = fields.object("box")) object.shape = readBox(*box);
  if (fields.has("triangle")) object.shape = readTriangle(fields);
  if (fields.has("ellipsoid")) object.shape = readEllipsoid(fields);
  return object;
}

}  // namespace

std::string_view faultOf(const Sphere& sphere) { return isValid(sphere) ? "" : "must not be below 0"; }

std::string_view faultOf(const Box& box) { return isValid(box) ? "" : "must not be below min in any coordinate"; }

std::vector<SceneObject> readScene(const std::string& source) {
  const Document document(source, "--scene");
  const ObjectReader scene(document, document.root(), {});
  scene.allow({"objects", "name", "$schema"});
  for (const char* key : {"name", "$schema"}) (void)scene.string(key);
  if (!scene.has("objects"))
    scene.fail("has no objects; expected {\"objects\": [{\"id\": ..., \"sphere\": {...}}, ...]}");
  std::vector<SceneObject> objects;
  for (const ObjectReader& object : scene.objects("objects")) objects.push_back(readObject(object, objects.size()));
  return objects;
}

}  // namespace viewproj::cmd
