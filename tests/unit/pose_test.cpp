#include "catch.hpp"
#include "internals.hpp"
#include "projection/exact_point.hpp"
#include "viewproj/camera.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

/// The field that a call complains about, and its message.
template <class Call>
std::pair<std::string, std::string> complaint(Call call) {
  try {
    call();
  } catch (const CameraError& e) {
    return {e.field(), e.message()};
  }
  return {"", ""};
}

Vec3 nearest(const DDVec3& v) { return rounded(v); }

constexpr auto right = Handedness::right;
constexpr auto left = Handedness::left;

}  // namespace

TEST_CASE("A matrix to the world that mirrors along one axis keeps the other two") {
  const Mat4 mirrored{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1}}}};
  const Pose pose = poseFromWorldFromCamera(mirrored, CameraAxes::RUF, Handedness::right);
  CHECK(pose.right() == Vec3{1, 0, 0});
  CHECK(pose.up() == Vec3{0, 1, 0});
  CHECK(pose.forward() == Vec3{0, 0, -1});
}

TEST_CASE("In a right-handed world looking along -z, right is +x; in a left-handed one looking along +z it is too") {
  const Pose rh = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, right);
  CHECK(nearest(parts(rh).rows.right) == Vec3{1, 0, 0});
  CHECK(nearest(parts(rh).rows.up) == Vec3{0, 1, 0});
  const Pose lh = lookAlong({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, left);
  CHECK(nearest(parts(lh).rows.right) == Vec3{1, 0, 0});
  CHECK(nearest(parts(lh).rows.up) == Vec3{0, 1, 0});
}

TEST_CASE("Up needs only a part across the viewing direction") {
  const Pose pose = lookAlong({0, 0, 0}, {0, 0, -2}, {0, 3, 5}, right);
  CHECK(nearest(parts(pose).rows.up) == Vec3{0, 1, 0});
  CHECK(parts(lookAt({-1e90, 0, 0}, {1e90, 0, 0}, {0, 1, 0}, Handedness::right)).rows.forward.x.hi == 1);
}

TEST_CASE("An up that is parallel to the view is an error, one that is off by the last bit is not") {
  const double off = std::nextafter(1.0, 2.0);
  CHECK(complaint([] { lookAlong({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, right); }).first == "up");
  CHECK(complaint([] { lookAlong({0, 0, 0}, {1, 1, 1}, {-2, -2, -2}, right); }).first == "up");
  CHECK(complaint([&] { lookAlong({0, 0, 0}, {1, 1, 1}, {1, off, 1}, right); }).first.empty());
  CHECK(complaint([] { lookAt({0.1, 0.2, 0.3}, {0.1, 0.2 + 1e-9, 0.3}, {0, 1, 0}, right); }).first == "up");
}

TEST_CASE("An eye and a target at opposite ends of the range are as far apart as they are") {
  const Pose pose = lookAt({-1e90, -0.5e90, 0}, {1e90, 0.5e90, 0}, {0, 0, 1}, right);
  const Vec3 forward = nearest(parts(pose).rows.forward);
  CHECK(forward.x == 2 * forward.y);
  CHECK(forward.x * forward.x + forward.y * forward.y == closely(1));
  CHECK(nearest(parts(pose).rows.up) == Vec3{0, 0, 1});
}

TEST_CASE("An up that its own error makes doubtful is an error, long before the picture is") {
  const auto within = [](double error) {
    FineVec3 up{{0, 1, 0}, 0};
    // Across up, and nearly along it: the part across is what counts.
    for (const Vec3& way : {Vec3{0, -0x1p-40, -1}, Vec3{0, -1, -0x1p-40}}) {
      up.error = error * std::fabs(way.z);
      if (complaint([&] { lookAlong({1, 2, 3}, way, up, right); }).first != (error > 0x1p-106 ? "up" : ""))
        return false;
    }
    return true;
  };
  CHECK(within(0x1p-120));
  CHECK(within(0x1p-106));
  CHECK(within(0x1p-104));
  CHECK(within(0x1p-90));
}

TEST_CASE("What does not make a pose is named") {
  CHECK(complaint([] { lookAt({1, 2, 3}, {1, 2, 3}, {0, 1, 0}, right); }).first == "target");
  CHECK(complaint([] { lookAlong({1, 2, 3}, {0, 0, 0}, {0, 1, 0}, right); }).first == "direction");
  CHECK(complaint([] { lookAlong({1, 2, 3}, {0, 0, 1}, {0, 0, 0}, right); }).first == "up");
  CHECK(complaint([] { poseFromRotation({0, 0, 0}, {0, 0, 0, 0}, CameraAxes::RUB, right); }).first == "rotation");
}

TEST_CASE("A NaN or an infinity in any component of a pose is named") {
  for (double bad : {double(NAN), double(INFINITY), -double(INFINITY)})
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3 v{1, 2, 4};
      v[i] = bad;
      INFO(bad << " at " << i);
      CHECK(complaint([&] { lookAt(v, {0, 0, 0}, {0, 1, 0}, right); }).first == "position");
      CHECK(complaint([&] { lookAt({0, 0, 0}, v, {0, 1, 0}, right); }).first == "target");
      CHECK(complaint([&] { lookAlong({0, 0, 0}, v, {0, 1, 0}, right); }).first == "direction");
      CHECK(complaint([&] { lookAlong({0, 0, 0}, {1, 0, 0}, v, right); }).first == "up");
      CHECK(complaint([&] {
              poseFromRotation({0, 0, 0}, {v.x, v.y, v.z, 1}, CameraAxes::RUB, right);
            }).first == "rotation");
    }
}

