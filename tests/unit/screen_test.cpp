#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "parts.hpp"
#include "records/model.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

constexpr std::array kPrecisions{Precision::standard, Precision::exact};

/// Looks along -z from the origin; 90 degrees high, so that the edges lie at x = +-2z, y = +-z.
Camera plainCamera(double near = 1, double far = 10, Convention convention = {}) {
  return makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                    frustum(-2 * near, 2 * near, -near, near, near, far), {200, 100}, convention);
}

Camera orthographicCamera() {
  return makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right), orthographic(-2, 2, -1, 1, -5, 5),
                    {200, 100});
}

std::array<double, 4> times(const Mat4& m, const Vec4& v) {
  std::array<double, 4> r{};
  for (std::size_t i = 0; i < 4; ++i) r[i] = m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z + m[i][3] * v.w;
  return r;
}

}  // namespace

TEST_CASE("The corners of the view land in the corners of the picture, and count as inside") {
  for (Precision precision : kPrecisions)
    for (double pixelCenter : {0.5, 0.0})
      for (double z : {1.0, 10.0})
        for (double right : {-1.0, 1.0})
          for (double up : {-1.0, 1.0}) {
            const Camera plain = plainCamera();
            const Viewport v{.width = 200, .height = 100, .pixelCenter = pixelCenter};
            const Camera camera = makeCamera(plain.pose(), plain.projection(), v, {});
            const ScreenPoint p = worldToScreen(camera, Vec3{2 * right * z, up * z, -z}, precision);
            INFO(right << " " << up << " at " << z << ", pixel centres at " << pixelCenter);
            CHECK(p.x == 100 + 100 * right + (pixelCenter - 0.5));
            CHECK(p.y == 50 - 50 * up + (pixelCenter - 0.5));
            CHECK(p.depth == (z == 1 ? 0.0 : 1.0));
            CHECK(p.viewDistance == z);
            CHECK(p.visible());
          }
}

TEST_CASE("What lies beyond a side is named by that side, in every convention") {
  struct Row {
    Vec3 point;
    unsigned outside;
  };
  const Row rows[] = {
      {{-5, 0, -2}, sideLeft},
      {{5, 0, -2}, sideRight},
      {{0, -3, -2}, sideBottom},
      {{0, 3, -2}, sideTop},
      {{0, 0, -0.5}, sideNear},
      {{0, 0, -10.5}, sideFar},
      {{-50, 30, -11}, sideLeft | sideTop | sideFar},
  };
  for (const ConventionPreset& preset : conventionPresets()) {
    Convention c = preset.convention;
    c.world = Handedness::right;
    for (Precision precision : kPrecisions)
      for (Origin origin : {Origin::topLeft, Origin::bottomLeft})
        for (const Row& row : rows) {
          const Camera plain = plainCamera();
          const Viewport v{.width = 200, .height = 100, .origin = origin};
          INFO(preset.name << (origin == Origin::topLeft ? " from the top" : " from the bottom"));
          CHECK(worldToScreen(makeCamera(plain.pose(), plain.projection(), v, c), row.point, precision).outside ==
                row.outside);
        }
  }
}

TEST_CASE("An infinite far has no far side") {
  const ScreenPoint p = worldToScreen(plainCamera(1, kInfiniteFar), Vec3{0, 0, -1e90});
  CHECK(p.visible());
  CHECK(p.depth == 1);
}

TEST_CASE("On or behind the eye plane there is no screen position, and the distance tells how far behind") {
  for (Precision precision : kPrecisions)
    for (double z : {0.0, 1.0, 1e-300}) {
      const ScreenPoint p = worldToScreen(plainCamera(), Vec3{0.5, 0.25, z}, precision);
      INFO(z);
      CHECK(p.status == PointStatus::behind);
      CHECK(std::isnan(p.x));
      CHECK(std::isnan(p.y));
      CHECK(std::isnan(p.depth));
      CHECK(p.viewDistance == -z);
      CHECK_FALSE(p.visible());
    }
}

