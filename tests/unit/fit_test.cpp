// Where a camera must stand to see it all. That both sides across from each other are touched is the proof that no
// place nearer along the view will do: the planes through them only come together as the camera moves on.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "catch.hpp"
#include "commands/fit/hull.hpp"
#include "input/adjusted.hpp"
#include "internals.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace viewproj::cmd;

namespace {

struct Things {
  std::vector<Vec3> points;
  std::vector<Sphere> spheres;
  std::vector<Box> boxes;

  template <class Visit>
  void each(const Visit& visit) const {
    for (const Vec3& point : points) visit(point);
    for (const Sphere& sphere : spheres) visit(sphere);
    for (const Box& box : boxes) visit(box);
  }
};

struct Seen {
  double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
};

Seen seenBy(const Camera& camera, const Things& things) {
  const Frustum frustum = viewFrustum(camera);
  Seen seen;
  const auto add = [&](const std::optional<ScreenBox>& box) {
    REQUIRE(box);
    seen.left = std::min(seen.left, box->left), seen.right = std::max(seen.right, box->right);
    seen.top = std::min(seen.top, box->top), seen.bottom = std::max(seen.bottom, box->bottom);
  };
  for (const Vec3& point : things.points) add(screenBox(frustum, Sphere{point, 0}));
  for (const Sphere& sphere : things.spheres) add(screenBox(frustum, sphere));
  for (const Box& box : things.boxes) add(screenBox(frustum, box));
  return seen;
}

}  // namespace

TEST_CASE("A fitted camera touches both sides of its room and shows all, from the middle of what is left") {
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) { return Vec3{size * unit(engine), size * unit(engine), size * unit(engine)}; };
  int byWidth = 0, byHeight = 0, ofSpheres = 0, byNear = 0;
  double worst = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 middle = vector(std::pow(10, 3 + 3 * unit(engine)));
    const double size = std::pow(10, 3 * unit(engine));
    const auto about = [&](double reach) {
      const Vec3 v = vector(reach);
      return Vec3{middle.x + v.x, middle.y + v.y, middle.z + v.z};
    };
    Things things;
    for (int i = trial % 5; i >= 0; --i) things.points.push_back(about(size));
    if (trial % 3 != 0)
      for (int i = trial % 4; i >= 0; --i) things.spheres.push_back({about(size), size * std::fabs(unit(engine)) / 3});
    if (trial % 2 != 0) {
      const Vec3 corner = about(size);
      things.boxes.push_back({corner, {corner.x + size / 2, corner.y + size / 5, corner.z + size / 7}});
    }
    if (things.points.size() == 1 && things.spheres.empty() && things.boxes.empty())
      things.points.push_back(about(size));

    const Viewport viewport{640 + 400 * unit(engine), 480 + 300 * unit(engine)};
    const double fov = 60 + 50 * unit(engine);
    const Projection projection =
        shifted(perspective(fov, viewport.width / viewport.height, size * 1e-2, kInfiniteFar),
                trial % 7 == 0 ? 0.3 * unit(engine) : 0, trial % 7 == 0 ? 0.3 * unit(engine) : 0);
    const Handedness world = trial % 2 ? Handedness::left : Handedness::right;
    const Pose pose = lookAlong(about(10 * size), vector(1), {0, 1, 0.1}, world);
    Convention convention;
    convention.world = world;
    const double margin = trial % 4 == 0 ? 0 : 0.2 * std::fabs(unit(engine));
    const Room room{margin, 1 - margin, margin, 1 - margin};
    Hull hull(makeCamera(pose, projection, viewport, convention), room);
    things.each([&](const auto& thing) { hull.add(thing); });
    const Hull::Place place = hull.place();
    CAPTURE(trial, fov, margin, size, viewport.width, viewport.height);
    REQUIRE(place.range.nearest > 0);
    // Nearer than near is no matter of fitting.
    const Projection open = withRange(projection, size * 1e-6, std::nullopt);
    const Seen seen = seenBy(makeCamera(movedTo(pose, place.eye, world), open, viewport, convention), things);
    const double left = margin * viewport.width, right = (1 - margin) * viewport.width;
    const double top = margin * viewport.height, bottom = (1 - margin) * viewport.height;
    // The eye is rounded to doubles, and stands back by that: worth so many pixels, and 1e-12 of the picture besides.
    const double focal = viewport.height / (2 * std::tan(fov * 3.14159265358979 / 360));
    const double away = std::max({std::fabs(middle.x), std::fabs(middle.y), std::fabs(middle.z)}) + 100 * size;
    const double within = 1e-12 * viewport.width + 24 * focal * away * 0x1p-53 / place.range.nearest;
    const double ulps = 4e-16 * viewport.width;  // of what is seen, which is rounded
    CHECK(seen.left >= left - ulps);
    CHECK(seen.right <= right + ulps);
    CHECK(seen.top >= top - ulps);
    CHECK(seen.bottom <= bottom + ulps);
    byNear += (place.by == Hull::Place::By::near);
    if ((place.by == Hull::Place::By::near)) continue;
    const double across = std::max(std::fabs(seen.left - left), std::fabs(seen.right - right));
    const double down = std::max(std::fabs(seen.top - top), std::fabs(seen.bottom - bottom));
    CHECK(std::min(across, down) <= within);
    worst = std::max(worst, std::min(across, down) / within);
    (across < down ? byWidth : byHeight)++;
    ofSpheres += !things.spheres.empty();
  }
  CHECK(byWidth > 300);
  CHECK(byHeight > 300);
  CHECK(ofSpheres > 1000);
  CHECK(byNear > 30);
  WARN("largest share of what is allowed: " << worst);
}

TEST_CASE("What fits from as near as one likes is on near") {
  const Camera camera =
      makeCamera(lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right), perspective(60, 1, 0.1, 100), {100, 100});
  Hull hull(camera, {});
  CHECK(hull.isEmpty());
  hull.add(Vec3{1, 2, 0});
  CHECK_FALSE(hull.isEmpty());
  CHECK(hull.place().by == Hull::Place::By::near);
  CHECK(hull.place().eye.z == 0.1);
  // Along the view behind it.
  hull.add(Vec3{1, 2, -3});
  CHECK(hull.place().by == Hull::Place::By::near);
  hull.add(Vec3{1.5, 2, -3});
  CHECK(hull.place().by == Hull::Place::By::near);
  hull.add(Vec3{1.5, 2, 0});
  const Hull::Place place = hull.place();
  CHECK_FALSE((place.by == Hull::Place::By::near));
  // Half a unit wide at the distance of the nearer two.
  CHECK(std::fabs(place.range.nearest - 0.25 / std::tan(30 * 3.14159265358979 / 180)) < 1e-12);
  CHECK(std::fabs(place.range.farthest - place.range.nearest - 3) < 1e-12);
  CHECK(place.eye.x == 1.25);
  CHECK(place.eye.y == 2);
}