TEST_CASE("A rotation's axes must have the world's handedness, and those that fit are named") {
  const auto wrong = complaint([] { poseFromRotation({0, 0, 0}, {0, 0, 0, 1}, CameraAxes::RUB, left); });
  CHECK(wrong.first == "rotation");
  CHECK(wrong.second.find("RUF or FRU") != std::string::npos);
  const auto other = complaint([] { poseFromRotation({0, 0, 0}, {0, 0, 0, 1}, CameraAxes::FRU, right); });
  CHECK(other.second.find("RUB or RDF") != std::string::npos);
}

TEST_CASE("The identity rotation looks where its axes say") {
  CHECK(nearest(parts(poseFromRotation({}, {0, 0, 0, 1}, CameraAxes::RUB, right)).rows.forward) == Vec3{0, 0, -1});
  CHECK(nearest(parts(poseFromRotation({}, {0, 0, 0, 1}, CameraAxes::RDF, right)).rows.forward) == Vec3{0, 0, 1});
  CHECK(nearest(parts(poseFromRotation({}, {0, 0, 0, 1}, CameraAxes::RDF, right)).rows.up) == Vec3{0, -1, 0});
  CHECK(nearest(parts(poseFromRotation({}, {0, 0, 0, 1}, CameraAxes::RUF, left)).rows.forward) == Vec3{0, 0, 1});
  CHECK(nearest(parts(poseFromRotation({}, {0, 0, 0, 1}, CameraAxes::FRU, left)).rows.forward) == Vec3{1, 0, 0});
}

TEST_CASE("A rotation need not be of unit length") {
  const Pose one = poseFromRotation({}, {1, 2, 3, 4}, CameraAxes::RUB, right);
  const Pose tiny = poseFromRotation({}, {1e-80, 2e-80, 3e-80, 4e-80}, CameraAxes::RUB, right);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(parts(tiny).rows.right[i].hi == Approx(parts(one).rows.right[i].hi).epsilon(1e-15));
}

