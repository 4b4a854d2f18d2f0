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

TEST_CASE("Exact projection is within 0.51 ulp for every kind of camera") {
  std::map<std::pair<int, int>, int> visited;
  int behind = 0, outside = 0, visible = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Scene scene = randomScene(random, random.spread(1e-3, 1e12));
    const Truth truth(scene);
    const Camera camera = build(scene);
    ++visited[{int(scene.poseKind), int(scene.lensKind)}];
    INFO("trial " << trial << ": " << describe(scene));
    for (int i = 0; i < 5; ++i) {
      Vec3 point = pointInView(random, truth, i < 3 ? 1 : 5);
      if (i == 4) {  // behind the eye
        for (std::size_t k = 0; k < 3; ++k) point[k] = double(truth.pose.eye[k] * Real(2) - Real(point[k]));
      }
      const Truth::View view = truth.view(toReal(point));
      const ScreenPoint got = worldToScreen(camera, point);
      REQUIRE(isExact(got.viewDistance, view.forward, scene.near));
      if (!truth.lens.orthographic && !(view.forward > Real(0))) {
        ++behind;
        REQUIRE(got.status == PointStatus::behind);
        REQUIRE(std::isnan(got.x));
        continue;
      }
      const Truth::Screen screen = truth.screen(view);
      REQUIRE(got.status == PointStatus::inFront);
      (got.visible() ? visible : outside)++;
      const double size = std::max(scene.viewport.width, scene.viewport.height);
      REQUIRE(isExact(got.x, screen.x, size));
      REQUIRE(isExact(got.y, screen.y, size));
      REQUIRE(isExact(got.depth, screen.depth, std::fabs(scene.viewport.depthSecond - scene.viewport.depthFirst)));
    }
  }
  CAPTURE(behind, outside, visible);
  CHECK(visited.size() == std::size(kPoseKinds) * std::size(kLensKinds));
  CHECK(behind > 1000);
  CHECK(outside > 1000);
  CHECK(visible > 1000);
}

TEST_CASE("Ray directions are within the bound, and exact ones within 0.51 ulp, for every kind of camera") {
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial + 1000000);
    const Scene scene = randomScene(random, random.spread(1e-3, 1e12));
    const Truth truth(scene);
    const Camera camera = build(scene);
    INFO("trial " << trial << ": " << describe(scene));
    const Viewport& v = camera.viewport();
    for (int i = 0; i < 3; ++i) {
      const Vec2 pixel{v.x + v.width * random.uniform(0, 1), v.y + v.height * random.uniform(0, 1)};
      const Truth::Window window = truth.window(pixel.x, pixel.y);
      const Real3 direction = truth.direction(window);
      const Ray exact = screenToRay(camera, pixel, Precision::exact);
      const Ray standard = screenToRay(camera, pixel, Precision::standard);
      REQUIRE(angle(toReal(standard.direction), direction) <= kRayDirectionBound);
      REQUIRE(angle(toReal(exact.direction), direction) <= kRayDirectionBound);
      const Real3 unitDirection = unit(direction);
      const Real3 origin = truth.lens.orthographic ? truth.pointAt(window, 0) : truth.pose.eye;
      const double size = std::max({maxAbs(parts(camera).pose.eye), std::fabs(scene.left), std::fabs(scene.right)});
      for (std::size_t k = 0; k < 3; ++k) {
        REQUIRE(isExact(exact.direction[k], unitDirection[k], 1e-3));
        REQUIRE(isExact(exact.origin[k], origin[k], size * 1e-3));
      }
    }
  }
}

TEST_CASE("A point comes back from its screen position and its window depth as nearly as the depth tells") {
  int beyond = 0, points = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial + 2000000);
    const Scene scene = randomScene(random, random.spread(1e-3, 1e6));
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
    Scene scene = randomScene(random, random.spread(1, 1e12));
    scene.lensKind = LensKind::fovY;
    scene.fov = 60;
    scene.viewport = {1920, 1080};
    scene.shiftX = scene.shiftY = 0;
    scene.hasCrop = false;
    scene.near = random.spread(1e-3, 1e3);
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
