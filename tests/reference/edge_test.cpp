// A search for a camera and a point that exact gets wrong, over all exponents that a camera's numbers may have, and for
// points over all that doubles have.
#include <cfloat>
#include <cstdlib>
#include <map>
#include <memory>
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

constexpr mpfr_prec_t kBits = 3000;
/// Of numbers that cancel to what 3000 bits leave of them.
constexpr mpfr_prec_t kManyBits = 20000;

std::uint64_t camerasWanted() {
  const char* wanted = std::getenv("VIEWPROJ_EDGE_CAMERAS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 2000;
}

class WithBits {
 public:
  explicit WithBits(mpfr_prec_t bits) : before_(Real::bits) { Real::bits = bits; }
  ~WithBits() { Real::bits = before_; }
  WithBits(const WithBits&) = delete;
  WithBits& operator=(const WithBits&) = delete;

 private:
  mpfr_prec_t before_;
};

/// A camera's numbers lie between 2^-298 and 2^298, a point's may be smaller.
constexpr int kMost = 298;

/// Numbers of exponents up to spread around a middle, and those that are special.
struct Exponents {
  Random& random;
  int spread, middle;
  int least = -kMost;

  double number() const {
    if (random.chance(0.12)) {
      const double special[] = {0.0, -0.0, kSmallestNumber, -kSmallestNumber, DBL_MIN, 1, -1, 2, 0.5};
      const double value = random.pick(special);
      return std::fabs(value) <= kSmallestNumber && spread < 150 ? 0 : least == -kMost && value == DBL_MIN ? 0 : value;
    }
    if (spread > 200 && random.chance(0.03))
      return random.sign() * (random.chance(0.5) ? kLargestNumber : kLargestNumber / 4);
    const double mantissa = random.chance(0.25) ? 1 : random.uniform(1, 2);
    const int exponent = middle + static_cast<int>(random.uniform(-spread, spread));
    return random.sign() * std::ldexp(mantissa, std::clamp(exponent, least, kMost));
  }
  double positive() const {
    const double value = std::fabs(number());
    return value == 0 ? 1 : value;
  }
  Vec3 vector() const { return {number(), number(), number()}; }
};

/// Most groups of numbers are those of a plain camera, and one or the other goes to the edge; of some cameras all do.
struct Drawing {
  Random& random;
  bool all;

  Exponents exponents(double share) const {
    const int spreads[] = {20, 60, 120, 200, 298};
    if (!all && !random.chance(share)) return {random, 8, 0};
    const int spread = random.pick(spreads);
    const int middle = random.chance(0.5) ? 0 : static_cast<int>(random.uniform(-250, 250));
    return {random, spread, middle};
  }
};

double nextTo(Random& r, double value) {
  return r.chance(0.5) ? std::nextafter(value, INFINITY) : std::nextafter(value, -INFINITY);
}

/// A rotation matrix, or one of axes with what may be next to them.
void drawMatrix(Random& r, const Exponents& size, Scene& s) {
  const bool fits = s.convention.world == Handedness::right;
  s.axes =
      fits ? (r.chance(0.5) ? CameraAxes::RUB : CameraAxes::RDF) : (r.chance(0.5) ? CameraAxes::RUF : CameraAxes::FRU);
  if (r.chance(0.4)) {
    const Pose pose = poseFromRotation({}, {r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1)},
                                       CameraAxes::RUB, Handedness::right);
    const DDVec3 columns[] = {parts(pose).columns.right, parts(pose).columns.up, -parts(pose).columns.forward};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) s.matrix[i][j] = columns[j][i].hi;
  } else {
    const std::size_t turn = static_cast<std::size_t>(r.uniform(0, 3));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double off = size.number();
        s.matrix[i][j] = (i + turn) % 3 == j ? 1 : std::fabs(off) < 1e-4 ? off : std::ldexp(off, -298) * 1e-6;
      }
  }
  const Vec3 translation = size.vector();
  for (std::size_t i = 0; i < 3; ++i) s.matrix[i][3] = translation[i];
  s.matrix[3] = {0, 0, 0, 1};
}

