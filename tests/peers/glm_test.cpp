// GLM 0.9.9 in double, on tame cameras: signs, hands, layouts and depth ranges, by code that no
// part of the library runs. How near the truth our numbers are, tests/reference tells.
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "catch.hpp"
#include "measure.hpp"
#include "parts.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace peers;

namespace {

constexpr std::uint64_t kTrials = 2000;
constexpr double kAgreed = 1e-10;  ///< of the largest number beside it

double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }
glm::dvec3 toGlm(const Vec3& v) { return {v.x, v.y, v.z}; }

Mat4 fromGlm(const glm::dmat4& m) {
  Mat4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = m[static_cast<int>(j)][static_cast<int>(i)];
  return result;
}

/// To within a share of the largest entry of the row.
void see(Worst& worst, std::uint64_t trial, const Mat4& ours, const Mat4& theirs) {
  for (std::size_t i = 0; i < 4; ++i) {
    double largest = 0;
    for (std::size_t j = 0; j < 4; ++j) largest = std::max(largest, std::fabs(theirs[i][j]));
    for (std::size_t j = 0; j < 4; ++j) worst.see(trial, ours[i][j] - theirs[i][j], kAgreed * largest);
  }
}

/// What lookAt takes. upSine: of the angle between up and the viewing direction, at least 0.1.
struct View {
  Vec3 eye, target, up;
  double upSine = 1;
};

View randomView(Random& random, double largestEye = 1e4) {
  View v;
  v.eye = random.direction(random.logUniform(0.1, largestEye));
  const Vec3 d = random.direction(random.logUniform(0.1, 1e3));
  v.target = {v.eye.x + d.x, v.eye.y + d.y, v.eye.z + d.z};
  do {
    v.up = random.direction(random.logUniform(0.01, 100));
    v.upSine = length(cross(d, v.up)) / (length(d) * length(v.up));
  } while (v.upSine < 0.1);
  return v;
}

Pose poseOf(const View& v, Handedness world) { return lookAt(v.eye, v.target, v.up, world); }

/// What glFrustum and glOrtho take.
struct Window {
  bool orthographic = false;
  double left = -1, right = 1, bottom = -1, top = 1, near = 1, far = 2;
};

Projection projectionOf(const Window& w) {
  return w.orthographic ? orthographic(w.left, w.right, w.bottom, w.top, w.near, w.far)
                        : frustum(w.left, w.right, w.bottom, w.top, w.near, w.far);
}

enum class Shape { symmetric, offCentre, orthographic };

Window randomWindow(Random& random, Shape shape, bool infiniteFar = false) {
  Window w;
  w.orthographic = shape == Shape::orthographic;
  w.near = w.orthographic ? random.uniform(-100, 100) : random.logUniform(1e-3, 10);
  w.far = infiniteFar      ? kInfiniteFar
          : w.orthographic ? w.near + random.logUniform(0.1, 1e4)
                           : w.near * random.logUniform(2, 1e6);
  const double halfWidth = w.orthographic ? random.logUniform(0.1, 1e3) : w.near * random.logUniform(0.1, 5);
  const double halfHeight = halfWidth * random.logUniform(0.3, 3);
  const double x = shape == Shape::symmetric ? 0 : halfWidth * random.uniform(-1.5, 1.5);
  const double y = shape == Shape::symmetric ? 0 : halfHeight * random.uniform(-1.5, 1.5);
  w.left = x - halfWidth;
  w.right = x + halfWidth;
  w.bottom = y - halfHeight;
  w.top = y + halfHeight;
  return w;
}

Window tameWindow(Random& random, Tally& tally) {
  const auto shape = static_cast<Shape>(static_cast<int>(random.uniform(0, 3)));
  Window w = randomWindow(random, shape);
  if (!w.orthographic) w.far = std::min(w.far, w.near * 100);
  tally.count("symmetric", shape == Shape::symmetric);
  tally.count("off-centre", shape == Shape::offCentre);
  tally.count("orthographic", shape == Shape::orthographic);
  tally.count("near behind the eye", w.near < 0);
  return w;
}

