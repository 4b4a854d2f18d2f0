// Imath's Frustum: row vectors, right-handed, -Z ahead, depth -1 to 1, and a screen that runs from -1 to 1.
//
// Tolerances are counts of Imath's roundings, each 2^-53 of the terms that it rounds.
#include <Imath/ImathFrustum.h>
#include <Imath/ImathLine.h>
#include <Imath/ImathMatrix.h>

#include "catch.hpp"
#include "measure.hpp"
#include "random_cameras.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace peers;

namespace {

constexpr std::uint64_t kTrials = 3000;

/// OpenGL's clip space written for row vectors.
Convention rowVectors() {
  Convention c = preset("opengl");
  c.vectors = Vectors::row;
  c.storage = Storage::rowMajor;
  return c;
}

/// Imath's screen: -1 to 1 in x and y, y upwards.
Viewport imathScreen() {
  Viewport v;
  v.width = v.height = 2;
  v.x = v.y = -1;
  v.origin = Origin::bottomLeft;
  return v;
}

/// Imath's camera space as a world: the eye at its origin, -Z ahead, Y up.
Pose cameraSpace() { return lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right); }

Imath::Frustum<double> toImath(const Window& w) {
  return {w.near, w.far, w.left, w.right, w.top, w.bottom, w.orthographic};
}

