#include <cstdint>
#include <cstring>
#include <iostream>
#include <random>
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "kernels.hpp"
#include "parts.hpp"
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
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) { return Vec3{size * unit(random), size * unit(random), size * unit(random)}; };
  const double size = std::pow(10.0, 6 * unit(random));
  const Vec3 eye = vector(size);
  const Vec3 way = vector(1);
  Pose pose = lookAlong(eye, way, vector(1), Handedness::right);
  if (seed % 4 == 1) {
    const Mat4 view = viewFromWorld(pose, {});
    pose = poseFromCameraFromWorld(view, CameraAxes::RUB, Handedness::right);
  }
  const double near = 0.01 * size;
  const Projection projection = seed % 3 == 0 ? orthographic(-size, size, -size, size, -size, 3 * size)
                                : seed % 3 == 1
                                    ? perspective(60, 1, seed % 5 ? near : 0, seed % 2 ? kInfiniteFar : 100 * size)
                                    : frustum(-near, 2 * near, 0, near, near, 50 * size);
  Trial trial{makeCamera(pose, projection, {1000, 1000}), {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 offset = vector(size * std::pow(10.0, 2 * unit(random)));
    trial.points.push_back({eye.x + offset.x, eye.y + offset.y, eye.z + offset.z});
  }
  const double bad[] = {NAN, INFINITY, 1e300, 1e-310};
  for (std::size_t i = 0; i < count / 50; ++i) trial.points[random() % count][random() % 3] = bad[random() % 4];
  if (count > 10) trial.points[10] = eye;
  return trial;
}

}  // namespace

TEST_CASE("A batch gives the bits of single points, in every precision, of every size and with every kernel") {
  std::size_t escalated = 0;
  int kernels = 0;
  for (unsigned seed = 0; seed < 60; ++seed)
    for (const std::size_t count : {0u, 1u, 2u, 3u, 7u, 8u, 9u, 500u}) {
      const Trial trial = randomTrial(seed, count);
      for (Precision precision : kPrecisions) {
        std::vector<ScreenPoint> singles;
        for (const Vec3& point : trial.points) singles.push_back(worldToScreen(trial.camera, point, precision));
        kernels = withEachKernel([&](const Kernels& kernel) {
          std::vector<Vec3> screen(count);
          escalated += worldToScreen(trial.camera, trial.points, screen, precision).escalated;
          for (std::size_t i = 0; i < count; ++i) {
            INFO("seed " << seed << ", point " << i << " of " << count << ", precision " << int(precision)
                         << ", kernel " << kernel.name);
            REQUIRE(sameBits(screen[i], {singles[i].x, singles[i].y, singles[i].depth}));
          }
        });
      }
    }
  CHECK(escalated > 1000);
  CHECK(kernels > 1);
}

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

TEST_CASE("A batch in full is what single points are: distance, status and sides as well") {
  const auto same = [](const ScreenPoint& a, const ScreenPoint& b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.depth, b.depth) &&
           sameBits(a.viewDistance, b.viewDistance) && a.status == b.status && a.outside == b.outside &&
           a.certain == b.certain && a.precision == b.precision;
  };
  std::size_t byStatus[4] = {}, escalated = 0;
  for (unsigned seed = 0; seed < 60; ++seed)
    for (const std::size_t count : {0u, 1u, 9u, 300u, 600u}) {
      const Trial trial = randomTrial(seed, count);
      std::vector<ScreenPoint> screen(count);
      for (Precision precision : kPrecisions) {
        std::vector<ScreenPoint> singles;
        for (const Vec3& point : trial.points) singles.push_back(worldToScreen(trial.camera, point, precision));
        withEachKernel([&](const Kernels& kernel) {
          escalated += worldToScreen(trial.camera, trial.points, screen, precision).escalated;
          INFO("seed " << seed << ", precision " << int(precision) << ", kernel " << kernel.name);
          for (std::size_t i = 0; i < count; ++i) {
            INFO("point " << i << " of " << count);
            REQUIRE(same(screen[i], singles[i]));
          }
        });
        for (const ScreenPoint& p : singles) ++byStatus[int(p.status)];
      }
    }
  CAPTURE(escalated);
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

