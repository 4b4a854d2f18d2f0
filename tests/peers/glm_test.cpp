// GLM 0.9.9 in double, on moderate cameras: no part of it is run by the library.
//
// Tolerances are counts of GLM's roundings, each 2^-53 of the terms that it rounds. Ours round once.
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_projection.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "catch.hpp"
#include "internals.hpp"
#include "measure.hpp"
#include "random_cameras.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace peers;

namespace {

constexpr std::uint64_t kTrials = 2000;

/// lookAt: two normalised vectors, a cross product and a dot product, about 50 roundings; the cross product of the
/// viewing direction and up enlarges them by 1 / sin of the angle between the two.
constexpr double kLookAtRoundings = 64;
/// perspective: rounding degrees to radians is enlarged by the tangent, up to 5 times at 150 degrees.
constexpr double kPerspectiveRoundings = 32;
/// frustum and ortho: a sum, a difference, a product and a quotient.
constexpr double kFrustumRoundings = 8;

glm::dvec3 toGlm(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 fromGlm(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// GLM's m[column][row].
Mat4 fromGlm(const glm::dmat4& m) {
  Mat4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = m[static_cast<int>(j)][static_cast<int>(i)];
  return result;
}

double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }

/// The four clip spaces that GLM knows, and what it calls them.
enum class Space { RH_NO, RH_ZO, LH_NO, LH_ZO };
constexpr Space kSpaces[] = {Space::RH_NO, Space::RH_ZO, Space::LH_NO, Space::LH_ZO};

bool isLeft(Space s) { return s == Space::LH_NO || s == Space::LH_ZO; }
bool isZeroToOne(Space s) { return s == Space::RH_ZO || s == Space::LH_ZO; }

Convention conventionOf(Space space, bool reverseZ = false) {
  Convention c;
  c.world = isLeft(space) ? Handedness::left : Handedness::right;
  c.view = isLeft(space) ? ViewAxes::RUF : ViewAxes::RUB;
  c.ndcZ = isZeroToOne(space) ? NdcZ::zeroToOne : NdcZ::minusOneToOne;
  c.reverseZ = reverseZ;
  return c;
}

glm::dmat4 glmLookAt(const View& v, Handedness world) {
  return world == Handedness::right ? glm::lookAtRH(toGlm(v.eye), toGlm(v.target), toGlm(v.up))
                                    : glm::lookAtLH(toGlm(v.eye), toGlm(v.target), toGlm(v.up));
}

glm::dmat4 glmPerspective(Space space, double fovY, double aspect, double near, double far) {
  switch (space) {
    case Space::RH_NO:
      return glm::perspectiveRH_NO(fovY, aspect, near, far);
    case Space::RH_ZO:
      return glm::perspectiveRH_ZO(fovY, aspect, near, far);
    case Space::LH_NO:
      return glm::perspectiveLH_NO(fovY, aspect, near, far);
    case Space::LH_ZO:
      return glm::perspectiveLH_ZO(fovY, aspect, near, far);
  }
  return {};
}

glm::dmat4 glmOrtho(Space space, const Window& w, double near, double far) {
  switch (space) {
    case Space::RH_NO:
      return glm::orthoRH_NO(w.left, w.right, w.bottom, w.top, near, far);
    case Space::RH_ZO:
      return glm::orthoRH_ZO(w.left, w.right, w.bottom, w.top, near, far);
    case Space::LH_NO:
      return glm::orthoLH_NO(w.left, w.right, w.bottom, w.top, near, far);
    case Space::LH_ZO:
      return glm::orthoLH_ZO(w.left, w.right, w.bottom, w.top, near, far);
  }
  return {};
}

/// GLM 0.9.9's frustumLH shifts an off-centre window the wrong way: it kept the sign of RH, where z runs backwards.
glm::dmat4 withShiftTurned(glm::dmat4 m) {
  m[2][0] = -m[2][0];
  m[2][1] = -m[2][1];
  return m;
}

glm::dmat4 glmFrustum(Space space, const Window& w, double near, double far) {
  switch (space) {
    case Space::RH_NO:
      return glm::frustumRH_NO(w.left, w.right, w.bottom, w.top, near, far);
    case Space::RH_ZO:
      return glm::frustumRH_ZO(w.left, w.right, w.bottom, w.top, near, far);
    case Space::LH_NO:
      return withShiftTurned(glm::frustumLH_NO(w.left, w.right, w.bottom, w.top, near, far));
    case Space::LH_ZO:
      return withShiftTurned(glm::frustumLH_ZO(w.left, w.right, w.bottom, w.top, near, far));
  }
  return {};
}

glm::dmat4 glmWindow(Space space, const Window& w, double near, double far) {
  return w.orthographic ? glmOrtho(space, w, near, far) : glmFrustum(space, w, near, far);
}

/// GLM has no reversed depth, but near and far can be handed over in the other order. frustum then takes its edges to
/// be on the far plane.
glm::dmat4 glmWindow(Space space, const Window& w, bool reverseZ) {
  if (!reverseZ) return glmWindow(space, w, w.near, w.far);
  Window onFar = w;
  if (!w.orthographic) {
    const double k = w.far / w.near;
    onFar.left *= k, onFar.right *= k, onFar.bottom *= k, onFar.top *= k;
  }
  return glmWindow(space, onFar, w.far, w.near);
}

void seePerspective(Worst& worst, std::uint64_t trial, const Mat4& ours, const glm::dmat4& peer) {
  const Mat4 theirs = fromGlm(peer);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      worst.see(trial, ours[i][j] - theirs[i][j], kPerspectiveRoundings * kRounding * std::fabs(ours[i][j]));
}

/// The entries of a window's matrix. Shifts such as (right + left) / (right - left) may cancel: their bound is of the
/// edges.
void seeWindow(Worst& worst, std::uint64_t trial, const Window& w, const Mat4& ours, const glm::dmat4& peer) {
  const Mat4 theirs = fromGlm(peer);
  const double shifts[] = {std::max(std::fabs(w.left), std::fabs(w.right)) / (w.right - w.left),
                           std::max(std::fabs(w.bottom), std::fabs(w.top)) / (w.top - w.bottom)};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double size = i < 2 && i != j && ours[i][j] != 0 ? shifts[i] : std::fabs(ours[i][j]);
      worst.see(trial, ours[i][j] - theirs[i][j], kFrustumRoundings * kRounding * size);
    }
}

/// A camera that GLM can express, and a point that it sees.
struct Shot {
  Space space;
  bool reverseZ;
  View view;
  Window window;
  Convention convention;
  Pose pose = poseOf(view, convention.world);
  Projection projection = projectionOf(window);
  Viewport viewport;
  Camera camera = makeCamera(pose, projection, viewport, convention);
  glm::dmat4 glmView{}, glmProjection{};
  glm::dvec4 glmViewport{};
  Vec3 point{};
};

Shot randomShot(Random& random, Tally& tally, double largestEye, double largestRatio) {
  const Space space = kSpaces[static_cast<std::size_t>(random.uniform(0, 4))];
  const bool reverseZ = random.coin();
  const auto shape = static_cast<Shape>(static_cast<int>(random.uniform(0, 3)));
  const View view = randomView(random, largestEye);
  Window window = randomWindow(random, shape);
  if (!window.orthographic) window.far = std::min(window.far, window.near * largestRatio);
  const Viewport viewport = randomViewport(random, Origin::bottomLeft);
  Shot s{.space = space,
         .reverseZ = reverseZ,
         .view = view,
         .window = window,
         .convention = conventionOf(space, reverseZ),
         .viewport = viewport};
  s.glmView = glmLookAt(s.view, s.convention.world);
  s.glmProjection = glmWindow(s.space, s.window, s.reverseZ);
  s.glmViewport = {viewport.x, viewport.y, viewport.width, viewport.height};
  s.point = randomPoint(random, s.pose, s.window);

  tally.count("RH NO", s.space == Space::RH_NO);
  tally.count("RH ZO", s.space == Space::RH_ZO);
  tally.count("LH NO", s.space == Space::LH_NO);
  tally.count("LH ZO", s.space == Space::LH_ZO);
  tally.count("reversed depth", s.reverseZ);
  tally.count("symmetric", shape == Shape::symmetric);
  tally.count("off-centre", shape == Shape::offCentre);
  tally.count("orthographic", shape == Shape::orthographic);
  tally.count("negative near", s.window.near < 0);
  return s;
}

/// How far GLM's clip coordinates of a point may be from the true ones: view coordinates are off by lookAt's roundings
/// of |point| + |eye|, and each row of the projection passes that on.
Vec4 clipErrors(const Shot& s) {
  const Mat4 projection = clipFromView(s.projection, s.convention);
  const double reach = sumOfSizes(s.point) + sumOfSizes(s.view.eye);
  const double view = (kLookAtRoundings / s.view.upSine + 8 + kFrustumRoundings) * kRounding * reach;
  const Vec4 scaled = sizes(projection, {view, view, view, 0});
  const Vec4 own = sizes(projection, {0, 0, 0, (8 + kFrustumRoundings) * kRounding});
  return {scaled.x + own.x, scaled.y + own.y, scaled.z + own.z, scaled.w + own.w};
}

}  // namespace

