// Cameras of matrices, against matrices written here by the formulas of textbooks.

#include "viewproj/cameras_of.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "catch.hpp"
#include "parts.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;

namespace {

// What matrices are made of, in long double

using Real = long double;
using Real3 = std::array<Real, 3>;
using RealMat = std::array<std::array<Real, 4>, 4>;

Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real3 cross(const Real3& a, const Real3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real3 unit(const Real3& a) {
  const Real length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

struct Truth {
  Real3 eye, right, up, forward;
  bool orthographic = false;
  Real left = 0, rightEdge = 0, bottom = 0, top = 0;  // tangents, or lengths
  Real near = 0, far = 0;
};

/// gluLookAt and D3DXMatrixLookAtLH: the side is forward x up, or up x forward where the world is left-handed.
void look(Truth& t, const Real3& direction, const Real3& up, Handedness world) {
  t.forward = unit(direction);
  const Real3 side = world == Handedness::right ? cross(t.forward, up) : cross(up, t.forward);
  t.right = unit(side);
  t.up = world == Handedness::right ? cross(t.right, t.forward) : cross(t.forward, t.right);
}

RealMat times(const RealMat& a, const RealMat& b) {
  RealMat m{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) m[i][j] += a[i][k] * b[k][j];
  return m;
}

struct Signs {
  Real up, forward;
};
Signs signsOf(ViewAxes view) { return {view == ViewAxes::RDF ? -1.0L : 1.0L, view == ViewAxes::RUB ? -1.0L : 1.0L}; }

RealMat viewOf(const Truth& t, ViewAxes view) {
  const auto [up, forward] = signsOf(view);
  RealMat m{};
  for (std::size_t j = 0; j < 3; ++j) {
    m[0][j] = t.right[j];
    m[1][j] = up * t.up[j];
    m[2][j] = forward * t.forward[j];
  }
  m[0][3] = -dot(t.right, t.eye);
  m[1][3] = -up * dot(t.up, t.eye);
  m[2][3] = -forward * dot(t.forward, t.eye);
  m[3][3] = 1;
  return m;
}

RealMat poseOf(const Truth& t, ViewAxes view) {
  const auto [up, forward] = signsOf(view);
  RealMat m{};
  for (std::size_t i = 0; i < 3; ++i) m[i] = {t.right[i], up * t.up[i], forward * t.forward[i], t.eye[i]};
  m[3][3] = 1;
  return m;
}

/// glFrustum, glOrtho and their Direct3D twins. With z the distance along forward, clip z is A z + B.
RealMat projectionOf(const Truth& t, const Convention& c) {
  const auto [up, forward] = signsOf(c.view);
  const Real n = t.near, f = t.far, y = c.ndcY == NdcY::up ? 1 : -1, range = f - n;
  const bool half = c.ndcZ == NdcZ::zeroToOne, isInfinite = std::isinf(f);
  Real a = 0, b = 0;  // z_ndc = A + B / z, or A z + B where it is orthographic
  if (t.orthographic) {
    a = (half ? 1 : 2) / range;
    b = half ? -n / range : -(f + n) / range;
    if (c.reverseZ) {
      a = -a;
      b = half ? f / range : -b;
    }
  } else if (!c.reverseZ) {
    a = isInfinite ? 1 : half ? f / range : (f + n) / range;
    b = isInfinite ? (half ? -n : -2 * n) : (half ? -f * n / range : -2 * f * n / range);
  } else {
    a = isInfinite ? (half ? 0 : -1) : half ? -n / range : -(f + n) / range;
    b = isInfinite ? (half ? n : 2 * n) : (half ? f * n / range : 2 * f * n / range);
  }
  const Real width = t.rightEdge - t.left, height = t.top - t.bottom;
  const Real offsetX = -(t.rightEdge + t.left) / width, offsetY = -y * (t.top + t.bottom) / height;
  RealMat m{};
  m[0][0] = 2 / width;
  m[1][1] = y * up * 2 / height;
  const std::size_t offset = t.orthographic ? 3 : 2;  // the column of the window's offsets
  m[0][offset] = t.orthographic ? offsetX : forward * offsetX;
  m[1][offset] = t.orthographic ? offsetY : forward * offsetY;
  m[2][2] = forward * a;
  m[2][3] = b;
  m[3][t.orthographic ? 3 : 2] = t.orthographic ? 1 : forward;
  return m;
}

RealMat write(MatrixKind kind, const Truth& t, const Convention& c) {
  switch (kind) {
    case MatrixKind::projection:
      return projectionOf(t, c);
    case MatrixKind::view:
      return viewOf(t, c.view);
    case MatrixKind::worldFromView:
      return poseOf(t, c.view);
    case MatrixKind::viewProjection:
      break;
  }
  return times(projectionOf(t, c), viewOf(t, c.view));
}

Mat4 rounded(const RealMat& a, bool asFloat = false) {
  Mat4 m;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      m[i][j] = asFloat ? static_cast<double>(static_cast<float>(a[i][j])) : static_cast<double>(a[i][j]);
  return m;
}

Mat4 multiplied(Mat4 m, double by) {
  for (auto& row : m.m)
    for (double& entry : row) entry *= by;
  return m;
}

/// The numbers as they lie in memory, written in rows of four.
Mat4 inMemory(const Mat4& m, const Convention& c) {
  return (c.vectors == Vectors::row) != (c.storage == Storage::columnMajor) ? transposed(m) : m;
}

Truth randomTruth(Random& random, Handedness world, double reach) {
  Truth t;
  for (Real& coordinate : t.eye) coordinate = reach * random.uniform(-1, 1);
  look(t, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, {0.1L, 1, 0.2L}, world);
  t.orthographic = random.oneIn(3);
  const Real height = random.logUniform(0.01, 10), aspect = random.logUniform(0.2, 5);
  const Real x = random.coin() ? 0 : random.uniform(-1, 1), y = random.coin() ? 0 : random.uniform(-1, 1);
  t.left = height * aspect * (x - 1);
  t.rightEdge = height * aspect * (x + 1);
  t.bottom = height * (y - 1);
  t.top = height * (y + 1);
  t.near = t.orthographic ? random.uniform(-50, 50) : random.logUniform(1e-3, 1e3);
  t.far = t.orthographic    ? t.near + random.logUniform(0.1, 1e4)
          : random.oneIn(3) ? HUGE_VALL
                            : t.near * random.logUniform(1.1, 1e6);
  return t;
}

bool holds(const PlaneDistance& e, Real number) {
  // Of the second order, and of what long double rounds here.
  const Real rest = std::isinf(number) ? 0 : 1e-6L * (Real{e.high} - Real{e.low}) + 1e-17L * std::fabs(number);
  return e.low <= number + rest && number - rest <= e.high;
}

bool isNear(double value, Real truth, Real size) { return std::fabs(value - truth) <= size; }

/// The same parameters, as far as the matrix tells them and the rounding of its entries leaves them.
void checkParameters(const MatrixCamera& camera, const Truth& t, const Convention& c, Real reach, Real rounding) {
  // An orthographic view-projection counts from the world's origin.
  const bool fromOrigin = t.orthographic && camera.kind == MatrixKind::viewProjection;
  const auto counted = [&](Real number, const Real3& axis) { return fromOrigin ? number + dot(axis, t.eye) : number; };
  if (camera.lens) {
    const MatrixLens& lens = *camera.lens;
    CHECK(lens.orthographic == t.orthographic);
    const Real size =
        rounding * 8 *
        (std::max({std::fabs(t.left), std::fabs(t.rightEdge), std::fabs(t.bottom), std::fabs(t.top)}) *
             std::max(t.rightEdge - t.left, t.top - t.bottom) / std::min(t.rightEdge - t.left, t.top - t.bottom) * 8 +
         (fromOrigin ? reach : 0));
    CHECK(isNear(lens.left, counted(t.left, t.right), size));
    CHECK(isNear(lens.right, counted(t.rightEdge, t.right), size));
    CHECK(isNear(lens.bottom, counted(t.bottom, t.up), size));
    CHECK(isNear(lens.top, counted(t.top, t.up), size));
    CHECK(holds(lens.zNear, counted(t.near, t.forward)));
    CHECK(holds(lens.zFar, std::isinf(t.far) ? t.far : counted(t.far, t.forward)));
    if (lens.projection) {
      CHECK(lens.projection->left() == lens.left);
      CHECK(lens.projection->top() == lens.top);
      CHECK(lens.projection->zNear() == lens.zNear.value);
      CHECK(lens.projection->zFar() == lens.zFar.value);
    }
  }
  CHECK(camera.pose.has_value() == (camera.kind != MatrixKind::projection));
  if (!camera.pose) return;
  CHECK(camera.convention.world == c.world);
  const Vec3 axes[] = {camera.pose->right(), camera.pose->up(), camera.pose->forward()};
  const Real3* const truths[] = {&t.right, &t.up, &t.forward};
  // Of a window off the axis, rows of a view-projection are largely along the w row.
  const Real angle = camera.kind == MatrixKind::viewProjection ? 256 * rounding : 4 * rounding;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t i = 0; i < 3; ++i) CHECK(isNear(axes[a][i], (*truths[a])[i], angle));
  if (!fromOrigin)
    for (std::size_t i = 0; i < 3; ++i) CHECK(isNear(camera.pose->eye()[i], t.eye[i], 4 * angle * (reach + 10)));
}

constexpr MatrixKind kKinds[] = {MatrixKind::projection, MatrixKind::view, MatrixKind::worldFromView,
                                 MatrixKind::viewProjection};

MatrixCamera theOnly(const Mat4& m, const MatrixQuery& query) {
  const MatrixCameras found = camerasOf(m, query);
  INFO(found.fault);
  REQUIRE(found.cameras.size() == 1);
  return found.cameras.front();
}

/// The identity's axes, a square window and near 1.
Truth plain(double far) {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, false, -0.5L, 0.5L, -0.5L, 0.5L, 1, far};
}

}  // namespace

