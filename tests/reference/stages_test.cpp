// View space, clip space and NDC, each against its own truth in 480 bits, and a model's place in the world.
#include "camera/depth.hpp"
#include "catch.hpp"
#include "internals.hpp"
#include "parts.hpp"
#include "records/model.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"
#include "viewproj/matrices.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

constexpr ViewAxes kViews[] = {ViewAxes::RUB, ViewAxes::RUF, ViewAxes::RDF};

Convention randomWriting(Random& random) {
  Convention c;
  c.view = random.oneOf(kViews);
  c.ndcZ = random.chance(0.5) ? NdcZ::zeroToOne : NdcZ::minusOneToOne;
  c.ndcY = random.chance(0.5) ? NdcY::up : NdcY::down;
  c.reverseZ = random.chance(0.5);
  return c;
}

/// The share of the way from near to far that window depth makes of a distance.
Real depthShare(const Scene& s, const Truth::Screen& screen) {
  const Real first = s.convention.reverseZ ? s.viewport.depthSecond : s.viewport.depthFirst;
  const Real second = s.convention.reverseZ ? s.viewport.depthFirst : s.viewport.depthSecond;
  return (screen.depth - first) / (second - first);
}

}  // namespace

TEST_CASE("Each stage of a point is the double nearest its own true value") {
  int behind = 0, outside = 0, orthographic = 0, infinite = 0, residuals = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 60000000);
    const Scene scene = randomScene(random, random.logUniform(1e-3, 1e9));
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Convention writing = randomWriting(random);
    Vec3 point = pointInView(random, truth, random.chance(0.3) ? 5 : 1);
    if (random.chance(0.2))
      for (std::size_t i = 0; i < 3; ++i) point[i] = 2 * parts(camera).pose.eye[i] - point[i];
    INFO("trial " << trial << ": " << describe(scene));
    const Vec4 given{point.x, point.y, point.z, 1};
    const struct {
      Vec3 view;
      Vec4 clip;
      Vec3 ndc;
      ScreenPoint screen;
    } s{worldToView(camera, given, writing), worldTo(camera, Space::clip, given, writing),
        worldToNdc(camera, given, writing), worldToScreen(camera, given)};
    const double away = double(length(toReal(point) - truth.pose.eye));
    const Truth::View view = truth.view(toReal(point));
    const AxisSigns sign = axisSigns(writing.view);
    CHECK(isExact(s.view.x, view.right, away));
    CHECK(isExact(sign.up * s.view.y, view.up, away));
    CHECK(isExact(sign.forward * s.view.z, view.forward, away));

    // Clip space from the true screen position, backwards through the viewport.
    const Truth::Screen screen = truth.screen(view);
    const Viewport& v = camera.viewport();
    const Real half = Real(v.pixelCenter) - Real(0.5);
    const Real w = truth.lens.orthographic ? Real(1) : view.forward;
    const Real x = (screen.x - Real(v.x) - half) * Real(2) / Real(v.width) - Real(1);
    Real y = (screen.y - Real(v.y) - half) * Real(2) / Real(v.height) - Real(1);
    if ((v.origin == Origin::topLeft) == (writing.ndcY == NdcY::up)) y = -y;
    const DepthEnds ends = ndcDepths(writing);
    const Real z = Real(ends.atNear) + Real(ends.atFar - ends.atNear) * depthShare(scene, screen);
    const Mat4 p = clipFromView(camera.projection(), writing);
    const auto size = [&](std::size_t row) {
      return std::fabs(p[row][row] * s.view[row]) + std::fabs(p[row][2] * s.view.z) + std::fabs(p[row][3]);
    };
    CHECK(isExact(s.clip.x, x * w, size(0)));
    CHECK(isExact(s.clip.y, y * w, size(1)));
    CHECK(isExact(s.clip.z, z * w, size(2)));
    CHECK(isExact(s.clip.w, w, away));
    const double sizeX = size(0) + std::fabs(s.clip.w), sizeY = size(1) + std::fabs(s.clip.w);
    const double sizeZ = size(2) + std::fabs(s.clip.w);
    CHECK(std::isnan(s.ndc.x) == !(w > Real(0)));
    if (w > Real(0)) {
      CHECK(isExact(s.ndc.x, x, sizeX / s.clip.w));
      CHECK(isExact(s.ndc.y, y, sizeY / s.clip.w));
      CHECK(isExact(s.ndc.z, z, sizeZ / s.clip.w));
    }
    behind += s.screen.status == PointStatus::behind;
    outside += s.screen.status == PointStatus::inFront && s.screen.outside != 0;
    orthographic += truth.lens.orthographic;
    infinite += std::isinf(scene.far);
    residuals += parts(camera).pose.residual.x.hi != 0;
  }
  CAPTURE(behind, outside, orthographic, infinite, residuals);
  CHECK(std::min({behind, outside, orthographic, infinite, residuals}) > 1000);
}

TEST_CASE("A model matrix takes a point to the doubles nearest its true place") {
  int cancelling = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 62000000);
    Vec3 translation = random.vector(random.logUniform(1e-3, 1e9));
    const Vec3 scale = random.vector(random.logUniform(1e-3, 1e3));
    const Quaternion q{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Vec3 local = random.vector(random.logUniform(1e-3, 1e6));
    const double w = random.chance(0.3) ? random.uniform(-2, 2) : 1;
    if (random.chance(0.2)) {
      // The point comes to lie next to the world's origin.
      const Vec4 away = cmd::toWorld(cmd::worldFromLocal({0, 0, 0}, q, scale), {local.x, local.y, local.z, 1});
      translation = {-away.x, -away.y, -away.z};
    }
    const Mat4 m = cmd::worldFromLocal(translation, q, scale);
    const Vec4 world = cmd::toWorld(m, {local.x, local.y, local.z, w});
    const Vec3 placed{world.x, world.y, world.z};
    // q v q* for the axes, as glTF has them.
    const Real norm = Real(q.x) * Real(q.x) + Real(q.y) * Real(q.y) + Real(q.z) * Real(q.z) + Real(q.w) * Real(q.w);
    const Real3 u{q.x, q.y, q.z};
    for (std::size_t j = 0; j < 3; ++j) {
      Real3 axis{0.0, 0.0, 0.0};
      axis[j] = 1.0;
      const Real3 turned = u * (Real(2) * dot(u, axis)) + axis * (Real(q.w) * Real(q.w) - dot(u, u)) +
                           cross(u, axis) * (Real(2) * Real(q.w));
      for (std::size_t i = 0; i < 3; ++i) {
        INFO("trial " << trial << " entry " << i << " " << j);
        CHECK(isExact(m[i][j], turned[i] * Real(scale[j]) / norm, std::fabs(scale[j])));
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Real truth = Real(m[i][0]) * Real(local.x) + Real(m[i][1]) * Real(local.y) + Real(m[i][2]) * Real(local.z) +
                         Real(m[i][3]) * Real(w);
      CHECK(ulps(placed[i], truth) <= 0.5001);
      cancelling += std::fabs(placed[i]) < 0.01 * std::fabs(translation[i] * w);
    }
  }
  CHECK(cancelling > 100);
}
