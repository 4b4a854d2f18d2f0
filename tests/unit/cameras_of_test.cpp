// Which cameras sixteen numbers can be of; that pose and window are right to 2^-90, reference/cameras_of_test shows.
#include "viewproj/cameras_of.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "parts.hpp"
#include "random.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;

namespace {

MatrixCamera theOnly(const Mat4& m, const MatrixQuery& query) {
  const MatrixCameras found = camerasOf(m, query);
  INFO(found.fault);
  REQUIRE(found.cameras.size() == 1);
  return found.cameras.front();
}

/// A square window of 1 and near 1.
Projection plain(double far) { return perspectiveWindow(-0.5, 0.5, -0.5, 0.5, 1, far); }

Mat4 asFloats(Mat4 m, double scale = 1) {
  for (auto& row : m.m)
    for (double& entry : row) entry = static_cast<double>(static_cast<float>(scale * entry));
  return m;
}

/// Half a step of float32 for each entry that is not 0.
Mat4 floatErrors(Mat4 m) {
  for (auto& row : m.m)
    for (double& entry : row) {
      const float size = std::fabs(static_cast<float>(entry));
      entry = entry == 0 ? 0 : (double{std::nextafter(size, HUGE_VALF)} - double{size}) / 2;
    }
  return m;
}

}  // namespace

TEST_CASE("A view-projection has a reading for each handedness, and for each range of depth that can be") {
  // Reversed 0..1 has only that range if far > 2 near; all else can be read with the other range and another near or
  // far.
  struct Row {
    double near, far;
    NdcZ ndcZ;
    bool reverseZ;
    std::size_t ranges;
  };
  const Row rows[] = {
      {0.1, 1000, NdcZ::zeroToOne, true, 1},      {0.1, HUGE_VAL, NdcZ::zeroToOne, true, 1},
      {0.1, 0.15, NdcZ::zeroToOne, true, 2},      {0.1, 1000, NdcZ::minusOneToOne, true, 2},
      {0.1, 1000, NdcZ::zeroToOne, false, 2},     {0.1, 1000, NdcZ::minusOneToOne, false, 2},
      {0.1, HUGE_VAL, NdcZ::zeroToOne, false, 2}, {0.1, HUGE_VAL, NdcZ::minusOneToOne, true, 2},
  };
  for (const Row& row : rows)
    for (const Handedness world : {Handedness::right, Handedness::left}) {
      Convention c;
      c.world = world;
      c.ndcZ = row.ndcZ;
      c.reverseZ = row.reverseZ;
      const Pose pose = lookAlong({3, 2, 5}, {-4, -1.5, -4.75}, {0, 1, 0}, world);
      const Projection lens = perspectiveWindow(-0.5, 0.5, -0.5, 0.5, row.near, row.far);
      const std::vector<MatrixCamera> cameras = camerasOf(clipFromWorld(pose, lens, c)).cameras;
      INFO("near " << row.near << " far " << row.far << " reversed " << row.reverseZ);
      CHECK(cameras.size() == 2 * row.ranges);
      for (const Handedness each : {Handedness::right, Handedness::left})
        CHECK(std::count_if(cameras.begin(), cameras.end(), [&](const MatrixCamera& camera) {
                return camera.kind == MatrixKind::viewProjection && camera.convention.world == each;
              }) == static_cast<std::ptrdiff_t>(row.ranges));
    }
}

