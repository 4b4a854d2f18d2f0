// What users of other libraries have asked for or stumbled over, of depth, precision and points behind the camera: each
// case names the threads it is about.
#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "measure.hpp"
#include "parts.hpp"
#include "random_cameras.hpp"
#include "thread_cameras.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace peers;

// 1-10: infinite and reversed depth

TEST_CASE(
    "An infinite far plane has finite matrices, inverses and rays in every convention "
    "[DirectXMath#158, Babylon#11743, ImGuizmo#97, transform-gizmo#7, filament#3730, three.js#11755]") {
  for (const Convention& c : everyConvention()) {
    const Pose pose = somePose(c.world);
    const Projection p = lens(0.1, kInfiniteFar);
    CHECK(isFinite(clipFromView(p, c)));
    CHECK(isFinite(viewFromClip(p, c)));
    CHECK(isFinite(clipFromWorld(pose, p, c)));
    CHECK(isFinite(worldFromClip(pose, p, c)));
    CHECK(isFinite(screenFromWorld(pose, p, kHd, c)));
    CHECK(isFinite(matrix(cameraOfParts(pose, p, kHd, c), Space::world, Space::screen)));
    const Camera camera = makeCamera(pose, p, kHd, c);
    for (const Vec2& pixel : kPixels)
      for (Precision precision : {Precision::standard, Precision::exact})
        CHECK(isUnit(screenToRay(camera, pixel, precision).direction));
  }
}

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
    "Reversed depth with an infinite far plane is near / distance: 1 at near, 0 for a direction [DirectXMath PR#334]") {
  Convention c = preset("d3d-rh");
  c.reverseZ = true;
  const Camera camera = makeCamera(plainPose(), lens(0.25, kInfiniteFar), kHd, c);
  CHECK(worldToScreen(camera, Vec3{0, 0, -0.25}).depth == 1);
  CHECK(worldToScreen(camera, Vec3{0, 0, -1}).depth == 0.25);
  CHECK(worldToScreen(camera, Vec3{0, 0, -1e90}).depth == 0.25 / 1e90);
  CHECK(worldToScreen(camera, Vec4{0, 0, -1, 0}).depth == 0);
}

TEST_CASE(
    "far may be infinite, and near and far exchanged are an error that names far and says what to do "
    "[corefx#17089, MonoGame#7380, cgmath PR#547, nalgebra#573, glm#298]") {
  CHECK(fieldAtFault([] { lens(0.1, kInfiniteFar); }).empty());
  CHECK(fieldAtFault([] { lens(1000, 0.1); }) == "far");
  CHECK(fieldAtFault([] { lens(1, 1); }) == "far");
  CHECK(fieldAtFault([] { lens(1, NAN); }) == "far");
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, 1, 5, -5); }) == "far");
  try {
    lens(1000, 0.1);
  } catch (const CameraError& error) {
    CHECK(std::string(error.what()).find("reverseZ") != std::string::npos);
  }
}

TEST_CASE(
    "A pixel has a point at either end of the depth range, 0 included, forward or reversed "
    "[amethyst#2440]") {
  for (bool reverseZ : {false, true}) {
    Convention c = preset("vulkan");
    c.reverseZ = reverseZ;
    const Camera camera = makeCamera(plainPose(), lens(0.5, 1000), kHd, c);
    for (const Vec2& pixel : kPixels) {
      const WorldPoint near = screenToWorld(camera, pixel, reverseZ ? 1 : 0);
      CHECK(near.status == DepthStatus::point);
      CHECK(near.position.z == -0.5);
      CHECK(screenToRay(camera, pixel, Precision::exact, RayOrigin::nearPlane).origin == near.position);
    }
  }
}

