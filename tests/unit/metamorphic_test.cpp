// The same scene said in another way has the same picture, and shapes are seen where their points are. No truth is
// needed: only pairs of results that must agree. The number of random scenes: VIEWPROJ_SCENES in the environment.
#include <cstdlib>
#include <map>

#include "catch.hpp"
#include "random.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;

namespace {

std::uint64_t scenesWanted() {
  const char* wanted = std::getenv("VIEWPROJ_SCENES");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 400;
}

constexpr Viewport kViewport{.width = 1920, .height = 1080};

/// Small integers, ordinary numbers, and magnitudes up to 10^decades.
double number(Random& r, double decades = 20) {
  const std::size_t kind = r.below(5);
  if (kind == 0) return double(r.below(11)) - 5;
  if (kind == 1) return r.sign() * std::pow(10, r.uniform(-decades, decades));
  return r.uniform(-10, 10);
}
Vec3 vector(Random& r, double decades = 20) {
  const double x = number(r, decades), y = number(r, decades);
  return {x, y, number(r, decades)};
}

Vec3 operator*(const Vec3& a, double k) { return {a.x * k, a.y * k, a.z * k}; }
Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 cycled(const Vec3& a) { return {a.z, a.x, a.y}; }
Vec3 mirrored(const Vec3& a) { return {-a.x, a.y, a.z}; }

enum class By { direction, target, rotation, turns, matrix };

struct Scene {
  By by = By::direction;
  Vec3 eye, way, up;
  Handedness world = Handedness::right;
  Quaternion rotation;
  std::array<Turn, 3> turns;
  Mat4 matrix;
  bool orthographic = false;
  std::array<double, 4> edges{};
  double near = 1, far = 2;
};

Scene randomScene(Random& r) {
  Scene s;
  constexpr By kAll[] = {By::direction, By::target, By::rotation, By::turns, By::matrix};
  s.by = r.oneOf(kAll);
  s.eye = vector(r), s.way = vector(r), s.up = vector(r);
  s.world = r.coin() ? Handedness::right : Handedness::left;
  s.rotation = {number(r), number(r), number(r), number(r)};
  for (int i = 0; i < 3; ++i)
    s.turns[std::size_t(i)] = {int(r.below(3)), r.coin() ? 45 * double(r.below(8)) : r.uniform(-180, 180)};
  // A turn about z that is not quite one, and a mirror for a left-handed world.
  const double a = r.uniform(-3, 3), off = r.coin() ? 0 : 1e-4;
  s.matrix.m = {{{std::cos(a), -std::sin(a), off, s.eye.x},
                 {std::sin(a), std::cos(a), 0, s.eye.y},
                 {0, off, 1, s.eye.z},
                 {0, 0, 0, 1}}};
  s.near = std::fabs(number(r)) + 1e-3;
  s.far = s.near * (1 + std::pow(10, r.uniform(-2, 6)));
  s.orthographic = r.oneIn(3);
  const double x = r.uniform(-2, 2), y = r.uniform(-2, 2);
  s.edges = {x, x + r.uniform(.01, 3), y, y + r.uniform(.01, 3)};
  if (r.coin()) s.edges = {-1, 1, -1, 1};
  return s;
}

Pose poseOf(const Scene& s) {
  const CameraAxes axes = s.world == Handedness::right ? CameraAxes::RUB : CameraAxes::RUF;
  if (s.by == By::direction) return lookAlong(s.eye, s.way, s.up, s.world);
  if (s.by == By::target) return lookAt(s.eye, s.way, s.up, s.world);
  if (s.by == By::rotation) return poseFromRotation(s.eye, s.rotation, axes);
  if (s.by == By::turns) return poseFromTurns(s.eye, s.turns, axes);
  return poseFromWorldFromCamera(s.matrix, axes);
}

Camera cameraOf(const Scene& s, const Pose& pose) {
  const auto [left, right, bottom, top] = s.edges;
  const Projection p = s.orthographic ? orthographic(left, right, bottom, top, s.near, s.far)
                                      : perspectiveWindow(left, right, bottom, top, s.near, s.far);
  return makeCamera(pose, p, kViewport, {.world = s.world});
}
Camera cameraOf(const Scene& s) { return cameraOf(s, poseOf(s)); }

bool isSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// unit: that of the second scene's lengths in the first one's.
bool agree(const ScreenPoint& a, const ScreenPoint& b, double unit = 1) {
  if (a.status != b.status) return false;
  if (!a.certain || !b.certain) return true;
  return isSame(a.x, b.x) && isSame(a.y, b.y) && isSame(a.depth, b.depth) &&
         isSame(a.viewDistance * unit, b.viewDistance) && a.outside == b.outside;
}

}  // namespace

