// Cameras of matrices that were read, against the sixteen doubles themselves, taken as exact.

#include "input/readings/readings.hpp"

#include <map>

#include "catch.hpp"
#include "internals.hpp"
#include "matrix_numbers.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace viewproj::cmd;
using namespace reference;

namespace {

constexpr MatrixKind kKinds[] = {MatrixKind::projection, MatrixKind::view, MatrixKind::worldFromView,
                                 MatrixKind::viewProjection};
const Viewport kPicture{1600, 900};

/// Distances along right, up, forward as a row of the matrix has them: part . p + constant.
struct Row {
  Real3 part;
  Real constant;

  Real at(const Real3& p) const { return dot(part, p) + constant; }
};

Row operator*(const Row& a, const Real& k) { return {a.part * k, a.constant * k}; }
Row operator-(const Row& a, const Row& b) { return {a.part - b.part, a.constant - b.constant}; }

Real real(DoubleDouble a) { return Real(a.hi) + Real(a.lo); }

/// The matrix M of y = M x that a reading is of.
Mat4 matrixOf(const Numbers& numbers, const Reading& r) {
  Mat4 m;
  for (std::size_t i = 0; i < 16; ++i) m[i / 4][i % 4] = numbers[i];
  return r.layout == MatrixLayout::transposed ? transposed(m) : m;
}

/// By the textbook, from the matrix alone.
struct TrueReading {
  TrueReading(const Mat4& m, const Reading& r) : orthographic(r.lens && r.lens->orthographic) {
    std::array<Row, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) rows[i] = {{m[i][0], m[i][1], m[i][2]}, m[i][3]};
    const AxisSigns sign = axisSigns(r.convention.view);
    const double ndcUp = r.convention.ndcY == NdcY::up ? 1 : -1;
    switch (r.kind) {
      case MatrixKind::view:
        right = rows[0];
        up = rows[1] * sign.up;
        forward = rows[2] * sign.forward;
        return;
      case MatrixKind::worldFromView: {
        const Real3 c[] = {{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}};
        const Real3 eye{m[0][3], m[1][3], m[2][3]};
        const auto row = [&](std::size_t i, double by) {
          const Real3 across = cross(c[(i + 1) % 3], c[(i + 2) % 3]);
          const Real3 part = across * (Real(by) / dot(across, c[i]));
          return Row{part, -dot(part, eye)};
        };
        right = row(0, 1);
        up = row(1, sign.up);
        forward = row(2, sign.forward);
        return;
      }
      case MatrixKind::projection:  // of the identity's view
        right = {{1, 0, 0}, 0};
        up = {{0, sign.up, 0}, 0};
        forward = {{0, 0, sign.forward}, 0};
        break;
      case MatrixKind::viewProjection:
        if (orthographic) {
          const auto axis = [&](std::size_t i, double by) {
            return Row{rows[i].part * (Real(by) / length(rows[i].part)), 0};
          };
          right = axis(0, 1);
          up = axis(1, ndcUp);
          forward = axis(2, r.convention.reverseZ ? -1 : 1);
        } else {
          forward = rows[3] * (Real(1) / length(rows[3].part));
          const auto axis = [&](std::size_t i, double by) {
            const Row across = rows[i] - forward * dot(rows[i].part, forward.part);
            return across * (Real(by) / length(across.part));
          };
          right = axis(0, 1);
          up = axis(1, ndcUp);
        }
        break;
    }
    ndc = {rows[0], rows[1] * ndcUp, rows[3]};
    hasNdc = true;
  }

  bool orthographic, hasNdc = false;
  Row right, up, forward;
  std::array<Row, 3> ndc;  ///< x, y upwards, w
};

struct Tally {
  int certain = 0, uncertain = 0, behind = 0;
  int inView = 0, uncertainInView = 0;  ///< points anywhere in the view
};

class Judge {
 public:
  Judge(const TrueReading& truth, const Camera& camera) : truth_(truth), c_(camera) {}