TEST_CASE("Beyond near and beyond far mean the same, forward or reversed [bevy PR#20662, bevy PR#6126]") {
  for (const Convention& c : everyConvention()) {
    const Pose pose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, c.world);
    const Camera camera = makeCamera(pose, lens(1, 100), kHd, c);
    CHECK(worldToScreen(camera, Vec3{0, 0, -0.99}).outside == sideNear);
    CHECK(worldToScreen(camera, Vec3{0, 0, -1}).visible());
    CHECK(worldToScreen(camera, Vec3{0, 0, -100}).visible());
    CHECK(worldToScreen(camera, Vec3{0, 0, -100.1}).outside == sideFar);
    CHECK(worldToScreen(makeCamera(pose, lens(1, kInfiniteFar), kHd, c), Vec3{0, 0, -1e90}).visible());
  }
}

// 11-21: precision of rays and of project and unproject

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

TEST_CASE(
    "Projected and unprojected again a point comes back to its last digits, near the origin, at 1.2e6 and in ECEF "
    "[StarDrive#254, colmap#2215, ImGuizmo#423, three.js PR#10702]") {
  Worst byDepth, byDistance, pixels;
  int asked = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    View v = randomView(random, 1);
    const Vec3 direction = minus(v.target, v.eye);
    const double radius[] = {1, 3e5, 1.2e6, 6378137};
    v.eye = random.direction(radius[trial % 4]);
    v.target = {v.eye.x + direction.x, v.eye.y + direction.y, v.eye.z + direction.z};
    Convention c;
    c.reverseZ = true;
    c.ndcZ = NdcZ::zeroToOne;
    const Window w = randomWindow(random, Shape::offCentre, true);
    const Camera camera = makeCamera(poseOf(v, c.world), projectionOf(w), kHd, c);
    const Vec3 point = randomPoint(random, camera.pose(), w);
    const ScreenPoint s = worldToScreen(camera, point);
    if (s.status != PointStatus::inFront) continue;  // nearer than a coordinate's last digit
    ++asked;

    // Three roundings of a pixel and one of the depth, which are worth that share of the distance and of the picture;
    // then that of the coordinates themselves. Reversed depth, near / distance, keeps its relative precision.
    const double distance = length(minus(point, v.eye));
    const double window = 1 + (w.right - w.left + w.top - w.bottom + std::fabs(w.left) + std::fabs(w.bottom)) / w.near;
    const double bound = 4 * kRounding * distance * window + kRounding * (sumOfSizes(v.eye) + distance);
    const WorldPoint back = screenToWorld(camera, {s.x, s.y}, s.depth);
    REQUIRE(back.status == DepthStatus::point);
    byDepth.see(trial, length(minus(back.position, point)), bound);
    const WorldPoint again = screenToWorldAtDistance(camera, {s.x, s.y}, s.viewDistance);
    byDistance.see(trial, length(minus(again.position, point)), bound);

    // Through the ray: any point of it projects to the pixel it came from.
    const Ray ray = screenToRay(camera, {s.x, s.y});
    const Camera atEye = makeCamera(relativeToEye(camera.pose()), projectionOf(w), kHd, c);
    const ScreenPoint onRay = worldToScreen(atEye, ray.direction);
    const double scale = kHd.width * w.near * (1 / (w.right - w.left) + 1 / (w.top - w.bottom));
    pixels.see(trial, onRay.x - s.x, 4 * kRounding * (std::fabs(s.x) + kHd.width + scale * window * window));
    pixels.see(trial, onRay.y - s.y, 4 * kRounding * (std::fabs(s.y) + kHd.height + scale * window * window));
  }
  CHECK(asked > 1500);
  CHECK_WITHIN_BOUND(byDepth);
  CHECK_WITHIN_BOUND(byDistance);
  CHECK_WITHIN_BOUND(pixels);
}

