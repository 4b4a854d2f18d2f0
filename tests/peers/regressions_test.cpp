// What users of other libraries have stumbled over, and no search of tests/reference would meet as such: each case
// names the threads that it is about.
#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "measure.hpp"
#include "parts.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace peers;

namespace {

constexpr Viewport kHd{1920, 1080};
constexpr Vec2 kPixels[] = {{0, 0}, {960, 540}, {1920, 1080}, {123.25, 987.5}, {1919.5, 0.5}};

/// Stands at (3, 2, 5) and looks at the origin.
Pose somePose(Handedness world = Handedness::right) { return lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, world); }
/// At the origin, -Z ahead, Y up.
Pose plainPose() { return lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right); }
Projection lens(double near = 0.1, double far = 1000) { return perspective(60, kHd, near, far); }

}  // namespace

TEST_CASE(
    "A ray does not depend on far, be it 10, 1e8, 1e27, 1e45 or infinite "
    "[galacean/engine#1720, xeokit-sdk#546, FlaxEngine#1486]") {
  for (const Vec2& pixel : kPixels) {
    const Ray expected = screenToRay(makeCamera(somePose(), lens(0.1, 10), kHd), pixel);
    for (double far : {2e6, 1e8, 1e27, 1e45, kInfiniteFar})
      CHECK(screenToRay(makeCamera(somePose(), lens(0.1, far), kHd), pixel) == expected);
  }
}

TEST_CASE(
    "Reversed depth with an infinite far plane is not singular: the inverse of its matrix is finite and exact "
    "[hlslpp#112, DirectXMath#158]") {
  Convention c = preset("d3d");
  c.reverseZ = true;
  const Projection p = lens(0.25, kInfiniteFar);
  const Mat4 m = laidOut(clipFromView(p, c), c), inverse = laidOut(viewFromClip(p, c), c);
  CHECK(m[2] == std::array<double, 4>{0, 0, 0, 1});
  CHECK(m[3] == std::array<double, 4>{0, 0, 0.25, 0});
  CHECK(inverse[2] == std::array<double, 4>{0, 0, 0, 4});
  CHECK(inverse[3] == std::array<double, 4>{0, 0, 1, 0});
}

TEST_CASE(
    "A camera moved by 1.2e6, 3e5 or to the Earth's surface has the same rays, bit for bit "
    "[three.js#10408, o3de#19600, bevy PR#20700, Vortice.Mathematics#9, playcanvas PR#2400]") {
  const Camera home = makeCamera(lookAt({0, 0, 0}, {3, -2, 5}, {0, 1, 0}, Handedness::right), lens(), kHd);
  for (const Vec3& far : {Vec3{1.2e6, 1.2e6, -1.2e6}, Vec3{3e5, 3e5, 3e5}, Vec3{4075539, 931735, 4801629}}) {
    const Vec3 target{far.x + 3, far.y - 2, far.z + 5};
    const Camera moved = makeCamera(lookAt(far, target, {0, 1, 0}, Handedness::right), lens(), kHd);
    for (const Vec2& pixel : kPixels) CHECK(screenToRay(moved, pixel) == Ray{far, screenToRay(home, pixel).direction});
  }
}

TEST_CASE("Unprojected exactly at far, a pixel's point lies at far [godot#46010, godot#95786, godot PR#98489]") {
  for (bool reverseZ : {false, true})
    for (const Projection& p : {lens(0.05, 4000), lens(0.1, 1000), orthographic(-8, 8, -4.5, 4.5, 0.05, 4000)}) {
      Convention c;
      c.reverseZ = reverseZ;
      const Camera camera = makeCamera(plainPose(), p, kHd, c);
      for (const Vec2& pixel : kPixels) {
        CHECK(screenToWorld(camera, pixel, reverseZ ? 0 : 1).position.z == -parts(p).far);
        CHECK(screenToWorld(camera, pixel, reverseZ ? 1 : 0).position.z == -parts(p).near);
        CHECK(screenToWorldAtDistance(camera, pixel, parts(p).far).position ==
              screenToWorld(camera, pixel, reverseZ ? 0 : 1).position);
        CHECK(screenToWorldAtDistance(camera, pixel, parts(p).far).status == DepthStatus::point);
      }
    }
}

TEST_CASE(
    "The absolute value of w would put a point behind on a pixel; here only its mirror image has one [glam PR#77]") {
  const Camera camera = makeCamera(plainPose(), lens(), kHd);
  CHECK(worldToScreen(camera, Vec3{1, 1, -5}).visible());
  CHECK(worldToScreen(camera, Vec3{1, 1, 5}).status == PointStatus::behind);
  CHECK(worldToScreen(camera, Vec3{-1, -1, 5}).status == PointStatus::behind);
  // A negative weight is a way to write a point, not a side of the camera.
  const ScreenPoint front = worldToScreen(camera, Vec3{1, 1, -5}), same = worldToScreen(camera, Vec4{-1, -1, 5, -1});
  CHECK(same.visible());
  CHECK(same.x == front.x);
  CHECK(same.y == front.y);
  CHECK(same.depth == front.depth);
  CHECK(worldToScreen(camera, Vec4{-1, -1, -5, -1}).status == PointStatus::behind);
}

TEST_CASE("A tiny near plane keeps the framing, bit for bit [filament#1766]") {
  const Vec3 point{0.5, -0.25, 1};
  const ScreenPoint expected = worldToScreen(makeCamera(somePose(), lens(1, 1000), kHd), point);
  for (double near : {1e-3, 1e-10, 1e-30, 1e-45})
    for (double far : {1000.0, 1e30, kInfiniteFar}) {
      const ScreenPoint p = worldToScreen(makeCamera(somePose(), lens(near, far), kHd), point);
      CHECK(p.x == expected.x);
      CHECK(p.y == expected.y);
      CHECK(std::isfinite(p.depth));
    }
}

TEST_CASE(
    "Relative to the eye, a pose given as a view matrix loses nothing of its own eye [bevy PR#20700, ImGuizmo#423]") {
  // -M^-1 t of such a matrix is no double. The eye that is subtracted beforehand is the rounded one; the rest has to
  // stay.
  const Pose pose = poseFromCameraFromWorld(
      viewFromWorld(
          lookAt({4075539.1, 931735.3, 4801629.7}, {4075542.1, 931733.3, 4801634.7}, {0, 1, 0}, Handedness::right),
          preset("opengl")),
      CameraAxes::RUB);
  const Camera camera = makeCamera(pose, lens(), kHd), relative = makeCamera(movedTo(pose, {}), lens(), kHd);
  const Vec3 point{4075541, 931734, 4801632};
  const ScreenPoint expected = worldToScreen(camera, point);
  // The difference of two such coordinates is exact in double.
  const ScreenPoint ours = worldToScreen(relative, minus(point, pose.eye()));
  CHECK(ours.x == Approx(expected.x).margin(2048 * kRounding));
  CHECK(ours.y == Approx(expected.y).margin(2048 * kRounding));
}
