// Scenes: shapes with a name each, for rays to hit.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "viewproj/scene.hpp"

namespace viewproj::cmd {

/// Of constant height above WGS84, in ECEF metres.
struct HeightSurface {
  double height = 0;
};

struct SceneObject {
  std::string id;  ///< as JSON text: its id, or its place in the list, counted from 0
  std::variant<Plane, Sphere, Box, Triangle, Ellipsoid, HeightSurface> shape;
};

/// source: a file name or the JSON itself, {"objects": [{"id": ..., SHAPE}]}. Throws InputError with the place of what
/// is wrong, a shape that is none among it, and a place where the world is not the Earth's.
std::vector<SceneObject> readScene(const std::string& source, bool worldIsEcef);

/// The normal is away from the ellipsoid.
Hits intersect(const Ray& ray, const HeightSurface& surface);

/// What is wrong with a shape, or empty. For messages.
std::string_view faultOf(const Sphere& sphere);
std::string_view faultOf(const Box& box, bool ofTheEarth);

}  // namespace viewproj::cmd
