// No result is farther from the truth than its bound: every family, every rung, and at the end a few points that need
// each of its terms.
//
// The number of points: VIEWPROJ_BOUND_POINTS in the environment.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

#include "catch.hpp"
#include "internals.hpp"
#include "kernels.hpp"
#include "reference/bounds/families.hpp"
#include "reference/bounds/oracle.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

constexpr Precision kRungs[] = {Precision::standard, Precision::exact};
constexpr const char* kRungNames[] = {"standard", "exact"};
constexpr std::size_t kRungCount = 2, kExact = 1;
constexpr std::size_t kPointsOfCamera = 200;
constexpr int kRaysOfCamera = 8;

std::size_t pointsWanted() {
  const char* wanted = std::getenv("VIEWPROJ_BOUND_POINTS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 250000;
}

std::string text(const char* format, auto... values) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

std::string exactText(const Vec3& v) { return text("(%a %a %a)", v.x, v.y, v.z); }

/// Errors of one point in one precision.
struct Errors {
  double x, y, depth;
  double screen() const { return std::max(x, y); }
};

Errors errorsOf(double x, double y, double depth, const Oracle::Answer& truth) {
  return {errorOf(x, truth.x), errorOf(y, truth.y), errorOf(depth, truth.depth)};
}

struct Tally {
  std::size_t points = 0, inPicture = 0, behind = 0, onEyePlane = 0, uncertain = 0, overflowed = 0;
  std::size_t undecided = 0;
  std::size_t inRung[kRungCount] = {};  ///< not handed on to exact
};

class Trial {
 public:
  Trial(const Family& family, std::uint64_t seed)
      : family_(family),
        seed_(seed),
        random_(seed),
        scene_(sceneOf(family, random_)),
        truth_(scene_),
        camera_(build(scene_)),
        oracle_(truth_) {
    for (std::size_t i = 0; i < kRungCount; ++i) inPicture_[i] = boundInPicture(camera_, kRungs[i]);
  }

  void run(Tally& tally, std::size_t count) {
    std::vector<Vec3> points(count);
    for (Vec3& point : points) point = family_.point(random_, scene_, camera_);
    std::vector<Vec3> batch[kRungCount];
    for (std::size_t i = 0; i < kRungCount; ++i) {
      batch[i].resize(count);
      worldToScreen(camera_, points, batch[i], kRungs[i]);
    }
    checkKernels(points, batch);
    for (std::size_t p = 0; p < count; ++p) {
      const Vec3& point = points[p];
      ++tally.points;
      const Oracle::Answer truth = oracle_.at(point);
      if (truth.undecided) ++(truth.side == 0 ? tally.onEyePlane : tally.undecided);
      ScreenPoint got[kRungCount];
      for (std::size_t i = 0; i < kRungCount; ++i) {
        got[i] = worldToScreen(camera_, point, kRungs[i]);
        if (!sameBits(batch[i][p], got[i]))
          fail(point, kRungNames[i],
               "the batch gives " + exactText(batch[i][p]) + ", a single point " +
                   exactText({got[i].x, got[i].y, got[i].depth}));
        if ((got[i].status == PointStatus::inFront) != truth.inFront)
          fail(point, kRungNames[i], text("status %d, true distance %a", int(got[i].status), truth.forward.hi));
      }
      if (!truth.inFront) {
        ++tally.behind;
        continue;
      }
      if (truth.undecided) continue;
      const bool isInPicture = beyond(truth) <= 0;
      tally.inPicture += isInPicture;
      if (!std::isfinite(truth.x.hi) || !std::isfinite(truth.y.hi) || !std::isfinite(truth.depth.hi))
        ++tally.overflowed;
      if (!got[kExact].certain) ++tally.uncertain;
      checkSides(got[kExact], truth, point);
      checkExact(got[kExact], truth, point);
      for (std::size_t i = 0; i < kRungCount; ++i) {
        checkBounds(i, got[i], truth, point, isInPicture);
        tally.inRung[i] += got[i].precision == kRungs[i];
      }
    }
    rays();
  }

  static std::size_t failures() { return failures_; }

 private:
  /// One of the kernels, another in each trial, against the batches of the best.
  void checkKernels(const std::vector<Vec3>& points, const std::vector<Vec3>* batch) {
    std::vector<Vec3> got(points.size());
    withKernels(*supportedKernels()[seed_ % supportedKernels().size()], [&](const Kernels& kernel) {
      const auto compare = [&](const std::vector<Vec3>& want, const char* what) {
        for (std::size_t i = 0; i < got.size(); ++i)
          if (!sameBits(got[i], {want[i].x, want[i].y, want[i].z}))
            fail(points[i], what,
                 std::string("kernel ") + kernel.name + " gives " + exactText(got[i]) + ", not " + exactText(want[i]));
      };
      for (std::size_t i = 0; i < kRungCount; ++i) {
        worldToScreen(camera_, points, got, kRungs[i]);
        compare(batch[i], kRungNames[i]);
      }
    });
  }

  static bool sameBits(const Vec3& a, const ScreenPoint& b) {
    const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0 || (x != x && y != y); };
    return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.depth);
  }

  double size() const { return std::max(camera_.viewport().width, camera_.viewport().height); }

  /// How many pixels outside the picture; infinite outside near and far in orthographic.
  double beyond(const Oracle::Answer& truth) const {
    const Viewport& v = camera_.viewport();
    const double half = v.pixelCenter - 0.5;
    const double x = std::fabs(truth.x.hi - (v.x + half + v.width / 2)) - v.width / 2;
    const double y = std::fabs(truth.y.hi - (v.y + half + v.height / 2)) - v.height / 2;
    if (parts(camera_).projection.orthographic && !betweenNearAndFar(truth)) return INFINITY;
    return std::max(x, y);
  }

  bool betweenNearAndFar(const Oracle::Answer& truth) const {
    return truth.forward.hi >= parts(camera_).projection.near && truth.forward.hi <= parts(camera_).projection.far;
  }

  /// What lies beyond near or far, or out of the picture by more than its bound, says so.
  void checkSides(const ScreenPoint& got, const Oracle::Answer& truth, const Vec3& point) {
    const Viewport& v = camera_.viewport();
    const double bound =
        boundOfPoint(camera_, point, Precision::exact).screen + 0x1p-48 * (size() + std::fabs(v.x) + std::fabs(v.y));
    const bool isOut = (got.outside & (sideLeft | sideRight | sideBottom | sideTop)) != 0;
    const double start = v.pixelCenter - 0.5;
    const double out = std::max(std::fabs(truth.x.hi - (v.x + start + v.width / 2)) - v.width / 2,
                                std::fabs(truth.y.hi - (v.y + start + v.height / 2)) - v.height / 2);
    if (std::fabs(out) > bound && isOut != (out > 0))
      fail(point, "exact", text("%g pixels out, sides %d", out, int(got.outside)));
    if (!got.certain) return;
    const ProjectionParts& p = parts(camera_).projection;
    if ((truth.forward.hi < p.near) != ((got.outside & sideNear) != 0) ||
        (truth.forward.hi > p.far) != ((got.outside & sideFar) != 0))
      fail(point, "exact", text("distance %a, sides %d", truth.forward.hi, int(got.outside)));
  }

  /// The nearest doubles where exact says so, and what it promises of the others.
  void checkExact(const ScreenPoint& got, const Oracle::Answer& truth, const Vec3& point) {
    const auto check = [&](const char* what, double value, const TrueNumber& number, double of, double also = 0) {
      const double nearest = std::fabs(number.hi);
      const double ulp = std::nextafter(nearest, INFINITY) - nearest;
      const double error = errorOf(value, number);
      if (value == number.hi || (!got.certain && error <= std::max({kExactUlps * ulp, kExactAbsolute * of, also})))
        return;
      fail(point, "exact",
           text("%s is %a, nearest %a + %a, error %g ulp, %s", what, value, number.hi, number.lo, error / ulp,
                got.certain ? "called certain" : "not called certain"));
    };
    const Viewport& v = camera_.viewport();
    check("x", got.x, truth.x, size());
    check("y", got.y, truth.y, size());
    // In a thin slab the depth is known as well as the distance.
    const double distance = std::fabs(truth.forward.hi);
    check("depth", got.depth, truth.depth, std::fabs(v.depthSecond - v.depthFirst),
          kExactDistance * std::fabs(parts(camera_).constants.depthScale.hi) *
              (parts(camera_).projection.orthographic ? distance : 1 / distance));
    check("viewDistance", got.viewDistance, truth.forward,
          std::max(std::fabs(parts(camera_).projection.near),
                   parts(camera_).projection.orthographic ? std::fabs(scene_.far) : 0));
  }

  void checkBounds(std::size_t rung, const ScreenPoint& got, const Oracle::Answer& truth, const Vec3& point,
                   bool isInPicture) {
    const Errors error = errorsOf(got.x, got.y, got.depth, truth);
    const auto check = [&](const char* what, double wrong, double bound) {
      if (!(wrong <= bound))
        fail(point, kRungNames[rung],
             text("%s: error %a, bound %a; got %a %a %a (of %s), true %a %a %a", what, wrong, bound, got.x, got.y,
                  got.depth, kRungNames[int(got.precision)], truth.x.hi, truth.y.hi, truth.depth.hi));
    };
    const ErrorBound bound = boundOfPoint(camera_, point, kRungs[rung]);
    // What a precision cannot bound goes the exact way: only what overflows has no bound.
    if ((std::isinf(bound.screen) && std::isfinite(truth.x.hi) && std::isfinite(truth.y.hi)) ||
        (std::isinf(bound.depth) && std::isfinite(truth.depth.hi)))
      fail(point, kRungNames[rung], text("no bound: %a, %a", bound.screen, bound.depth));
    check("screen, bound of the point", error.screen(), bound.screen);
    check("depth, bound of the point", error.depth, bound.depth);
    if (isInPicture) {
      check("screen, bound in the picture", error.screen(), inPicture_[rung].screen);
      if (betweenNearAndFar(truth)) check("depth, bound in the picture", error.depth, inPicture_[rung].depth);
    }
  }

  void rays() {
    const Viewport& v = camera_.viewport();
    for (int i = 0; i < kRaysOfCamera; ++i) {
      const Vec2 pixel{v.x + v.width * random_.uniform(0, 1), v.y + v.height * random_.uniform(0, 1)};
      const std::array<TrueNumber, 3> truth = oracle_.direction(pixel);
      const Vec3 got = screenToRay(camera_, pixel).direction;
      // got x truth = (got - truth) x truth, and truth has unit length.
      Vec3 off;
      for (std::size_t k = 0; k < 3; ++k) off[k] = (got[k] - truth[k].hi) - truth[k].lo;
      const double angle =
          std::hypot(off.y * truth[2].hi - off.z * truth[1].hi, off.z * truth[0].hi - off.x * truth[2].hi,
                     off.x * truth[1].hi - off.y * truth[0].hi);
      if (!(angle <= kRayDirectionBound) || !(std::fabs(std::hypot(got.x, got.y, got.z) - 1) <= 0x1p-51))
        fail({pixel.x, pixel.y, 0}, "ray", text("the pixel's ray is %s, off by %g", exactText(got).c_str(), angle));
    }
  }

  /// Shows the first few of a family's and rung's.
  void fail(const Vec3& point, const char* rung, const std::string& what) {
    ++failures_;
    // Not through Catch, which would break the lines and the numbers in them.
    if (++shown_[std::string(family_.name) + rung] <= 3)
      std::fprintf(stderr, "family \"%s\", seed %" PRIu64 ", %s, point %s: %s\n  %s\n", family_.name, seed_, rung,
                   exactText(point).c_str(), what.c_str(), describe(scene_).c_str());
  }

  static inline std::size_t failures_ = 0;
  static inline std::map<std::string, int> shown_;

  const Family& family_;
  std::uint64_t seed_;
  Random random_;
  Scene scene_;
  Truth truth_;
  Camera camera_;
  Oracle oracle_;
  ErrorBound inPicture_[kRungCount];
};

}  // namespace

