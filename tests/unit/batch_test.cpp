#include <cstdint>
#include <cstring>
#include <iostream>
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "kernels.hpp"
#include "parts.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

constexpr Precision kPrecisions[] = {Precision::standard, Precision::exact};

bool sameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }
bool sameBits(const Vec3& a, const Vec3& b) { return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z); }

struct Trial {
  Camera camera;
  std::vector<Vec3> points;
};

/// A camera of every lens and pose now and then, and points in, around and behind its view, some of them unusable.
Trial randomTrial(unsigned seed, std::size_t count) {
  Random random(seed);
  const double size = random.logUniform(1e-6, 1e6);
  const Vec3 eye = random.vector(size), way = random.vector(1);
  Pose pose = lookAlong(eye, way, random.vector(1), Handedness::right);
  if (seed % 4 == 1) {
    const Mat4 view = viewFromWorld(pose, {});
    pose = poseFromCameraFromWorld(view, CameraAxes::RUB);
  }
  const double near = 0.01 * size;
  const Projection projection = seed % 3 == 0 ? orthographic(-size, size, -size, size, -size, 3 * size)
                                : seed % 3 == 1
                                    ? perspective(60, 1, seed % 5 ? near : 0, seed % 2 ? kInfiniteFar : 100 * size)
                                    : frustum(-near, 2 * near, 0, near, near, 50 * size);
  Trial trial{makeCamera(pose, projection, {1000, 1000}), {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 offset = random.vector(size * random.logUniform(0.01, 100));
    trial.points.push_back({eye.x + offset.x, eye.y + offset.y, eye.z + offset.z});
  }
  const double bad[] = {NAN, INFINITY, 1e300, 1e-310};
  for (std::size_t i = 0; i < count / 50; ++i) trial.points[random.below(count)][random.below(3)] = random.oneOf(bad);
  if (count > 10) trial.points[10] = eye;
  return trial;
}

}  // namespace

TEST_CASE("The best of the supported kernels is used, unless another is forced, and that one then is") {
  const Kernels* last = nullptr;
  withEachKernel([&](const Kernels& kernel) {
    CHECK(&kernels() == &kernel);
    last = &kernel;
  });
  CHECK(&kernels() == last);
}

// For processors.sh, under a processor that lacks this or that.
TEST_CASE("Which kernel is used here", "[.kernel]") {
  std::cout << "kernel " << kernels().name << '\n';
  withEachKernel([&](const Kernels& kernel) { std::cout << "supports " << kernel.name << '\n'; });
}

TEST_CASE("Points that are settled one by one are counted in every block of a batch") {
  const Camera camera = makeCamera(lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right),
                                   perspective(60, 1.5, 0.1, 100), {600, 400});
  const std::vector<Vec3> points(5000, Vec3{1e250, 2e250, -1e251});  // beyond every kernel's reach
  std::vector<Vec3> screen(points.size());
  std::vector<ScreenPoint> full(points.size());
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    CHECK(worldToScreen(camera, points, screen, precision).escalated == points.size());
    CHECK(worldToScreen(camera, points, full, precision).escalated == points.size());
    std::vector<Vec3> inPlace = points;
    CHECK(worldToScreen(camera, inPlace, inPlace, precision).escalated == points.size());
  }
}

TEST_CASE("A batch gives the bits of single points, in every precision, of every size and with every kernel") {
  const auto same = [](const ScreenPoint& a, const ScreenPoint& b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.depth, b.depth) &&
           sameBits(a.viewDistance, b.viewDistance) && a.status == b.status && a.outside == b.outside &&
           a.certain == b.certain && a.precision == b.precision;
  };
  std::size_t byStatus[5] = {}, escalated = 0;
  for (unsigned seed = 0; seed < 60; ++seed)
    for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 600u}) {
      const Trial trial = randomTrial(seed, count);
      std::vector<ScreenPoint> screen(count);
      std::vector<Vec3> positions(count);
      for (Precision precision : kPrecisions) {
        std::vector<ScreenPoint> singles;
        for (const Vec3& point : trial.points) singles.push_back(worldToScreen(trial.camera, point, precision));
        withEachKernel([&](const Kernels& kernel) {
          escalated += worldToScreen(trial.camera, trial.points, screen, precision).escalated;
          worldToScreen(trial.camera, trial.points, positions, precision);
          INFO("seed " << seed << ", precision " << int(precision) << ", kernel " << kernel.name);
          for (std::size_t i = 0; i < count; ++i) {
            INFO("point " << i << " of " << count);
            REQUIRE(same(screen[i], singles[i]));
            REQUIRE(sameBits(positions[i], {singles[i].x, singles[i].y, singles[i].depth}));
          }
        });
        for (const ScreenPoint& p : singles) ++byStatus[int(p.status)];
      }
    }
  CHECK(escalated > 1000);
  CHECK(byStatus[int(PointStatus::inFront)] > 10000);
  CHECK(byStatus[int(PointStatus::behind)] > 10000);
  CHECK(byStatus[int(PointStatus::outOfRange)] > 500);
  CHECK(escalated < 30000 * allKernels().size());
}

