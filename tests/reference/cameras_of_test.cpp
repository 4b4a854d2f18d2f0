// Poses and windows of matrices that were read, against the sixteen doubles themselves, taken as exact.

#include "viewproj/cameras_of.hpp"

#include <map>

#include "catch.hpp"
#include "internals.hpp"
#include "parts.hpp"
#include "reference/real.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

constexpr MatrixKind kKinds[] = {MatrixKind::projection, MatrixKind::view, MatrixKind::worldFromView,
                                 MatrixKind::viewProjection};

/// part . p + constant.
struct Row {
  Real3 part;
  Real constant;

  Real at(const Real3& p) const { return dot(part, p) + constant; }
};

Row operator*(const Row& a, const Real& k) { return {a.part * k, a.constant * k}; }
Row operator-(const Row& a, const Row& b) { return {a.part - b.part, a.constant - b.constant}; }

Real real(DoubleDouble a) { return Real(a.hi) + Real(a.lo); }
Real3 real(const DDVec3& a) { return {real(a.x), real(a.y), real(a.z)}; }

/// By the textbook, from the matrix alone.
struct TrueCamera {
  TrueCamera(const Mat4& m, const MatrixCamera& camera) {
    std::array<Row, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) rows[i] = {{m[i][0], m[i][1], m[i][2]}, m[i][3]};
    const AxisSigns sign = axisSigns(camera.convention.view);
    const double ndcUp = camera.convention.ndcY == NdcY::up ? 1 : -1;
    const Real last = rows[3].constant;
    if (camera.kind == MatrixKind::view) {
      axes = {rows[0] * (Real(1) / last), rows[1] * (Real(sign.up) / last), rows[2] * (Real(sign.forward) / last)};
    } else if (camera.kind == MatrixKind::worldFromView) {
      const Real3 c[] = {{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}};
      const Real3 eye{m[0][3], m[1][3], m[2][3]};
      const double signs[] = {1, sign.up, sign.forward};
      for (std::size_t i = 0; i < 3; ++i) {
        const Real3 across = cross(c[(i + 1) % 3], c[(i + 2) % 3]);
        const Real3 part = across * (last * Real(signs[i]) / dot(across, c[i]));
        axes[i] = {part, -dot(part, eye) / last};
      }
    } else {
      const bool orthographic = camera.lens->orthographic;
      const Real w = orthographic ? last : length(rows[3].part);
      const auto scaleOf = [&](std::size_t i, Real& scale, Real& offset) {
        Row across = rows[i];
        offset = orthographic ? rows[i].constant / w : dot(rows[i].part, rows[3].part) / (w * w);
        if (!orthographic) across = across - rows[3] * offset;
        scale = length(across.part) / w;
        return across * (Real(1) / length(across.part));
      };
      std::array<Real, 2> scale, offset;
      axes[0] = scaleOf(0, scale[0], offset[0]);
      axes[1] = scaleOf(1, scale[1], offset[1]) * Real(ndcUp);
      const double against = orthographic && camera.convention.reverseZ ? -1 : 1;
      const Row& depth = rows[orthographic ? 2 : 3];
      axes[2] = depth * (Real(against) / length(depth.part));
      if (orthographic)
        for (Row& axis : axes) axis.constant = 0;  // counted from the origin
      for (std::size_t i = 0; i < 2; ++i) {
        const Real low = (Real(-1) - offset[i]) / scale[i], high = (Real(1) - offset[i]) / scale[i];
        const bool turned = i == 1 && ndcUp < 0;
        window[i] = turned ? std::array<Real, 2>{-high, -low} : std::array<Real, 2>{low, high};
      }
    }
  }

  std::array<Row, 3> axes;  ///< right, up, forward
  std::array<std::array<Real, 2>, 2> window;
};

Mat4 write(MatrixKind kind, const Camera& c, const Convention& target) {
  switch (kind) {
    case MatrixKind::projection:
      return clipFromView(c.projection(), target);
    case MatrixKind::view:
      return viewFromWorld(c.pose(), target);
    case MatrixKind::worldFromView:
      return worldFromView(c.pose(), target);
    case MatrixKind::viewProjection:
      break;
  }
  return clipFromWorld(c.pose(), c.projection(), target);
}

struct Written {
  Camera camera;
  Convention convention;
  Mat4 matrix;
};

