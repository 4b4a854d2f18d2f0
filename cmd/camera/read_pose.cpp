#include "camera/read_pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "camera/read_projection.hpp"
#include "camera/read_screen.hpp"
#include "camera/rigid.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// Of the world that a rotation of these camera axes fits.
Handedness worldOfAxes(CameraAxes axes) { return poseFromRotation({}, {}, axes).world(); }

/// The pose of worldFromCamera or cameraFromWorld, in any of their forms. eye: used instead of the matrix's own.
Pose rigidPose(const RigidTransform& value, bool isInverse, const std::optional<Vec3>& eye, CameraAxes axes) {
  if (const Mat4* const matrix = std::get_if<Mat4>(&value.rotation)) {
    Mat4 m = *matrix;
    if (!isInverse && eye)
      for (std::size_t i = 0; i < 3; ++i) m[i][3] = (*eye)[i];
    if (!isInverse) return poseFromWorldFromCamera(m, axes);
    const Pose pose = poseFromCameraFromWorld(m, axes);
    return eye ? movedTo(pose, *eye) : pose;
  }
  const Rigid rigid = isInverse ? inverse(rigidOf(value)) : rigidOf(value);
  return poseFromColumns({split(rigid.columns[0]), split(rigid.columns[1]), split(rigid.columns[2])},
                         eye ? SplitVec3{*eye, {}} : split(rigid.origin), axes);
}

/// The option for a convention of these camera axes.
std::string readAsOf(const std::optional<CameraAxes>& axes) {
  const auto presets = conventionPresets();
  const auto of = std::find_if(presets.begin(), presets.end(),
                               [&](const ConventionPreset& preset) { return preset.cameraAxes == axes; });
  return of == presets.end() ? "" : "; --read-as " + std::string(of->name) + " fits";
}

/// Reads a pose that has an orientation.
struct PoseReader {
  const FieldValues& values;
  const DocumentConvention& convention;
  World worldKind;
  Handedness hand;

  /// The pose, if the axes that it was made from are of the convention's handedness.
  Pose inThisWorld(FieldId field, CameraAxes axes, const Pose& pose) const {
    if (pose.world() == hand) return pose;
    const auto handed = [](Handedness h) { return std::string(nameOf(kWorldNames, h)) + "-handed"; };
    values.fail(field, "makes the world " + handed(pose.world()) + " with cameraAxes " +
                           std::string(nameOf(kCameraAxesNames, axes)) + ", and the convention's is " + handed(hand) +
                           "; cameraAxes " + (worldOfAxes(axes) == Handedness::left ? "RUB or RDF" : "RUF or FRU") +
                           " would fit, or --set convention.world=" + std::string(nameOf(kWorldNames, pose.world())));
  }

  Pose turned(const Position& position) const {
    const auto angle = [&](FieldId field) { return values.valueOr(field, Angle(0)); };
    const HeadingPitchRoll angles{angle("heading"), angle("pitch"), angle("roll")};
    if (position.place) return poseFromHeadingPitchRoll(*position.place, angles);
    if (worldKind == World::ecef)
      return movedTo(poseFromHeadingPitchRoll(ecefToGeodetic(position.point), angles), position.point);
    if (worldKind != World::enu)
      values.fail("position",
                  R"(needs lat, lon and height, or "world": "enu" (--set world=enu), for a heading, pitch or roll)");
    return poseInEastNorthUp(position.point, angles);
  }

  Pose looking(const Position& position) const {
    const Vec3& eye = position.point;
    const auto* const target = values.find<Position>("target");
    const auto* const up = values.find<Vec3>("up");
    const auto look = [&](const Vec3& upward) {
      return target ? lookAt(eye, target->point, upward, hand)
                    : lookAlong(eye, values.require<Vec3>("direction"), upward, hand);
    };
    if (up) return look(*up);
    if (worldKind == World::enu) return look({0, 0, 1});
    if (worldKind != World::ecef) return look(convention.preset->up);
    if (target && position.place && target->place) return lookAtPlace(*position.place, *target->place);
    const Geodetic place = position.place ? *position.place : ecefToGeodetic(eye);
    return target ? lookAtOnEarth(eye, target->point, place, hand)
                  : lookAlongOnEarth(eye, values.require<Vec3>("direction"), place, hand);
  }
};

}  // namespace

Vec3 eyeOf(const RigidTransform& transform, bool isInverse) {
  return rigidPose(transform, isInverse, {}, CameraAxes::RUB).eye();  // which axes is all the same
}

World worldOf(const FieldValues& values) {
  if (const auto* const name = values.find<std::string_view>("world")) return valueOf(kWorlds, *name);
  for (const FieldId field : {FieldId("position"), FieldId("target")})
    if (const auto* const position = values.find<Position>(field); position && position->place) return World::ecef;
  return World::any;
}

CameraAxes axesOfOrder(const EulerOrder& order, Handedness world, CameraAxes otherwise) {
  if (world == Handedness::left && order.leftHandedAxes) return *order.leftHandedAxes;
  return order.cameraAxes.value_or(otherwise);
}

CameraAxes cameraAxesOf(const FieldValues& values, const ConventionPreset& preset) {
  const auto* const euler = values.find<EulerTurns>("euler");
  if (euler && euler->order->second.cameraAxes) return *euler->order->second.cameraAxes;
  const auto* const name = values.find<std::string_view>("cameraAxes");
  return name ? valueOf(kCameraAxesNames, *name) : preset.cameraAxes;
}