TEST_CASE("A pose matrix that is not a rotation says how far it is from one") {
  Mat4 m{{{{2, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
  const auto scaled = complaint([&] { poseFromWorldFromCamera(m, CameraAxes::RUB, right); });
  CHECK(scaled.first == "worldFromCamera");
  CHECK(scaled.second.find(" 3,") != std::string::npos);
  m[0][0] = 1;
  m[3][0] = 5;
  m[3][3] = 1;
  const auto rowVectors = complaint([&] { poseFromCameraFromWorld(m, CameraAxes::RUB, right); });
  CHECK(rowVectors.second.find("transpose") != std::string::npos);
}

TEST_CASE("A matrix and its inverse give the same pose") {
  const Pose pose = lookAt({1, 2, 3}, {4, 6, -5}, {0, 1, 0}, right);
  Mat4 toWorld{};
  for (std::size_t i = 0; i < 3; ++i)
    toWorld[i] = {parts(pose).rows.right[i].hi, parts(pose).rows.up[i].hi, -parts(pose).rows.forward[i].hi,
                  pose.eye()[i]};
  toWorld[3] = {0, 0, 0, 1};
  const Pose again = poseFromWorldFromCamera(toWorld, CameraAxes::RUB, right);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(parts(again).rows.forward[i].hi == Approx(parts(pose).rows.forward[i].hi).epsilon(1e-15));
  CHECK(again.eye() == pose.eye());
}

TEST_CASE("Columns in double-double give the pose that a rotation gives, and the eye's low part is not lost") {
  const Vec3 eye{1e6, -2e5, 3e4};
  const DDVec3 off{{eye.x, 1e-11}, {eye.y, -2e-12}, {eye.z, 1e-13}};
  for (const CameraAxes axes : {CameraAxes::RUB, CameraAxes::RDF, CameraAxes::RUF, CameraAxes::FRU}) {
    const Handedness world = axes == CameraAxes::RUB || axes == CameraAxes::RDF ? right : left;
    const Pose turned = poseFromRotation(eye, {0.3, -0.1, 0.7, 0.5}, axes, world);
    const Axes& c = parts(turned).columns;
    const std::array<DDVec3, 3> columns = axes == CameraAxes::RUB   ? std::array{c.right, c.up, -c.forward}
                                          : axes == CameraAxes::RDF ? std::array{c.right, -c.up, c.forward}
                                          : axes == CameraAxes::RUF ? std::array{c.right, c.up, c.forward}
                                                                    : std::array{c.forward, c.right, c.up};
    const Pose pose = poseFromColumns(columns, off, axes, world);
    const auto same = [](const DDVec3& a, const DDVec3& b) { return maxAbs(a + -b) <= 0x1p-98; };
    CHECK(same(parts(pose).rows.right, parts(turned).rows.right));
    CHECK(same(parts(pose).rows.up, parts(turned).rows.up));
    CHECK(same(parts(pose).rows.forward, parts(turned).rows.forward));
    CHECK(pose.eye() == eye);
    const DDVec3 eyeBack = unroundedEye(parts(pose));
    for (std::size_t i = 0; i < 3; ++i) CHECK(eyeBack[i].lo == Approx(off[i].lo).epsilon(1e-9));
    // The exact rows are the rounded ones.
    const AxisDistances exact = exactDistances(parts(pose), {3, 4, 5, 1});
    const DDVec3 d = toDoubleDouble(Vec3{3, 4, 5}) + -toDoubleDouble(eye);
    const auto apart = [&](const Wide& a, const DDVec3& row, DoubleDouble residual) {
      return std::fabs((toDoubleDouble(a) - (dot(row, d) + residual)).hi);
    };
    CHECK(apart(exact.right, parts(pose).rows.right, parts(pose).residual.x) <= 1e6 * 0x1p-96);
    CHECK(apart(exact.up, parts(pose).rows.up, parts(pose).residual.y) <= 1e6 * 0x1p-96);
    CHECK(apart(exact.forward, parts(pose).rows.forward, parts(pose).residual.z) <= 1e6 * 0x1p-96);
  }
}

TEST_CASE("Columns that are no rotation, or mirror, are named") {
  const DDVec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  CHECK(complaint([&] { poseFromColumns({x, y, x}, {}, CameraAxes::RUB, right); }).first == "columns");
  CHECK(complaint([&] {
          poseFromColumns({x, y, z * DoubleDouble(2)}, {}, CameraAxes::RUB, right);
        }).first == "columns");
  CHECK(complaint([&] { poseFromColumns({x, y, -z}, {}, CameraAxes::RUB, right); }).first == "columns");
  CHECK(complaint([&] {
          poseFromColumns({x, y, z * DoubleDouble(NAN)}, {}, CameraAxes::RUB, right);
        }).first == "columns");
  CHECK(complaint([&] { poseFromColumns({x, y, z}, {INFINITY, 0, 0}, CameraAxes::RUB, right); }).first == "position");
}

TEST_CASE("Turns bring the axis after theirs towards the one after that, each about the axes that the last one left") {
  // About y a quarter turn brings z to x, so that x, which the second turn is about, points along -z.
  const auto pose = [](CameraAxes axes, Handedness world) {
    return poseFromTurns({1, 2, 3}, {{{1, 90}, {0, 90}, {2, 0}}}, axes, world);
  };
  const auto axesAre = [](const Pose& p, const Vec3& x, const Vec3& y, const Vec3& z) {
    return p.right() == x && p.up() == y && p.forward() == z;
  };
  CHECK(axesAre(pose(CameraAxes::RUB, right), {0, 0, -1}, {1, 0, 0}, {0, 1, 0}));
  CHECK(axesAre(pose(CameraAxes::RDF, right), {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}));
  CHECK(axesAre(pose(CameraAxes::RUF, left), {0, 0, -1}, {1, 0, 0}, {0, -1, 0}));
  CHECK(axesAre(pose(CameraAxes::FRU, left), {1, 0, 0}, {0, -1, 0}, {0, 0, -1}));
  CHECK(complaint([&] { pose(CameraAxes::RUF, right); }).first == "rotation");
  for (const Turn& bad : {Turn{3, 1}, Turn{-1, 1}, Turn{0, NAN}, Turn{0, INFINITY}})
    CHECK(complaint([&] { poseFromTurns({}, {{{0, 1}, bad, {2, 3}}}, CameraAxes::RUB, right); }).first == "euler");
}

TEST_CASE("A moved pose has its axes, and the eye's low part is left behind") {
  const Pose pose = poseFromColumns({SplitVec3{{0, 0, -1}, {}}, SplitVec3{{0, 1, 0}, {}}, SplitVec3{{1, 0, 0}, {}}},
                                    {{1, 2, 3}, {1e-17, 0, 0}}, CameraAxes::RUB, right);
  const Pose moved = movedTo(pose, {7, 8, 9});
  CHECK(moved.eye() == Vec3{7, 8, 9});
  CHECK(moved.right() == pose.right());
  CHECK(moved.forward() == pose.forward());
  CHECK(moved.world() == right);
  CHECK(parts(pose).residual.z.hi != 0);
  CHECK(parts(moved).residual.z.hi == 0);
  CHECK(complaint([&] { movedTo(pose, {NAN, 0, 0}); }).first == "position");
}
