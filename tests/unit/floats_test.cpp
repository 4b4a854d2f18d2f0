// float32 in and out: batches in every shape, their bounds, and matrices for graphics APIs.
#include "viewproj/floats.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "catch.hpp"
#include "kernels.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool sameBits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

struct Trial {
  Camera camera;
  std::vector<float> x, y, z;
};

/// A camera of every lens, its eye near to and far from the origin and seldom a float32, and points of which some are
/// next to the eye, some beside it, some unusable.
Trial randomTrial(unsigned seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) { return Vec3{size * unit(random), size * unit(random), size * unit(random)}; };
  const double size = std::pow(10.0, 4 * unit(random)), away = size * std::pow(10.0, seed % 7);
  const Vec3 eye = seed % 11 == 0 ? Vec3{1, 0.25, -2} : vector(away);
  Pose pose = lookAlong(eye, vector(1), vector(1), Handedness::right);
  if (seed % 4 == 1) pose = poseFromCameraFromWorld(viewFromWorld(pose, {}), CameraAxes::RUB, Handedness::right);
  const double near = 0.01 * size;
  const Projection projection = seed % 3 == 0   ? orthographic(-size, size, -size, size, -size, 3 * size)
                                : seed % 3 == 1 ? perspectiveFovY(60, 1.5, near, seed % 2 ? kInfiniteFar : 100 * size)
                                                : frustum(-near, 2 * near, 0, near, near, 50 * size);
  const Viewport viewport{.width = 1920, .height = 1080.5, .x = 0.1 * seed, .y = -3};
  Trial trial{makeCamera(pose, projection, viewport, {.ndcZ = NdcZ::zeroToOne, .reverseZ = seed % 2 == 0}), {}, {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 offset = vector(size * std::pow(10.0, 2 * unit(random)));
    trial.x.push_back(static_cast<float>(eye.x + offset.x));
    trial.y.push_back(static_cast<float>(eye.y + offset.y));
    trial.z.push_back(static_cast<float>(eye.z + offset.z));
  }
  const float bad[] = {kNaN, INFINITY, 3e38f, 1e-42f};
  for (std::size_t i = 0; i < count / 50; ++i) trial.y[random() % count] = bad[random() % 4];
  for (std::size_t i = 0; i < count / 20; ++i) {  // the eye itself, as near as float32 is to it
    const std::size_t at = random() % count;
    trial.x[at] = static_cast<float>(eye.x);
    trial.y[at] = static_cast<float>(eye.y);
    trial.z[at] = std::nextafter(static_cast<float>(eye.z), INFINITY);
  }
  return trial;
}

struct Positions {
  std::vector<float> x, y, depth;
};

Positions separately(const Trial& t, Precision precision, BatchCounts* counts = nullptr) {
  const std::size_t n = t.x.size();
  Positions p{std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
  const BatchCounts all = worldToScreen(t.camera, FloatPoints{t.x.data(), t.y.data(), t.z.data(), n},
                                        FloatPositions{p.x.data(), p.y.data(), p.depth.data()}, precision);
  if (counts) *counts = all;
  return p;
}

constexpr Precision kPrecisions[] = {Precision::fast, Precision::standard, Precision::exact};

}  // namespace

