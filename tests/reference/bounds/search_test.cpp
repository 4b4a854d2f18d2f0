// Bounds are searched: from random cameras and points, climbing step by step to those whose error takes up most of its
// bound, or of one term of it.
//
// On the way up the truth is double-double, from the camera's own rows; at the top it is MPFR's. Each bound must be
// what its derivation says (written out here once more), be finite and kept; it must be reached to the share given,
// and so must each of its terms: a constant of half the size would be found out. A climb ends where that is shown;
// with VIEWPROJ_BOUND_CLIMBS=N there are N for each, to the very top.
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "reference/bounds/families.hpp"
#include "reference/bounds/oracle.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

/// Where a climb stands.
struct State {
  Scene scene;
  Vec3 point;
};

using Field = double& (*)(State&);
#define FIELD(member) [](State& s) -> double& { return s.member; }
#define FIELDS_OF(vector) FIELD(vector.x), FIELD(vector.y), FIELD(vector.z)

/// Cameras of one kind, and the numbers of theirs that a climb changes.
struct Kind {
  const char* name;
  bool orthographic, hasResidual;
  void (*start)(Random&, Scene&);
  std::vector<Field> fields;
};

void anyPose(Random& r, Scene& s) {
  s.poseKind = PoseKind::direction;
  s.position = r.vector(r.chance(0.5) ? 0 : 100);
  s.target = r.vector(1);
  s.up = r.vector(1);
  if (r.chance(0.7)) {  // Rows whose largest entries stand in one column: (1 1 1) and (2 -1 -1).
    const std::size_t first = std::size_t(r.uniform(0, 3));
    s.target = {1, 1, 1}, s.up = {r.sign(), r.sign(), r.sign()};
    s.up[first] = 0, s.up[(first + 1) % 3] = 1, s.up[(first + 2) % 3] = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double sign = r.sign();
      s.target[i] *= sign, s.up[i] *= sign;
    }
  }
  s.near = r.spread(1e-3, 1), s.far = s.near * r.spread(2, 1e6);
  s.viewport.origin = r.chance(0.5) ? Origin::topLeft : Origin::bottomLeft;
  if (r.chance(0.5)) s.convention.reverseZ = true;
  if (r.chance(0.3)) s.viewport.depthFirst = -1;
  if (r.chance(0.3)) s.viewport.x = r.spread(1, 1e15), s.viewport.y = -r.spread(1, 1e15);
  if (r.chance(0.3)) s.viewport = {1, 1, 0, 0, 0, 1, Origin::topLeft, r.uniform(-4, 4)};
}

void viewMatrix(Random& r, Scene& s) {
  anyPose(r, s);
  const Pose pose = lookAlong({0, 0, 0}, s.target, s.up, Handedness::right);
  s.poseKind = PoseKind::cameraFromWorld;
  const Vec3 far = r.vector(r.spread(1, 1e6));
  for (std::size_t j = 0; j < 3; ++j) {
    s.matrix[0][j] = parts(pose).rows.right[j].hi;
    s.matrix[1][j] = parts(pose).rows.up[j].hi;
    s.matrix[2][j] = -parts(pose).rows.forward[j].hi;
    s.matrix[j][3] = far[j];
  }
  s.matrix[3] = {0, 0, 0, 1};
}

/// Rows that are rounded, and a forward axis a little longer than 1.
void cameraMatrix(Random& r, Scene& s) {
  viewMatrix(r, s);
  s.poseKind = PoseKind::worldFromCamera;
  const double shrink = r.chance(0.7) ? 1 - r.spread(1e-6, 3e-4) : 1;
  const Mat4 rows = r.chance(0.5) ? Mat4{{{{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}}}} : s.matrix;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) s.matrix[j][i] = shrink * rows[i][j] + r.uniform(-1e-6, 1e-6);
  for (std::size_t j = 0; j < 3; ++j) s.matrix[j][3] = 0;
}

void focalLengths(Random& r, Scene& s) {
  s.lensKind = LensKind::intrinsics;
  s.fx = r.spread(1, 1e6), s.fy = s.fx * r.spread(1e-3, 1e3);
  s.cx = s.viewport.x + r.uniform(0, 1) * s.viewport.width, s.cy = s.viewport.y + r.uniform(0, 1) * s.viewport.height;
}

