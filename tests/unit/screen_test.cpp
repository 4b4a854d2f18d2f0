#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "parts.hpp"
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

TEST_CASE("A direction has no screen position in an orthographic camera, but sides it leaves through") {
  const ScreenPoint p = worldToScreen(orthographicCamera(), Vec4{1, 0, -1, 0});
  CHECK(p.status == PointStatus::atInfinity);
  CHECK(p.outside == (sideRight | sideFar));
  CHECK(worldToScreen(orthographicCamera(), Vec4{-1, 1, 0, 0}).outside == (sideLeft | sideTop));
  CHECK(worldToScreen(orthographicCamera(), Vec4{0, -1, 1, 0}).outside == (sideBottom | sideNear));
}

TEST_CASE("An orthographic ray starts on the plane through the eye, or on near") {
  const Camera camera = makeCamera(lookAlong({3, 2, 1}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                   orthographic(-2, 2, -1, 1, -5, 5), {200, 100});
  CHECK(screenToRay(camera, {150, 25}).origin == Vec3{4, 2.5, 1});
  CHECK(screenToRay(camera, {150, 25}, RayOrigin::nearPlane).origin == Vec3{4, 2.5, 6});
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
        const auto world = times(model, {local.x, local.y, local.z, 1});
        const ScreenPoint truth = worldToScreen(camera, Vec3{world[0], world[1], world[2]});
        const auto there = times(matrix(camera, Space::screen, Space::model, model), {local.x, local.y, local.z, 1});
        CHECK(there[0] / there[3] == near(truth.x));
        CHECK(there[1] / there[3] == near(truth.y));
        CHECK(there[2] / there[3] == near(truth.depth));
        const auto back = times(matrix(camera, Space::model, Space::screen, model), {truth.x, truth.y, truth.depth, 1});
        for (std::size_t i = 0; i < 3; ++i) CHECK(back[i] / back[3] == near(local[i]));
      }
    }
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
    CHECK(screenToRay(camera, {150, 50}, RayOrigin::nearPlane).origin == Vec3{3, 2, 5});
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