TEST_CASE("GLM: viewFromWorld is lookAtRH in a right-handed world and lookAtLH in a left-handed one") {
  Worst worst;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const View v = randomView(random);
    for (Space space : {Space::RH_NO, Space::LH_NO}) {
      const Convention c = conventionOf(space);
      const Mat4 ours = viewFromWorld(poseOf(v, c.world), c);
      const Mat4 theirs = fromGlm(glmLookAt(v, c.world));
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          worst.see(trial, ours[i][j] - theirs[i][j],
                    kLookAtRoundings / v.upSine * kRounding * (j == 3 ? sumOfSizes(v.eye) : 1));
    }
  }
  CHECK_WITHIN_BOUND(worst);
}

TEST_CASE(
    "GLM: clipFromView is perspective, in both hands and both depth ranges, and reversed where near and far trade "
    "places") {
  Worst worst;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const double fovY = random.uniform(5, 150), aspect = random.logUniform(0.3, 3);
    const double near = random.logUniform(1e-3, 10), far = near * random.logUniform(2, 1e6);
    const Projection p = perspectiveFovY(fovY, aspect, near, far);
    for (Space space : kSpaces) {
      seePerspective(worst, trial, clipFromView(p, conventionOf(space)),
                     glmPerspective(space, radians(fovY), aspect, near, far));
      seePerspective(worst, trial, clipFromView(p, conventionOf(space, true)),
                     glmPerspective(space, radians(fovY), aspect, far, near));
    }
  }
  CHECK_WITHIN_BOUND(worst);
}