TEST_CASE("The same scene said in another way has the same picture, to the last bit") {
  std::map<std::string, int> compared;
  for (std::uint64_t seed = 0; seed < scenesWanted(); ++seed) {
    Random r(seed);
    const Scene s = randomScene(r);
    try {
      const Camera camera = cameraOf(s);
      const Pose pose = camera.pose();
      const double unit = std::ldexp(1, int(r.below(81)) - 40), factor = std::ldexp(1, int(r.below(41)) - 20);
      std::array<Vec3, 4> points;
      for (Vec3& p : points) p = s.eye + (r.coin() ? vector(r) : pose.forward() * r.logUniform(1e-3, 1e5) + vector(r));
      const auto compare = [&](const std::string& way, const Camera& other, const auto& moved, double lengths = 1) {
        for (const Vec3& p : points) {
          INFO("scene " << seed << ", " << way << ": " << p.x << " " << p.y << " " << p.z);
          REQUIRE(agree(worldToScreen(camera, p), worldToScreen(other, moved(p)), lengths));
          ++compared[way];
        }
      };
      const auto inPlace = [](const Vec3& p) { return p; };
      if (s.by == By::direction || s.by == By::target) {
        Scene t = s;
        t.eye = cycled(s.eye), t.way = cycled(s.way), t.up = cycled(s.up);
        compare("axes exchanged", cameraOf(t), cycled);
        t.eye = mirrored(s.eye), t.way = mirrored(s.way), t.up = mirrored(s.up);
        t.world = s.world == Handedness::right ? Handedness::left : Handedness::right;
        compare("mirrored", cameraOf(t), mirrored);
        t = s;
        if (s.by == By::direction) t.way = s.way * factor;
        t.up = s.up * factor;
        compare("longer directions", cameraOf(t), inPlace);
      }
      if (s.by == By::rotation) {
        const auto [x, y, z, w] = s.rotation;
        Scene t = s;
        t.rotation = {-x, -y, -z, -w};
        compare("negated quaternion", cameraOf(t), inPlace);
        t.rotation = {x * factor, y * factor, z * factor, w * factor};
        compare("longer quaternion", cameraOf(t), inPlace);
      }
      Scene t = s;
      t.eye = s.eye * unit, t.near *= unit, t.far *= unit;
      if (s.by == By::target) t.way = s.way * unit;
      for (std::size_t i = 0; i < 3; ++i) t.matrix[i][3] *= unit;
      if (s.orthographic)
        for (double& edge : t.edges) edge *= unit;
      compare(
          "another unit", cameraOf(t), [&](const Vec3& p) { return p * unit; }, unit);
      compare("moved to its own eye", cameraOf(s, movedTo(pose, pose.eye())), inPlace);
      for (const Vec3& p : points) {
        const double w = r.sign() * factor;
        INFO("scene " << seed << ", weight " << w << ": " << p.x << " " << p.y << " " << p.z);
        REQUIRE(agree(worldToScreen(camera, p), worldToScreen(camera, Vec4{p.x * w, p.y * w, p.z * w, w})));
      }
      for (const Precision precision : {Precision::exact, Precision::standard}) {
        std::array<ScreenPoint, 4> all;
        worldToScreen(camera, points, all, precision);
        for (std::size_t i = 0; i < 4; ++i) {
          const ScreenPoint one = worldToScreen(camera, points[i], precision);
          INFO("scene " << seed << ", in a batch: " << points[i].x << " " << points[i].y << " " << points[i].z);
          REQUIRE(agree(one, all[i]));
          REQUIRE(std::signbit(one.viewDistance) == std::signbit(all[i].viewDistance));
        }
      }
    } catch (const CameraError&) {  // numbers that make no camera
      ++compared["no camera"];
    }
  }
  for (const char* way : {"axes exchanged", "mirrored", "longer directions", "negated quaternion", "longer quaternion",
                          "another unit", "moved to its own eye"})
    CHECK(compared[way] > int(scenesWanted()) / 4);
  CHECK(compared["no camera"] < int(scenesWanted()) / 2);
}

