// Cameras with a lens: what is made and what is refused, and that all ways through them agree.
#include "viewproj/lens.hpp"

#include <cstring>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "field_at_fault.hpp"
#include "kernels.hpp"
#include "random.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

using namespace viewproj;

namespace {

const Viewport kViewport{752, 480};
const Pose kPose = lookAt({3, 2, 5}, {0, 0.5, 0}, {0, 1, 0}, Handedness::right);
const Camera kPinhole =
    makeCamera(kPose, intrinsics(458.654, 457.296, 367.215, 248.375, kViewport, 0.1, 100), kViewport);
const Lens kBrown = brownLens({-0.3728755, 0.2037299, -0.07233722}, {0.002219027, 0.001383707});
const Lens kFisheye =
    fisheyeLens({-0.05631891929412012, -0.0038333424842925284, -0.00024681888617308917, -0.00012153386798050158});

bool sameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }
bool same(const ScreenPoint& a, const ScreenPoint& b) {
  return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.depth, b.depth) &&
         sameBits(a.viewDistance, b.viewDistance) && a.status == b.status && a.outside == b.outside &&
         a.certain == b.certain && a.precision == b.precision;
}

/// In the picture, far beside it, and behind.
std::vector<Vec3> pointsAround(std::size_t count) {
  Random random(count);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 d = random.direction(random.logUniform(0.1, 100));
    points.push_back({3 + d.x, 2 + d.y, 5 + d.z});
  }
  points.push_back({3, 2, 5});
  points.push_back({NAN, 0, 0});
  return points;
}

}  // namespace

TEST_CASE("A lens is made whole or refused by the name of its number") {
  CHECK(fieldAtFault([] { brownLens({0, NAN}); }) == "distortion.k.1");
  CHECK(fieldAtFault([] { brownLens({0, 0, 0, 0, 0, 1e46}); }) == "distortion.k.5");
  CHECK(fieldAtFault([] { brownLens({0}, {0, INFINITY}); }) == "distortion.p.1");
  CHECK(fieldAtFault([] { brownLens({0}, {}, 0); }) == "distortion.limit");
  CHECK(fisheyeLens({9e-46}).k()[0] == 0);
  CHECK(fieldAtFault([] { fisheyeLens({0}, NAN); }) == "distortion.limit");
  CHECK(fieldAtFault([] { fisheyeLens({0}, -10); }) == "distortion.limit");
  CHECK(fieldAtFault([] { unifiedLens(NAN); }) == "distortion.alpha");
  CHECK(fieldAtFault([] { unifiedLens(0.5, 0); }) == "distortion.beta");
  CHECK(fieldAtFault([] { doubleSphereLens(-1, 0.5); }) == "distortion.xi");
  CHECK(fieldAtFault([] { omniLens(1e46); }) == "distortion.xi");
  CHECK(fieldAtFault([] { omniLens(1, {0, INFINITY}); }) == "distortion.k.1");
  CHECK(fieldAtFault([] { fovLens(0); }) == "distortion.omega");
  CHECK(fieldAtFault([] { fovLens(std::numbers::pi); }) == "distortion.omega");
  CHECK(fieldAtFault([] { limitedTo(fovLens(1), 0); }) == "distortion.limit");
  CHECK(fieldAtFault([] { limitedTo(fovLens(1), NAN); }) == "distortion.limit");
  const Camera orthographicCamera = makeCamera(kPose, orthographic(-1, 1, -1, 1, 0, 10), kViewport);
  CHECK(fieldAtFault([&] { withLens(orthographicCamera, kBrown); }) == "distortion");
  CHECK(fieldAtFault([&] { calibrated(orthographicCamera.projection(), kBrown); }) == "distortion");
  CHECK(fieldAtFault([] { viewFrustum(withLens(kPinhole, kBrown)); }) == "distortion");
}

