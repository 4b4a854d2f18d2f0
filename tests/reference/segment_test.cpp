// Segments cut at the sides of the view, against the cut in 480 bits.
#include <map>

#include "catch.hpp"
#include "internals.hpp"
#include "reference/scene.hpp"
#include "viewproj/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

Real3 along(const Vec3& a, const Vec3& b, const Real& t) { return toReal(a) + (toReal(b) - toReal(a)) * t; }

}  // namespace

TEST_CASE("A segment is cut where it crosses the sides of the view, to within the bound") {
  std::map<int, int> cuts;
  int hidden = 0, throughTheEyePlane = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 80000000);
    Scene scene = randomScene(random, random.logUniform(1e-3, 1e9));
    scene.shiftX = scene.shiftY = 0;
    scene.hasCrop = false;
    const Truth truth(scene);
    const Camera camera = build(scene);
    // From somewhere about the picture to somewhere about it or behind the eye.
    const Vec3 a = pointInView(random, truth, random.chance(0.5) ? 4 : 1);
    Vec3 b = pointInView(random, truth, random.chance(0.7) ? 4 : 1);
    if (random.chance(0.4))
      for (std::size_t i = 0; i < 3; ++i) b[i] = 2 * parts(camera).pose.eye[i] - b[i];
    // Farther along its line of sight.
    if (random.chance(0.2)) {
      const double farther = random.logUniform(1, 1e6);
      for (std::size_t i = 0; i < 3; ++i) b[i] += farther * (b[i] - parts(camera).pose.eye[i]);
    }
    INFO("trial " << trial << ": " << describe(scene));

    Real first = 0, last = 1;
    int firstSide = 0, lastSide = 0;
    bool isBeyond = false;
    const std::array<TruePlane, 6> planes = truth.planes(camera.viewport());
    for (int i = 0; i < (std::isinf(scene.far) ? 5 : 6); ++i) {
      const int side = 1 << i;
      const Real insideA = planes[std::size_t(i)].distance(toReal(a)),
                 insideB = planes[std::size_t(i)].distance(toReal(b));
      if (insideA < Real(0) && insideB < Real(0)) isBeyond = true;
      if ((insideA < Real(0)) == (insideB < Real(0))) continue;
      const Real t = insideA / (insideA - insideB);
      if (insideA < Real(0) && t > first) first = t, firstSide = side;
      if (insideB < Real(0) && t < last) last = t, lastSide = side;
    }
    const VisibleSegment got = clipSegment(viewFrustum(camera), a, b);
    if (isBeyond || first > last + Real(1e-15)) {
      CHECK_FALSE(got.visible);
      ++hidden;
      continue;
    }
    if (first > last - Real(1e-15)) continue;
    REQUIRE(got.visible);
    throughTheEyePlane += (truth.view(toReal(a)).forward < Real(0)) != (truth.view(toReal(b)).forward < Real(0));

    const double range = std::fabs(scene.viewport.depthSecond - scene.viewport.depthFirst);
    const auto check = [&](const SegmentEnd& end, const Real& t, int side) {
      if (side == 0) return;  // worldToScreen's own
      ++cuts[side];
      INFO("side " << side << ", t " << double(t));
      CHECK(int(end.side) == side);
      CHECK(distance(end.t, t) <= kSegmentBound);
      const Truth::Screen screen = truth.screen(truth.view(along(a, b, t)));
      CHECK(distance(end.screen.x, screen.x) <= kSegmentBound * (scene.viewport.width + std::fabs(scene.viewport.x)));
      CHECK(distance(end.screen.y, screen.y) <= kSegmentBound * (scene.viewport.height + std::fabs(scene.viewport.y)));
      CHECK(distance(end.depth, screen.depth) <= kSegmentBound * (range + std::fabs(scene.viewport.depthFirst)));
    };
    check(got.start, first, firstSide);
    check(got.end, last, lastSide);
  }
  for (Side side : {sideLeft, sideRight, sideBottom, sideTop, sideNear, sideFar}) {
    INFO("side " << int(side) << ": " << cuts[side]);
    CHECK(cuts[side] > 300);
  }
  CHECK(hidden > 1000);
  CHECK(throughTheEyePlane > 1000);
}
