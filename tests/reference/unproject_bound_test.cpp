// How much a window depth says about a point.
#include "catch.hpp"
#include "internals.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

TEST_CASE("A point from its rounded window depth is within the bound it comes with, and the bound is no excuse") {
  int points = 0, infinite = 0, tight = 0;
  for (std::uint64_t trial = 0; trial < 4000; ++trial) {
    Random random(trial + 4000000);
    const Scene scene = randomScene(random, random.logUniform(1e-3, 1e6));
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Viewport& v = camera.viewport();
    for (int i = 0; i < 4; ++i) {
      const Vec2 pixel{v.x + v.width * random.uniform(0, 1), v.y + v.height * random.uniform(0, 1)};
      const double far = std::isinf(scene.far) ? scene.near * 1e17 : scene.far;
      const double distance =
          truth.lens.orthographic ? random.uniform(scene.near, far) : random.logUniform(scene.near, far);
      const Truth::Window window = truth.window(pixel.x, pixel.y);
      const Real3 want = truth.pointAt(window, distance);
      const Real h = truth.lens.orthographic ? window.right : window.right * Real(distance);
      const Real u = truth.lens.orthographic ? window.up : window.up * Real(distance);
      const double depth = double(truth.screen({h, u, distance}).depth);
      const WorldPoint got = screenToWorld(camera, pixel, depth);
      INFO("trial " << trial << ": " << describe(scene) << ", distance " << distance << ", depth " << depth);
      if (got.status != DepthStatus::point || std::isinf(got.bound)) {
        ++infinite;
        continue;
      }
      ++points;
      const double error = double(length(toReal(got.position) - want));
      REQUIRE(error <= got.bound);
      tight += error > 0.1 * got.bound;
    }
  }
  CAPTURE(points, infinite, tight);
  CHECK(points > 5000);
  CHECK(infinite > 100);
  CHECK(tight > points / 4);
}
