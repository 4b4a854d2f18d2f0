// The presets of Unity and Unreal against the matrices that the engines document, by their formulas in double.
//
// Unity, Scripting API: Camera.worldToCameraMatrix ("camera space matches OpenGL convention: camera's forward is the
// negative Z axis", and the example that builds it: a scale by (1, 1, -1) after the transform's worldToLocalMatrix);
// Camera.projectionMatrix (the example PerspectiveOffCenter); Matrix4x4.Perspective (fov is vertical, in degrees);
// GL.GetGPUProjectionMatrix with Manual, "Platform-specific rendering differences" (Direct3D, Metal, Vulkan: clip z is
// 1 at near and 0 at far; y turned over for a render texture); Camera.WorldToScreenPoint.
//
// Unreal Engine, Runtime/Core/Public/Math: PerspectiveMatrix.h (FReversedZPerspectiveMatrix), InverseRotationMatrix.h,
// TranslationMatrix.h, LookAtMatrix.h (FLookFromMatrix), OrthoMatrix.h (FReversedZOrthoMatrix); UnrealMath.cpp
// (FRotator::Quaternion); Engine/Private/LocalPlayer.cpp (the view: rotation undone, then x, y, z := y, z, x).
#include <array>

#include "catch.hpp"
#include "internals.hpp"
#include "measure.hpp"
#include "parts.hpp"
#include "random_cameras.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace peers;

namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;

/// Row by row, row vectors: v * M, as FMatrix has it.
using Rows = std::array<std::array<double, 4>, 4>;

Rows operator*(const Rows& a, const Rows& b) {
  Rows c{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// Largest difference of entries, each against the size given.
double apart(const Rows& a, const Rows& b, const Rows& sizes) {
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      most = std::max(most, std::fabs(a[i][j] - b[i][j]) / (sizes[i][j] == 0 ? 1 : std::fabs(sizes[i][j])));
  return most;
}

double apart(const Rows& a, const Rows& b) { return apart(a, b, b); }

/// Entries of rotations, and translations of that size.
double apartInView(const Rows& a, const Rows& b, double translation, bool rowVectors) {
  Rows sizes;
  for (auto& row : sizes) row.fill(1);
  for (std::size_t i = 0; i < 3; ++i) (rowVectors ? sizes[3][i] : sizes[i][3]) = 1 + translation;
  return apart(a, b, sizes);
}

constexpr double kFewRoundings = 16 * kRounding;

Vec3 unit(const Vec3& a) { return {a.x / length(a), a.y / length(a), a.z / length(a)}; }

double degrees(Random& random) { return random.uniform(5, 160); }

// Unity

struct Quat {
  double x, y, z, w;
};

Quat randomQuaternion(Random& random) {
  const Quat q{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  const double n = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x / n, q.y / n, q.z / n, q.w / n};
}

/// Columns: where the transform's x, y, z axes point. Right, up and forward in Unity.
std::array<Vec3, 3> axesOf(const Quat& q) {
  return {{{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.z * q.w), 2 * (q.x * q.z - q.y * q.w)},
           {2 * (q.x * q.y - q.z * q.w), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.x * q.w)},
           {2 * (q.x * q.z + q.y * q.w), 2 * (q.y * q.z - q.x * q.w), 1 - 2 * (q.x * q.x + q.y * q.y)}}};
}

/// Scale(1, 1, -1) * worldToLocalMatrix, column vectors.
Rows worldToCameraMatrix(const Vec3& position, const Quat& rotation) {
  const auto axes = axesOf(rotation);
  Rows m{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double mirror = i == 2 ? -1 : 1;
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = mirror * axes[i][j];
    m[i][3] = -mirror * (axes[i].x * position.x + axes[i].y * position.y + axes[i].z * position.z);
  }
  m[3][3] = 1;
  return m;
}

/// The example of Camera.projectionMatrix.
Rows perspectiveOffCenter(double left, double right, double bottom, double top, double near, double far) {
  return {{{2 * near / (right - left), 0, (right + left) / (right - left), 0},
           {0, 2 * near / (top - bottom), (top + bottom) / (top - bottom), 0},
           {0, 0, -(far + near) / (far - near), -(2 * far * near) / (far - near)},
           {0, 0, -1, 0}}};
}

Convention unity() { return preset("unity"); }