/// GLM's four clip spaces, in the order of the rows below.
constexpr struct {
  Handedness world;
  NdcZ ndcZ;
} kSpaces[] = {{Handedness::right, NdcZ::minusOneToOne},
               {Handedness::right, NdcZ::zeroToOne},
               {Handedness::left, NdcZ::minusOneToOne},
               {Handedness::left, NdcZ::zeroToOne}};
constexpr decltype(&glm::perspectiveRH_NO<double>) kPerspective[] = {
    glm::perspectiveRH_NO<double>, glm::perspectiveRH_ZO<double>, glm::perspectiveLH_NO<double>,
    glm::perspectiveLH_ZO<double>};
constexpr decltype(&glm::frustumRH_NO<double>) kFrustum[] = {glm::frustumRH_NO<double>, glm::frustumRH_ZO<double>,
                                                             glm::frustumLH_NO<double>, glm::frustumLH_ZO<double>};
constexpr decltype(&glm::orthoRH_NO<double>) kOrtho[] = {glm::orthoRH_NO<double>, glm::orthoRH_ZO<double>,
                                                         glm::orthoLH_NO<double>, glm::orthoLH_ZO<double>};

Convention conventionOf(std::size_t space, bool reverseZ) {
  Convention c;
  c.world = kSpaces[space].world;
  c.view = c.world == Handedness::left ? ViewAxes::RUF : ViewAxes::RUB;
  c.ndcZ = kSpaces[space].ndcZ;
  c.reverseZ = reverseZ;
  return c;
}

glm::dmat4 glmView(const View& v, Handedness world) {
  return world == Handedness::right ? glm::lookAtRH(toGlm(v.eye), toGlm(v.target), toGlm(v.up))
                                    : glm::lookAtLH(toGlm(v.eye), toGlm(v.target), toGlm(v.up));
}

/// GLM has no reversed depth, but near and far can be handed over in the other order; frustum then takes its edges to
/// be on the far plane. Its frustumLH shifts an off-centre window the wrong way: it kept the sign of RH, where z runs
/// backwards.
glm::dmat4 glmWindow(std::size_t space, const Window& w, bool reverseZ) {
  const double first = reverseZ ? w.far : w.near, second = reverseZ ? w.near : w.far;
  if (w.orthographic) return kOrtho[space](w.left, w.right, w.bottom, w.top, first, second);
  const double k = first / w.near;
  glm::dmat4 m = kFrustum[space](k * w.left, k * w.right, k * w.bottom, k * w.top, first, second);
  if (kSpaces[space].world == Handedness::left) m[2][0] = -m[2][0], m[2][1] = -m[2][1];
  return m;
}

}  // namespace

TEST_CASE(
    "GLM: lookAt, perspective, infinitePerspective, frustum and ortho, in both hands, depth ranges and reversed") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const View v = randomView(random, 10);
    const Window w = tameWindow(random, tally);
    const double fovY = random.uniform(5, 150), aspect = random.logUniform(0.3, 3), near = random.logUniform(1e-3, 10);
    for (std::size_t space = 0; space < 4; ++space)
      for (bool reverseZ : {false, true}) {
        const Convention c = conventionOf(space, reverseZ);
        const glm::dmat4 view = glmView(v, c.world), projection = glmWindow(space, w, reverseZ);
        see(worst, trial, viewFromWorld(poseOf(v, c.world), c), fromGlm(view));
        see(worst, trial, clipFromView(projectionOf(w), c), fromGlm(projection));
        see(worst, trial, clipFromWorld(poseOf(v, c.world), projectionOf(w), c), fromGlm(projection * view));
        const double first = reverseZ ? 100 * near : near, second = reverseZ ? near : 100 * near;
        see(worst, trial, clipFromView(perspective(fovY, aspect, near, 100 * near), c),
            fromGlm(kPerspective[space](radians(fovY), aspect, first, second)));
      }
    const Projection infinite = perspective(fovY, aspect, near, kInfiniteFar);
    see(worst, trial, clipFromView(infinite, conventionOf(0, false)),
        fromGlm(glm::infinitePerspectiveRH(radians(fovY), aspect, near)));
    see(worst, trial, clipFromView(infinite, conventionOf(2, false)),
        fromGlm(glm::infinitePerspectiveLH(radians(fovY), aspect, near)));
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}
