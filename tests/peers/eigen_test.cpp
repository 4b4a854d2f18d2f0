// The whole chain in Eigen's doubles, built from the textbook's formulas, against the matrices written in closed form.
//
// Tolerances are counts of roundings of 2^-53 of the terms that are rounded. An entry of ours is rounded once, so the
// product of a matrix and its inverse is off by at most |M| |M^-1| times two roundings and the product's own four.
#include <Eigen/Dense>

#include "catch.hpp"
#include "internals.hpp"
#include "measure.hpp"
#include "random_cameras.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace peers;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

constexpr std::uint64_t kTrials = 150;  // times every convention

Matrix4d toEigen(const Mat4& m) {
  Matrix4d e;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) e(i, j) = m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return e;
}

Vector3d toEigen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vector4d homogeneous(const Vec3& v) { return {v.x, v.y, v.z, 1}; }

void seeEntries(Worst& worst, std::uint64_t trial, const Matrix4d& difference, const Matrix4d& bound) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) worst.see(trial, difference(i, j), bound(i, j));
}

/// | right    -right . eye   |
/// | up       -up . eye      |     with the signs of the convention's view axes
/// | forward  -forward . eye |
/// | 0        1              |
Matrix4d eigenView(const View& v, const Convention& c) {
  const Vector3d eye = toEigen(v.eye);
  const Vector3d forward = (toEigen(v.target) - eye).normalized();
  Vector3d right = forward.cross(toEigen(v.up)).normalized();
  const Vector3d up = right.cross(forward);
  if (c.world == Handedness::left) right = -right;
  Matrix4d m = Matrix4d::Identity();
  m.block<1, 3>(0, 0) = right.transpose();
  m.block<1, 3>(1, 0) = up.transpose() * (c.view == ViewAxes::RDF ? -1 : 1);
  m.block<1, 3>(2, 0) = forward.transpose() * (c.view == ViewAxes::RUB ? -1 : 1);
  m.block<3, 1>(0, 3) = -(m.block<3, 3>(0, 0) * eye);
  return m;
}

/// Depth = a z + b over z in perspective, a z + b in orthographic, for z along the viewing axis.
struct DepthTerms {
  double a, b;
};

DepthTerms depthTerms(const Window& w, NdcZ range, bool reversed) {
  const double n = w.near, f = w.far;
  const bool zeroToOne = range == NdcZ::zeroToOne;
  if (w.orthographic) {
    if (zeroToOne) return reversed ? DepthTerms{-1 / (f - n), f / (f - n)} : DepthTerms{1 / (f - n), -n / (f - n)};
    return reversed ? DepthTerms{-2 / (f - n), (f + n) / (f - n)} : DepthTerms{2 / (f - n), -(f + n) / (f - n)};
  }
  if (std::isinf(f)) {
    if (zeroToOne) return reversed ? DepthTerms{0, n} : DepthTerms{1, -n};
    return reversed ? DepthTerms{-1, 2 * n} : DepthTerms{1, -2 * n};
  }
  if (zeroToOne)
    return reversed ? DepthTerms{-n / (f - n), f * n / (f - n)} : DepthTerms{f / (f - n), -f * n / (f - n)};
  return reversed ? DepthTerms{-(f + n) / (f - n), 2 * f * n / (f - n)}
                  : DepthTerms{(f + n) / (f - n), -2 * f * n / (f - n)};
}

Matrix4d eigenProjection(const Window& w, const Convention& c) {
  const double width = w.right - w.left, height = w.top - w.bottom;
  const DepthTerms depth = depthTerms(w, c.ndcZ, c.reverseZ);
  Matrix4d m = Matrix4d::Zero();
  if (w.orthographic) {
    m << 2 / width, 0, 0, -(w.right + w.left) / width,   //
        0, 2 / height, 0, -(w.top + w.bottom) / height,  //
        0, 0, depth.a, depth.b,                          //
        0, 0, 0, 1;
  } else {
    m << 2 * w.near / width, 0, -(w.right + w.left) / width, 0,   //
        0, 2 * w.near / height, -(w.top + w.bottom) / height, 0,  //
        0, 0, depth.a, depth.b,                                   //
        0, 0, 1, 0;
  }
  if (c.ndcY == NdcY::down) m.row(1) *= -1;
  if (c.view == ViewAxes::RDF) m.col(1) *= -1;
  if (c.view == ViewAxes::RUB) m.col(2) *= -1;
  return m;
}

