#include <limits>
#include <numbers>

#include "catch.hpp"
#include "internals.hpp"
#include "parts.hpp"
#include "records/screen_box.hpp"
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

void checkEquation(const FrustumPlane& p, Side side, const Vec4& want, double within = 1e-15) {
  INFO(int(side));
  CHECK(p.side == side);
  CHECK(p.equation.x == Approx(want.x).epsilon(within));
  CHECK(p.equation.y == Approx(want.y).epsilon(within));
  CHECK(p.equation.z == Approx(want.z).epsilon(within));
  CHECK(p.equation.w == Approx(want.w).epsilon(within));
}

/// What a matrix of doubles leaves of them.
constexpr double kOfDoubles = 1e-12;

/// Gribb & Hartmann, from a matrix of doubles.
Vec4 extracted(const Mat4& m, double w, double sign, std::size_t row) {
  Vec4 e{w * m[3][0] + sign * m[row][0], w * m[3][1] + sign * m[row][1], w * m[3][2] + sign * m[row][2],
         w * m[3][3] + sign * m[row][3]};
  const double k = 1 / std::hypot(e.x, e.y, e.z);
  return {e.x * k, e.y * k, e.z * k, e.w * k};
}

}  // namespace

TEST_CASE("The planes look inwards, in the order left, right, bottom, top, near, far") {
  const Frustum f = plainFrustum();
  const double s = std::sqrt(0.5);
  REQUIRE(f.planes().size() == 6);
  checkEquation(f.planes()[0], sideLeft, {s, 0, -s, 0});
  checkEquation(f.planes()[1], sideRight, {-s, 0, -s, 0});
  checkEquation(f.planes()[2], sideBottom, {0, s, -s, 0});
  checkEquation(f.planes()[3], sideTop, {0, -s, -s, 0});
  checkEquation(f.planes()[4], sideNear, {0, 0, -1, -1});
  checkEquation(f.planes()[5], sideFar, {0, 0, 1, 10});
}

TEST_CASE("An infinite far has no plane, and nothing is too far") {
  const Frustum f = plainFrustum(1, kInfiniteFar);
  CHECK(f.planes().size() == 5);
  CHECK(cull(f, Vec3{0, 0, -1e90}).verdict == CullVerdict::inside);
  CHECK(cull(f, Sphere{{0, 0, -1e90}, 1e89}).verdict == CullVerdict::inside);
}

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
    CHECK_FALSE(cmd::screenBox(f.camera(), Sphere{{0, 0, -5}, 1}));
    CHECK_FALSE(cmd::screenBox(f.camera(), Box{{-1, -1, -5}, {1, 1, -4}}));
  }
}

