// Lenses against MPFR: where points go, where pixels come from, and where the map stops being one-to-one.
#include "viewproj/lens.hpp"

#include <cstdlib>
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

/// Brown's polynomials.
RealXY brown(const viewproj::Lens& lens, const RealXY& at) {
  const Real &x = at.x, &y = at.y, u = x * x + y * y;
  const double* const k = lens.k().data();
  const Real g = series(k, 3, u) / series(k + 3, 3, u);
  const Real p1 = lens.p()[0], p2 = lens.p()[1];
  return {x * g + Real(2) * p1 * x * y + p2 * (u + Real(2) * x * x),
          y * g + p1 * (u + Real(2) * y * y) + Real(2) * p2 * x * y};
}

/// What the calibration's plane is to be divided by, for a slope of 1 on the axis; and the fov's factor of tangents.
Real across(const viewproj::Lens& lens) { return Real(2) * tanDegrees(Real(lens.omega()) * Real(90) / Real::pi()); }
Real slopeOnAxis(const viewproj::Lens& lens) {
  if (lens.model() == LensModel::fov) return across(lens) / Real(lens.omega());
  return Real(1) / (Real(1) + Real(lens.xi()));
}

/// The textbook's formulas, from x right, y down, z forward, divided by their slope on the axis.
RealXY bend(const viewproj::Lens& lens, const Real3& v) {
  const Real square = v[0] * v[0] + v[1] * v[1], r = sqrt(square), scale = Real(1) / slopeOnAxis(lens);
  if (lens.model() == LensModel::fisheye || lens.model() == LensModel::fov) {
    const bool isFov = lens.model() == LensModel::fov;
    if (r.sign() == 0) return {0.0, 0.0};
    const Real angle = arctangent2(isFov ? across(lens) * r : r, v[2]);
    const Real by =
        isFov ? angle / Real(lens.omega()) * scale / r : angle * series(lens.k().data(), 4, angle * angle) / r;
    return {v[0] * by, v[1] * by};
  }
  const Real k = v[2] + Real(lens.xi()) * length(v), alpha = lens.alpha();
  const Real divisor = alpha * sqrt(Real(lens.beta()) * square + k * k) + (Real(1) - alpha) * k;
  const RealXY at{v[0] / divisor, v[1] / divisor};
  const RealXY put = brown(lens, at);
  return {put.x * scale, put.y * scale};
}

Real lengthOf(const Real& x, const Real& y) { return sqrt(x * x + y * y); }

/// In degrees.
Real angleOfAxis(const Real3& v) { return arctangent2(lengthOf(v[0], v[1]), v[2]) * Real(180) / Real::pi(); }

/// The least eigenvalue of the Jacobian of Brown's polynomials at (r cos a, r sin a), by differences.
double leastStretch(const viewproj::Lens& lens, double r, double angle) {
  const Real h = 1e-30, x = Real(r) * cosine(Real(angle)), y = Real(r) * sine(Real(angle));
  const RealXY at = brown(lens, {x, y}), right = brown(lens, {x + h, y}), down = brown(lens, {x, y + h});
  const double xx = double((right.x - at.x) / h), xy = double((right.y - at.y) / h), yy = double((down.y - at.y) / h);
  return (xx + yy) / 2 - std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
}

double denominator(const viewproj::Lens& lens, double r) {
  return double(series(lens.k().data() + 3, 3, Real(r) * Real(r)));
}