/// A matrix of this kind: as written, a multiple of it, or with each entry a little off.
Written randomMatrix(Random& random, MatrixKind kind, int variant) {
  Scene scene = randomScene(random, random.logUniform(1e-3, 1e9));
  scene.hasCrop = false;
  const auto presets = conventionPresets();
  Convention convention = presets[static_cast<std::size_t>(random.uniform(0, double(presets.size())))].convention;
  convention.world = scene.convention.world;
  convention.reverseZ = random.chance(0.5);
  const Camera camera = build(scene);
  Mat4 m = write(kind, camera, convention);
  const bool isPose = kind == MatrixKind::view || kind == MatrixKind::worldFromView;
  const double scale = variant != 1 ? 1 : isPose ? 1 - 0x1p-52 : random.logUniform(1e-3, 1e3);
  for (auto& row : m.m)
    for (double& entry : row) {
      entry *= scale;
      if (variant == 2 && entry != 1) entry *= 1 + random.uniform(-1e-9, 1e-9);
    }
  return {camera, convention, m};
}

/// As it was written, of its own convention, a matrix is one camera, whose near and far lie where the camera's do.
void checkTheOnly(const Written& written, MatrixKind kind) {
  const MatrixCameras found = camerasOf(written.matrix, {.kind = kind, .convention = written.convention});
  INFO(found.fault);
  REQUIRE(found.cameras.size() == 1);
  const MatrixCamera& camera = found.cameras.front();
  if (!camera.lens) return;
  const Projection& lens = written.camera.projection();
  CHECK(camera.lens->orthographic == lens.isOrthographic());
  // Rows of a view-projection may be of another length, and an orthographic one counts from the world's origin.
  if (kind == MatrixKind::viewProjection) return;
  const auto holds = [](const PlaneDistance& e, double truth) {
    const double rest = std::isinf(truth) ? 0 : 1e-6 * (e.high - e.low) + 1e-15 * std::fabs(truth);
    return e.low <= truth + rest && truth - rest <= e.high;
  };
  CAPTURE(lens.zNear(), lens.zFar());
  CHECK(holds(camera.lens->zNear, lens.zNear()));
  CHECK(holds(camera.lens->zFar, lens.zFar()));
}

/// |got - truth| <= 2^-90 size.
void check(const char* what, const Real& got, const Real& truth, const Real& size) {
  CAPTURE(what, double(got), double(truth), double(abs(got - truth)), double(size));
  CHECK(abs(got - truth) <= Real(0x1p-90) * size);
}

}  // namespace

TEST_CASE("Pose and window of a matrix are within 2^-90 of those of its sixteen numbers") {
  std::map<MatrixKind, int> tally;
  int scaled = 0;
  for (std::uint64_t trial = 0; trial < 1200; ++trial) {
    Random random(trial);
    const MatrixKind kind = kKinds[trial % 4];
    const int variant = int(trial / 4 % 3);
    const Written written = randomMatrix(random, kind, variant);
    const Mat4& m = written.matrix;
    if (variant == 0) checkTheOnly(written, kind);
    for (const MatrixCamera& camera : camerasOf(m, {.kind = kind}).cameras) {
      INFO("trial " << trial << ", kind " << int(kind));
      const TrueCamera truth(camera.layout == MatrixLayout::transposed ? transposed(m) : m, camera);
      ++tally[kind];
      scaled += camera.scale != 1;
      if (camera.pose) {
        const PoseParts& pose = parts(*camera.pose);
        const Real3 eye = real(unroundedEye(pose));
        const DDVec3* const rows[] = {&pose.rows.right, &pose.rows.up, &pose.rows.forward};
        for (std::size_t i = 0; i < 3; ++i) {
          const Row& axis = truth.axes[i];
          for (std::size_t j = 0; j < 3; ++j) check("axis", real(*rows[i])[j], axis.part[j], 1);
          check("eye", axis.at(eye), 0, length(eye));
        }
      }
      if (!camera.lens || !camera.lens->projection) continue;
      const ProjectionParts& lens = parts(*camera.lens->projection);
      const DoubleDouble edges[][2] = {{lens.left, lens.right}, {lens.bottom, lens.top}};
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < 2; ++k)
          check("window", real(edges[i][k]), truth.window[i][k],
                truth.window[i][1] - truth.window[i][0] + abs(truth.window[i][0]));
    }
  }
  for (const MatrixKind kind : kKinds) CHECK(tally[kind] > 300);
  CHECK(scaled > 300);
}
