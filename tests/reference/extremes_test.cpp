// Cameras and points at the ends of what doubles can say.
#include <functional>
#include <set>

#include "catch.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"
#include "viewproj/numbers/degrees.hpp"

using namespace viewproj;
using namespace reference;

namespace {

/// A plain camera: 60 degrees, 1920x1080, looking from a random place in a random direction.
Scene plainScene(Random& r) {
  Scene s;
  s.position = r.vector(100);
  s.target = r.vector(100);
  s.near = 0.1;
  s.far = 1000;
  return s;
}

void scaleScene(Scene& s, double k) {
  for (Vec3* v : {&s.position, &s.target})
    for (std::size_t i = 0; i < 3; ++i) (*v)[i] *= k;
  s.near *= k;
  s.far *= k;
}

void nearlyParallelUp(Random& r, Scene& s, double angle) {
  const Vec3 jitter = r.vector(angle);
  for (std::size_t i = 0; i < 3; ++i) s.up[i] = s.target[i] - s.position[i];
  const double size = maxAbs(s.up);
  for (std::size_t i = 0; i < 3; ++i) s.up[i] = s.up[i] / size + jitter[i];
}

void moveTo(Random& r, Scene& s, double distance) {
  const Vec3 way = r.vector(10);
  s.position = r.vector(distance);
  for (std::size_t i = 0; i < 3; ++i) s.target[i] = s.position[i] + std::max(1.0, distance * 1e-9) * way[i];
}

struct Family {
  const char* name;
  std::function<void(Random&, Scene&)> make;
  int fewestVisible = 50;  ///< doubles are too coarse for a window of 1e-30 degrees
};

const Family kFamilies[] = {
    {"ordinary", [](Random&, Scene&) {}},
    {"far/near 1e15", [](Random&, Scene& s) { s.far = s.near * 1e15; }},
    {"far/near 1e300", [](Random&, Scene& s) { s.near = 1e-3, s.far = 1e297; }},
    {"near 1e-300, far 1e300", [](Random&, Scene& s) { s.near = 1e-300, s.far = 1e300; }},
    {"infinite far", [](Random&, Scene& s) { s.far = kInfiniteFar; }},
    {"reversed infinite", [](Random&, Scene& s) { s.far = kInfiniteFar, s.convention.reverseZ = true; }},
    {"fov 1e-6", [](Random&, Scene& s) { s.fov = 1e-6; }},
    {"fov 1e-30", [](Random&, Scene& s) { s.fov = 1e-30; }, 0},
    {"fov 1e-100", [](Random&, Scene& s) { s.fov = 1e-100; }, 0},
    {"fov 179.9", [](Random&, Scene& s) { s.fov = 179.9; }},
    {"fov 179.999999", [](Random&, Scene& s) { s.fov = 179.999999; }},
    {"fov next to 180", [](Random&, Scene& s) { s.fov = std::nextafter(180, 0); }},
    {"ECEF", [](Random& r, Scene& s) { moveTo(r, s, 6.4e6); }},
    {"eye 1e12", [](Random& r, Scene& s) { moveTo(r, s, 1e12); }},
    {"scale 1e-160", [](Random&, Scene& s) { scaleScene(s, 1e-160); }},
    {"scale 1e200", [](Random&, Scene& s) { scaleScene(s, 1e200); }},
    {"scale 1e-300", [](Random&, Scene& s) { scaleScene(s, 1e-300); }},
    {"scale 1e300", [](Random&, Scene& s) { scaleScene(s, 1e300); }},
    {"up 1e-8 off parallel", [](Random& r, Scene& s) { nearlyParallelUp(r, s, 1e-8); }},
    {"up 1e-15 off parallel", [](Random& r, Scene& s) { nearlyParallelUp(r, s, 1e-15); }},
    {"off-centre tile of 1e-9",
     [](Random& r, Scene& s) {
       s.lensKind = LensKind::frustum;
       s.left = r.uniform(-1, 1), s.bottom = r.uniform(-1, 1);
       s.right = s.left + 1e-9, s.top = s.bottom + 1e-9;
     }},
    {"depth slab of 1e-12", [](Random&, Scene& s) { s.far = s.near * (1 + 1e-12); }},
    {"orthographic at 1e9",
     [](Random& r, Scene& s) {
       moveTo(r, s, 1e9);
       s.lensKind = LensKind::orthographic;
       s.left = -10, s.right = 10, s.bottom = -5, s.top = 5;
     }},
};

/// Points inside the view, then ones next to its edge and next to the eye plane.
Vec3 randomPoint(Random& r, const Truth& truth, int i) {
  if (i == 0) return pointInView(r, truth, 3);
  return pointInView(r, truth);
}

}  // namespace

