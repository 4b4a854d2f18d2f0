#include "records/scene.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "camera/read_camera.hpp"
#include "camera/values.hpp"
#include "numbers/dyadic.hpp"
#include "numbers/vectors.hpp"
#include "records/points.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kSceneForm =
    "{\"objects\": [{\"id\": \"a\", \"sphere\": {\"center\": [0, 0, 0], \"radius\": 1}}]}";

constexpr const char* kOutOfRange = "has a number beyond 1e46";

// The fault of a shape whose numbers are in range, or an empty text.

std::string faultOf(const Sphere& sphere) { return sphere.radius < 0 ? "must not be below 0" : ""; }

std::string faultOf(const Box& box, bool worldIsEcef) {
  if (box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z) return "";
  return std::string("must not be below min in any coordinate") +
         (worldIsEcef ? "; of places these are x, y and z of ECEF" : "");
}

/// A point [x, y, z], or a place if the camera is on the Earth.
Vec3 pointOf(const Node& value, bool worldIsEcef) {
  const Position position = readPosition(value);
  if (position.place && !worldIsEcef) value.fail("is a place, which needs a camera on the Earth");
  return position.point;
}

/// Whether a shape without a fault is in range.
struct IsInRange {
  bool operator()(const Vec3& point) const { return isValid(Sphere{point}); }
  bool operator()(const PlaneEquation& plane) const { return isValid(Plane{{plane.offset, 0, 0}, plane.normal}); }
  bool operator()(const HeightSurface&) const { return true; }
  template <class Shape>
  bool operator()(const Shape& shape) const {
    return isValid(shape);
  }
};

using Shape = decltype(SceneObject::shape);

Shape ellipsoidOf(const Node& object) {
  if (const Node name = object.require("ellipsoid"); name.text() != "WGS84") name.fail("is not known; known is WGS84");
  const auto height = object.find("height");
  if (!height || height->number() == 0) return kWgs84;
  if (!(height->number() >= kLeastCrossedHeight)) height->fail("must not be below -1000000 metres");
  return HeightSurface{height->number()};
}

/// name: the member that holds the shape.
Shape shapeOf(const Node& object, std::string_view name, bool worldIsEcef) {
  if (name == "ellipsoid") return ellipsoidOf(object);
  const Node value = object.require(name);
  const auto point = [&](std::string_view key) { return pointOf(value.require(key), worldIsEcef); };
  if (name == "plane") {
    allowMembers(value, {"point", "normal"});
    const Plane plane{point("point"), point("normal")};
    if (plane.normal == Vec3{}) value.require("normal").fail("must not be all 0");
    return plane;
  }
  if (name == "sphere") {
    allowMembers(value, {"center", "radius"});
    const Sphere sphere{point("center"), value.require("radius").number()};
    if (const auto fault = faultOf(sphere); !fault.empty()) value.require("radius").fail(fault);
    return sphere;
  }
  if (name == "box") {
    allowMembers(value, {"min", "max"});
    const Box box{point("min"), point("max")};
    if (const auto fault = faultOf(box, worldIsEcef); !fault.empty()) value.require("max").fail(fault);
    return box;
  }
  if (value.size() != 3) value.fail("expected three corners");
  return Triangle{pointOf(value[0], worldIsEcef), pointOf(value[1], worldIsEcef), pointOf(value[2], worldIsEcef)};
}

/// A text or a number as JSON.
std::optional<std::string> labelOf(const Node& object, std::string_view key) {
  const auto value = object.find(key);
  if (!value) return std::nullopt;
  if (!value->json().is_number() && !value->json().is_string()) value->fail("expected a text or a number");
  return value->json().dump(-1, ' ', false, Json::error_handler_t::replace);
}

