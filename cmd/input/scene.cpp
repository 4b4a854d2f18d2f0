#include "input/scene.hpp"

#include <optional>

#include "input/document.hpp"
#include "input/scene_fields.hpp"

namespace viewproj::cmd {
namespace {

Vec3 requireVec3(const ObjectReader& fields, const Field& key) {
  const auto v = fields.vec3(key);
  if (!v) fields.fail("has no " + std::string(key.name) + "; expected [x, y, z]");
  return *v;
}

Plane readPlane(const ObjectReader& fields) {
  fields.allow(field::planeForm);
  const Plane plane{requireVec3(fields, field::point), requireVec3(fields, field::normal)};
  if (!isValid(plane)) fields.fail(field::normal, "is no direction");
  return plane;
}

Sphere readSphere(const ObjectReader& fields) {
  fields.allow(field::sphereForm);
  const Sphere sphere{requireVec3(fields, field::center), fields.requireNumber(field::radius)};
  if (const auto fault = faultOf(sphere); !fault.empty()) fields.fail(field::radius, std::string(fault));
  return sphere;
}

Box readBox(const ObjectReader& fields) {
  fields.allow(field::boxForm);
  const Box box{requireVec3(fields, field::min), requireVec3(fields, field::max)};
  if (const auto fault = faultOf(box); !fault.empty()) fields.fail(field::max, std::string(fault));
  return box;
}

Triangle readTriangle(const ObjectReader& fields) {
  const std::vector<Vec3> corners = *fields.vec3s(field::triangle, 3);
  const Triangle triangle{corners[0], corners[1], corners[2]};
  if (!isValid(triangle)) fields.fail(field::triangle, "has a coordinate that is not finite");
  return triangle;
}

Ellipsoid readEllipsoid(const ObjectReader& fields) { return *fields.choice(field::ellipsoid, field::kEllipsoids); }

SceneObject readObject(const ObjectReader& fields, std::size_t index) {
  fields.allow(field::sceneObject);
  (void)fields.string(field::name);
  SceneObject object;
  object.id = fields.label(field::id).value_or(std::to_string(index));
  (void)fields.way(field::sceneObject);
  if (const auto plane = fields.object(field::plane)) object.shape = readPlane(*plane);
  if (const auto sphere = fields.object(field::sphere)) object.shape = readSphere(*sphere);
  if (const auto box = fields.object(field::box)) object.shape = readBox(*box);
  if (fields.has(field::triangle)) object.shape = readTriangle(fields);
  if (fields.has(field::ellipsoid)) object.shape = readEllipsoid(fields);
  return object;
}

}  // namespace

std::string_view faultOf(const Sphere& sphere) { return isValid(sphere) ? "" : "must not be below 0"; }

std::string_view faultOf(const Box& box) { return isValid(box) ? "" : "must not be below min in any coordinate"; }

std::vector<SceneObject> readScene(const std::string& source) {
  const Document document(source, "--scene");
  const ObjectReader scene(document, document.root(), {});
  scene.allow(field::scene);
  for (const Field* text : {&field::name, &field::schema}) (void)scene.string(*text);
  if (!scene.has(field::objects))
    scene.fail("has no objects; expected {\"objects\": [{\"id\": ..., \"sphere\": {...}}, ...]}");
  std::vector<SceneObject> objects;
  for (const ObjectReader& object : scene.objects(field::objects))
    objects.push_back(readObject(object, objects.size()));
  return objects;
}

}  // namespace viewproj::cmd