TEST_CASE("An orthographic camera never says behind") {
  for (Precision precision : kPrecisions) {
    const ScreenPoint p = worldToScreen(orthographicCamera(), Vec3{1, 0.5, 3}, precision);
    CHECK(p.x == 150);
    CHECK(p.y == 25);
    CHECK(p.viewDistance == -3);
    CHECK(p.depth == Approx(0.2).epsilon(precision == Precision::exact ? 1e-300 : 1e-15));
    CHECK(p.visible());
  }
}

TEST_CASE("A direction has no screen position in an orthographic camera, but sides it leaves through") {
  const ScreenPoint p = worldToScreen(orthographicCamera(), Vec4{1, 0, -1, 0});
  CHECK(p.status == PointStatus::atInfinity);
  CHECK(p.outside == (sideRight | sideFar));
  CHECK(worldToScreen(orthographicCamera(), Vec4{-1, 1, 0, 0}).outside == (sideLeft | sideTop));
  CHECK(worldToScreen(orthographicCamera(), Vec4{0, -1, 1, 0}).outside == (sideBottom | sideNear));
}

TEST_CASE("A NaN or an infinity in any coordinate of a point is said, not computed with") {
  for (double bad : {double(NAN), double(INFINITY), -double(INFINITY)})
    for (int i = 0; i < 4; ++i)
      for (Precision precision : kPrecisions) {
        double v[4] = {1, 2, -3, 1};
        v[i] = bad;
        CHECK(worldToScreen(plainCamera(), Vec4{v[0], v[1], v[2], v[3]}, precision).status == PointStatus::outOfRange);
        if (i < 3)
          CHECK(worldToScreen(plainCamera(), Vec3{v[0], v[1], v[2]}, precision).status == PointStatus::outOfRange);
      }
  CHECK(worldToScreen(plainCamera(), Vec4{0, 0, 0, 0}).status == PointStatus::outOfRange);
}

TEST_CASE("A point that is not finite has a number at no stage") {
  for (const Vec4& point : {Vec4{NAN, 0, -2, 1}, Vec4{0, INFINITY, -2, 1}}) {
    CHECK(worldToScreen(plainCamera(), point).status == PointStatus::outOfRange);
    for (const Vec3& v : {worldToView(plainCamera(), point, {}), worldToNdc(plainCamera(), point, {})})
      CHECK((std::isnan(v.x) && std::isnan(v.y) && std::isnan(v.z)));
    const Vec4 clip = worldTo(plainCamera(), Space::clip, point, {});
    CHECK((std::isnan(clip.x) && std::isnan(clip.y) && std::isnan(clip.z) && std::isnan(clip.w)));
  }
}

TEST_CASE(
    "A point whose weight takes it almost out of range lies where its direction does, turned if the weight is below "
    "0") {
  // x / -z = 2/3 of an edge at 2, y / -z = 1/3 of an edge at 1: a third of half the width and of half the height.
  for (double sign : {1.0, -1.0}) {
    const Vec4 far{sign * 2e70, sign * 1e70, sign * -3e70, sign * 1e-20};
    const ScreenPoint p = worldToScreen(plainCamera(), far);
    CHECK(p.x == closely(100 + 100.0 / 3));
    CHECK(p.y == closely(50 - 50.0 / 3));
    CHECK(p.depth == closely(10.0 / 9));  // of infinity
  }
  CHECK(worldToScreen(plainCamera(), Vec4{2e70, 1e70, -3e70, -1e-20}).status == PointStatus::behind);
}

