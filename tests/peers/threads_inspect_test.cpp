// What users of other libraries have stumbled over when they had a matrix and not the camera it came from.
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/matrix_transform.hpp>

#include "catch.hpp"
#include "commands/inspect_report.hpp"
#include "internals.hpp"
#include "parts.hpp"
#include "random_cameras.hpp"
#include "thread_cameras.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace viewproj::cmd;
using namespace peers;

namespace {

/// The sixteen numbers as they lie in memory, in four rows.
template <class T>
Mat4 memoryOf(const glm::mat<4, 4, T>& m) {
  Mat4 n;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) n[std::size_t(i)][std::size_t(j)] = static_cast<double>(m[i][j]);
  return n;
}

bool holds(const PlaneDistance& e, double number) { return e.low <= number && number <= e.high; }

std::vector<MatrixCamera> readAs(const MatrixCameras& in, const char* name, MatrixKind kind,
                                 NumberOrder order = NumberOrder::memory) {
  std::vector<MatrixCamera> result;
  for (const MatrixCamera& r : in.cameras)
    if (r.kind == kind && fits(r, preset(name), order)) result.push_back(r);
  return result;
}

}  // namespace

TEST_CASE(
    "Whether the view looks along +z or -z is read off the w row, also when depth is reversed "
    "[bgfx#2167, transform-gizmo PR#108]") {
  // The sign of the z row's entry, which is what such guesses go by, changes with reversal; w's does not.
  int checked = 0;
  for (const Convention& c : everyConvention())
    for (double far : {100.0, kInfiniteFar}) {
      const MatrixCameras in = camerasOf(clipFromView(lens(0.1, far), c));
      REQUIRE_FALSE(in.cameras.empty());
      for (const MatrixCamera& r : in.cameras) {
        CHECK((r.convention.view == ViewAxes::RUB) == (c.view == ViewAxes::RUB));
        CHECK(r.convention.reverseZ == c.reverseZ);
        ++checked;
      }
    }
  CHECK(checked > 88);
  // In orthographic, forward RUB and reversed RUF are the same sixteen numbers: both are listed.
  Convention forward = preset("opengl"), reversed = preset("opengl-lh");
  reversed.reverseZ = true;
  const Projection box = orthographic(-2, 2, -1, 1, -10, 10);
  CHECK(clipFromView(box, forward) == clipFromView(box, reversed));
  bool hasForward = false, hasReversed = false;
  for (const MatrixCamera& r : camerasOf(clipFromView(box, forward)).cameras) {
    hasForward = hasForward || (r.convention.view == ViewAxes::RUB && !r.convention.reverseZ);
    hasReversed = hasReversed || (r.convention.view == ViewAxes::RUF && r.convention.reverseZ);
  }
  CHECK(hasForward);
  CHECK(hasReversed);
}

TEST_CASE(
    "Row vectors by rows and column vectors by columns are the same sixteen numbers, and one reading "
    "[DirectXMath#82, DirectXMath#254, glm#85, bgfx#1627]") {
  const Convention columns = preset("webgpu"), rows = preset("d3d-rh");
  const std::array<double, 16> numbers = inStorageOrder(clipFromView(lens(), columns), columns);
  REQUIRE(numbers == inStorageOrder(clipFromView(lens(), rows), rows));
  const MatrixCameras in = camerasOf(fromStorageOrder(numbers, {.storage = Storage::rowMajor}));
  REQUIRE(readAs(in, "webgpu", MatrixKind::projection).size() == 1);
  REQUIRE(readAs(in, "d3d-rh", MatrixKind::projection).size() == 1);
  for (const MatrixCamera& r : in.cameras) CHECK(r.layout == MatrixLayout::transposed);
  // On paper they are each other's transpose.
  const MatrixCameras paper = camerasOf(laidOut(clipFromView(lens(), rows), rows));
  CHECK(readAs(paper, "d3d-rh", MatrixKind::projection, NumberOrder::rows).size() == 1);
  for (const MatrixCamera& r : paper.cameras) CHECK(r.layout == MatrixLayout::transposed);
}