TEST_CASE("Points of float32 have the same bits in every shape, of every size and with every kernel") {
  for (unsigned seed = 0; seed < 40; ++seed)
    for (const std::size_t count : {0u, 1u, 3u, 15u, 16u, 17u, 700u}) {
      const Trial t = randomTrial(seed, count);
      forceKernels(allKernels().front());
      BatchCounts portable;
      const Positions expected = separately(t, Precision::fast, &portable);
      forceKernels(nullptr);
      withEachKernel([&](const Kernels& kernel) {
        INFO("seed " << seed << ", " << count << " points, kernel " << kernel.name);
        BatchCounts counts;
        const Positions p = separately(t, Precision::fast, &counts);
        CHECK(counts.escalated == portable.escalated);
        const auto check = [&](const float* x, const float* y, const float* depth, std::size_t stride) {
          for (std::size_t i = 0; i < count; ++i) {
            INFO("point " << i << ", stride " << stride);
            REQUIRE(sameBits(x[stride * i], expected.x[i]));
            REQUIRE(sameBits(y[stride * i], expected.y[i]));
            REQUIRE(sameBits(depth[stride * i], expected.depth[i]));
          }
        };
        check(p.x.data(), p.y.data(), p.depth.data(), 1);
        for (const std::size_t stride : {3u, 4u, 8u}) {
          // Not a float more than there has to be.
          const std::size_t size = count == 0 ? 3 : stride * (count - 1) + 3;
          std::vector<float> buffer(size), results(size, -1);
          for (std::size_t i = 0; i < count; ++i) {
            buffer[stride * i] = t.x[i];
            buffer[stride * i + 1] = t.y[i];
            buffer[stride * i + 2] = t.z[i];
          }
          const FloatPoints points = vertices(buffer.data(), count, stride * sizeof(float));
          worldToScreen(t.camera, points, positions(results.data(), stride * sizeof(float)));
          check(results.data(), results.data() + 1, results.data() + 2, stride);
          for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 3; j < stride && stride * i + j < size; ++j) REQUIRE(results[stride * i + j] == -1);
          Positions apart = expected;
          worldToScreen(t.camera, points, FloatPositions{apart.x.data(), apart.y.data(), apart.depth.data()});
          check(apart.x.data(), apart.y.data(), apart.depth.data(), 1);
          worldToScreen(t.camera, points, positions(buffer.data(), stride * sizeof(float)));  // in place
          check(buffer.data(), buffer.data() + 1, buffer.data() + 2, stride);
        }
        Trial own = t;
        worldToScreen(t.camera, FloatPoints{own.x.data(), own.y.data(), own.z.data(), count},
                      FloatPositions{own.x.data(), own.y.data(), own.z.data()});
        check(own.x.data(), own.y.data(), own.z.data(), 1);
      });
    }
}

TEST_CASE("No vertices need no memory") {
  const Camera camera = randomTrial(1, 0).camera;
  for (const Precision precision : kPrecisions) {
    CHECK(worldToScreen(camera, vertices(nullptr, 0), positions(nullptr), precision).escalated == 0);
    CHECK(worldToScreen(camera, FloatPoints{}, FloatPositions{}, precision).escalated == 0);
  }
}

TEST_CASE("Vertices need not lie at addresses of float32") {
  const Trial t = randomTrial(4, 100);
  const Positions expected = separately(t, Precision::fast);
  constexpr std::size_t kStride = 17;
  std::vector<char> buffer(kStride * 100 + 1);
  for (std::size_t i = 0; i < 100; ++i) {
    const float vertex[] = {t.x[i], t.y[i], t.z[i]};
    std::memcpy(&buffer[kStride * i + 1], vertex, sizeof vertex);
  }
  const float* first = reinterpret_cast<const float*>(&buffer[1]);
  Positions p = expected;
  std::fill(p.x.begin(), p.x.end(), -1.0f);
  worldToScreen(t.camera, vertices(first, 100, kStride), FloatPositions{p.x.data(), p.y.data(), p.depth.data()});
  for (std::size_t i = 0; i < 100; ++i) CHECK(sameBits(p.x[i], expected.x[i]));
}