TEST_CASE("A lens tells its numbers and where it ends") {
  CHECK(kBrown.model() == LensModel::brown);
  CHECK(kBrown.k()[2] == -0.07233722);
  CHECK(kBrown.p()[1] == 0.001383707);
  CHECK(kBrown.limitCause() == LimitCause::fold);
  CHECK(kBrown.limitDegrees() == Approx(49.974189937339915).epsilon(1e-9));
  const Lens stated = brownLens(kBrown.k(), kBrown.p(), 1);
  CHECK(stated.limitCause() == LimitCause::stated);
  CHECK(stated.limitDegrees() == 45);
  CHECK(brownLens(kBrown.k(), kBrown.p(), 1.7).limitCause() == LimitCause::fold);
  CHECK(kFisheye.model() == LensModel::fisheye);
  CHECK(kFisheye.limitDegrees() == Approx(105.35127956552093).epsilon(1e-9));
  CHECK(fisheyeLens({}, 60).limitDegrees() == closely(60));
  CHECK(limitedTo(kBrown, 30).limitDegrees() == closely(30));
  CHECK(limitedTo(kBrown, 30).limitCause() == LimitCause::stated);
  CHECK(limitedTo(kBrown, 60).limitCause() == LimitCause::fold);
  CHECK(limitedTo(stated, 60).limitDegrees() == 45);
  CHECK(limitedTo(unifiedLens(0.5), 90).limitDegrees() == 90);
  CHECK(limitedTo(limitedTo(fovLens(1), 100), 120).limitDegrees() == closely(100));
  // Straight back is no limit: a paraboloid, and the same lens by other names.
  CHECK(unifiedLens(0.5).limitDegrees() == INFINITY);
  CHECK(omniLens(1).limitDegrees() == INFINITY);
  CHECK(doubleSphereLens(1, 0.75).limitCause() == LimitCause::none);
  CHECK(omniLens(0.5).limitCause() == LimitCause::pole);
  CHECK(omniLens(0.5).limitDegrees() == closely(120));
  CHECK(omniLens(2).limitCause() == LimitCause::fold);
  CHECK(omniLens(2).limitDegrees() == closely(120));
  CHECK(unifiedLens(2.0 / 3).limitDegrees() == closely(120));
  CHECK(fisheyeLens({}, 180).limitCause() == LimitCause::none);
  CHECK(fisheyeLens({}).limitDegrees() == INFINITY);
  // Coefficients of a long lens, and of one that ends next to its axis.
  CHECK(brownLens({-1e6}).limitDegrees() ==
        Approx(std::atan(std::sqrt(1e-6 / 3)) * 180 / std::numbers::pi).epsilon(1e-9));
  CHECK(brownLens({-1e45}).limitDegrees() == Approx(std::sqrt(1e-45 / 3) * 180 / std::numbers::pi).epsilon(1e-9));
  CHECK(fisheyeLens({-1e45}).limitDegrees() == Approx(std::sqrt(1e-45 / 3) * 180 / std::numbers::pi).epsilon(1e-9));
}

TEST_CASE("A stated limit ends a lens: no pixel from there on, no ray to there") {
  const Camera wide = withLens(kPinhole, fisheyeLens({})), narrow = withLens(kPinhole, fisheyeLens({}, 30));
  int cut = 0, kept = 0;
  for (const Vec3& point : pointsAround(2000)) {
    const ScreenPoint a = worldToScreen(wide, point), b = worldToScreen(narrow, point);
    if (a.status != PointStatus::inFront) continue;
    const double tangent = std::hypot(a.x - 367.215, a.y - 248.375) / 458;
    if (std::fabs(tangent - std::numbers::pi / 6) < 0.005) continue;
    const bool isBeyond = tangent > std::numbers::pi / 6;
    CHECK(b.status == (!isBeyond            ? PointStatus::inFront
                       : a.viewDistance > 0 ? PointStatus::beyondLens
                                            : PointStatus::behind));
    CHECK(b.outside == (isBeyond ? 0 : a.outside));
    CHECK(sameBits(b.depth, a.depth));
    CHECK(b.viewDistance == a.viewDistance);
    CHECK(std::isnan(screenToRay(narrow, {a.x, a.y}).direction.x) == isBeyond);
    CHECK(std::isinf(boundOfPoint(narrow, point, Precision::exact).screen) == isBeyond);
    (isBeyond ? cut : kept)++;
  }
  CHECK((cut > 500 && kept > 100));
}

TEST_CASE("A calibration's projection becomes that of the pinhole that agrees with the lens on the axis") {
  const Projection file = kPinhole.projection();
  for (const Lens& lens : {kBrown, kFisheye, unifiedLens(0.6, 1.1), omniLens(1.5, {0.1, -0.2}, {0.001, 0}),
                           doubleSphereLens(-0.25, 0.6), fovLens(0.9)}) {
    const Camera pinhole = makeCamera(kPose, calibrated(file, lens), kViewport), camera = withLens(pinhole, lens);
    const double slope = lens.model() == LensModel::fov ? 2 * std::tan(0.45) / 0.9 : 1 / (1 + lens.xi());
    CHECK(pinhole.intrinsics().fx == Approx(458.654 * slope).epsilon(1e-15));
    CHECK(pinhole.intrinsics().cy == Approx(248.375).epsilon(1e-15));
    const Vec3 f = kPose.forward(), r = kPose.right(), u = kPose.up();
    const double s = 1e-6;
    const Vec4 near{f.x + s * (r.x + u.x), f.y + s * (r.y + u.y), f.z + s * (r.z + u.z), 0};
    const ScreenPoint bent = worldToScreen(camera, near), straight = worldToScreen(pinhole, near);
    CHECK(std::fabs(bent.x - straight.x) < 1e-8);
    CHECK(std::fabs(bent.y - straight.y) < 1e-8);
    CHECK(camera.intrinsics().fx == pinhole.intrinsics().fx);
  }
}