TEST_CASE("A weighted point has the bound of exact, whatever the precision") {
  for (Precision precision : {Precision::standard, Precision::exact}) {
    const ErrorBound weighted = boundOfPoint(plainCamera(), Vec4{2, 1, -6, 2}, precision);
    const ErrorBound plain = boundOfPoint(plainCamera(), Vec3{1, 0.5, -3}, Precision::exact);
    CHECK(weighted.screen == plain.screen);
    CHECK(boundOfPoint(plainCamera(), Vec4{1, 0.5, -3, 1}, precision).screen ==
          boundOfPoint(plainCamera(), Vec3{1, 0.5, -3}, precision).screen);
  }
}

TEST_CASE("A vanishing point lies beyond a far that is finite, and beyond none") {
  for (const double far : {100.0, kInfiniteFar}) {
    const Camera camera = makeCamera(lookAlong({1, 2, 3}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                     perspective(90, 2, 1, far), {200, 100});
    CHECK(worldToScreen(camera, Vec4{0, 0, -1, 0}).outside == (far == 100 ? sideFar : 0));
    CHECK(worldToScreen(camera, Vec4{0, 0, -1e-300, 0}).outside == (far == 100 ? sideFar : 0));
  }
}

TEST_CASE("A depth of an orthographic camera is that share of the way from near to far") {
  const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                   orthographic(-2, 2, -1, 1, 1, 9), {200, 100});
  CHECK(screenToWorld(camera, {100, 50}, 0.25).position == Vec3{0, 0, -3});
  const Camera huge = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                 orthographic(-2, 2, -1, 1, 0x1p290, 9 * 0x1p290), {200, 100});
  CHECK(screenToWorld(huge, {100, 50}, 0.25).position == Vec3{0, 0, -3 * 0x1p290});
}

TEST_CASE("A pixel's point at the ends of the range is the one nearby, brought there") {
  const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0.3, -0.7, -1}, {0, 1, 0}, Handedness::right),
                                   perspective(50, 2, 1, kInfiniteFar), {200, 100});
  for (int i = 0; i < 200; ++i) {
    const Vec2 pixel{i * 0.97, i * 0.49};
    const Vec3 near = screenToWorldAtDistance(camera, pixel, 1.1).position;
    for (const int power : {-290, 290}) {
      INFO(i << ", 2^" << power);
      const Vec3 there = screenToWorldAtDistance(camera, pixel, std::ldexp(1.1, power)).position;
      CHECK(there == Vec3{std::ldexp(near.x, power), std::ldexp(near.y, power), std::ldexp(near.z, power)});
    }
  }
}

TEST_CASE("A viewport takes all of NDC's depth to all of its own") {
  Convention convention;
  convention.ndcZ = NdcZ::zeroToOne;
  const Mat4 zeroToOne = screenFromNdc({200, 100, 0, 0, 0.25, 0.75}, convention);
  CHECK(zeroToOne[2] == std::array<double, 4>{0, 0, 0.5, 0.25});
  convention.ndcZ = NdcZ::minusOneToOne;
  CHECK(screenFromNdc({200, 100, 0, 0, 0.25, 0.75}, convention)[2] == std::array<double, 4>{0, 0, 0.25, 0.5});
}

TEST_CASE("The weight of a point is divided out of its view coordinates") {
  const Camera camera = plainCamera();
  const Convention c;
  const Vec3 view = worldToView(camera, {1, 2, -3, 1}, c);
  for (const double w : {2.0, 0.25, -4.0, 0x1p-298, 0x1p298})
    CHECK(worldToView(camera, {w, 2 * w, -3 * w, w}, c) == view);
  CHECK(worldTo(camera, Space::clip, {0x1p-298, 0x1p-297, -3 * 0x1p-298, 0x1p-298}, c) ==
        worldTo(camera, Space::clip, {1, 2, -3, 1}, c));
}

