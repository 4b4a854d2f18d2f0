// Numbers that others have published: specifications, and the tests of other libraries. Each case names its source.
//
// Published to n digits, they are compared to half a unit of the last; formulas evaluated here in double, to the few
// roundings of the formula.
#include "catch.hpp"
#include "internals.hpp"
#include "measure.hpp"
#include "parts.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace peers;

namespace {

/// Each entry within that share of the expected one; exactly where 0 is expected.
void checkEntries(const Mat4& ours, const Mat4& expected, double relative) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      INFO("row " << i << ", column " << j << ": " << ours[i][j] << " for " << expected[i][j]);
      CHECK(std::fabs(ours[i][j] - expected[i][j]) <= relative * std::fabs(expected[i][j]));
    }
}

void checkVector(const Vec3& ours, const Vec3& expected, double bound) {
  INFO(ours.x << ' ' << ours.y << ' ' << ours.z << " for " << expected.x << ' ' << expected.y << ' ' << expected.z);
  CHECK(std::fabs(ours.x - expected.x) <= bound);
  CHECK(std::fabs(ours.y - expected.y) <= bound);
  CHECK(std::fabs(ours.z - expected.z) <= bound);
}

constexpr double kFewRoundings = 8 * kRounding;

Convention gl() { return preset("opengl"); }

}  // namespace

// OpenUSD, pxr/base/gf/testenv/testGfFrustum.py and testGfCamera.py. A default GfFrustum is a window of -1 to 1 at
// distance 1, near 1 and far 10; its pick rays start on the near plane.

TEST_CASE("OpenUSD: GfFrustum.ComputePickRay((2, 2)) starts at (2/3, 2/3, -1/3) in that direction") {
  const Viewport ndc{2, 2, -1, -1, 0, 1, Origin::bottomLeft};
  const Camera camera =
      makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right), frustum(-1, 1, -1, 1, 1, 10), ndc);
  const Ray ray = screenToRay(camera, {2, 2});
  checkVector(ray.direction, {2.0 / 3, 2.0 / 3, -1.0 / 3}, kRounding);
  CHECK(ray.origin == Vec3{0, 0, 0});
  // GfFrustum starts a unit along the ray; ours starts on the near plane, where the same pixel is.
  CHECK(screenToRay(camera, {2, 2}, RayOrigin::nearPlane).origin == Vec3{2, 2, -1});
  CHECK(screenToRay(camera, {0, 0}, RayOrigin::nearPlane).origin == Vec3{0, 0, -1});
}

TEST_CASE("OpenUSD: GfFrustum.ComputeNarrowedFrustum is a tile of the picture") {
  // A window of 3 by 2 about the axis; narrowed to a tenth about the picture's middle and about the point (.1, .2, -5).
  const Viewport ndc{2, 2, -1, -1, 0, 1, Origin::bottomLeft};
  const Pose pose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right);
  const auto narrowed = [&](const Projection& p, const Vec3& about) {
    const ScreenPoint at = worldToScreen(makeCamera(pose, p, ndc), about);
    const Projection tile = cropped(p, ndc, {at.x - 0.1 + 1, at.y - 0.1 + 1, 0.2, 0.2});
    return std::array<double, 4>{parts(tile).left.hi, parts(tile).bottom.hi, parts(tile).right.hi, parts(tile).top.hi};
  };
  const auto check = [](const std::array<double, 4>& ours, const std::array<double, 4>& expected) {
    for (std::size_t i = 0; i < 4; ++i) CHECK(std::fabs(ours[i] - expected[i]) <= 64 * kRounding);
  };
  check(narrowed(orthographic(-3, 3, -2, 2, 1, 10), {0, 0, -1}), {-0.3, -0.2, 0.3, 0.2});
  check(narrowed(orthographic(-3, 3, -2, 2, 1, 10), {.1, .2, -5}), {-0.2, 0, 0.4, 0.4});
  check(narrowed(frustum(-3, 3, -2, 2, 1, 10), {.1, .2, -5}), {-0.28, -0.16, 0.32, 0.24});
}

