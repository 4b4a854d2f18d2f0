// Places on the Earth and cameras that stand there, against 480-bit arithmetic.
#include "viewproj/geodesy.hpp"

#include <map>

#include "camera/turned_axes.hpp"
#include "catch.hpp"
#include "internals.hpp"
#include "numbers/degrees.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

constexpr std::uint64_t kTrials = 3000;

template <int Degree>
Real sumOf(Dyadic<Degree> rest) {
  Real sum;
  while (rest.sign() != 0) {
    const double most = double(rest.rounded());
    sum = sum + Real(most);
    rest = rest - Dyadic<1>(most);
  }
  return sum;
}

Real sumOf(DoubleDouble a) { return Real(a.hi) + Real(a.lo); }

/// WGS84: a = 6378137 m, 1/f = 298.257223563.
Real3 trueEcef(const Geodetic& g) {
  const Real a = 6378137, f = Real(1000000000) / Real(298257223563.0);
  const Real e2 = f * (Real(2) - f);
  const Real s = sinDegrees(g.lat), c = cosDegrees(g.lat), h = g.height;
  const Real n = a / sqrt(Real(1) - e2 * s * s);
  return {(n + h) * c * cosDegrees(g.lon), (n + h) * c * sinDegrees(g.lon), (n * (Real(1) - e2) + h) * s};
}

struct EastNorthUp {
  Real3 east, north, up;
};
EastNorthUp trueFrame(const Geodetic& g) {
  const Real sp = sinDegrees(g.lat), cp = cosDegrees(g.lat), sl = sinDegrees(g.lon), cl = cosDegrees(g.lon);
  return {{-sl, cl, 0}, {-sp * cl, -sp * sl, cp}, {cp * cl, cp * sl, sp}};
}

Real degreesOf(const Angle& a) { return a.isRadians ? Real(a.value) * Real(180) / Real::pi() : Real(a.value); }

/// The closed form, where the library turns a frame step by step.
TruePose truePose(const Geodetic& g, const HeadingPitchRoll& t) {
  const EastNorthUp e = trueFrame(g);
  const Real heading = degreesOf(t.heading), pitch = degreesOf(t.pitch), roll = degreesOf(t.roll);
  const Real sh = sinDegrees(heading), ch = cosDegrees(heading), sp = sinDegrees(pitch), cp = cosDegrees(pitch);
  const Real sr = sinDegrees(roll), cr = cosDegrees(roll);
  TruePose p;
  p.forward = e.east * (sh * cp) + e.north * (ch * cp) + e.up * sp;
  p.right = e.east * (ch * cr + sh * sp * sr) + e.north * (ch * sp * sr - sh * cr) + e.up * (-(cp * sr));
  p.up = cross(p.right, p.forward);
  p.rightColumn = p.right;
  p.upColumn = p.up;
  p.forwardColumn = p.forward;
  return p;
}

enum Kind { anywhere, pole, nextToPole, antimeridian, rightAngles, tinyAngles, inRadians, kinds };

Geodetic randomPlace(Random& r, Kind kind) {
  Geodetic g{r.uniform(-90, 90), r.uniform(-400, 400), r.sign() * r.logUniform(1e-3, 5e6)};
  if (kind == pole) g.lat = r.sign() * 90;
  if (kind == nextToPole) g.lat = r.sign() * (90 - r.logUniform(1e-13, 1e-3));
  if (kind == antimeridian)
    g.lon = r.chance(0.3) ? r.sign() * 180 : r.sign() * (180 - r.sign() * r.logUniform(1e-13, 1e-3));
  if (kind == rightAngles) g.lat = 45 * std::floor(r.uniform(-2, 3)), g.lon = 45 * std::floor(r.uniform(-9, 9));
  if (kind == tinyAngles) g.lat = r.sign() * r.logUniform(1e-250, 1e-5), g.lon = r.sign() * r.logUniform(1e-250, 1e-5);
  return g;
}

