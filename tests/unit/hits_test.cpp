// What is hit by nothing; what rays hit, and where, reference/shapes/hits_test.cpp shows.

#include "catch.hpp"
#include "internals.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

const Box kCube{{-1, -1, -1}, {1, 1, 1}};

}  // namespace

TEST_CASE("Shapes and rays that are none are hit by nothing") {
  const Ray ray{{0, 0, 5}, {0, 0, -1}};
  CHECK(intersect(ray, Sphere{{0, 0, 0}, -1}).count == 0);
  CHECK(intersect(ray, Sphere{{0, 0, 0}, kInfinity}).count == 0);
  CHECK(intersect(ray, Box{{1, -1, -1}, {-1, 1, 1}}).count == 0);
  CHECK(intersect(ray, Box{{-1, -1, kNaN}, {1, 1, 1}}).count == 0);
  CHECK(intersect(ray, Plane{{0, 0, 0}, {0, 0, 0}}).count == 0);
  CHECK(intersect(ray, Ellipsoid{1, 0}).count == 0);
  for (const Ray& none : {Ray{{0, 0, 5}, {0, 0, 0}}, Ray{{0, 0, 5}, {0, -0.0, 0}}, Ray{{kNaN, 0, 5}, {0, 0, -1}},
                          Ray{{0, 0, 5}, {0, 0, -kInfinity}}})
    CHECK(intersect(none, kCube).count == 0);
}
