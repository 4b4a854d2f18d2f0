// Cameras and points at the ends of what doubles can say.
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "numbers/degrees.hpp"
#include "reference/bounds/families.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

TEST_CASE("A coordinate that cancels to the rounding of its point has its digits, and is certain of no other") {
  int certain = 0, doubtful = 0;
  for (std::uint64_t trial = 0; trial < 4000; ++trial) {
    Random random(trial);
    Scene scene;
    scene.position = random.vector(1);
    scene.target = random.vector(1);
    scene.viewport.x = -960;  // the middle of the picture is 0, and hides no digit
    scene.viewport.y = -540;
    const Camera camera = build(scene);
    const DDVec3 &right = parts(camera).pose.rows.right, &forward = parts(camera).pose.rows.forward;
    const double aside = random.logUniform(1e-3, 1e18);
    Vec3 point;
    for (std::size_t i = 0; i < 3; ++i) point[i] = scene.position[i] + forward[i].hi + aside * right[i].hi;
    const Truth truth(scene);
    const Truth::View view = truth.view(toReal(point));
    if (!(view.forward > Real(1e-3))) continue;
    const Truth::Screen screen = truth.screen(view);
    const ScreenPoint got = worldToScreen(camera, point);
    INFO("trial " << trial << ", " << aside);
    REQUIRE(isExact(got.x, screen.x, 1920));
    REQUIRE(isExact(got.y, screen.y, 1920));
    REQUIRE(isExact(got.depth, screen.depth, 1));
    if (got.certain)
      REQUIRE((ulps(got.x, screen.x) <= 0.5 && ulps(got.y, screen.y) <= 0.5 && ulps(got.depth, screen.depth) <= 0.5));
    // Of numbers next to 0 the last digits may be below the error of the picture's own middle.
    if (abs(screen.y) > Real(1e-3)) REQUIRE(got.certain);
    ++(got.certain ? certain : doubtful);
    Vec3 screenOfBatch;
    REQUIRE(worldToScreen(camera, {&point, 1}, {&screenOfBatch, 1}).uncertain == (got.certain ? 0 : 1));
    // The other way up it is the other side of a tie that decides.
    scene.viewport.origin = Origin::bottomLeft;
    const ScreenPoint flipped = worldToScreen(build(scene), point);
    REQUIRE(flipped.y == -got.y);
    REQUIRE(flipped.certain == got.certain);
  }
  INFO(certain << " certain, " << doubtful << " not");
  CHECK(certain > 1000);
  CHECK(doubtful > 20);
}

TEST_CASE("Rays of pixels far outside the picture keep the bound") {
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    Scene scene = plainScene(random);
    scene.fov = random.logUniform(1e-3, 179.9);
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Vec2 pixel{random.sign() * random.logUniform(1, 1e45), random.sign() * random.logUniform(1, 1e45)};
    const Real3 direction = truth.direction(truth.window(pixel.x, pixel.y));
    INFO("trial " << trial << ": pixel " << pixel.x << " " << pixel.y);
    REQUIRE(angle(toReal(screenToRay(camera, pixel).direction), direction) <= kRayDirectionBound);
  }
}

TEST_CASE("Homogeneous points are divided by their weight exactly, negative and extreme weights included") {
  int inFront = 0;
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    Scene scene = plainScene(random);
    if (trial % 2) moveTo(random, scene, 1e9);
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Vec3 p = pointInView(random, truth);
    const double w = random.sign() * random.logUniform(1e-40, 1e40);
    const Vec4 point{p.x * w, p.y * w, p.z * w, w};
    const Real k = Real(1) / Real(w);
    const Truth::View view = truth.view(Real3{point.x, point.y, point.z} * k);
    const ScreenPoint got = worldToScreen(camera, point);
    INFO("trial " << trial << ": w " << w);
    if (!(view.forward > Real(0))) {
      REQUIRE(got.status == PointStatus::behind);
      continue;
    }
    ++inFront;
    const Truth::Screen screen = truth.screen(view);
    REQUIRE(isExact(got.x, screen.x, 1920));
    REQUIRE(isExact(got.y, screen.y, 1920));
    REQUIRE(isExact(got.depth, screen.depth, 1));
    REQUIRE(isExact(got.viewDistance, view.forward, scene.near));
  }
  CHECK(inFront > 400);
}

TEST_CASE("A direction gives its vanishing point, or is behind") {
  int behind = 0;
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    Scene scene = plainScene(random);
    scene.far = trial % 2 ? kInfiniteFar : 1000;
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Vec3 d = random.vector(random.logUniform(1e-300, 1e45));
    const Real3 way = toReal(d);
    const Truth::View view{dot(truth.pose.right, way), dot(truth.pose.up, way), dot(truth.pose.forward, way)};
    const ScreenPoint got = worldToScreen(camera, Vec4{d.x, d.y, d.z, 0});
    INFO("trial " << trial);
    if (!(view.forward > Real(0))) {
      ++behind;
      REQUIRE(got.status == PointStatus::behind);
      continue;
    }
    const Truth::Screen screen = truth.screen(view);
    REQUIRE(isExact(got.x, screen.x, 1920));
    REQUIRE(isExact(got.y, screen.y, 1920));
    REQUIRE(std::isnan(got.viewDistance));
    REQUIRE(((got.outside & sideFar) != 0) == (trial % 2 == 0));
  }
  CHECK(behind > 100);
}

