// Random cameras of every pose, lens and convention against 480-bit arithmetic.
#include <map>

#include "catch.hpp"
#include "internals.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

constexpr std::uint64_t kTrials = 4000;

}  // namespace

TEST_CASE("A point comes back from its screen position and its window depth as nearly as the depth tells") {
  int beyond = 0, points = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial + 2000000);
    const Scene scene = randomScene(random, random.logUniform(1e-3, 1e6));
    const Truth truth(scene);
    const Camera camera = build(scene);
    INFO("trial " << trial << ": " << describe(scene));
    for (int i = 0; i < 3; ++i) {
      const ScreenPoint screen = worldToScreen(camera, pointInView(random, truth));
      const WorldPoint got = screenToWorld(camera, {screen.x, screen.y}, screen.depth);
      const Real distanceTruth = truth.distanceAt(screen.depth);
      if (got.status != DepthStatus::point) {
        ++beyond;  // the depth has rounded to that of infinity
        REQUIRE((!(distanceTruth > Real(0)) || screen.depth == parts(camera).depthAtInfinity ||
                 std::isinf(double(distanceTruth))));
        continue;
      }
      ++points;
      const Real3 want = truth.pointAt(truth.window(screen.x, screen.y), distanceTruth);
      const double size =
          std::max({maxAbs(parts(camera).pose.eye), std::fabs(double(distanceTruth)), std::fabs(scene.left)});
      for (std::size_t k = 0; k < 3; ++k) {
        CAPTURE(k, got.position[k], double(want[k]), screen.depth);
        REQUIRE(isExact(got.position[k], want[k], size));
      }
      const WorldPoint byDistance = screenToWorldAtDistance(camera, {screen.x, screen.y}, screen.viewDistance);
      const Real3 wantByDistance = truth.pointAt(truth.window(screen.x, screen.y), screen.viewDistance);
      for (std::size_t k = 0; k < 3; ++k) REQUIRE(isExact(byDistance.position[k], wantByDistance[k], size));
    }
  }
  CAPTURE(beyond, points);
  CHECK(points > 10000);
}

TEST_CASE("Standard projection is within 1e-12 pixels at 60 degrees and 1080p with the eye up to 1e12 away") {
  int asked = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial + 3000000);
    Scene scene = randomScene(random, random.logUniform(1, 1e12));
    scene.lensKind = LensKind::fovY;
    scene.fov = 60;
    scene.viewport = {1920, 1080};
    scene.shiftX = scene.shiftY = 0;
    scene.hasCrop = false;
    scene.near = random.logUniform(1e-3, 1e3);
    scene.far = kInfiniteFar;
    const Truth truth(scene);
    const Camera camera = build(scene);
    for (int i = 0; i < 5; ++i) {
      const Vec3 point = pointInView(random, truth);
      const ScreenPoint got = worldToScreen(camera, point, Precision::standard);
      // Next to a far eye the nearest doubles may lie off screen or behind.
      if (!got.visible()) continue;
      const Truth::Screen screen = truth.screen(truth.view(toReal(point)));
      INFO("trial " << trial << ": " << describe(scene));
      ++asked;
      REQUIRE(distance(got.x, screen.x) <= 1e-12);
      REQUIRE(distance(got.y, screen.y) <= 1e-12);
    }
  }
  CHECK(asked > 1000);
}