/// What GetGPUProjectionMatrix makes for Direct3D, Metal and Vulkan.
Convention unityOnGpu(bool renderIntoTexture) {
  Convention c = unity();
  c.ndcZ = NdcZ::zeroToOne;
  c.reverseZ = true;
  c.ndcY = renderIntoTexture ? NdcY::down : NdcY::up;
  return c;
}

// Unreal

Convention unreal() { return preset("unreal"); }

struct Rotator {
  double pitch, yaw, roll;  // degrees
};

Rows translationMatrix(const Vec3& delta) {
  return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {delta.x, delta.y, delta.z, 1}}};
}

Rows inverseRotationMatrix(const Rotator& r) {
  const double cy = std::cos(r.yaw * kRadiansPerDegree), sy = std::sin(r.yaw * kRadiansPerDegree);
  const double cp = std::cos(r.pitch * kRadiansPerDegree), sp = std::sin(r.pitch * kRadiansPerDegree);
  const double cr = std::cos(r.roll * kRadiansPerDegree), sr = std::sin(r.roll * kRadiansPerDegree);
  const Rows yaw = {{{cy, -sy, 0, 0}, {sy, cy, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  const Rows pitch = {{{cp, 0, -sp, 0}, {0, 1, 0, 0}, {sp, 0, cp, 0}, {0, 0, 0, 1}}};
  const Rows roll = {{{1, 0, 0, 0}, {0, cr, sr, 0}, {0, -sr, cr, 0}, {0, 0, 0, 1}}};
  return yaw * pitch * roll;
}

/// x, y, z (forward, right, up) become z, x, y (right, up, forward of the view).
constexpr Rows kViewAxes = {{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};

Rows viewMatrix(const Vec3& location, const Rotator& r) {
  return translationMatrix({-location.x, -location.y, -location.z}) * inverseRotationMatrix(r) * kViewAxes;
}

Quaternion quaternionOf(const Rotator& r) {
  const double half = kRadiansPerDegree / 2;
  const double sp = std::sin(r.pitch * half), sy = std::sin(r.yaw * half), sr = std::sin(r.roll * half);
  const double cp = std::cos(r.pitch * half), cy = std::cos(r.yaw * half), cr = std::cos(r.roll * half);
  return {cr * sp * sy - sr * cp * cy, -cr * sp * cy - sr * cp * sy, cr * cp * sy - sr * sp * cy,
          cr * cp * cy + sr * sp * sy};
}

Rows reversedZPerspectiveMatrix(double halfFov, double width, double height, double minZ, double maxZ) {
  const double t = std::tan(halfFov);
  return {{{1 / t, 0, 0, 0},
           {0, width / t / height, 0, 0},
           {0, 0, minZ == maxZ ? 0 : minZ / (minZ - maxZ), 1},
           {0, 0, minZ == maxZ ? minZ : -maxZ * minZ / (minZ - maxZ), 0}}};
}

Rotator randomRotator(Random& random) {
  return {random.uniform(-85, 85), random.uniform(-180, 180), random.uniform(-180, 180)};
}

}  // namespace

TEST_CASE("Unity: the main camera of a new scene, at (0, 1, -10) and not turned") {
  const Pose pose = poseFromRotation({0, 1, -10}, {0, 0, 0, 1}, CameraAxes::RUF, Handedness::left);
  CHECK(viewFromWorld(pose, unity()).m == Rows{{{1, 0, 0, 0}, {0, 1, 0, -1}, {0, 0, -1, -10}, {0, 0, 0, 1}}});
  CHECK(worldToCameraMatrix({0, 1, -10}, {0, 0, 0, 1}) == viewFromWorld(pose, unity()).m);
}

TEST_CASE("Unity: Camera.worldToCameraMatrix is a scale by (1, 1, -1) after the transform's worldToLocalMatrix") {
  double most = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const Vec3 position = random.direction(random.logUniform(0.1, 1e4));
    const Quat q = randomQuaternion(random);
    const Pose pose = poseFromRotation(position, {q.x, q.y, q.z, q.w}, CameraAxes::RUF, Handedness::left);
    const Rows expected = worldToCameraMatrix(position, q);
    most = std::max(most, apartInView(viewFromWorld(pose, unity()).m, expected, length(position), false));
    // Transform.LookAt: forward at the target, up towards worldUp.
    const auto axes = axesOf(q);
    const Pose looking = lookAlong(position, axes[2], axes[1], Handedness::left);
    most = std::max(most, apartInView(viewFromWorld(looking, unity()).m, expected, length(position), false));
  }
  CHECK(most <= kFewRoundings);
}

TEST_CASE("Unity: Camera.projectionMatrix as Matrix4x4.Perspective and PerspectiveOffCenter give it") {
  double most = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const double fov = degrees(random), aspect = random.logUniform(0.3, 3);
    const double near = random.logUniform(0.01, 10), far = near * random.logUniform(2, 1e6);
    const double top = near * std::tan(fov / 2 * kRadiansPerDegree);
    most = std::max(most, apart(clipFromView(perspective(fov, aspect, near, far), unity()).m,
                                perspectiveOffCenter(-top * aspect, top * aspect, -top, top, near, far)));
    const double left = -random.logUniform(0.1, 10), right = random.logUniform(0.1, 10);
    const double bottom = -random.logUniform(0.1, 10), upper = random.logUniform(0.1, 10);
    const Rows sizes = {{{1, 0, 1, 0}, {0, 1, 1, 0}, {0, 0, 1, near}, {0, 0, 1, 0}}};
    const Rows ours = clipFromView(frustum(left, right, bottom, upper, near, far), unity()).m;
    const Rows theirs = perspectiveOffCenter(left, right, bottom, upper, near, far);
    most = std::max(
        {most, apart(ours, theirs, sizes) / std::max({1.0, theirs[0][0], theirs[1][1], -theirs[2][3] / near})});
  }
  CHECK(most <= kFewRoundings);
}

TEST_CASE("Unity: GL.GetGPUProjectionMatrix is reversed, 0 to 1, and upside down into a texture") {
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    const double near = random.logUniform(0.01, 10), far = near * random.logUniform(2, 100);
    const Projection p = perspective(degrees(random), 1.6, near, far);
    const Rows gl = clipFromView(p, unity()).m;
    for (bool renderIntoTexture : {false, true}) {
      Rows expected = gl;
      for (std::size_t j = 0; j < 4; ++j) {
        expected[2][j] = (gl[3][j] - gl[2][j]) / 2;
        if (renderIntoTexture) expected[1][j] = 0 - gl[1][j];
      }
      // Halving what is almost 1 loses what near / far is.
      const Rows sizes = {{{gl[0][0], 0, 0, 0}, {0, gl[1][1], 0, 0}, {0, 0, 1, near}, {0, 0, 1, 0}}};
      CHECK(apart(clipFromView(p, unityOnGpu(renderIntoTexture)).m, expected, sizes) <= kFewRoundings);
    }
    const Mat4 gpu = clipFromView(p, unityOnGpu(false));
    const auto depthAt = [&](double distance) { return (gpu[2][2] * -distance + gpu[2][3]) / distance; };
    CHECK(std::fabs(depthAt(near) - 1) <= kFewRoundings);
    CHECK(std::fabs(depthAt(far)) <= kFewRoundings);
  }
}

