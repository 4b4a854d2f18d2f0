// GLM 0.9.9 and Imath's Frustum in double, on tame cameras: signs, hands, layouts and depth ranges, by code that no
// part of the library runs. How near the truth our numbers are, tests/reference tells.
#include <Imath/ImathFrustum.h>
#include <Imath/ImathLine.h>
#include <Imath/ImathMatrix.h>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_projection.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "catch.hpp"
#include "measure.hpp"
#include "parts.hpp"
#include "random_cameras.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace peers;

namespace {

constexpr std::uint64_t kTrials = 2000;
constexpr double kAgreed = 1e-10;        ///< of the largest number beside it
constexpr double kAgreedInverse = 1e-6;  ///< what inverting their product leaves

double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }
glm::dvec3 toGlm(const Vec3& v) { return {v.x, v.y, v.z}; }

Mat4 fromGlm(const glm::dmat4& m) {
  Mat4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = m[static_cast<int>(j)][static_cast<int>(i)];
  return result;
}

Mat4 fromImath(const Imath::M44d& m) {
  Mat4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = m[static_cast<int>(i)][static_cast<int>(j)];
  return result;
}

/// To within a share of the largest entry of the row.
void see(Worst& worst, std::uint64_t trial, const Mat4& ours, const Mat4& theirs) {
  for (std::size_t i = 0; i < 4; ++i) {
    double largest = 0;
    for (std::size_t j = 0; j < 4; ++j) largest = std::max(largest, std::fabs(theirs[i][j]));
    for (std::size_t j = 0; j < 4; ++j) worst.see(trial, ours[i][j] - theirs[i][j], kAgreed * largest);
  }
}

void see(Worst& worst, std::uint64_t trial, const Vec3& ours, const Vec3& theirs, double bound) {
  worst.see(trial, length(minus(ours, theirs)), bound);
}

Window tameWindow(Random& random, Tally& tally) {
  const auto shape = static_cast<Shape>(static_cast<int>(random.uniform(0, 3)));
  Window w = randomWindow(random, shape);
  if (!w.orthographic) w.far = std::min(w.far, w.near * 100);
  tally.count("symmetric", shape == Shape::symmetric);
  tally.count("off-centre", shape == Shape::offCentre);
  tally.count("orthographic", shape == Shape::orthographic);
  tally.count("near behind the eye", w.near < 0);
  return w;
}

/// GLM's four clip spaces, in the order of the rows below.
constexpr struct {
  Handedness world;
  NdcZ ndcZ;
} kSpaces[] = {{Handedness::right, NdcZ::minusOneToOne},
               {Handedness::right, NdcZ::zeroToOne},
               {Handedness::left, NdcZ::minusOneToOne},
               {Handedness::left, NdcZ::zeroToOne}};
constexpr decltype(&glm::perspectiveRH_NO<double>) kPerspective[] = {
    glm::perspectiveRH_NO<double>, glm::perspectiveRH_ZO<double>, glm::perspectiveLH_NO<double>,
    glm::perspectiveLH_ZO<double>};
constexpr decltype(&glm::frustumRH_NO<double>) kFrustum[] = {glm::frustumRH_NO<double>, glm::frustumRH_ZO<double>,
                                                             glm::frustumLH_NO<double>, glm::frustumLH_ZO<double>};
constexpr decltype(&glm::orthoRH_NO<double>) kOrtho[] = {glm::orthoRH_NO<double>, glm::orthoRH_ZO<double>,
                                                         glm::orthoLH_NO<double>, glm::orthoLH_ZO<double>};

Convention conventionOf(std::size_t space, bool reverseZ) {
  Convention c;
  c.world = kSpaces[space].world;
  c.view = c.world == Handedness::left ? ViewAxes::RUF : ViewAxes::RUB;
  c.ndcZ = kSpaces[space].ndcZ;
  c.reverseZ = reverseZ;
  return c;
}

glm::dmat4 glmView(const View& v, Handedness world) {
  return world == Handedness::right ? glm::lookAtRH(toGlm(v.eye), toGlm(v.target), toGlm(v.up))
                                    : glm::lookAtLH(toGlm(v.eye), toGlm(v.target), toGlm(v.up));
}

/// GLM has no reversed depth, but near and far can be handed over in the other order; frustum then takes its edges to
/// be on the far plane. Its frustumLH shifts an off-centre window the wrong way: it kept the sign of RH, where z runs
/// backwards.
glm::dmat4 glmWindow(std::size_t space, const Window& w, bool reverseZ) {
  const double first = reverseZ ? w.far : w.near, second = reverseZ ? w.near : w.far;
  if (w.orthographic) return kOrtho[space](w.left, w.right, w.bottom, w.top, first, second);
  const double k = first / w.near;
  glm::dmat4 m = kFrustum[space](k * w.left, k * w.right, k * w.bottom, k * w.top, first, second);
  if (kSpaces[space].world == Handedness::left) m[2][0] = -m[2][0], m[2][1] = -m[2][1];
  return m;
}

