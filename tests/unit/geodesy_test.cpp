#include "viewproj/geodesy.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "parts.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

double distanceBetween(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

struct Place {
  Geodetic geodetic;
  Vec3 ecef;
};

// The first two are published, IOGP Guidance Note 7-2 and its test in PROJ; the rest GeographicLib's CartConvert.
constexpr Place kPlaces[] = {
    {{55, 5, 200}, {3652755.305807658, 319574.679892340, 5201547.353611131}},
    {{53.80939444444444, 2.12955, 73}, {3771793.967641783, 140253.341899613, 5124304.349350536}},
    {{90, 0, 0}, {0, 0, 6356752.3142451793}},
    {{90, 77, 1000}, {0, 0, 6357752.3142451793}},
    {{-90, -120, 12.5}, {0, 0, -6356764.8142451793}},
    {{0, 0, 0}, {6378137, 0, 0}},
    {{0, 180, 0}, {-6378137, 0, 0}},
    {{45, -180, -100}, {-4517520.1681708125, 0, 4487277.6981878011}},
    {{-33.25, 151.125, 58}, {-4675555.8926124768, 2578384.3718729587, -3477210.9658103860}},
    {{27.988056, 86.925278, 8848}, {302742.6703562936, 5636029.2242822545, 2979488.7755781310}},
    {{71.5, 179.9999999, 3}, {-2029933.2223592126, 0.0035429016, 6026217.2447218243}},
    {{-0.0000001, -90, 35786000}, {0, -42164137, -0.0735157802}},
    {{89.9999999, 13, 5}, {0.0108831349, 0.0025125697, 6356757.3142451793}},
};

}  // namespace

TEST_CASE("Places have the ECEF coordinates that are published and that GeographicLib's tool gives, to 10 nm") {
  for (const Place& place : kPlaces) {
    INFO(place.geodetic.lat << " " << place.geodetic.lon << " " << place.geodetic.height);
    CHECK(distanceBetween(geodeticToEcef(place.geodetic), place.ecef) <= kGeodesyBound);
    const Geodetic back = ecefToGeodetic(place.ecef);
    CHECK(distanceBetween(geodeticToEcef(back), place.ecef) <= kGeodesyBound);
    CHECK(std::fabs(back.height - place.geodetic.height) <= kGeodesyBound);
  }
}

TEST_CASE("What is no place has no coordinates, and a pose there is an error that names the field") {
  const double inf = INFINITY, nan = NAN;
  for (const Geodetic& bad : {Geodetic{90.0000001, 0, 0}, Geodetic{-91, 0, 0}, Geodetic{nan, 0, 0}, Geodetic{0, inf, 0},
                              Geodetic{0, nan, 0}, Geodetic{0, 0, nan}, Geodetic{0, 0, -inf}}) {
    CHECK_FALSE(isPlace(bad));
    CHECK(std::isnan(geodeticToEcef(bad).x));
    CHECK(std::isnan(geodeticToEcef(bad).z));
    CHECK(fieldAtFault([&] { poseFromHeadingPitchRoll(bad, {}); }).starts_with("position."));
    CHECK(fieldAtFault([&] { lookAtPlace({1, 2, 3}, bad); }).starts_with("target."));
    CHECK(fieldAtFault([&] { lookAtOnEarth({1, 2, 3}, {4, 5, 6}, bad, Handedness::right); }) == "up");
  }
  CHECK(std::isnan(ecefToGeodetic({0, nan, 0}).lat));
  CHECK(std::isnan(ecefToGeodetic({0, 0, inf}).height));
  CHECK(fieldAtFault([&] { poseFromHeadingPitchRoll({}, {.heading = inf}); }) == "heading");
  CHECK(fieldAtFault([&] { poseFromHeadingPitchRoll({}, {.pitch = 180.5}); }) == "pitch");
  CHECK(fieldAtFault([&] { poseFromHeadingPitchRoll({}, {.pitch = nan}); }) == "pitch");
  CHECK(fieldAtFault([&] { poseFromHeadingPitchRoll({}, {.roll = nan}); }) == "roll");
  CHECK_FALSE(std::signbit(ecefToGeodetic({6378137, 0, -0.0}).lat));
}

TEST_CASE("In east, north and up heading turns from y towards x, pitch up, and roll puts the right side down") {
  const auto near = [](const Vec3& a, const Vec3& b) {
    return std::fabs(a.x - b.x) + std::fabs(a.y - b.y) + std::fabs(a.z - b.z) < 1e-15;
  };
  const Pose level = poseInEastNorthUp({1, 2, 3}, {.heading = 30});
  CHECK(level.eye() == Vec3{1, 2, 3});
  CHECK(near(level.forward(), {0.5, std::sqrt(0.75), 0}));
  CHECK(near(level.right(), {std::sqrt(0.75), -0.5, 0}));
  CHECK(level.up() == Vec3{0, 0, 1});
  CHECK(poseInEastNorthUp({}, {.pitch = 90}).forward() == Vec3{0, 0, 1});
  CHECK(poseInEastNorthUp({}, {.roll = 90}).right() == Vec3{0, 0, -1});
  // Beyond the vertical: 60 degrees before straight down, upside down.
  const Pose over = poseInEastNorthUp({}, {.heading = 90, .pitch = -120});
  CHECK(near(over.forward(), {-0.5, 0, -std::sqrt(0.75)}));
  CHECK(near(over.up(), {std::sqrt(0.75), 0, -0.5}));
  CHECK(fieldAtFault([&] { poseInEastNorthUp({0, NAN, 0}, {}); }) == "position");
}