TEST_CASE("A result of zero is positive zero") {
  const ScreenPoint p = worldToScreen(plainCamera(), Vec3{-2, 1, -1});
  CHECK_FALSE(std::signbit(p.x));
  CHECK_FALSE(std::signbit(p.y));
  CHECK_FALSE(std::signbit(p.depth));
  // A tenth of the smallest double is 0.
  const Pose oblique = lookAlong({0, 0, 0}, {0.1, 0, -1}, {0, 1, 0}, Handedness::right);
  const Camera aside = makeCamera(oblique, orthographic(-2, 2, -1, 1, -5, 5), {200, 100});
  CHECK_FALSE(std::signbit(worldToScreen(aside, Vec3{-5e-324, 0, 0}).viewDistance));
  const Ray ray = screenToRay(plainCamera(), {100, 50});
  for (std::size_t i = 0; i < 3; ++i) CHECK((ray.direction[i] != 0 || !std::signbit(ray.direction[i])));
  const Mat4 m = clipFromWorld(plainCamera().pose(), plainCamera().projection(), {});
  for (const auto& row : m.m)
    for (double entry : row) CHECK((entry != 0 || !std::signbit(entry)));
  Convention zeroToOne;
  zeroToOne.ndcZ = NdcZ::zeroToOne;
  CHECK_FALSE(std::signbit(screenFromNdc({.width = 2, .height = 2, .depthFirst = -0.0}, zeroToOne)[2][3]));
}

TEST_CASE("Where the offset of depth cancels, certain depths are the nearest doubles") {
  const Pose pose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right);
  struct Row {
    Projection projection;
    double first, second, distance, depth;
  };
  const Row rows[] = {
      {perspective(60, 1, 0.9790644480897627, 1.468596672134644), 1.4535107490988497, 0.9690071660658999, 1e30,
       1.1216276120247303e-16},
      {orthographic(-1, 1, -1, 1, 0.3325787499389463, 0.8314468748473658), 0.32811233408627394, 0.8202808352156848,
       2.5e-40, 2.466425877679404e-40},
  };
  for (const Row& row : rows) {
    const Camera camera =
        makeCamera(pose, row.projection, {.width = 2, .height = 2, .depthFirst = row.first, .depthSecond = row.second});
    const ScreenPoint p = worldToScreen(camera, Vec3{0, 0, -row.distance});
    CHECK(p.certain);
    CHECK(p.depth == row.depth);
  }
}

TEST_CASE("A signed zero in the input changes nothing") {
  const ScreenPoint plus = worldToScreen(plainCamera(), Vec3{0.0, 0.0, -2});
  const ScreenPoint minus = worldToScreen(plainCamera(), Vec3{-0.0, -0.0, -2});
  CHECK(plus.x == minus.x);
  CHECK(plus.y == minus.y);
  CHECK(plus.depth == minus.depth);
}

TEST_CASE("Window depth follows the depth range and reverseZ, whatever the NDC range") {
  for (const ConventionPreset& preset : conventionPresets()) {
    Convention c = preset.convention;
    c.world = Handedness::right;
    Viewport v{200, 100};
    v.depthFirst = 0.25;
    v.depthSecond = 0.75;
    const Camera plain = plainCamera(1, 10, c);
    const Camera camera = makeCamera(plain.pose(), plain.projection(), v, c);
    INFO(preset.name);
    CHECK(worldToScreen(camera, Vec3{0, 0, -1}).depth == (c.reverseZ ? 0.75 : 0.25));
    CHECK(worldToScreen(camera, Vec3{0, 0, -10}).depth == (c.reverseZ ? 0.25 : 0.75));
  }
}

TEST_CASE("The depth of infinity has no point, and a depth beyond it is said") {
  for (bool reversed : {false, true}) {
    Convention c;
    c.reverseZ = reversed;
    const Camera camera = plainCamera(1, kInfiniteFar, c);
    const double infinity = reversed ? 0 : 1;
    CHECK(screenToWorld(camera, {100, 50}, infinity).status == DepthStatus::infinity);
    CHECK(screenToWorld(camera, {100, 50}, infinity + (reversed ? -0.1 : 0.1)).status == DepthStatus::beyond);
    CHECK(screenToWorld(camera, {100, 50}, reversed ? 1 : 0).position == Vec3{0, 0, -1});
    // In front of near, on the eye's side.
    CHECK(screenToWorld(camera, {100, 50}, reversed ? 2 : -1).position == Vec3{0, 0, -0.5});
  }
  CHECK(screenToWorld(plainCamera(), {NAN, 50}, 0.5).status == DepthStatus::notFinite);
  CHECK(screenToWorldAtDistance(plainCamera(), {100, 50}, -1).status == DepthStatus::beyond);
  CHECK(screenToWorldAtDistance(orthographicCamera(), {100, 50}, -1).position == Vec3{0, 0, 1});
}