TEST_CASE("No result is farther from the truth than its bound, of every family") {
  const std::size_t wanted = pointsWanted();
  const std::size_t trials = (wanted + families().size() * kPointsOfCamera - 1) / (families().size() * kPointsOfCamera);
  Tally total;
  for (const Family& family : families()) {
    Tally tally;
    const std::size_t before = Trial::failures();
    for (std::uint64_t seed = 0; seed < trials; ++seed) Trial(family, seed).run(tally, kPointsOfCamera);
    INFO(family.name);
    CHECK(Trial::failures() == before);
    CHECK(double(tally.inPicture) >= family.leastInPicture * double(tally.points));
    CHECK(tally.undecided == 0);
    total.points += tally.points;
    total.onEyePlane += tally.onEyePlane;
    total.uncertain += tally.uncertain;
    total.overflowed += tally.overflowed;
    for (std::size_t i = 0; i < kRungCount; ++i) total.inRung[i] += tally.inRung[i];
  }
  CHECK(total.points >= wanted);
  CHECK(total.onEyePlane > wanted / 10000);
  CHECK(total.overflowed > wanted / 1000);
  CHECK(total.uncertain > wanted / 1000);
  for (std::size_t i = 0; i < kRungCount; ++i) CHECK(total.inRung[i] > wanted / 10);
}