void windowEdges(Random& r, Scene& s) {
  s.lensKind = LensKind::frustum;
  s.left = r.uniform(-2, 1), s.bottom = r.uniform(-2, 1);
  s.right = s.left + r.spread(1e-4, 2), s.top = s.bottom + r.spread(1e-4, 2);
}

void parallel(Random& r, Scene& s) {
  windowEdges(r, s);
  s.lensKind = LensKind::orthographic;
  s.near = r.uniform(-10, 1);
  s.far = s.near + r.spread(1e-3, 1e3);
}

const std::vector<Field> kPoint = {FIELDS_OF(point)};
const std::vector<Field> kMade = {FIELDS_OF(scene.position), FIELDS_OF(scene.target), FIELDS_OF(scene.up)};
const std::vector<Field> kMatrix = {FIELD(scene.matrix[0][0]), FIELD(scene.matrix[0][1]), FIELD(scene.matrix[0][2]),
                                    FIELD(scene.matrix[0][3]), FIELD(scene.matrix[1][0]), FIELD(scene.matrix[1][1]),
                                    FIELD(scene.matrix[1][2]), FIELD(scene.matrix[1][3]), FIELD(scene.matrix[2][0]),
                                    FIELD(scene.matrix[2][1]), FIELD(scene.matrix[2][2]), FIELD(scene.matrix[2][3])};
const std::vector<Field> kRange = {FIELD(scene.near), FIELD(scene.far), FIELD(scene.viewport.depthFirst),
                                   FIELD(scene.viewport.depthSecond)};
const std::vector<Field> kPlace = {FIELD(scene.viewport.x), FIELD(scene.viewport.y), FIELD(scene.viewport.pixelCenter)};
const std::vector<Field> kEdges = {FIELD(scene.left), FIELD(scene.right), FIELD(scene.bottom), FIELD(scene.top)};
const std::vector<Field> kFocal = {FIELD(scene.fx), FIELD(scene.fy), FIELD(scene.cx), FIELD(scene.cy)};