TEST_CASE("The tangent of half an angle is within its bound from 1e-200 degrees to next to 180") {
  double worst = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial);
    const double degrees = trial % 3 == 0   ? random.uniform(0, 180)
                           : trial % 3 == 1 ? random.logUniform(1e-200, 180)
                                            : 180 - random.logUniform(1e-13, 90);
    const Real truth = tanDegrees(Real(degrees) / Real(2));
    const DoubleDouble got = tanHalfDegrees(degrees);
    const double error = double(abs((Real(got.hi) + Real(got.lo) - truth) / truth));
    worst = std::max(worst, error);
    INFO(degrees);
    REQUIRE(error <= kTanHalfDegreesBound);
  }
  CHECK(worst > 0x1p-110);
}

TEST_CASE(
    "A number that is not finite, or out of the range of a camera's, makes no camera, whichever of a camera's numbers "
    "it is") {
  struct Field {
    const char* name;
    double& (*of)(Scene&);
  };
  struct Kind {
    PoseKind pose;
    LensKind lens;
    std::vector<Field> fields;
  };
#define FIELD(member)                                      \
  Field {                                                  \
#member, [](Scene & s) -> double& { return s.member; } \
  }
  const std::vector<Field> always = {
      FIELD(near),
      FIELD(far),
      FIELD(shiftX),
      FIELD(shiftY),
      FIELD(viewport.width),
      FIELD(viewport.height),
      FIELD(viewport.x),
      FIELD(viewport.y),
      FIELD(viewport.pixelCenter),
      FIELD(viewport.depthFirst),
      FIELD(viewport.depthSecond),
  };
  const std::vector<Field> ofCrop = {FIELD(crop.x), FIELD(crop.y), FIELD(crop.width), FIELD(crop.height)};
  const Kind kinds[] = {
      {PoseKind::target,
       LensKind::fovY,
       {FIELD(fov), FIELD(position.x), FIELD(position.y), FIELD(position.z), FIELD(target.x), FIELD(target.y),
        FIELD(target.z), FIELD(up.x), FIELD(up.y), FIELD(up.z)}},
      {PoseKind::direction, LensKind::fovX, {FIELD(fov), FIELD(position.y), FIELD(target.x), FIELD(up.z)}},
      {PoseKind::rotation,
       LensKind::fovDiagonal,
       {FIELD(fov), FIELD(position.z), FIELD(rotation.x), FIELD(rotation.y), FIELD(rotation.z), FIELD(rotation.w)}},
      {PoseKind::worldFromCamera,
       LensKind::nearSize,
       {FIELD(right), FIELD(top), FIELD(matrix[0][0]), FIELD(matrix[1][2]), FIELD(matrix[2][3]), FIELD(matrix[3][3])}},
      {PoseKind::cameraFromWorld,
       LensKind::frustum,
       {FIELD(left), FIELD(right), FIELD(bottom), FIELD(top), FIELD(matrix[0][0]), FIELD(matrix[1][3]),
        FIELD(matrix[3][0])}},
      {PoseKind::target, LensKind::sensorBoth, {FIELD(sensorWidth), FIELD(sensorHeight), FIELD(focalLength)}},
      {PoseKind::target, LensKind::sensorWidth, {FIELD(sensorWidth), FIELD(focalLength)}},
      {PoseKind::target, LensKind::sensorHeight, {FIELD(sensorHeight), FIELD(focalLength)}},
      {PoseKind::target, LensKind::sensorDiagonal, {FIELD(sensorWidth), FIELD(focalLength)}},
      {PoseKind::target, LensKind::intrinsics, {FIELD(fx), FIELD(fy), FIELD(cx), FIELD(cy)}},
      {PoseKind::target, LensKind::orthographic, {FIELD(left), FIELD(right), FIELD(bottom), FIELD(top)}},
  };
#undef FIELD
  const auto isEntry = [](const std::string& name) {
    for (const char* const of : {"position", "target", "up", "rotation", "matrix"})
      if (name.starts_with(of)) return true;
    return false;
  };
  int rejected = 0;
  for (const Kind& kind : kinds)
    for (const bool hasCrop : {false, true}) {
      Random random(1);
      Scene good = plainScene(random);
      good.poseKind = kind.pose;
      good.lensKind = kind.lens;
      good.matrix.m = {{{1, 0, 0, 5}, {0, 1, 0, 6}, {0, 0, 1, 7}, {0, 0, 0, 1}}};
      good.hasCrop = hasCrop;
      good.crop = {10, 20, 30, 40};
      REQUIRE_NOTHROW(build(good));
      std::vector<Field> fields = kind.fields;
      fields.insert(fields.end(), always.begin(), always.end());
      if (hasCrop) fields.insert(fields.end(), ofCrop.begin(), ofCrop.end());
      for (const Field& field : fields)
        for (const double bad : {double(NAN), double(INFINITY), -double(INFINITY), 9e-46, 1.1e45, 5e-324, 1e300}) {
          Scene scene = good;
          double& number = field.of(scene);
          number = bad;
          if (&number == &scene.far && bad == INFINITY && kind.lens != LensKind::orthographic) continue;
          if (std::fabs(bad) < kSmallestNumber && isEntry(field.name)) continue;  // counts as 0
          INFO("lens kind " << int(kind.lens) << ", crop " << hasCrop << ", " << field.name << " = " << bad);
          CHECK_THROWS_AS(build(scene), CameraError);
          ++rejected;
        }
    }
  CHECK(rejected > 500);
}

