// No shape is called inside or outside that is not, and frustum planes are the textbook's.
#include <cstdlib>
#include <map>

#include "catch.hpp"
#include "internals.hpp"
#include "reference/scene.hpp"
#include "viewproj/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

using reference::toReal;

std::size_t casesWanted() {
  const char* wanted = std::getenv("VIEWPROJ_SHAPE_CASES");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 15000;
}

/// A random scene's camera, frustum and true planes.
struct World {
  explicit World(Scene s) : scene(std::move(s)), truth(scene), camera(build(scene)), frustum(viewFrustum(camera)) {
    planes = truth.planes(camera.viewport());
  }
  Scene scene;
  Truth truth;
  Camera camera;
  Frustum frustum;
  std::array<TruePlane, 6> planes;
};

World randomWorld(std::uint64_t trial, Random& random) {
  const double reach = trial % 3 == 0 ? 6.4e6 : random.logUniform(1e-3, 1e12);
  return World(randomScene(random, reach));
}

double oneNorm(const Real3& v) { return double(abs(v[0]) + abs(v[1]) + abs(v[2])); }

/// Within 0.51 ulp or within a bound.
bool isNear(double got, const Real& truth, double bound) {
  return ulps(got, truth) <= 0.51 || double(abs(Real(got) - truth)) <= bound;
}

int indexOf(unsigned side) {
  for (int i = 0; i < 6; ++i)
    if (side == 1u << i) return i;
  return -1;
}

/// What a plane is to a shape: the true distances of its inmost and outmost points, and the bounds on what was computed
/// for the verdict and for the plane that is named.
struct Margin {
  Real inmost, outmost;
  double bound = 0, nameBound = 0;
};

bool isTilted(const Camera& camera, Side side) {
  return !camera.projection().isOrthographic() && side != sideNear && side != sideFar;
}

/// reach: how far from the eye the shape's points lie.
Margin marginOf(const World& w, const ExactPlane& p, double reach, const Real& inmost, const Real& outmost) {
  const double edge = std::fabs(double(p.edge)) * (isTilted(w.camera, p.side) ? reach : 1);
  return {inmost, outmost, 2 * kCullBound * std::fabs(double(p.scale)) * (reach + edge),
          0x1p-48 * (reach + std::fabs(p.offset))};
}

std::vector<Margin> marginsOf(const World& w, const Sphere& s) {
  std::vector<Margin> margins;
  const double reach = oneNorm(toReal(s.center) - toReal(parts(w.camera).pose.eye)) + s.radius;
  for (const ExactPlane& p : parts(w.frustum)) {
    const Real d = w.planes[std::size_t(indexOf(p.side))].distance(toReal(s.center));
    margins.push_back(marginOf(w, p, reach, d + Real(s.radius), d - Real(s.radius)));
  }
  return margins;
}

/// By all eight corners.
std::vector<Margin> marginsOf(const World& w, const Box& b) {
  std::vector<Margin> margins;
  const Real3 eye = toReal(parts(w.camera).pose.eye);
  const double reach = oneNorm(toReal(b.min) - eye) + oneNorm(toReal(b.max) - eye);
  for (const ExactPlane& p : parts(w.frustum)) {
    Margin m;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Real3 at{corner & 1 ? b.max.x : b.min.x, corner & 2 ? b.max.y : b.min.y, corner & 4 ? b.max.z : b.min.z};
      const Real d = w.planes[std::size_t(indexOf(p.side))].distance(at);
      if (corner == 0 || d > m.inmost) m.inmost = d;
      if (corner == 0 || d < m.outmost) m.outmost = d;
    }
    margins.push_back(marginOf(w, p, reach, m.inmost, m.outmost));
  }
  return margins;
}

/// What is wrong with a verdict, or nothing. inside and outside must be true; intersects may be said too often.
std::string wrongWith(const Cull& got, const std::vector<Margin>& margins) {
  const int decided = indexOf(got.side);
  if ((got.verdict == CullVerdict::inside) != (decided < 0)) return "a side that does not fit";
  if (decided >= int(margins.size())) return "a plane that is absent";
  for (std::size_t i = 0; i < margins.size(); ++i) {
    const Margin& m = margins[i];
    const Real twice = 2 * m.bound;
    if (got.verdict != CullVerdict::outside && m.inmost < -twice) return "not outside, but beyond a plane";
    if (got.verdict == CullVerdict::inside && m.outmost < -twice) return "inside, but reaches beyond a plane";
    if (decided < 0) continue;
    const Margin& by = margins[std::size_t(decided)];
    const Real both = m.nameBound + by.nameBound;
    if (got.verdict == CullVerdict::outside && m.inmost < by.inmost - both) return "farther beyond another plane";
    if (got.verdict == CullVerdict::intersects && m.outmost < by.outmost - both)
      return "reaches farther beyond another";
  }
  if (got.verdict == CullVerdict::outside && !(margins[std::size_t(decided)].inmost < Real(0))) return "not outside";
  if (got.verdict == CullVerdict::intersects && !(margins[std::size_t(decided)].outmost < Real(0)))
    return "does not reach beyond the plane";
  return {};
}