/// Brown or a fisheye; coefficients that count at tangents of this size.
viewproj::Lens randomPolynomials(Random& random, double size, double largest = 3) {
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

/// Of any model.
viewproj::Lens randomLens(Random& random, double size, double largest = 3) {
  const auto alpha = [&] { return random.chance(0.1) ? 0.5 : random.uniform(-0.5, 2); };
  const auto xi = [&] {
    return random.chance(0.1) ? 1 : random.chance(0.5) ? random.uniform(-0.95, 1) : random.uniform(0, 4);
  };
  const int model = int(random.uniform(0, 7));
  if (model == 0) return unifiedLens(alpha(), random.chance(0.5) ? 1 : random.uniform(0.3, 3));
  if (model == 1) return doubleSphereLens(xi(), alpha());
  if (model == 2) return fovLens(random.uniform(0.01, 3));
  const viewproj::Lens lens = randomPolynomials(random, model == 3 ? 1 : size, largest);
  return model == 3 && lens.model() == LensModel::brown ? omniLens(xi(), lens.k(), lens.p()) : lens;
}

/// How many random lenses. A seventh of them are of each model but brown and fisheye, which share what is left.
int lensesWanted(int usually) {
  const char* const wanted = std::getenv("VIEWPROJ_RANDOM_LENSES");
  return wanted ? std::atoi(wanted) : usually;
}

viewproj::Lens lensOf(const json& d) {
  const auto number = [&](const char* name) { return d.value(name, 0.0); };
  std::array<double, 6> k{};
  for (std::size_t i = 0; d.contains("k") && i < d["k"].size(); ++i) k[i] = d["k"][i];
  std::array<double, 2> p{};
  if (d.contains("p")) p = {d["p"][0], d["p"][1]};
  if (d["model"] == "brown") return brownLens(k, p);
  if (d["model"] == "fisheye") return fisheyeLens({k[0], k[1], k[2], k[3]});
  if (d["model"] == "unified") return unifiedLens(number("alpha"), d.value("beta", 1.0));
  if (d["model"] == "double-sphere") return doubleSphereLens(number("xi"), number("alpha"));
  if (d["model"] == "omni") return omniLens(number("xi"), k, p);
  REQUIRE(d["model"] == "fov");
  return fovLens(number("omega"));
}

Camera cameraOf(const json& test) {
  const json& K = test["K"];
  const Viewport viewport{.width = test["size"][0], .height = test["size"][1], .pixelCenter = 0};
  const Pose pose = poseFromRotation({0, 0, 0}, {}, CameraAxes::RDF);
  const viewproj::Lens lens = lensOf(test["distortion"]);
  const Projection file = intrinsics(K["fx"], K["fy"], K["cx"], K["cy"], viewport, 0, kInfiniteFar);
  return withLens(makeCamera(pose, calibrated(file, lens), viewport), lens);
}

}  // namespace

