#include "input/scene.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "camera/exact_vectors.hpp"
#include "geodesy/normal.hpp"
#include "input/document.hpp"
#include "input/geodetic.hpp"
#include "input/scene_fields.hpp"
#include "input/value_form.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kNotOnEarth = "is a place, which needs a camera that stands on the Earth";

/// Reads shapes.
struct ShapeReader {
  bool worldIsEcef;

  Vec3 point(const ObjectReader& fields, const Field& key) const {
    if (!worldIsEcef && readPlace(fields, key)) fields.fail(key, kNotOnEarth);
    const auto v = readPosition(fields, key);
    if (!v) fields.fail("has no " + std::string(key.name) + "; expected [x, y, z]");
    return *v;
  }

  Plane readPlane(const ObjectReader& fields) const {
    fields.allow(field::planeForm);
    const Plane plane{point(fields, field::point), point(fields, field::normal)};
    if (!isValid(plane)) fields.fail(field::normal, "is no direction");
    return plane;
  }

  Sphere readSphere(const ObjectReader& fields) const {
    fields.allow(field::sphereForm);
    const Sphere sphere{point(fields, field::center), fields.requireNumber(field::radius)};
    if (const auto fault = faultOf(sphere); !fault.empty()) fields.fail(field::radius, std::string(fault));
    return sphere;
  }

  Box readBox(const ObjectReader& fields) const {
    fields.allow(field::boxForm);
    const Box box{point(fields, field::min), point(fields, field::max)};
    if (const auto fault = faultOf(box, worldIsEcef); !fault.empty()) fields.fail(field::max, std::string(fault));
    return box;
  }

  Triangle readTriangle(const ObjectReader& fields) const {
    const nlohmann::json& value = *fields.find(field::triangle);
    const bool arePlaces =
        value.is_array() && value.size() == 3 && std::all_of(value.begin(), value.end(), [](const auto& corner) {
          return corner.is_object() && !hasCoordinates(corner);
        });
    std::vector<Vec3> corners;
    if (arePlaces)
      for (const ObjectReader& corner : fields.objects(field::triangle)) {
        if (!worldIsEcef) corner.fail(kNotOnEarth);
        corners.push_back(geodeticToEcef(requirePlace(corner)));
      }
    else
      corners = *fields.vec3s(field::triangle, 3);
    const Triangle triangle{corners[0], corners[1], corners[2]};
    if (!isValid(triangle)) fields.fail(field::triangle, "has a coordinate that is not finite");
    return triangle;
  }
};

decltype(SceneObject::shape) readEllipsoid(const ObjectReader& fields) {
  const Ellipsoid ellipsoid = *fields.choice(field::ellipsoid, field::kEllipsoids);
  const double height = fields.number(field::height).value_or(0);
  if (height == 0) return ellipsoid;
  if (!(height >= kLeastCrossedHeight)) fields.fail(field::height, "must not be below -1000000 metres");
  return HeightSurface{height};
}

SceneObject readObject(const ObjectReader& fields, std::size_t index, const ShapeReader& reader) {
  fields.allow(field::sceneObject);
  (void)fields.string(field::name);
  SceneObject object;
  const auto name = fields.label(field::name);
  object.id = fields.label(field::id).value_or(name.value_or(std::to_string(index)));
  (void)fields.way(field::sceneObject);
  if (const auto plane = fields.object(field::plane)) object.shape = reader.readPlane(*plane);
  if (const auto sphere = fields.object(field::sphere)) object.shape = reader.readSphere(*sphere);
  if (const auto box = fields.object(field::box)) object.shape = reader.readBox(*box);
  if (fields.has(field::triangle)) object.shape = reader.readTriangle(fields);
  if (fields.has(field::ellipsoid)) object.shape = readEllipsoid(fields);
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
    hit.normal = detail::rounded(detail::rounded(detail::ellipsoidNormal(ecefToGeodetic(hit.point)).terms));
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
  const Document document(source, "--scene");
  const ObjectReader scene(document, document.root(), {});
  scene.allow(field::scene);
  for (const Field* text : {&field::name, &field::schema}) (void)scene.string(*text);
  if (!scene.has(field::objects))
    scene.fail("has no objects; expected {\"objects\": [{\"id\": ..., \"sphere\": {...}}, ...]}");
  std::vector<SceneObject> objects;
  for (const ObjectReader& object : scene.objects(field::objects))
    objects.push_back(readObject(object, objects.size(), {worldIsEcef}));
  return objects;
}

}  // namespace viewproj::cmd