TEST_CASE("Intervals of near and far are as wide as the rounding of the entries makes them") {
  // Entries moved by half a float32 step, and read as doubles: every value stays inside, some come close to an end.
  int checked = 0;
  for (std::uint64_t trial = 0; trial < 25; ++trial) {
    Random random(trial);
    Convention c;
    c.reverseZ = random.coin();
    c.ndcZ = random.coin() ? NdcZ::zeroToOne : NdcZ::minusOneToOne;
    const bool isOrthographic = random.oneIn(3);
    const double near = isOrthographic ? random.uniform(-50, 50) : random.logUniform(1e-3, 1e3);
    const double width = random.logUniform(0.01, 10), height = random.logUniform(0.01, 10), off = random.uniform(-1, 1);
    const Projection lens =
        isOrthographic
            ? orthographic(off - width, off + width, -height, height, near, near + random.logUniform(1, 1e3))
            : perspectiveWindow(off - width, off + width, -height, height, near, near * random.logUniform(2, 1e3));
    const Pose pose = lookAlong(random.direction(9), random.direction(), {0.1, 1, 0.2}, Handedness::right);
    for (const MatrixKind kind : {MatrixKind::projection, MatrixKind::viewProjection}) {
      // Of a multiple, the w row counts too.
      const bool isMultiple = trial % 4 == 0,
                 hasExactW = !isMultiple && (kind == MatrixKind::projection || isOrthographic);
      const Mat4 m = asFloats(kind == MatrixKind::projection ? clipFromView(lens, c) : clipFromWorld(pose, lens, c),
                              isMultiple ? 3 : 1);
      const auto ends = [&](const Mat4& matrix, bool float32) {
        const MatrixLens found =
            *theOnly(
                 matrix,
                 {.kind = kind, .convention = c, .errors = float32 ? std::optional(floatErrors(matrix)) : std::nullopt})
                 .lens;
        return std::array<PlaneDistance, 2>{found.zNear, found.zFar};
      };
      const std::array<PlaneDistance, 2> whole = ends(m, true);
      const bool isFromOrigin = isOrthographic && kind == MatrixKind::viewProjection;
      for (std::size_t k = 0; k < 2 && !isFromOrigin; ++k) {
        const double truth = k == 0 ? lens.zNear() : lens.zFar(), rest = 1e-6 * (whole[k].high - whole[k].low);
        CHECK((whole[k].low - rest <= truth && truth <= whole[k].high + rest));
      }
      std::array<double, 2> reached{};
      for (int sample = 0; sample < 256; ++sample) {
        Mat4 moved = m;
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < 4; ++j) {
            double& entry = moved[i][j];
            if (entry == 0 || (i == 3 && hasExactW)) continue;
            const auto narrow = static_cast<float>(entry);
            entry += (double{std::nextafter(narrow, random.coin() ? HUGE_VALF : -HUGE_VALF)} - entry) / 2;
          }
        const std::array<PlaneDistance, 2> there = ends(moved, false);
        for (std::size_t k = 0; k < 2; ++k) {
          const double half = (whole[k].high - whole[k].low) / 2;
          const double away = std::fabs(there[k].value - (whole[k].low + half));
          INFO("trial " << trial << " kind " << int(kind) << " parameter " << k);
          CHECK(away <= half * (1 + 1e-3));
          reached[k] = std::max(reached[k], away / half);
        }
      }
      for (const double share : reached) {
        INFO("trial " << trial << " kind " << int(kind) << " orthographic " << isOrthographic);
        // A projection's parameter hangs on two or three entries, so that some sample takes all to their ends.
        CHECK(share > (kind == MatrixKind::projection && !isMultiple ? 0.99 : 0.2));
        ++checked;
      }
    }
  }
  CHECK(checked == 100);
}

TEST_CASE("A last entry a few units in the last place from 1 divides a view or a pose, exactly") {
  for (const int steps : {-8, -5, -4, -1, 1, 2, 4, 5})
    for (const bool turned : {false, true}) {
      const double last = 1 + steps * 0x1p-52;
      const Mat4 m{{{{0.6, 0, 0.8, 0.36}, {0, 1, 0, -0.48}, {-0.8, 0, 0.6, 0.8}, {0, 0, 0, last}}}};
      std::size_t poses = 0;
      for (const MatrixCamera& camera : camerasOf(turned ? transposed(m) : m).cameras) {
        if (!camera.pose || camera.lens) continue;
        ++poses;
        CHECK(camera.layout == (turned ? MatrixLayout::transposed : MatrixLayout::asWritten));
        CHECK(camera.scale == last);
      }
      CHECK(poses == (steps < -4 || steps > 4 ? 0 : 6));
    }
  // Of float32s it is their units that count.
  const Mat4 m{{{{0, 0, 1, 3}, {0, 1, 0, 4}, {-1, 0, 0, 5}, {0, 0, 0, 1 - 2 * 0x1p-23}}}};
  CHECK(camerasOf(m, {.errors = floatErrors(m)}).cameras.front().kind == MatrixKind::view);
  CHECK(camerasOf(m).cameras.front().kind != MatrixKind::view);
}

TEST_CASE("A far plane a little beyond infinity is infinite, and one well behind the eye is none") {
  const auto lensOf = [](double a, double b) -> std::optional<MatrixLens> {
    const Mat4 m{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -a, -b}, {0, 0, -1, 0}}}};
    const MatrixCameras found = camerasOf(m, {.kind = MatrixKind::projection, .convention = conventions::metal});
    return found.cameras.empty() ? std::nullopt : found.cameras.front().lens;
  };
  // NDC z = a - b / W: 1 at infinity, at -2^20 / 3, and at -65.
  const auto tweaked = lensOf(1 - 3 * 0x1p-20, 1);
  REQUIRE(tweaked);
  CHECK(tweaked->beyondInfinity);
  CHECK(std::isinf(tweaked->zFar.low));
  CHECK(tweaked->projection->zFar() == kInfiniteFar);
  CHECK(lensOf(1, 1)->zFar.value == kInfiniteFar);
  CHECK_FALSE(lensOf(1, 1)->beyondInfinity);
  CHECK_FALSE(lensOf(1 - 1.0 / 64, 1));
}

