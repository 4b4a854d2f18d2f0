// Lenses against MPFR: where points go, where pixels come from, and where the map stops being one-to-one.
#include "viewproj/lens.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "internals.hpp"
#include "kernels.hpp"
#include "projection/kernels/formulas.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;
using nlohmann::json;

namespace {

struct RealXY {
  Real x, y;
};

Real series(const double* k, int count, const Real& u) {
  Real sum = 0.0;
  for (int i = count; i-- > 0;) sum = (sum + Real(k[i])) * u;
  return sum + Real(1);
}

/// The textbook's formulas; y down.
RealXY bend(const viewproj::Lens& lens, const RealXY& at) {
  const Real &x = at.x, &y = at.y, u = x * x + y * y;
  const double* const k = lens.k().data();
  if (lens.model() == LensModel::fisheye) {
    const Real r = sqrt(u), angle = arctangent2(r, 1);
    if (r.sign() == 0) return at;
    const Real by = angle * series(k, 4, angle * angle) / r;
    return {x * by, y * by};
  }
  const Real g = series(k, 3, u) / series(k + 3, 3, u);
  const Real p1 = lens.p()[0], p2 = lens.p()[1];
  return {x * g + Real(2) * p1 * x * y + p2 * (u + Real(2) * x * x),
          y * g + p1 * (u + Real(2) * y * y) + Real(2) * p2 * x * y};
}

Real lengthOf(const Real& x, const Real& y) { return sqrt(x * x + y * y); }

/// Radius or angle.
double limitOf(const viewproj::Lens& lens) { return parts(lens).limit; }

/// The least eigenvalue of brown's Jacobian at (r cos a, r sin a), by differences; D times it, so that poles are zeros.
double leastStretch(const viewproj::Lens& lens, double r, double angle) {
  const Real h = 1e-30, x = Real(r) * cosine(Real(angle)), y = Real(r) * sine(Real(angle));
  const RealXY at = bend(lens, {x, y}), right = bend(lens, {x + h, y}), down = bend(lens, {x, y + h});
  const double xx = double((right.x - at.x) / h), xy = double((right.y - at.y) / h), yy = double((down.y - at.y) / h);
  return (xx + yy) / 2 - std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
}

double denominator(const viewproj::Lens& lens, double r) {
  return double(series(lens.k().data() + 3, 3, Real(r) * Real(r)));
}

/// Coefficients that count at tangents of this size.
viewproj::Lens randomLens(Random& random, double size, double largest = 3) {
  const auto number = [&](double power) {
    return random.chance(0.3) ? 0 : random.sign() * random.logUniform(1e-3, largest) * std::pow(size, -power);
  };
  if (random.chance(0.3)) return fisheyeLens({number(0) / 3, number(0) / 9, number(0) / 27, number(0) / 81});
  std::array<double, 6> k{};
  const std::size_t count = random.chance(0.4) ? 6 : 3;
  for (std::size_t i = 0; i < count; ++i) k[i] = number(2.0 * double(i % 3 + 1));
  const double p = random.chance(0.3) ? 0 : random.logUniform(1e-4, 0.2) / size;
  return brownLens(k, {p * random.uniform(-1, 1), p * random.uniform(-1, 1)});
}

Camera cameraOf(const json& test) {
  const json& K = test["K"];
  const Viewport viewport{.width = test["size"][0], .height = test["size"][1], .pixelCenter = 0};
  const Pose pose = poseFromRotation({0, 0, 0}, {}, CameraAxes::RDF, Handedness::right);
  const json& d = test["distortion"];
  std::array<double, 6> k{};
  for (std::size_t i = 0; i < d["k"].size(); ++i) k[i] = d["k"][i];
  const viewproj::Lens lens =
      d["model"] == "brown" ? brownLens(k, {d["p"][0], d["p"][1]}) : fisheyeLens({k[0], k[1], k[2], k[3]});
  return withLens(makeCamera(pose, intrinsics(K["fx"], K["fy"], K["cx"], K["cy"], viewport, 0.1, 1000), viewport),
                  lens);
}

}  // namespace

