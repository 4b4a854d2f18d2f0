// What programs that hold matrices, floats or a moving camera call.
#include <cstring>

#include "catch.hpp"
#include "field_at_fault.hpp"
#include "parts.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;

namespace {

constexpr Viewport kViewport{.width = 1280, .height = 720};

Camera cameraOf(Random& r, const Convention& convention) {
  const Pose pose = lookAlong(r.vector(1e3), r.direction(), r.direction(), convention.world);
  const double near = r.logUniform(1e-2, 1), x = r.uniform(-.5, .5), y = r.uniform(-.5, .5);
  if (r.oneIn(3))
    return makeCamera(pose, orthographic(x - 2, x + 2, y - 1, y + 1, -near, near * 1e3), kViewport, convention);
  const double far = r.oneIn(3) ? kInfiniteFar : near * r.logUniform(10, 1e4);
  return makeCamera(pose, perspectiveWindow(x - 1, x + 1, y - .5, y + .5, near, far), kViewport, convention);
}

Vec3 seenPoint(Random& r, const Camera& c) {
  const Projection p = c.projection();
  const double from = std::max(p.zNear(), 1e-2), to = std::isinf(p.zFar()) ? from * 1e4 : p.zFar();
  const Vec2 pixel{r.uniform(0, kViewport.width), r.uniform(0, kViewport.height)};
  return screenToWorldAtDistance(c, pixel, r.logUniform(from, to)).position;
}

}  // namespace

TEST_CASE(
    "A camera of view and projection matrices has the pixels of the camera that wrote them, in every convention") {
  int floats = 0, infinite = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random r(trial);
    const ConventionPreset& preset = conventionPresets()[r.below(conventionPresets().size())];
    Convention convention = preset;
    if (r.coin()) convention.reverseZ = !convention.reverseZ;
    const Camera camera = cameraOf(r, convention);
    const auto view = storedMatrix<double>(camera, Space::view, Space::world);
    const auto projection = storedMatrix<double>(camera, Space::clip, Space::view);
    const bool isFloat = r.coin();
    const Camera same =
        isFloat ? cameraFromMatrices(storedMatrix<float>(camera, Space::view, Space::world),
                                     storedMatrix<float>(camera, Space::clip, Space::view), kViewport, convention)
                : cameraFromMatrices(view.data(), projection.data(), kViewport, convention);
    INFO("trial " << trial << ", " << preset.name << (isFloat ? ", float" : ""));
    REQUIRE(same.projection().isOrthographic() == camera.projection().isOrthographic());
    // A float's matrix has lost the eye to 1e3 units in 2^24, which far away does not show.
    const double eye = isFloat ? 1e-3 : 1e-12;
    for (std::size_t i = 0; i < 3; ++i) REQUIRE(std::fabs(same.pose().eye()[i] - camera.pose().eye()[i]) < eye);
    for (int i = 0; i < 4; ++i) {
      const Vec3 point = seenPoint(r, camera);
      const ScreenPoint a = worldToScreen(camera, point), b = worldToScreen(same, point);
      if (isFloat && !camera.projection().isOrthographic() && a.viewDistance < 1) continue;
      // The eye's last digits show the more the nearer the point is.
      const double near = camera.projection().isOrthographic() ? 1 : std::max(1.0, 1 / a.viewDistance);
      const double pixel = near * (isFloat ? 1 : 1e-9);
      REQUIRE(std::fabs(a.x - b.x) < pixel);
      REQUIRE(std::fabs(a.y - b.y) < pixel);
      REQUIRE(std::fabs(a.depth - b.depth) < near * (isFloat ? 1e-3 : 1e-9));
    }
    const double zNear = camera.projection().zNear(), far = camera.projection().zFar();
    if (!isFloat) REQUIRE(std::fabs(same.projection().zNear() - zNear) <= 1e-9 * std::fabs(zNear));
    if (!isFloat && std::isinf(far)) REQUIRE(std::isinf(same.projection().zFar()));
    floats += isFloat;
    infinite += std::isinf(far);
  }
  CHECK(floats > 500);
  CHECK(infinite > 200);
}