std::vector<Field> joined(std::initializer_list<std::vector<Field>> lists) {
  std::vector<Field> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

const Kind kKinds[] = {
    {"field of view", false, false, anyPose, joined({kPoint, kMade, kRange, kPlace, {FIELD(scene.fov)}})},
    {"focal lengths", false, false, [](Random& r, Scene& s) { anyPose(r, s), focalLengths(r, s); },
     joined({kPoint, kMade, kRange, kPlace, kFocal})},
    {"off-centre window", false, false, [](Random& r, Scene& s) { anyPose(r, s), windowEdges(r, s); },
     joined({kPoint, kMade, kRange, kPlace, kEdges})},
    {"view matrix", false, true, [](Random& r, Scene& s) { viewMatrix(r, s), focalLengths(r, s); },
     joined({kPoint, kMatrix, kRange, kPlace, kFocal})},
    {"camera matrix", false, false, [](Random& r, Scene& s) { cameraMatrix(r, s), focalLengths(r, s); },
     joined({kPoint, kMatrix, kRange, kPlace, kFocal})},
    {"orthographic camera matrix", true, false, [](Random& r, Scene& s) { cameraMatrix(r, s), parallel(r, s); },
     joined({kPoint, kMatrix, kRange, kPlace, kEdges})},
    {"orthographic", true, false, [](Random& r, Scene& s) { anyPose(r, s), parallel(r, s); },
     joined({kPoint, kMade, kRange, kPlace, kEdges})},
    {"orthographic view matrix", true, true, [](Random& r, Scene& s) { viewMatrix(r, s), parallel(r, s); },
     joined({kPoint, kMatrix, kRange, kPlace, kEdges})},
};

/// The terms of the derivation in view/bounds.hpp, each times a weight.
struct Weights {
  double c1 = 1, c2 = 1, quotient = 1, sum = 1, center = 1, residual = 1, operations = 1, depth = 1, offset = 1;
};

enum class Of { point, picture };
enum class Number { screen, depth };

constexpr double kNever = -100;  ///< where a term cannot be told from the slack of the others

/// A bound, or a term of it (without: what is left of the bound when it is dropped). An error must be found that takes
/// up at least this share of it, where everything else is granted in full: more than half of c1 and c2, and of the
/// others more than nothing. What is proven of a coordinate in perspective takes the worst of X and of W, and what is
/// proven of a picture the worst of its corners: no point has all of that, and the shares are what was found.
struct Target {
  const char* name;
  Number number;
  Of of;
  double leastPerspective, leastOrthographic;
  Weights without{};
};

const Target kTargets[] = {
    {"whole", Number::screen, Of::point, 0.5, 0.5},
    {"c1", Number::screen, Of::point, 0.2, 0.5, {.c1 = 0}},
    {"c1 and c2", Number::screen, Of::point, 0.3, 0.5, {.c1 = 0, .c2 = 0}},
    {"last sum", Number::screen, Of::point, 0, 0, {.sum = 0}},
    {"centre's low part", Number::screen, Of::point, 0, 0, {.center = 0}},
    {"residual", Number::screen, Of::point, 0, kNever, {.residual = 0}},
    {"whole", Number::depth, Of::point, 0.5, 0.5},
    {"c2", Number::depth, Of::point, 0.45, 0.5, {.c2 = 0}},
    {"last sum", Number::depth, Of::point, 0, 0, {.depth = 0}},
    {"offset's low part", Number::depth, Of::point, 0, 0, {.offset = 0}},
    {"whole", Number::screen, Of::picture, 0.5, 0.5},
    {"c1 and c2", Number::screen, Of::picture, 0.15, 0.15, {.c1 = 0, .c2 = 0}},
    {"whole", Number::depth, Of::picture, 0.5, 0.5},
    {"c2", Number::depth, Of::picture, 0.15, 0.15, {.c2 = 0}},
};

bool isWhole(const Target& t) { return t.name == kTargets[0].name; }

double size(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// The true numbers of a point, from the camera's rows in double-double.
struct Truly {
  DoubleDouble x, y, depth, w;

  Truly(const ProjectionConstants& k, const Vec3& p) {
    const DDVec3 d{twoDiff(p.x, k.eye.x), twoDiff(p.y, k.eye.y), twoDiff(p.z, k.eye.z)};
    w = dot(k.w, d) + k.residual.z;
    x = dot(k.x, d) + k.residual.x, y = dot(k.y, d) + k.residual.y;
    depth = w;
    if (!k.orthographic) x = x / w, y = y / w, depth = DoubleDouble(1) / w;
    x += k.centerX, y += k.centerY;
    depth = k.depthOffset + k.depthScale * depth;
  }
};

double off(double got, DoubleDouble truth) { return std::fabs((got - truth.hi) - truth.lo); }

/// The derivation once more: of a point t = D / |W|, q pixels from the centre, at the screen position and depth.
ErrorBound derived(const ProjectionConstants& k, Precision rung, double t, double q, double position, double perW,
                   double depth, const Weights& g) {
  const double u = rung == Precision::fast ? 0x1p-24 : 0x1p-53, v = 0x1p-53, more = 1 + 0x1p-8;
  const double c1 = g.c1 * 6 * u * more * k.sizeXY, c2 = g.c2 * 6 * u * more * k.sizeW;
  const double center = g.center * std::max(std::fabs(k.centerX.lo), std::fabs(k.centerY.lo));
  const double tiny = 0x1p-1072, scale = std::fabs(k.depthScale.hi) + tiny;
  const double sums = g.sum * v * more * position + center;
  const double depthSums = g.depth * v * more * depth + g.offset * std::fabs(k.depthOffset.lo) + tiny * (1 + perW);
  if (k.orthographic) return {c1 * t + sums, scale * (c2 * t + g.operations * 2 * v * more * perW) + depthSums};
  return {t * (c1 + c2 * q) + g.quotient * 2 * u * more * q + sums,
          scale * perW * (c2 * t + g.operations * (u + 2 * v) * more) + depthSums};
}

ErrorBound derivedOfPoint(const Camera& c, Precision rung, const Vec3& p, const Truly& truly, const Weights& g) {
  const ProjectionConstants& k = parts(c).constants;
  const double D = size({p.x - k.eye.x, p.y - k.eye.y, p.z - k.eye.z}) + g.residual * k.residualReach;
  const double w = std::fabs(truly.w.hi);
  return derived(k, rung, k.orthographic ? D : D / w,
                 std::max(std::fabs(truly.x.hi - k.centerX.hi), std::fabs(truly.y.hi - k.centerY.hi)),
                 std::max(std::fabs(truly.x.hi), std::fabs(truly.y.hi)), k.orthographic ? w : 1 / w,
                 std::fabs(truly.depth.hi), g);
}

/// The screen positions of the left and the right end of the picture, or of the lower and the upper.
struct Span {
  double first, last;
  double reachFrom(double center) const { return std::max(std::fabs(first - center), std::fabs(last - center)); }
  double size() const { return std::max(std::fabs(first), std::fabs(last)); }
  bool holds(double at) const { return first <= at && at <= last; }
};
Span across(const Viewport& v, double band) {
  const double middle = v.x + (v.pixelCenter - 0.5) + v.width / 2;
  return {middle - band * v.width / 2, middle + band * v.width / 2};
}
Span along(const Viewport& v, double band) {
  const double middle = v.y + (v.pixelCenter - 0.5) + v.height / 2;
  return {middle - band * v.height / 2, middle + band * v.height / 2};
}

/// Of points d = W (C + qx RX + qy RY), with q as far as the picture's ends are from the centre.
ErrorBound derivedInPicture(const Camera& c, Precision rung, double band, const Weights& g) {
  const ProjectionConstants& k = parts(c).constants;
  const Span x = across(c.viewport(), band), y = along(c.viewport(), band);
  const double qx = x.reachFrom(k.centerX.hi), qy = y.reachFrom(k.centerY.hi);
  const double position = std::max(std::fabs(k.centerX.hi) + qx, std::fabs(k.centerY.hi) + qy);
  const double nearest = std::fabs(parts(c).projection.near);
  const double perW = k.orthographic ? std::max(nearest, std::fabs(parts(c).projection.far)) : 1 / nearest;
  const double spread = qx * size(k.rayX) + qy * size(k.rayY), residual = g.residual * k.residualReach;
  const double t = k.orthographic ? spread + size(k.rayW) * perW + residual : size(k.rayW) + spread + residual * perW;
  return derived(k, rung, t, std::max(qx, qy), position, perW,
                 std::max(std::fabs(c.viewport().depthFirst), std::fabs(c.viewport().depthSecond)), g);
}

/// The library takes 2^-8 once or twice more than the derivation needs.
bool isAsDerived(double bound, double wanted) {
  return bound >= wanted * (1 - 0x1p-40) && bound <= wanted * (1 + 0x1p-6);
}

/// What a climb has met on its way.
struct Findings {
  std::size_t visited = 0;
  std::size_t unbounded = 0;         ///< no finite bound
  std::size_t otherwiseDerived = 0;  ///< another bound than that of the derivation
  std::size_t violated = 0;          ///< a bound smaller than the error
};

/// An error's share of its bound, or of the target's term of it; minus infinity where the target does not apply.
double shareOf(const State& s, const Camera& c, Precision rung, const Target& target, Findings& found) {
  const ScreenPoint got = worldToScreen(c, s.point, rung);
  if (got.status != PointStatus::inFront) return -INFINITY;
  const Truly truly(parts(c).constants, s.point);
  // Nearer to the eye plane double-double does not know the truth.
  const Vec3& eye = parts(c).constants.eye;
  if (std::fabs(truly.w.hi) < 0x1p-45 * size({s.point.x - eye.x, s.point.y - eye.y, s.point.z - eye.z}))
    return -INFINITY;
  if (!std::isfinite(truly.x.hi) || !std::isfinite(truly.y.hi) || !std::isfinite(truly.depth.hi)) return -INFINITY;
  const bool isInPicture = target.of == Of::picture;
  if (isInPicture) {
    if (!across(c.viewport(), 1).holds(truly.x.hi) || !along(c.viewport(), 1).holds(truly.y.hi)) return -INFINITY;
    const bool isInRange = truly.w.hi >= parts(c).projection.near && truly.w.hi <= parts(c).projection.far;
    if ((parts(c).projection.orthographic || target.number == Number::depth) && !isInRange) return -INFINITY;
  }
  const ErrorBound bound = isInPicture ? boundInPicture(c, rung) : boundOfPoint(c, s.point, rung);
  const bool isScreen = target.number == Number::screen;
  const double error = isScreen ? std::max(off(got.x, truly.x), off(got.y, truly.y)) : off(got.depth, truly.depth);
  const double limit = isScreen ? bound.screen : bound.depth;
  ++found.visited;
  found.violated += !(error <= limit * (1 + 0x1p-30));
  if (got.precision != rung || (isInPicture && std::isinf(limit))) {
    // Handed on: what is not bounded in the picture is bounded point by point.
    found.unbounded += !std::isfinite(boundOfPoint(c, s.point, rung).screen);
    return -INFINITY;
  }
  found.unbounded += !std::isfinite(limit);
  if (rung == Precision::exact) return limit > 0 ? error / limit : -INFINITY;
  const auto derive = [&](const Weights& g) {
    const ErrorBound b = isInPicture ? derivedInPicture(c, rung, 1, g) : derivedOfPoint(c, rung, s.point, truly, g);
    return isScreen ? b.screen : b.depth;
  };
  found.otherwiseDerived += !isAsDerived(limit, derive({}));
  if (isWhole(target)) return error / limit;
  // By the derivation's bound, not the library's: where that is too small, the climb goes beyond it.
  const double full = derive({}), term = full - derive(target.without);
  return term > 0 ? 1 - (full - error) / term : -INFINITY;
}

/// A number's neighbour, near or far.
double changed(Random& r, double a) {
  const double where = r.uniform(0, 1);
  const double part = std::ldexp(1, -int(r.uniform(0, 53)));
  if (where < 0.55) return a * (1 + r.sign() * part);
  if (where < 0.75) return std::nextafter(a, r.sign() * INFINITY);
  // Just above a power of two a rounding is largest.
  if (where < 0.9 && a != 0) return std::copysign(std::ldexp(1 + part, std::ilogb(a)), a);
  if (where < 0.95) return a * std::ldexp(1, int(r.uniform(-4, 5)));
  return where < 0.98 ? -a : a + r.sign() * part;
}

std::optional<Camera> made(const Scene& scene) {
  try {
    return build(scene);
  } catch (const CameraError&) {
    return {};
  }
}

class Climb {
 public:
  Climb(const Kind& kind, Precision rung, const Target& target, std::uint64_t seed)
      : kind_(kind), rung_(rung), target_(target), random_(seed) {
    kind.start(random_, at_.scene);
    std::optional<Camera> camera = made(at_.scene);
    for (; !camera; camera = made(at_.scene)) {
      at_.scene = {};
      kind.start(random_, at_.scene);
    }
    camera_ = *camera;
    const double distance = random_.spread(1e-2, 1e2), tangent = random_.spread(1e-4, 1e2);
    const double angle = random_.uniform(0, 6.3);
    at_.point = parts(camera_).pose.eye;
    if (kind.hasResidual && random_.chance(0.3)) {
      // The eye itself, as rounded.
    } else if (target.of == Of::picture) {
      const Viewport& v = camera_.viewport();
      const double w = random_.spread(1, 10) * std::max(1e-2, std::fabs(at_.scene.near));
      const WorldPoint p = screenToWorldAtDistance(
          camera_,
          {v.x + v.pixelCenter - 0.5 + v.width * random_.uniform(0, 1),
           v.y + v.pixelCenter - 0.5 + v.height * random_.uniform(0, 1)},
          kind.orthographic ? random_.uniform(at_.scene.near, at_.scene.far) : std::min(w, at_.scene.far));
      at_.point = p.position;
    } else if (random_.chance(0.7)) {
      // Along an axis of the world; the eye and what is off the axis are there for their roundings.
      const std::size_t axis = std::size_t(random_.uniform(0, 3));
      const double unit = rung == Precision::fast ? 0x1p-24 : 0x1p-53;
      Vec3& eye = at_.scene.position;
      for (std::size_t i = 0; i < 3; ++i) eye[i] = i == axis ? random_.sign() * random_.spread(1e-3, 1e-1) : 0;
      at_.point = eye;
      const double along =
          std::copysign(std::ldexp(1 + random_.spread(1e-4, 1e-1), 3), parts(camera_).pose.rows.forward[axis].hi);
      for (std::size_t i = 0; i < 3; ++i)
        at_.point[i] += i == axis ? along : along * unit * random_.sign() * random_.spread(0.1, 4);
      camera_ = made(at_.scene).value_or(camera_);
    } else {
      for (std::size_t i = 0; i < 3; ++i)
        at_.point[i] += distance * (parts(camera_).pose.rows.forward[i].hi +
                                    tangent * (std::cos(angle) * parts(camera_).pose.rows.right[i].hi +
                                               std::sin(angle) * parts(camera_).pose.rows.up[i].hi));
    }
    share_ = shareOf(at_, camera_, rung_, target_, found_);
  }

  /// As many steps, or until the share is enough.
  void run(std::size_t steps, double enough) {
    for (std::size_t i = 0; i < steps && share_ < enough; ++i) {
      State next = at_;
      bool isSameCamera = true;
      for (bool again = true; again; again = random_.chance(0.3)) {
        const bool isOfPoint = random_.chance(0.5);
        const std::size_t field =
            std::size_t(random_.uniform(0, double(isOfPoint ? kPoint.size() : kind_.fields.size())));
        double& number = kind_.fields[field](next);
        number = changed(random_, number);
        isSameCamera &= field < kPoint.size();
      }
      const std::optional<Camera> camera = isSameCamera ? camera_ : made(next.scene);
      if (!camera) continue;
      const double share = shareOf(next, *camera, rung_, target_, found_);
      if (!(share >= share_)) continue;
      share_ = share;
      at_ = next;
      camera_ = *camera;
    }
  }

  double share() const { return share_; }
  const State& at() const { return at_; }
  const Camera& camera() const { return camera_; }
  const Findings& findings() const { return found_; }

 private:
  const Kind& kind_;
  Precision rung_;
  const Target& target_;
  Random random_;
  State at_;
  Camera camera_ = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                              frustum(-1, 1, -1, 1, 1, 2), {100, 100});  // until there is one
  double share_ = -INFINITY;
  Findings found_;
};

/// The same share by MPFR's truth.
double shareByReference(const Climb& climb, Precision rung, const Target& target) {
  const Truth truth(climb.at().scene);
  Oracle oracle(truth, 256);
  const Oracle::Answer answer = oracle.at(climb.at().point);
  const Camera& c = climb.camera();
  const ScreenPoint got = worldToScreen(c, climb.at().point, rung);
  const ErrorBound bound = target.of == Of::picture ? boundInPicture(c, rung) : boundOfPoint(c, climb.at().point, rung);
  return target.number == Number::screen ? std::max(errorOf(got.x, answer.x), errorOf(got.y, answer.y)) / bound.screen
                                         : errorOf(got.depth, answer.depth) / bound.depth;
}

}  // namespace

