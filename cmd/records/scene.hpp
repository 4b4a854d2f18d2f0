// The shapes of a scene, each with a name, for rays to hit; and the shapes of records.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "records/number_plan.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

/// A surface of constant height above WGS84, in ECEF metres.
struct HeightSurface {
  double height = 0;
};

/// The points of ax + by + cz + d = 0, which may have no point in doubles.
struct PlaneEquation {
  Vec3 normal;
  double offset = 0;
};

struct SceneObject {
  std::string id;  ///< JSON text: the id, else the name, else the index in the list, from 0
  std::variant<Plane, Sphere, Box, Triangle, Ellipsoid, HeightSurface, PlaneEquation> shape;
};

/// source: a file name or the JSON itself, {"objects": [{"id": ..., SHAPE}]}. Throws InputError with the place of the
/// error, also for an invalid shape, and for a place if the world is not the Earth's.
std::vector<SceneObject> readScene(const std::string& source, bool worldIsEcef);

/// The normal points away from the ellipsoid.
Hits intersect(const Ray& ray, const HeightSurface& surface);
/// Like that of a Plane: whether there is a hit is decided exactly.
Hits intersect(const Ray& ray, const PlaneEquation& plane);

struct SceneHit {
  const SceneObject* object = nullptr;
  Hit hit;
};

/// What the camera shows along a pixel's ray, between near and far where it has them; in orthographic also behind the
/// ray's origin, at a distance below 0. Nearest first. Hits at the same distance are in the scene's order.
std::vector<SceneHit> hitsOf(const Camera& camera, const Ray& ray, const std::vector<SceneObject>& scene);

using CullShape = std::variant<Vec3, Sphere, Box, Triangle>;

/// The shape of a record. Throws RecordError if the numbers make no valid shape, or make a direction.
CullShape toShape(const NumberPlan& plan, const Numbers& numbers);

}  // namespace viewproj::cmd