HeadingPitchRoll randomTurn(Random& r, Kind kind) {
  HeadingPitchRoll t{r.uniform(-400, 400), r.uniform(-90, 90), r.uniform(-400, 400)};
  if (kind == rightAngles) t = {45 * std::floor(r.uniform(-9, 9)), 45 * std::floor(r.uniform(-2, 3)), 0};
  if (kind == inRadians)
    t = {Angle::radians(r.sign() * r.logUniform(1e-250, 1e6)), Angle::radians(r.uniform(-1.57, 1.57)),
         Angle::radians(r.uniform(-7, 7))};
  if (kind == tinyAngles) t = {r.logUniform(1e-250, 1e-5), r.logUniform(1e-250, 1e-5), r.logUniform(1e-250, 1e-5)};
  return t;
}

Kind kindOf(std::uint64_t trial) { return Kind(trial % kinds); }

double distanceBetween(const Vec3& a, const Real3& b) { return double(length(toReal(a) - b)); }

/// Largest error of an axis, in dd and in the exact rows.
struct RowErrors {
  double rounded = 0, exact = 0;
};
void add(RowErrors& errors, const DDVec3& row, const ExactPose::Row& exact, const Real3& truth) {
  for (std::size_t i = 0; i < 3; ++i) {
    errors.rounded = std::max(errors.rounded, double(abs(sumOf(row[i]) - truth[i])));
    errors.exact = std::max(errors.exact, double(abs(sumOf(exact[i]) - truth[i])));
  }
}

Camera cameraOf(const Scene& s, const Pose& pose) {
  return makeCamera(pose, perspective(s.fov, s.viewport, s.near, s.far), s.viewport);
}

/// The eye of a pose at a place: its ECEF doubles, where tiny ones count as 0.
Real3 eyeAt(const Geodetic& place, const Pose& pose) {
  const Vec3 eye = pose.eye(), ecef = geodeticToEcef(place);
  for (std::size_t i = 0; i < 3; ++i) REQUIRE(eye[i] == (std::fabs(ecef[i]) < kSmallestNumber ? 0 : ecef[i]));
  return toReal(eye);
}

/// Projects points in the picture, behind and next to the eye plane; true if the camera's numbers are all exact.
struct Tally {
  int visible = 0, behind = 0, nearPlane = 0, onPlane = 0, uncertain = 0;
};
void requireExactProjection(Random& r, const Scene& scene, const TruePose& pose, const Camera& camera, Tally& tally) {
  Truth truth(scene);
  truth.pose = pose;
  for (int i = 0; i < 6; ++i) {
    const double far = r.logUniform(1e-2, 1e5);
    const Real right = far * r.uniform(-1, 1), up = far * r.uniform(-1, 1);
    const Real ahead = i < 3 ? Real(far) : i == 3 ? Real(-far) : Real(0);
    const Real3 p = pose.eye + pose.right * right + pose.up * up + pose.forward * ahead;
    const Vec3 point{double(p[0]), double(p[1]), double(p[2])};
    const Truth::View view = truth.view(toReal(point));
    const ScreenPoint got = worldToScreen(camera, point);
    CAPTURE(i, far, double(view.forward));
    REQUIRE(isExact(got.viewDistance, view.forward, scene.near));
    if (i > 3) ++tally.nearPlane;
    if (!got.certain) ++tally.uncertain;
    // As near the eye plane as this, the rows' rounding shows.
    if (abs(view.forward) < length(toReal(point) - pose.eye) * Real(0x1p-146)) {
      ++tally.onPlane;
      continue;
    }
    if (!(view.forward > Real(0))) {
      ++tally.behind;
      REQUIRE(got.status == PointStatus::behind);
      continue;
    }
    REQUIRE(got.status == PointStatus::inFront);
    const Truth::Screen screen = truth.screen(view);
    REQUIRE(isExact(got.x, screen.x, scene.viewport.width));
    REQUIRE(isExact(got.y, screen.y, scene.viewport.width));
    REQUIRE(isExact(got.depth, screen.depth, 1));
    if (got.certain) REQUIRE(std::max(ulps(got.x, screen.x), ulps(got.y, screen.y)) <= 0.5000001);
    if (got.visible()) ++tally.visible;
  }
}