TEST_CASE("A camera of matrices has the numbers of their entries, exactly") {
  // x' = (3 x - z / 2) / -z and y' = 2 y / -z: edges at (-1 - 1/2) / 3, (1 - 1/2) / 3, -1/2 and 1/2; near 0.5, far 1.5.
  Mat4 view, projection;
  view.m = {{{1, 0, 0, -1}, {0, 1, 0, -2}, {0, 0, 1, -3}, {0, 0, 0, 1}}};
  projection.m = {{{3, 0, -.5, 0}, {0, 2, 0, 0}, {0, 0, -2, -1.5}, {0, 0, -1, 0}}};
  const Camera camera = cameraFromMatrices(view, projection, kViewport, conventions::opengl);
  CHECK(camera.pose().eye() == Vec3{1, 2, 3});
  const Projection p = camera.projection();
  CHECK(p.left() == -.5);
  CHECK(p.right() == 1. / 6);
  CHECK(p.bottom() == -.5);
  CHECK(p.top() == .5);
  CHECK(p.zNear() == .5);
  CHECK(p.zFar() == 1.5);
  for (auto& row : projection.m)
    for (double& entry : row) entry *= 4;
  CHECK(cameraFromMatrices(view, projection, kViewport, conventions::opengl).projection().right() == 1. / 6);

  const auto faultOf = [&](std::size_t i, std::size_t j, double entry, bool ofView = false) {
    Mat4 v = view, q = projection;
    (ofView ? v : q)[i][j] = entry;
    return fieldAtFault([&] { cameraFromMatrices(v, q, kViewport, conventions::opengl); });
  };
  CHECK(faultOf(0, 1, .1) == "clipFromView");  // a skew
  CHECK(faultOf(0, 0, -3) == "clipFromView");  // a mirror
  CHECK(faultOf(3, 2, 4) == "clipFromView");   // looks along +z
  CHECK(faultOf(2, 3, 6) == "clipFromView");   // near behind the eye
  CHECK(faultOf(2, 2, NAN) == "clipFromView");
  CHECK(faultOf(0, 0, 1.01, true) == "viewFromWorld");
  CHECK(faultOf(0, 0, -1, true) == "viewFromWorld");
}

TEST_CASE("Points of floats and of any stride have the pixels of the same points as vectors") {
  struct Vertex {
    float u;
    float position[3];
    float normal[2];
  };
  struct Wide {
    double position[3];
    int name;
  };
  Random r(1);
  const Camera camera = makeCamera(lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right),
                                   perspective(60, kViewport, .1, 1000), kViewport);
  for (const std::size_t count : {0u, 1u, 191u, 192u, 193u, 1000u}) {
    std::vector<Vertex> vertices(count);
    std::vector<Wide> wide(count);
    std::vector<Vec3> points(count), expected(count), got(count), inPlace;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 p = r.vector(4);
      for (std::size_t k = 0; k < 3; ++k) {
        vertices[i].position[k] = static_cast<float>(p[k]);
        wide[i].position[k] = points[i][k] = vertices[i].position[k];
      }
    }
    for (const Precision precision : {Precision::exact, Precision::standard}) {
      const auto same = [&] {
        return count == 0 || std::memcmp(got.data(), expected.data(), count * sizeof(Vec3)) == 0;
      };
      worldToScreen(camera, points, expected, precision);
      if (count > 0) {
        worldToScreen(camera, Points(vertices[0].position, count, sizeof(Vertex)), got, precision);
        CHECK(same());
        worldToScreen(camera, Points(wide[0].position, count, sizeof(Wide)), got, precision);
        CHECK(same());
        std::vector<ScreenPoint> whole(count), of(count);
        worldToScreen(camera, points, whole, precision);
        worldToScreen(camera, Points(vertices[0].position, count, sizeof(Vertex)), of, precision);
        for (std::size_t i = 0; i < count; ++i) CHECK((whole[i].status != PointStatus::inFront || of[i] == whole[i]));
        CHECK(std::equal(of.begin(), of.end(), whole.begin(), [](const ScreenPoint& a, const ScreenPoint& b) {
          return a.status == b.status && a.outside == b.outside && a.certain == b.certain;
        }));
      }
      got = points;
      worldToScreen(camera, got, got, precision);
      CHECK(same());
    }
  }
}