Matrix4d eigenViewport(const Viewport& v, const Convention& c) {
  const double x = v.x + v.pixelCenter - 0.5, y = v.y + v.pixelCenter - 0.5;
  const bool screenRunsAsNdc = (v.origin == Origin::topLeft) == (c.ndcY == NdcY::down);
  const double range = v.depthSecond - v.depthFirst;
  const bool zeroToOne = c.ndcZ == NdcZ::zeroToOne;
  Matrix4d m;
  m << v.width / 2, 0, 0, x + v.width / 2,                                              //
      0, (screenRunsAsNdc ? v.height : -v.height) / 2, 0, y + v.height / 2,             //
      0, 0, zeroToOne ? range : range / 2, v.depthFirst + (zeroToOne ? 0 : range / 2),  //
      0, 0, 0, 1;
  return m;
}

/// Rounding errors of view coordinates, per unit of |point| + |eye|: about 50, enlarged where up is near the viewing
/// axis.
double viewError(const View& v) { return 64 / v.upSine * kRounding; }

/// What a point's clip coordinates, each off by a share of its terms, leave of screen x, y and depth.
void seeScreen(Worst& worst, std::uint64_t trial, const Matrix4d& screenFromNdc, const Vector4d& clip,
               const Vector4d& clipError, const ScreenPoint& ours) {
  const Vector4d ndc = clip / clip.w();
  const Vector4d screen = screenFromNdc * ndc;
  const Vector4d ndcError =
      (clipError + ndc.cwiseAbs() * clipError.w()) / (std::fabs(clip.w()) - clipError.w()) + ndc.cwiseAbs() * kRounding;
  const Vector4d bound = screenFromNdc.cwiseAbs() * Vector4d(ndcError.x(), ndcError.y(), ndcError.z(), 0) +
                         4 * kRounding * (screenFromNdc.cwiseAbs() * ndc.cwiseAbs());
  worst.see(trial, ours.x - screen.x(), bound.x());
  worst.see(trial, ours.y - screen.y(), bound.y());
  worst.see(trial, ours.depth - screen.z(), bound.z());
}

/// Calls see(trial, scene, pose, projection, convention) for random scenes in every convention.
template <class See>
void forRandomScenes(See see) {
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Scene scene = randomScene(random, tally);
    for (const Convention& c : everyConvention())
      see(trial, random, scene, poseOf(scene.view, c.world), projectionOf(scene.window), c);
  }
  CHECK_ALL_VISITED(tally);
}

}  // namespace

TEST_CASE("Eigen: the matrices of every preset are those of the textbook's formulas") {
  Worst view, projection, viewport, both;
  forRandomScenes(
      [&](std::uint64_t trial, Random&, const Scene& s, const Pose& pose, const Projection& p, const Convention& c) {
        const Matrix4d ourView = toEigen(viewFromWorld(pose, c)), theirView = eigenView(s.view, c);
        Matrix4d viewBound = Matrix4d::Constant(viewError(s.view));
        viewBound.col(3) *= sumOfSizes(s.view.eye);
        viewBound.row(3).setZero();
        seeEntries(view, trial, ourView - theirView, viewBound);

        const Matrix4d ourProjection = toEigen(clipFromView(p, c)), theirProjection = eigenProjection(s.window, c);
        Matrix4d projectionBound = 8 * kRounding * theirProjection.cwiseAbs();
        seeEntries(projection, trial, ourProjection - theirProjection, projectionBound);

        const Matrix4d theirViewport = eigenViewport(s.viewport, c);
        Matrix4d viewportBound = 4 * kRounding * theirViewport.cwiseAbs();
        // x + W/2 and min + range/2 may cancel.
        viewportBound.col(3) += 4 * kRounding * Vector4d(s.viewport.width, s.viewport.height, 4, 0);
        seeEntries(viewport, trial, toEigen(screenFromNdc(s.viewport, c)) - theirViewport, viewportBound);

        seeEntries(both, trial, toEigen(clipFromWorld(pose, p, c)) - theirProjection * theirView,
                   theirProjection.cwiseAbs() * viewBound + projectionBound * theirView.cwiseAbs() +
                       4 * kRounding * (theirProjection.cwiseAbs() * theirView.cwiseAbs()));
      });
  CHECK_WITHIN_BOUND(view);
  CHECK_WITHIN_BOUND(projection);
  CHECK_WITHIN_BOUND(viewport);
  CHECK_WITHIN_BOUND(both);
}