TEST_CASE(
    "A camera-to-world matrix is listed with z back and z forward, and as a view too "
    "[nerfstudio#1286, nerfstudio#2019, nerfstudio#3484, instant-ngp#72, colmap#3499]") {
  const MatrixCameras in = camerasOf(worldFromView(somePose(), preset("opengl")));
  CHECK(in.cameras.size() == 6);
  Convention rows = preset("opengl");
  rows.storage = Storage::rowMajor;
  for (const MatrixCamera& r : in.cameras) {
    if (r.kind != MatrixKind::worldFromView) continue;
    CHECK(r.pose->eye().x == 3);
    CHECK(r.pose->eye().z == 5);
    const double ahead = dot(r.pose->forward(), {3, 2, 5});  // the pose looks at the origin
    CHECK((ahead < 0) == (r.convention.view == ViewAxes::RUB));
    if (!fits(r, rows, NumberOrder::memory)) continue;
    // OpenCV's axes of the same camera: y and z of the matrix turned round.
    const Mat4 opencv = converted(r, preset("opencv"));
    const Mat4 expected = worldFromView(somePose(), preset("opencv"));
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) CHECK(opencv[i][j] == expected[i][j]);
  }
}

TEST_CASE("near and far read from a float32 matrix come with what is left of them [cglm PR#16]") {
  const auto m = glm::perspective(1.0F, 1.5F, 0.1F, 1e6F);
  const auto found = readAs(camerasOf(memoryOf(m), {.float32 = true}), "opengl", MatrixKind::projection);
  REQUIRE(found.size() == 1);
  CHECK(found[0].lens->zFar.value == Approx(838861).epsilon(1e-5));  // what such a decomposition returns
  CHECK(holds(found[0].lens->zFar, 1e6));
  CHECK(found[0].lens->zFar.high > 1.5 * found[0].lens->zFar.low);
  CHECK(holds(found[0].lens->zNear, 0.1));
  CHECK(found[0].lens->zNear.high - found[0].lens->zNear.low < 3e-8);
}

TEST_CASE("An infinite projection that is tweaked by an epsilon is read as infinite, and told [JOML, GLM]") {
  const auto m = glm::tweakedInfinitePerspective(1.0, 1.5, 0.1, 1e-6);
  const auto found = readAs(camerasOf(memoryOf(m)), "opengl", MatrixKind::projection);
  REQUIRE(found.size() == 1);
  CHECK(std::isinf(found[0].lens->zFar.value));
  CHECK(found[0].lens->beyondInfinity);
  CHECK(found[0].lens->zNear.value == Approx(0.1).epsilon(1e-15));
  // Three-tenths of the way to the near plane is no tweak.
  CHECK(
      readAs(camerasOf(memoryOf(glm::tweakedInfinitePerspective(1.0, 1.5, 0.1, 0.3))), "opengl", MatrixKind::projection)
          .empty());
}

TEST_CASE("Axes of left, up, forward are a camera in the origin whose right is -x [pytorch3d#522]") {
  const MatrixCameras in = camerasOf(Mat4{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1.25, -1.25}, {0, 0, 1, 0}}}});
  const MatrixCameras mirrored = camerasOf(Mat4{{{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1.25, -1.25}, {0, 0, 1, 0}}}});
  for (const MatrixCamera& r : in.cameras) CHECK(r.kind == MatrixKind::projection);
  REQUIRE(mirrored.cameras.size() == 4);
  for (const MatrixCamera& r : mirrored.cameras) {
    CHECK(r.kind == MatrixKind::viewProjection);
    CHECK(r.pose->right() == Vec3{-1, 0, 0});
    CHECK(r.pose->forward() == Vec3{0, 0, 1});
  }
}

TEST_CASE("A view-projection matrix by GLM gives back its camera [glm, thread 13]") {
  const auto view = glm::lookAt(glm::dvec3(3, 2, 5), glm::dvec3(0), glm::dvec3(0, 1, 0));
  const auto m = glm::perspective(1.0, 1.5, 0.1, 100.0) * view;
  const auto found = readAs(camerasOf(memoryOf(m)), "opengl", MatrixKind::viewProjection);
  REQUIRE(found.size() == 1);
  CHECK(found[0].convention.world == Handedness::right);
  for (std::size_t i = 0; i < 3; ++i) CHECK(std::fabs(found[0].pose->eye()[i] - Vec3{3, 2, 5}[i]) < 1e-14);
  CHECK(found[0].lens->zNear.value == Approx(0.1).epsilon(1e-13));
  CHECK(found[0].lens->zFar.value == Approx(100).epsilon(1e-11));
  CHECK(2 * std::atan(found[0].lens->top) == Approx(1).epsilon(1e-14));
}