SceneObject readObject(const Node& object, std::size_t index, bool worldIsEcef) {
  allowMembers(object, {"id", "name", "plane", "sphere", "box", "triangle", "ellipsoid", "height"});
  std::vector<std::string_view> shapes;
  for (const char* shape : {"plane", "sphere", "box", "triangle", "ellipsoid"})
    if (object.find(shape)) shapes.emplace_back(shape);
  if (shapes.empty()) object.fail("needs a shape: plane, sphere, box, triangle or ellipsoid");
  if (shapes.size() > 1) object.fail("has " + together(shapes) + "; expected one of them");
  if (const auto height = object.find("height"); height && shapes[0] != "ellipsoid")
    height->fail("goes with ellipsoid alone");
  const auto name = labelOf(object, "name");
  Shape shape = shapeOf(object, shapes[0], worldIsEcef);
  if (!std::visit(IsInRange(), shape)) object.fail(kOutOfRange);
  return {labelOf(object, "id").value_or(name.value_or(std::to_string(index))), std::move(shape)};
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

Hits intersect(const Ray& ray, const PlaneEquation& plane) {
  using namespace detail;
  const Vector3<Dyadic<1>> normal = toDyadic(plane.normal);
  const Dyadic<2> height = dot(normal, toDyadic(ray.origin)) + Dyadic<1>(plane.offset);
  const Dyadic<2> slope = dot(normal, toDyadic(ray.direction));
  if (slope.sign() == 0 || height.sign() * slope.sign() > 0) return {};
  const Wide ratio = -height.rounded() / slope.rounded();
  const DoubleDouble t = scaleByPowerOfTwo(ratio.value, ratio.exponent);
  Hit hit{
      rounded(t / inverseLength(toDoubleDouble(ray.direction))), {}, rounded(normalized(toDoubleDouble(plane.normal)))};
  for (std::size_t i = 0; i < 3; ++i)
    hit.point[i] = rounded(sumOrZero(ray.origin[i], t * DoubleDouble(ray.direction[i])));
  return {{{hit}}, 1};
}

std::vector<SceneHit> hitsOf(const Camera& camera, const Ray& ray, const std::vector<SceneObject>& scene) {
  const Projection projection = camera.projection();
  const Vec3& d = ray.direction;
  std::vector<SceneHit> found;
  for (const SceneObject& object : scene)
    for (const double sign : {1.0, -1.0}) {
      if (sign < 0 && !projection.isOrthographic()) break;
      const Ray one{ray.origin, {sign * d.x, sign * d.y, sign * d.z}};
      for (Hit hit : std::visit([&](const auto& shape) { return intersect(one, shape); }, object.shape)) {
        const double z = worldToScreen(camera, hit.point).viewDistance, along = std::isnan(z) ? HUGE_VAL : z;
        // Without a near plane, a lens may see behind the eye.
        if (hasDepth(projection) && !(along >= projection.zNear())) continue;
        if (!(along <= projection.zFar())) continue;
        if (sign < 0 && hit.distance == 0) continue;  // found already
        const auto* const sphere = std::get_if<Sphere>(&object.shape);
        if (sphere && sphere->radius == 0) hit.normal = {0 - d.x, 0 - d.y, 0 - d.z};
        hit.distance *= sign;
        found.push_back({&object, hit});
      }
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const SceneHit& a, const SceneHit& b) { return a.hit.distance < b.hit.distance; });
  return found;
}

std::vector<SceneObject> readScene(const std::string& source, bool worldIsEcef) {
  const Document document = load(source, "--scene");
  const Node scene(document);
  if (!scene.json().is_object()) scene.fail(std::string("expected ") + kSceneForm);
  for (const char* shape : {"plane", "sphere", "box", "triangle", "ellipsoid"})
    if (scene.find(shape)) scene.fail(std::string("put the ") + shape + " under objects, as in " + kSceneForm);
  if (!scene.find("objects")) scene.fail(std::string("needs objects, as in ") + kSceneForm);
  allowMembers(scene, {"$schema", "name", "objects"});
  for (const char* key : {"$schema", "name"})
    if (const auto text = scene.find(key)) (void)text->text();
  const Node all = scene.require("objects");
  std::vector<SceneObject> objects;
  for (std::size_t i = 0; i < all.size(); ++i) objects.push_back(readObject(all[i], i, worldIsEcef));
  return objects;
}

namespace {

CullShape shapeOf(const NumberPlan& plan, const Numbers& n) {
  const auto vector = [&](std::size_t first) { return Vec3{n[first], n[first + 1], n[first + 2]}; };
  const auto checked = [](const Sphere& sphere) {
    if (const std::string fault = faultOf(sphere); !fault.empty()) throw RecordError(0, "radius " + fault);
    return sphere;
  };
  if (plan.kind == kindSphere) return checked({vector(0), n[3]});
  if (plan.kind == kindTriangle) return Triangle{vector(0), vector(3), vector(6)};
  if (plan.kind == kindBox) {
    const Box box{vector(0), vector(3)};
    const std::string fault = faultOf(box, plan.fields[0].point == PointForm::ofTheEarth);
    if (!fault.empty()) throw RecordError(0, "max " + fault);
    return box;
  }
  const Vec4 point = toPoint(plan, n);
  if (point.w == 0) throw RecordError(0, "is a direction; expected a point or a shape");
  const Vec3 position{point.x / point.w, point.y / point.w, point.z / point.w};
  if (isPoint(plan)) return position;
  if (!detail::isFinite(position)) throw RecordError(0, "has a center beyond the range of doubles");
  return checked({position, n[plan.slots() - 1]});
}

}  // namespace

CullShape toShape(const NumberPlan& plan, const Numbers& n) {
  CullShape shape = shapeOf(plan, n);
  if (!std::visit(IsInRange(), shape)) throw RecordError(0, kOutOfRange);
  return shape;
}

}  // namespace viewproj::cmd