TEST_CASE("Rays begin at the eye, on the plane through it in orthographic, or on the near plane") {
  for (Precision precision : kPrecisions) {
    CHECK(screenToRay(plainCamera(), {200, 0}, precision).origin == Vec3{0, 0, 0});
    CHECK(screenToRay(plainCamera(), {200, 0}, precision, RayOrigin::nearPlane).origin == Vec3{2, 1, -1});
    CHECK(screenToRay(orthographicCamera(), {150, 25}, precision).origin == Vec3{1, 0.5, 0});
    CHECK(screenToRay(orthographicCamera(), {150, 25}, precision, RayOrigin::nearPlane).origin == Vec3{1, 0.5, 5});
    CHECK(screenToRay(orthographicCamera(), {150, 25}, precision).direction == Vec3{0, 0, -1});
  }
}

TEST_CASE("Clip, NDC and view coordinates are what the matrices give") {
  for (const ConventionPreset& preset : conventionPresets())
    for (const bool orthographicLens : {false, true}) {
      const Convention& c = preset.convention;
      const Pose pose = lookAt({3, 2, 5}, {0, 1, 0}, {0, 1, 0}, c.world);
      const Projection projection =
          orthographicLens ? orthographic(-3, 2, -1, 4, 0.5, 20) : frustum(-0.3, 0.2, -0.1, 0.4, 0.5, 20);
      const Camera camera = makeCamera(pose, projection, {100, 100}, c);
      const Vec4 point{0.5, 0.25, -1, 1};
      const auto clip = times(clipFromWorld(pose, projection, c), point);
      const auto view = times(viewFromWorld(pose, c), point);
      const Vec4 gotClip = worldTo(camera, Space::clip, point, c);
      const Vec3 gotView = worldToView(camera, point, c);
      const Vec3 gotNdc = worldToNdc(camera, point, c);
      const auto near = [](double x) { return Approx(x).epsilon(1e-13).margin(1e-14); };
      INFO(preset.name);
      CHECK(gotClip.x == near(clip[0]));
      CHECK(gotClip.y == near(clip[1]));
      CHECK(gotClip.z == near(clip[2]));
      CHECK(gotClip.w == near(clip[3]));
      CHECK(gotView.x == near(view[0]));
      CHECK(gotView.y == near(view[1]));
      CHECK(gotView.z == near(view[2]));
      CHECK(gotNdc.x == near(clip[0] / clip[3]));
      CHECK(gotNdc.y == near(clip[1] / clip[3]));
      CHECK(gotNdc.z == near(clip[2] / clip[3]));
    }
}