Scene randomLens(Random& r) {
  Scene s;
  s.fov = r.uniform(1, 120);
  s.near = r.logUniform(1e-3, 1);
  s.far = kInfiniteFar;
  return s;
}

}  // namespace

TEST_CASE("Places go to ECEF and back within 10 nm, up to 5000 km high") {
  double worst = 0, worstBack = 0;
  std::map<int, int> visited;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random r(trial);
    const Geodetic place = randomPlace(r, kindOf(trial));
    ++visited[kindOf(trial)];
    const Vec3 ecef = geodeticToEcef(place);
    INFO("trial " << trial << ": " << place.lat << " " << place.lon << " " << place.height);
    worst = std::max(worst, distanceBetween(ecef, trueEcef(place)));
    REQUIRE(worst <= kGeodesyBound);
    const Geodetic back = ecefToGeodetic(ecef);
    worstBack = std::max(worstBack, distanceBetween(ecef, trueEcef(back)));
    REQUIRE(worstBack <= kGeodesyBound);
    REQUIRE(std::fabs(back.lon) <= 180);
  }
  CAPTURE(worst, worstBack);
  CHECK(visited.size() == kinds);
}

TEST_CASE("The axes of heading, pitch and roll are within 2^-100, and their exact rows within their bound") {
  RowErrors errors;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random r(trial + 100000);
    const Geodetic place = randomPlace(r, kindOf(trial));
    const HeadingPitchRoll turned = randomTurn(r, kindOf(trial));
    const Pose pose = poseFromHeadingPitchRoll(place, turned);
    const TruePose truth = truePose(place, turned);
    INFO("trial " << trial << ": " << place.lat << " " << place.lon << " turned " << turned.heading.value << " "
                  << turned.pitch.value << " " << turned.roll.value);
    add(errors, parts(pose).rows.right, parts(pose).exact->rows[0], truth.right);
    add(errors, parts(pose).rows.up, parts(pose).exact->rows[1], truth.up);
    add(errors, parts(pose).rows.forward, parts(pose).exact->rows[2], truth.forward);
    REQUIRE(errors.rounded <= 0x1p-100);
    REQUIRE(errors.exact <= kTurnedRowBound);
    const FineVec3 normal = exactNormal(place);
    const EastNorthUp frame = trueFrame(place);
    for (std::size_t i = 0; i < 3; ++i) REQUIRE(double(abs(sumOf(normal[i]) - frame.up[i])) <= kTurnedRowBound);
  }
  CAPTURE(errors.rounded, errors.exact);
  CHECK(errors.rounded > 0x1p-110);
  CHECK(errors.exact > 0x1p-222);
}

TEST_CASE("From anywhere on Earth projection is exact from the ECEF doubles on, next to the eye plane too") {
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random r(trial + 200000);
    const Geodetic place = randomPlace(r, kindOf(trial));
    const HeadingPitchRoll turned = randomTurn(r, kindOf(trial));
    const Scene scene = randomLens(r);
    TruePose truth = truePose(place, turned);
    const Pose pose = poseFromHeadingPitchRoll(place, turned);
    truth.eye = eyeAt(place, pose);
    INFO("trial " << trial << ": " << place.lat << " " << place.lon << " " << place.height << " turned "
                  << turned.heading.value << " " << turned.pitch.value << " " << turned.roll.value << ", fov "
                  << scene.fov);
    requireExactProjection(r, scene, truth, cameraOf(scene, pose), tally);
  }
  CAPTURE(tally.visible, tally.behind, tally.nearPlane, tally.onPlane, tally.uncertain);
  CHECK(tally.visible > 1000);
  CHECK(tally.behind > 1000);
  CHECK(tally.onPlane > 0);
  CHECK(tally.nearPlane == 2 * kTrials);
}