TEST_CASE("What lies farther from the eye than 1e46 has no number, and what lies a little less far has") {
  Scene scene;
  scene.position = {-9e44, 0, 0};
  scene.target = {1, 0, 0};
  const Camera camera = build(scene);
  for (Precision precision : {Precision::standard, Precision::exact}) {
    CHECK(worldToScreen(camera, Vec3{9.0e45, 0, 0}, precision).status == PointStatus::inFront);
    CHECK(worldToScreen(camera, Vec3{9.2e45, 0, 0}, precision).status == PointStatus::outOfRange);
    CHECK(worldToScreen(camera, Vec3{4e45, 3e45, 3e45}, precision).status == PointStatus::outOfRange);
    CHECK(worldToScreen(camera, Vec4{9.0e45, 0, 0, 0}, precision).status == PointStatus::inFront);
    CHECK(worldToScreen(camera, Vec4{1.1e46, 0, 0, 0}, precision).status == PointStatus::outOfRange);
    CHECK(worldToScreen(camera, Vec4{-9.0e90, 0, 0, -1e45}, precision).status == PointStatus::inFront);
    for (const double weight : {1.1e90, 9e-91, 5e-324, double(INFINITY), double(NAN)})
      CHECK(worldToScreen(camera, Vec4{weight, 0, 0, weight}, precision).status == PointStatus::outOfRange);
  }
  CHECK(std::isnan(screenToRay(camera, {1.1e46, 0}).direction.x));
  CHECK(std::isfinite(screenToRay(camera, {9e45, 0}).direction.x));
}

TEST_CASE("A point or a pixel that is not finite gives no number, in every precision") {
  Random random(1);
  const Camera camera = build(plainScene(random));
  for (const double bad : {double(NAN), double(INFINITY), -double(INFINITY)}) {
    for (std::size_t i = 0; i < 3; ++i)
      for (Precision precision : {Precision::standard, Precision::exact}) {
        Vec3 point{1, 2, 3};
        point[i] = bad;
        const ScreenPoint got = worldToScreen(camera, point, precision);
        INFO("component " << i << " = " << bad << ", precision " << int(precision));
        CHECK(got.status == PointStatus::outOfRange);
        CHECK((std::isnan(got.x) && std::isnan(got.y) && std::isnan(got.depth) && std::isnan(got.viewDistance)));
        CHECK(std::isinf(boundOfPoint(camera, point, precision).screen));
      }
    CHECK(worldToScreen(camera, Vec4{1, 2, 3, bad}).status == PointStatus::outOfRange);
    for (const Vec2& pixel : {Vec2{bad, 1}, Vec2{1, bad}}) {
      CHECK(std::isnan(screenToRay(camera, pixel).direction.x));
      CHECK(screenToWorld(camera, pixel, 0.5).status == DepthStatus::notFinite);
    }
    CHECK(screenToWorld(camera, {1, 1}, bad).status == DepthStatus::notFinite);
  }
}

TEST_CASE("A pixel at a distance is unprojected exactly from the smallest to the largest scale") {
  for (const double scale : {1e-40, 1e-20, 1e20, 1e35, 1e42})
    for (std::uint64_t trial = 0; trial < 100; ++trial) {
      Random random(trial);
      Scene scene = plainScene(random);
      scene.far = 100;
      scaleScene(scene, scale);
      const Truth truth(scene);
      const Camera camera = build(scene);
      const Vec2 pixel{random.uniform(0, 1920), random.uniform(0, 1080)};
      const double distance = random.logUniform(scene.near, scene.far);
      const WorldPoint got = screenToWorldAtDistance(camera, pixel, distance);
      INFO("scale " << scale << ", trial " << trial << ": distance " << distance);
      REQUIRE(got.status == DepthStatus::point);
      const Real3 want = truth.pointAt(truth.window(pixel.x, pixel.y), distance);
      for (std::size_t i = 0; i < 3; ++i) REQUIRE(isExact(got.position[i], want[i], scale));
    }
}
