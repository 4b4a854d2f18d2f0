// What users of other libraries have stumbled over, and no search of tests/reference would meet as such: each case
// names the threads that it is about.
#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "measure.hpp"
#include "parts.hpp"
#include "random_cameras.hpp"
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
    "A ray does not depend on far, be it 10, 1e8, 1e27, 1e90 or infinite "
    "[galacean/engine#1720, xeokit-sdk#546, FlaxEngine#1486]") {
  for (Precision precision : {Precision::standard, Precision::exact})
    for (const Vec2& pixel : kPixels) {
      const Ray expected = screenToRay(makeCamera(somePose(), lens(0.1, 10), kHd), pixel, precision);
      for (double far : {2e6, 1e8, 1e27, 1e90, kInfiniteFar}) {
        const Ray ray = screenToRay(makeCamera(somePose(), lens(0.1, far), kHd), pixel, precision);
        CHECK(ray.direction == expected.direction);
        CHECK(ray.origin == expected.origin);
      }
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
    for (const Vec2& pixel : kPixels)
      for (Precision precision : {Precision::standard, Precision::exact}) {
        const Ray ray = screenToRay(moved, pixel, precision);
        CHECK(ray.direction == screenToRay(home, pixel, precision).direction);
        CHECK(ray.origin == far);
      }
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

TEST_CASE(
    "A convention is chosen at run time, and pixels, distances and rays are the same in all of one world [glm#680]") {
  for (Handedness world : {Handedness::right, Handedness::left}) {
    const Camera reference = makeCamera(somePose(world), lens(), kHd, {.world = world});
    const Vec3 point{0.5, -0.25, 1};
    const ScreenPoint expected = worldToScreen(reference, point);
    for (Convention c : everyConvention()) {
      c.world = world;
      const Camera camera = makeCamera(somePose(world), lens(), kHd, c);
      const ScreenPoint p = worldToScreen(camera, point);
      CHECK(p.x == expected.x);
      CHECK(p.y == expected.y);
      CHECK(p.viewDistance == expected.viewDistance);
      if (!c.reverseZ) CHECK(p.depth == expected.depth);
      CHECK(screenToRay(camera, {17, 4}).direction == screenToRay(reference, {17, 4}).direction);
    }
  }
}

TEST_CASE(
    "cx = W/2 with pixels from corners and cx = (W-1)/2 with pixels from centres are the same camera "
    "[Open3D#7579, nerfstudio#2255, gazebo_ros_pkgs PR#938, DEODR#196]") {
  Viewport corners{640, 480}, centres{640, 480};
  corners.pixelCenter = 0.5;
  centres.pixelCenter = 0;
  const Projection a = intrinsics(500, 500, 320, 240, corners, 0.1, 100);
  const Projection b = intrinsics(500, 500, 319.5, 239.5, centres, 0.1, 100);
  CHECK(clipFromView(a, preset("opencv")) == clipFromView(b, preset("opencv")));
  const Camera cornerCamera = makeCamera(somePose(), a, corners), centreCamera = makeCamera(somePose(), b, centres);
  const Vec3 point{0.25, -0.5, 0.75};
  const ScreenPoint p = worldToScreen(cornerCamera, point), q = worldToScreen(centreCamera, point);
  CHECK(p.x - q.x == Approx(0.5).margin(1024 * kRounding));
  CHECK(p.y - q.y == Approx(0.5).margin(1024 * kRounding));
  CHECK(p.outside == q.outside);
  CHECK(screenToRay(cornerCamera, {100.5, 20.5}).direction == screenToRay(centreCamera, {100, 20}).direction);
}

TEST_CASE(
    "The same camera given in OpenCV's, OpenGL's and Unity's axes is the same camera "
    "[nerfstudio#1286, nerfstudio#2019, nerfstudio#3484, instant-ngp#72, colmap#3499]") {
  // Turned by (3, 4, 0)/5 about Z, at (1, 2, 3); x right, y up, z back.
  const Mat4 rub{{{{0.6, -0.8, 0, 1}, {0.8, 0.6, 0, 2}, {0, 0, 1, 3}, {0, 0, 0, 1}}}};
  Mat4 rdf = rub;
  for (std::size_t i = 0; i < 3; ++i) {
    rdf[i][1] = -rub[i][1];
    rdf[i][2] = -rub[i][2];
  }
  const Camera a = makeCamera(poseFromWorldFromCamera(rub, CameraAxes::RUB, Handedness::right), lens(), kHd);
  const Camera b = makeCamera(poseFromWorldFromCamera(rdf, CameraAxes::RDF, Handedness::right), lens(), kHd);
  const Vec3 point{1.5, 2.25, -4};
  CHECK(worldToScreen(a, point).x == worldToScreen(b, point).x);
  CHECK(worldToScreen(a, point).y == worldToScreen(b, point).y);
  CHECK(worldToScreen(a, point).viewDistance == 7);
  // A rotation of left-handed axes cannot be a pose of a right-handed world, and says so.
  CHECK(fieldAtFault([&] { poseFromWorldFromCamera(rub, CameraAxes::RUF, Handedness::right); }) == "worldFromCamera");
  CHECK(fieldAtFault([&] { poseFromWorldFromCamera(rub, CameraAxes::RUB, Handedness::left); }) == "worldFromCamera");
  CHECK(fieldAtFault([&] { poseFromRotation({0, 0, 0}, {}, CameraAxes::RUF, Handedness::right); }) == "rotation");
}

TEST_CASE(
    "An up that is nearly parallel, by 1e-12 or by the last bit, gives a camera with right angles [glm#881, "
    "gl-matrix#466]") {
  for (double lean : {1e-3, 1e-8, 1e-12, 1e-17, 1e-50, 1e-90}) {
    const Pose pose = lookAt({0, 5, 0}, {0, 0, 0}, {lean, 1, 0}, Handedness::right);
    const Vec3 right = rounded(parts(pose).rows.right), up = rounded(parts(pose).rows.up),
               forward = rounded(parts(pose).rows.forward);
    CHECK(forward == Vec3{0, -1, 0});
    CHECK(up == Vec3{1, 0, 0});
    CHECK(right == Vec3{0, 0, 1});
  }
  Worst worst;
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    const Vec3 d = random.direction(), lean = random.direction(random.logUniform(1e-15, 1e-3));
    const Pose pose = lookAlong({1, 2, 3}, d, {d.x + lean.x, d.y + lean.y, d.z + lean.z}, Handedness::right);
    const Vec3 right = rounded(parts(pose).rows.right), up = rounded(parts(pose).rows.up),
               forward = rounded(parts(pose).rows.forward);
    for (double product : {dot(right, up), dot(up, forward), dot(forward, right), length(right) - 1, length(up) - 1})
      worst.see(trial, product, 8 * kRounding);
  }
  CHECK_WITHIN_BOUND(worst);
}

TEST_CASE("A tiny near plane keeps the framing, bit for bit [filament#1766]") {
  const Vec3 point{0.5, -0.25, 1};
  const ScreenPoint expected = worldToScreen(makeCamera(somePose(), lens(1, 1000), kHd), point);
  for (double near : {1e-3, 1e-10, 1e-30, 1e-90})
    for (double far : {1000.0, 1e30, kInfiniteFar}) {
      const ScreenPoint p = worldToScreen(makeCamera(somePose(), lens(near, far), kHd), point);
      CHECK(p.x == expected.x);
      CHECK(p.y == expected.y);
      CHECK(std::isfinite(p.depth));
    }
}

TEST_CASE("No limit is absolute: a thin slab, a narrow angle and a small world are cameras [DirectXMath's asserts]") {
  const Camera slab = makeCamera(plainPose(), lens(1, 1 + 1e-12), kHd);
  CHECK(worldToScreen(slab, Vec3{0, 0, -(1 + 1e-12)}).depth == 1);
  const Camera narrow = makeCamera(plainPose(), perspective(1e-6, 1, 0.1, 10), Viewport{100, 100});
  CHECK(worldToScreen(narrow, Vec3{0, 0, -5}).visible());
  const Camera small = makeCamera(plainPose(), lens(1e-90, 1e-80), kHd);
  CHECK(worldToScreen(small, Vec3{0, 0, -1e-85}).visible());
}

TEST_CASE(
    "Relative to the eye, a pose given as a view matrix loses nothing of its own eye [bevy PR#20700, ImGuizmo#423]") {
  // -M^-1 t of such a matrix is no double. The eye that is subtracted beforehand is the rounded one; the rest has to
  // stay.
  const Pose pose = poseFromCameraFromWorld(
      viewFromWorld(
          lookAt({4075539.1, 931735.3, 4801629.7}, {4075542.1, 931733.3, 4801634.7}, {0, 1, 0}, Handedness::right),
          preset("opengl")),
      CameraAxes::RUB, Handedness::right);
  const Camera camera = makeCamera(pose, lens(), kHd), relative = makeCamera(relativeToEye(pose), lens(), kHd);
  const Vec3 point{4075541, 931734, 4801632};
  const ScreenPoint expected = worldToScreen(camera, point);
  // The difference of two such coordinates is exact in double.
  const ScreenPoint ours = worldToScreen(relative, minus(point, pose.eye()));
  CHECK(ours.x == Approx(expected.x).margin(2048 * kRounding));
  CHECK(ours.y == Approx(expected.y).margin(2048 * kRounding));
}