TEST_CASE("A matrix of any convention and kind gives back the one camera that it was written from") {
  std::map<std::string, int> tally;
  for (std::uint64_t trial = 0; trial < 60; ++trial)
    for (const ConventionPreset& named : conventionPresets())
      for (const bool reverseZ : {false, true}) {
        Random random(trial);
        Convention c = named.convention;
        c.reverseZ = reverseZ;
        if (random.oneIn(3)) c.ndcZ = c.ndcZ == NdcZ::zeroToOne ? NdcZ::minusOneToOne : NdcZ::zeroToOne;
        if (random.oneIn(3)) c.ndcY = c.ndcY == NdcY::up ? NdcY::down : NdcY::up;
        if (random.oneIn(3)) c.world = c.world == Handedness::right ? Handedness::left : Handedness::right;
        const bool asFloat = random.oneIn(4);
        const double reach = random.logUniform(0.1, asFloat ? 10 : 1e4), rounding = asFloat ? 0x1p-24 : 0x1p-53;
        const Truth t = randomTruth(random, c.world, reach);
        for (const MatrixKind kind : kKinds) {
          const bool isPose = kind == MatrixKind::view || kind == MatrixKind::worldFromView;
          const double scale = isPose || random.coin() ? 1 : 8;
          const Mat4 m = multiplied(rounded(write(kind, t, c), asFloat), scale);
          INFO("trial " << trial << " " << named.name << " kind " << int(kind) << " reversed " << reverseZ
                        << " float32 " << asFloat << " scale " << scale << " orthographic " << t.orthographic);
          const MatrixCamera camera = theOnly(m, {.kind = kind, .convention = c, .float32 = asFloat});
          checkParameters(camera, t, c, reach, rounding);
          CHECK(camera.scale == Approx(scale).epsilon(asFloat ? 1e-6 : 1e-15));
          CHECK((!camera.lens || camera.lens->projection));
          // Among all that its numbers can be, there is that one.
          const Mat4 numbers = inMemory(m, c);
          std::size_t same = 0;
          for (const MatrixCamera& other : camerasOf(numbers, {.float32 = asFloat}).cameras) {
            const Convention& own = other.convention;
            const bool isTurned = !(numbers == m);
            if (other.kind != kind || other.layout != (isTurned ? MatrixLayout::transposed : MatrixLayout::asWritten))
              continue;
            if (kind != MatrixKind::projection && own.world != c.world) continue;
            if (kind != MatrixKind::viewProjection && own.view != c.view) continue;
            if (!isPose && !(own.ndcZ == c.ndcZ && own.reverseZ == c.reverseZ && own.ndcY == c.ndcY)) continue;
            ++same;
            if (other.lens) {
              CHECK(other.lens->left == camera.lens->left);
              CHECK(other.lens->zFar.value == camera.lens->zFar.value);
            }
          }
          CHECK(same == 1);
          tally[t.orthographic ? "orthographic" : std::isinf(t.far) ? "infinite" : "perspective"] += !isPose;
          tally["scaled"] += scale != 1;
          tally["float32"] += asFloat;
        }
      }
  for (const char* name : {"orthographic", "infinite", "perspective", "scaled", "float32"}) {
    INFO(name);
    CHECK(tally[name] > 200);
  }
}

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
      Truth t = plain(row.far);
      t.near = row.near;
      t.eye = {3, 2, 5};
      look(t, {-4, -1.5L, -4.75L}, {0, 1, 0}, world);
      const std::vector<MatrixCamera> cameras = camerasOf(rounded(write(MatrixKind::viewProjection, t, c))).cameras;
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
    Truth t = randomTruth(random, c.world, 9);
    t.far = t.orthographic ? t.near + random.logUniform(1, 1e3) : t.near * random.logUniform(2, 1e3);
    for (const MatrixKind kind : {MatrixKind::projection, MatrixKind::viewProjection}) {
      // Of a multiple, the w row counts too.
      const bool isMultiple = trial % 4 == 0,
                 hasExactW = !isMultiple && (kind == MatrixKind::projection || t.orthographic);
      Mat4 m = rounded(write(kind, t, c), true);
      if (isMultiple)
        for (auto& row : m.m)
          for (double& entry : row) entry = static_cast<double>(static_cast<float>(3 * entry));
      const auto ends = [&](const Mat4& matrix, bool float32) {
        const MatrixLens lens = *theOnly(matrix, {.kind = kind, .convention = c, .float32 = float32}).lens;
        return std::array<PlaneDistance, 2>{lens.zNear, lens.zFar};
      };
      const std::array<PlaneDistance, 2> whole = ends(m, true);
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
          const double off = std::fabs(there[k].value - (whole[k].low + half));
          INFO("trial " << trial << " kind " << int(kind) << " parameter " << k);
          CHECK(off <= half * (1 + 1e-3));
          reached[k] = std::max(reached[k], off / half);
        }
      }
      for (const double share : reached) {
        INFO("trial " << trial << " kind " << int(kind) << " orthographic " << t.orthographic);
        // A projection's parameter hangs on two or three entries, so that some sample takes all to their ends.
        CHECK(share > (kind == MatrixKind::projection && !isMultiple ? 0.99 : 0.2));
        ++checked;
      }
    }
  }
  CHECK(checked == 100);
}

