// Where a camera must stand, or how wide it must open, to see it all: everything lies inside, and something at the
// margin on both sides across from each other, which proves that no place nearer along the view will do.
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "commands/fitting.hpp"
#include "random.hpp"
#include "text/error.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

std::string numbers(const Vec3& v) {
  char text[128];
  std::snprintf(text, sizeof text, "[%.17g, %.17g, %.17g]", v.x, v.y, v.z);
  return text;
}

CameraFile cameraOf(const std::string& members) {
  return readCamera(load("{" + members + "}", "the camera"), {.allowStretch = true});
}

struct Seen {
  double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
};

Seen seenBy(const Camera& camera, const std::vector<Sphere>& things) {
  const Frustum frustum = viewFrustum(camera);
  Seen seen;
  for (const Sphere& sphere : things) {
    CHECK(cull(frustum, sphere).verdict == CullVerdict::inside);
    const auto box = screenBox(frustum.camera(), sphere);
    REQUIRE(box);
    seen.left = std::min(seen.left, box->left), seen.right = std::max(seen.right, box->right);
    seen.top = std::min(seen.top, box->top), seen.bottom = std::max(seen.bottom, box->bottom);
  }
  return seen;
}

}  // namespace

TEST_CASE("A fitted camera shows all, and something touches its margin on both sides") {
  int byWidth = 0, byHeight = 0, byNear = 0;
  for (unsigned trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const Vec3 middle = random.vector(random.logUniform(1e-3, 1e3));
    const auto about = [&](double reach) {
      const Vec3 v = random.vector(reach);
      return Vec3{middle.x + v.x, middle.y + v.y, middle.z + v.z};
    };
    std::vector<Sphere> things;
    for (unsigned i = 0; i <= 1 + trial % 5; ++i)
      things.push_back({about(1), trial % 3 == 0 ? 0 : random.uniform(0, 1.0 / 3)});
    const double margin = trial % 4 == 0 ? 0 : random.uniform(0, 0.2);
    const bool byLens = trial % 5 == 4, orthographic = trial % 7 == 6;
    const Vec3 eye = about(10);
    const Vec3 ahead = byLens ? Vec3{middle.x - eye.x, middle.y - eye.y, middle.z - eye.z} : random.vector(1);
    const std::string pose = trial % 2 ? "\"direction\": " + numbers(ahead)
                                       : "\"target\": " + numbers({eye.x + ahead.x, eye.y + ahead.y, eye.z + ahead.z});
    const std::string projection = orthographic ? R"({"type": "orthographic", "height": 3, "near": -1e4, "far": 1e4})"
                                                : R"({"type": "perspective", "fovY": )" +
                                                      std::to_string(random.uniform(10, 110)) + R"(, "near": 0.001})";
    const CameraFile camera = cameraOf("\"position\": " + numbers(eye) + ", " + pose +
                                       ", \"up\": [0, 1, 0.1], \"projection\": " + projection +
                                       R"(, "viewport": {"width": 640, "height": 480})");
    Fitting fitting(camera, margin);
    for (const Sphere& sphere : things) fitting.add(sphere);
    CAPTURE(trial, margin);
    Document fitted;
    try {
      fitted = byLens || orthographic ? fitting.byWindow() : fitting.byPlace();
    } catch (const InputError&) {  // the eye is among the things
      CHECK(byLens);
      continue;
    }
    const Seen seen = seenBy(makeCamera(readCamera(fitted, {.allowStretch = true})), things);
    const double left = margin * 640, right = 640 - left, top = margin * 480, bottom = 480 - top;
    const double within = 1e-9;
    CHECK(std::min({seen.left - left, right - seen.right, seen.top - top, bottom - seen.bottom}) >= -within);
    const double across = std::max(seen.left - left, right - seen.right);
    const double down = std::max(seen.top - top, bottom - seen.bottom);
    if (byLens && !orthographic) {
      CHECK(std::min({seen.left - left, right - seen.right, seen.top - top, bottom - seen.bottom}) <= 1e-6);
      continue;
    }
    const Vec3 to = readCamera(fitted, {.allowStretch = true}).pose->eye();
    const bool isNear = std::any_of(things.begin(), things.end(), [&](const Sphere& s) {
      return std::hypot(s.center.x - to.x, s.center.y - to.y, s.center.z - to.z) < s.radius + 0.01;
    });
    if (isNear) {
      ++byNear;
      continue;
    }
    CHECK(std::min(across, down) <= 1e-6);
    ++(across < down ? byWidth : byHeight);
  }
  CHECK(byWidth > 200);
  CHECK(byHeight > 200);
  CHECK(byNear > 0);
}