TEST_CASE("Looking from place to place is exact, down to targets nearly straight below") {
  Tally tally;
  int nearlyBelow = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random r(trial + 300000);
    const Geodetic place = randomPlace(r, kindOf(trial));
    Geodetic target = place;
    const bool below = r.chance(0.3);
    const double step = below ? r.logUniform(1e-9, 1e-6) : r.logUniform(1e-6, 1);
    target.lat = std::clamp(target.lat + step * r.uniform(-1, 1), -90.0, 90.0);
    target.lon += step * r.uniform(-1, 1);
    target.height = r.sign() * r.logUniform(1, 1e6);
    if (std::fabs(place.lat) == 90) target.lat = r.sign() * (90 - step);
    INFO("trial " << trial << ": " << place.lat << " " << place.lon << " " << place.height << " to " << target.lat
                  << " " << target.lon << " " << target.height);
    const Pose pose = lookAtPlace(place, target);
    TruePose truth;
    truth.eye = eyeAt(place, pose);
    const Real3 way = toReal(geodeticToEcef(target)) - truth.eye;
    truth.forward = unit(way);
    const Real3 side = cross(truth.forward, trueFrame(place).up);
    if (double(length(side)) < 1e-9) ++nearlyBelow;
    truth.right = unit(side);
    truth.up = cross(truth.right, truth.forward);
    const Scene scene = randomLens(r);
    requireExactProjection(r, scene, truth, cameraOf(scene, pose), tally);
  }
  CAPTURE(tally.visible, tally.behind, tally.uncertain, nearlyBelow);
  CHECK(tally.visible > 1000);
  CHECK(nearlyBelow > 20);
}

TEST_CASE("The bound of a camera and a point at places holds for the places, not for their rounded positions alone") {
  int looked = 0, beyondRounding = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random r(trial + 400000);
    const Geodetic place = randomPlace(r, kindOf(trial));
    const bool looks = r.coin();
    Geodetic target = place;
    target.lat = std::clamp(place.lat + r.uniform(-1e-3, 1e-3), -90.0, 90.0);
    target.lon += r.uniform(-1e-3, 1e-3);
    target.height -= r.logUniform(1, 1e4);
    const HeadingPitchRoll turned = randomTurn(r, kindOf(trial));
    const Scene scene = randomLens(r);
    Truth truth(scene);
    Pose pose = poseFromHeadingPitchRoll(place, turned);
    truth.pose = truePose(place, turned);
    truth.pose.eye = trueEcef(place);
    if (looks) {
      if (std::fabs(place.lat) == 90) continue;
      pose = lookAtPlace(place, target);
      truth.pose.forward = unit(trueEcef(target) - truth.pose.eye);
      truth.pose.right = unit(cross(truth.pose.forward, trueFrame(place).up));
      truth.pose.up = cross(truth.pose.right, truth.pose.forward);
      ++looked;
    }
    const Camera camera = cameraOf(scene, pose);
    for (int i = 0; i < 4; ++i) {
      const double far = r.logUniform(1, 1e5);
      const Real3 near = truth.pose.eye + (truth.pose.right * Real(r.uniform(-.5, .5)) +
                                           truth.pose.up * Real(r.uniform(-.5, .5)) + truth.pose.forward) *
                                              Real(far);
      const Geodetic there = ecefToGeodetic({double(near[0]), double(near[1]), double(near[2])});
      const Vec3 point = geodeticToEcef(there);
      const ScreenPoint got = worldToScreen(camera, point);
      const ErrorBound bound = boundOfPoint(camera, point, Precision::exact, placeError(point));
      const Truth::Screen screen = truth.screen(truth.view(trueEcef(there)));
      const double error = double(abs(Real(got.x) - screen.x));
      INFO("trial " << trial << "." << i << ": " << error << " of " << bound.screen);
      REQUIRE(error <= bound.screen);
      REQUIRE(double(abs(Real(got.y) - screen.y)) <= bound.screen);
      REQUIRE(double(abs(Real(got.depth) - screen.depth)) <= bound.depth);
      beyondRounding += error > 2 * halfUlp(got.x);
    }
  }
  CHECK(looked > int(kTrials) / 4);
  CHECK(beyondRounding > int(kTrials));
}