void drawPose(Random& r, const Drawing& draw, Scene& s) {
  s.poseKind = r.pick(kPoseKinds);
  const Exponents place = draw.exponents(0.4), way = r.chance(0.5) ? place : draw.exponents(0.5);
  const Exponents up = draw.exponents(0.4);
  s.position = place.vector();
  if (r.chance(0.2)) s.position = {};
  s.target = way.vector();
  s.up = up.vector();
  if (s.poseKind == PoseKind::target && r.chance(0.3))
    for (std::size_t i = 0; i < 3; ++i)
      if (r.chance(0.6)) s.target[i] = r.chance(0.5) ? s.position[i] : nextTo(r, s.position[i]);
  if (r.chance(0.25)) {  // nearly parallel
    for (std::size_t i = 0; i < 3; ++i)
      s.up[i] = s.poseKind == PoseKind::target ? s.target[i] - s.position[i] : s.target[i];
    const std::size_t moved = static_cast<std::size_t>(r.uniform(0, 3));
    s.up[moved] = r.chance(0.5) ? nextTo(r, s.up[moved]) : up.number();
  }
  s.rotation = {way.number(), way.number(), way.number(), way.number()};
  const bool isMatrix = s.poseKind == PoseKind::worldFromCamera || s.poseKind == PoseKind::cameraFromWorld;
  if (isMatrix || s.poseKind == PoseKind::rotation) drawMatrix(r, place, s);
}

void drawLens(Random& r, const Drawing& draw, Scene& s) {
  s.lensKind = r.pick(kLensKinds);
  const Exponents depth = draw.exponents(0.4), window = draw.exponents(0.35);
  s.near = depth.positive(), s.far = depth.positive();
  if (s.near > s.far && !r.chance(0.02)) std::swap(s.near, s.far);
  if (r.chance(0.1)) s.far = nextTo(r, s.near);
  if (r.chance(0.2)) s.far = kInfiniteFar;
  const double fovs[] = {1e-6, 1e-3, 60, 90, 179.9, 179.999999, 1e-60, 1e-86, 180 - 3e-14};
  s.fov = r.chance(0.5) ? r.pick(fovs) : r.uniform(1, 179);
  s.sensorWidth = window.positive(), s.sensorHeight = window.positive(), s.focalLength = window.positive();
  const auto edges = [&](double& low, double& high) {
    low = window.number(), high = window.number();
    if (r.chance(0.5)) low = -high;
    if (r.chance(0.1)) high = nextTo(r, low);
    if (low > high) std::swap(low, high);
  };
  edges(s.left, s.right);
  edges(s.bottom, s.top);
  if (s.lensKind == LensKind::frustum && r.chance(0.6))
    for (double* edge : {&s.left, &s.right, &s.bottom, &s.top}) *edge *= s.near;
  if (s.lensKind == LensKind::nearSize) s.right = window.positive() * s.near, s.top = window.positive() * s.near;
  if (s.lensKind == LensKind::orthographic) {
    s.near = depth.number(), s.far = depth.number();
    if (r.chance(0.3)) s.near = -s.far;
    if (s.near > s.far) std::swap(s.near, s.far);
  }
  const Exponents port = draw.exponents(0.2);
  Viewport& v = s.viewport;
  if (draw.all || r.chance(0.3)) {
    v = {port.positive(), port.positive()};
    if (r.chance(0.5)) v.x = port.number(), v.y = port.number();
    if (r.chance(0.3)) v.pixelCenter = port.number();
  } else if (r.chance(0.3)) {
    v = {100, 100};
  }
  if (r.chance(0.2)) v.pixelCenter = 0;
  if (r.chance(0.5)) v.origin = Origin::bottomLeft;
  if (r.chance(0.2)) {
    const Exponents range = draw.exponents(0.3);
    v.depthFirst = range.number(), v.depthSecond = range.number();
  }
  s.fx = window.positive(), s.fy = window.positive();
  if (r.chance(0.5)) s.fx *= v.width, s.fy *= v.height;
  s.cx = r.chance(0.5) ? v.x + v.width / 2 : window.number();
  s.cy = r.chance(0.5) ? v.y + v.height / 2 : window.number();
  if (r.chance(0.2)) s.shiftX = draw.exponents(0.3).number(), s.shiftY = draw.exponents(0.3).number();
  if (r.chance(0.15)) {
    s.hasCrop = true;
    s.crop = {v.width * r.uniform(0, 1), v.height * r.uniform(0, 1), v.width * r.spread(1e-12, 1),
              v.height * r.spread(1e-12, 1)};
    if (r.chance(0.2)) s.crop.width = port.positive(), s.crop.x = port.number();
  }
}