TEST_CASE(
    "A lens sees past the eye plane: a pixel, no depth, beyond near if there is one; a ray that points backwards") {
  const Pose pose = poseFromRotation({1, 2, 3}, {}, CameraAxes::RDF);
  const auto cameraOf = [&](const Lens& lens, double zNear) {
    return withLens(
        makeCamera(pose, intrinsics(150, 150, 376, 240, kViewport, zNear, zNear > 0 ? 100 : kInfiniteFar), kViewport),
        lens);
  };
  for (const Lens& lens : {fisheyeLens({}), unifiedLens(0.6), doubleSphereLens(-0.2, 0.6), omniLens(0.9), fovLens(1)}) {
    const Camera open = cameraOf(lens, 0), closed = cameraOf(lens, 0.1);
    const Vec3 back{1 + 2, 2 - 1, 3 - 0.5}, beside{1, 2 + 4, 3};
    for (const Vec3& point : {back, beside}) {
      const ScreenPoint a = worldToScreen(open, point), b = worldToScreen(closed, point);
      CHECK((a.status == PointStatus::inFront && b.status == PointStatus::inFront));
      CHECK((a.certain && b.certain));
      CHECK((sameBits(a.x, b.x) && sameBits(a.y, b.y)));
      CHECK(a.viewDistance == point.z - 3);
      CHECK((std::isnan(a.depth) && std::isnan(b.depth)));
      CHECK((b.outside ^ a.outside) == sideNear);
      CHECK((a.outside & sideNear) == 0);
      const ScreenPoint direction = worldToScreen(closed, Vec4{point.x - 1, point.y - 2, point.z - 3, 0});
      CHECK((direction.outside & (sideNear | sideFar)) == sideNear);
      CHECK((worldToScreen(open, Vec4{-point.x, -point.y, -point.z, -1}).x == a.x));
      CHECK(boundOfPoint(open, point, Precision::exact).screen < 1e-12);
    }
    const ScreenPoint at = worldToScreen(open, back);
    const Ray ray = screenToRay(open, {at.x, at.y}), fromNear = screenToRay(closed, {at.x, at.y}, RayOrigin::nearPlane);
    CHECK(std::hypot(ray.direction.x - 2 / std::sqrt(5.25), ray.direction.y + 1 / std::sqrt(5.25),
                     ray.direction.z + 0.5 / std::sqrt(5.25)) < 1e-14);
    CHECK(std::isnan(fromNear.origin.x));
    CHECK(sameBits(fromNear.direction.x, ray.direction.x));
    CHECK(screenToRay(open, {at.x, at.y}, RayOrigin::nearPlane).origin.x == 1);
    const WorldPoint found = screenToWorldAtDistance(open, {at.x, at.y}, -0.5);
    CHECK(found.position.x == Approx(3).epsilon(1e-13));
    CHECK(found.position.y == Approx(1).epsilon(1e-13));
    CHECK(found.viewDistance == -0.5);
    CHECK(screenToWorldAtDistance(open, {at.x, at.y}, 0.5).status == DepthStatus::beyond);
    CHECK(screenToWorld(closed, {at.x, at.y}, 0.5).status == DepthStatus::beyond);
    CHECK(lensShift(open).behind > 40);
    CHECK(lensShift(open).largest > 100);
    // Nothing is straight back.
    CHECK(worldToScreen(open, Vec3{1, 2, 2}).status == PointStatus::behind);
    CHECK(worldToScreen(open, Vec3{1, 2, 3}).status == PointStatus::behind);
  }
}