TEST_CASE("Coordinates in arrays of their own may lie some floats apart, and results at any address") {
  const Trial t = randomTrial(5, 100);
  const Positions expected = separately(t, Precision::fast);
  constexpr std::size_t kStep = 3, kStride = kStep * sizeof(float);
  std::vector<float> in[3] = {}, out[3] = {};
  for (std::size_t part = 0; part < 3; ++part) {
    const std::vector<float>& from = part == 0 ? t.x : part == 1 ? t.y : t.z;
    for (std::size_t i = 0; i < 100; ++i) in[part].insert(in[part].end(), {from[i], -1, -1});
    out[part].assign(in[part].size(), -2);
  }
  worldToScreen(t.camera, FloatPoints{in[0].data(), in[1].data(), in[2].data(), 100, kStride},
                FloatPositions{out[0].data(), out[1].data(), out[2].data(), kStride});
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK(sameBits(out[0][kStep * i], expected.x[i]));
    CHECK(sameBits(out[1][kStep * i], expected.y[i]));
    CHECK(sameBits(out[2][kStep * i], expected.depth[i]));
    for (const auto& array : out) CHECK((array[kStep * i + 1] == -2 && array[kStep * i + 2] == -2));
  }
}

TEST_CASE(
    "Results in float32 are within their bound, point by point and in the picture, and those of doubles rounded") {
  double worst[3] = {}, worstDepth[3] = {}, worstInPicture[3] = {};
  std::size_t bounded[3] = {}, inPicture = 0, none = 0, nextToTheEye = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Trial t = randomTrial(seed, 400);
    for (const Precision precision : kPrecisions) {
      const auto which = static_cast<std::size_t>(precision);
      const Positions p = separately(t, precision);
      const ErrorBound picture = floatBoundInPicture(t.camera, precision);
      for (std::size_t i = 0; i < t.x.size(); ++i) {
        const Vec3 point{t.x[i], t.y[i], t.z[i]};
        const ScreenPoint truth = worldToScreen(t.camera, point, Precision::exact);
        INFO("seed " << seed << ", point " << i << ", precision " << which);
        if (truth.status != PointStatus::inFront) {
          REQUIRE(std::isnan(p.x[i]));
          REQUIRE(std::isnan(p.y[i]));
          REQUIRE(std::isnan(p.depth[i]));
          ++none;
          continue;
        }
        if (precision != Precision::fast) {
          const ScreenPoint own = worldToScreen(t.camera, point, precision);
          REQUIRE(sameBits(p.x[i], static_cast<float>(own.x)));
          REQUIRE(sameBits(p.depth[i], static_cast<float>(own.depth)));
        }
        const ErrorBound bound = floatBoundOfPoint(t.camera, point, precision);
        const double error = std::max(std::fabs(p.x[i] - truth.x), std::fabs(p.y[i] - truth.y));
        const double depthError = std::fabs(p.depth[i] - truth.depth);
        CAPTURE(p.x[i], truth.x, p.y[i], truth.y, truth.viewDistance);
        REQUIRE(error <= bound.screen);
        REQUIRE(depthError <= bound.depth);
        if (std::isinf(bound.screen)) continue;
        ++bounded[which];
        worst[which] = std::max(worst[which], error / bound.screen);
        worstDepth[which] = std::max(worstDepth[which], depthError / bound.depth);
        nextToTheEye += static_cast<float>(t.camera.pose().eye().x) == t.x[i];
        if (!truth.visible() || std::isinf(picture.screen)) continue;
        ++inPicture;
        REQUIRE(error <= picture.screen);
        REQUIRE(depthError <= picture.depth);
        worstInPicture[which] = std::max(worstInPicture[which], error / picture.screen);
      }
    }
  }
  CAPTURE(worst[0], worst[1], worst[2], worstDepth[0], worstDepth[1], worstDepth[2], bounded[0], inPicture, none,
          nextToTheEye, worstInPicture[0]);
  CHECK(bounded[0] > 20000);
  CHECK(inPicture > 1000);
  CHECK(none > 10000);
  CHECK(nextToTheEye > 100);
  CHECK(worst[0] > 0.3);
  CHECK(worstDepth[0] > 0.3);
  for (const std::size_t rounded : {1u, 2u}) CHECK(worst[rounded] > 0.9);  // half a unit of float32 is all of it
}