Scene edgeScene(Random& r) {
  Scene s;
  const auto presets = conventionPresets();
  s.convention = presets[static_cast<std::size_t>(r.uniform(0, double(presets.size())))].convention;
  if (r.chance(0.3)) s.convention.reverseZ = !s.convention.reverseZ;
  const Drawing draw{r, r.chance(0.15)};
  drawPose(r, draw, s);
  drawLens(r, draw, s);
  return s;
}

Vec3 toDoubles(const Real3& p) { return {double(p[0]), double(p[1]), double(p[2])}; }

enum PointKind { inView, onPlane, nextToEye, atTarget, inEyePlane, alongAxis, anywhere, kPointKinds };

Vec3 pointOfKind(Random& r, int kind, const Scene& s, const Truth& truth, const Camera& camera) {
  const Exponents any{r, 700, -400, -1074};
  const Vec3& eye = parts(camera).pose.eye;
  const Viewport& v = camera.viewport();
  const auto pixel = [&](double start, double size) {
    const double share = r.chance(0.2) ? std::floor(r.uniform(0, 2)) : r.uniform(0, 1);
    return start + size * share;
  };
  const double far = std::isinf(s.far) ? s.near * 1e6 : s.far;
  double distance = s.near + (far - s.near) * r.uniform(0, 1);
  switch (kind) {
    case inView:
      if (s.lensKind != LensKind::orthographic && r.chance(0.5)) distance = r.spread(s.near, std::min(far, DBL_MAX));
      return toDoubles(truth.pointAt(truth.window(pixel(v.x, v.width), pixel(v.y, v.height)), distance));
    case onPlane: {
      const Vec3 p = toDoubles(truth.pointAt(truth.window(pixel(v.x, v.width), pixel(v.y, v.height)),
                                             r.chance(0.5) ? s.near : std::min(far, DBL_MAX)));
      return r.chance(0.5) ? p : Vec3{nextTo(r, p.x), p.y, p.z};
    }
    case nextToEye: {
      Vec3 p = eye;
      for (std::size_t i = 0; i < 3; ++i) {
        if (r.chance(0.3)) p[i] = nextTo(r, p[i]);
        if (r.chance(0.3)) p[i] += Exponents{r, 40, -1040, -1074}.number();
        if (r.chance(0.2)) p[i] += any.number();
      }
      return p;
    }
    case atTarget: {
      Vec3 p = s.target;
      if (r.chance(0.5)) p[static_cast<std::size_t>(r.uniform(0, 3))] = any.number();
      return p;
    }
    case inEyePlane: {
      const Real a = any.number(), b = any.number();
      const Vec3 p = toDoubles(truth.pose.eye + truth.pose.rightColumn * a + truth.pose.upColumn * b);
      return r.chance(0.5) ? p : Vec3{p.x, nextTo(r, p.y), p.z};
    }
    case alongAxis: {
      const Real3* axes[] = {&truth.pose.rightColumn, &truth.pose.upColumn, &truth.pose.forwardColumn};
      return toDoubles(truth.pose.eye + *r.pick(axes) * Real(any.number()));
    }
    default:
      return r.chance(0.5) ? any.vector() : Exponents{r, 20, static_cast<int>(r.uniform(-1060, 300)), -1074}.vector();
  }
}

struct Worst {
  double ulp = 0, uncertainUlp = 0, share[2] = {}, ray = 0, exactRay = 0;
};

struct Tally {
  std::map<std::string, int> refused;
  std::map<int, int> byPose, byLens, byKind;
  std::uint64_t accepted = 0, points = 0, certain = 0, uncertain = 0, behind = 0, beyondDoubles = 0, visible = 0,
                inPicture = 0, rungs[2] = {}, rays = 0, manyBits = 0, directions = 0, outOfRange = 0;
  std::uint64_t failures = 0;
};

class Search {
 public:
  Search(std::uint64_t trial, Tally& tally, Worst& worst)
      : trial_(trial), random_(trial + 90000000), tally_(tally), worst_(worst) {}