TEST_CASE("A forward matrix of doubles does not determine a far plane 1e15 or 1e17 times as far as near") {
  for (const NdcZ ndcZ : {NdcZ::minusOneToOne, NdcZ::zeroToOne}) {
    Convention c;
    c.ndcZ = ndcZ;
    const auto entryOf = [&](double far) { return rounded(write(MatrixKind::projection, plain(far), c))[2][2]; };
    const auto farOf = [&](double far) {
      return theOnly(rounded(write(MatrixKind::projection, plain(far), c)),
                     {.kind = MatrixKind::projection, .convention = c})
          .lens->zFar;
    };
    const PlaneDistance hardly = farOf(1e15);
    CHECK(holds(hardly, 1e15L));
    CHECK(hardly.high / hardly.low > 1.1);
    CHECK(hardly.high / hardly.low < 1.4);
    const PlaneDistance none = farOf(1e17);
    CHECK(none.value == HUGE_VAL);
    CHECK(none.high == HUGE_VAL);
    CHECK(none.low > 4e15);
    CHECK(none.low < 2e16);
    // Any far within the interval is written as the same matrix, and one outside is not.
    CHECK(entryOf(hardly.low * (1 + 4e-3)) == entryOf(1e15));
    CHECK(entryOf(hardly.high * (1 - 4e-3)) == entryOf(1e15));
    CHECK(entryOf(hardly.low * (1 - 4e-3)) != entryOf(1e15));
    CHECK(entryOf(hardly.high * (1 + 4e-3)) != entryOf(1e15));
    CHECK(entryOf(none.low * (1 + 4e-3)) == entryOf(1e17));
    CHECK(entryOf(none.low * (1 - 4e-3)) != entryOf(1e17));
  }
  Convention reversed;
  reversed.ndcZ = NdcZ::zeroToOne;
  reversed.reverseZ = true;
  const MatrixCameras found = camerasOf(rounded(write(MatrixKind::projection, plain(1e15), reversed)));
  REQUIRE(found.cameras.size() == 1);
  CHECK(found.cameras[0].lens->zFar.value == Approx(1e15).epsilon(1e-15));
  CHECK(found.cameras[0].lens->zFar.high / found.cameras[0].lens->zFar.low < 1 + 1e-15);
}