TEST_CASE("Exact projection and rays keep their promise in every extreme family") {
  for (const Family& family : kFamilies) {
    int visible = 0;
    double worstRay = 0;
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
      Random random(trial);
      Scene scene = plainScene(random);
      family.make(random, scene);
      const Truth truth(scene);
      const Camera camera = build(scene);
      INFO(family.name << ", trial " << trial << ": " << describe(scene));
      for (int i = 0; i < 4; ++i) {
        const Vec3 point = randomPoint(random, truth, i);
        const Truth::View view = truth.view(toReal(point));
        if (!truth.lens.orthographic && !(view.forward > Real(0))) {
          REQUIRE(worldToScreen(camera, point).status == PointStatus::behind);
          continue;
        }
        const Truth::Screen screen = truth.screen(view);
        const ScreenPoint got = worldToScreen(camera, point);
        CAPTURE(i, got.x, double(screen.x), got.depth, double(screen.depth), got.viewDistance, double(view.forward));
        REQUIRE(isExact(got.x, screen.x, 1920));
        REQUIRE(isExact(got.y, screen.y, 1920));
        REQUIRE(isExact(got.depth, screen.depth, 1));
        REQUIRE(isExact(got.viewDistance, view.forward, scene.near));
        visible += got.visible();
      }
      const Vec2 pixel{random.uniform(0, 1920), random.uniform(0, 1080)};
      const Real3 direction = truth.direction(truth.window(pixel.x, pixel.y));
      for (Precision precision : {Precision::standard, Precision::exact}) {
        const double off = angle(toReal(screenToRay(camera, pixel, precision).direction), direction);
        worstRay = std::max(worstRay, off);
        REQUIRE(off <= kRayDirectionBound);
      }
    }
    INFO(family.name);
    CAPTURE(worstRay);
    CHECK(visible >= family.fewestVisible);
  }
}

TEST_CASE("Next to the eye plane the side is exact, and so is the screen position") {
  int onPlane = 0, inFront = 0, behind = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    Scene scene = plainScene(random);
    // Whole numbers, so that points can lie in the eye plane exactly.
    const auto whole = [&](double size) {
      Vec3 v = random.vector(size);
      for (std::size_t i = 0; i < 3; ++i) v[i] = std::floor(v[i]);
      return v;
    };
    scene.position = whole(1000);
    const Vec3 way = whole(100);
    if (maxAbs(way) == 0 || (way.x == 0 && way.z == 0)) continue;
    for (std::size_t i = 0; i < 3; ++i) scene.target[i] = scene.position[i] + way[i];
    const Vec3 other = whole(100);
    Vec3 point{scene.position.x + way.y * other.z - way.z * other.y,
               scene.position.y + way.z * other.x - way.x * other.z,
               scene.position.z + way.x * other.y - way.y * other.x};
    // Every other one moved off the plane by a few of its last digits.
    if (trial % 2) point.x += random.sign() * random.spread(1e-13, 1e-3) * std::max(1.0, std::fabs(point.x));
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Truth::View view = truth.view(toReal(point));
    // Whole numbers below 2^53: the plane equation is exact in doubles; 480 bits leave 1e-140 of noise.
    const bool isOnPlane = abs(view.forward) < Real(1e-100);
    INFO("trial " << trial);
    for (Precision precision : {Precision::standard, Precision::exact}) {
      const ScreenPoint got = worldToScreen(camera, point, precision);
      if (isOnPlane || !(view.forward > Real(0))) {
        REQUIRE(got.status == PointStatus::behind);
        REQUIRE(std::isnan(got.x));
      } else {
        REQUIRE(got.status == PointStatus::inFront);
        if (precision == Precision::standard) continue;
        const Truth::Screen screen = truth.screen(view);
        REQUIRE(isExact(got.x, screen.x, 1920));
        REQUIRE(isExact(got.y, screen.y, 1920));
        REQUIRE(isExact(got.depth, screen.depth, 1));
      }
    }
    (isOnPlane ? onPlane : view.forward > Real(0) ? inFront : behind)++;
  }
  CAPTURE(onPlane, inFront, behind);
  CHECK(onPlane > 300);
  CHECK(inFront > 300);
  CHECK(behind > 300);
}