/// A point in or around the view; on a plane, as nearly as doubles can, where one is given.
Vec3 pointNear(Random& random, const World& w, const TruePlane* on) {
  const Vec3 p = pointInView(random, w.truth, random.chance(0.5) ? 1 : 3);
  Real3 at = toReal(p);
  if (random.chance(0.1)) at = w.truth.pose.eye * Real(2) - at;  // behind
  if (on) at = at - on->normal * on->distance(at);
  return {double(at[0]), double(at[1]), double(at[2])};
}

struct Tally {
  std::size_t cases = 0, verdicts[3] = {}, sides[6] = {}, close = 0;
};

}  // namespace

TEST_CASE("Frustum planes are the textbook's to within their bounds") {
  std::map<std::string, int> visited;
  for (std::uint64_t trial = 0; trial < 3000; ++trial) {
    Random random(trial + 20000000);
    const World w = randomWorld(trial, random);
    const double eye = oneNorm(w.truth.pose.eye);
    INFO("trial " << trial << ": " << describe(w.scene));
    const bool infinite = std::isinf(parts(w.camera).projection.far);
    REQUIRE(parts(w.frustum).count == (infinite ? 5 : 6));
    std::size_t i = 0;
    for (const ExactPlane& p : parts(w.frustum)) {
      const Vec4& equation = parts(w.frustum).rounded[i].equation;
      const Projection lens = w.camera.projection();
      const bool isUpright = p.side == sideLeft || p.side == sideRight;
      const double edge = isUpright ? std::max(std::fabs(lens.left()), std::fabs(lens.right()))
                                    : std::max(std::fabs(lens.bottom()), std::fabs(lens.top()));
      const double perLength = std::fabs(double(p.scale)), tilt = isTilted(w.camera, p.side) ? edge : 0;
      const double bound = kPlaneBound * (1 + tilt) * perLength;
      const DDVec3& residual = parts(w.camera).pose.residual;
      const double terms = std::fabs(double(p.edge)) + maxAbs(residual) * (1 + tilt) + eye;
      CAPTURE(i, equation.x, equation.y, equation.z, equation.w, bound, terms);
      REQUIRE(p.side == 1u << i);
      const TruePlane& truth = w.planes[i++];
      REQUIRE(isNear(equation.x, truth.normal[0], bound));
      REQUIRE(isNear(equation.y, truth.normal[1], bound));
      REQUIRE(isNear(equation.z, truth.normal[2], bound));
      REQUIRE(isNear(equation.w, truth.offset, bound * terms));
    }
    ++visited[infinite ? "infinite" : w.truth.lens.orthographic ? "orthographic" : "finite"];
  }
  for (const char* kind : {"infinite", "orthographic", "finite"}) CHECK(visited[kind] > 200);
}