TEST_CASE("The point that comes nearest to a bound keeps it and reaches it, and so does each term of the bound") {
  constexpr std::size_t kSteps = 4000;
  constexpr std::size_t kMostClimbs = 60;  // of each kind, where that many are needed
  constexpr const char* kRungNames[] = {"fast", "standard", "exact"};
  const char* wanted = std::getenv("VIEWPROJ_BOUND_CLIMBS");
  const std::size_t more = wanted ? std::strtoull(wanted, nullptr, 10) : 0;
  Findings found;
  std::size_t searches = 0;
  for (const Precision rung : {Precision::fast, Precision::standard, Precision::exact})
    for (const bool orthographic : {false, true})
      for (const Target& target : kTargets) {
        if (rung == Precision::exact && !isWhole(target)) continue;
        const double least = rung == Precision::exact ? 0.95
                             : orthographic           ? target.leastOrthographic
                                                      : target.leastPerspective;
        if (least == kNever) continue;
        const double enough = least + 0.005, most = 0.99;
        double best = -INFINITY, ofWhole = 0;
        const char* by = "";
        std::size_t made = 0;
        for (std::size_t i = 0; i < more || (i < kMostClimbs && best < enough); ++i)
          for (const Kind& kind : kKinds) {
            if (kind.orthographic != orthographic || best >= (i < more ? most : enough)) continue;
            Climb climb(kind, rung, target, ++made);
            climb.run(kSteps, i < more ? most : enough);
            found.visited += climb.findings().visited;
            found.unbounded += climb.findings().unbounded;
            found.otherwiseDerived += climb.findings().otherwiseDerived;
            found.violated += climb.findings().violated;
            if (climb.share() <= best) continue;
            best = climb.share();
            by = kind.name;
            ofWhole = shareByReference(climb, rung, target);
            INFO(kind.name << ", " << target.name << ", climb " << made);
            CHECK(ofWhole <= 1);
            if (isWhole(target)) CHECK(ofWhole == Approx(best).epsilon(1e-6));
          }
        std::printf("%-9s %-12s %-7s %-8s %-18s %.3f (%.3f of the bound), %zu climbs, %s\n", kRungNames[int(rung)],
                    orthographic ? "orthographic" : "perspective", target.number == Number::screen ? "screen" : "depth",
                    target.of == Of::point ? "point" : "picture", target.name, best, ofWhole, made, by);
        INFO(kRungNames[int(rung)] << ", " << (orthographic ? "orthographic" : "perspective") << ", "
                                   << (target.number == Number::screen ? "screen, " : "depth, ") << target.name);
        CHECK(best > least);
        ++searches;
      }
  std::printf("%zu searches, %zu points\n", searches, found.visited);
  CHECK(searches == 62);
  CHECK(found.visited > 100000);
  CHECK(found.unbounded == 0);
  CHECK(found.otherwiseDerived == 0);
  CHECK(found.violated == 0);
}

