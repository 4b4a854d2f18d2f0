// Where a ray meets a shape, by the textbook's formulas in exact arithmetic; other formulas than the library's.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "reference/scene.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

namespace reference {

using Shape = std::variant<viewproj::Plane, viewproj::Sphere, viewproj::Box, viewproj::Triangle, viewproj::Ellipsoid>;

struct TrueHit {
  Real distance;
  Real3 point, normal;
  /// Of each coordinate of the point and each component of the normal, beside its units in the last place.
  Real slack, normalSlack;
  std::vector<viewproj::BoxFace> faces;  ///< those that meet there, of a box
};

struct TrueHits {
  std::vector<TrueHit> hits;
  bool touches = false;   ///< a tangent, an edge or a corner
  bool startsOn = false;  ///< the ray starts on the surface
  bool startsInside = false;
  bool wide = false;  ///< the verdict took thousands of bits
};

/// For finite input and a direction that is not zero.
TrueHits trueHits(const viewproj::Ray& ray, const Shape& shape);

}  // namespace reference