TEST_CASE("A near that its digits leave open is told with its window, and makes no camera of a stated convention") {
  // A near of 1e-9 seen from 1e6 away, in float32s: from the first eye it is below 0, so 0.
  for (const double x : {1e6, 1.3e6}) {
    const Pose pose = lookAlong({x, 2e6, 3e6}, {-1, -2, -2}, {0, 1, 0}, Handedness::right);
    const Mat4 m = asFloats(clipFromWorld(pose, perspectiveWindow(-0.5, 0.5, -0.5, 0.5, 1e-9, 1.7e-9), {}));
    const MatrixCameras found = camerasOf(m, {.kind = MatrixKind::viewProjection, .errors = floatErrors(m)});
    REQUIRE(!found.cameras.empty());
    for (const MatrixCamera& camera : found.cameras) {
      CHECK(camera.lens->zNear.low == 0);
      CHECK(camera.lens->zNear.high > 1e-9);
      CHECK((camera.lens->zNear.value == 0) == (x == 1e6));
      CHECK(camera.lens->right == Approx(0.5).epsilon(1e-6));
      CHECK(camera.lens->projection.has_value() == (camera.lens->zNear.value > 0));
    }
  }
  const Mat4 none{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, -5e-324}, {0, 0, -1, 0}}}};
  CHECK_FALSE(camerasOf(none, {.kind = MatrixKind::projection}).cameras.empty());
  CHECK(camerasOf(none, {.kind = MatrixKind::projection, .convention = conventions::opengl}).fault ==
        "it does not determine near and far");
}

TEST_CASE("Rows x, y and w of a camera are told where the depth row is none of a camera") {
  const Pose pose = lookAlong({3, 2, 5}, {-4, -1.5, -4.75}, {0, 1, 0}, Handedness::right);
  const Mat4 whole = clipFromWorld(pose, plain(9), {});
  struct Row {
    std::array<double, 4> z;
    const char* fault;
  };
  const Row rows[] = {{{0, 0, 0, 0}, "depth is lost"},
                      {{0, 0, 0, -2}, "depth is constant"},
                      {{0, 1, 0, 0}, "not along the view"},
                      {{1.001 * whole[3][0], 1.001 * whole[3][1], 1.001 * whole[3][2], 1.001 * whole[3][3] + 0.003},
                       "the w row again, times 1.001"}};
  for (const Row& row : rows) {
    Mat4 m = whole;
    m[2] = row.z;
    const std::vector<MatrixCamera> cameras = camerasOf(m).cameras;
    REQUIRE(cameras.size() == 2);  // NDC y up and down
    for (const MatrixCamera& camera : cameras) {
      INFO(camera.lens->depthFault);
      CHECK(camera.lens->depthFault.find(row.fault) != std::string::npos);
      CHECK(camera.kind == MatrixKind::viewProjection);
      CHECK(camera.pose->eye().x == Approx(3));
      CHECK(camera.lens->right == Approx(0.5));
    }
    // A z row of zeros is no fault of a stated convention, but a camera without near.
    const std::vector<MatrixCamera> stated = camerasOf(m, {.convention = Convention{}}).cameras;
    REQUIRE(stated.size() == (row.z == std::array<double, 4>{} ? 1 : 0));
    for (const MatrixCamera& camera : stated) CHECK(camera.lens->projection->zNear() == 0);
  }
}