TEST_CASE("Unity: WorldToScreenPoint counts pixels from the bottom left, and z along the view in world units") {
  const Camera camera =
      makeCamera(poseFromRotation({0, 1, -10}, {0, 0, 0, 1}, CameraAxes::RUF, Handedness::left),
                 perspective(90, 2, 0.3, 1000), {.width = 800, .height = 400, .origin = Origin::bottomLeft}, unity());
  const ScreenPoint corner = worldToScreen(camera, Vec3{10, 6, -5});
  CHECK((corner.x == 800 && corner.y == 400 && corner.viewDistance == 5));
  const ScreenPoint left = worldToScreen(camera, Vec3{-10, -4, -5});
  CHECK((left.x == 0 && left.y == 0));
}

TEST_CASE("Unreal: FReversedZPerspectiveMatrix, whose angle is half of the horizontal one") {
  double most = 0;
  int infinite = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const double fov = degrees(random), width = random.logUniform(100, 8000), height = random.logUniform(100, 8000);
    const double near = random.logUniform(0.1, 100);
    const bool isInfinite = random.coin();
    infinite += isInfinite;
    const double far = isInfinite ? near : near * random.logUniform(2, 1e6);
    const Projection p =
        perspective(fov, Aspect(width, height), near, isInfinite ? kInfiniteFar : far, Fov::horizontal);
    most = std::max(most, apart(laidOut(clipFromView(p, unreal()), unreal()).m,
                                reversedZPerspectiveMatrix(fov / 2 * kRadiansPerDegree, width, height, near, far)));
  }
  CHECK(infinite > 500);
  CHECK(infinite < 1500);
  CHECK(most <= kFewRoundings);
}

