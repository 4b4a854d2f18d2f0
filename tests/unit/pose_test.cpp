#include "catch.hpp"
#include "internals.hpp"
#include "projection/exact_point.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/screen.hpp"

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

constexpr auto right = Handedness::right;
constexpr auto left = Handedness::left;

}  // namespace

TEST_CASE("A pose matrix that is not a rotation says how far it is from one") {
  Mat4 m{{{{2, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
  const auto scaled = complaint([&] { poseFromWorldFromCamera(m, CameraAxes::RUB); });
  CHECK(scaled.first == "worldFromCamera");
  CHECK(scaled.second.find(" 3,") != std::string::npos);
  m[0][0] = 1;
  m[3][0] = 5;
  m[3][3] = 1;
  const auto rowVectors = complaint([&] { poseFromCameraFromWorld(m, CameraAxes::RUB); });
  CHECK(rowVectors.second.find("transpose") != std::string::npos);
  for (std::size_t i = 0; i < 3; ++i) {
    Mat4 other = m;
    other[i][3] = 1;
    CHECK(complaint([&] { poseFromCameraFromWorld(other, CameraAxes::RUB); }).second.ends_with("not 0 0 0 1"));
  }
}

TEST_CASE("Columns that are no rotation are named") {
  const DDVec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  CHECK(complaint([&] { poseFromColumns({x, y, x}, {}, CameraAxes::RUB); }).first == "columns");
  CHECK(complaint([&] { poseFromColumns({x, y, z * DoubleDouble(2)}, {}, CameraAxes::RUB); }).first == "columns");
  CHECK(complaint([&] { poseFromColumns({x, y, z * DoubleDouble(NAN)}, {}, CameraAxes::RUB); }).first == "columns");
  CHECK(complaint([&] { poseFromColumns({x, y, z}, {INFINITY, 0, 0}, CameraAxes::RUB); }).first == "position");
}

TEST_CASE("Turns bring the axis after theirs towards the one after that, each about the axes that the last one left") {
  // About y a quarter turn brings z to x, so that x, which the second turn is about, points along -z.
  const auto pose = [](CameraAxes axes) { return poseFromTurns({1, 2, 3}, {{{1, 90}, {0, 90}, {2, 0}}}, axes); };
  const auto axesAre = [](const Pose& p, const Vec3& x, const Vec3& y, const Vec3& z) {
    return p.right() == x && p.up() == y && p.forward() == z;
  };
  CHECK(axesAre(pose(CameraAxes::RUB), {0, 0, -1}, {1, 0, 0}, {0, 1, 0}));
  CHECK(axesAre(pose(CameraAxes::RDF), {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}));
  CHECK(axesAre(pose(CameraAxes::RUF), {0, 0, -1}, {1, 0, 0}, {0, -1, 0}));
  CHECK(axesAre(pose(CameraAxes::FRU), {1, 0, 0}, {0, -1, 0}, {0, 0, -1}));
  CHECK(axesAre(pose(CameraAxes::FLU), {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}));
  CHECK(axesAre(pose(CameraAxes::FRD), {1, 0, 0}, {0, 1, 0}, {0, 0, -1}));
  for (const Turn& bad : {Turn{3, 1}, Turn{-1, 1}, Turn{0, NAN}, Turn{0, INFINITY}})
    CHECK(complaint([&] { poseFromTurns({}, {{{0, 1}, bad, {2, 3}}}, CameraAxes::RUB); }).first == "euler");
}

TEST_CASE("The axes that are given say which handedness the world has, and a mirroring changes it") {
  constexpr std::pair<CameraAxes, Handedness> kHands[] = {{CameraAxes::RUB, right}, {CameraAxes::RUF, left},
                                                          {CameraAxes::RDF, right}, {CameraAxes::FRU, left},
                                                          {CameraAxes::FLU, right}, {CameraAxes::FRD, right}};
  const Mat4 mirror{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1}}}};
  const DDVec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  for (const auto& [axes, world] : kHands) {
    const Handedness mirrored = world == right ? left : right;
    CHECK(poseFromRotation({}, {1, 2, 3, 4}, axes).world() == world);
    CHECK(poseFromTurns({}, {{{1, 10}, {0, 20}, {2, 30}}}, axes).world() == world);
    CHECK(poseFromColumns({x, y, z}, {}, axes).world() == world);
    CHECK(poseFromColumns({x, y, -z}, {}, axes).world() == mirrored);
    CHECK(poseFromWorldFromCamera(mirror, axes).world() == mirrored);
    CHECK(poseFromCameraFromWorld(mirror, axes).world() == mirrored);
  }
}

TEST_CASE("Next to the eye plane a pose of columns is exact") {
  const Pose pose =
      poseFromColumns({SplitVec3{{0.6, 0, -0.8}, {}}, SplitVec3{{0, 1, 0}, {}}, SplitVec3{{0.8, 0, 0.6}, {}}},
                      {{1, 2, 3}, {}}, CameraAxes::RUB);
  const Camera camera = makeCamera(pose, perspective(60, 1, 0.1), {100, 100});
  for (const double k : {-1e6, -3.0, 1.0, 7.0, 1e9}) {
    const ScreenPoint p = worldToScreen(camera, Vec3{1 + 0.6 * k, 2 + k, 3 - 0.8 * k});
    CHECK(std::fabs(p.viewDistance) < 0x1p-51 * (3 + std::fabs(k)));
  }
}

TEST_CASE("A moved pose has its axes, and the eye's low part is left behind") {
  const Pose pose = poseFromColumns({SplitVec3{{0, 0, -1}, {}}, SplitVec3{{0, 1, 0}, {}}, SplitVec3{{1, 0, 0}, {}}},
                                    {{1, 2, 3}, {1e-17, 0, 0}}, CameraAxes::RUB);
  const Pose moved = movedTo(pose, {7, 8, 9});
  CHECK(moved.eye() == Vec3{7, 8, 9});
  CHECK(moved.right() == pose.right());
  CHECK(moved.forward() == pose.forward());
  CHECK(moved.world() == right);
  CHECK(parts(pose).residual.z.hi != 0);
  CHECK(parts(moved).residual.z.hi == 0);
  CHECK(complaint([&] { movedTo(pose, {NAN, 0, 0}); }).first == "position");
}