TEST_CASE("near keeps the digits that the matrix has, at any size and any ratio") {
  for (const double near : {1e-80, 1e-12, 0.1, 1e30})
    for (const double ratio : {1.0000001, 2.0, 1e6, 1e15})
      for (const ConventionPreset& named : conventionPresets()) {
        Truth t = plain(near * ratio);
        t.near = near;
        const Convention& c = named.convention;
        const Mat4 m = rounded(write(MatrixKind::projection, t, c));
        INFO(named.name << " " << near << " " << ratio);
        const PlaneDistance n = theOnly(m, {.kind = MatrixKind::projection, .convention = c}).lens->zNear;
        CHECK(n.low <= near);
        CHECK(near <= n.high);
        // near = B / (D - A): the two relative half ulps and no more, D - A cancels only where far is next to near.
        CHECK(n.high - n.low <= near * 0x1p-50 * (ratio < 2 ? 1e7 : 1));
      }
}

TEST_CASE("The identity is a view, a pose and a projection, and every reading of it is listed") {
  const Mat4 identity{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
  std::map<MatrixKind, int> kinds;
  for (const MatrixCamera& camera : camerasOf(identity).cameras) {
    ++kinds[camera.kind];
    CHECK(camera.layout == MatrixLayout::either);
  }
  CHECK(kinds ==
        std::map<MatrixKind, int>{{MatrixKind::projection, 6}, {MatrixKind::view, 3}, {MatrixKind::worldFromView, 3}});
  // Of a window 2 wide and 2 high it is the product too, where that is what it is said to be.
  CHECK(camerasOf(identity, {.kind = MatrixKind::viewProjection}).cameras.size() == 8);
}

TEST_CASE("The product of a camera at the origin is a projection, and a view-projection where that is asked for") {
  const Convention c = conventions::opengl;
  const Mat4 m = rounded(write(MatrixKind::viewProjection, plain(9), c));
  for (const MatrixCamera& camera : camerasOf(m).cameras) CHECK(camera.kind == MatrixKind::projection);
  const MatrixCamera camera = theOnly(m, {.kind = MatrixKind::viewProjection, .convention = c});
  CHECK(camera.pose->eye() == Vec3{0, 0, 0});
  CHECK(camera.pose->forward() == Vec3{0, 0, -1});
  CHECK(camera.lens->zFar.value == Approx(9).epsilon(1e-15));
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
        const Mat4 again = camera.kind == MatrixKind::view ? viewFromWorld(*camera.pose, camera.convention)
                                                           : worldFromView(*camera.pose, camera.convention);
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 4; ++j) CHECK(again[i][j] == static_cast<double>(Real{m[i][j]} / last));
      }
      CHECK(poses == (steps < -4 || steps > 4 ? 0 : 6));
    }
  // Of float32s it is their units that count.
  const Mat4 m{{{{0, 0, 1, 3}, {0, 1, 0, 4}, {-1, 0, 0, 5}, {0, 0, 0, 1 - 2 * 0x1p-23}}}};
  CHECK(camerasOf(m, {.float32 = true}).cameras.front().kind == MatrixKind::view);
  CHECK(camerasOf(m).cameras.front().kind != MatrixKind::view);
}

