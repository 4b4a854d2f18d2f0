#include <cmath>
#include <limits>
#include <numbers>

#include "catch.hpp"
#include "internals.hpp"
#include "parts.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

/// Looks along -z from the origin; 90 degrees wide and high.
Frustum plainFrustum(double near = 1, double far = 10) {
  return viewFrustum(makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                perspectiveWindow(-1, 1, -1, 1, near, far), {100, 100}));
}

}  // namespace

TEST_CASE("Without a near plane there are the other planes, and what needs near gives nothing") {
  for (double far : {10.0, kInfiniteFar}) {
    const Frustum f = plainFrustum(0, far);
    CHECK(f.planes().size() == (std::isinf(far) ? 4 : 5));
    for (const FrustumPlane& plane : f.planes()) CHECK(plane.side != sideNear);
    CHECK(cull(f, Vec3{0, 0, -1e-300}).verdict == CullVerdict::inside);
    CHECK(cull(f, Vec3{0, 0, 1e-300}).verdict == CullVerdict::outside);
    CHECK(cull(f, Vec3{0, 0, 0}).verdict == CullVerdict::inside);
    CHECK(cull(f, Sphere{{0, 0, 5}, 1}).verdict == CullVerdict::outside);
    CHECK(cull(f, Sphere{{0, 0, 0}, 1}).verdict == CullVerdict::intersects);
    CHECK(cull(f, Box{{-1, -1, -5}, {1, 1, -4}}).verdict == CullVerdict::inside);
    CHECK(cull(f, Triangle{{-9, 0, 1}, {9, 0, 1}, {0, 9, 1}}).verdict == CullVerdict::outside);
    CHECK(cull(f, Vec3{0, 0, -11}).side == (std::isinf(far) ? 0 : sideFar));
    CHECK_FALSE(clipSegment(f, {0, 0, -5}, {1, 0, -5}).visible);
    // What is all in front of the eye has its rectangle; what reaches its plane would be without end.
    CHECK(std::fabs(screenBox(f.camera(), Sphere{{0, 0, -5}, 1}).value().right - (50 + 50 / std::sqrt(24))) < 1e-13);
    CHECK(screenBox(f.camera(), Box{{-1, -1, -5}, {1, 1, -4}}).value().left == 37.5);
    CHECK_FALSE(screenBox(f.camera(), Sphere{{0, 0, -1}, 1}));
    CHECK_FALSE(screenBox(f.camera(), Sphere{{0, 0, 5}, 1}));
    CHECK_FALSE(screenBox(f.camera(), Box{{-1, -1, -5}, {1, 1, 0}}));
  }
}

TEST_CASE("What touches a plane from within is inside, from without intersects") {
  const Frustum f = plainFrustum();
  CHECK(cull(f, Sphere{{0, 0, -3}, 2}).verdict == CullVerdict::inside);
  CHECK(cull(f, Sphere{{0, 0, -12}, 2}).verdict == CullVerdict::intersects);
  CHECK(cull(f, Sphere{{0, 0, -12}, std::nextafter(2.0, 0)}).verdict == CullVerdict::outside);
  CHECK(cull(f, Box{{-1, -1, -10}, {1, 1, -1}}).verdict == CullVerdict::inside);
  CHECK(cull(f, Box{{-1, -1, -12}, {1, 1, -10}}).verdict == CullVerdict::intersects);
  CHECK(cull(f, Box{{-1, -1, -12}, {1, 1, std::nextafter(-10.0, -11)}}).verdict == CullVerdict::outside);
  // A corner on the left plane.
  CHECK(cull(f, Box{{-8, 0, -6}, {-5, 1, -5}}).verdict == CullVerdict::intersects);
  CHECK(cull(f, Box{{-5, 0, -6}, {-4, 1, -5}}).verdict == CullVerdict::inside);
  CHECK(cull(f, Box{{-8, 0, -6}, {std::nextafter(-6.0, -7), 1, -5}}).verdict == CullVerdict::outside);
}

TEST_CASE("What is no point, sphere or box is outside of everything, beyond no plane") {
  const Frustum f = plainFrustum();
  const double bad = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Cull& c : {cull(f, Vec3{0, bad, -5}), cull(f, Vec3{0, 0, -infinity}), cull(f, Sphere{{0, 0, -5}, -1}),
                        cull(f, Sphere{{0, 0, -5}, bad}), cull(f, Box{{1, 0, -5}, {0, 1, -4}}),
                        cull(f, Box{{0, 0, -5}, {bad, 1, -4}})}) {
    CHECK(c.verdict == CullVerdict::outside);
    CHECK(c.side == 0);
  }
}