TEST_CASE("A batch may be projected in place") {
  for (Precision precision : kPrecisions) {
    Trial trial = randomTrial(7, 1000);
    std::vector<Vec3> apart(trial.points.size());
    worldToScreen(trial.camera, trial.points, apart, precision);
    worldToScreen(trial.camera, trial.points, trial.points, precision);
    for (std::size_t i = 0; i < apart.size(); ++i) REQUIRE(sameBits(apart[i], trial.points[i]));
  }
}

TEST_CASE("A batch of rays gives the bits of single rays") {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Trial trial = randomTrial(seed, 1);
    Random random(seed);
    std::vector<Vec2> pixels(1100);  // more than are cast at once
    for (Vec2& pixel : pixels) pixel = {random.uniform(-3000, 3000), random.uniform(-3000, 3000)};
    pixels[5] = {NAN, 1};
    pixels[6] = {1e40, -1e45};
    pixels[600] = {1e40, -1e45};
    pixels[1099] = {NAN, 1};
    withEachKernel([&](const Kernels& kernel) {
      std::vector<Vec3> directions(pixels.size());
      screenToRayDirections(trial.camera, pixels, directions);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        INFO("seed " << seed << ", pixel " << i << ", kernel " << kernel.name);
        if (parts(trial.camera).projection.orthographic && std::isnan(pixels[i].x))
          continue;  // a direction that no pixel changes
        REQUIRE(sameBits(directions[i], screenToRay(trial.camera, pixels[i]).direction));
      }
    });
  }
}

TEST_CASE("Without a near plane points have the same pixels, at the same speed, and no depth") {
  std::size_t points = 0, nearer = 0, certain = 0, behind = 0;
  for (unsigned seed = 1; seed < 240; ++seed) {
    const Trial trial = randomTrial(seed, 400);
    const Projection& p = trial.camera.projection();
    if (p.isOrthographic() || p.zNear() == 0) continue;
    Convention c = conventionPresets()[seed % conventionPresets().size()].convention;
    c.world = Handedness::right;
    const auto withNear = [&](double near) {
      return makeCamera(trial.camera.pose(),
                        perspectiveWindow(p.left(), p.right(), p.bottom(), p.top(), near, p.zFar()),
                        trial.camera.viewport(), c);
    };
    const Camera with = withNear(p.zNear()), without = withNear(0);
    for (const Precision precision : kPrecisions) {
      std::vector<ScreenPoint> expected(trial.points.size()), got(trial.points.size());
      withEachKernel([&](const Kernels&) {
        const std::size_t escalated = worldToScreen(with, trial.points, expected, precision).escalated;
        CHECK(worldToScreen(without, trial.points, got, precision).escalated <= escalated);
      });
      for (std::size_t i = 0; i < got.size(); ++i) {
        const ScreenPoint &a = got[i], &b = expected[i];
        INFO("seed " << seed << ", point " << i << ", precision " << int(precision));
        REQUIRE((sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.viewDistance, b.viewDistance)));
        REQUIRE(std::isnan(a.depth));
        REQUIRE(a.status == b.status);
        REQUIRE(a.outside == (b.outside & ~sideNear));
        REQUIRE(a.certain >= b.certain);
        const ErrorBound bound = boundOfPoint(without, trial.points[i], precision);
        REQUIRE(bound.screen == boundOfPoint(with, trial.points[i], precision).screen);
        REQUIRE(bound.depth == INFINITY);
        ++points;
        nearer += (b.outside & sideNear) != 0;
        certain += a.certain;
        behind += a.status == PointStatus::behind;
      }
      const ErrorBound picture = boundInPicture(without, precision);
      CHECK((precision == Precision::exact || parts(without).constants.residualReach == 0) ==
            (picture.screen == boundInPicture(with, precision).screen));
      CHECK(picture.depth == INFINITY);
    }
  }
  CHECK((points > 50000 && nearer > 100 && certain > 10000 && behind > 10000));
}