  void check(const Vec3& point, Tally& tally) const {
    const Real3 p = toReal(point);
    const ScreenPoint got = worldToScreen(c_, point);
    const Real w = truth_.forward.at(p);
    CAPTURE(point.x, point.y, point.z, got.certain, double(w));
    judge("viewDistance", got, got.viewDistance, w, std::max(std::fabs(parts(c_).projection.near), 1.0));
    if (!truth_.orthographic && !(w > Real(0))) {
      ++tally.behind;
      REQUIRE(got.status == PointStatus::behind);
      return;
    }
    ++(got.certain ? tally.certain : tally.uncertain);
    REQUIRE(got.status == PointStatus::inFront);
    const Real divisor = truth_.orthographic ? Real(1) : w;
    const ProjectionParts& lens = parts(c_).projection;
    const auto share = [&](const Row& row, DoubleDouble low, DoubleDouble high) {
      return (row.at(p) / divisor - real(low)) / (real(high) - real(low));
    };
    judgeShares(got, share(truth_.right, lens.left, lens.right), share(truth_.up, lens.bottom, lens.top));
    // Window edges are numbers of their own: beside a picture that is far narrower they are not all of the matrix.
    if (truth_.hasNdc && size() <= 32 * kPicture.width) {
      const Real clipW = truth_.ndc[2].at(p);
      const auto ndcShare = [&](const Row& row) { return (row.at(p) / clipW + Real(1)) / Real(2); };
      judgeShares(got, ndcShare(truth_.ndc[0]), ndcShare(truth_.ndc[1]));
    }
    const Real near = lens.near, far = std::isinf(lens.far) ? Real(0) : Real(lens.far);
    Real toFar;  // 0 at near, 1 at far
    if (truth_.orthographic)
      toFar = (w - near) / (far - near);
    else
      toFar = std::isinf(lens.far) ? Real(1) - near / w : far * (w - near) / ((far - near) * w);
    const double depths[] = {c_.viewport().depthFirst, c_.viewport().depthSecond};
    const bool reversed = c_.convention().reverseZ;
    const Real first = depths[reversed], second = depths[!reversed];
    // In a thin slab the depth is known as well as the distance.
    const double slab = kExactDistance / kExactAbsolute * std::fabs(parts(c_).constants.depthScale.hi);
    const double size = std::fabs(double(w));
    judge("depth", got, got.depth, first + (second - first) * toFar,
          std::max(1.0, truth_.orthographic ? slab * size : slab / size));
  }

 private:
  /// Where the viewing axis meets the screen, a number cancels from there on.
  double size() const {
    return std::max(
        {kPicture.width, std::fabs(parts(c_).constants.centerX.hi), std::fabs(parts(c_).constants.centerY.hi)});
  }

  void judgeShares(const ScreenPoint& got, const Real& x, const Real& y) const {
    judge("x", got, got.x, x * Real(kPicture.width), size());
    judge("y", got, got.y, (Real(1) - y) * Real(kPicture.height), size());
  }

  /// Certain is the nearest double.
  static void judge(const char* what, const ScreenPoint& got, double value, const Real& truth, double size) {
    CAPTURE(what, value, double(truth), ulps(value, truth));
    if (got.certain)
      REQUIRE(value == double(truth));
    else
      REQUIRE(isExact(value, truth, size));
  }

  const TrueReading& truth_;
  const Camera& c_;
};

/// A point at these distances along the camera's axes, nearly.
Vec3 pointAt(const Camera& c, double x, double y, double w) {
  Vec3 p;
  const Axes& a = parts(c).pose.columns;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = parts(c).pose.eye[i] + (a.right[i].hi * x + a.up[i].hi * y + a.forward[i].hi * w);
  return p;
}

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

/// A matrix of this kind: as written, a multiple of it, or with each entry a little off.
Numbers randomNumbers(Random& random, MatrixKind kind, int variant, EntryPrecision precision) {
  Scene scene = randomScene(random, random.spread(1e-3, precision == EntryPrecision::float32 ? 1e3 : 1e9));
  scene.hasCrop = false;
  const Camera camera = build(scene);
  const auto presets = conventionPresets();
  Convention convention = presets[static_cast<std::size_t>(random.uniform(0, double(presets.size())))].convention;
  convention.world = scene.convention.world;
  Mat4 m = laidOut(write(kind, camera, convention), convention);
  const double scale = variant == 1 ? random.spread(1e-3, 1e3) : 1;
  for (auto& row : m.m)
    for (double& entry : row) {
      entry *= scale;
      if (variant == 2 && entry != 1) entry *= 1 + random.uniform(-1e-9, 1e-9);
      if (precision == EntryPrecision::float32) entry = static_cast<double>(static_cast<float>(entry));
    }
  return rowsOf(m);
}