TEST_CASE("Unreal: the default view of 90 degrees in 1920 x 1080 with GNearClippingPlane 10 and no far plane") {
  const Mat4 m =
      laidOut(clipFromView(perspective(90, Aspect(1920, 1080), 10, kInfiniteFar, Fov::horizontal), unreal()), unreal());
  CHECK(m.m == Rows{{{1, 0, 0, 0}, {0, 1920.0 / 1080, 0, 0}, {0, 0, 0, 1}, {0, 0, 10, 0}}});
}

TEST_CASE("Unreal: FReversedZOrthoMatrix of half a width and half a height") {
  // FReversedZOrthoMatrix(Width, Height, ZScale, ZOffset): ZScale = 1 / (far - near), ZOffset = -near.
  const double width = 512, height = 256, near = 16, far = 80, zScale = 1 / (far - near), zOffset = -near;
  const Rows expected = {
      {{1 / width, 0, 0, 0}, {0, 1 / height, 0, 0}, {0, 0, -zScale, 0}, {0, 0, 1 - zOffset * zScale, 1}}};
  CHECK(laidOut(clipFromView(orthographic(-width, width, -height, height, near, far), unreal()), unreal()).m ==
        expected);
}

TEST_CASE("Unreal: the view undoes location and FRotator, then turns forward, right, up into z, x, y") {
  double most = 0, viaQuaternion = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const Vec3 location = random.direction(random.logUniform(1, 1e5));
    const Rotator r = randomRotator(random);
    const Rows expected = viewMatrix(location, r);
    // An actor's axes are the columns of the inverse rotation: forward, right, up.
    const Rows inverse = inverseRotationMatrix(r);
    const Pose looking = lookAlong(location, {inverse[0][0], inverse[1][0], inverse[2][0]},
                                   {inverse[0][2], inverse[1][2], inverse[2][2]}, Handedness::left);
    const auto view = [](const Pose& pose) { return laidOut(viewFromWorld(pose, unreal()), unreal()).m; };
    most = std::max(most, apartInView(view(looking), expected, length(location), true));
    const Pose turned = poseFromRotation(location, quaternionOf(r), CameraAxes::FRU, Handedness::left);
    viaQuaternion = std::max(viaQuaternion, apartInView(view(turned), expected, length(location), true));
  }
  CHECK(most <= kFewRoundings);
  CHECK(viaQuaternion <= kFewRoundings);
}

TEST_CASE("Unreal: FLookFromMatrix has z along the view, x along up ^ z, y along z ^ x") {
  double most = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const View v = randomView(random, 1e5);
    const Vec3 z = unit(minus(v.target, v.eye)), x = unit(cross(v.up, z)), y = cross(z, x);
    const Rows expected = {{{x.x, y.x, z.x, 0},
                            {x.y, y.y, z.y, 0},
                            {x.z, y.z, z.z, 0},
                            {-dot(v.eye, x), -dot(v.eye, y), -dot(v.eye, z), 1}}};
    const Rows ours = laidOut(viewFromWorld(lookAt(v.eye, v.target, v.up, Handedness::left), unreal()), unreal()).m;
    // target - eye was rounded, and the right axis is as uncertain as up is near the view.
    const double reach = 1 + length(v.eye) / length(minus(v.target, v.eye));
    most = std::max(most, apartInView(ours, expected, length(v.eye), true) * v.upSine / reach);
  }
  CHECK(most <= kFewRoundings);
}

TEST_CASE("Unreal: a level in centimetres, z up, y to the right of x, depth reversed") {
  const Camera camera = makeCamera(lookAlong({100, 200, 170}, {1, 0, 0}, {0, 0, 1}, Handedness::left),
                                   perspective(90, Aspect(1920, 1080), 10, kInfiniteFar, Fov::horizontal),
                                   {.width = 1920, .height = 1080}, unreal());
  const ScreenPoint right = worldToScreen(camera, Vec3{1100, 1200, 170});
  CHECK((right.x == 1920 && right.y == 540 && right.depth == 0.01 && right.viewDistance == 1000));
  const ScreenPoint top = worldToScreen(camera, Vec3{1100, 200, 170 + 562.5});
  CHECK((top.x == 960 && top.y == 0));
}