/// Imath's Frustum: row vectors, right-handed, -Z ahead, and a screen from -1 to 1 with y upwards.
Imath::Frustum<double> toImath(const Window& w) {
  return {w.near, w.far, w.left, w.right, w.top, w.bottom, w.orthographic};
}
Convention rowVectors() {
  Convention c = preset("opengl");
  c.vectors = Vectors::row;
  c.storage = Storage::rowMajor;
  return c;
}
const Viewport kImathScreen{.width = 2, .height = 2, .x = -1, .y = -1, .origin = Origin::bottomLeft};

double largestEdge(const Window& w) {
  return std::max({std::fabs(w.left), std::fabs(w.right), std::fabs(w.bottom), std::fabs(w.top)});
}

}  // namespace

TEST_CASE(
    "GLM: lookAt, perspective, infinitePerspective, frustum and ortho, in both hands, depth ranges and reversed") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const View v = randomView(random, 10);
    const Window w = tameWindow(random, tally);
    const double fovY = random.uniform(5, 150), aspect = random.logUniform(0.3, 3), near = random.logUniform(1e-3, 10);
    for (std::size_t space = 0; space < 4; ++space)
      for (bool reverseZ : {false, true}) {
        const Convention c = conventionOf(space, reverseZ);
        const glm::dmat4 view = glmView(v, c.world), projection = glmWindow(space, w, reverseZ);
        see(worst, trial, viewFromWorld(poseOf(v, c.world), c), fromGlm(view));
        see(worst, trial, clipFromView(projectionOf(w), c), fromGlm(projection));
        see(worst, trial, clipFromWorld(poseOf(v, c.world), projectionOf(w), c), fromGlm(projection * view));
        const double first = reverseZ ? 100 * near : near, second = reverseZ ? near : 100 * near;
        see(worst, trial, clipFromView(perspective(fovY, aspect, near, 100 * near), c),
            fromGlm(kPerspective[space](radians(fovY), aspect, first, second)));
      }
    const Projection infinite = perspective(fovY, aspect, near, kInfiniteFar);
    see(worst, trial, clipFromView(infinite, conventionOf(0, false)),
        fromGlm(glm::infinitePerspectiveRH(radians(fovY), aspect, near)));
    see(worst, trial, clipFromView(infinite, conventionOf(2, false)),
        fromGlm(glm::infinitePerspectiveLH(radians(fovY), aspect, near)));
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("GLM: frustumLH of an off-centre window misses its own left edge, which clipFromView meets") {
  const Window w{false, 1, 3, -1, 1, 2, 10};
  const glm::dvec4 theirs = glm::frustumLH_NO(w.left, w.right, w.bottom, w.top, w.near, w.far) * glm::dvec4(1, 0, 2, 1);
  CHECK(theirs.x / theirs.w == 3);
  const Vec4 ours = times(clipFromView(projectionOf(w), conventionOf(2, false)), {1, 0, 2, 1});
  CHECK(ours.x / ours.w == -1);
}