TEST_CASE("OpenUSD: GfCamera's frustum corners, aperture 34 x 34/2.4, focal length 26.684656143188477, 10 to 100") {
  // The transform is printed there for row vectors.
  const Mat4 transform = transposed({{{{0.8731530112777166, 0.3850071166178898, 0.2989537406526877, 0},
                                       {-0.4240369593016693, 0.9024253932905512, 0.07629591529425725, 0},
                                       {-0.2404089766270184, -0.1933854433455958, 0.9512126966452756, 0},
                                       {-100.0, 123.0, 153.0, 1.0}}}});
  const Pose pose = poseFromWorldFromCamera(transform, CameraAxes::RUB);
  const Viewport unit{1, 1, 0, 0, 0, 1, Origin::bottomLeft};
  const Vec2 screens[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};

  // left bottom, right bottom, left top, right top; near, then far
  const Vec3 perspective[] = {
      {-102.032919327869, 120.085637354940, 141.38080336149}, {-90.9077235508873, 124.991168793969, 145.18989392187},
      {-104.284096916572, 124.876540072942, 141.78585214522}, {-93.1589011395900, 129.782071511971, 145.59494270559},
      {-120.329193278696, 93.8563735494037, 36.808033614959}, {-9.07723550887376, 142.911687939691, 74.898939218725},
      {-142.840969165722, 141.765400729428, 40.858521452219}, {-31.5890113959001, 190.820715119715, 78.949427055984}};
  const Camera lens = makeCamera(pose, perspectiveFocalLength(26.684656143188477, {.width = 34}, 2.4, 10, 100), unit);
  // Apertures of 340 x 340/2.4 tenths of a unit.
  const Vec3 parallel[] = {
      {-109.435916189226, 111.996553352311, 137.8652300230474}, {-79.748713805783, 125.086795317320, 148.0296572052388},
      {-115.443106661676, 124.780913549591, 138.9460888618555}, {-85.755904278233, 137.871155514600, 149.1105160440469},
      {-87.799108292794, 129.401243253415, 52.2560873249726},   {-58.111905909352, 142.491485218423, 62.4205145071640},
      {-93.806298765244, 142.185603450695, 53.3369461637807},   {-64.119096381802, 155.275845415703, 63.5013733459721}};
  const double halfHeight = 17 / 2.4;
  const Camera box = makeCamera(pose, orthographic(-17, 17, -halfHeight, halfHeight, 10, 100), unit);

  for (std::size_t i = 0; i < 8; ++i) {
    const double depth = i < 4 ? 0 : 1;
    // GfCamera holds its apertures in float32: 1e-7 of the far corner's 100 units.
    checkVector(screenToWorld(lens, screens[i % 4], depth).position, perspective[i], 1e-5);
    checkVector(screenToWorld(box, screens[i % 4], depth).position, parallel[i], 1e-5);
  }
}

// Direct3D

TEST_CASE("Direct3D 11 functional specification: the viewport scale matrix") {
  const Viewport v{1280, 720, 100, 50, 0.25, 0.75};
  checkEntries(laidOut(screenFromNdc(v, preset("d3d")), preset("d3d")),
               {{{{640, 0, 0, 0}, {0, -360, 0, 0}, {0, 0, 0.5, 0}, {100 + 640, 50 + 360, 0.25, 1}}}}, 0);
}

// WebGPU

TEST_CASE("WebGPU specification: vp.x + 0.5 (n.x + 1) w, vp.y + 0.5 (-n.y + 1) h, min + n.z (max - min)") {
  const Viewport v{300, 150, 11, 13, 0.125, 0.875};
  const Mat4 m = screenFromNdc(v, preset("webgpu"));
  for (const Vec3& n : {Vec3{-1, -1, 0}, Vec3{1, 1, 1}, Vec3{0.25, -0.5, 0.5}}) {
    const Vec4 screen = times(m, peers::point(n));
    CHECK(screen.x == 11 + 0.5 * (n.x + 1) * 300);
    CHECK(screen.y == 13 + 0.5 * (-n.y + 1) * 150);
    CHECK(screen.z == 0.125 + n.z * 0.75);
  }
}

// Engines

