// Written matrices, entry by entry, against products and inverses in 480 bits.
#include <cstdlib>

#include "camera/depth.hpp"
#include "catch.hpp"
#include "internals.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

using Real4x4 = std::array<std::array<Real, 4>, 4>;

Real4x4 product(const Real4x4& a, const Real4x4& b) {
  Real4x4 r;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + a[i][3] * b[3][j];
  return r;
}

Real4x4 magnitudes(Real4x4 a) {
  for (auto& row : a)
    for (Real& entry : row) entry = abs(entry);
  return a;
}

/// By Gauss and Jordan. What 480 bits leave of a zero counts as 0.
Real4x4 inverse(Real4x4 a) {
  Real4x4 r;
  for (std::size_t i = 0; i < 4; ++i) r[i][i] = Real(1);
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i)
      if (abs(a[i][k]) > abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(r[k], r[pivot]);
    const Real scale = Real(1) / a[k][k];
    for (std::size_t j = 0; j < 4; ++j) a[k][j] = a[k][j] * scale, r[k][j] = r[k][j] * scale;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == k) continue;
      const Real share = a[i][k];
      for (std::size_t j = 0; j < 4; ++j) a[i][j] = a[i][j] - share * a[k][j], r[i][j] = r[i][j] - share * r[k][j];
    }
  }
  Real largest = 0;
  for (const auto& row : r)
    for (const Real& entry : row) largest = abs(entry) > largest ? abs(entry) : largest;
  for (auto& row : r)
    for (Real& entry : row)
      if (abs(entry) < largest * Real(0x1p-300)) entry = 0;
  return r;
}

Real4x4 diagonal(const Real& x, const Real& y, const Real& z) { return {{{x}, {0, y}, {0, 0, z}, {0, 0, 0, Real(1)}}}; }

/// World to distances along right, up and forward.
Real4x4 axesFromWorld(const TruePose& p) {
  const auto row = [&](const Real3& axis) { return std::array<Real, 4>{axis[0], axis[1], axis[2], -dot(axis, p.eye)}; };
  return {{row(p.right), row(p.up), row(p.forward), {0, 0, 0, Real(1)}}};
}

/// Distances along right, up and forward to clip space with y up.
Real4x4 clipFromAxes(const Scene& s, const TrueLens& l, const DepthEnds& z) {
  const Real width = l.right - l.left, height = l.top - l.bottom;
  const Real x = Real(2) / width, y = Real(2) / height;
  const Real offX = -(l.right + l.left) / width, offY = -(l.top + l.bottom) / height;
  const Real near = s.near, atNear = z.atNear, atFar = z.atFar;
  if (l.orthographic) {
    const Real slope = (atFar - atNear) / (Real(s.far) - near);
    return {{{x, 0, 0, offX}, {0, y, 0, offY}, {0, 0, slope, atNear - near * slope}, {0, 0, 0, Real(1)}}};
  }
  const bool infinite = std::isinf(s.far);
  const Real a = infinite ? atFar : (atFar * Real(s.far) - atNear * near) / (Real(s.far) - near);
  const Real b = infinite ? near * (atNear - atFar) : Real(s.far) * near * (atNear - atFar) / (Real(s.far) - near);
  return {{{x, 0, offX, 0}, {0, y, offY, 0}, {0, 0, a, b}, {0, 0, Real(1), 0}}};
}

/// The double nearest the true entry, or within 1e-26 of the terms that it is the sum of.
void checkEntries(const char* name, const Mat4& got, const Real4x4& truth, const Real4x4& terms) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      if (!isExact(got[i][j], truth[i][j], double(terms[i][j])))
        FAIL_CHECK(name << ": row " << i + 1 << ", column " << j + 1 << ": " << got[i][j] << " for "
                        << double(truth[i][j]));
}

/// A model near the eye, of any shape, its axes not quite in a plane at times.
Mat4 randomModel(Random& random, const Scene& scene) {
  Mat4 m;
  const double size = random.logUniform(1e-6, 1e6), flat = random.chance(0.3) ? 1e-9 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 2; ++j) m[i][j] = size * random.uniform(-1, 1);
    m[i][2] = m[i][0] - m[i][1] + flat * size * random.uniform(-1, 1);
    m[i][3] = scene.position[i] + size * random.uniform(-1, 1);
  }
  m[3][3] = 1;
  return m;
}

}  // namespace