TEST_CASE("Eye and fields of view are as far off as the entries make them") {
  // Entries rounded to so many decimals: the truth stays inside, and comes near an end.
  for (const int decimals : {2, 3, 4, 5, 6}) {
    double farthest = 0;
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
      Random random(trial);
      const Pose pose = lookAlong(random.direction(9), random.direction(), {0.1, 1, 0.2}, Handedness::right);
      const double half = random.uniform(0.2, 1.5), shift = random.oneIn(3) ? random.uniform(-0.3, 0.3) : 0;
      const Projection lens = perspectiveWindow(shift - half, shift + half, -half, half, 0.1, 1000);
      const bool isView = random.coin();
      Mat4 m = isView ? viewFromWorld(pose, {}) : clipFromWorld(pose, lens, {});
      Mat4 errors;
      const double step = std::pow(10, -decimals);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          m[i][j] = std::round(m[i][j] / step) * step;
          errors[i][j] = isView && i == 3 ? 0 : step / 2;
        }
      for (const MatrixCamera& camera : camerasOf(m, {.errors = errors}).cameras) {
        if (camera.kind != (isView ? MatrixKind::view : MatrixKind::viewProjection)) continue;
        INFO("trial " << trial << ", " << decimals << " decimals");
        const Vec3 eye = camera.pose->eye(), truth = pose.eye();
        for (std::size_t i = 0; i < 3; ++i) {
          const double off = std::fabs(eye[i] - truth[i]);
          CHECK(off <= camera.eyeError[i]);
          farthest = std::max(farthest, off / camera.eyeError[i]);
        }
        if (!camera.lens) continue;
        const auto fov = [](double low, double high) {
          return (std::atan(high) - std::atan(low)) * 180 / 3.14159265358979;
        };
        CHECK(std::fabs(fov(camera.lens->left, camera.lens->right) - lens.fov(Fov::horizontal)) <=
              camera.lens->fovError.x);
        CHECK(std::fabs(fov(camera.lens->bottom, camera.lens->top) - lens.fov(Fov::vertical)) <=
              camera.lens->fovError.y);
      }
    }
    CHECK(farthest > 0.3);
  }
}

TEST_CASE("Errors so large that no right angle can be told leave no camera") {
  const Mat4 m{{{{0.9, -0.4, 0, 1}, {0.4, 0.9, 0, 2}, {0, 0, 1, 3}, {0, 0, 0, 1}}}};
  const auto withErrors = [](double size) {
    Mat4 errors;
    for (std::size_t i = 0; i < 3; ++i) errors[i] = {size, size, size, size};
    return errors;
  };
  CHECK(camerasOf(m, {.errors = withErrors(0.05)}).cameras.front().kind == MatrixKind::view);
  CHECK(camerasOf(m, {.errors = withErrors(0.001)}).cameras.front().kind == MatrixKind::viewProjection);
  CHECK(camerasOf(m, {.errors = withErrors(0.2)}).cameras.empty());
}

TEST_CASE("What no camera has written is told with its fault") {
  const auto fault = [](const std::array<double, 16>& n, const MatrixQuery& query = {}) {
    const MatrixCameras found = camerasOf(fromStorageOrder(n, conventions::opencv), query);
    for (const MatrixCamera& camera : found.cameras) CHECK(!camera.lens->depthFault.empty());
    return found.fault;
  };
  const auto has = [](const std::string& text, const char* word) { return text.find(word) != std::string::npos; };
  CHECK(has(fault({}), "w row is 0 0 0 0"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2}), "w row is 0 0 0 -2"));
  CHECK(has(fault({1, 0.5, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "right angles"));
  CHECK(has(fault({1, 0.5, 0, 0, 0, 1, 0, 0, 0, 0, -1, -0.5, 0, 0, -1, 0}), "right angles"));
  CHECK(has(fault({1, 0, 0, 3, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "flattens"));
  for (const double n : {7.0, 1.1, 1e-3}) {
    CHECK(has(fault({n, n, n, n, n, n, n, n, n, n, n, n, n, n, n, n}), "across the picture"));
    CHECK(has(fault({1, 0, 0, 0, n, n, n, n, 0, 0, 1, 0, n, n, n, n}), "across the picture"));
  }
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0.2, 0.1, -1, -0.5, 0, 0, -1, 0}), "oblique"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.5, 100, 0, 0, -1, 0}), "viewport"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, NAN, 0, 0, -1, 0}), "finite"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1.1e45, 0, 0, -1, 0}), "1e45"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 1e45, 0, 1e45, 1, 0, 0, 0, 1, 1}), "right angles"));
  // With a convention: which of its axes are others, and whether it is the transpose that fits.
  const Mat4 m = clipFromView(plain(9), conventions::d3d);
  const MatrixQuery asOpenGl{.kind = MatrixKind::projection, .convention = conventions::opengl};
  CHECK(camerasOf(m, asOpenGl).fault == "it is of a convention with another view");
  CHECK(camerasOf(clipFromView(plain(9), conventions::unreal), asOpenGl).fault ==
        "it is of a convention with another view, ndcZ, reverseZ");
  CHECK(has(camerasOf(transposed(m), {.kind = MatrixKind::projection, .convention = conventions::d3d}).fault,
            "; its transpose fits"));
  CHECK(camerasOf(m, {.kind = MatrixKind::view}).fault == "it is of another kind");
}