TEST_CASE("The same lens by two names gives the same pixels") {
  const Camera pinhole = kPinhole;
  for (double degrees = 1; degrees < 120; degrees += 7) {
    const double a = degrees * std::numbers::pi / 180;
    const Vec3 d{std::sin(a) * 0.6, std::sin(a) * 0.8, std::cos(a)};
    const auto same = [&](const Lens& one, const Lens& other, double scale = 1, const Vec3* stretched = nullptr) {
      const Vec2 x = distorted(one, d), y = distorted(other, stretched ? *stretched : d);
      CHECK(x.x == Approx(y.x * scale).epsilon(1e-14));
      CHECK(x.y == Approx(y.y * scale).epsilon(1e-14));
    };
    same(omniLens(0.7), doubleSphereLens(0.7, 0));
    same(unifiedLens(0.6), doubleSphereLens(0, 0.6));
    same(unifiedLens(0.6), omniLens(0.6 / 0.4));
    const Vec3 stretched{std::sqrt(1.3) * d.x, std::sqrt(1.3) * d.y, d.z};
    same(unifiedLens(0.6, 1.3), unifiedLens(0.6), 1 / std::sqrt(1.3), &stretched);
    if (degrees < 85) same(omniLens(0, {0.1, 0.02}, {0.001, 0.002}), brownLens({0.1, 0.02}, {0.001, 0.002}));
  }
}

TEST_CASE("Brown's zeros are the pinhole, a fisheye's are not") {
  CHECK_FALSE(lensOf(withLens(kPinhole, unifiedLens(0))));
  CHECK_FALSE(lensOf(withLens(kPinhole, doubleSphereLens(0, 0))));
  CHECK_FALSE(lensOf(withLens(kPinhole, omniLens(0))));
  CHECK(lensOf(withLens(kPinhole, omniLens(0.1))));
  CHECK_FALSE(lensOf(withLens(kPinhole, brownLens({}))));
  CHECK(lensOf(withLens(kPinhole, brownLens({}, {}, 1))));
  const Vec3 point{1, 1, 1};
  const Camera fisheye = withLens(kPinhole, fisheyeLens({}));
  CHECK(worldToScreen(fisheye, point).x != worldToScreen(kPinhole, point).x);
  // A lens takes the place of another; without it all is as before.
  CHECK(lensOf(withLens(fisheye, kBrown))->model() == LensModel::brown);
  CHECK_FALSE(lensOf(withLens(fisheye, brownLens({}))));
  CHECK(same(worldToScreen(withoutLens(withLens(fisheye, kBrown)), point), worldToScreen(kPinhole, point)));
  CHECK(lensShift(kPinhole).largest == 0);
  CHECK(lensShift(fisheye).largest > 10);
}

TEST_CASE("A batch through a lens gives the bits of single points, in place too, and of rays") {
  for (const Lens& lens :
       {kBrown, kFisheye, fisheyeLens({}), brownLens({0.3, -0.2, 0.1, 0.2, 0.1, 0.05}, {0.001, -0.002}),
        unifiedLens(0.6, 1.1), doubleSphereLens(-0.2, 0.59), omniLens(2.2, {0.02, 1.6}, {4e-4, 4e-4}), fovLens(0.93)}) {
    const Camera camera = withLens(kPinhole, lens);
    int byStatus[5] = {};
    for (const Precision precision : {Precision::standard, Precision::exact})
      for (const std::size_t count : {3u, 2000u}) {
        const std::vector<Vec3> points = pointsAround(count);
        std::vector<ScreenPoint> full(points.size());
        std::vector<Vec3> apart(points.size()), inPlace = points;
        std::vector<ScreenPoint> singles;
        for (const Vec3& point : points) singles.push_back(worldToScreen(camera, point, precision));
        std::size_t uncertain = 0, uncertainOfBatch = 0;
        withEachKernel([&](const detail::Kernels& kernel) {
          INFO(kernel.name);
          const BatchCounts counts = worldToScreen(camera, points, full, precision);
          CHECK(counts.escalated < 5 + count / (lens.k()[3] != 0 ? 25 : 100));
          uncertainOfBatch = counts.uncertain;
          worldToScreen(camera, points, apart, precision);
          for (std::size_t i = 0; i < points.size(); ++i) {
            const ScreenPoint& single = singles[i];
            REQUIRE(same(full[i], single));
            REQUIRE((sameBits(apart[i].x, single.x) && sameBits(apart[i].y, single.y)));
            REQUIRE(sameBits(apart[i].z, single.depth));
          }
        });
        worldToScreen(camera, inPlace, inPlace, precision);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const ScreenPoint& single = singles[i];
          REQUIRE((sameBits(inPlace[i].x, single.x) && sameBits(inPlace[i].z, single.depth)));
          // As a point of weight 1, and with another weight the same point to the last bits.
          REQUIRE(same(worldToScreen(camera, Vec4{points[i].x, points[i].y, points[i].z, 1}, precision), single));
          const ScreenPoint weighted =
              worldToScreen(camera, Vec4{2 * points[i].x, 2 * points[i].y, 2 * points[i].z, 2});
          REQUIRE(weighted.status == single.status);
          if (single.certain) REQUIRE(sameBits(weighted.x, single.x));
          uncertain += single.status == PointStatus::inFront && !single.certain;
          ++byStatus[int(single.status)];
        }
        CHECK(uncertainOfBatch == uncertain);
      }
    const bool seesAll = lens.limitCause() == LimitCause::none && lens.model() != LensModel::brown;
    CHECK(byStatus[int(PointStatus::inFront)] > 500);
    CHECK((byStatus[int(PointStatus::behind)] > 500) == !seesAll);
    CHECK(byStatus[int(PointStatus::outOfRange)] == 4);
    CHECK((byStatus[int(PointStatus::beyondLens)] > 100) == (lens.limitDegrees() < 60));
    std::vector<Vec2> pixels;
    for (int i = 0; i < 300; ++i) pixels.push_back({i * 2.5, i * 1.6});
    pixels.push_back({NAN, 0});
    pixels.push_back({367.215, 248.375});
    std::vector<Vec3> directions(pixels.size()), first;
    int none = 0;
    withEachKernel([&](const detail::Kernels& kernel) {
      INFO(kernel.name);
      screenToRayDirections(camera, pixels, directions);
      if (first.empty()) first = directions;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        REQUIRE(sameBits(directions[i].x, first[i].x));
        REQUIRE(sameBits(directions[i].z, first[i].z));
        none += std::isnan(first[i].x);
        REQUIRE(sameBits(directions[i].y, screenToRay(camera, pixels[i]).direction.y));
      }
    });
    CHECK((none > 20) == (lens.limitDegrees() < 50));
  }
}