TEST_CASE("Eigen: in every preset a matrix times its closed-form inverse is the identity, from both sides") {
  Worst worst;
  const auto see = [&](std::uint64_t trial, const Mat4& matrix, const Mat4& inverse) {
    const Matrix4d a = toEigen(matrix), b = toEigen(inverse);
    const double roundings = 6 * kRounding;
    seeEntries(worst, trial, a * b - Matrix4d::Identity(), roundings * (a.cwiseAbs() * b.cwiseAbs()));
    seeEntries(worst, trial, b * a - Matrix4d::Identity(), roundings * (b.cwiseAbs() * a.cwiseAbs()));
  };
  forRandomScenes(
      [&](std::uint64_t trial, Random&, const Scene& s, const Pose& pose, const Projection& p, const Convention& c) {
        see(trial, viewFromWorld(pose, c), worldFromView(pose, c));
        see(trial, clipFromView(p, c), viewFromClip(p, c));
        see(trial, clipFromWorld(pose, p, c), worldFromClip(pose, p, c));
        see(trial, screenFromNdc(s.viewport, c), ndcFromScreen(s.viewport, c));
        see(trial, screenFromView(p, s.viewport, c), viewFromScreen(p, s.viewport, c));
        see(trial, screenFromWorld(pose, p, s.viewport, c), worldFromScreen(pose, p, s.viewport, c));
      });
  CHECK_WITHIN_BOUND(worst);
}

TEST_CASE("Eigen: the closed-form inverse is what the general inverse approaches") {
  Worst worst;
  forRandomScenes(
      [&](std::uint64_t trial, Random&, const Scene&, const Pose& pose, const Projection& p, const Convention& c) {
        const Matrix4d matrix = toEigen(clipFromWorld(pose, p, c)), ours = toEigen(worldFromClip(pose, p, c));
        const Matrix4d theirs = matrix.fullPivLu().inverse();
        // Elimination with pivoting loses the digits that the matrix's condition has.
        const double bound = 16 * kRounding * ours.norm() * matrix.norm() * ours.norm();
        seeEntries(worst, trial, ours - theirs, Matrix4d::Constant(bound));
      });
  CHECK_WITHIN_BOUND(worst);
}

TEST_CASE("Eigen: worldToScreen is screenFromNdc after the division after clipFromWorld") {
  Worst chain, textbook, baked;
  forRandomScenes([&](std::uint64_t trial, Random& random, const Scene& s, const Pose& pose, const Projection& p,
                      const Convention& c) {
    const Camera camera = makeCamera(pose, p, s.viewport, c);
    const Vec3 point = randomPoint(random, pose, s.window);
    const ScreenPoint ours = worldToScreen(camera, point);
    REQUIRE(ours.status == PointStatus::inFront);
    const Vector4d world = homogeneous(point);
    const Matrix4d viewport = toEigen(screenFromNdc(s.viewport, c));

    const Matrix4d clipMatrix = toEigen(clipFromWorld(pose, p, c));
    const Vector4d clipError = 5 * kRounding * (clipMatrix.cwiseAbs() * world.cwiseAbs());
    seeScreen(chain, trial, viewport, clipMatrix * world, clipError, ours);

    const Matrix4d view = eigenView(s.view, c), projection = eigenProjection(s.window, c);
    const double reach = sumOfSizes(point) + sumOfSizes(s.view.eye);
    const double e = (viewError(s.view) + 16 * kRounding) * reach;
    seeScreen(textbook, trial, eigenViewport(s.viewport, c), projection * (view * world),
              projection.cwiseAbs() * Vector4d(e, e, e, 16 * kRounding), ours);

    // The viewport folded in: what is left after the division is the screen.
    const Matrix4d screenMatrix = toEigen(screenFromView(p, s.viewport, c)) * toEigen(viewFromWorld(pose, c));
    const Matrix4d screenSize =
        toEigen(screenFromView(p, s.viewport, c)).cwiseAbs() * toEigen(viewFromWorld(pose, c)).cwiseAbs();
    seeScreen(baked, trial, Matrix4d::Identity(), screenMatrix * world,
              10 * kRounding * (screenSize * world.cwiseAbs()), ours);
    const Matrix4d whole = toEigen(screenFromWorld(pose, p, s.viewport, c));
    seeScreen(baked, trial, Matrix4d::Identity(), whole * world, 5 * kRounding * (whole.cwiseAbs() * world.cwiseAbs()),
              ours);
  });
  CHECK_WITHIN_BOUND(chain);
  CHECK_WITHIN_BOUND(textbook);
  CHECK_WITHIN_BOUND(baked);
}