TEST_CASE("Calibrated lenses put points where sixty digits put them, and see along the rays that these see along") {
  std::ifstream lines(VIEWPROJ_LENSES);
  int lenses = 0, points = 0, unseen = 0, backward = 0, rays = 0, dark = 0;
  for (std::string line; std::getline(lines, line); ++lenses) {
    const json test = json::parse(line);
    INFO(test["name"]);
    const Camera camera = cameraOf(test);
    const viewproj::Lens lens = *lensOf(camera);
    if (test["limitDegrees"].is_null()) {
      CHECK(lens.limitCause() == LimitCause::none);
      CHECK(lens.limitDegrees() == INFINITY);
    } else {
      const double limit = test["limitDegrees"];
      CHECK(lens.limitDegrees() <= limit * (1 + 1e-15));
      CHECK(lens.limitDegrees() > limit * (1 - 1e-8));
      CHECK(lens.limitCause() == (test["cause"] == "pole" ? LimitCause::pole : LimitCause::fold));
    }
    if (test.contains("pinholeFx")) CHECK(camera.intrinsics().fx == std::stod(test["pinholeFx"].get<std::string>()));
    for (const json& point : test["points"]) {
      const Vec3 p{point[0][0], point[0][1], point[0][2]};
      const ScreenPoint exact = worldToScreen(camera, p);
      INFO(p.x << " " << p.y << " " << p.z);
      CHECK(exact.viewDistance == p.z);
      CHECK(std::isnan(exact.depth));
      if (point[1].is_null()) {
        CHECK(exact.status == (p.z > 0 ? PointStatus::beyondLens : PointStatus::behind));
        CHECK((std::isnan(exact.x) && std::isnan(exact.y)));
        CHECK(exact.outside == 0);
        ++unseen;
        continue;
      }
      CHECK(exact.status == PointStatus::inFront);
      CHECK(exact.certain);
      CHECK(exact.x == std::stod(point[1][0].get<std::string>()));
      CHECK(exact.y == std::stod(point[1][1].get<std::string>()));
      const Vec3 back = screenToRay(camera, {exact.x, exact.y}).direction;
      CHECK(angle(toReal(back), toReal(p)) <= 1e-14 * (1 + std::hypot(exact.x, exact.y)));
      backward += p.z <= 0;
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
        const double z = ray[1][2];
        CHECK(angle(toReal(got.direction), {Real(ray[1][0].get<double>()), Real(ray[1][1].get<double>()), Real(z)}) <=
              3e-16);
        CHECK(screenToWorldAtDistance(camera, pixel, z > 0 ? 1 : -1).status == DepthStatus::point);
        CHECK(screenToWorldAtDistance(camera, pixel, z > 0 ? -1 : 1).status == DepthStatus::beyond);
        ++rays;
      }
    }
    CHECK(lensShift(camera).largest > 3);
  }
  CAPTURE(lenses, points, unseen, backward, rays, dark);
  CHECK((lenses == 28 && points == 216 && unseen == 27 && backward > 54 && rays == 143 && dark == 12));
}

TEST_CASE("Through random lenses pixels are the nearest doubles in either precision, and no bound is passed") {
  int seen = 0, backward = 0, beyond = 0, certain = 0, wide = 0, finite = 0;
  const int lenses = lensesWanted(3000);
  for (std::uint64_t trial = 0; trial < std::uint64_t(lenses); ++trial) {
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
    INFO("trial " << trial << ": " << describe(scene) << " lens " << int(lens.model()) << " xi " << lens.xi()
                  << " alpha " << lens.alpha());
    for (int i = 0; i < 9; ++i) {
      Vec3 point = pointInView(random, truth, i < 3 ? 1 : 3);
      if (i >= 6) {  // to any side
        const Vec3 eye = pinhole.pose().eye(), d = random.direction(random.logUniform(0.1, 10) * window.zNear());
        point = {eye.x + d.x, eye.y + d.y, eye.z + d.z};
      }
      const Truth::View view = truth.view(toReal(point));
      const Real3 v{view.right, -view.up, view.forward};
      if (length(v).sign() == 0) continue;
      const double degrees = double(angleOfAxis(v)), limit = std::fmin(lens.limitDegrees(), 180);
      if (i >= 6 && std::fabs(degrees - 90) < 1e-3) continue;
      const bool isForward = view.forward > Real(0);
      for (const Precision precision : {Precision::standard, Precision::exact}) {
        const ScreenPoint got = worldToScreen(camera, point, precision);
        const ScreenPoint without = worldToScreen(pinhole, point, got.precision);
        REQUIRE((got.viewDistance == without.viewDistance && (got.depth == without.depth || std::isnan(got.depth))));
        if (std::fabs(degrees - limit) < 1e-9 * limit) continue;
        if (degrees > limit || (std::isinf(lens.limitDegrees()) && lens.model() == LensModel::brown && !isForward)) {
          REQUIRE(got.status == (isForward ? PointStatus::beyondLens : PointStatus::behind));
          ++beyond;
          continue;
        }
        REQUIRE(got.status == PointStatus::inFront);
        ++seen;
        backward += !isForward;
        REQUIRE((got.outside & sideNear) == (got.viewDistance < window.zNear() ? sideNear : 0));
        const RealXY put = bend(lens, v);
        const Truth::Screen screen = truth.screen({put.x, -put.y, 1});
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
        if ((got.outside & ~(sideNear | sideFar)) == 0) {
          REQUIRE(error <= inPicture[int(precision)].screen);
          wide += inPicture[int(precision)].screen < INFINITY;
        }
      }
    }
  }
  forceKernels(nullptr);
  CAPTURE(seen, backward, beyond, certain, wide, finite);
  CHECK(certain > 7 * lenses);
  CHECK((3 * backward > 2 * lenses && 3 * beyond > 5 * lenses));
  CHECK((finite == seen && 3 * wide > 8 * lenses));
}