TEST_CASE("GLM: project and unProject, from the bottom left, with window depths of 0 to 1 in both depth ranges") {
  Worst screen, world;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const View v = randomView(random, 10);
    const Window w = tameWindow(random, tally);
    const Viewport viewport = randomViewport(random, Origin::bottomLeft);
    const glm::dvec4 box{viewport.x, viewport.y, viewport.width, viewport.height};
    for (std::size_t space = 0; space < 4; ++space)
      for (bool reverseZ : {false, true}) {
        const Convention c = conventionOf(space, reverseZ);
        const Camera camera = makeCamera(poseOf(v, c.world), projectionOf(w), viewport, c);
        const glm::dmat4 view = glmView(v, c.world), projection = glmWindow(space, w, reverseZ);
        const bool zeroToOne = c.ndcZ == NdcZ::zeroToOne;
        const glm::dvec3 point = toGlm(randomPoint(random, camera.pose(), w));
        const glm::dvec3 there =
            zeroToOne ? glm::projectZO(point, view, projection, box) : glm::projectNO(point, view, projection, box);
        const ScreenPoint ours = worldToScreen(camera, {point.x, point.y, point.z});
        REQUIRE(ours.status == PointStatus::inFront);
        tally.count("in the picture", ours.visible());
        tally.count("beside the picture", !ours.visible());
        // Near the eye a world coordinate has fewer digits of the view's.
        const double lost = 1 + (sumOfSizes(v.eye) + 1) / std::fabs(w.near);
        screen.see(trial, ours.x - there.x, kAgreed * lost * (std::fabs(ours.x) + viewport.width));
        screen.see(trial, ours.y - there.y, kAgreed * lost * (std::fabs(ours.y) + viewport.height));
        screen.see(trial, ours.depth - there.z, kAgreed * lost);

        const glm::dvec3 window{viewport.x + random.uniform(0, 1) * viewport.width,
                                viewport.y + random.uniform(0, 1) * viewport.height, random.uniform(0.05, 0.95)};
        const glm::dvec3 back = zeroToOne ? glm::unProjectZO(window, view, projection, box)
                                          : glm::unProjectNO(window, view, projection, box);
        const WorldPoint there3 = screenToWorld(camera, {window.x, window.y}, window.z);
        REQUIRE(there3.status == DepthStatus::point);
        see(world, trial, there3.position, {back.x, back.y, back.z},
            kAgreedInverse * lost * (1 + length(there3.position) + sumOfSizes(v.eye)));
      }
  }
  CHECK_WITHIN_BOUND(screen);
  CHECK_WITHIN_BOUND(world);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("Imath: projectionMatrix for row vectors, window, fields of view, and its storage order") {
  Worst worst;
  Tally tally;
  const Convention c = rowVectors();
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Window w = tameWindow(random, tally);
    const auto seeFrustum = [&](const Projection& ours, const Imath::Frustum<double>& theirs) {
      see(worst, trial, laidOut(clipFromView(ours, c), c), fromImath(theirs.projectionMatrix()));
    };
    seeFrustum(projectionOf(w), toImath(w));
    const Crop crop{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0.5, 1), random.uniform(0.5, 1)};
    seeFrustum(cropped(projectionOf(w), kImathScreen, crop),
               toImath(w).window(crop.x - 1, crop.x + crop.width - 1, crop.y + crop.height - 1, crop.y - 1));
    const double degrees = random.uniform(5, 150), aspect = random.logUniform(0.3, 3),
                 near = random.logUniform(0.01, 9);
    seeFrustum(perspective(degrees, aspect, near, 9 * near, Fov::horizontal),
               {near, 9 * near, radians(degrees), 0, aspect});
    seeFrustum(perspective(degrees, aspect, near, 9 * near), {near, 9 * near, 0, radians(degrees), aspect});
    const auto stored = inStorageOrder(clipFromView(projectionOf(w), c), c);
    const Imath::M44d theirs = toImath(w).projectionMatrix();
    for (std::size_t k = 0; k < 16; ++k) CHECK(stored[k] == Approx(theirs.getValue()[k]).margin(kAgreed));
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("Imath: projectScreenToRay, projectPointToScreen and normalizedZToDepth, and its ray in the world") {
  Worst rays, points, depths;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const View v = randomView(random, 10);
    const Window w = tameWindow(random, tally);
    const Pose pose = poseOf(v, Handedness::right);
    const Camera camera = makeCamera(pose, projectionOf(w), kImathScreen, rowVectors());
    const Camera atOrigin =
        makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right), projectionOf(w), kImathScreen);
    const Vec2 screen{random.uniform(-1, 1), random.uniform(-1, 1)};
    const Imath::Line3<double> line = toImath(w).projectScreenToRay(Imath::V2d(screen.x, screen.y));
    const Imath::M44d turned = [&] {
      const Mat4 m = laidOut(worldFromView(pose, rowVectors()), rowVectors());
      Imath::M44d result;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) result[i][j] = m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      return result;
    }();
    Imath::V3d direction;
    turned.multDirMatrix(line.dir, direction);
    const Imath::V3d origin = line.pos * turned;
    const double size = 1 + sumOfSizes(v.eye) + largestEdge(w);
    for (Precision precision : {Precision::standard, Precision::exact}) {
      const Ray ours = screenToRay(camera, screen, precision), there = screenToRay(atOrigin, screen, precision);
      see(rays, trial, there.direction, {line.dir.x, line.dir.y, line.dir.z}, kAgreed);
      see(rays, trial, there.origin, {line.pos.x, line.pos.y, line.pos.z}, kAgreed * size);
      see(rays, trial, ours.direction, {direction.x, direction.y, direction.z}, kAgreed);
      see(rays, trial, ours.origin, {origin.x, origin.y, origin.z}, kAgreed * size);
    }
    const Vec3 point = randomPoint(random, atOrigin.pose(), w);
    const Imath::V2d theirs = toImath(w).projectPointToScreen(Imath::V3d(point.x, point.y, point.z));
    const ScreenPoint ours = worldToScreen(atOrigin, point);
    const double parts = 1 + largestEdge(w) / std::min(w.right - w.left, w.top - w.bottom);
    points.see(trial, ours.x - theirs.x, kAgreed * parts);
    points.see(trial, ours.y - theirs.y, kAgreed * parts);
    const double depth = random.uniform(0, 1);
    depths.see(trial, screenToWorld(atOrigin, {0.25, -0.5}, depth).position.z - toImath(w).normalizedZToDepth(depth),
               kAgreed * (std::fabs(w.near) + std::fabs(w.far)));
  }
  CHECK_WITHIN_BOUND(rays);
  CHECK_WITHIN_BOUND(points);
  CHECK_WITHIN_BOUND(depths);
  CHECK_ALL_VISITED(tally);
}