namespace {

enum class Of { screen, depth, picture };

/// A point that needs a term of a bound: without it, or with half of it, the bound would be too small.
struct TightPoint {
  const char* term;
  Of bound;
  double leastShare;  ///< of the error in the bound as it is
  Vec3 point;
  void (*change)(Scene&);
};

/// The first axis's row is a little longer than 1, and so is the point's way along it: each rounding but the
/// residual's, which there is not, loses nearly half a last place there, all the same way.
void allRoundAlike(Scene& s) {
  constexpr double a = 1 - 0x1.4p-18, e = 0x1p-16;
  s.poseKind = PoseKind::worldFromCamera;
  s.matrix = {{{{a, e, e, -0x1.fp-54}, {0, a, 0, 0}, {0, 0, a, 0}, {0, 0, 0, 1}}}};
  s.viewport = {64, 64};
}
constexpr Vec3 kAllRoundAlike{0x1.000032d37000ap+0, -0x1.effep-38, -0x1.effep-38};

const TightPoint kTightPoints[] = {
    {"roundings of X", Of::screen, 0.65, kAllRoundAlike,
     [](Scene& s) {
       allRoundAlike(s);
       s.lensKind = LensKind::orthographic;
       s.left = 0, s.right = 2, s.bottom = -2, s.top = 0, s.near = -1;
     }},
    // And those of a depth's scale, its 1 / W and their product.
    {"roundings of W and of a quotient", Of::depth, 0.8, kAllRoundAlike,
     [](Scene& s) {
       allRoundAlike(s);
       s.axes = CameraAxes::FRU;
       s.convention.world = Handedness::left;
       s.lensKind = LensKind::frustum;
       s.near = 0x1.0000144cp+0, s.far = kInfiniteFar, s.viewport.depthSecond = 0x1.0001eap+0;
     }},
    // Nothing else puts the picture 1000 pixels from the principal point.
    {"pixel centre", Of::picture, 4e-5, Vec3{-333.4, 333.4, -0x1.55555p-2},
     [](Scene& s) {
       s.poseKind = PoseKind::direction;
       s.target = {0, 0, -1};
       s.viewport = {1, 1}, s.viewport.pixelCenter = -1000;
       s.lensKind = LensKind::intrinsics;
       s.fx = s.fy = 1, s.cx = s.cy = 0;
     }},
    // In last places of the eye: it is (0.47 0 0.39) off, and the point 1 from it, too few for many roundings; but the
    // point's own bound counts them.
    {"what rounding the eye left over", Of::picture, 0, Vec3{-550944905.509449, 0, -599940005.9994001},
     [](Scene& s) {
       s.poseKind = PoseKind::cameraFromWorld;
       s.matrix = {{{{1.0001, 0, 0, 551e6}, {0, 1.0001, 0, 0}, {0, 0, 1.0001, 600e6}, {0, 0, 0, 1}}}};
       s.viewport = {1, 1};
       s.lensKind = LensKind::intrinsics;
       s.cx = -775, s.cy = 0, s.near = 0x1p-24;
     }},
};

}  // namespace

TEST_CASE("Points that need a term of a bound keep the bound") {
  for (const TightPoint& tight : kTightPoints) {
    Scene scene;
    tight.change(scene);
    const Camera camera = build(scene);
    const Truth formulas(scene);
    const Oracle::Answer truth = Oracle(formulas).at(tight.point);
    const ScreenPoint got = worldToScreen(camera, tight.point, Precision::standard);
    const Errors error = errorsOf(got.x, got.y, got.depth, truth);
    const ErrorBound own = boundOfPoint(camera, tight.point, Precision::standard);
    const ErrorBound bound = tight.bound == Of::picture ? boundInPicture(camera, Precision::standard) : own;
    const double share = tight.bound == Of::depth ? error.depth / bound.depth : error.screen() / bound.screen;
    INFO(tight.term);
    CHECK(got.precision == Precision::standard);
    CHECK(got.outside == 0);
    CHECK(share <= 1);
    CHECK(share >= tight.leastShare);
    CHECK(own.screen <= bound.screen);
  }
}