namespace {

/// Radius or angle.
double limitOf(const viewproj::Lens& lens) {
  if (lens.limitCause() == LimitCause::none) return INFINITY;
  return lens.model() == LensModel::fisheye ? parts(lens).angleEnd : parts(lens).brownEnd;
}

}  // namespace

TEST_CASE("Up to a lens's limit the map is one-to-one, and not much beyond") {
  int folds = 0, poles = 0, none = 0, loose = 0, pairs = 0;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    Random random(trial);
    const viewproj::Lens lens = randomPolynomials(random, 1, random.chance(0.5) ? 3 : 0.3);
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
      const RealXY fa = brown(lens, {a.x, a.y}), fb = brown(lens, {b.x, b.y});
      REQUIRE((fa.x - fb.x) * (Real(a.x) - Real(b.x)) + (fa.y - fb.y) * (Real(a.y) - Real(b.y)) > Real(0));
      ++pairs;
    }
  }
  CAPTURE(folds, poles, none, loose, pairs);
  CHECK((folds > 500 && poles > 150 && none > 300 && pairs > 30000));
  CHECK(loose == 0);
}

TEST_CASE("The sphere maps rise up to their limit, and fall or end beyond it") {
  int folds = 0, poles = 0, none = 0;
  for (std::uint64_t trial = 0; trial < 1000; ++trial) {
    Random random(trial);
    const viewproj::Lens lens = random.chance(0.5) ? unifiedLens(random.uniform(-0.5, 2), random.uniform(0.3, 3))
                                                   : doubleSphereLens(random.chance(0.1) ? 1 : random.uniform(-0.95, 4),
                                                                      random.uniform(-0.5, 2));
    INFO("trial " << trial << " xi " << lens.xi() << " alpha " << lens.alpha() << " beta " << lens.beta());
    const double limit = std::fmin(lens.limitDegrees(), 180);
    const auto radius = [&](double degrees) { return bend(lens, {sinDegrees(degrees), 0.0, cosDegrees(degrees)}).x; };
    for (int i = 0; i < 40; ++i) {
      const double degrees = limit * (i % 2 ? random.uniform(0, 1) : 1 - random.logUniform(1e-9, 0.1));
      REQUIRE(radius(degrees * (1 + 1e-12)) > radius(degrees));
      REQUIRE(radius(degrees).sign() > 0);
    }
    const double past = limit * (1 + 1e-6);
    const Real after = radius(past);
    if (lens.limitCause() == LimitCause::none)
      ++none;
    else if (lens.limitCause() == LimitCause::fold)
      REQUIRE((radius(past * (1 + 1e-9)) < after && ++folds));
    else
      REQUIRE((after.sign() <= 0 && ++poles));
  }
  CAPTURE(folds, poles, none);
  CHECK((folds > 400 && poles > 100 && none > 3));
}