TEST_CASE("What is 0 comes out as exactly 0, without a sign [godot#84007]") {
  const auto isPlainZero = [](double value) { return value == 0 && !std::signbit(value); };
  // The middle of the picture is 0, 0.
  for (double fovY : {1.0, 35.0, 60.0, 90.0, 123.0}) {
    const Viewport v{1920, 1080, -960, -540};
    const Projection p = perspective(fovY, Aspect(16, 9), 0.1, 1000);
    const Vec3 target{-0.3, 0.7, 1e3};
    const ScreenPoint middle =
        worldToScreen(makeCamera(lookAt({0.1, 0.2, 0.3}, target, {0, 1, 0}, Handedness::right), p, v), target);
    INFO("fovY " << fovY << ": screen " << middle.x << ' ' << middle.y);
    CHECK(isPlainZero(middle.x));
    CHECK(isPlainZero(middle.y));

    const Camera camera = makeCamera(plainPose(), p, v);
    CHECK(isPlainZero(worldToScreen(camera, Vec3{0, 0, -0.1}).depth));
    for (Precision precision : {Precision::standard, Precision::exact}) {
      const Ray ray = screenToRay(camera, {0, 0}, precision);
      INFO("ray " << ray.direction.x << ' ' << ray.direction.y << ' ' << ray.direction.z);
      CHECK(isPlainZero(ray.direction.x));
      CHECK(isPlainZero(ray.direction.y));
      CHECK(ray.direction.z == -1);
    }
    const WorldPoint far = screenToWorld(camera, {0, 0}, 1);
    INFO("point " << far.position.x << ' ' << far.position.y << ' ' << far.position.z);
    CHECK(isPlainZero(far.position.x));
    CHECK(isPlainZero(far.position.y));
    CHECK(far.position.z == -1000);
  }
  // The zeros of the matrices have no sign either.
  for (const Convention& c : everyConvention()) {
    const Pose pose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, c.world);
    for (const Mat4& m : {viewFromWorld(pose, c), clipFromView(lens(), c), viewFromClip(lens(), c),
                          clipFromWorld(pose, lens(), c), worldFromClip(pose, lens(), c), screenFromNdc(kHd, c)})
      for (const auto& row : m.m)
        for (double entry : row) CHECK((entry != 0 || isPlainZero(entry)));
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

TEST_CASE("The depth of infinity is told apart from a depth that no point has [Babylon PR#11744, godot PR#98489]") {
  const Camera infinite = makeCamera(plainPose(), lens(0.1, kInfiniteFar), kHd);
  CHECK(screenToWorld(infinite, {5, 5}, 1).status == DepthStatus::infinity);
  CHECK(isNaN(screenToWorld(infinite, {5, 5}, 1).position));
  CHECK(screenToWorld(infinite, {5, 5}, 1.5).status == DepthStatus::beyond);
  CHECK(screenToWorld(infinite, {5, 5}, NAN).status == DepthStatus::notFinite);
  const Camera finite = makeCamera(plainPose(), lens(1, 100), kHd);
  CHECK(screenToWorld(finite, {5, 5}, 1.005).status == DepthStatus::point);  // beyond far, still in front
  CHECK(screenToWorld(finite, {5, 5}, 100.0 / 99 + 1e-9).status == DepthStatus::beyond);
}

// 22-27: points behind the camera

TEST_CASE(
    "A point one metre behind never appears in front: status behind, no pixel, no depth "
    "[opencv#4628, viamrobotics/rdk PR#6315, godot#1725, Dalamud#780, OpenSfM#484, pytorch3d#1359]") {
  Tally tally;
  int asked = 0;
  for (std::uint64_t trial = 0; trial < 1000; ++trial) {
    Random random(trial);
    const Scene scene = randomScene(random, tally);
    if (scene.window.orthographic) continue;
    const std::vector<Convention> conventions = everyConvention();
    const Convention c = conventions[trial % conventions.size()];
    const Camera camera = makeCamera(poseOf(scene.view, c.world), projectionOf(scene.window), scene.viewport, c);
    const double distance = random.logUniform(1e-3, 1e3);
    const Vec3 behind = alongAxes(camera.pose(), random.uniform(-1, 1), random.uniform(-1, 1), -distance);
    for (Precision precision : {Precision::standard, Precision::exact}) {
      const ScreenPoint p = worldToScreen(camera, behind, precision);
      CHECK(p.status == PointStatus::behind);
      CHECK(!p.visible());
      CHECK((std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.depth)));
      CHECK(p.viewDistance < 0);
    }
    const Vec3 ndc = worldToNdc(camera, peers::point(behind), c);
    CHECK(isNaN(ndc));
    ++asked;
  }
  CHECK(asked > 500);
}