TEST_CASE("A shape is not outside if a point of it is inside, nor inside if one is outside") {
  int seen = 0;
  for (std::uint64_t seed = 0; seed < scenesWanted(); ++seed) {
    Random r(seed);
    Scene s = randomScene(r);
    if (s.orthographic && r.coin()) s.near = -1e40, s.far = 1e40;
    try {
      const Camera camera = cameraOf(s);
      const Frustum f = viewFrustum(camera);
      for (int i = 0; i < 10; ++i) {
        const auto anywhere = [&] {
          const Vec2 pixel{960 * double(r.below(3)), 540 * double(r.below(3))};
          const WorldPoint seenThere = screenToWorldAtDistance(camera, pixel, std::fabs(number(r, 40)));
          return seenThere.status == DepthStatus::point && r.oneIn(3) ? seenThere.position : s.eye + vector(r, 40);
        };
        const Vec3 a = anywhere(), b = anywhere(), c = anywhere();
        const Box box{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                      {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
        const auto requireFits = [&](const Cull& shape, const Vec3& part) {
          const CullVerdict verdict = cull(f, part).verdict;
          INFO("scene " << seed << "." << i << ": " << part.x << " " << part.y << " " << part.z);
          REQUIRE_FALSE((shape.verdict == CullVerdict::outside && verdict == CullVerdict::inside));
          REQUIRE_FALSE((shape.verdict == CullVerdict::inside && verdict == CullVerdict::outside));
          seen += verdict == CullVerdict::inside;
        };
        for (const Vec3& vertex : {a, b, c}) requireFits(cull(f, Triangle{a, b, c}), vertex);
        for (const Vec3& corner : {a, b}) requireFits(cull(f, box), corner);
        requireFits(cull(f, Sphere{a, std::fabs(number(r, 40))}), a);
      }
    } catch (const CameraError&) {
    }
  }
  CHECK(seen > int(scenesWanted()));
}

TEST_CASE("A triangle with a vertex on a plane is seen, though the others lie far beyond it and nearer to it") {
  int onPlane = 0;
  for (std::uint64_t seed = 0; seed < scenesWanted(); ++seed) {
    Random r(seed);
    const Vec3 forward = r.vector(1);
    const Camera camera = makeCamera(lookAlong({0, 0, 0}, forward, r.vector(1), Handedness::right),
                                     orthographic(0, 1, -1, 1, -1e45, 1e45), {.width = 100, .height = 100});
    const Frustum f = viewFrustum(camera);
    const Vec3 right = camera.pose().right(), seen = forward * 0x1p148;
    REQUIRE(worldToScreen(camera, seen).visible());
    REQUIRE(cull(f, seen).verdict == CullVerdict::inside);
    CHECK(cull(f, Triangle{right * -1e-3, right * -1e43, seen}).verdict != CullVerdict::outside);
    ++onPlane;
  }
  CHECK(onPlane == int(scenesWanted()));
}

TEST_CASE(
    "Far beside the view a point of a turned camera is in front, and a box that holds the view's middle is seen") {
  // A roll leaves forward at 0 0 -1.
  for (const double roll : {30.0, 1e-9, 77.7}) {
    const Pose pose = poseFromTurns({0, 0, 0}, {{{2, roll}, {0, 0}, {1, 0}}}, CameraAxes::RUB);
    const Camera camera = makeCamera(pose, perspective(60, 1, .1, 1e3), {.width = 1000, .height = 1000});
    for (const double x : {1e38, 1e40, 1e43, 1e45}) {
      const ScreenPoint p = worldToScreen(camera, Vec3{x, 0, -8});
      CHECK(p.status == PointStatus::inFront);
      CHECK(p.viewDistance == 8);
      CHECK(cull(viewFrustum(camera), Box{{-x, -1, -8}, {x, 1, -7}}).verdict != CullVerdict::outside);
    }
  }
}

TEST_CASE("A camera and a point that are within their errors show nothing farther than the bound") {
  int tight = 0, through = 0;
  for (std::uint64_t seed = 0; seed < scenesWanted(); ++seed) {
    Random r(seed);
    const double eyeError = r.oneIn(4) ? 0 : r.logUniform(1e-9, 1e-3),
                 angle = r.oneIn(4) ? 0 : r.logUniform(1e-9, 1e-4);
    const double pointError = r.oneIn(4) ? 0 : r.logUniform(1e-9, 1e-3);
    const Vec3 eye = r.vector(10), forward = r.direction(), up = r.direction();
    const bool isFlat = r.oneIn(3);
    const Projection p =
        isFlat ? orthographic(-2, 2, -1, 1, .1, 100) : perspective(r.uniform(20, 100), kViewport, .1, 100);
    // What turns forward and up by the angle at most: they move across by it, and roll with the rest.
    const auto turned = [&](const Vec3& v) { return v + r.direction(angle / 3); };
    const auto cameraAt = [&](const Pose& pose) {
      const Camera c = makeCamera(pose, p, kViewport);
      return isFlat || seed % 3 != 0 ? c : withLens(c, brownLens({-.1, .02}, {1e-3, -1e-3}));
    };
    const Pose pose = lookAlong(eye, forward, up, Handedness::right);
    const double sine = pose.up().x * up.x + pose.up().y * up.y + pose.up().z * up.z;
    if (sine < .5) continue;
    const Camera camera = cameraAt(withError(pose, {eyeError, 2 * angle}));
    through += lensOf(camera).has_value();
    for (int i = 0; i < 8; ++i) {
      const double distance = r.logUniform(.2, 50);
      const Vec3 point = eye + forward * distance + r.direction(distance * r.uniform(0, .8));
      const ErrorBound bound = boundOfPoint(camera, point, Precision::exact, pointError);
      const Camera other =
          cameraAt(lookAlong(eye + r.direction(eyeError), turned(forward), turned(up), Handedness::right));
      const ScreenPoint a = worldToScreen(camera, point), b = worldToScreen(other, point + r.direction(pointError));
      if (a.status != PointStatus::inFront || b.status != PointStatus::inFront) continue;
      const double shift = std::max(std::fabs(a.x - b.x), std::fabs(a.y - b.y));
      INFO("scene " << seed << "." << i << ": " << shift << " of " << bound.screen << ", depth " << a.depth - b.depth);
      REQUIRE(shift <= bound.screen);
      REQUIRE(std::fabs(a.depth - b.depth) <= bound.depth);
      tight += shift > bound.screen / 20;
      const WorldPoint back = screenToWorldAtDistance(camera, {a.x, a.y}, a.viewDistance);
      const WorldPoint there = screenToWorldAtDistance(other, {a.x, a.y}, a.viewDistance);
      const Vec3 off = back.position + there.position * -1.0;
      REQUIRE(std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z) <= back.bound + there.bound);
    }
  }
  CHECK(tight > int(scenesWanted()) / 4);
  CHECK(through > int(scenesWanted()) / 20);
}