TEST_CASE("An orthographic view is a box, whose near may lie behind the eye") {
  const Frustum f = viewFrustum(makeCamera(lookAlong({1, 2, 3}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                           orthographic(-2, 3, -1, 4, -5, 5), {100, 100}));
  REQUIRE(f.planes().size() == 6);
  checkEquation(f.planes()[0], sideLeft, {1, 0, 0, 1});
  checkEquation(f.planes()[1], sideRight, {-1, 0, 0, 4});
  checkEquation(f.planes()[2], sideBottom, {0, 1, 0, -1});
  checkEquation(f.planes()[3], sideTop, {0, -1, 0, 6});
  checkEquation(f.planes()[4], sideNear, {0, 0, -1, 8});
  checkEquation(f.planes()[5], sideFar, {0, 0, 1, 2});
  CHECK(cull(f, Vec3{1, 2, 7.5}).verdict == CullVerdict::inside);
  CHECK(cull(f, Vec3{1, 2, 8.5}).side == sideNear);
}

TEST_CASE("Every convention's matrix holds the same planes") {
  for (double far : {50.0, kInfiniteFar})
    for (const ConventionPreset& preset : conventionPresets())
      for (bool reverse : {false, true}) {
        Convention c = preset.convention;
        c.reverseZ = reverse;
        INFO(preset.name << (reverse ? " reversed" : ""));
        const Camera camera = makeCamera(lookAt({3, 2, 5}, {0, 1, 0}, {0, 1, 0}, c.world),
                                         shifted(perspective(60, 1.5, 0.5, far), 0.25, -0.5), {300, 200}, c);
        const Mat4 m = clipFromWorld(camera.pose(), camera.projection(), c);
        const double up = c.ndcY == NdcY::up ? 1 : -1, low = c.ndcZ == NdcZ::zeroToOne ? 0 : 1;
        const Frustum f = viewFrustum(camera);
        checkEquation(f.planes()[0], sideLeft, extracted(m, 1, 1, 0), kOfDoubles);
        checkEquation(f.planes()[1], sideRight, extracted(m, 1, -1, 0), kOfDoubles);
        checkEquation(f.planes()[2], sideBottom, extracted(m, 1, up, 1), kOfDoubles);
        checkEquation(f.planes()[3], sideTop, extracted(m, 1, -up, 1), kOfDoubles);
        checkEquation(f.planes()[4], sideNear, reverse ? extracted(m, 1, -1, 2) : extracted(m, low, 1, 2), kOfDoubles);
        if (f.planes().size() == 6)
          checkEquation(f.planes()[5], sideFar, reverse ? extracted(m, low, 1, 2) : extracted(m, 1, -1, 2), kOfDoubles);
      }
}

TEST_CASE("A sphere is inside, intersects or is outside, by the plane that decides") {
  struct Row {
    Sphere sphere;
    CullVerdict verdict;
    unsigned side;
  };
  const Row rows[] = {
      {{{0, 0, -5}, 1}, CullVerdict::inside, 0},
      {{{0, 0, -5}, 0}, CullVerdict::inside, 0},
      {{{0, 0, -9.5}, 1}, CullVerdict::intersects, sideFar},
      {{{0, 0, -12}, 1}, CullVerdict::outside, sideFar},
      {{{-5, 0, -5}, 1}, CullVerdict::intersects, sideLeft},
      {{{-9, 0, -5}, 1}, CullVerdict::outside, sideLeft},
      {{{9, 0, -5}, 1}, CullVerdict::outside, sideRight},
      {{{0, -9, -5}, 1}, CullVerdict::outside, sideBottom},
      {{{0, 9, -5}, 1}, CullVerdict::outside, sideTop},
      {{{0, 0, 5}, 1}, CullVerdict::outside, sideNear},
      {{{1, -9, -5}, 1}, CullVerdict::outside, sideBottom},    // beyond bottom only
      {{{-9, -30, -5}, 1}, CullVerdict::outside, sideBottom},  // beyond both, farther beyond bottom
      {{{0, 0, -2}, 100}, CullVerdict::intersects, sideNear},  // reaches beyond all, farthest beyond near
  };
  const Frustum f = plainFrustum();
  for (const Row& row : rows) {
    const Cull got = cull(f, row.sphere);
    INFO(row.sphere.center.x << " " << row.sphere.center.y << " " << row.sphere.center.z);
    CHECK(got.verdict == row.verdict);
    CHECK(int(got.side) == int(row.side));
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

TEST_CASE("What is no farther from a plane than its bound is told by the exact rows, and what is farther without") {
  // A bound a million million times the true one, so that all is told by the exact rows up to there.
  FrustumParts numbers = parts(plainFrustum());
  numbers.planes[4].normalBound = 0x1p-10;
  numbers.planes[4].offsetBound = 0x1p-14;
  const Frustum f = Access::whole<Frustum, FrustumParts>(std::make_shared<const FrustumParts>(numbers));
  const ExactPlane& near = parts(f).planes[4];
  const auto size = [](const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); };
  /// What is called of a shape whose point that decides lies share of the bound beyond near: z = -1 + share * bound.
  const auto at = [&](double reach, double share) {
    return -1 + share * (near.normalBound * reach + near.offsetBound);
  };
  for (const double share : {0.0, 0x1p-30, 0.98, 1.02}) {
    CAPTURE(share);
    const CullVerdict whole = share == 0 ? CullVerdict::intersects : CullVerdict::outside;
    const CullVerdict part = share == 0 ? CullVerdict::inside : CullVerdict::intersects;
    // The corner farthest inside, and the one farthest beyond.
    Box box{{-0.25, -0.125, -1}, {0.25, 0.125, -0.5}};
    box.min.z = at(size(box.min) + size(box.max), share);
    CHECK(cull(f, box).verdict == whole);
    box = {{-0.25, -0.125, -2}, {0.25, 0.125, -1}};
    box.max.z = at(size(box.min) + size(box.max), share);
    CHECK(cull(f, box).verdict == part);
    const double radius = 0.25;
    const Vec3 beyond{0.125, 0, -1 + radius}, within{0.125, 0, -1 - radius};
    CHECK(cull(f, Sphere{{0.125, 0, at(size(beyond) + radius, share) + radius}, radius}).verdict == whole);
    CHECK(cull(f, Sphere{{0.125, 0, at(size(within) + radius, share) - radius}, radius}).verdict == part);
    // Of a triangle the reach is its farthest corner's.
    const Vec3 a{0.5, 0.25, -0.75}, b{0, 0, -0.5}, c{0.25, 0, -2};
    CHECK(cull(f, Triangle{a, b, {0, 0, at(size(a), share)}}).verdict == whole);
    CHECK(cull(f, Triangle{c, {0, 0, -1.5}, {0, 0, at(size(c), share)}}).verdict == part);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 point{0.125, 0.25, at(size({0.125, 0.25, -1}), side * share)};
      const double expected = share == 0 ? 0 : -side;
      const int sign = distanceInside(parts(f), near, point).sign();
      CHECK(sign == expected);
      CHECK(cull(f, point).verdict == (expected < 0 ? CullVerdict::outside : CullVerdict::inside));
    }
  }
}

TEST_CASE("A box or a sphere past an edge of the view may be called intersecting that misses it") {
  const Frustum f = plainFrustum();
  // The frustum ends at x = -10, in the edge of left and far. The box begins half a unit further left; but it reaches
  // inside of the left plane farther back, and inside of the far plane farther left.
  const Box box{{-14, -1, -13}, {-10.5, 1, -9.75}};
  CHECK(cull(f, box).verdict == CullVerdict::intersects);
  // The sphere's centre is 1.2 from that edge, which is the frustum's nearest point to it: both planes lie nearer.
  const Sphere sphere{
      {-10 - 1.2 * std::sin(3 * std::numbers::pi / 8), 0, -10 - 1.2 * std::cos(3 * std::numbers::pi / 8)}, 1};
  CHECK(cull(f, sphere).verdict == CullVerdict::intersects);
  // No point of either shape is visible.
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j)
      for (double y : {-1.0, 0.0, 1.0}) {
        const double u = i / 20.0, v = j / 20.0;
        CHECK(cull(f, Vec3{box.min.x + (box.max.x - box.min.x) * u, y, box.min.z + (box.max.z - box.min.z) * v})
                  .verdict == CullVerdict::outside);
        const double around = 2 * std::numbers::pi * v, reach = u * std::sqrt(1 - y * y);
        CHECK(cull(f, Vec3{sphere.center.x + reach * std::cos(around), y, sphere.center.z + reach * std::sin(around)})
                  .verdict == CullVerdict::outside);
      }
}

