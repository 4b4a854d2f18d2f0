// No verdict on a ray and a shape differs from exact arithmetic's, and no number from its bound.
//
// The number of cases: VIEWPROJ_SHAPE_CASES in the environment, for hits and for culling each.
#include <cstdlib>
#include <map>

#include "catch.hpp"
#include "internals.hpp"
#include "reference/shapes/hit_cases.hpp"
#include "scene/frustum_parts.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

std::size_t casesWanted() {
  const char* wanted = std::getenv("VIEWPROJ_SHAPE_CASES");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 15000;
}

Hits hitsOf(const HitCase& c) {
  return std::visit([&](const auto& s) { return intersect(c.ray, s); }, c.shape);
}

bool isUsable(const HitCase& c) {
  return isInRange(c.ray.origin) && isInRange(c.ray.direction) && maxAbs(c.ray.direction) > 0 &&
         std::visit([](const auto& s) { return isValid(s); }, c.shape);
}

/// Within `ulps` units in the last place (1 for subnormal numbers), or within `also`. What lies beyond the largest
/// double must be infinite.
bool isNear(double got, const Real& truth, double ulps, const Real& also) {
  const double nearest = double(truth);
  if (got == nearest) return true;
  if (!std::isfinite(got) || !std::isfinite(nearest)) return false;
  const double size = std::fabs(nearest);
  const Real ulp = Real(std::nextafter(size, INFINITY)) - Real(size);
  const Real error = abs(Real(got) - truth);
  return error <= ulp * Real(std::isnormal(nearest) ? ulps : 1) || error <= also;
}

/// What is wrong with a hit, or nothing.
std::string wrongWith(const Hit& got, const TrueHit& truth) {
  if (!(got.distance >= 0)) return "a distance below 0";
  if (!isNear(got.distance, truth.distance, kHitUlps, 0)) return "the distance";
  Real3 normal = truth.normal;
  if (!truth.faces.empty() && truth.faces[0] != BoxFace::none) {
    if (std::find(truth.faces.begin(), truth.faces.end(), got.face) == truth.faces.end()) return "the face";
    const int face = int(got.face) - 1;
    normal = {0, 0, 0};
    normal[std::size_t(face / 2)] = face % 2 ? 1 : -1;
  } else if (got.face != BoxFace::none) {
    return "a face of no box";
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!isNear(got.point[i], truth.point[i], kHitUlps, truth.slack)) return "the point";
    if (!isNear(got.normal[i], normal[i], kHitUlps, truth.normalSlack)) return "the normal";
  }
  return {};
}

struct Tally {
  std::size_t cases = 0, hits[3] = {}, touches = 0, startsOn = 0, startsInside = 0, wide = 0;
};

}  // namespace

TEST_CASE("Hits are those of exact arithmetic, and their numbers within the bounds") {
  const auto families = hitFamilies();
  std::map<std::string, Tally> tallies;
  Tally all;
  for (std::size_t trial = 0; all.cases < casesWanted(); ++trial) {
    Random random(trial);
    const HitFamily& family = families[trial % families.size()];
    const HitCase c = family.make(random);
    if (!isUsable(c)) continue;  // a random number was too large
    const TrueHits truth = trueHits(c.ray, c.shape);
    const Hits got = hitsOf(c);
    std::string wrong;
    if (got.count != int(truth.hits.size()))
      wrong = "the number of hits: " + std::to_string(got.count) + ", not " + std::to_string(truth.hits.size());
    for (std::size_t i = 0; wrong.empty() && i < truth.hits.size(); ++i) wrong = wrongWith(got.hits[i], truth.hits[i]);
    if (!wrong.empty()) FAIL_CHECK(family.name << ", trial " << trial << ": " << wrong);
    for (Tally* t : {&all, &tallies[family.name]}) {
      ++t->cases;
      ++t->hits[truth.hits.size()];
      t->touches += truth.touches;
      t->startsOn += truth.startsOn;
      t->startsInside += truth.startsInside;
      t->wide += truth.wide;
    }
  }
  for (const auto& [name, t] : tallies) {
    INFO(name);
    CHECK(t.hits[0] > 0);
    CHECK(t.hits[1] + t.hits[2] > 0);
  }
  CHECK(tallies.size() == families.size());
  const auto share = [&](const char* name, std::size_t Tally::*of) {
    const Tally& t = tallies[name];
    return double(t.*of) / double(t.cases);
  };
  // What each family is there for, it meets.
  CHECK(share("tangent to sphere", &Tally::touches) > 0.4);
  CHECK(share("starts on sphere", &Tally::startsOn) > 0.3);
  CHECK(share("sphere of radius 0", &Tally::touches) > 0.2);
  CHECK(share("Earth, exactly", &Tally::touches) > 0.05);
  CHECK(share("Earth, exactly", &Tally::startsOn) > 0.1);
  CHECK(share("box of whole numbers", &Tally::touches) > 0.02);
  CHECK(share("box of whole numbers", &Tally::startsOn) > 0.1);
  CHECK(share("triangle of whole numbers", &Tally::touches) > 0.03);
  CHECK(share("triangle of whole numbers", &Tally::startsOn) > 0.02);
  CHECK(share("plane of whole numbers", &Tally::startsOn) > 0.1);
  CHECK(all.wide > all.cases / 50);
  CHECK(all.startsInside > all.cases / 50);
}
