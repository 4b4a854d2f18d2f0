// Shapes: those of a scene, with a name each, for rays to hit; and those of records.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "records/layout.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

/// Of constant height above WGS84, in ECEF metres.
struct HeightSurface {
  double height = 0;
};

struct SceneObject {
  std::string id;  ///< as JSON text: its id, its name, or its place in the list, counted from 0
  std::variant<Plane, Sphere, Box, Triangle, Ellipsoid, HeightSurface> shape;
};

/// source: a file name or the JSON itself, {"objects": [{"id": ..., SHAPE}]}. Throws InputError with the place of what
/// is wrong, a shape that is none among it, and a place where the world is not the Earth's.
std::vector<SceneObject> readScene(const std::string& source, bool worldIsEcef);

/// The normal is away from the ellipsoid.
Hits intersect(const Ray& ray, const HeightSurface& surface);

struct SceneHit {
  const SceneObject* object = nullptr;
  Hit hit;
};

/// Nearest first; of hits at the same distance, in the scene's order.
std::vector<SceneHit> hitsOf(const Ray& ray, const std::vector<SceneObject>& scene);

using CullShape = std::variant<Vec3, Sphere, Box, Triangle>;

/// What a record holds. Throws RecordError where the numbers make no shape, and for a direction.
CullShape toShape(const Layout& layout, const Numbers& numbers);

}  // namespace viewproj::cmd