Camera cameraOf(const Reading& r) {
  const CameraAxes axes = r.convention.view == ViewAxes::RUB   ? CameraAxes::RUB
                          : r.convention.view == ViewAxes::RUF ? CameraAxes::RUF
                                                               : CameraAxes::RDF;
  Convention convention = r.convention;
  if (!r.pose) convention.world = axes == CameraAxes::RUF ? Handedness::left : Handedness::right;
  const Mat4 identity{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
  const Pose pose = r.pose ? *r.pose : poseFromCameraFromWorld(identity, axes, convention.world);
  const Projection lens = r.projection ? *r.projection : perspectiveWindow(-0.75, 1, -0.5, 0.5, 0.125, 1000);
  return makeCamera(pose, lens, kPicture, convention);
}

}  // namespace

TEST_CASE("The camera of a matrix that was read is exact for its sixteen numbers, or does not call itself certain") {
  std::map<std::pair<MatrixKind, bool>, Tally> tallies;
  int scaled = 0, off = 0, undetermined = 0;
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    Random random(trial);
    const MatrixKind kind = kKinds[trial % 4];
    const int variant = int(trial / 4 % 3);
    const EntryPrecision precision = trial % 7 == 0 ? EntryPrecision::float32 : EntryPrecision::float64;
    const Numbers numbers = randomNumbers(random, kind, variant, precision);
    for (const Reading& r : inspectMatrix(numbers, precision).readings) {
      if (r.kind != kind) continue;
      if (r.projection && !(parts(*r.projection).near < parts(*r.projection).far)) {
        ++undetermined;
        continue;
      }
      if (r.projection && !parts(*r.projection).orthographic && !(parts(*r.projection).near > 0)) continue;
      INFO("trial " << trial << ", kind " << int(kind) << ", variant " << variant << ", float32 "
                    << (precision == EntryPrecision::float32));
      const Camera camera = cameraOf(r);
      CAPTURE(r.scale, parts(camera).projection.near, parts(camera).projection.far);
      CAPTURE(parts(camera).projection.left.hi, parts(camera).projection.right.hi, parts(camera).projection.bottom.hi,
              parts(camera).projection.top.hi);
      const TrueReading truth(matrixOf(numbers, r), r);
      const Judge judge(truth, camera);
      Tally& tally = tallies[{kind, parts(camera).projection.orthographic}];
      scaled += r.scale != 1;
      off += variant == 2;
      const ProjectionParts& lens = parts(camera).projection;
      const double from = std::max(lens.near, -1e6), to = std::min(lens.far, 1e6 * std::max(1.0, std::fabs(from)));
      for (int i = 0; i < 12; ++i) {
        const double w = lens.orthographic ? random.uniform(std::min(from, to), std::max(from, to))
                                           : from * std::exp(random.uniform(-2, 8));
        const double wide = lens.orthographic ? 1 : w;
        const double x = wide * (lens.left.hi + (lens.right.hi - lens.left.hi) * random.uniform(-0.2, 1.2));
        const double y = wide * (lens.bottom.hi + (lens.top.hi - lens.bottom.hi) * random.uniform(-0.2, 1.2));
        const int before = tally.uncertain;
        judge.check(pointAt(camera, x, y, w), tally);
        ++tally.inView;
        tally.uncertainInView += tally.uncertain - before;
        // On the picture's borders, next to the eye plane, next to the eye, and behind it.
        judge.check(pointAt(camera, wide * lens.left.hi, y, w), tally);
        judge.check(pointAt(camera, x, wide * lens.top.hi, w), tally);
        judge.check(pointAt(camera, x, y, lens.orthographic ? lens.near : 0), tally);
        judge.check(pointAt(camera, x, y, -w), tally);
        const double ulps = maxAbs(parts(camera).pose.eye) * 0x1p-50;
        const Vec3 step = random.vector(ulps > 0 ? ulps : 1);
        judge.check(
            {parts(camera).pose.eye.x + step.x, parts(camera).pose.eye.y + step.y, parts(camera).pose.eye.z + step.z},
            tally);
      }
    }
  }
  CAPTURE(scaled, off, undetermined);
  CHECK(tallies.size() == 6);
  for (const auto& [of, tally] : tallies) {
    CAPTURE(int(of.first), of.second, tally.certain, tally.uncertain, tally.behind, tally.uncertainInView,
            tally.inView);
    CHECK(tally.certain > 1000);
    CHECK((of.second || tally.behind > 1000));
    CHECK(tally.uncertain > 200);
    CHECK(tally.uncertainInView < tally.inView / 50);
  }
  CHECK(scaled > 50);
  CHECK(off > 200);
}