TEST_CASE("Rays of pixels far outside the picture keep the bound") {
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    Scene scene = plainScene(random);
    scene.fov = random.spread(1e-3, 179.9);
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Vec2 pixel{random.sign() * random.spread(1, 1e100), random.sign() * random.spread(1, 1e200)};
    const Real3 direction = truth.direction(truth.window(pixel.x, pixel.y));
    INFO("trial " << trial << ": pixel " << pixel.x << " " << pixel.y);
    for (Precision precision : {Precision::standard, Precision::exact})
      REQUIRE(angle(toReal(screenToRay(camera, pixel, precision).direction), direction) <= kRayDirectionBound);
  }
}

TEST_CASE("Homogeneous points are divided by their weight exactly, negative and extreme weights included") {
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    Scene scene = plainScene(random);
    if (trial % 2) moveTo(random, scene, 1e9);
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Vec3 p = pointInView(random, truth);
    const double w = random.sign() * random.spread(1e-200, 1e200);
    const Vec4 point{p.x * w, p.y * w, p.z * w, w};
    const Real k = Real(1) / Real(w);
    const Truth::View view = truth.view(Real3{point.x, point.y, point.z} * k);
    const ScreenPoint got = worldToScreen(camera, point);
    INFO("trial " << trial << ": w " << w);
    if (!(view.forward > Real(0))) {
      REQUIRE(got.status == PointStatus::behind);
      continue;
    }
    const Truth::Screen screen = truth.screen(view);
    REQUIRE(isExact(got.x, screen.x, 1920));
    REQUIRE(isExact(got.y, screen.y, 1920));
    REQUIRE(isExact(got.depth, screen.depth, 1));
    REQUIRE(isExact(got.viewDistance, view.forward, scene.near));
  }
}

TEST_CASE("A direction gives its vanishing point, or is behind") {
  int behind = 0;
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    Scene scene = plainScene(random);
    scene.far = trial % 2 ? kInfiniteFar : 1000;
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Vec3 d = random.vector(random.spread(1e-300, 1e300));
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

TEST_CASE("Subnormal points and points of the largest doubles are projected") {
  Random random(1);
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    Scene scene = plainScene(random);
    const double size = trial % 2 ? 1e-310 : 1.7e308;
    scene.position = trial % 2 ? Vec3{1e-311, 2e-311, 3e-310} : Vec3{-1.7e308, 1e308, 1e307};
    scene.target = {0, 0, 0};
    scene.near = size * 1e-3, scene.far = kInfiniteFar;
    if (scene.near == 0) continue;
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Vec3 point = random.vector(size);
    const Truth::View view = truth.view(toReal(point));
    const ScreenPoint got = worldToScreen(camera, point);
    INFO("trial " << trial);
    if (!(view.forward > Real(0))) {
      REQUIRE(got.status == PointStatus::behind);
      continue;
    }
    const Truth::Screen screen = truth.screen(view);
    REQUIRE(isExact(got.x, screen.x, 1920));
    REQUIRE(isExact(got.y, screen.y, 1920));
  }
}

TEST_CASE("The tangent of half an angle is within its bound from 1e-200 degrees to next to 180") {
  double worst = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial);
    const double degrees = trial % 3 == 0   ? random.uniform(0, 180)
                           : trial % 3 == 1 ? random.spread(1e-200, 180)
                                            : 180 - random.spread(1e-13, 90);
    const Real truth = tanDegrees(Real(degrees) / Real(2));
    const DoubleDouble got = tanHalfDegrees(degrees);
    const double error = double(abs((Real(got.hi) + Real(got.lo) - truth) / truth));
    worst = std::max(worst, error);
    INFO(degrees);
    REQUIRE(error <= kTanHalfDegreesBound);
  }
  CHECK(worst > 0x1p-110);
}