TEST_CASE("Calibrated lenses put points where sixty digits put them, and see along the rays that these see along") {
  std::ifstream lines(VIEWPROJ_LENSES);
  int lenses = 0, points = 0, rays = 0, dark = 0;
  for (std::string line; std::getline(lines, line); ++lenses) {
    const json test = json::parse(line);
    INFO(test["name"]);
    const Camera camera = cameraOf(test);
    const viewproj::Lens lens = *lensOf(camera);
    if (test["limit"].is_null()) {
      CHECK(lens.limitCause() == LimitCause::none);
      CHECK(lens.limitDegrees() == INFINITY);
    } else {
      const double limit = test["limit"];
      CHECK(limitOf(lens) <= limit);
      CHECK(limitOf(lens) > limit * (1 - 1e-8));
      CHECK(lens.limitCause() == (test["cause"] == "pole" ? LimitCause::pole : LimitCause::fold));
    }
    for (const json& point : test["points"]) {
      const Vec3 p{point[0][0], point[0][1], point[0][2]};
      const ScreenPoint exact = worldToScreen(camera, p);
      CHECK(exact.status == PointStatus::inFront);
      CHECK(exact.visible());
      CHECK(exact.certain);
      const double x = std::stod(point[1][0].get<std::string>()), y = std::stod(point[1][1].get<std::string>());
      CHECK(exact.x == x);
      CHECK(exact.y == y);
      ++points;
    }
    for (const json& ray : test["rays"]) {
      const Vec2 pixel{ray[0][0], ray[0][1]};
      const Ray got = screenToRay(camera, pixel);
      if (ray[1].is_null()) {
        CHECK(std::isnan(got.direction.x));
        CHECK(screenToWorldAtDistance(camera, pixel, 1).status == DepthStatus::noRay);
        ++dark;
      } else {
        CHECK(angle(toReal(got.direction), {Real(ray[1][0].get<double>()), Real(ray[1][1].get<double>()),
                                            Real(ray[1][2].get<double>())}) <= 3e-16);
        ++rays;
      }
    }
    const json& trap = test["trap"]["camera"];
    const ScreenPoint trapped = worldToScreen(camera, Vec3{trap[0], trap[1], trap[2]});
    CHECK(trapped.status == (test["trap"]["kind"] == "behind" ? PointStatus::behind : PointStatus::beyondLens));
    CHECK(std::isnan(trapped.x));
    CHECK(trapped.outside == 0);
    CHECK(largestShift(camera) > 3);
  }
  CHECK((lenses == 10 && points == 50 && rays == 46 && dark == 4));
}

TEST_CASE("Through random lenses pixels are the nearest doubles in either precision, and no bound is passed") {
  int inFront = 0, beyond = 0, certain = 0, wide = 0, finite = 0;
  for (std::uint64_t trial = 0; trial < 3000; ++trial) {
    Random random(trial);
    forceKernels(supportedKernels()[trial % supportedKernels().size()]);
    Scene scene = randomScene(random, random.logUniform(1e-3, 1e12));
    if (scene.lensKind == LensKind::orthographic) continue;
    const Truth truth(scene);
    const Camera pinhole = build(scene);
    const Projection window = pinhole.projection();
    const double size = std::max({std::fabs(window.left()), std::fabs(window.right()), std::fabs(window.top())});
    const viewproj::Lens lens = randomLens(random, size);
    const Camera camera = withLens(pinhole, lens);
    const ErrorBound inPicture[2] = {boundInPicture(camera, Precision::standard),
                                     boundInPicture(camera, Precision::exact)};
    INFO("trial " << trial << ": " << describe(scene));
    for (int i = 0; i < 6; ++i) {
      const Vec3 point = pointInView(random, truth, i < 3 ? 1 : 3);
      const Truth::View view = truth.view(toReal(point));
      if (!(view.forward > Real(0))) continue;
      const RealXY at{view.right / view.forward, -view.up / view.forward}, put = bend(lens, at);
      const Real r = lengthOf(at.x, at.y), measure = lens.model() == LensModel::fisheye ? arctangent2(r, 1) : r;
      const Truth::Screen screen = truth.screen({put.x, -put.y, 1});
      for (const Precision precision : {Precision::standard, Precision::exact}) {
        const ScreenPoint got = worldToScreen(camera, point, precision);
        const ScreenPoint without = worldToScreen(pinhole, point, got.precision);
        REQUIRE((got.viewDistance == without.viewDistance && (got.depth == without.depth || std::isnan(got.depth))));
        if (!(measure < Real(limitOf(lens)))) {
          REQUIRE(got.status == PointStatus::beyondLens);
          ++beyond;
          continue;
        }
        if (got.status == PointStatus::beyondLens) {
          REQUIRE(double(measure) > limitOf(lens) * (1 - 1e-11));
          continue;
        }
        REQUIRE(got.status == PointStatus::inFront);
        ++inFront;
        const double error = std::max(distance(got.x, screen.x), distance(got.y, screen.y));
        const ErrorBound bound = boundOfPoint(camera, point, precision);
        REQUIRE(error <= bound.screen);
        finite += std::isfinite(bound.screen);
        REQUIRE((got.precision == Precision::exact || !lensOf(camera)));
        if (got.certain) {
          REQUIRE(ulps(got.x, screen.x) <= 0.5);
          REQUIRE(ulps(got.y, screen.y) <= 0.5);
          ++certain;
        }
        if (got.visible()) {
          REQUIRE(error <= inPicture[int(precision)].screen);
          wide += inPicture[int(precision)].screen < INFINITY;
        }
      }
    }
  }
  forceKernels(nullptr);
  CAPTURE(inFront, beyond, certain, wide, finite);
  CHECK(certain > 20000);
  CHECK(beyond > 5000);
  CHECK((finite == inFront && wide > 8000));
}