TEST_CASE("A camera at a place without angles is level and looks north") {
  const Pose pose = poseFromHeadingPitchRoll({0, 0, 0}, {});
  CHECK(pose.forward() == Vec3{0, 0, 1});
  CHECK(pose.up() == Vec3{1, 0, 0});
}

TEST_CASE("A target straight above or below is an error, one a nanodegree beside it is not") {
  const auto fault = [](const Geodetic& a, const Geodetic& b) { return fieldAtFault([&] { lookAtPlace(a, b); }); };
  CHECK(fault({10, 20, 30}, {10, 20, 30}) == "target");
  CHECK(fault({10, 20, 30}, {10, 20, 1000}) == "target");
  CHECK(fault({10, 20, 30}, {10, 380, -30}) == "target");
  CHECK(fault({10, -180, 30}, {10, 180, -30}) == "target");
  CHECK(fault({90, -180, 30}, {90, 12, -30}) == "target");
  CHECK(fault({10, 20, 3000}, {10, 20 + 1e-9, 0}).empty());
  CHECK(fault({0, 0, 0}, {0, 180, 0}) == "up");  // through the centre of the Earth
}

TEST_CASE("A ray meets a surface of constant height where its height is that, once on its way in and once out") {
  Random random(7);
  int inwards = 0, outwards = 0, twice = 0, grazing = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const double size = random.logUniform(1, 1e6);
    const double height = trial % 10 == 0 ? 0 : std::max(random.uniform(-size, size), kLeastCrossedHeight);
    const Geodetic place{random.uniform(-90, 90), random.uniform(-180, 180), height};
    const Vec3 point = geodeticToEcef(place), above = geodeticToEcef({place.lat, place.lon, height + 1e7});
    Vec3 normal, direction;
    for (std::size_t i = 0; i < 3; ++i) normal[i] = (above[i] - point[i]) / 1e7, direction[i] = random.uniform(-1, 1);
    // Some nearly along the surface.
    double slope = normal.x * direction.x + normal.y * direction.y + normal.z * direction.z;
    if (trial % 5 == 0)
      for (std::size_t i = 0; i < 3; ++i) direction[i] -= slope * (1 - 1e-4) * normal[i];
    const double length = std::hypot(direction.x, direction.y, direction.z);
    for (std::size_t i = 0; i < 3; ++i) direction[i] /= length;
    slope = normal.x * direction.x + normal.y * direction.y + normal.z * direction.z;
    const double before = random.uniform(0, 2e5);
    Ray ray{{}, direction};
    for (std::size_t i = 0; i < 3; ++i) ray.origin[i] = point[i] - before * direction[i];
    CAPTURE(trial, place.lat, place.lon, height, before, slope);
    const HeightCrossings got = crossingsOfHeight(ray, height);
    REQUIRE(got.count >= 1);
    // One of them is the point that the ray was made to go through.
    double nearest = 1e300;
    for (int k = 0; k < got.count; ++k) {
      const double t = got.distances[static_cast<std::size_t>(k)];
      nearest = std::min(nearest, std::fabs(t - before));
      const Vec3 at{ray.origin.x + t * direction.x, ray.origin.y + t * direction.y, ray.origin.z + t * direction.z};
      CHECK(std::fabs(ecefToGeodetic(at).height - height) <= kCrossingBound);
    }
    CHECK(nearest <= 1e-7 / std::fabs(slope));
    if (got.count == 2) CHECK(got.distances[0] < got.distances[1]);
    twice += got.count == 2;
    grazing += std::fabs(slope) < 1e-4;
    (slope < 0 ? inwards : outwards)++;
  }
  CHECK(inwards > 2000);
  CHECK(outwards > 2000);
  CHECK(twice > 500);
  CHECK(grazing > 500);
}

TEST_CASE("A surface of constant height is missed, touched and begun on") {
  const double a = 6378137;
  const auto count = [](const Vec3& origin, const Vec3& direction, double height) {
    return crossingsOfHeight({origin, direction}, height).count;
  };
  CHECK(count({a + 2000, -1e6, 0}, {0, 1, 0}, 1000) == 0);
  CHECK(count({a + 1000, -1e6, 0}, {0, 1, 0}, 1000.001) == 2);
  CHECK(count({a + 1000, -1e6, 0}, {0, 1, 0}, 999.999) == 0);
  // Away from it, from below it, and from the Earth's centre.
  CHECK(count({a + 2000, 0, 0}, {1, 0, 0}, 1000) == 0);
  CHECK(count({a, 0, 0}, {1, 0, 0}, 1000) == 1);
  CHECK(count({0, 0, 0}, {0, 0, 1}, 1000) == 1);
  const HeightCrossings on = crossingsOfHeight({{a + 1000, 0, 0}, {-1, 0, 0}}, 1000);
  REQUIRE(on.count == 2);
  CHECK(on.distances[0] <= kCrossingBound);
  CHECK(std::fabs(on.distances[1] - 2 * (a + 1000)) < 1e-6);
  CHECK(count({a, 0, 0}, {0, 0, 0}, 1000) == 0);
  CHECK(count({std::numeric_limits<double>::infinity(), 0, 0}, {1, 0, 0}, 1000) == 0);
  CHECK(count({a + 1000, 0, 0}, {-1, 0, 0}, -1.1e6) == 0);
}