TEST_CASE("What rounding a far eye leaves over counts in the bounds of the picture") {
  for (const bool orthographic : {false, true})
    for (const Precision rung : {Precision::fast, Precision::standard})
      for (std::uint64_t trial = 0; trial < 100; ++trial) {
        Random r(trial);
        Scene s;
        viewMatrix(r, s);
        s.viewport = {100, 100};
        for (std::size_t i = 0; i < 3; ++i) s.matrix[i][3] = r.uniform(1e8, 1e9);
        s.lensKind = orthographic ? LensKind::orthographic : LensKind::frustum;
        s.near = 1e-9, s.far = 1e-8;  // nearer than the eye is known to a double
        s.left = s.bottom = -1e-9, s.right = s.top = 1e-9;
        const Camera c = build(s);
        const ErrorBound bound = boundInPicture(c, rung), wanted = derivedInPicture(c, rung, 1, {});
        const ErrorBound without = derivedInPicture(c, rung, 1, {.residual = 0});
        if (std::isinf(bound.screen)) continue;
        CHECK(isAsDerived(bound.screen, wanted.screen));
        CHECK(wanted.screen > 1.05 * without.screen);
      }
}

namespace {

/// The angle between a ray's direction in standard and the true one, by double-double.
double rayAngle(const State& s, const Camera& c) {
  const ScreenMap& m = parts(c).screen;
  const Axes& a = parts(c).pose.columns;
  const DoubleDouble right = (DoubleDouble(s.point.x) - m.centerX) / m.scaleX;
  const DoubleDouble up = (DoubleDouble(s.point.y) - m.centerY) / m.scaleY;
  const DDVec3 truth = normalized(a.forward + a.right * right + a.up * up);
  const Vec3 got = screenToRay(c, {s.point.x, s.point.y}, Precision::standard).direction;
  Vec3 wrong;
  for (std::size_t i = 0; i < 3; ++i) wrong[i] = (got[i] - truth[i].hi) - truth[i].lo;
  return std::hypot(wrong.y * truth.z.hi - wrong.z * truth.y.hi, wrong.z * truth.x.hi - wrong.x * truth.z.hi,
                    wrong.x * truth.y.hi - wrong.y * truth.x.hi);
}

}  // namespace