TEST_CASE("Up to a lens's limit the map is one-to-one, and not much beyond") {
  int folds = 0, poles = 0, none = 0, loose = 0, pairs = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const viewproj::Lens lens = randomLens(random, 1, random.chance(0.5) ? 3 : 0.3);
    const double limit = limitOf(lens), end = std::min(limit, 1e6);
    INFO("trial " << trial << " limit " << limit);
    if (lens.model() == LensModel::fisheye) {
      const auto slope = [&](double t) {
        Real sum = 1;
        Real power = 1;
        for (int i = 0; i < 4; ++i) {
          power = power * Real(t) * Real(t);
          sum = sum + Real(2 * i + 3) * Real(lens.k()[std::size_t(i)]) * power;
        }
        return double(sum);
      };
      const double until = std::min(limit, 3.141592653589793);
      for (int i = 0; i < 200; ++i) REQUIRE(slope(until * i / 200) > 0);
      if (limit < INFINITY) REQUIRE(slope(limit) < 1e-5);  // of some thousands: a zero nearly touched
      continue;
    }
    double least = INFINITY;
    for (int i = 0; i < 60; ++i) {
      const double r = i % 3 ? end * random.uniform(0, 1) : end * (1 - random.logUniform(1e-9, 1e-2));
      REQUIRE(denominator(lens, r) > 0);
      REQUIRE(leastStretch(lens, r, random.uniform(0, 7)) > 0);
    }
    // In the direction opposite to (p2, p1) it is least.
    const double opposite = std::atan2(-lens.p()[0], -lens.p()[1]);
    REQUIRE(leastStretch(lens, limit < INFINITY ? limit : 1e6, opposite) > -1e-9);
    if (lens.limitCause() == LimitCause::fold) {
      least = leastStretch(lens, limit * (1 + 1e-6), opposite);
      ++folds;
      loose += !(least < 0);
    } else if (lens.limitCause() == LimitCause::pole) {
      REQUIRE(denominator(lens, limit * (1 + 1e-6)) < 1e-6);
      ++poles;
    } else {
      ++none;
    }
    for (int i = 0; i < 30; ++i) {
      const auto anywhere = [&] {
        const double r = end * std::sqrt(random.uniform(0, 1)) * (1 - 1e-12), a = random.uniform(0, 7);
        return Vec2{r * std::cos(a), r * std::sin(a)};
      };
      const Vec2 a = anywhere();
      Vec2 b = anywhere();
      if (i % 2) b = {a.x + end * random.uniform(-1e-4, 1e-4), a.y + end * random.uniform(-1e-4, 1e-4)};
      if (std::hypot(b.x, b.y) >= end) continue;
      const RealXY fa = bend(lens, {a.x, a.y}), fb = bend(lens, {b.x, b.y});
      REQUIRE((fa.x - fb.x) * (Real(a.x) - Real(b.x)) + (fa.y - fb.y) * (Real(a.y) - Real(b.y)) > Real(0));
      ++pairs;
    }
  }
  CAPTURE(folds, poles, none, loose, pairs);
  CHECK((folds > 500 && poles > 150 && none > 300 && pairs > 30000));
  CHECK(loose == 0);
}

