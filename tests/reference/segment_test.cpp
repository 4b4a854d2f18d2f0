// Segments cut at the sides of the view, against the cut in 480 bits.
#include <map>

#include "catch.hpp"
#include "viewproj/scene.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace reference;

namespace {

/// How far inside each side a point is, times a factor above 0, by the textbook's inequalities.
std::map<Side, Real> insideBy(const Scene& s, const Truth& truth, const Real3& point) {
  const Truth::View v = truth.view(point);
  const TrueLens& l = truth.lens;
  const Real w = l.orthographic ? Real(1) : v.forward;
  std::map<Side, Real> inside{{sideLeft, v.right - l.left * w},
                              {sideRight, l.right * w - v.right},
                              {sideBottom, v.up - l.bottom * w},
                              {sideTop, l.top * w - v.up},
                              {sideNear, v.forward - Real(s.near)}};
  if (!std::isinf(s.far)) inside[sideFar] = Real(s.far) - v.forward;
  return inside;
}

Real3 along(const Vec3& a, const Vec3& b, const Real& t) { return toReal(a) + (toReal(b) - toReal(a)) * t; }

}  // namespace

TEST_CASE("A segment is cut where it crosses the sides of the view, to within the bound") {
  std::map<int, int> cuts;
  int hidden = 0, throughTheEyePlane = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 80000000);
    Scene scene = randomScene(random, random.spread(1e-3, 1e9));
    scene.shiftX = scene.shiftY = 0;
    scene.hasCrop = false;
    const Truth truth(scene);
    const Camera camera = build(scene);
    // From somewhere about the picture to somewhere about it or behind the eye.
    const Vec3 a = pointInView(random, truth, random.chance(0.5) ? 4 : 1);
    Vec3 b = pointInView(random, truth, random.chance(0.7) ? 4 : 1);
    if (random.chance(0.4))
      for (std::size_t i = 0; i < 3; ++i) b[i] = 2 * camera.pose.eye[i] - b[i];
    // Farther along its line of sight.
    if (random.chance(0.2)) {
      const double farther = random.spread(1, 1e6);
      for (std::size_t i = 0; i < 3; ++i) b[i] += farther * (b[i] - camera.pose.eye[i]);
    }
    INFO("trial " << trial << ": " << describe(scene));

    Real first = 0, last = 1;
    int firstSide = 0, lastSide = 0;
    const auto atA = insideBy(scene, truth, toReal(a)), atB = insideBy(scene, truth, toReal(b));
    bool isBeyond = false;
    for (const auto& [side, insideA] : atA) {
      const Real& insideB = atB.at(side);
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