TEST_CASE("The distance of a point behind keeps the sign that w had [LayaAir#101]") {
  const Camera camera = makeCamera(plainPose(), lens(), kHd);
  CHECK(worldToScreen(camera, Vec3{0, 0, 1}).viewDistance == -1);
  CHECK(worldToScreen(camera, Vec3{0, 0, -1}).viewDistance == 1);
  CHECK(worldTo(camera, Space::clip, {0, 0, 1, 1}, preset("opengl")).w == -1);
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
    "As w goes to 0 a point runs out of the picture and never back into it; at 0 it has no pixel [WickedEngine "
    "PR#1672]") {
  const Camera camera = makeCamera(plainPose(), lens(), kHd);
  for (Precision precision : {Precision::standard, Precision::exact}) {
    double last = 0;
    for (double w = 1; w > 1e-300; w /= 16) {
      const ScreenPoint p = worldToScreen(camera, Vec3{1, 0, -w}, precision);
      REQUIRE(p.status == PointStatus::inFront);
      CHECK(p.x > last);
      CHECK(p.depth <= 1);
      CHECK(p.viewDistance == w);
      last = p.x;
    }
    CHECK(worldToScreen(camera, Vec3{1, 0, 0}, precision).status == PointStatus::behind);
    CHECK(worldToScreen(camera, Vec3{1, 0, 5e-324}, precision).status == PointStatus::behind);
    CHECK(worldToScreen(camera, Vec3{0, 0, 0}, precision).status == PointStatus::behind);
  }
}

TEST_CASE("A point that is not visible says why [bevy#8048, bevy PR#8841]") {
  const Camera camera = makeCamera(plainPose(), lens(1, 100), kHd);
  CHECK(worldToScreen(camera, Vec3{0, 0, 1}).status == PointStatus::behind);
  CHECK(worldToScreen(camera, Vec3{0, NAN, -5}).status == PointStatus::outOfRange);
  CHECK(worldToScreen(camera, Vec4{0, 0, 0, 0}).status == PointStatus::outOfRange);
  Viewport fromBottom = kHd;
  fromBottom.origin = Origin::bottomLeft;
  for (const Viewport& v : {kHd, fromBottom})
    for (Precision precision : {Precision::standard, Precision::exact}) {
      const Camera c = makeCamera(plainPose(), lens(1, 100), v);
      CHECK(worldToScreen(c, Vec3{-50, 0, -5}, precision).outside == sideLeft);
      CHECK(worldToScreen(c, Vec3{50, 0, -5}, precision).outside == sideRight);
      CHECK(worldToScreen(c, Vec3{0, 50, -5}, precision).outside == sideTop);
      CHECK(worldToScreen(c, Vec3{0, -50, -5}, precision).outside == sideBottom);
      CHECK(worldToScreen(c, Vec3{-5000, 5000, -500}, precision).outside == (sideLeft | sideTop | sideFar));
    }
  const Camera box = makeCamera(plainPose(), orthographic(-1, 1, -1, 1, 1, 100), kHd);
  CHECK(worldToScreen(box, Vec3{0, 0, 1}).outside == sideNear);
  CHECK(worldToScreen(box, Vec4{0, 0, -1, 0}).status == PointStatus::atInfinity);
}