TEST_CASE("What a lens puts somewhere comes back from there, within the certificate's bound, and nothing else does") {
  int found = 0, backward = 0, slow = 0, lost = 0, outside = 0;
  double worst = 0, share = 0;
  const int lenses = lensesWanted(1500);
  for (std::uint64_t trial = 0; trial < std::uint64_t(lenses); ++trial) {
    Random random(trial);
    const viewproj::Lens lens = randomLens(random, 1, random.chance(0.5) ? 3 : 0.3);
    const LensParts& l = parts(lens);
    const double limit = std::fmin(lens.limitDegrees(), lens.model() == LensModel::brown ? 89.9 : 180);
    for (int i = 0; i < 20; ++i) {
      const double part = i % 4 == 0 ? 1 - random.logUniform(1e-12, 1e-2) : random.uniform(0, 1);
      const Real degrees = Real(limit) * Real(part), turn = random.uniform(0, 360);
      const Real3 truth{sinDegrees(degrees) * cosDegrees(turn), sinDegrees(degrees) * sinDegrees(turn),
                        cosDegrees(degrees)};
      const RealXY put = bend(lens, truth);
      const Real scale = Real(l.scale.hi) + Real(l.scale.lo);
      const auto pair = [](const Real& a) { return DoubleDouble(double(a), double(a - Real(double(a)))); };
      const auto real = [](DoubleDouble a) { return Real(a.hi) + Real(a.lo); };
      const PlanePoint<DoubleDouble> target{pair(put.x / scale), pair(put.y / scale)};
      INFO("trial " << trial << " model " << int(lens.model()) << " at " << part << " of " << limit);
      for (const bool isSlow : {false, true}) {
        const Undistorted got = isSlow ? undistortSlowly(l, target) : undistort(l, target);
        if (std::isnan(got.at.right.hi)) {
          ++lost;
          REQUIRE(part > 1 - 1e-8);
          continue;
        }
        ++found;
        slow += isSlow;
        backward += got.at.forward.hi < 0;
        const Real3 back{real(got.at.right), real(got.at.down), real(got.at.forward)};
        REQUIRE(std::fabs(double(length(back) - Real(1))) < 1e-18);
        REQUIRE(double(angleOfAxis(back)) < limit);
        // The target was rounded: what comes back is its own. Newton's steps along two tangents, from there.
        Real3 z = back;
        const Real3 right =
                        unit(cross(z, std::fabs(got.at.right.hi) < 0.5 ? Real3{1.0, 0.0, 0.0} : Real3{0.0, 1.0, 0.0})),
                    down = unit(cross(z, right));
        const Real h = 1e-40, x = real(target.x) * scale, y = real(target.y) * scale;
        for (int step = 0; step < 2; ++step) {
          const RealXY f = bend(lens, z), fr = bend(lens, z + right * h), fd = bend(lens, z + down * h);
          const Real xx = (fr.x - f.x) / h, xy = (fd.x - f.x) / h, yx = (fr.y - f.y) / h, yy = (fd.y - f.y) / h;
          const Real ex = f.x - x, ey = f.y - y, det = xx * yy - xy * yx;
          z = z - right * ((yy * ex - xy * ey) / det) - down * ((xx * ey - yx * ex) / det);
        }
        const double off = angle(z, back);
        REQUIRE(off <= got.error);
        worst = std::max(worst, got.error);
        share = std::max(share, off / got.error);
      }
    }
    const double far = l.edge * random.logUniform(1.0001, 100), a = random.uniform(0, 7);
    if (far < INFINITY) {
      REQUIRE(std::isnan(undistorted(lens, {far * l.scale.hi * std::cos(a), far * l.scale.hi * std::sin(a)}).x));
      ++outside;
    }
  }
  CAPTURE(found, backward, slow, lost, outside, worst, share);
  CHECK(worst <= 0x1p-56);
  CHECK((found > 36 * lenses && slow > 16 * lenses && backward > 5 * lenses && 2 * outside > lenses));
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
    for (const double sign : {1.0, -1.0}) {
      const auto lanes = angleOf<Fine<ScalarLanes>>(slope, sign);
      const Real other = sign > 0 ? truth : Real::pi() - truth;
      worstOfLanes = std::max(worstOfLanes, double(abs(Real(lanes.hi) + Real(lanes.lo) - other) / other));
    }
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