TEST_CASE("A tile of a picture is seen through the whole picture's lens; matrices are the pinhole's") {
  const Camera camera = withLens(kPinhole, kBrown), tile = cropped(camera, {100, 50, 300, 200});
  const Vec3 point{1, 1, 1};
  const ScreenPoint whole = worldToScreen(camera, point), part = worldToScreen(tile, point);
  CHECK(part.x == Approx(whole.x - 100).epsilon(1e-13));
  CHECK(part.y == Approx(whole.y - 50).epsilon(1e-13));
  CHECK(std::memcmp(&kPinhole.viewport(), &camera.viewport(), sizeof(Viewport)) == 0);
  const Mat4 a = matrix(camera, Space::screen, Space::world), b = matrix(kPinhole, Space::screen, Space::world);
  CHECK(std::memcmp(&a, &b, sizeof a) == 0);
}

TEST_CASE("A direction's vanishing point goes through the lens, and tangents there and back") {
  const Camera camera = withLens(kPinhole, kBrown);
  const Vec3 f = kPose.forward(), r = kPose.right();
  const ScreenPoint along = worldToScreen(camera, Vec4{f.x + 0.2 * r.x, f.y + 0.2 * r.y, f.z + 0.2 * r.z, 0});
  CHECK(along.outside == sideFar);
  const Vec2 bent = distorted(kBrown, {0.2, 0, 1});
  CHECK(along.x == Approx(367.215 + 458.654 * bent.x).epsilon(1e-13));
  CHECK(along.y == Approx(248.375 + 457.296 * bent.y).epsilon(1e-13));
  const Vec3 back = undistorted(kBrown, bent);
  CHECK(back.x / back.z == closely(0.2));
  CHECK(std::fabs(back.y) < 1e-16);
  CHECK(std::isnan(distorted(kBrown, {1.2, 0, 1}).x));
  CHECK(std::isnan(distorted(kBrown, {0.1, 0, -1}).x));
  CHECK(std::isnan(distorted(kBrown, {0, 0, 0}).x));
  CHECK(std::isnan(undistorted(kBrown, {0.9, 0}).x));
  CHECK(std::isnan(undistorted(kFisheye, {NAN, 0}).x));
  for (const double tiny : {0.0, 1e-300, 1e-160, 1e-130})
    for (const Lens& lens :
         {kBrown, kFisheye, unifiedLens(0.6), doubleSphereLens(0.25, 0.6), omniLens(0.5), fovLens(1)}) {
      CHECK(distorted(lens, {tiny, 0, 1}).x == closely(tiny));
      CHECK(undistorted(lens, {tiny, 0}).x == closely(tiny));
      CHECK(undistorted(lens, {tiny, 0}).z == 1);
    }
}