TEST_CASE("A depth buffer of floats leads back to the point within the bound that its error gives") {
  Random r(2);
  double share = 0;
  for (const bool isReversed : {false, true}) {
    Convention convention = conventions::d3d;
    convention.reverseZ = isReversed;
    const Camera camera = makeCamera(lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::left),
                                     perspective(60, kViewport, .1, 1000), kViewport, convention);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 point = seenPoint(r, camera);
      const ScreenPoint at = worldToScreen(camera, point);
      const float depth = static_cast<float>(at.depth);
      const WorldPoint back =
          screenToWorld(camera, {at.x, at.y}, depth, double(std::nextafter(depth, 2.f) - depth) / 2);
      const double miss = std::hypot(back.position.x - point.x, back.position.y - point.y, back.position.z - point.z);
      REQUIRE(back.status == DepthStatus::point);
      REQUIRE(miss <= back.bound * (1 + 1e-9) + 1e-12);
      share = std::max(share, miss / back.bound);
    }
  }
  CHECK(share > .9);
}

TEST_CASE("A camera that moves keeps its lens and its pixel centre") {
  const Viewport picture = viewportOf(640, 480, conventions::opencv);
  CHECK(picture == Viewport{.width = 640, .height = 480, .pixelCenter = 0});
  const Pose here = lookAlong({0, 0, 0}, {0, 0, 1}, conventions::opencv.up, Handedness::right);
  const Camera camera =
      withLens(makeCamera(here, intrinsics(800, 800, 319.5, 239.5, picture, .1, 100), picture, conventions::opencv),
               brownLens({-.2, .05}));
  const Camera moved = withPose(camera, movedTo(here, {1, 2, 3}));
  CHECK(moved.pose().eye() == Vec3{1, 2, 3});
  CHECK(moved.viewport() == picture);
  REQUIRE(lensOf(moved));
  ScreenPoint before = worldToScreen(camera, Vec3{.5, .25, 2}), after = worldToScreen(moved, Vec3{1.5, 2.25, 5});
  CHECK(before == after);
  CHECK(worldToScreen(camera, Vec3{0, 0, 2}).x == 319.5);
  CHECK(worldToScreen(withLens(makeCamera(here, camera.projection(), picture, conventions::opencv), *lensOf(moved)),
                      Vec3{.5, .25, 2}) == before);
  CHECK(fieldAtFault([&] {
          withPose(camera, lookAlong({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, Handedness::left));
        }) == "pose");
}

TEST_CASE("Many rays at a time are the rays one by one, with origins, through a lens and beyond the range too") {
  Random r(2);
  const Pose pose = lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right);
  const Camera perspectiveCamera = makeCamera(pose, perspective(60, kViewport, .1, 1000), kViewport);
  const Camera flat = makeCamera(pose, orthographic(-4, 4, -2.25, 2.25, .1, 1000), kViewport);
  std::vector<Vec2> pixels{{NAN, 0}, {INFINITY, 3}, {1e47, 0}, {1e140, -1e139}, {1e45, 1e45}};
  for (int i = 0; i < 500; ++i) pixels.push_back({r.uniform(-100, 1400), r.uniform(-100, 800)});
  for (const Camera& camera : {perspectiveCamera, flat, withLens(perspectiveCamera, brownLens({-.1, .02}))})
    for (const RayOrigin origin : {RayOrigin::eye, RayOrigin::nearPlane}) {
      std::vector<Ray> rays(pixels.size());
      std::vector<Vec3> directions(pixels.size());
      screenToRays(camera, pixels, rays, origin);
      screenToRayDirections(camera, pixels, directions);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Ray one = screenToRay(camera, pixels[i], origin);
        INFO(i << ": " << pixels[i].x << " " << pixels[i].y);
        const bool hasNone = i < 4;
        REQUIRE(std::isnan(one.direction.x) == hasNone);
        REQUIRE((rays[i] == one || hasNone));
        REQUIRE(std::isnan(rays[i].direction.x) == hasNone);
        REQUIRE((directions[i] == one.direction || hasNone));
        REQUIRE(std::isnan(directions[i].x) == hasNone);
      }
    }
}

TEST_CASE("The depth of infinity's neighbour has a point whose bound is infinite, and not NaN") {
  Convention reversed;
  reversed.reverseZ = true;
  const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                                   perspective(60, 1, 1e-30), {100, 100}, reversed);
  const WorldPoint p = screenToWorld(camera, {50, 50}, 5e-324);
  CHECK(p.status == DepthStatus::point);
  CHECK(p.bound == INFINITY);
}
