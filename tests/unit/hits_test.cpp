#include <limits>

#include "catch.hpp"
#include "internals.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const Box kCube{{-1, -1, -1}, {1, 1, 1}};

}  // namespace

TEST_CASE("A ray that starts on a surface hits it at distance 0, whichever way it goes") {
  const Sphere sphere{{0, 0, 0}, 1};
  CHECK(intersect(Ray{{0, 0, 1}, {0, 0, -1}}, sphere).count == 2);
  for (const Vec3& d : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 0.6, 0.8}}) {
    const Hits h = intersect(Ray{{0, 0, 1}, d}, sphere);
    REQUIRE(h.count == 1);
    CHECK(h.hits[0].distance == 0);
    CHECK(h.hits[0].point == Vec3{0, 0, 1});
    CHECK(h.hits[0].normal == Vec3{0, 0, 1});
  }
  CHECK(intersect(Ray{{0, 0, 1}, {0, 0, -1}}, kCube).count == 2);
  CHECK(intersect(Ray{{0, 0, 1}, {0, 0, 1}}, kCube).hits[0].distance == 0);
  CHECK(intersect(Ray{{2, 0, 3}, {0, 1, 0}}, Plane{{0, 0, 0}, {0, 1, 0}}).hits[0].distance == 0);
  CHECK(intersect(Ray{{0.25, 0, 0.25}, {0, 1, 0}}, Triangle{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}).hits[0].distance == 0);
}

TEST_CASE("A tangent touches once, and the next double beside it misses or hits twice") {
  const Ray ray{{0, 1, 5}, {0, 0, -1}};
  const Hits h = intersect(ray, Sphere{{0, 0, 0}, 1});
  REQUIRE(h.count == 1);
  CHECK(h.hits[0].distance == 5);
  CHECK(h.hits[0].point == Vec3{0, 1, 0});
  CHECK(h.hits[0].normal == Vec3{0, 1, 0});
  CHECK(intersect(ray, Sphere{{0, 0, 0}, std::nextafter(1.0, 0)}).count == 0);
  CHECK(intersect(ray, Sphere{{0, 0, 0}, std::nextafter(1.0, 2)}).count == 2);
}

TEST_CASE("A box is hit by its faces, and the face is named") {
  struct Row {
    Vec3 origin, direction;
    BoxFace in, out;
  };
  const Row rows[] = {{{5, 0, 0}, {-1, 0, 0}, BoxFace::maxX, BoxFace::minX},
                      {{-5, 0, 0}, {1, 0, 0}, BoxFace::minX, BoxFace::maxX},
                      {{0, 5, 0}, {0, -1, -0.0}, BoxFace::maxY, BoxFace::minY},
                      {{0, -5, 0}, {-0.0, 1, 0}, BoxFace::minY, BoxFace::maxY},
                      {{0, 0, 5}, {0, -0.0, -1}, BoxFace::maxZ, BoxFace::minZ},
                      {{0, 0, -5}, {0, 0, 1}, BoxFace::minZ, BoxFace::maxZ}};
  for (const Row& row : rows) {
    const Hits h = intersect(Ray{row.origin, row.direction}, kCube);
    REQUIRE(h.count == 2);
    CHECK(h.hits[0].distance == 4);
    CHECK(h.hits[1].distance == 6);
    CHECK(h.hits[0].face == row.in);
    CHECK(h.hits[1].face == row.out);
    CHECK(h.hits[0].normal == Vec3{-row.direction.x + 0.0, -row.direction.y + 0.0, -row.direction.z + 0.0});
    CHECK(h.hits[1].normal == Vec3{row.direction.x + 0.0, row.direction.y + 0.0, row.direction.z + 0.0});
  }
}

TEST_CASE("A triangle is not hit from within its plane, nor one of no area") {
  const Triangle t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK(intersect(Ray{{-1, 0.25, 0}, {1, 0, 0}}, t).count == 0);
  CHECK(intersect(Ray{{0.25, 0.25, 0}, {1, 0, 0}}, t).count == 0);
  CHECK(intersect(Ray{{1, 1, 1}, {0, 0, -1}}, Triangle{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}).count == 0);
  CHECK(intersect(Ray{{0, 0, 1}, {0, 0, -1}}, Triangle{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).count == 0);
}

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