  void run() {
    scene_ = edgeScene(random_);
    try {
      camera_ = build(scene_);
    } catch (const CameraError& error) {
      ++tally_.refused[error.field()];
      return;
    }
    ++tally_.accepted;
    ++tally_.byPose[int(scene_.poseKind)];
    ++tally_.byLens[int(scene_.lensKind)];
    truth_ = std::make_unique<Truth>(scene_);
    std::vector<Vec3> points;
    for (int i = 0; i < 7; ++i) {
      const Vec3 p = pointOfKind(random_, i, scene_, *truth_, camera_);
      if (!isFinite(p)) continue;
      ++tally_.byKind[i];
      points.push_back(p);
      project(p);
    }
    checkBatches(points);
    for (int i = 0; i < 2; ++i) castRay();
    homogeneous(random_.chance(0.5) ? 0 : Exponents{random_, 298, 0}.number());
  }

 private:
  void fail(const std::string& what, const Vec4& p) {
    if (++tally_.failures > 200) return;
    char text[400];
    std::snprintf(text, sizeof text,
                  "trial %llu, point %a %a %a %a (%.17g %.17g %.17g): ", static_cast<unsigned long long>(trial_), p.x,
                  p.y, p.z, p.w, p.x, p.y, p.z);
    UNSCOPED_INFO(text << what << "\n  " << describe(scene_));
    std::fprintf(stderr, "%s%s\n  %s\n", text, what.c_str(), describe(scene_).c_str());
  }

  /// The truth in as many bits as it takes.
  struct Answer {
    Truth::View view;
    Truth::Screen screen;
    bool hasScreen;
  };
  Answer answer(const Vec4& p) {
    const auto in = [&](const Truth& truth) {
      const Real3 xyz{p.x, p.y, p.z};
      const Real3 d = p.w == 0 ? xyz : xyz * (Real(1) / Real(p.w)) - truth.pose.eye;
      Answer a{{dot(truth.pose.right, d), dot(truth.pose.up, d), dot(truth.pose.forward, d)}, {}, false};
      return std::pair{a, d};
    };
    auto [a, d] = in(*truth_);
    const auto cancels = [&](const Real3& axis, const Real& value, const Real3& offset, int bits) {
      // The eye of a view matrix is a sum itself.
      const Real sizes =
          abs(axis[0] * offset[0]) + abs(axis[1] * offset[1]) + abs(axis[2] * offset[2]) + length(truth_->pose.eye);
      return !(abs(value) > sizes * power(-bits));
    };
    const TruePose& pose = truth_->pose;
    if (cancels(pose.forward, a.view.forward, d, 2700) || cancels(pose.right, a.view.right, d, 2700) ||
        cancels(pose.up, a.view.up, d, 2700)) {
      ++tally_.manyBits;
      const WithBits many(kManyBits);
      if (!finer_) finer_ = std::make_unique<Truth>(scene_);
      std::tie(a, d) = in(*finer_);
      const TruePose& fine = finer_->pose;
      if (cancels(fine.forward, a.view.forward, d, 19000)) a.view.forward = 0;
      if (cancels(fine.right, a.view.right, d, 19000)) a.view.right = 0;
      if (cancels(fine.up, a.view.up, d, 19000)) a.view.up = 0;
      finish(a, *finer_, p.w == 0);
    } else {
      finish(a, *truth_, p.w == 0);
    }
    return a;
  }
  static Real power(int exponent) {
    Real r = 1;
    for (int left = exponent; left < 0; left += 1000) r = r * Real(std::ldexp(1, std::max(left, -1000)));
    return r;
  }
  void finish(Answer& a, const Truth& truth, bool isDirection) const {
    a.hasScreen = truth.lens.orthographic ? !isDirection : a.view.forward > Real(0);
    if (a.hasScreen) a.screen = truth.screen(a.view);
  }

  static std::string exactly(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%a", value);
    return text;
  }

  /// What is left of the last of 3000 bits may decide a tie.
  static bool isNearest(double got, const Real& truth) {
    const double nearest = double(truth);
    if (got == nearest) return true;
    return distance(got, truth) > 0 && std::isfinite(nearest) &&
           abs(abs(Real(got) - truth) - abs(Real(nearest) - truth)) < abs(truth) * power(-2000);
  }