TEST_CASE("Points, spheres and boxes are inside, outside or neither as exact arithmetic says, beyond the bound") {
  Tally spheres, boxes;
  for (std::uint64_t trial = 0; spheres.cases + boxes.cases < casesWanted() * 2 / 3; ++trial) {
    Random random(trial + 30000000);
    const World w = randomWorld(trial, random);
    for (int i = 0; i < 16; ++i) {
      const TruePlane* on = i % 2 ? &w.planes[std::size_t(random.uniform(0, double(parts(w.frustum).count)))] : nullptr;
      const Vec3 at = pointNear(random, w, on);
      if (!isFinite(at)) continue;
      const std::string wrongPoint = wrongWith(cull(w.frustum, at), marginsOf(w, Sphere{at, 0}));
      if (!wrongPoint.empty()) FAIL_CHECK("trial " << trial << "." << i << ", point: " << wrongPoint);
      const double size = std::fabs(
          w.planes[4].distance(toReal(at)) > Real(0) ? double(w.planes[4].distance(toReal(at))) : w.scene.near);
      const auto check = [&](const auto& shape, Tally& tally) {
        const Cull got = cull(w.frustum, shape);
        const std::vector<Margin> margins = marginsOf(w, shape);
        const std::string wrong = wrongWith(got, margins);
        if (!wrong.empty()) FAIL_CHECK("trial " << trial << "." << i << ": " << wrong << ": " << describe(w.scene));
        ++tally.cases;
        ++tally.verdicts[int(got.verdict)];
        if (got.side != 0) ++tally.sides[indexOf(got.side)];
        for (const Margin& m : margins)
          if (abs(m.inmost) < Real(1e-14 * size) || abs(m.outmost) < Real(1e-14 * size)) {
            ++tally.close;
            break;
          }
      };
      if (i % 4 < 2) {
        double radius = random.chance(0.1) ? 0 : size * random.logUniform(1e-6, 1e2);
        if (random.chance(0.4)) {  // touches a plane, as nearly as a double can
          radius = std::fabs(
              double(w.planes[std::size_t(random.uniform(0, double(parts(w.frustum).count)))].distance(toReal(at))));
          if (random.chance(0.5)) radius = std::nextafter(radius, random.sign() * INFINITY);
        }
        if (radius >= 0) check(Sphere{at, radius}, spheres);
      } else {
        Box b{at, at};
        const double extent = size * random.logUniform(1e-6, 1e2);
        for (std::size_t k = 0; k < 3; ++k)
          (random.chance(0.5) ? b.min : b.max)[k] += random.chance(0.1) ? 0 : (random.chance(0.5) ? 1 : 0.1) * extent;
        for (std::size_t k = 0; k < 3; ++k)
          if (b.min[k] > b.max[k]) std::swap(b.min[k], b.max[k]);
        check(b, boxes);
      }
    }
  }
  for (const Tally* t : {&spheres, &boxes}) {
    for (std::size_t count : t->verdicts) CHECK(count > t->cases / 50);
    for (std::size_t count : t->sides) CHECK(count > t->cases / 100);
    CHECK(t->close > t->cases / 20);
  }
}

TEST_CASE("A shape on a plane counts as on it, and one beyond by less than double-double tells as outside") {
  // Axes of thirds of 13: no row is a double, and yet points of the left plane, 15 x + 7 y + 8 z = 0, are.
  std::size_t on = 0, beyond = 0;
  for (std::uint64_t trial = 0; trial < 3000; ++trial) {
    Random r(trial);
    Vec3 at;
    for (bool isInView = false; !isInView;) {
      const double size = std::ldexp(1, int(r.uniform(4, 40)));
      at.x = std::round(r.uniform(-size, size)), at.y = std::round(r.uniform(-size, size));
      at.z = -(15 * at.x + 7 * at.y) / 8;
      isInView = 2 * std::fabs(4 * at.x - 12 * at.y + 3 * at.z) < 3 * at.x + 4 * at.y + 12 * at.z;
    }
    const double side = 8 / (13 * std::sqrt(2.0));  // of the plane's unit normal, along z
    const auto frustumAt = [&](double eyeZ) {
      const Pose pose = lookAlong({0, 0, eyeZ}, {3, 4, 12}, {4, -12, 3}, Handedness::right);
      return viewFrustum(makeCamera(pose, perspective(90, 1, 1e-3, kInfiniteFar), {100, 100}));
    };
    // Seen from the eye, both of a box's corners count, and a sphere's centre and radius.
    const ExactPlane left = *parts(frustumAt(0)).begin();
    REQUIRE(left.side == sideLeft);
    for (const bool isBox : {false, true})
      for (const double share : {0.0, 0.3, 0.7, 0.95, 1.05, 1.5}) {
        const Box box{at, at};
        const double reach = (isBox ? 2 : 1) * (std::fabs(at.x) + std::fabs(at.y) + std::fabs(at.z));
        const Frustum f = frustumAt(share * kPlaneBound * std::sqrt(2.0) * reach / side);
        const Cull got = isBox ? cull(f, box) : cull(f, Sphere{at, 0});
        CHECK(cull(f, at).verdict == (share > 0 ? CullVerdict::outside : CullVerdict::inside));
        INFO("trial " << trial << ", " << (isBox ? "box, " : "sphere, ") << share << " of the bound beyond");
        if (share > 0) {
          CHECK(got.verdict == CullVerdict::outside);
          CHECK(int(got.side) == int(sideLeft));
          ++beyond;
        } else {
          CHECK(got.verdict != CullVerdict::outside);
          CHECK(distanceInside(parts(f), left, exactDistances(parts(f.camera()).pose, {at.x, at.y, at.z, 1})).sign() ==
                0);
          ++on;
        }
      }
  }
  CHECK(on == 6000);
  CHECK(beyond == 30000);
}