TEST_CASE("Matrices with the viewport folded in take a model's points to their pixels, and back") {
  const Mat4 model{{{{0, 2, 0, 1}, {-2, 0, 0, 0.5}, {0, 0, 3, -1}, {0, 0, 0, 1}}}};
  for (const ConventionPreset& preset : conventionPresets())
    for (const bool orthographicLens : {false, true}) {
      INFO(preset.name);
      const Convention& c = preset.convention;
      const Pose pose = lookAt({3, 2, 5}, {0, 1, 0}, {0, 1, 0}, c.world);
      const Projection projection =
          orthographicLens ? orthographic(-3, 2, -1, 4, 0.5, 20) : frustum(-0.3, 0.2, -0.1, 0.4, 0.5, 20);
      const Viewport viewport{300, 200};
      const Camera camera = makeCamera(pose, projection, viewport, c);
      const auto near = [](double x) { return Approx(x).epsilon(1e-12).margin(1e-12); };
      for (const Vec3& local : {Vec3{0.5, 0.25, -0.5}, Vec3{0, 0, 0}, Vec3{-0.25, 0.5, 0.125}}) {
        const Vec4 world = cmd::toWorld(model, {local.x, local.y, local.z, 1});
        const ScreenPoint truth = worldToScreen(camera, Vec3{world.x, world.y, world.z});
        const auto there = times(matrix(camera, Space::screen, Space::model, model), {local.x, local.y, local.z, 1});
        CHECK(there[0] / there[3] == near(truth.x));
        CHECK(there[1] / there[3] == near(truth.y));
        CHECK(there[2] / there[3] == near(truth.depth));
        const auto back = times(matrix(camera, Space::model, Space::screen, model), {truth.x, truth.y, truth.depth, 1});
        for (std::size_t i = 0; i < 3; ++i) CHECK(back[i] / back[3] == near(local[i]));
      }
    }
}

TEST_CASE("A model's matrix and its points keep their digits at both ends of the range") {
  constexpr double kLarge = 1e90, kSmall = 1e-90;
  const Quaternion none{}, half{0.6, 0, 0, 0.8};  // 0.28 and 0.96 along y and z
  CHECK(cmd::worldFromLocal({0, 0, 0}, none, {kLarge, 1, kSmall})[0][0] == kLarge);
  CHECK(cmd::worldFromLocal({0, 0, 0}, none, {kLarge, 1, kSmall})[2][2] == kSmall);
  CHECK(cmd::worldFromLocal({0, 0, 0}, half, {1, kLarge, 1})[1][1] == Approx(0.28 * kLarge).epsilon(1e-15));
  CHECK(cmd::worldFromLocal({0, 0, 0}, half, {1, kLarge, 1})[2][1] == Approx(0.96 * kLarge).epsilon(1e-15));
  Mat4 wide = cmd::worldFromLocal({-kLarge, 0, kSmall}, none, {kLarge, 1e80, kSmall});
  CHECK(cmd::toWorld(wide, {1.5, 1e60, -0.5, 1}).x == Approx(kLarge / 2).epsilon(1e-15));
  CHECK(cmd::toWorld(wide, {1, 1e60, -0.5, 1}).x == 0);
  CHECK(cmd::toWorld(wide, {1, 1e229, 0, 1}).y == std::numeric_limits<double>::infinity());
  CHECK(cmd::toWorld(wide, {1, 1e-80, -0.5, 1}).y == 1);
  CHECK(cmd::toWorld(wide, {1, 1, -0.5, 1}).z == kSmall / 2);
  wide[0] = {kLarge, -kLarge, 1, 0};  // what cancels leaves the smallest term
  CHECK(cmd::toWorld(wide, {16, 16, 0.1, 1}).x == 0.1);
}