TEST_CASE("An infinite 0..1 projection with near 1 is symmetric, so that it does not tell its layout") {
  const MatrixCameras found = camerasOf(rounded(write(MatrixKind::projection, plain(HUGE_VAL), conventions::metal)));
  for (const MatrixCamera& camera : found.cameras) CHECK(camera.layout == MatrixLayout::either);
  CHECK(found.cameras.size() == 2);
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
  // A near of 1e-9 seen from 1e6 away, in float32s.
  Truth t = plain(10);
  t.near = 1e-9L;
  t.eye = {1e6L, 2e6L, 3e6L};
  look(t, {-1, -2, -2}, {0, 1, 0}, Handedness::right);
  const Mat4 m = rounded(write(MatrixKind::viewProjection, t, {}), true);
  const MatrixCameras found = camerasOf(m, {.kind = MatrixKind::viewProjection, .float32 = true});
  REQUIRE(!found.cameras.empty());
  for (const MatrixCamera& camera : found.cameras) {
    CHECK(camera.lens->zNear.low == 0);
    CHECK(camera.lens->zNear.high > 1e-9);
    CHECK(camera.lens->right == Approx(0.5).epsilon(1e-6));
    CHECK(camera.lens->projection.has_value() == (camera.lens->zNear.value > 0));
  }
  const Mat4 none{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, -5e-324}, {0, 0, -1, 0}}}};
  CHECK_FALSE(camerasOf(none, {.kind = MatrixKind::projection}).cameras.empty());
  CHECK(camerasOf(none, {.kind = MatrixKind::projection, .convention = conventions::opengl}).fault ==
        "it does not determine near and far");
}