TEST_CASE("The ray that comes nearest to its bound keeps it") {
  // Five roundings of a component, whose sizes are together at most sqrt(3) of the length, and that of the direction.
  CHECK(kRayDirectionBound >= (5 * std::sqrt(3.0) + 1) * 0x1p-53);
  double best = 0;
  std::size_t rays = 0;
  for (std::uint64_t trial = 0; trial < 40; ++trial)
    for (const Kind& kind : kKinds) {
      if (kind.orthographic) continue;
      Random r(trial);
      State at;
      kind.start(r, at.scene);
      const std::optional<Camera> start = made(at.scene);
      if (!start || std::fabs(at.scene.viewport.x) > 1e6) continue;  // whose centre double-double does not know enough
      Camera camera = *start;
      const Viewport& v = camera.viewport();
      at.point = {v.x + v.width * r.uniform(0, 1), v.y + v.height * r.uniform(0, 1), 0};
      double angle = rayAngle(at, camera);
      for (int i = 0; i < 2000; ++i) {
        State next = at;
        const bool isPixel = r.chance(0.5);
        double& number = kind.fields[std::size_t(r.uniform(0, isPixel ? 2 : double(kind.fields.size())))](next);
        number = changed(r, number);
        const std::optional<Camera> other = isPixel ? camera : made(next.scene);
        if (!other) continue;
        const double now = rayAngle(next, *other);
        ++rays;
        if (!(now >= angle)) continue;
        angle = now;
        at = next;
        camera = *other;
      }
      const std::array<TrueNumber, 3> truth = Oracle(Truth(at.scene), 256).direction({at.point.x, at.point.y});
      const Vec3 got = screenToRay(camera, {at.point.x, at.point.y}, Precision::standard).direction;
      Vec3 wrong;
      for (std::size_t i = 0; i < 3; ++i) wrong[i] = (got[i] - truth[i].hi) - truth[i].lo;
      const double proven =
          std::hypot(wrong.y * truth[2].hi - wrong.z * truth[1].hi, wrong.z * truth[0].hi - wrong.x * truth[2].hi,
                     wrong.x * truth[1].hi - wrong.y * truth[0].hi);
      INFO(kind.name << ", trial " << trial);
      CHECK(proven <= kRayDirectionBound);
      CHECK(proven == Approx(angle).margin(1e-17));
      best = std::max(best, proven);
    }
  std::printf("rays: %zu, off by up to %.3g radians, %.3f of the bound\n", rays, best, best / kRayDirectionBound);
  CHECK(best > 0.25 * kRayDirectionBound);
}