TEST_CASE("The inverse of a model, or of a lens, keeps its digits however its numbers differ in size") {
  const Convention c;
  const Camera camera = cameraOfParts(lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, c.world), c);
  const Mat4 thin = cmd::worldFromLocal({1e90, 1, 0}, {}, {1e90, 1e-90, 1});
  const Mat4 back = matrix(camera, Space::model, Space::view, thin);
  CHECK(back[0][0] == 1e-90);
  CHECK(back[1][1] == 1 / 1e-90);
  CHECK(back[0][3] == -1);
  CHECK(back[1][3] == -1 / 1e-90);
  CHECK(matrix(camera, Space::view, Space::model, thin)[0][0] == 1e90);
  Mat4 lopsided{{{{0.38657873214981797, 2.2951981166007252e-155, -2.713965713352535e-155, 0},
                  {0.9021322338081337, 2.4645853084211475e-155, -6.8789491785606e-155, 0},
                  {-0.8645671835810627, 9.475800985852006e-155, 9.75637713530295e-155, 0},
                  {0, 0, 0, 1}}}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 1; j < 3; ++j) lopsided[i][j] *= 0x1p230;
  CHECK(matrix(camera, Space::model, Space::view, lopsided)[0][0] == -85.79330356029764);  // by fractions
  const Mat4 flat{{{{1e80, 1e-60, 0, 0}, {1e80, 1e-60, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
  CHECK_THROWS_AS(matrix(camera, Space::model, Space::view, flat), CameraError);
  Viewport viewport{100, 100};
  viewport.depthFirst = 0.2240809957474883;
  const Mat4 slab = matrix(cameraOfParts(perspective(60, 1, 1.5052038720446184, 1.5052038720446188), c, viewport),
                           Space::view, Space::screen);
  CHECK(slab[3][2] == -2.526173520109471e-16);  // by fractions
  CHECK(slab[3][3] == 0.6643618306944917);
}

TEST_CASE("Along an axis of the world a viewDistance is a difference, and certain even where it is a tie") {
  const Camera camera = makeCamera(lookAt({0, 0, 50}, {0, 0, 0}, {0, 1, 0}, Handedness::right),
                                   perspective(60, 16.0 / 9, 0.1, 1000), {1920, 1080});
  std::vector<Vec3> points;
  for (int i = 0; i < 4000; ++i) points.push_back({0.37 * i - 700, 0.11 * i - 200, 40 - 0.01 * i});
  std::vector<ScreenPoint> screen(points.size());
  const BatchCounts counts = worldToScreen(camera, points, screen);
  std::size_t ties = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double rest = twoDiff(50, points[i].z).lo;
    ties += screen[i].viewDistance + 2 * rest != screen[i].viewDistance;
    REQUIRE(screen[i].viewDistance == 50 - points[i].z);
    REQUIRE(screen[i].certain);
  }
  CHECK(ties > 400);
  CHECK(counts.escalated < 10);
}

TEST_CASE("Numbers at the ends of the range, and points as small as doubles are, keep their digits") {
  const Viewport square{100, 100};
  SECTION("axes") {
    const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0, 1, 1e-80}, {1, 1e80, 0}, Handedness::right),
                                     orthographic(-1, 1, -1, 1, -1e85, 1e85), square);
    const ScreenPoint p = worldToScreen(camera, Vec3{0, 1e81, 0});
    CHECK(p.certain);
    CHECK(p.x == 403.5533905932737);  // by decimals, here and below
    CHECK(p.y == -303.5533905932737);
    CHECK(p.depth == 0.50005);
  }
  SECTION("an orthographic window of 1e50") {
    const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                     orthographic(-5e49, 5e49, -5e49, 5e49, 0, 1), square);
    CHECK(worldToScreen(camera, Vec3{0, 1e90, 0}).y == -9.999999999999999e+41);
  }
  SECTION("an eye at the largest number, and a point beside it by the smallest") {
    const Camera camera = makeCamera(lookAlong({1e90, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                     orthographic(-1, 1, -1, 1, -1, 1), square);
    CHECK(worldToScreen(camera, Vec3{1e90, 0, -1e-306}).viewDistance == 1e-306);
  }
  SECTION("a point of the smallest doubles") {
    const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                     perspective(90, 1, 1, kInfiniteFar), square);
    const ScreenPoint p = worldToScreen(camera, Vec3{0x1p-1074, 0, -0x1.8p-1073});
    CHECK(p.status == PointStatus::inFront);
    CHECK(p.x == 66.66666666666667);
  }
}

