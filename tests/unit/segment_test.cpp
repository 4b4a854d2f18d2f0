
#include "catch.hpp"
#include "internals.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

/// Looks along -z from the origin; the edges of the picture lie at x = +-2z, y = +-z, its corner (0, 0) top left.
Camera plainCamera(double far = 10) {
  return makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right), frustum(-2, 2, -1, 1, 1, far),
                    {200, 100});
}

}  // namespace

TEST_CASE("Both ends outside and the middle in the picture: cut on both sides, on the boundary to the last bit") {
  const Frustum f = viewFrustum(plainCamera(kInfiniteFar));
  const VisibleSegment s = clipSegment(f, {-7, 0.3, -3}, {9, 0.3, -3});
  REQUIRE(s.visible);
  CHECK((s.start.side == sideLeft && s.end.side == sideRight));
  CHECK((s.start.screen.x == 0 && s.end.screen.x == 200));
  CHECK(s.start.t == 1.0 / 16);
  CHECK(s.end.t == 13.0 / 16);
  CHECK(s.start.screen.y == Approx(45).epsilon(1e-14));
  const Camera c = plainCamera();
  const Viewport wholeCentres{.width = 200, .height = 100, .pixelCenter = 0};
  const Frustum g = viewFrustum(makeCamera(c.pose(), c.projection(), wholeCentres, c.convention()));
  const VisibleSegment t = clipSegment(g, {-7, 0.3, -3}, {1, 0.3, -17});
  REQUIRE(t.visible);
  CHECK((t.start.side == sideLeft && t.start.screen.x == -0.5));
  CHECK((t.end.side == sideFar && t.end.depth == 1 && t.end.viewDistance == 10));
}

TEST_CASE("A segment that leaves the view where it begins, or enters it where it ends, is seen in that point") {
  const Frustum f = viewFrustum(plainCamera());
  for (const Vec3& out : {Vec3{-9, 0, -3}, {9, 0, -3}, {0, -4, -3}, {0, 4, -3}, {0, 0, -12}}) {
    const Vec3 on = out.z < -10 ? Vec3{0, 0, -10} : Vec3{out.x * 2 / 3, out.y * 3 / 4, -3};
    const VisibleSegment leaving = clipSegment(f, on, out), entering = clipSegment(f, out, on);
    CHECK((leaving.visible && leaving.start.t == 0 && leaving.end.t == 0));
    CHECK((entering.visible && entering.start.t == 1 && entering.end.t == 1));
  }
}

TEST_CASE("A segment past the picture, behind the eye or of numbers that are not finite is not visible") {
  const Frustum f = viewFrustum(plainCamera());
  CHECK_FALSE(clipSegment(f, {-7, 5, -3}, {9, 5, -3}).visible);
  CHECK_FALSE(clipSegment(f, {0, 0, 1}, {0, 0, 5}).visible);
  CHECK_FALSE(clipSegment(f, {0, 0, -11}, {0, 0, -20}).visible);
  CHECK_FALSE(clipSegment(f, {-10, 0, -3}, {0, 10, -3}).visible);  // around the corner, beyond no single side
  CHECK_FALSE(clipSegment(f, {NAN, 0, -3}, {0, 0, -3}).visible);
  CHECK(clipSegment(f, {-2, 1, -1}, {2, 1, -1}).visible);  // along an edge of near
}