TEST_CASE(
    "Depths next to the smallest double are within their bound in every precision, and nearest where exact says") {
  std::size_t subnormal = 0, wrong = 0, certain = 0;
  for (std::uint64_t trial = 0; trial < 4000; ++trial) {
    Random r(trial);
    Scene s;
    anyPose(r, s);
    s.position = {0, 0, 0};
    s.convention.reverseZ = true;
    s.viewport.depthFirst = 0;
    Vec3 point = r.vector(r.spread(1e-3, 1e6));
    if (trial % 4 == 0) {
      s.near = r.spread(1e-310, 1e-300), s.far = kInfiniteFar;
    } else if (trial % 4 == 1) {  // with an exact distance
      s.target = {0, 0, -1}, s.up = {0, 1, 0};
      parallel(r, s);
      s.near = -1, s.far = 0;
      point.z = r.spread(1e-322, 1e-290);
    } else if (trial % 4 == 2) {
      s.viewport.depthSecond = r.spread(1e-270, 1e-260);
      s.target = {0, 0, -1}, s.up = {0, 1, 0};
      parallel(r, s);
      s.near = -1, s.far = 0;
      point.z = r.spread(1e-60, 1e-40);
    } else {
      s.viewport.depthSecond = r.spread(1e-270, 1e-260);
      s.near = r.spread(1e-60, 1e-40), s.far = kInfiniteFar;
    }
    const Camera camera = build(s);
    const Oracle::Answer truth = Oracle(Truth(s), 400).at(point);
    if (!truth.inFront || truth.undecided) continue;
    subnormal += std::fabs(truth.depth.hi) < 0x1p-1022;
    for (const Precision rung : {Precision::fast, Precision::standard, Precision::exact}) {
      const ScreenPoint got = worldToScreen(camera, point, rung);
      std::vector<Vec3> batch(1);
      const BatchCounts counts = worldToScreen(camera, std::span(&point, 1), std::span(batch), rung);
      const double error = errorOf(got.depth, truth.depth), bound = boundOfPoint(camera, point, rung).depth;
      INFO("trial " << trial << ", precision " << int(rung) << ", depth " << truth.depth.hi);
      CHECK(error <= bound);
      CHECK(bound > 0);
      CHECK(batch[0].z == got.depth);
      if (rung == Precision::exact && (got.certain || counts.escalated == 0)) {
        CHECK(batch[0].z == truth.depth.hi);
        ++certain;
      }
      wrong += error > 0;
    }
  }
  CAPTURE(subnormal, wrong, certain);
  CHECK(subnormal > 1000);
  CHECK(wrong > 100);
  CHECK(certain > 100);
}
