#include <random>

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

TEST_CASE("A segment in the picture keeps its own ends") {
  const Frustum f = viewFrustum(plainCamera());
  const VisibleSegment s = clipSegment(f, {-2, 0, -2}, {2, 1, -4});
  REQUIRE(s.visible);
  CHECK(s.start.t == 0);
  CHECK(s.end.t == 1);
  CHECK((s.start.side == 0 && s.end.side == 0));
  CHECK((s.start.screen == Vec2{50, 50} && s.end.screen == Vec2{125, 37.5}));
  CHECK((s.start.viewDistance == 2 && s.end.viewDistance == 4));
}

TEST_CASE("A segment that runs through the eye plane is cut at near, not mirrored") {
  const Frustum f = viewFrustum(plainCamera());
  const VisibleSegment s = clipSegment(f, {1, 0, 4}, {1, 0, -4});
  REQUIRE(s.visible);
  CHECK(s.start.t == 0.625);
  CHECK(s.start.side == sideNear);
  CHECK((s.start.screen == Vec2{150, 50} && s.start.depth == 0));
  CHECK((s.end.t == 1 && s.end.screen == Vec2{112.5, 50}));
}

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

TEST_CASE("A segment past the picture, behind the eye or of numbers that are not finite is not visible") {
  const Frustum f = viewFrustum(plainCamera());
  CHECK_FALSE(clipSegment(f, {-7, 5, -3}, {9, 5, -3}).visible);
  CHECK_FALSE(clipSegment(f, {0, 0, 1}, {0, 0, 5}).visible);
  CHECK_FALSE(clipSegment(f, {0, 0, -11}, {0, 0, -20}).visible);
  CHECK_FALSE(clipSegment(f, {-10, 0, -3}, {0, 10, -3}).visible);  // around the corner, beyond no single side
  CHECK_FALSE(clipSegment(f, {NAN, 0, -3}, {0, 0, -3}).visible);
  CHECK(clipSegment(f, {-2, 1, -1}, {2, 1, -1}).visible);  // along an edge of near
}

TEST_CASE("Ends that are ninety magnitudes apart are cut as well") {
  const Frustum f = viewFrustum(plainCamera(kInfiniteFar));
  // From a point in the picture to far behind the eye and back: the far end leaves no trace in the near one.
  const VisibleSegment s = clipSegment(f, {-7.6e57, 8e-15, -1.15e90}, {-0.5, 0.25, -2});
  REQUIRE(s.visible);
  CHECK(s.start.t == 0);
  CHECK(s.end.t == 1);
  const VisibleSegment cut = clipSegment(f, {0, 0, 1e90}, {0.5, 0, -2});
  REQUIRE(cut.visible);
  CHECK(cut.start.side == sideNear);
  CHECK(cut.start.screen.x == closely(125));
  CHECK((cut.end.screen == Vec2{112.5, 50}));
  const VisibleSegment last = clipSegment(f, {0.5, 0, -2}, {0, 0, 1e90});
  REQUIRE(last.visible);
  CHECK(last.end.side == sideNear);
  CHECK(last.end.screen.x == closely(125));
}

TEST_CASE("Equal steps on the screen are not equal steps along a segment") {
  const Frustum f = viewFrustum(plainCamera());
  const Vec3 a{0, 0, -2}, b{8, 0, -8};
  const VisibleSegment s = clipSegment(f, a, b);
  // x / (2 z): 100 at a, 150 at b. Halfway, at 125: x = z / 2, so 8 t = 1 + 3 t.
  CHECK(s.end.screen == Vec2{150, 50});
  CHECK(parameterUnder(f, s, {125, 50}) == Approx(0.2).epsilon(1e-15));
  CHECK(parameterUnder(f, s, {125, 80}) == parameterUnder(f, s, {125, 50}));
  CHECK(parameterUnder(f, s, {0, 0}) == 0);
  CHECK(pointAlong(a, b, 0.2).x == closely(1.6));
}

TEST_CASE("Of a segment seen end on a pixel has the nearer end, wherever the pixel is") {
  const Camera box = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                orthographic(-2, 2, -1, 1, -1, 10), {200, 100});
  const struct {
    Frustum frustum;
    Vec3 a, b;
    double t;
  } rows[] = {
      {viewFrustum(plainCamera()), {0, 0, -3}, {0, 0, -9}, 0},
      {viewFrustum(plainCamera()), {0, 0, -9}, {0, 0, -3}, 1},
      {viewFrustum(plainCamera()), {2, -1, -4}, {4, -2, -8}, 0},
      {viewFrustum(plainCamera()), {4, -2, -8}, {2, -1, -4}, 1},
      {viewFrustum(plainCamera()), {0, 0, 3}, {0, 0, -5}, 0.5},  // cut at near
      {viewFrustum(box), {1, 0.5, 0.5}, {1, 0.5, -7}, 0},
      {viewFrustum(box), {1, 0.5, -7}, {1, 0.5, 0.5}, 1},
  };
  for (const auto& row : rows) {
    const VisibleSegment s = clipSegment(row.frustum, row.a, row.b);
    INFO("row " << &row - rows);
    REQUIRE(s.visible);
    REQUIRE(s.start.screen == s.end.screen);
    for (const Vec2& pixel : {s.start.screen, Vec2{0, 0}, Vec2{150, 99}})
      CHECK(parameterUnder(row.frustum, s, pixel) == row.t);
  }
}

TEST_CASE("What is clipped away is what is not visible, for random segments") {
  std::size_t visible = 0, cut = 0, hidden = 0, checked = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&](double size) {
      return Vec3{size * unit(random), size * unit(random), size * unit(random)};
    };
    const double size = std::pow(10.0, 5 * unit(random));
    const Vec3 eye = vector(seed % 2 ? size : 1e6 * size);
    const Pose pose = lookAlong(eye, vector(1), vector(1), Handedness::right);
    const double near = 0.1 * size, far = seed % 3 ? 5 * size : kInfiniteFar;
    const Camera camera = seed % 5 == 0
                              ? makeCamera(pose, orthographic(-size, size, -size, size, -size, 3 * size), {800, 600})
                              : makeCamera(pose, frustum(-near, 2 * near, -near, near, near, far), {800, 600});
    const Frustum f = viewFrustum(camera);
    const auto point = [&] {
      const Vec3 v = vector(4 * size);
      return Vec3{eye.x + v.x, eye.y + v.y, eye.z + v.z};
    };
    const Vec3 a = point(), b = point();
    const VisibleSegment s = clipSegment(f, a, b);
    s.visible ? ++visible : ++hidden;
    cut += s.visible && (s.start.side || s.end.side);
    INFO("seed " << seed);
    for (int i = 0; i <= 50; ++i) {
      const double t = i / 50.0;
      const Vec3 p = pointAlong(a, b, t);
      const ScreenPoint screen = worldToScreen(camera, p);
      const double inside = s.visible ? std::min(t - s.start.t, s.end.t - t) : -1;
      if (std::fabs(inside) < 1e-6) continue;
      REQUIRE(screen.visible() == (inside > 0));
      ++checked;
    }
  }
  CAPTURE(visible, cut, hidden, checked);
  CHECK(visible > 500);
  CHECK(cut > 500);
  CHECK(hidden > 500);
  CHECK(checked > 150000);
}
