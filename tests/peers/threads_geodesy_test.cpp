// What users of Cesium have stumbled over where cameras stand on the Earth: which axes heading, pitch and roll turn
// about, which way they count, and from where.
#include <array>

#include "catch.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;

namespace {

constexpr double kDegree = M_PI / 180;

using Rows = std::array<Vec3, 3>;

double dotOf(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// East, north, up as a double has them.
Rows eastNorthUp(const Geodetic& g) {
  const double sp = std::sin(g.lat * kDegree), cp = std::cos(g.lat * kDegree);
  const double sl = std::sin(g.lon * kDegree), cl = std::cos(g.lon * kDegree);
  return {{{-sl, cl, 0}, {-sp * cl, -sp * sl, cp}, {cp * cl, cp * sl, sp}}};
}

Vec3 localOf(const Rows& frame, const DDVec3& axis) {
  const Vec3 v = rounded(axis);
  return {dotOf(frame[0], v), dotOf(frame[1], v), dotOf(frame[2], v)};
}

/// Rotates v by degrees about an axis of the frame, right-handed.
Vec3 rotatedAbout(int axis, double degrees, const Vec3& v) {
  const double s = std::sin(degrees * kDegree), c = std::cos(degrees * kDegree);
  if (axis == 0) return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
  if (axis == 1) return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
  return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

void checkSame(const Vec3& a, const Vec3& b) {
  CHECK(std::fabs(a.x - b.x) < 1e-14);
  CHECK(std::fabs(a.y - b.y) < 1e-14);
  CHECK(std::fabs(a.z - b.z) < 1e-14);
}

constexpr Geodetic kSomewhere{40.0397, -75.5962, 350};
constexpr HeadingPitchRoll kTurns[] = {{0, 0, 0},     {30, 0, 0},     {0, 20, 0},     {0, 0, 10},     {30, 20, 10},
                                       {123, -45, 7}, {-60, 80, -95}, {200, -5, 179}, {345, -89, 271}};

}  // namespace

TEST_CASE(
    "Roll turns about the view, pitch about the camera's right, heading about up, clockwise from north "
    "[cesium#3256, cesium#11523]") {
  // Cesium: roll about x, then pitch about -y, then heading about -z, of a body whose nose is x; its camera takes
  // heading - 90 degrees, because x is east.
  const Rows frame = eastNorthUp(kSomewhere);
  for (const HeadingPitchRoll& t : kTurns) {
    INFO(t.heading << " " << t.pitch << " " << t.roll);
    const Pose pose = poseFromHeadingPitchRoll(kSomewhere, t);
    const auto turned = [&](const Vec3& v) {
      return rotatedAbout(2, 90 - t.heading, rotatedAbout(1, -t.pitch, rotatedAbout(0, t.roll, v)));
    };
    checkSame(localOf(frame, pose.rows.forward), turned({1, 0, 0}));
    checkSame(localOf(frame, pose.rows.right), turned({0, -1, 0}));
    checkSame(localOf(frame, pose.rows.up), turned({0, 0, 1}));
  }
}

TEST_CASE(
    "Heading, pitch and roll read back from the axes are those given, roll being atan2(-right.z, up.z) [cesium#2446]") {
  const Rows frame = eastNorthUp(kSomewhere);
  for (const HeadingPitchRoll& t : kTurns) {
    INFO(t.heading << " " << t.pitch << " " << t.roll);
    const Pose pose = poseFromHeadingPitchRoll(kSomewhere, t);
    const Vec3 direction = localOf(frame, pose.rows.forward), right = localOf(frame, pose.rows.right),
               up = localOf(frame, pose.rows.up);
    const auto turn = [](double radians, double degrees) {
      return std::fabs(std::remainder(radians / kDegree - degrees, 360));
    };
    CHECK(turn(M_PI / 2 - std::atan2(direction.y, direction.x), t.heading) < 1e-11);
    CHECK(turn(M_PI / 2 - std::acos(direction.z), t.pitch) < 1e-11);
    CHECK(turn(std::atan2(-right.z, up.z), t.roll) < 1e-11);
  }
}

TEST_CASE("At a pole, on the Earth's axis and at its centre there are east, north and up [cesium#11463]") {
  for (const Geodetic& g : {Geodetic{90, 0, 0}, Geodetic{-90, 30, 100}, ecefToGeodetic({0, 0, 6400000}),
                            ecefToGeodetic({0, 0, -1}), ecefToGeodetic({0, 0, 0})}) {
    INFO(g.lat << " " << g.lon << " " << g.height);
    const Pose pose = poseFromHeadingPitchRoll(g, {});
    const Rows frame = eastNorthUp(g);
    checkSame(rounded(pose.rows.right), frame[0]);
    checkSame(rounded(pose.rows.forward), frame[1]);
    checkSame(rounded(pose.rows.up), frame[2]);
  }
}

TEST_CASE("East, north and up do not change with the height [cesium#8989]") {
  const Pose low = poseFromHeadingPitchRoll({45, 45, 0}, {}), high = poseFromHeadingPitchRoll({45, 45, 1e7}, {});
  CHECK(rounded(low.rows.up) == rounded(high.rows.up));
  CHECK(rounded(low.rows.up).z == std::sqrt(0.5));
  CHECK(rounded(low.rows.forward) == rounded(high.rows.forward));
}