TEST_CASE("Eigen: worldToView, worldToClip and worldToNdc are the matrices applied") {
  Worst worst;
  forRandomScenes([&](std::uint64_t trial, Random& random, const Scene& s, const Pose& pose, const Projection& p,
                      const Convention& c) {
    const Camera camera = makeCamera(pose, p, s.viewport, c);
    const Vec3 at = randomPoint(random, pose, s.window);
    const Vector4d world = homogeneous(at);
    const auto see = [&](const Mat4& matrix, const Vector4d& ours) {
      const Matrix4d m = toEigen(matrix);
      const Vector4d difference = ours - m * world, bound = 5 * kRounding * (m.cwiseAbs() * world.cwiseAbs());
      for (int i = 0; i < 4; ++i) worst.see(trial, difference(i), bound(i));
    };
    const Vec3 view = worldToView(camera, peers::point(at), c);
    const Vec4 clip = worldToClip(camera, peers::point(at), c);
    see(viewFromWorld(pose, c), {view.x, view.y, view.z, 1});
    see(clipFromWorld(pose, p, c), {clip.x, clip.y, clip.z, clip.w});

    const Vec3 ndc = worldToNdc(camera, peers::point(at), c);
    // clip is rounded, and so is the quotient; ndc is rounded once.
    worst.see(trial, ndc.x - clip.x / clip.w, 4 * kRounding * std::fabs(ndc.x));
    worst.see(trial, ndc.y - clip.y / clip.w, 4 * kRounding * std::fabs(ndc.y));
    worst.see(trial, ndc.z - clip.z / clip.w, 4 * kRounding * std::fabs(ndc.z));
  });
  CHECK_WITHIN_BOUND(worst);
}

TEST_CASE("Eigen: relative to the eye, a matrix in double keeps its digits at the radius of the Earth") {
  Worst worst;
  int lostWithoutIt = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    View v = randomView(random);
    const Vec3 direction = minus(v.target, v.eye);
    v.eye = random.direction(6378137);
    v.target = {v.eye.x + direction.x, v.eye.y + direction.y, v.eye.z + direction.z};
    Window w = randomWindow(random, Shape::symmetric);
    for (const Convention& c : everyConvention()) {
      const Pose pose = poseOf(v, c.world);
      const Projection p = projectionOf(w);
      const Camera camera = makeCamera(pose, p, Viewport{1920, 1080}, c);
      const Vec3 point = randomPoint(random, pose, w);
      const ScreenPoint ours = worldToScreen(camera, point);
      if (ours.status != PointStatus::inFront) continue;  // nearer than a coordinate's last digit

      const Vector4d relative = homogeneous(point) - Vector4d(v.eye.x, v.eye.y, v.eye.z, 0);
      const Matrix4d matrix = toEigen(clipFromWorld(relativeToEye(pose), p, c));
      const Matrix4d viewport = toEigen(screenFromNdc(camera.viewport(), c));
      const Vector4d clip = matrix * relative;
      seeScreen(worst, trial, viewport, clip, 6 * kRounding * (matrix.cwiseAbs() * relative.cwiseAbs()), ours);

      const Vector4d absolute = toEigen(clipFromWorld(pose, p, c)) * homogeneous(point);
      if (std::fabs((viewport * absolute / absolute.w()).x() - ours.x) > 1e-7) ++lostWithoutIt;
    }
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK(lostWithoutIt > 0);
}