Imath::V3d toImath(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 fromImath(const Imath::V3d& v) { return {v.x, v.y, v.z}; }

Imath::M44d toImath(const Mat4& rowsOnPaper) {
  Imath::M44d m;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m[i][j] = rowsOnPaper[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return m;
}

Window anyWindow(Random& random, Tally& tally) {
  const auto shape = static_cast<Shape>(static_cast<int>(random.uniform(0, 3)));
  tally.count("symmetric", shape == Shape::symmetric);
  tally.count("off-centre", shape == Shape::offCentre);
  tally.count("orthographic", shape == Shape::orthographic);
  return randomWindow(random, shape);
}

double largestEdge(const Window& w) {
  return std::max({std::fabs(w.left), std::fabs(w.right), std::fabs(w.bottom), std::fabs(w.top)});
}

double angleBetween(const Vec3& a, const Vec3& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

/// Imath rounds the window position of a pixel about four times, each by the size of the window's edges.
double directionBound(const Window& w) {
  return kRayDirectionBound + 4 * kRounding + (w.orthographic ? 0 : 6 * kRounding * largestEdge(w) / w.near);
}

}  // namespace

TEST_CASE("Imath: projectionMatrix is clipFromView laid out for row vectors") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Window w = anyWindow(random, tally);
    const Mat4 ours = laidOut(clipFromView(projectionOf(w), rowVectors()), rowVectors());
    const Imath::M44d theirs = toImath(w).projectionMatrix();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const double entry = ours[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        worst.see(trial, entry - theirs[i][j], 8 * kRounding * std::fabs(entry));
      }
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("Imath: memory order of row vectors in row-major storage is Imath's") {
  const Window w{false, -3.5, 2, -1.3, 0.9, 1.7, 567};
  const auto ours = inStorageOrder(clipFromView(projectionOf(w), rowVectors()), rowVectors());
  const Imath::M44d theirs = toImath(w).projectionMatrix();
  for (std::size_t k = 0; k < 16; ++k) CHECK(ours[k] == Approx(theirs.getValue()[k]).epsilon(8 * kRounding));
}

TEST_CASE("Imath: projectScreenToRay is screenToRay in camera space, from the eye or from the plane through it") {
  Worst direction, origin;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Window w = anyWindow(random, tally);
    const Camera camera = makeCamera(cameraSpace(), projectionOf(w), imathScreen());
    const Vec2 screen{random.uniform(-1, 1), random.uniform(-1, 1)};
    const Imath::Line3<double> theirs = toImath(w).projectScreenToRay(Imath::V2d(screen.x, screen.y));
    for (Precision precision : {Precision::standard, Precision::exact}) {
      const Ray ours = screenToRay(camera, screen, precision);
      direction.see(trial, angleBetween(ours.direction, fromImath(theirs.dir)), directionBound(w));
      const double bound = w.orthographic ? 6 * kRounding * largestEdge(w) : 0;
      origin.see(trial, length(minus(ours.origin, fromImath(theirs.pos))), bound);
    }
  }
  CHECK_WITHIN_BOUND(direction);
  CHECK_WITHIN_BOUND(origin);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("Imath: its ray taken to the world by worldFromView on row vectors is our ray in the world") {
  Worst direction, origin;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const View v = randomView(random);
    const Window w = anyWindow(random, tally);
    const Pose pose = poseOf(v, Handedness::right);
    const Camera camera = makeCamera(pose, projectionOf(w), imathScreen(), rowVectors());
    const Vec2 screen{random.uniform(-1, 1), random.uniform(-1, 1)};

    const Imath::M44d worldFromCamera = toImath(laidOut(worldFromView(pose, rowVectors()), rowVectors()));
    const Imath::Line3<double> inCamera = toImath(w).projectScreenToRay(Imath::V2d(screen.x, screen.y));
    Imath::V3d theirs;
    worldFromCamera.multDirMatrix(inCamera.dir, theirs);

    for (Precision precision : {Precision::standard, Precision::exact}) {
      const Ray ours = screenToRay(camera, screen, precision);
      direction.see(trial, angleBetween(ours.direction, fromImath(theirs)), directionBound(w) + 8 * kRounding);
      const double size = sumOfSizes(v.eye) + (w.orthographic ? 6 * largestEdge(w) : 0);
      origin.see(trial, length(minus(ours.origin, fromImath(inCamera.pos * worldFromCamera))), 8 * kRounding * size);
    }
  }
  CHECK_WITHIN_BOUND(direction);
  CHECK_WITHIN_BOUND(origin);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("Imath: projectPointToScreen is worldToScreen on a screen from -1 to 1") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Window w = anyWindow(random, tally);
    const Camera camera = makeCamera(cameraSpace(), projectionOf(w), imathScreen());
    const Vec3 point = randomPoint(random, camera.pose, w);
    const Imath::V2d theirs = toImath(w).projectPointToScreen(toImath(point));
    const ScreenPoint ours = worldToScreen(camera, point);
    // (left - 2 x + right) / (left - right), where x comes with two roundings.
    const double terms = 4 * largestEdge(w) + 4 * (w.right - w.left) + 4 * (w.top - w.bottom);
    worst.see(trial, ours.x - theirs.x, 6 * kRounding * terms / (w.right - w.left));
    worst.see(trial, ours.y - theirs.y, 6 * kRounding * terms / (w.top - w.bottom));
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("Imath: the distance of a normalised depth is screenToWorld's") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Window w = anyWindow(random, tally);
    const Camera camera = makeCamera(cameraSpace(), projectionOf(w), imathScreen());
    const double depth = random.uniform(0, 1);
    const double theirs = toImath(w).normalizedZToDepth(depth);
    const WorldPoint ours = screenToWorld(camera, {0.25, -0.5}, depth);
    // In perspective 2 f n / (Zp (f - n) - f - n), whose denominator cancels near far.
    const double sum = std::fabs(w.far) + std::fabs(w.near);
    const double denominator = std::fabs((2 * depth - 1) * (w.far - w.near) - w.far - w.near);
    const double bound = w.orthographic ? sum : std::fabs(theirs) * (1 + sum / denominator);
    worst.see(trial, ours.position.z - theirs, 6 * kRounding * bound);
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("Imath: window is a tile of the picture") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Window w = anyWindow(random, tally);
    const double x = random.uniform(0, 1), y = random.uniform(0, 1);
    const Crop crop{x, y, random.uniform(0.5, 1), random.uniform(0.5, 1)};
    const Projection ours = cropped(projectionOf(w), imathScreen(), crop);
    const Imath::Frustum<double> theirs =
        toImath(w).window(crop.x - 1, crop.x + crop.width - 1, crop.y + crop.height - 1, crop.y - 1);
    const double toEdge = w.orthographic ? 1 : w.near;
    const double bound = 8 * kRounding * largestEdge(w);
    worst.see(trial, ours.left.hi * toEdge - theirs.left(), bound);
    worst.see(trial, ours.right.hi * toEdge - theirs.right(), bound);
    worst.see(trial, ours.bottom.hi * toEdge - theirs.bottom(), bound);
    worst.see(trial, ours.top.hi * toEdge - theirs.top(), bound);
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("Imath: its horizontal and vertical fields of view are fovX and fovY") {
  Worst worst;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const double degrees = random.uniform(5, 150), aspect = random.logUniform(0.3, 3);
    const double near = random.logUniform(1e-3, 10), far = near * random.logUniform(2, 1e6);
    const double radians = degrees * (3.14159265358979323846 / 180);
    const auto see = [&](const Projection& p, const Imath::Frustum<double>& theirs) {
      const Mat4 ours = laidOut(clipFromView(p, rowVectors()), rowVectors());
      const Imath::M44d m = theirs.projectionMatrix();
      // The tangent enlarges the rounding of degrees to radians up to 5 times at 150 degrees.
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
          const double entry = ours[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
          worst.see(trial, entry - m[i][j], 32 * kRounding * std::fabs(entry));
        }
    };
    see(perspectiveFovX(degrees, aspect, near, far), {near, far, radians, 0, aspect});
    see(perspectiveFovY(degrees, aspect, near, far), {near, far, 0, radians, aspect});
  }
  CHECK_WITHIN_BOUND(worst);
}