TEST_CASE("What a lens puts somewhere comes back from there, within the certificate's bound, and nothing else does") {
  int found = 0, lost = 0, outside = 0;
  double worst = 0, share = 0;
  for (std::uint64_t trial = 0; trial < 4000; ++trial) {
    Random random(trial);
    const viewproj::Lens lens = randomLens(random, 1, random.chance(0.5) ? 3 : 0.3);
    const bool isFisheye = lens.model() == LensModel::fisheye;
    const double limit = isFisheye ? std::min(limitOf(lens), 1.5707963) : std::min(limitOf(lens), 1e3);
    const double edge = isFisheye ? std::tan(limit) : limit;
    for (int i = 0; i < 20; ++i) {
      const double part = i % 4 == 0 ? 1 - random.logUniform(1e-12, 1e-2) : random.uniform(0, 1);
      const double r = isFisheye ? std::tan(limit * part) : edge * part, a = random.uniform(0, 7);
      const RealXY at{r * std::cos(a), r * std::sin(a)}, put = bend(lens, at);
      const DoubleDouble x = double(put.x), y = double(put.y);
      const Undistorted got = undistort(parts(lens), {x, y});
      INFO("trial " << trial << " r " << r << " of " << edge);
      // The target was rounded to doubles: what comes back is its own preimage.
      if (std::isnan(got.at.x.hi)) {
        ++lost;
        REQUIRE(part > 1 - 1e-5);
        continue;
      }
      ++found;
      const RealXY back{Real(got.at.x.hi) + Real(got.at.x.lo), Real(got.at.y.hi) + Real(got.at.y.lo)};
      REQUIRE(double(lengthOf(back.x, back.y)) < edge);
      // A solution by Newton's steps with differences, from there.
      RealXY z = back;
      const Real h = 1e-40;
      for (int step = 0; step < 2; ++step) {
        const RealXY f = bend(lens, z), fx = bend(lens, {z.x + h, z.y}), fy = bend(lens, {z.x, z.y + h});
        const Real xx = (fx.x - f.x) / h, xy = (fy.x - f.x) / h, yx = (fx.y - f.y) / h, yy = (fy.y - f.y) / h;
        const Real ex = f.x - Real(double(put.x)), ey = f.y - Real(double(put.y)), det = xx * yy - xy * yx;
        z = {z.x - (yy * ex - xy * ey) / det, z.y - (xx * ey - yx * ex) / det};
      }
      const double off = angle({z.x, z.y, Real(1)}, {back.x, back.y, Real(1)});
      REQUIRE(off <= got.error);
      worst = std::max(worst, got.error);
      share = std::max(share, off / got.error);
    }
    const double far = parts(lens).outerEdge * random.logUniform(1.0001, 100), a = random.uniform(0, 7);
    if (far < INFINITY) {
      const Vec2 none = undistorted(lens, {far * std::cos(a), far * std::sin(a)});
      REQUIRE(std::isnan(none.x));
      ++outside;
    }
  }
  CAPTURE(found, lost, outside, worst, share);
  CHECK(worst <= 0x1p-56);
  CHECK((found > 70000 && outside > 2000));
}

TEST_CASE("Arctangents and the way back in double-double are within their bounds") {
  double worst = 0, worstOfLanes = 0, worstBack = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial);
    const double high = trial % 3 == 0 ? (double(trial % 35) + 0.5) / 32 : random.logUniform(1e-12, 1e12);
    const DoubleDouble slope(high, high * random.uniform(-1, 1) * 0x1p-54);
    const Real truth = arctangent2(Real(slope.hi) + Real(slope.lo), 1);
    const DoubleDouble got = arctangent(slope);
    worst = std::max(worst, double(abs(Real(got.hi) + Real(got.lo) - truth) / truth));
    const auto lanes = arctangent(Fine<ScalarLanes>(slope));
    worstOfLanes = std::max(worstOfLanes, double(abs(Real(lanes.hi) + Real(lanes.lo) - truth) / truth));
    const DoubleDouble t = got;
    const Direction d = directionOf(t);
    const Real across = Real(d.across.hi) + Real(d.across.lo), along = Real(d.along.hi) + Real(d.along.lo);
    worstBack = std::max(worstBack, double(abs(arctangent2(across, along) - (Real(t.hi) + Real(t.lo)))));
  }
  CAPTURE(std::log2(worst), std::log2(worstOfLanes), std::log2(worstBack));
  CHECK(worst <= 0x1p-94);
  CHECK(worstOfLanes <= 0x1p-94);
  CHECK(worstBack <= 0x1p-94);
}