TEST_CASE("A point on an edge of the picture is inside, wherever the picture's corner lies") {
  for (const double start : {100.3, -77.7, 0.1, 1e6 / 3, 2019.0})
    for (const Origin origin : {Origin::topLeft, Origin::bottomLeft}) {
      const Viewport viewport{1920, 1080, start, -start, 0, 1, origin};
      const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                       perspectiveWindow(-2, 2, -1, 1, 1, 100), viewport);
      for (const double d : {1.0, 3.0, 7.0})
        for (const Vec3& point : {Vec3{2 * d, 0, -d}, {-2 * d, 0, -d}, {0, d, -d}, {0, -d, -d}, {2 * d, -d, -d}}) {
          INFO(start << ", " << point.x << " " << point.y << " at " << d);
          CHECK(worldToScreen(camera, point).outside == 0);
        }
    }
}

TEST_CASE("Without a near plane a pixel has a ray, and a point by its distance, but none by a depth") {
  for (const double far : {10.0, kInfiniteFar}) {
    const Camera camera = makeCamera(lookAlong({3, 2, 5}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                     perspective(90, 2, 0, far), {200, 100});
    const ScreenPoint p = worldToScreen(camera, Vec3{5, 2, 3});
    CHECK((p.x == 150 && p.y == 50 && std::isnan(p.depth) && p.viewDistance == 2 && p.visible() && p.certain));
    CHECK(worldToScreen(camera, Vec3{3, 2, std::nextafter(5, 0)}).visible());
    CHECK(worldToScreen(camera, Vec3{3, 2, 5}).status == PointStatus::behind);
    const ScreenPoint away = worldToScreen(camera, Vec4{1, 0, -1, 0});
    CHECK((away.x == 150 && std::isnan(away.depth) && away.status == PointStatus::inFront && away.certain));
    CHECK(std::isnan(worldToScreen(camera, Vec4{15, 6, 9, 3}).depth));
    CHECK(screenToRay(camera, {150, 50}, Precision::exact, RayOrigin::nearPlane).origin == Vec3{3, 2, 5});
    CHECK(screenToWorldAtDistance(camera, {150, 50}, 2).position == Vec3{5, 2, 3});
    for (const double depth : {0.0, 0.5, 1.0})
      CHECK(screenToWorld(camera, {150, 50}, depth).status == DepthStatus::beyond);
    CHECK(worldToView(camera, {5, 2, 3, 1}, {}) == Vec3{2, 0, -2});
    const Vec4 clip = worldTo(camera, Space::clip, {5, 2, 3, 1}, {});
    CHECK((clip.x == 1 && clip.y == 0 && std::isnan(clip.z) && clip.w == 2));
    const Vec3 ndc = worldToNdc(camera, {5, 2, 3, 1}, {});
    CHECK((ndc.x == 0.5 && ndc.y == 0 && std::isnan(ndc.z)));
  }
}

TEST_CASE("A projection without near plane has no matrix to clip space or the screen, and names near") {
  const Projection p = perspective(90, 2, 0);
  const Pose pose = lookAlong({3, 2, 5}, {1, 2, -3}, {0, 1, 0}, Handedness::right);
  const Viewport v{200, 100};
  const Camera camera = makeCamera(pose, p, v);
  Mat4 model;
  for (std::size_t i = 0; i < 4; ++i) model[i][i] = 1;
  for (const Space inner : {Space::model, Space::world, Space::view})
    for (const Space outer : {Space::clip, Space::ndc, Space::screen}) {
      CHECK(fieldAtFault([&] { matrix(camera, outer, inner, model); }) == "near");
      CHECK(fieldAtFault([&] { matrix(camera, inner, outer, model); }) == "near");
    }
  CHECK(fieldAtFault([&] { storedMatrix<float>(camera, Space::clip, Space::world); }) == "near");
  CHECK(fieldAtFault([&] { storedMatrix<double>(camera, Space::world, Space::screen); }) == "near");
  CHECK(fieldAtFault([&] { matrix(camera, Space::screen, Space::ndc); }).empty());
  CHECK(fieldAtFault([&] { storedMatrix<float>(camera, Space::view, Space::world); }).empty());
}