TEST_CASE("Every kernel that this processor supports gives the same bits") {
  // What a kernel leaves over is settled as a batch does.
  struct Run {
    std::vector<Vec3> screen;
    std::vector<double> distance;
  };
  std::size_t compared = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Trial trial = randomTrial(seed, 1003);
    const std::size_t count = trial.points.size();
    for (Precision precision : kPrecisions) {
      std::vector<Run> runs;
      for (const Kernels* k : supportedKernels()) {
        Run run{std::vector<Vec3>(count), std::vector<double>(count)};
        std::vector<std::uint64_t> unsettled(count / 64 + 1);
        const auto kernel = precision == Precision::standard ? k->standard : k->exact;
        kernel(parts(trial.camera).constants, &trial.points[0].x, &run.screen[0].x,
               seed % 2 ? run.distance.data() : nullptr, count, unsettled.data());
        for (std::size_t i = 0; i < count; ++i) {
          if (!(unsettled[i / 64] >> i % 64 & 1)) continue;
          const ScreenPoint p = worldToScreen(trial.camera, trial.points[i]);
          run.screen[i] = {p.x, p.y, p.depth};
          run.distance[i] = p.viewDistance;
        }
        runs.push_back(std::move(run));
      }
      for (const Run& run : runs) {
        INFO("seed " << seed << ", precision " << int(precision));
        for (std::size_t i = 0; i < count; ++i) {
          REQUIRE(sameBits(run.screen[i], runs[0].screen[i]));
          REQUIRE(sameBits(run.distance[i], runs[0].distance[i]));
        }
        ++compared;
      }
    }
  }
  CAPTURE(compared);
  CHECK(compared >= 240);
}

TEST_CASE("Every kernel that this processor supports casts the same rays, to the bit") {
  struct Run {
    std::vector<Vec3> directions;
    std::size_t settled = 0;
  };
  std::size_t compared = 0, settled = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Trial trial = randomTrial(seed, 1);
    if (parts(trial.camera).projection.orthographic) continue;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> anywhere(-3000, 3000);
    std::vector<Vec2> pixels(123);
    for (Vec2& pixel : pixels) pixel = {anywhere(random), anywhere(random)};
    pixels[5] = {NAN, 1};
    pixels[6] = {1e70, -1e90};
    std::vector<Run> runs;
    for (const Kernels* k : supportedKernels()) {
      Run run{std::vector<Vec3>(pixels.size())};
      std::uint64_t unsettled[2] = {};
      k->rays(parts(trial.camera).constants, &pixels[0].x, &run.directions[0].x, pixels.size(), unsettled);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (!(unsettled[i / 64] >> i % 64 & 1)) continue;
        run.directions[i] = screenToRay(trial.camera, pixels[i], Precision::standard).direction;
        ++run.settled;
      }
      runs.push_back(std::move(run));
    }
    for (const Run& run : runs) {
      INFO("seed " << seed);
      for (std::size_t i = 0; i < pixels.size(); ++i) REQUIRE(sameBits(run.directions[i], runs[0].directions[i]));
      settled += run.settled;
      ++compared;
    }
  }
  CAPTURE(compared, settled);
  CHECK(compared >= 80);
  CHECK(settled >= compared);
  CHECK(settled < 20 * compared);
}

TEST_CASE("A batch of rays gives the bits of single rays") {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Trial trial = randomTrial(seed, 1);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> anywhere(-3000, 3000);
    std::vector<Vec2> pixels(1100);  // more than are cast at once
    for (Vec2& pixel : pixels) pixel = {anywhere(random), anywhere(random)};
    pixels[5] = {NAN, 1};
    pixels[6] = {1e70, -1e90};
    pixels[600] = {1e70, -1e90};
    pixels[1099] = {NAN, 1};
    withEachKernel([&](const Kernels& kernel) {
      std::vector<Vec3> directions(pixels.size());
      screenToRayDirections(trial.camera, pixels, directions);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        INFO("seed " << seed << ", pixel " << i << ", kernel " << kernel.name);
        if (parts(trial.camera).projection.orthographic && std::isnan(pixels[i].x))
          continue;  // a direction that no pixel changes
        REQUIRE(sameBits(directions[i], screenToRay(trial.camera, pixels[i], Precision::standard).direction));
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