  /// isBounded: whether the bound has to be a number.
  void number(const char* name, double got, const Real& truth, bool certain, double bound, bool isBounded, int rung,
              const Vec4& p) {
    const double nearest = double(truth);
    if (certain) {
      if (!isNearest(got, truth))
        fail(std::string(name) + " is certain and not the nearest double: " + exactly(got) + ", " + exactly(nearest),
             p);
      if (!std::isfinite(bound)) fail(std::string(name) + " is certain and has no bound", p);
    }
    if (std::isinf(nearest)) {
      ++tally_.beyondDoubles;
      return;
    }
    if (std::isnan(got)) return fail(std::string(name) + " is missing", p);
    const double off = distance(got, truth);
    if (rung == 2) {
      double& worst = certain ? worst_.ulp : worst_.uncertainUlp;
      worst = std::max(worst, std::min(ulps(got, truth), certain && isNearest(got, truth) ? 0.5 : 1e300));
    }
    if (std::isfinite(bound) && bound > 0) worst_.share[rung] = std::max(worst_.share[rung], off / bound);
    if (!(off <= bound)) fail(std::string(name) + " is " + std::to_string(off / bound) + " bounds off", p);
    if (isBounded && !std::isfinite(bound)) fail(std::string(name) + " has no bound", p);
  }

  /// Beyond which sides the true position lies; may: so near a boundary that either is right.
  void sides(const ScreenPoint& got, const Answer& a, const ErrorBound& bound, const Vec4& p) {
    const Viewport& v = camera_.viewport();
    const Real half = Real(v.pixelCenter) - Real(0.5);
    const bool down = v.origin == Origin::topLeft;
    const auto side = [&](const Real& from, const Real& to, double slack, int flag, const char* name) {
      const bool isOutside = (got.outside & flag) != 0;
      if (to - from > Real(slack) && !isOutside) fail(std::string(name) + " was not seen to be left", p);
      if (from - to > Real(slack) && isOutside) fail(std::string(name) + " was not left", p);
    };
    const auto slackAt = [&](double start, double size, double b) {
      return b + 8 * DBL_EPSILON * (std::fabs(start) + size + std::fabs(v.pixelCenter) + 0.5);
    };
    const double sx = slackAt(v.x, v.width, bound.screen), sy = slackAt(v.y, v.height, bound.screen);
    const Real left = Real(v.x) + half, start = Real(v.y) + half;
    const int first = down ? sideTop : sideBottom, last = down ? sideBottom : sideTop;
    side(a.screen.x, left, sx, sideLeft, "left");
    side(left + Real(v.width), a.screen.x, sx, sideRight, "right");
    side(a.screen.y, start, sy, first, "first row");
    side(start + Real(v.height), a.screen.y, sy, last, "last row");
    if (p.w == 0) return;
    const double w = double(a.view.forward);
    const double slack = got.certain ? 0 : std::fabs(w) * 0x1p-50 + 1e-25 * std::fabs(scene_.near) + DBL_TRUE_MIN;
    if (got.certain && ((w < scene_.near) != ((got.outside & sideNear) != 0))) fail("near", p);
    if (got.certain && ((w > scene_.far) != ((got.outside & sideFar) != 0))) fail("far", p);
    if (!got.certain && got.precision == Precision::exact) {
      side(a.view.forward, scene_.near, slack, sideNear, "near");
      if (std::isfinite(scene_.far)) side(scene_.far, a.view.forward, slack, sideFar, "far");
    }
  }

  void check(const ScreenPoint& got, const Answer& a, const ErrorBound& bound, const Vec4& p) {
    const int rung = int(got.precision);
    ++tally_.rungs[rung];
    const bool isExact = got.precision == Precision::exact;
    const bool certain = isExact && got.certain;
    const bool isDirection = p.w == 0;
    if (!isDirection && isExact) {
      const double nearest = double(a.view.forward);
      if (certain && !isNearest(got.viewDistance, a.view.forward))
        fail("viewDistance is certain and not the nearest double: " + exactly(got.viewDistance) + ", " +
                 exactly(nearest),
             p);
      if (std::isfinite(nearest) && !certain &&
          !(ulps(got.viewDistance, a.view.forward) <= 1.01 ||
            distance(got.viewDistance, a.view.forward) <= 1e-26 * std::fabs(scene_.near)))
        fail("viewDistance is far off: " + std::to_string(got.viewDistance) + ", " +
                 std::to_string(double(a.view.forward)),
             p);
    }
    if (!a.hasScreen) {
      const PointStatus want = truth_->lens.orthographic ? PointStatus::atInfinity : PointStatus::behind;
      if (got.status != want) fail("is behind, and not said to be", p);
      return;
    }
    if (got.status != PointStatus::inFront) return fail("is in front, and not said to be", p);
    const bool isBounded = isExact && std::isfinite(double(a.screen.x)) && std::isfinite(double(a.screen.y));
    number("x", got.x, a.screen.x, certain, bound.screen, isBounded, rung, p);
    number("y", got.y, a.screen.y, certain, bound.screen, isBounded, rung, p);
    if (!isDirection) number("depth", got.depth, a.screen.depth, certain, bound.depth, isExact, rung, p);
    sides(got, a, bound, p);
  }