TEST_CASE("A box is fitted as its eight corners are") {
  const CameraFile camera = cameraOf(R"("position": [9, 7, 5], "target": [0, 0, 0], "up": [0.4, 1, 0],
      "viewport": {"width": 100, "height": 100}, "projection": {"type": "perspective", "fovY": 60, "near": 0.1})");
  Fitting ofBox(camera, 0), ofCorners(camera, 0);
  ofBox.add(Box{{-1, -2, -3}, {2, 3, 1}});
  for (const double x : {-1, 2})
    for (const double y : {-2, 3})
      for (const double z : {-3, 1}) ofCorners.add(Vec3{x, y, z});
  CHECK(readCamera(ofBox.byPlace(), {}).pose->eye() == readCamera(ofCorners.byPlace(), {}).pose->eye());
}

TEST_CASE("What fits from as near as one likes is on near, and what far cuts is refused") {
  const std::string camera = R"("position": [0, 0, 5], "target": [0, 0, 0], "viewport": {"width": 100, "height": 100},
      "projection": {"type": "perspective", "fovY": 60, "near": 0.1, "far": 4})";
  const auto placed = [&](const std::vector<Vec3>& points) {
    Fitting fitting(cameraOf(camera), 0);
    for (const Vec3& point : points) fitting.add(point);
    return readCamera(fitting.byPlace(), {}).pose->eye();
  };
  const Vec3 one = placed({{1, 2, 0}});
  CHECK(std::max({std::fabs(one.x - 1), std::fabs(one.y - 2), std::fabs(one.z - 0.1)}) < 1e-14);
  const Vec3 two = placed({{1, 2, 0}, {1.5, 2, -3}});
  CHECK(std::fabs(two.z - 0.1) < 1e-14);
  const Vec3 three = placed({{1, 2, 0}, {1.5, 2, 0}});
  CHECK(std::fabs(three.x - 1.25) < 1e-14);
  CHECK(std::fabs(three.z - 0.25 / std::tan(30 * 3.14159265358979 / 180)) < 1e-12);
  CHECK_THROWS_AS(placed({{1, 2, 0}, {1, 2, -4}}), InputError);
  CHECK_THROWS_AS(placed({}), InputError);
}

TEST_CASE("What is fitted is visible: in a part of a picture, by a matrix that is not quite a rotation, far away") {
  int cut = 0, fitted = 0;
  for (unsigned trial = 0; trial < 1500; ++trial) {
    Random random(trial);
    const double size = trial % 3 == 0 ? 1e6 : 10, unit = 1 + (trial % 4 < 2 ? 0 : random.uniform(-4e-4, 4e-4));
    const Vec3 middle = random.vector(size);
    char members[600];
    std::snprintf(members, sizeof members,
                  R"("worldFromCamera": [[0, %.17g, 0, %.17g], [0, 0, %.17g, %.17g], [%.17g, 0, 0, %.17g]],
                     "projection": {"type": "perspective", "fovY": %.17g, "near": 1, "far": %.17g},
                     "viewport": {"width": 640, "height": 480, "crop": {"x": %.17g, "y": %.17g, "width": 90, "height": 60}})",
                  unit, middle.x, unit, middle.y, unit, middle.z, random.uniform(20, 120), random.uniform(3, 60),
                  random.uniform(0, 550), random.uniform(0, 420));
    const CameraFile camera = cameraOf(members);
    Fitting fitting(camera, 0);
    std::vector<Vec3> points;
    for (int i = 0; i < 3; ++i) {
      const Vec3 v = random.vector(2);
      points.push_back({middle.x + v.x, middle.y + v.y, middle.z + v.z});
      fitting.add(points.back());
    }
    try {
      const Camera there = makeCamera(readCamera(fitting.byPlace(), {}));
      CAPTURE(trial);
      for (const Vec3& point : points) {
        const ScreenPoint p = worldToScreen(there, point);
        CAPTURE(unit, p.x, p.y, p.viewDistance, p.outside);
        CHECK(p.visible());
      }
      ++fitted;
    } catch (const InputError&) {  // far
      ++cut;
    }
  }
  CHECK(fitted > 700);
  CHECK(cut > 200);
}
