#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "numbers/degrees.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

const Viewport kViewport{1280, 720};
const Pose kPose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right);

ScreenPoint project(const Projection& projection, const Viewport& viewport, const Vec3& point) {
  return worldToScreen(makeCamera(kPose, projection, viewport), point);
}

}  // namespace

TEST_CASE("near and far out of order are named, and the message names reverseZ") {
  for (auto [near, far] : {std::pair{1.0, 1.0}, {2.0, 1.0}, {1.0, double(NAN)}}) {
    INFO(near << " " << far);
    CHECK(fieldAtFault([&, n = near, f = far] { perspectiveFovY(60, 1, n, f); }) == "far");
    CHECK(fieldAtFault([&, n = near, f = far] { frustum(-1, 1, -1, 1, n, f); }) == "far");
    CHECK(fieldAtFault([&, n = near, f = far] { orthographic(-1, 1, -1, 1, n, f); }) == "far");
  }
  try {
    perspectiveFovY(60, 1, 100, 0.1);
    FAIL("no error");
  } catch (const CameraError& e) {
    CHECK(e.message().find("reverseZ") != std::string::npos);
  }
}

TEST_CASE("near must be positive and finite in perspective, and may be negative in orthographic") {
  for (double near : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    INFO(near);
    CHECK(fieldAtFault([&] { perspectiveFovY(60, 1, near, kInfiniteFar); }) == "near");
  }
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, 1, -5, 5); }).empty());
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, 1, 0, kInfiniteFar); }) == "far");
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, 1, -1e308, 1e308); }) == "far");
  const Mat4 wide = clipFromView(orthographic(-1, 1, -1, 1, -8e307, 8e307), *conventionPreset("d3d"));
  CHECK(wide[2][3] == 0.5);
  CHECK(std::fabs(std::fabs(wide[2][2]) - 1 / 1.6e308) <= 0x1p-1074);
}

TEST_CASE("An opening angle outside 0 to 180 degrees is named") {
  for (double fov : {0.0, 180.0, -60.0, 360.0, double(NAN)}) {
    INFO(fov);
    CHECK(fieldAtFault([&] { perspectiveFovY(fov, 1, 1, 2); }) == "fovY");
    CHECK(fieldAtFault([&] { perspectiveFovX(fov, 1, 1, 2); }) == "fovX");
    CHECK(fieldAtFault([&] { perspectiveFovDiagonal(fov, 1, 1, 2); }) == "fovDiagonal");
  }
}

TEST_CASE("Edges must be in order and finite") {
  CHECK(fieldAtFault([] { frustum(1, -1, -1, 1, 1, 2); }) == "right");
  CHECK(fieldAtFault([] { frustum(-1, 1, 1, 1, 1, 2); }) == "top");
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, NAN, 1, 2); }) == "top");
  CHECK(fieldAtFault([] { orthographic(-1, INFINITY, -1, 1, 1, 2); }) == "right");
}

TEST_CASE("A window that doubles cannot tell from none, or from the whole plane, is named") {
  CHECK(fieldAtFault([] { frustum(-1e-280, 1e-280, -1, 1, 1, 2); }) == "right");
  CHECK(fieldAtFault([] { frustum(-1e280, 1e280, -1, 1, 1, 2); }) == "right");
  CHECK(fieldAtFault([] { frustum(-1, 1, 1e280, 2e280, 1, 2); }) == "top");
  const Projection narrow = frustum(-1e-270, 1e-270, -1e-270, 1e-270, 1, 2);
  CHECK(fieldAtFault([&] { makeCamera(kPose, narrow, {1e30, 1e30}); }).empty());
  CHECK(fieldAtFault([&] { makeCamera(kPose, narrow, {1e270, 1e270}); }) == "projection");
}

TEST_CASE("A focal length goes with a side of the sensor") {
  CHECK(fieldAtFault([] { perspectiveFocalLength(50, 0, 0, 1.5, 1, 2); }) == "focalLength");
  CHECK(fieldAtFault([] { perspectiveFocalLength(50, -36, 0, 1.5, 1, 2); }) == "sensorWidth");
  CHECK(fieldAtFault([] { perspectiveFocalLength(50, 0, NAN, 1.5, 1, 2); }) == "sensorHeight");
}

