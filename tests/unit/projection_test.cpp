#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "numbers/degrees.hpp"
#include "parts.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

const Viewport kViewport{1280, 720};
const Pose kPose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right);

}  // namespace

TEST_CASE("near must be positive and finite in perspective, and may be negative in orthographic") {
  for (double near : {-1.0, double(NAN), double(INFINITY)}) {
    INFO(near);
    CHECK(fieldAtFault([&] { perspective(60, 1, near, kInfiniteFar); }) == "near");
  }
  // 0: no near plane, but for those whose window lies on it.
  CHECK(perspective(60, 1, 0).zNear() == 0);
  CHECK(intrinsics(500, 500, 320, 240, kViewport, 0, 10).zNear() == 0);
  CHECK(fieldAtFault([] { perspective(60, 1, 0, 0); }) == "far");
  CHECK(fieldAtFault([] { frustum(-1, 1, -1, 1, 0, 10); }) == "near");
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, 1, -5, 5); }).empty());
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, 1, 0, kInfiniteFar); }) == "far");
  CHECK(fieldAtFault([] { orthographic(-1, 1, -1, 1, -1e45, 1.1e45); }) == "far");
  const Mat4 wide = clipFromView(orthographic(-1, 1, -1, 1, -8e44, 8e44), conventions::d3d);
  CHECK(wide[2][3] == 0.5);
  CHECK(std::fabs(wide[2][2]) == closely(1 / 1.6e45));
}

TEST_CASE("Radians are no degrees that were rounded") {
  const DoubleDouble tangent{0x1.279a74590331cp-1, -0x1.8d985307c7b36p-55};  // of half, from mpmath at 400 bits
  const DoubleDouble top = parts(perspective(Angle::radians(1.0471975511965976), 1, 1)).top;
  CHECK(std::fabs((top - tangent).hi) <= 0x1p-97 * tangent.hi);
  for (double radians : {0.0, -1.0, 3.1415926535897936, double(NAN), double(INFINITY)})
    CHECK(fieldAtFault([&] { perspective(Angle::radians(radians), 1, 1); }) == "fovY");
}

TEST_CASE("An aspect is the exact ratio of two sides, also of a viewport's") {
  const DoubleDouble exact{0x1.c71c71c71c71cp+0, 0x1.c71c71c71c71cp-54};
  for (const Aspect& aspect : {Aspect(16, 9), Aspect(Viewport{1920, 1080})}) {
    const ProjectionParts p = parts(perspective(90, aspect, 1));
    CHECK(std::fabs((p.right - exact).hi) <= 0x1p-102 * exact.hi);
  }
  CHECK(std::fabs((parts(perspective(90, 16.0 / 9, 1)).right - DoubleDouble(16.0 / 9)).hi) <= 0x1p-102);
  for (const Aspect& aspect : {Aspect(0), Aspect(-16, -9), Aspect(1, 0), Aspect(NAN), Aspect(Viewport{})})
    CHECK(fieldAtFault([&] { perspective(90, aspect, 1); }) == "aspect");
}

TEST_CASE("The other side of an orthographic window follows from the aspect") {
  const DoubleDouble width{0x1.5555555555555p+2, 0x1.5555555555555p-52}, height{0x1.b000000000000p+0, 0x0.0p+0};
  const ProjectionParts byHeight = parts(orthographicHeight(6, {16, 9}, -1, 1)),
                        byWidth = parts(orthographicWidth(6, {16, 9}, -1, 1));
  CHECK(byHeight.orthographic);
  CHECK((byHeight.top.hi == 3 && byHeight.bottom.hi == -3 && byWidth.right.hi == 3 && byWidth.left.hi == -3));
  CHECK(std::fabs((byHeight.right - width).hi) <= 0x1p-102 * width.hi);
  CHECK(std::fabs((byHeight.left + width).hi) <= 0x1p-102 * width.hi);
  CHECK(std::fabs((byWidth.top - height).hi) <= 0x1p-102 * height.hi);
  CHECK(std::fabs((byWidth.bottom + height).hi) <= 0x1p-102 * height.hi);
  for (double side : {0.0, -1.0, 5e-324, double(NAN), double(INFINITY)}) {
    CHECK(fieldAtFault([&] { orthographicHeight(side, 1, -1, 1); }) == "height");
    CHECK(fieldAtFault([&] { orthographicWidth(side, 1, -1, 1); }) == "width");
  }
}

TEST_CASE("A projection tells its shape and its angles") {
  // From mpmath at 400 bits: 60 degrees at 16:9, and a window off the axis.
  const struct {
    Projection projection;
    double aspect, vertical, horizontal, diagonal;
  } rows[] = {
      {perspective(60, {16, 9}, 1), 16.0 / 9, 60, 91.49284451967723, 99.32700682675518},
      {perspectiveWindow(-0.25, 1, -0.5, 0.125, 1, 2), 2, 33.690067525979785, 59.036243467926475, 64.9956982216016},
  };
  for (const auto& row : rows) {
    CHECK(row.projection.aspect() == row.aspect);
    CHECK(std::fabs(row.projection.fov(Fov::vertical) - row.vertical) <= 0x1p-47);
    CHECK(std::fabs(row.projection.fov(Fov::horizontal) - row.horizontal) <= 0x1p-46);
    CHECK(std::fabs(row.projection.fov(Fov::diagonal) - row.diagonal) <= 0x1p-46);
  }
  CHECK(std::isnan(orthographicHeight(6, 1, -1, 1).fov(Fov::vertical)));
}

TEST_CASE("A camera tells its window depths, and a pose the world that it fits") {
  const Viewport v{.width = 640, .height = 480, .depthFirst = 0.25, .depthSecond = 1};
  const auto depths = [&](const Projection& p, bool reverseZ) {
    return makeCamera(kPose, p, v, {.reverseZ = reverseZ}).depths();
  };
  const WindowDepths finite = depths(perspective(60, v, 1, 4), false);
  CHECK((finite.atNear == 0.25 && finite.atFar == 1 && finite.atInfinity == 1.25));
  const WindowDepths reversed = depths(perspective(60, v, 1), true);
  CHECK((reversed.atNear == 1 && reversed.atFar == 0.25 && reversed.atInfinity == 0.25));
  const WindowDepths none = depths(perspective(60, v, 0), true);
  CHECK((std::isnan(none.atNear) && std::isnan(none.atFar) && std::isnan(none.atInfinity)));
  const WindowDepths box = depths(orthographicHeight(6, v, -1, 1), false);
  CHECK((box.atNear == 0.25 && box.atFar == 1 && std::isnan(box.atInfinity)));
  for (const Handedness world : {Handedness::right, Handedness::left})
    CHECK(lookAlong({1, 2, 3}, {1, 0, 2}, {0, 1, 0}, world).world() == world);
}