TEST_CASE("What no camera has written is told with its fault") {
  const auto fault = [](const std::array<double, 16>& n, const MatrixQuery& query = {}) {
    const MatrixCameras found = camerasOf(fromStorageOrder(n, conventions::opencv), query);
    CHECK(found.cameras.empty());
    return found.fault;
  };
  const auto has = [](const std::string& text, const char* word) { return text.find(word) != std::string::npos; };
  CHECK(has(fault({}), "w row is 0 0 0 0"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2}), "w row is 0 0 0 -2"));
  CHECK(has(fault({1, 0.5, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "right angles"));
  CHECK(has(fault({1, 0, 0, 3, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "flattens"));
  for (const double n : {7.0, 1.1, 1e-3}) {
    CHECK(has(fault({n, n, n, n, n, n, n, n, n, n, n, n, n, n, n, n}), "across the picture"));
    CHECK(has(fault({1, 0, 0, 0, n, n, n, n, 0, 0, 1, 0, n, n, n, n}), "across the picture"));
  }
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0.2, 0.1, -1, -0.5, 0, 0, -1, 0}), "oblique"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.5, 100, 0, 0, -1, 0}), "viewport"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, NAN, 0, 0, -1, 0}), "finite"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1.1e90, 0, 0, -1, 0}), "1e90"));
  CHECK(has(fault({1, 0, 0, 0, 0, 1, 0, 1e90, 0, 1e90, 1, 0, 0, 0, 1, 1}), "right angles"));
  // With a convention: which of its axes are others, and whether it is the transpose that fits.
  const Truth t = plain(9);
  const Mat4 m = rounded(write(MatrixKind::projection, t, conventions::d3d));
  const MatrixQuery asOpenGl{.kind = MatrixKind::projection, .convention = conventions::opengl};
  CHECK(camerasOf(m, asOpenGl).fault == "it is of a convention with another view");
  CHECK(camerasOf(rounded(write(MatrixKind::projection, t, conventions::unreal)), asOpenGl).fault ==
        "it is of a convention with another view, ndcZ, reverseZ");
  CHECK(has(camerasOf(transposed(m), {.kind = MatrixKind::projection, .convention = conventions::d3d}).fault,
            "; its transpose fits"));
  CHECK(camerasOf(m, {.kind = MatrixKind::view}).fault == "it is of another kind");
}