TEST_CASE("GLM: with an infinite far plane clipFromView is infinitePerspective") {
  Worst worst;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const double fovY = random.uniform(5, 150), aspect = random.logUniform(0.3, 3), near = random.logUniform(1e-3, 10);
    const Projection p = perspectiveFovY(fovY, aspect, near, kInfiniteFar);
    seePerspective(worst, trial, clipFromView(p, conventionOf(Space::RH_NO)),
                   glm::infinitePerspectiveRH(radians(fovY), aspect, near));
    seePerspective(worst, trial, clipFromView(p, conventionOf(Space::LH_NO)),
                   glm::infinitePerspectiveLH(radians(fovY), aspect, near));
  }
  CHECK_WITHIN_BOUND(worst);
}

TEST_CASE("GLM: clipFromView is frustum and ortho, in both hands, both depth ranges and reversed") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    for (Shape shape : {Shape::symmetric, Shape::offCentre, Shape::orthographic}) {
      const Window w = randomWindow(random, shape);
      tally.count("near in front of the eye", w.near > 0);
      tally.count("near behind the eye", w.near < 0);
      for (Space space : kSpaces)
        for (bool reverseZ : {false, true})
          seeWindow(worst, trial, w, clipFromView(projectionOf(w), conventionOf(space, reverseZ)),
                    glmWindow(space, w, reverseZ));
    }
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("GLM: frustumLH of an off-centre window misses its own left edge, which clipFromView meets") {
  const Window w{false, 1, 3, -1, 1, 2, 10};
  const glm::dvec4 theirs = glm::frustumLH_NO(w.left, w.right, w.bottom, w.top, w.near, w.far) * glm::dvec4(1, 0, 2, 1);
  CHECK(theirs.x / theirs.w == 3);
  const Vec4 ours = times(clipFromView(projectionOf(w), conventionOf(Space::LH_NO)), {1, 0, 2, 1});
  CHECK(ours.x / ours.w == -1);
}