TEST_CASE("Every way to give the same lens ends in the same window") {
  const DoubleDouble aspect = DoubleDouble(kViewport.width) / DoubleDouble(kViewport.height);
  const double tangent = tanHalfDegrees(90).hi;
  const Projection same[] = {
      perspectiveFovY(90, aspect, 2, 9),
      perspectiveFovX(degreesOfHalfTangent(aspect), aspect, 2, 9),
      perspectiveNearSize(4 * tangent * kViewport.width / kViewport.height, 4 * tangent, 2, 9),
      perspectiveFocalLength(12, 0, 24, aspect, 2, 9),
      frustum(-2 * kViewport.width / kViewport.height, 2 * kViewport.width / kViewport.height, -2, 2, 2, 9),
      intrinsics(360, 360, 640, 360, kViewport, 2, 9),
  };
  for (const Projection& p : same) {
    CHECK(parts(p).top.hi == Approx(1).epsilon(1e-15));
    CHECK(parts(p).bottom.hi == Approx(-1).epsilon(1e-15));
    CHECK(parts(p).right.hi == Approx(aspect.hi).epsilon(1e-15));
    CHECK(parts(p).left.hi == Approx(-aspect.hi).epsilon(1e-15));
  }
}

TEST_CASE("A diagonal angle spans the picture's corners") {
  const Projection p = perspectiveFovDiagonal(90, DoubleDouble(4) / DoubleDouble(3), 1, 2);
  CHECK(parts(p).right.hi == Approx(0.8).epsilon(1e-15));
  CHECK(parts(p).top.hi == Approx(0.6).epsilon(1e-15));
}

TEST_CASE("A shift moves the picture right and up by halves of its size") {
  const Projection plain = perspectiveFovY(60, DoubleDouble(1280) / DoubleDouble(720), 0.1, 100);
  const ScreenPoint before = project(plain, kViewport, {1, 2, -7});
  const ScreenPoint after = project(shifted(plain, 0.5, 0.25), kViewport, {1, 2, -7});
  CHECK(after.x - before.x == Approx(0.5 * 640).epsilon(1e-13));
  CHECK(after.y - before.y == Approx(-0.25 * 360).epsilon(1e-13));
  CHECK(after.depth == before.depth);
}

TEST_CASE("A tile shows the same picture from its corner, whichever corner y starts at") {
  const Crop crop{100, 50, 320, 200};
  for (Origin origin : {Origin::topLeft, Origin::bottomLeft}) {
    Viewport full = kViewport;
    full.origin = origin;
    const Projection plain = perspectiveFovY(60, DoubleDouble(1280) / DoubleDouble(720), 0.1, 100);
    const ScreenPoint whole = project(plain, full, {1, 2, -7});
    const ScreenPoint tile = project(cropped(plain, full, crop), cropped(full, crop), {1, 2, -7});
    CHECK(whole.x - tile.x == Approx(100).epsilon(1e-14));
    CHECK(whole.y - tile.y == Approx(50).epsilon(1e-14));
  }
}

TEST_CASE("The principal point is a screen position: the viewport's corner and pixel centre count") {
  for (Origin origin : {Origin::topLeft, Origin::bottomLeft})
    for (double center : {0.0, 0.5}) {
      const Viewport v{.width = 640, .height = 480, .x = 30, .y = 20, .origin = origin, .pixelCenter = center};
      const ScreenPoint p = project(intrinsics(500, 600, 331.5, 252.25, v, 0.1, 10), v, {0, 0, -1});
      CHECK(p.x == 331.5);
      CHECK(p.y == 252.25);
    }
}

TEST_CASE("A viewport's numbers are checked") {
  const Projection p = perspectiveFovY(60, 1, 1, 2);
  CHECK(fieldAtFault([&] { makeCamera(kPose, p, {0, 10}); }) == "viewport.width");
  CHECK(fieldAtFault([&] { makeCamera(kPose, p, {10, -1}); }) == "viewport.height");
  CHECK(fieldAtFault([&] { makeCamera(kPose, p, {NAN, 10}); }) == "viewport.width");
  Viewport flat{10, 10};
  flat.depthSecond = flat.depthFirst;
  CHECK(fieldAtFault([&] { makeCamera(kPose, p, flat); }) == "viewport.depthRange");
}