  void project(const Vec3& point) {
    const Vec4 p{point.x, point.y, point.z, 1};
    if (isOutOfRange(worldToScreen(camera_, point), p)) return;
    const Answer a = answer(p);
    ++tally_.points;
    for (Precision precision : {Precision::standard, Precision::exact}) {
      const ScreenPoint got = worldToScreen(camera_, point, precision);
      const ErrorBound bound = boundOfPoint(camera_, point, got.precision);
      check(got, a, bound, p);
      if (precision == Precision::exact) {
        ++(got.certain ? tally_.certain : tally_.uncertain);
        if (got.status == PointStatus::behind) ++tally_.behind;
        if (got.visible()) ++tally_.visible;
      }
      if (a.hasScreen) inPicture(got, a, precision, p);
    }
  }

  /// The picture's bound holds for what lies in it.
  void inPicture(const ScreenPoint& got, const Answer& a, Precision precision, const Vec4& p) {
    const Viewport& v = camera_.viewport();
    const Real half = Real(v.pixelCenter) - Real(0.5);
    const Real x = a.screen.x - Real(v.x) - half, y = a.screen.y - Real(v.y) - half;
    const Real w = a.view.forward;
    if (x < Real(0) || y < Real(0) || x > Real(v.width) || y > Real(v.height) || w < Real(scene_.near)) return;
    if (std::isfinite(scene_.far) && w > Real(scene_.far)) return;
    ++tally_.inPicture;
    const ErrorBound bound = boundInPicture(camera_, got.precision == precision ? precision : Precision::exact);
    if (!(distance(got.x, a.screen.x) <= bound.screen && distance(got.y, a.screen.y) <= bound.screen))
      fail("the picture's bound is exceeded in precision " + std::to_string(int(precision)), p);
    if (!(distance(got.depth, a.screen.depth) <= bound.depth))
      fail("the picture's bound of depth is exceeded in precision " + std::to_string(int(precision)), p);
  }

  void checkBatches(const std::vector<Vec3>& points) {
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    for (Precision precision : {Precision::standard, Precision::exact}) {
      std::vector<Vec3> numbers(points.size());
      std::vector<ScreenPoint> full(points.size());
      worldToScreen(camera_, points, std::span(numbers), precision);
      worldToScreen(camera_, points, std::span(full), precision);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const ScreenPoint one = worldToScreen(camera_, points[i], precision);
        const Vec4 p{points[i].x, points[i].y, points[i].z, 1};
        if (!(same(numbers[i].x, one.x) && same(numbers[i].y, one.y) && same(numbers[i].z, one.depth)))
          fail("a batch is not what its points are, precision " + std::to_string(int(precision)), p);
        if (!(same(full[i].x, one.x) && same(full[i].viewDistance, one.viewDistance) && full[i].status == one.status &&
              full[i].outside == one.outside && full[i].certain == one.certain))
          fail("a full batch is not what its points are, precision " + std::to_string(int(precision)) + ": " +
                   exactly(full[i].viewDistance) + (full[i].certain ? " certain, " : ", ") + exactly(one.viewDistance) +
                   (one.certain ? " certain" : ""),
               p);
      }
    }
  }

  void homogeneous(double w) {
    const Vec3 xyz = Exponents{random_, 700, -400, -1074}.vector();
    const Vec4 p{xyz.x, xyz.y, xyz.z, w};
    if (maxAbs(xyz) == 0 && w == 0) return;
    ++tally_.directions;
    const ScreenPoint got = worldToScreen(camera_, p);
    if (isOutOfRange(got, p)) return;
    check(got, answer(p), boundOfPoint(camera_, p, Precision::exact), p);
  }
  /// And is seen to be.
  bool isOutOfRange(const ScreenPoint& got, const Vec4& p) {
    const bool isIn = isInDomain(parts(camera_).pose.eye, p);
    if (isIn == (got.status == PointStatus::outOfRange)) fail("the range of points", p);
    if (!isIn) ++tally_.outOfRange;
    return !isIn;
  }
  void castRay() {
    const Viewport& v = camera_.viewport();
    const Vec2 pixel{v.x + v.width * random_.uniform(0, 1), v.y + v.height * random_.uniform(0, 1)};
    if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return;
    const Vec4 p{pixel.x, pixel.y, 0, 0};
    const Truth::Window window = truth_->window(pixel.x, pixel.y);
    const Real3 direction = unit(truth_->direction(window));
    const Real3 origin = truth_->lens.orthographic ? truth_->pointAt(window, 0) : truth_->pose.eye;
    ++tally_.rays;
    const Ray exact = screenToRay(camera_, pixel, Precision::exact);
    const Ray standard = screenToRay(camera_, pixel, Precision::standard);
    Vec3 batch;
    screenToRayDirections(camera_, std::span(&pixel, 1), std::span(&batch, 1));
    for (const Vec3& got : {exact.direction, standard.direction, batch}) {
      const double off = isFinite(got) ? angle(toReal(got), direction) : INFINITY;
      worst_.ray = std::max(worst_.ray, off);
      if (!(off <= kRayDirectionBound)) fail("a ray is off by " + std::to_string(off / kRayDirectionBound), p);
    }
    const double size = double(length(origin - truth_->pose.eye)) + maxAbs(parts(camera_).pose.eye);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!isExact(exact.direction[k], direction[k], 1e-3)) fail("a direction is not exact", p);
      if (std::isfinite(double(origin[k])) && !isExact(exact.origin[k], origin[k], std::min(size, DBL_MAX)))
        fail("an origin is not exact", p);
    }
  }

  std::uint64_t trial_;
  Random random_;
  Tally& tally_;
  Worst& worst_;
  Scene scene_;
  Camera camera_ = makeCamera(lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
                              frustum(-1, 1, -1, 1, 1, 2), {100, 100});  // until there is one
  std::unique_ptr<Truth> truth_, finer_;
};

}  // namespace

