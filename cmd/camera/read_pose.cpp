#include "camera/read_pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/check.hpp"
#include "numbers/degrees.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

using Columns = std::array<DDVec3, 3>;

/// The columns of the rotation x, y, z, w. The quaternion may have any length but 0.
Columns columnsOf(const std::array<DoubleDouble, 4>& q) {
  const auto& [x, y, z, w] = q;
  const DoubleDouble one = 1, two = DoubleDouble(2) / (x * x + y * y + z * z + w * w);
  //     | 1 - 2 (yy + zz)    2 (xy - zw)      2 (xz + yw)   |
  // R = |   2 (xy + zw)    1 - 2 (xx + zz)    2 (yz - xw)   |  for a quaternion of unit length
  //     |   2 (xz - yw)      2 (yz + xw)    1 - 2 (xx + yy) |
  return {DDVec3{one - two * (y * y + z * z), two * (x * y + z * w), two * (x * z - y * w)},
          DDVec3{two * (x * y - z * w), one - two * (x * x + z * z), two * (y * z + x * w)},
          DDVec3{two * (x * z + y * w), two * (y * z - x * w), one - two * (x * x + y * y)}};
}

/// The quaternion x, y, z, w of a rotation vector: its direction is the axis, its length the angle in radians.
std::array<DoubleDouble, 4> quaternionOf(const Node& value) {
  constexpr double kLargest = 1e6;  // a larger angle is not known to its last digits
  constexpr DoubleDouble kTurn{0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};
  const DDVec3 vector = toDoubleDouble(value.vec3());
  if (!(maxAbs(vector) <= kLargest)) value.fail("its length is the angle in radians, at most 1e6");
  if (!(maxAbs(vector) > 0)) return {0, 0, 0, 1};
  DoubleDouble angle = DoubleDouble(1) / inverseLength(vector);
  angle = angle - kTurn * DoubleDouble(std::round(angle.hi / kTurn.hi));
  // With t the tangent of a quarter of the angle, (2 t axis, 1 - t t) is a quaternion.
  const DoubleDouble quarter = timesPowerOfTwo(angle.hi < 0 ? -angle : angle, 0.5);
  const DoubleDouble t = quarter.hi > 0 ? tanHalfRadians(quarter) : DoubleDouble();
  const DDVec3 part = normalized(vector) * timesPowerOfTwo(angle.hi < 0 ? -t : t, 2);
  return {part.x, part.y, part.z, DoubleDouble(1) - t * t};
}

/// The quaternion scaled so that squares neither underflow nor overflow.
std::array<DoubleDouble, 4> scaledQuaternion(const Node& value) {
  const std::vector<double> q = value.numbers(4);
  double largest = 0;
  for (const double part : q) largest = std::max(largest, std::fabs(part));
  if (!(largest > 0)) value.fail("must not be all 0");
  std::array<DoubleDouble, 4> scaled;
  for (std::size_t i = 0; i < 4; ++i) scaled[i] = std::scalbn(q[i], -std::ilogb(largest));
  return scaled;
}

Mat4 affine(const std::vector<double>& rotation, const Vec3& translation) {
  Mat4 m;
  for (std::size_t i = 0; i < 3; ++i)
    m[i] = {rotation[3 * i], rotation[3 * i + 1], rotation[3 * i + 2], translation[i]};
  m[3] = {0, 0, 0, 1};
  return m;
}

/// The pose of worldFromCamera or cameraFromWorld, in any of their forms. eye: used instead of the matrix's own.
Pose matrixPose(const Node& value, bool isInverse, const std::optional<Vec3>& eye, CameraAxes axes, Handedness world) {
  const auto poseOf = [&](Mat4 m) {
    if (!isInverse && eye)
      for (std::size_t i = 0; i < 3; ++i) m[i][3] = (*eye)[i];
    if (!isInverse) return poseFromWorldFromCamera(m, axes, world);
    const Pose pose = poseFromCameraFromWorld(m, axes, world);
    return eye ? movedTo(pose, *eye) : pose;
  };
  if (const auto matrix = rigidMatrix(value)) return poseOf(*matrix);
  const Vec3 translation = value.require("translation").vec3();
  const auto rotation = value.find("rotation");
  Columns columns = columnsOf(rotation ? scaledQuaternion(*rotation) : quaternionOf(value.require("rotationVector")));
  DDVec3 origin = toDoubleDouble(translation);
  if (isInverse) {  // p_camera = R p_world + t: the rows of R are the camera's axes, and the eye is -R^T t
    const Columns c = columns;
    columns = {DDVec3{c[0].x, c[1].x, c[2].x}, DDVec3{c[0].y, c[1].y, c[2].y}, DDVec3{c[0].z, c[1].z, c[2].z}};
    origin = -(columns[0] * origin.x + columns[1] * origin.y + columns[2] * origin.z);
  }
  return poseFromColumns({split(columns[0]), split(columns[1]), split(columns[2])},
                         eye ? SplitVec3{*eye, {}} : split(origin), axes, world);
}

Pose eulerPose(const Node& value, const Vec3& position, CameraAxes axes, Handedness world) {
  const auto order = viewproj::cmd::valueOf(kEulerOrders, value.require("order").text());
  const Node degrees = value.require("degrees");
  std::array<Turn, 3> turns;
  for (std::size_t i = 0; i < 3; ++i) turns[i] = {static_cast<int>(order[i]), angleOf(degrees[i])};
  return poseFromTurns(position, turns, axes, world);
}

}  // namespace