TEST_CASE("GLM: clipFromWorld is the product of projection and view") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Shot s = randomShot(random, tally, 1e4, 1e6);
    const Mat4 ours = clipFromWorld(s.pose, s.projection, s.convention);
    const Mat4 theirs = fromGlm(s.glmProjection * s.glmView);
    const Mat4 projection = clipFromView(s.projection, s.convention);
    const double view = (kLookAtRoundings / s.view.upSine + 8 + kFrustumRoundings) * kRounding;
    for (std::size_t j = 0; j < 4; ++j) {
      const double column = j == 3 ? view * sumOfSizes(s.view.eye) : view;
      const double constant = j == 3 ? (8 + kFrustumRoundings) * kRounding : 0;
      const Vec4 bound = sizes(projection, {column, column, column, constant});
      const double bounds[] = {bound.x, bound.y, bound.z, bound.w};
      for (std::size_t i = 0; i < 4; ++i) worst.see(trial, ours[i][j] - theirs[i][j], bounds[i]);
    }
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("GLM: worldToScreen from the bottom left is project, whose window depth is 0 to 1 in both depth ranges") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    const Shot s = randomShot(random, tally, 1e4, 1e6);
    const glm::dvec3 theirs = isZeroToOne(s.space)
                                  ? glm::projectZO(toGlm(s.point), s.glmView, s.glmProjection, s.glmViewport)
                                  : glm::projectNO(toGlm(s.point), s.glmView, s.glmProjection, s.glmViewport);
    const Vec4 clip = times(clipFromWorld(s.pose, s.projection, s.convention), peers::point(s.point));
    const Vec4 error = clipErrors(s);
    const Viewport& v = s.camera.viewport();
    const auto bound = [&](double value, double errorOfValue, double scale, double offset) {
      const double ndc = std::fabs(value / clip.w);
      // The division, then three roundings on the way to the screen.
      return scale * ((errorOfValue + ndc * error.w) / (std::fabs(clip.w) - error.w) + 4 * kRounding * (ndc + 1)) +
             2 * kRounding * std::fabs(offset);
    };
    for (Precision precision : {Precision::standard, Precision::exact}) {
      const ScreenPoint ours = worldToScreen(s.camera, s.point, precision);
      REQUIRE(ours.status == PointStatus::inFront);
      tally.count("in the picture", ours.visible());
      tally.count("beside the picture", !ours.visible());
      worst.see(trial, ours.x - theirs.x, bound(clip.x, error.x, v.width, v.x));
      worst.see(trial, ours.y - theirs.y, bound(clip.y, error.y, v.height, v.y));
      worst.see(trial, ours.depth - theirs.z, bound(clip.z, error.z, 1, 0));
    }
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}

TEST_CASE("GLM: screenToWorld is unProject, as far as inverting a matrix in double allows") {
  Worst worst;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    // Near the origin and with far / near up to 100: the inverse loses as many digits as the matrix's condition has.
    const Shot s = randomShot(random, tally, 10, 100);
    const Viewport& v = s.camera.viewport();
    const Vec2 screen{v.x + random.uniform(0, 1) * v.width, v.y + random.uniform(0, 1) * v.height};
    const double depth = random.uniform(0.05, 0.95);
    const WorldPoint ours = screenToWorld(s.camera, screen, depth);
    REQUIRE(ours.status == DepthStatus::point);

    const glm::dvec3 window{screen.x, screen.y, depth};
    const Vec3 theirs =
        fromGlm(isZeroToOne(s.space) ? glm::unProjectZO(window, s.glmView, s.glmProjection, s.glmViewport)
                                     : glm::unProjectNO(window, s.glmView, s.glmProjection, s.glmViewport));
    // GLM inverts a product that is off by e. Its inverse is off by |M^-1| e |M^-1|.
    const Mat4 inverse = worldFromClip(s.pose, s.projection, s.convention);
    const Vec4 world = sizes(inverse, {1, 1, 1, 1});
    const double reach = 1 + sumOfSizes(s.view.eye);
    const double e =
        (kLookAtRoundings / s.view.upSine + 16) * kRounding * reach * (world.x + world.y + world.z + world.w);
    const Vec4 error = sizes(inverse, sizes(clipFromView(s.projection, s.convention), {e, e, e, e}));
    const Vec4 weight = times(inverse, {2 * (screen.x - v.x) / v.width - 1, 2 * (screen.y - v.y) / v.height - 1,
                                        isZeroToOne(s.space) ? depth : 2 * depth - 1, 1});
    const auto bound = [&](double value, double errorOfValue) {
      return (errorOfValue + std::fabs(value) * error.w) / std::fabs(weight.w);
    };
    worst.see(trial, ours.position.x - theirs.x, bound(theirs.x, error.x));
    worst.see(trial, ours.position.y - theirs.y, bound(theirs.y, error.y));
    worst.see(trial, ours.position.z - theirs.z, bound(theirs.z, error.z));
  }
  CHECK_WITHIN_BOUND(worst);
  CHECK_ALL_VISITED(tally);
}