TEST_CASE("A camera that float32 has no numbers for is projected exactly") {
  const Camera camera = makeCamera(lookAt({1e60, 0, 0}, {0, 0, 0}, {0, 1, 0}, Handedness::right),
                                   perspectiveFovY(60, 1.5, 1e50, kInfiniteFar), {600, 400});
  const float x[] = {1, 2}, y[] = {0, 1e30f}, z[] = {3, 4};
  float sx[2], sy[2], depth[2];
  const BatchCounts counts = worldToScreen(camera, FloatPoints{x, y, z, 2}, FloatPositions{sx, sy, depth});
  CHECK(counts.escalated == 2);
  for (int i = 0; i < 2; ++i) CHECK(sx[i] == static_cast<float>(worldToScreen(camera, Vec3{x[i], y[i], z[i]}).x));
}

TEST_CASE("Stored matrices are those of the camera's parts in the order of its convention, in float32 the nearest") {
  std::size_t checked = 0;
  for (unsigned seed = 0; seed < 60; ++seed)
    for (const Storage storage : {Storage::rowMajor, Storage::columnMajor})
      for (const Vectors vectors : {Vectors::row, Vectors::column}) {
        const Camera made = randomTrial(seed, 0).camera;
        Convention c = made.convention();
        c.storage = storage;
        c.vectors = vectors;
        const Camera camera = makeCamera(made.pose(), made.projection(), made.viewport(), c);
        const auto check = [&](const StoredMatrix<double>& doubles, const StoredMatrix<float>& floats, const Mat4& m) {
          REQUIRE(doubles == inStorageOrder(m, c));
          for (std::size_t i = 0; i < 16; ++i) {
            REQUIRE(floats[i] == static_cast<float>(doubles[i]));  // no entry here lies on a middle
            ++checked;
          }
        };
        const Pose pose = camera.pose();
        const Projection p = camera.projection();
        const Viewport& v = camera.viewport();
        check(viewFromWorld<double>(camera), viewFromWorld<float>(camera), viewFromWorld(pose, c));
        check(worldFromView<double>(camera), worldFromView<float>(camera), worldFromView(pose, c));
        check(clipFromView<double>(camera), clipFromView<float>(camera), clipFromView(p, c));
        check(viewFromClip<double>(camera), viewFromClip<float>(camera), viewFromClip(p, c));
        check(clipFromWorld<double>(camera), clipFromWorld<float>(camera), clipFromWorld(pose, p, c));
        check(worldFromClip<double>(camera), worldFromClip<float>(camera), worldFromClip(pose, p, c));
        check(screenFromWorld<double>(camera), screenFromWorld<float>(camera), screenFromWorld(pose, p, v, c));
        check(worldFromScreen<double>(camera), worldFromScreen<float>(camera), worldFromScreen(pose, p, v, c));
      }
  CHECK(checked > 10000);
}

TEST_CASE("An entry whose double is the middle of two float32 goes to the nearer of them") {
  // 2 near / width = 1 + 2^-24 + a little, whose nearest double is 1 + 2^-24 itself.
  constexpr double kMiddle = 1 + 0x1p-24;
  const double width = 2 / kMiddle;
  const double rest = std::fma(-width, kMiddle, 2.0);  // its sign is that of 2/width - middle
  REQUIRE(rest != 0);
  REQUIRE(2 / width == kMiddle);
  for (const bool above : {rest > 0, rest <= 0}) {
    // The other side by a width one double away, if its quotient still rounds to the middle.
    const double w = above == (rest > 0) ? width : std::nextafter(width, rest > 0 ? 3.0 : 1.0);
    if (2 / w != kMiddle) continue;
    const bool isAbove = std::fma(-w, kMiddle, 2.0) > 0;
    const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                     frustum(-w / 2, w / 2, -1, 1, 1, 10), {100, 100});
    const float entry = clipFromView<float>(camera)[0];
    CHECK(entry == (isAbove ? std::nextafter(1.0f, 2.0f) : 1.0f));
  }
}
