// What users of other libraries have asked for or stumbled over, of conventions, ray origins, poses and degenerate
// parameters: each case names the threads it is about.
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

// 28-39: conventions

TEST_CASE(
    "Unprojecting speaks of window depth, so that 0..1 and -1..1 clip spaces give the same point "
    "[cglm#216, Babylon#11774, glm#119]") {
  for (const Projection& p : {lens(0.1, 50), lens(0.1, kInfiniteFar), orthographic(-5, 5, -5, 5, -10, 50)})
    for (double depth : {0.0, 0.25, 0.5, 0.9375}) {
      Convention c;
      c.ndcZ = NdcZ::minusOneToOne;
      const Vec3 a = screenToWorld(makeCamera(somePose(), p, kHd, c), {700, 300}, depth).position;
      c.ndcZ = NdcZ::zeroToOne;
      const Vec3 b = screenToWorld(makeCamera(somePose(), p, kHd, c), {700, 300}, depth).position;
      CHECK(a == b);
    }
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

TEST_CASE("Under Vulkan's clip space near is 0 and not -1 [SaschaWillems/Vulkan#45, SaschaWillems/Vulkan#526]") {
  const Camera camera = makeCamera(plainPose(), lens(0.5, 8), kHd);
  CHECK(worldToNdc(camera, {0, 0, -0.5, 1}, preset("vulkan")).z == 0);
  CHECK(worldToNdc(camera, {0, 0, -8, 1}, preset("vulkan")).z == 1);
  CHECK(worldToNdc(camera, {0, 0, -0.5, 1}, preset("opengl")).z == -1);
  CHECK(worldToNdc(camera, {0, 0, -8, 1}, preset("opengl")).z == 1);
  CHECK(worldToNdc(camera, {0, 1, -5, 1}, preset("vulkan")).y < 0);
  CHECK(worldToNdc(camera, {0, 1, -5, 1}, preset("opengl")).y > 0);
}

TEST_CASE(
    "Vectors and storage are two things: the paper is transposed by one, the memory by each "
    "[DirectXMath#82, DirectXMath#254, glm#85, bgfx#1627]") {
  const Mat4 m = viewFromWorld(lookAlong({1, 2, 3}, {0, 0, -1}, {0, 1, 0}, Handedness::right), preset("opengl"));
  const auto with = [](Vectors vectors, Storage storage) {
    Convention c;
    c.vectors = vectors;
    c.storage = storage;
    return c;
  };
  const Convention opengl = with(Vectors::column, Storage::columnMajor),
                   math = with(Vectors::column, Storage::rowMajor);
  const Convention direct3d = with(Vectors::row, Storage::rowMajor), odd = with(Vectors::row, Storage::columnMajor);
  const std::array<double, 16> translationLast{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, -2, -3, 1};
  const std::array<double, 16> translationRight{1, 0, 0, -1, 0, 1, 0, -2, 0, 0, 1, -3, 0, 0, 0, 1};
  CHECK(inStorageOrder(m, opengl) == translationLast);
  CHECK(inStorageOrder(m, direct3d) == translationLast);
  CHECK(inStorageOrder(m, math) == translationRight);
  CHECK(inStorageOrder(m, odd) == translationRight);
  CHECK(laidOut(m, opengl) == m);
  CHECK(laidOut(m, math) == m);
  CHECK(laidOut(m, direct3d) == transposed(m));
  CHECK(laidOut(m, odd) == transposed(m));
}

TEST_CASE(
    "WebGPU's NDC y points up, its framebuffer's down, and its depth range is kept [gpuweb#4492, gpuweb PR#4641, "
    "gpuweb#4003]") {
  const Camera camera = makeCamera(plainPose(), lens(), Viewport{1920, 1080, 0, 0, 0.25, 0.5}, preset("webgpu"));
  const Vec4 above{0, 1, -10, 1};
  CHECK(worldToNdc(camera, above, preset("webgpu")).y > 0);
  CHECK(worldToScreen(camera, above).y < 540);
  CHECK(worldToScreen(camera, Vec3{0, 0, -0.1}).depth == 0.25);
  CHECK(worldToScreen(camera, Vec3{0, 0, -1000}).depth == 0.5);
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
    "With pixels counted at their centres the picture reaches half a pixel beyond them [Open3D#7579, DEODR#196]") {
  Viewport v{640, 480};
  v.pixelCenter = 0;
  const Camera camera = makeCamera(plainPose(), perspective(90, Aspect(640, 480), 0.1, 100), v);
  CHECK(worldToScreen(camera, Vec3{-4.0 / 3, 1, -1}).x == Approx(-0.5).margin(1024 * kRounding));
  CHECK(worldToScreen(camera, Vec3{0, 1, -1}).y == -0.5);
  CHECK(worldToScreen(camera, Vec3{0, -1, -1}).y == 479.5);
  CHECK(worldToScreen(camera, Vec3{0, 0, -1}).x == 319.5);
  CHECK(worldToScreen(camera, Vec3{0, 1, -1}).outside == 0);
}

TEST_CASE("A principal point may lie anywhere, outside the picture too [Open3D#78, Open3D#834, Open3D#1417]") {
  const Viewport v{640, 480};
  for (const Vec2& c : {Vec2{320, 240}, Vec2{319.5, 239.5}, Vec2{12.25, 479}, Vec2{-100, 1000}}) {
    const Camera camera = makeCamera(plainPose(), intrinsics(500, 510, c.x, c.y, v, 0.1, 100), v);
    const ScreenPoint axis = worldToScreen(camera, Vec3{0, 0, -7}), beside = worldToScreen(camera, Vec3{1, 1, -10});
    CHECK(axis.x == c.x);
    CHECK(axis.y == c.y);
    CHECK(beside.x == Approx(c.x + 50).epsilon(4 * kRounding));
    CHECK(beside.y == Approx(c.y - 51).epsilon(4 * kRounding));
  }
}

TEST_CASE("cy measured from the bottom says the same as H - cy from the top [gazebo-classic#2587]") {
  Viewport top{640, 480}, bottom{640, 480};
  bottom.origin = Origin::bottomLeft;
  const Projection a = intrinsics(500, 510, 300, 100, top, 0.1, 100);
  const Projection b = intrinsics(500, 510, 300, 380, bottom, 0.1, 100);
  CHECK(clipFromView(a, preset("opengl")) == clipFromView(b, preset("opengl")));
  const ScreenPoint p = worldToScreen(makeCamera(plainPose(), a, top), Vec3{1, 2, -10});
  const ScreenPoint q = worldToScreen(makeCamera(plainPose(), b, bottom), Vec3{1, 2, -10});
  CHECK(p.x == q.x);
  CHECK(p.y + q.y == 480);
}

TEST_CASE(
    "From pixels and metres along the axis back to the world, without any NDC "
    "[pytorch3d#522, pytorch3d#596, pytorch3d#720, pytorch3d#860, pytorch3d#1056, pytorch3d PR#872]") {
  const Viewport v{640, 480};
  const Camera camera = makeCamera(somePose(), intrinsics(500, 510, 300, 250, v, 0.1, 100), v, preset("opencv"));
  for (const Vec3& point : {Vec3{0, 0, 0}, Vec3{1, 0.5, -2}, Vec3{-3, 1, 2}}) {
    const ScreenPoint p = worldToScreen(camera, point);
    const WorldPoint back = screenToWorldAtDistance(camera, {p.x, p.y}, p.viewDistance);
    CHECK(length(minus(back.position, point)) <= 16 * kRounding * (length(point) + 10));
  }
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

TEST_CASE("A camera-to-world matrix and its inverse are the same camera [nerfstudio#2019, colmap#3499]") {
  const Pose pose = somePose();
  const Convention gl = preset("opengl");
  const Pose forth = poseFromWorldFromCamera(worldFromView(pose, gl), CameraAxes::RUB, Handedness::right);
  const Pose back = poseFromCameraFromWorld(viewFromWorld(pose, gl), CameraAxes::RUB, Handedness::right);
  const Vec3 point{0.5, -0.25, 1};
  const ScreenPoint expected = worldToScreen(makeCamera(pose, lens(), kHd), point);
  for (const Pose& p : {forth, back}) {
    const ScreenPoint ours = worldToScreen(makeCamera(p, lens(), kHd), point);
    // The matrix's entries are rounded.
    CHECK(ours.x == Approx(expected.x).margin(1920 * 16 * kRounding));
    CHECK(ours.y == Approx(expected.y).margin(1920 * 16 * kRounding));
  }
}

TEST_CASE(
    "A shift moves the picture by half-widths and half-heights, whatever the aspect "
    "[RadeonProRenderUSD#181, RadeonProRenderUSD PR#493, arnold-usd#1000]") {
  for (const Projection& p : {lens(), orthographic(-16, 16, -2, 2, 1, 10)}) {
    const ScreenPoint before = worldToScreen(makeCamera(plainPose(), p, kHd), Vec3{0, 0, -5});
    const ScreenPoint after = worldToScreen(makeCamera(plainPose(), shifted(p, 0.25, 0.5), kHd), Vec3{0, 0, -5});
    CHECK(after.x - before.x == Approx(0.25 * 960).epsilon(4 * kRounding));
    CHECK(after.y - before.y == Approx(-0.5 * 540).epsilon(4 * kRounding));  // up
  }
}

// 40-43: ray origins and orthographic rays

TEST_CASE(
    "A ray starts at the eye or on the near plane, as asked; orthographic near may be negative "
    "[three.js#9009, three.js#28026, three.js PR#28027, three.js#14128, three.js#14916]") {
  const Vec2 pixel{480, 810};  // a quarter in from the left and from the bottom
  const Camera perspective = makeCamera(plainPose(), perspectiveNearSize(4, 2, 1, 10), kHd);
  CHECK(screenToRay(perspective, pixel).origin == Vec3{0, 0, 0});
  CHECK(screenToRay(perspective, pixel, Precision::exact, RayOrigin::nearPlane).origin == Vec3{-1, -0.5, -1});
  for (double near : {-5.0, 0.0, 2.0}) {
    const Camera box = makeCamera(plainPose(), orthographic(-8, 8, -4, 4, near, 10), kHd);
    for (Precision precision : {Precision::standard, Precision::exact}) {
      CHECK(screenToRay(box, pixel, precision).origin == Vec3{-4, -2, 0});
      CHECK(screenToRay(box, pixel, precision, RayOrigin::nearPlane).origin == Vec3{-4, -2, -near});
      CHECK(screenToRay(box, pixel, precision).direction == Vec3{0, 0, -1});
    }
  }
}

TEST_CASE("Orthographic rays do not depend on the clip space: WebGPU's, reversed or not [three.js#33568]") {
  const Camera reference = makeCamera(somePose(), orthographic(-8, 8, -4, 4, -3, 10), kHd);
  for (Convention c : everyConvention()) {
    c.world = Handedness::right;
    const Camera camera = makeCamera(somePose(), orthographic(-8, 8, -4, 4, -3, 10), kHd, c);
    for (RayOrigin origin : {RayOrigin::eye, RayOrigin::nearPlane}) {
      const Ray ours = screenToRay(camera, {17, 900}, Precision::exact, origin);
      const Ray expected = screenToRay(reference, {17, 900}, Precision::exact, origin);
      CHECK(ours.origin == expected.origin);
      CHECK(ours.direction == expected.direction);
    }
  }
}

TEST_CASE("Rays are in world coordinates, orthographic ones too [cesium#12498]") {
  const Vec3 eye{100, 200, 300};
  const Pose pose = lookAlong(eye, {1, 0, 0}, {0, 0, 1}, Handedness::right);  // right is -Y
  const Camera box = makeCamera(pose, orthographic(-8, 8, -4, 4, 1, 10), kHd);
  CHECK(screenToRay(box, {0, 0}).origin == Vec3{100, 208, 304});
  CHECK(screenToRay(box, {0, 0}).direction == Vec3{1, 0, 0});
  const Camera perspective = makeCamera(pose, perspectiveNearSize(2, 2, 1, 10), kHd);
  CHECK(screenToRay(perspective, {960, 540}).origin == eye);
  CHECK(screenToRay(perspective, {960, 540}).direction == Vec3{1, 0, 0});
}

TEST_CASE(
    "Picking works in orthographic: each pixel has its own origin, and its point projects back to it [bgfx#929]") {
  const Camera box = makeCamera(somePose(), orthographic(-8, 8, -4, 4, 1, 10), kHd);
  const Vec3 direction = screenToRay(box, {960, 540}).direction;
  for (const Vec2& pixel : kPixels) {
    const Ray ray = screenToRay(box, pixel);
    CHECK(ray.direction == direction);
    const ScreenPoint p = worldToScreen(
        box, Vec3{ray.origin.x + 5 * direction.x, ray.origin.y + 5 * direction.y, ray.origin.z + 5 * direction.z});
    // A few roundings of coordinates up to 20, at 120 and 135 pixels a unit.
    CHECK(p.x == Approx(pixel.x).margin(8 * kRounding * 20 * 135));
    CHECK(p.y == Approx(pixel.y).margin(8 * kRounding * 20 * 135));
  }
}

TEST_CASE(
    "An off-centre frustum's offset counts for points, for rays and for depths alike [godot#61174, godot#39812]") {
  const Camera camera = makeCamera(plainPose(), frustum(-1, 3, -0.5, 1.5, 1, 100), kHd);
  CHECK(worldToScreen(camera, Vec3{0, 0, -10}).x == 480);
  CHECK(worldToScreen(camera, Vec3{0, 0, -10}).y == 810);
  CHECK(screenToRay(camera, {480, 810}).direction == Vec3{0, 0, -1});
  CHECK(screenToWorldAtDistance(camera, {0, 0}, 10).position == Vec3{-10, 15, -10});
  CHECK(screenToWorld(camera, {1920, 1080}, 1).position == Vec3{300, -50, -100});
  CHECK(screenToRay(camera, {1920, 1080}, Precision::exact, RayOrigin::nearPlane).origin == Vec3{3, -0.5, -1});
}

// 44-51: poses and degenerate parameters

TEST_CASE(
    "An up that is parallel to the view is an error that names up, and nothing becomes NaN "
    "[glm#881, glm#855, cglm#54, nalgebra#504, gl-matrix#466, JOML#179]") {
  const auto fault = [](const Vec3& position, const Vec3& target, const Vec3& up) {
    return fieldAtFault([&] { lookAt(position, target, up, Handedness::right); });
  };
  CHECK(fault({0, 5, 0}, {0, 0, 0}, {0, 1, 0}) == "up");
  CHECK(fault({0, 5, 0}, {0, 9, 0}, {0, 1, 0}) == "up");
  CHECK(fault({1, 2, 3}, {2, 4, 6}, {-0.5, -1, -1.5}) == "up");
  CHECK(fault({1, 2, 3}, {2, 4, 6}, {-0.1, -0.2, -0.3}) == "");  // as doubles these are not quite 1 : 2 : 3
  CHECK(fault({0, 0, 0}, {1e-80, 1e-80, 0}, {1e80, 1e80, 0}) == "up");
  CHECK(fault({0, 0, 0}, {0, 0, -1}, {0, 0, 0}) == "up");
  CHECK(fault({0, 0, 0}, {0, 0, -1}, {0, NAN, 0}) == "up");
  CHECK(fault({1, 2, 3}, {1, 2, 3}, {0, 1, 0}) == "target");
  CHECK(fieldAtFault([] { lookAlong({0, 0, 0}, {0, 0, 0}, {0, 1, 0}, Handedness::right); }) == "direction");
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

TEST_CASE("A target a millionth away or nearer is still a target [gl-matrix lookAt]") {
  for (double distance : {1e-6, 1e-7, 1e-90}) {
    const Pose pose = lookAt({0, 0, 0}, {distance, 0, 0}, {0, 1, 0}, Handedness::right);
    CHECK(rounded(parts(pose).rows.forward) == Vec3{1, 0, 0});
    CHECK(rounded(parts(pose).rows.right) == Vec3{0, 0, 1});
  }
}

TEST_CASE("viewDistance runs along the viewing axis, not along the ray [habitat-sim PR#2001]") {
  const Camera camera = makeCamera(plainPose(), lens(), kHd);
  const Vec3 point{3, 0, -4};
  const ScreenPoint p = worldToScreen(camera, point);
  CHECK(p.viewDistance == 4);
  const Ray ray = screenToRay(camera, {p.x, p.y});
  CHECK(-4 / ray.direction.z == Approx(5).epsilon(8 * kRounding));  // the distance along the ray
  CHECK(length(minus(screenToWorldAtDistance(camera, {p.x, p.y}, 4).position, point)) <= 16 * kRounding * 5);
}

TEST_CASE(
    "Window depth is 0 at near and 1 at far in every convention, and not metres [pylinalg PR#22, bevy PR#14590]") {
  for (const Convention& c : everyConvention()) {
    const Pose pose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, c.world);
    for (const Projection& p : {lens(2, 50), orthographic(-1, 1, -1, 1, 2, 50)}) {
      const Camera camera = makeCamera(pose, p, kHd, c);
      CHECK(worldToScreen(camera, Vec3{0, 0, -2}).depth == (c.reverseZ ? 1 : 0));
      CHECK(worldToScreen(camera, Vec3{0, 0, -50}).depth == (c.reverseZ ? 0 : 1));
      CHECK(worldToScreen(camera, Vec3{0, 0, -50}).viewDistance == 50);
    }
  }
}

TEST_CASE("near = 0 is an error that names near, not a matrix of NaN [glm#71]") {
  CHECK(fieldAtFault([] { clipFromView(lens(0, 100), {}); }) == "near");
  CHECK(fieldAtFault([] { lens(-1, 100); }) == "near");
  CHECK(fieldAtFault([] { lens(NAN, 100); }) == "near");
  CHECK(fieldAtFault([] { frustum(-1, 1, -1, 1, 0, 100); }) == "near");
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, 1, 0, 100); }).empty());
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