TEST_CASE("Unity and Filament: the GPU's reversed matrix has row z replaced by (row w - row z) / 2") {
  const Projection p = perspective(60, 1.5, 0.3, 1000);
  const Mat4 g = clipFromView(p, preset("unity"));
  Convention gpu = preset("unity");
  gpu.ndcZ = NdcZ::zeroToOne;
  gpu.reverseZ = true;
  const Mat4 ours = clipFromView(p, gpu);
  // The subtraction -1 + 1.0006 that the engines do leaves the error of 1 in 0.0003.
  for (std::size_t j = 0; j < 4; ++j) CHECK(std::fabs(ours[2][j] - (g[3][j] - g[2][j]) / 2) <= 2 * kRounding);
}

TEST_CASE("Unreal: a camera without rotation looks along +X, its right is +Y and Z is up") {
  const Pose pose = poseFromRotation({0, 0, 0}, {0, 0, 0, 1}, CameraAxes::FRU);
  const Camera camera =
      makeCamera(pose, perspective(90, 1, 10, kInfiniteFar, Fov::horizontal), Viewport{100, 100}, preset("unreal"));
  CHECK(worldToScreen(camera, Vec3{100, 0, 0}).x == 50);
  CHECK(worldToScreen(camera, Vec3{100, 50, 0}).x == 75);
  CHECK(worldToScreen(camera, Vec3{100, 0, 50}).y == 25);
  CHECK(worldToScreen(camera, Vec3{100, 0, 0}).depth == 0.1);  // near / distance
}

TEST_CASE("PS2: sceVu0ViewScreenMatrix in closed form, near at zmax and far at zmin") {
  const double scrz = 512, ax = 1, ay = 0.46875, cx = 2048, cy = 2048, zmin = 1, zmax = 16777215, n = 1, f = 65536;
  const double width = 640, height = 224;
  const Viewport v{width, height, cx - width / 2, cy - height / 2, zmin, zmax};
  const Projection p = intrinsics(ax * scrz, ay * scrz, cx, cy, v, n, f);
  const double az = f * n * (zmax - zmin) / (f - n), cz = (zmin * f - zmax * n) / (f - n);
  const Convention c = preset("ps2");
  checkEntries(laidOut(matrix(cameraOfParts(p, c, v), Space::screen, Space::view), c),
               {{{{ax * scrz, 0, 0, 0}, {0, ay * scrz, 0, 0}, {cx, cy, cz, 1}, {0, 0, az, 0}}}}, kFewRoundings);

  const Camera camera = makeCamera(lookAlong({0, 0, 0}, {0, 0, 1}, {0, -1, 0}, Handedness::right), p, v, c);
  const ScreenPoint near = worldToScreen(camera, Vec3{0.25, 0.125, n}), far = worldToScreen(camera, Vec3{0, 0, f});
  CHECK(near.x == cx + 128);
  CHECK(near.y == cy + 30);
  CHECK(near.depth == zmax);
  CHECK(far.depth == zmin);
}

// OpenCV and those who convert from it

TEST_CASE("OpenCV: K in clip space, whole numbers at pixel centres and at pixel corners") {
  const double W = 1280, H = 720, fx = 1000.5, fy = 998.25, cx = 655.25, cy = 340.75;
  for (double centre : {0.0, 0.5}) {
    const double half = 0.5 - centre;  // of a pixel, between K's origin and the picture's corner
    Viewport v{W, H};
    v.pixelCenter = centre;
    const Projection p = intrinsics(fx, fy, cx, cy, v, 0.1, kInfiniteFar);
    const Mat4 g = clipFromView(p, gl());
    const Mat4 o = clipFromView(p, preset("opencv"));
    const double x = 2 * (cx + half) / W - 1, y = 2 * (cy + half) / H - 1;
    const double e = 8 * kRounding;  // of terms of about 1
    CHECK(std::fabs(g[0][0] - 2 * fx / W) <= e);
    CHECK(std::fabs(g[1][1] - 2 * fy / H) <= e);
    CHECK(std::fabs(g[0][2] + x) <= e);
    CHECK(std::fabs(g[1][2] - y) <= e);
    CHECK(std::fabs(o[0][0] - 2 * fx / W) <= e);
    CHECK(std::fabs(o[0][2] - x) <= e);
    CHECK(std::fabs(o[1][1] + 2 * fy / H) <= e);
    CHECK(std::fabs(o[1][2] + y) <= e);
    CHECK(o[3] == std::array<double, 4>{0, 0, 1, 0});
  }
}