TEST_CASE("A point on a boundary is inside, and one behind the eye is beyond near") {
  const Frustum f = plainFrustum();
  for (double z : {1.0, 10.0})
    for (double x : {-1.0, 0.0, 1.0})
      for (double y : {-1.0, 1.0}) CHECK(cull(f, Vec3{x * z, y * z, -z}).verdict == CullVerdict::inside);
  CHECK(cull(f, Vec3{0, 0, 1}).side == sideNear);
  CHECK(cull(f, Vec3{0, 0, 0}).side == sideNear);
  CHECK(cull(f, Vec3{0, 0, 1}).verdict == CullVerdict::outside);
  // The plane that a point is farthest beyond is named, behind the eye too.
  CHECK(cull(f, Vec3{-50, 0, 1}).side == sideLeft);
  CHECK(cull(f, Vec3{-12, 0, -11}).side == sideFar);
}

TEST_CASE("A point is judged as a sphere of radius 0 there, not by its pixel") {
  // The right side is the pixel 1e14 + 100, and those of doubles lie 1/64 apart.
  const Frustum f = viewFrustum(makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                           frustum(-1, 1, -1, 1, 1, 1000), {.width = 100, .height = 100, .x = 1e14}));
  const double beyond = std::nextafter(2.0, 3.0);
  CHECK(worldToScreen(f.camera(), Vec3{beyond, 0, -2}).visible());
  for (const Vec3& p :
       {Vec3{2, 0, -2}, Vec3{beyond, 0, -2}, Vec3{2.0002, 0, -2}, Vec3{0, -beyond, -2}, Vec3{0, 0, -2}}) {
    const Cull point = cull(f, p), sphere = cull(f, Sphere{p, 0}), box = cull(f, Box{p, p});
    CHECK(point.verdict == sphere.verdict);
    CHECK(point.side == sphere.side);
    CHECK(point.verdict == box.verdict);
    CHECK((point.verdict == CullVerdict::inside) == (p.x <= 2 && p.y >= -2));
  }
}

TEST_CASE("Neither units nor place change a verdict") {
  struct Row {
    double center, radius, boxNear, boxFar;  // along the view
    CullVerdict want;
  };
  const Row rows[] = {{12, 2, 10, 12, CullVerdict::intersects},
                      {12, std::nextafter(2.0, 0), std::nextafter(10.0, 11), 12, CullVerdict::outside},
                      {3, 2, 1, 5, CullVerdict::inside},
                      {3, std::nextafter(2.0, 3), std::nextafter(1.0, 0), 5, CullVerdict::intersects}};
  for (double k : {0x1p-290, 0x1p-100, 1.0, 0x1p100, 0x1p290})
    for (const Row& row : rows) {
      const Frustum f = plainFrustum(k, 10 * k);
      INFO(k << " " << row.center << " " << row.radius);
      CHECK(cull(f, Sphere{{0, 0, -row.center * k}, row.radius * k}).verdict == row.want);
      CHECK(cull(f, Box{{-k / 2, -k / 2, -row.boxFar * k}, {k / 2, k / 2, -row.boxNear * k}}).verdict == row.want);
    }
  // In ECEF, where the planes' d has half a nanometre: a millionth of that decides.
  const Vec3 eye{4e6, 3e6, 4e6};
  const Frustum f = viewFrustum(
      makeCamera(lookAlong(eye, {0, 0, -1}, {0, 1, 0}, Handedness::right), frustum(-1, 1, -1, 1, 1, 10), {100, 100}));
  const Vec3 center{eye.x, eye.y, eye.z - 12};
  CHECK(cull(f, Sphere{center, 2}).verdict == CullVerdict::intersects);
  CHECK(cull(f, Sphere{center, std::nextafter(2.0, 0)}).verdict == CullVerdict::outside);
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