TEST_CASE("Every entry of a matrix and of its inverse is the double nearest the true one") {
  const char* const count = std::getenv("VIEWPROJ_MATRIX_CAMERAS");
  const std::uint64_t cameras = count ? std::strtoull(count, nullptr, 10) : 4000;
  int orthographic = 0, infinite = 0, offCentre = 0, reversed = 0;
  for (std::uint64_t trial = 0; trial < cameras; ++trial) {
    Random random(trial + 70000000);
    Scene scene = randomScene(random, random.logUniform(1e-3, 1e9));
    scene.shiftX = scene.shiftY = 0;
    scene.hasCrop = false;
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Convention& c = scene.convention;
    const DepthEnds ends = ndcDepths(c);
    const AxisSigns sign = axisSigns(c.view);
    INFO("trial " << trial << ": " << describe(scene));

    const Real4x4 toViewAxes = diagonal(Real(1), sign.up, sign.forward);  // its own inverse
    const Real4x4 ndcY = diagonal(Real(1), c.ndcY == NdcY::up ? 1 : -1, Real(1));
    const Real4x4 view = product(toViewAxes, axesFromWorld(truth.pose));
    const Real4x4 clip = product(product(ndcY, clipFromAxes(scene, truth.lens, ends)), toViewAxes);
    const Real4x4 viewInverse = inverse(view), clipInverse = inverse(clip);

    // The translation is the sum of three products.
    Real4x4 viewTerms = magnitudes(view);
    for (std::size_t i = 0; i < 3; ++i)
      viewTerms[i][3] = viewTerms[i][3] + abs(view[i][0] * truth.pose.eye[0]) + abs(view[i][1] * truth.pose.eye[1]) +
                        abs(view[i][2] * truth.pose.eye[2]) + length(truth.pose.eye);
    checkEntries("view", matrix(camera, Space::view, Space::world), view, viewTerms);
    checkEntries("viewInverse", matrix(camera, Space::world, Space::view), viewInverse, magnitudes(viewInverse));
    checkEntries("projection", matrix(camera, Space::clip, Space::view), clip, magnitudes(clip));
    checkEntries("projectionInverse", matrix(camera, Space::view, Space::clip), clipInverse, magnitudes(clipInverse));
    checkEntries("viewProjection", matrix(camera, Space::clip, Space::world), product(clip, view),
                 product(magnitudes(clip), viewTerms));
    checkEntries("viewProjectionInverse", matrix(camera, Space::world, Space::clip), product(viewInverse, clipInverse),
                 product(magnitudes(viewInverse), magnitudes(clipInverse)));

    const Mat4 given = randomModel(random, scene);
    Real4x4 model{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) model[i][j] = given[i][j];
    const Real4x4 modelInverse = inverse(model);
    Real4x4 inverseTerms = magnitudes(modelInverse);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        inverseTerms[i][3] = inverseTerms[i][3] + abs(modelInverse[i][j] * model[j][3]);
    const Real4x4 modelTerms = product(viewTerms, magnitudes(model));
    checkEntries("modelView", matrix(camera, Space::view, Space::model, given), product(view, model), modelTerms);
    checkEntries("modelViewInverse", matrix(camera, Space::model, Space::view, given),
                 product(modelInverse, viewInverse), product(inverseTerms, magnitudes(viewInverse)));
    checkEntries("modelViewProjection", matrix(camera, Space::clip, Space::model, given),
                 product(clip, product(view, model)), product(magnitudes(clip), modelTerms));
    checkEntries("modelViewProjectionInverse", matrix(camera, Space::model, Space::clip, given),
                 product(product(modelInverse, viewInverse), clipInverse),
                 product(product(inverseTerms, magnitudes(viewInverse)), magnitudes(clipInverse)));

    orthographic += truth.lens.orthographic;
    infinite += std::isinf(scene.far);
    offCentre += scene.lensKind == LensKind::frustum;
    reversed += c.reverseZ;
  }
  INFO(orthographic << " orthographic, " << infinite << " infinite, " << offCentre << " off-centre, " << reversed
                    << " reversed");
  CHECK(orthographic > 200);
  CHECK(infinite > 200);
  CHECK(offCentre > 200);
  CHECK(reversed > 200);
}

TEST_CASE(
    "The translation into view space is the nearest double, of an origin or a model that the view passes closely") {
  double worst = 0, lost = 0;  // lost: of its terms, what is left
  for (std::uint64_t trial = 0; trial < 4000; ++trial) {
    Random random(trial + 71000000);
    Scene scene = randomScene(random, random.logUniform(1, 1e9));
    scene.shiftX = scene.shiftY = 0;
    scene.hasCrop = false;
    Mat4 model = randomModel(random, scene);
    if (trial % 2) {  // the world's origin next to the viewing axis
      scene.poseKind = PoseKind::target;
      scene.target = random.vector(random.logUniform(1e-12, 1));
      for (std::size_t i = 0; i < 3; ++i) model[i][3] = scene.target[i];
    } else {  // the model's origin within a few last places of the eye
      for (std::size_t i = 0; i < 3; ++i) {
        model[i][3] = scene.position[i];
        for (int steps = int(random.uniform(0, 5)); steps > 0; --steps)
          model[i][3] = std::nextafter(model[i][3], random.sign() * INFINITY);
      }
    }
    const Truth truth(scene);
    const Camera camera = build(scene);
    const Convention& c = scene.convention;
    const AxisSigns sign = axisSigns(c.view);
    const Mat4 view = matrix(camera, Space::view, Space::world);
    const Mat4 modelView = matrix(camera, Space::view, Space::model, model);
    const auto check = [&](const Mat4& got, const Vec3& origin) {
      const Truth::View v = truth.view(toReal(origin));
      const Real want[] = {v.right, v.up * Real(sign.up), v.forward * Real(sign.forward)};
      for (std::size_t i = 0; i < 3; ++i) {
        INFO("trial " << trial << ", row " << i << ": " << describe(scene));
        const double size = double(length(toReal(origin) - truth.pose.eye)) + maxAbs(scene.position);
        if (abs(want[i]) < Real(size * 1e-100)) {  // 0, and what 480 bits leave of it
          REQUIRE(std::fabs(got[i][3]) < size * 1e-100);
          continue;
        }
        worst = std::max(worst, ulps(got[i][3], want[i]));
        REQUIRE(ulps(got[i][3], want[i]) <= 0.5 + 0x1p-30);
        lost = std::max(lost, size / std::fabs(got[i][3]));
      }
    };
    check(view, {0, 0, 0});
    check(modelView, {model[0][3], model[1][3], model[2][3]});
  }
  CAPTURE(worst, lost);
  CHECK(lost > 1e14);
}