std::string faultOfOrder(const NameRow<EulerOrder>& order, const FieldValues& values, Handedness world) {
  const auto& [name, of] = order;
  const bool isLetters = 'A' <= name.front() && name.front() <= 'Z';
  if (!isLetters && worldOf(values) == World::ecef)
    return std::string(name) +
           " turns from the axes of a local world, as east, north and up, and this world is Earth-centred; give "
           "heading, pitch and roll, or x, y, z of a map grid with \"world\": \"enu\"";
  if (!of.cameraAxes) return "";
  const Handedness own = worldOfAxes(*of.cameraAxes);
  if (own == world) return "";
  return std::string(name) + " is of a " + std::string(nameOf(kWorldNames, own)) +
         "-handed world, and the convention's is " + std::string(nameOf(kWorldNames, world)) + "-handed";
}

namespace {

/// The pose, if positions are exact.
std::optional<Pose> readStatedPose(const FieldValues& values, const DocumentConvention& convention) {
  const PoseReader reader{values, convention, worldOf(values), convention.convention.world};
  const CameraAxes axes = cameraAxesOf(values, *convention.preset);
  if (typeOf(values) == kScreen) {
    for (const Field& field : kFields)
      if (field.group == Group::pose && field.path != "position" && valueAt(*values.document().root, field.path))
        values.failAt(field.path, "the screen orients the camera; leave one of the two out");
    return readScreen(values, reader.hand).pose;
  }
  const auto* const position = values.find<Position>("position");
  for (const FieldId field : {FieldId("worldFromCamera"), FieldId("cameraFromWorld")})
    if (const auto* const value = values.find<RigidTransform>(field))
      return reader.inThisWorld(field, axes,
                                rigidPose(*value, field->path == "cameraFromWorld",
                                          position ? std::optional(position->point) : std::nullopt, axes));
  const bool isTurned = values.has("heading") || values.has("pitch") || values.has("roll");
  const auto* const rotation = values.find<Quaternion>("rotation");
  const auto* const euler = values.find<EulerTurns>("euler");
  if (!values.has("target") && !values.has("direction") && !rotation && !euler && !isTurned) {
    if (position || values.has("up"))
      values.failAt(position ? "position" : "up", "needs a target, direction, rotation, euler or heading beside it");
    return std::nullopt;
  }
  if (!position) values.failAt("", "needs position");
  if (rotation) return reader.inThisWorld("rotation", axes, poseFromRotation(position->point, *rotation, axes));
  if (euler) {
    const auto& [name, order] = *euler->order;
    const auto* const stated = values.find<std::string_view>("cameraAxes");
    if (stated && order.cameraAxes && *stated != nameOf(kCameraAxesNames, *order.cameraAxes))
      values.fail("euler", std::string(name) + " turns the axes " +
                               std::string(nameOf(kCameraAxesNames, *order.cameraAxes)) + ", and cameraAxes is " +
                               std::string(*stated));
    if (const std::string fault = faultOfOrder(*euler->order, values, reader.hand); !fault.empty())
      values.fail("euler", fault + (worldOf(values) == World::ecef ? "" : readAsOf(order.cameraAxes)));
    return reader.inThisWorld("euler", axes, poseFromTurns(position->point, euler->turns, axes));
  }
  return isTurned ? reader.turned(*position) : reader.looking(*position);
}

}  // namespace

std::optional<Pose> readPose(const FieldValues& values, const DocumentConvention& convention) {
  const std::optional<Pose> pose = readStatedPose(values, convention);
  const auto* const position = values.find<Position>("position");
  if (!pose || !position) return pose;
  const auto* const target = values.find<Position>("target");
  // The north of a position in metres is as exact as its place.
  const bool isOfNorth = values.has("heading") || values.has("pitch") || values.has("roll");
  const double axis = std::hypot(pose->eye().x, pose->eye().y);
  const bool isNorthFound = isOfNorth && worldOf(values) == World::ecef && !position->place && axis > 0;
  const double north = isNorthFound ? placeError(pose->eye()) / axis : 0;
  if (position->error == 0 && !position->isRounded && (!target || target->error == 0))
    return withError(*pose, {0, north});
  const auto* const up = values.find<Vec3>("up");
  const Geodetic place = position->place ? *position->place : ecefToGeodetic(pose->eye());
  const Vec3 upward = up ? rounded(normalized(toDoubleDouble(*up))) : ellipsoidNormal(place);
  PoseError error{position->error, 0};
  if (target) error = lookAtError(*pose, target->point, upward, position->error, target->error);
  // A latitude in radians is rounded to degrees, and turns the axes: up alone where the camera looks along a direction.
  constexpr double kOfLatitude = 5e-16;
  if (position->isRounded)
    error.angle += kOfLatitude / (target || values.has("direction") ? dot(pose->up(), upward) : 1);
  return withError(*pose, error);
}

double rotationError(const Pose& pose) {
  const Vec3 axes[] = {pose.right(), pose.up(), pose.forward()};
  double off = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      off = std::max(off, std::fabs(detail::dot(axes[i], axes[j]) - (i == j ? 1 : 0)));
  return off;
}

}  // namespace viewproj::cmd