std::optional<Mat4> rigidMatrix(const Node& value) {
  if (!value.json().is_object()) return value.mat4();
  const auto rotation = value.find("rotation");
  if (!rotation || !rotation->holdsNumbers(9)) return std::nullopt;
  return affine(rotation->numbers(9), value.require("translation").vec3());
}

std::array<DDVec3, 3> rotationColumns(const Node& quaternion) { return columnsOf(scaledQuaternion(quaternion)); }

bool isPlaceValue(const Node& value) { return value.json().is_object() && !value.json().contains("x"); }

Geodetic placeOf(const Node& value) {
  return {degreesOf(value.require("lat")), degreesOf(value.require("lon")), value.require("height").number()};
}

Vec3 positionOf(const Node& value) { return isPlaceValue(value) ? geodeticToEcef(placeOf(value)) : value.vec3(); }

bool worldIsEcef(const Document& document) {
  const Node root(document);
  const auto isPlace = [&](std::string_view key) {
    const auto value = root.find(key);
    return value && isPlaceValue(*value);
  };
  return root.find("world") || isPlace("position") || isPlace("target");
}

namespace {

std::optional<Pose> readExactPose(const Document& document) {
  const Node root(document);
  const auto [preset, convention, isStated] = readConvention(document);
  const Handedness world = convention.world;
  const auto axesName = root.find("cameraAxes");
  const CameraAxes axes = axesName ? viewproj::cmd::valueOf(kCameraAxesNames, axesName->text()) : preset->cameraAxes;
  const auto position = root.find("position");
  std::optional<Vec3> eye;
  if (position) eye = positionOf(*position);
  for (const char* key : {"worldFromCamera", "cameraFromWorld"})
    if (const auto matrix = root.find(key)) return matrixPose(*matrix, *key == 'c', eye, axes, world);
  const auto target = root.find("target"), direction = root.find("direction"), rotation = root.find("rotation");
  const auto euler = root.find("euler"), up = root.find("up");
  const bool isTurned = root.find("heading") || root.find("pitch") || root.find("roll");
  if (!target && !direction && !rotation && !euler && !isTurned) {
    if (position || up)
      (position ? *position : *up).fail("needs a target, direction, rotation, euler or heading beside it");
    return std::nullopt;
  }
  if (!eye) root.fail("needs position");
  if (rotation) {
    const std::vector<double> q = rotation->numbers(4);
    return poseFromRotation(*eye, {q[0], q[1], q[2], q[3]}, axes, world);
  }
  if (euler) return eulerPose(*euler, *eye, axes, world);
  const auto angle = [&](std::string_view key) {
    const auto value = root.find(key);
    return value ? angleOf(*value) : Angle(0);
  };
  if (isTurned) {
    if (!isPlaceValue(*position)) position->fail("needs lat, lon and height for a heading, pitch or roll");
    return poseFromHeadingPitchRoll(placeOf(*position), {angle("heading"), angle("pitch"), angle("roll")});
  }
  if (target && !up && isPlaceValue(*position) && isPlaceValue(*target))
    return lookAtPlace(placeOf(*position), placeOf(*target));
  const auto look = [&](const Vec3& upward) {
    return target ? lookAt(*eye, positionOf(*target), upward, world)
                  : lookAlong(*eye, direction->vec3(), upward, world);
  };
  if (up) return look(up->vec3());
  if (worldIsEcef(document)) {
    const Geodetic place = isPlaceValue(*position) ? placeOf(*position) : ecefToGeodetic(*eye);
    return target ? lookAtOnEarth(*eye, positionOf(*target), place, world)
                  : lookAlongOnEarth(*eye, direction->vec3(), place, world);
  }
  return look(preset->up);
}

/// How far a place's ECEF position may be from it; 0 for a position.
double errorOf(const Node& value) { return isPlaceValue(value) ? placeError(positionOf(value)) : 0; }

}  // namespace

std::optional<Pose> readPose(const Document& document) {
  const std::optional<Pose> pose = readExactPose(document);
  const Node root(document);
  const auto position = root.find("position"), target = root.find("target"), up = root.find("up");
  if (!pose || !position) return pose;
  const Geodetic place = isPlaceValue(*position) ? placeOf(*position) : ecefToGeodetic(pose->eye());
  const Vec3 upward = up ? rounded(normalized(toDoubleDouble(up->vec3()))) : ellipsoidNormal(place);
  PoseError error{errorOf(*position), 0};
  if (target) error = lookAtError(*pose, positionOf(*target), upward, error.eye, errorOf(*target));
  // A latitude in radians is rounded to degrees, and turns the axes: up alone where the camera looks along a direction.
  constexpr double kRounding = 5e-16;
  const auto isRounded = [&](const char* key) { return angleOf(position->require(key)).isRadians; };
  if (isPlaceValue(*position) && (isRounded("lat") || isRounded("lon")))
    error.angle += kRounding / (target || root.find("direction") ? dot(pose->up(), upward) : 1);
  return withError(*pose, error);
}

}  // namespace viewproj::cmd