TEST_CASE("No camera and no point makes exact certain of a wrong number, or a bound untrue") {
  const WithBits bits(kBits);
  const std::uint64_t wanted = camerasWanted();
  const char* first = std::getenv("VIEWPROJ_EDGE_FIRST");
  const std::uint64_t from = first ? std::strtoull(first, nullptr, 10) : 0;
  Tally tally;
  Worst worst;
  for (std::uint64_t trial = from; trial < from + wanted; ++trial) Search(trial, tally, worst).run();
  std::printf("cameras %llu, accepted %llu; refused for", static_cast<unsigned long long>(wanted),
              static_cast<unsigned long long>(tally.accepted));
  for (const auto& [field, count] : tally.refused) std::printf(" %s %d,", field.c_str(), count);
  std::printf(
      "\npoints %llu (certain %llu, uncertain %llu, behind %llu, visible %llu, in the picture %llu), numbers beyond "
      "doubles %llu, homogeneous %llu, rays %llu, in %d bits %llu\n",
      static_cast<unsigned long long>(tally.points), static_cast<unsigned long long>(tally.certain),
      static_cast<unsigned long long>(tally.uncertain), static_cast<unsigned long long>(tally.behind),
      static_cast<unsigned long long>(tally.visible), static_cast<unsigned long long>(tally.inPicture),
      static_cast<unsigned long long>(tally.beyondDoubles), static_cast<unsigned long long>(tally.directions),
      static_cast<unsigned long long>(tally.rays), int(kManyBits), static_cast<unsigned long long>(tally.manyBits));
  std::printf(
      "rungs: standard %llu, exact %llu; worst: certain %.4f ulp, uncertain %.3g ulp; share of the "
      "bound: standard %.3f, exact %.3f; ray %.3g\n",
      static_cast<unsigned long long>(tally.rungs[0]), static_cast<unsigned long long>(tally.rungs[1]), worst.ulp,
      worst.uncertainUlp, worst.share[0], worst.share[1], worst.ray);
  CHECK(tally.failures == 0);
  CHECK(worst.ulp <= 0.5);
  CHECK(tally.accepted > wanted / 2);
  CHECK(tally.certain > tally.points / 2);
  CHECK(tally.behind > tally.points / 20);
  CHECK(tally.visible > tally.points / 50);
  CHECK(tally.inPicture > tally.points / 1000);
  for (const std::uint64_t rung : tally.rungs) CHECK(rung > tally.points / 50);
  CHECK(tally.byPose.size() == std::size(kPoseKinds));
  CHECK(tally.byLens.size() == std::size(kLensKinds));
}
