// Mistakes of the pose, and of the points' axes and units.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/names.hpp"
#include "camera/read_pose.hpp"
#include "commands/check/hypothesis.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr double kNoTurn = 1e-9;  // radians

/// What was written as one field is read as another.
void readAsOther(Trials& t) {
  const auto array = [&](std::string_view path) {
    const Json* const value = t.find(path);
    return value && value->is_array() ? value : nullptr;
  };
  for (const auto& [path, other] :
       {std::pair("worldFromCamera", "cameraFromWorld"), {"cameraFromWorld", "worldFromCamera"}})
    if (const Json* const pose = t.find(path)) t.change("pose-inverted", {{path, nullptr}, {other, *pose}}, other);
  const Json *const rotation = array("rotation"), *const position = array("position"), *const target = array("target");
  if (rotation && position)
    t.change("pose-inverted",
             {{"position", nullptr},
              {"rotation", nullptr},
              {"cameraFromWorld", {{"rotation", *rotation}, {"translation", *position}}}},
             "cameraFromWorld");
  for (const auto& [path, other] : {std::pair("target", "direction"), {"direction", "target"}})
    if (const Json* const value = array(path)) t.change("direction-as-target", {{other, *value}}, other);
  if (target && position) t.change("eye-target-exchanged", {{"position", *target}, {"target", *position}});
  for (const char* const path : {"rotation", "worldFromCamera.rotation", "cameraFromWorld.rotation"})
    if (const Json* const given = array(path); given && given->size() == 4 && (*given)[0].is_number()) {
      const Json& q = *given;
      for (const Json& order : {Json{q[1], q[2], q[3], q[0]}, Json{q[3], q[0], q[1], q[2]}})
        t.change("quaternion-order", {{path, order}});
    }
  if (t.has("target") || t.has("direction"))
    for (const Json& up : {Json{0, 1, 0}, Json{0, 0, 1}})
      if (const Json* const own = t.find("up"); !own || *own != up)
        t.change("up-axis", {{"up", up}}, up[1] == 1 ? "up y" : "up z");
  for (const char* const path : {"worldFromCamera.rotationVector", "cameraFromWorld.rotationVector"})
    if (const Json* const vector = array(path)) {
      std::array<double, 3> radians{};
      for (std::size_t i = 0; i < 3; ++i) radians[i] = (*vector)[i].get<double>() * std::numbers::pi / 180;
      t.change("radians", {{path, radians}}, "degrees");
    }
  const bool isRight = t.file().convention.world == Handedness::right;
  t.change("x-mirrored", {{"convention.world", isRight ? "left" : "right"}});
  const Json* const axes = t.find("cameraAxes");
  for (const auto& [name, each] : kCameraAxesNames)
    if (!axes || *axes != name) t.change("camera-axes", {{"cameraAxes", name}}, name);
}

void turnEuler(Trials& t) {
  const Json* const euler = t.find("euler");
  if (!euler) return;
  const EulerOrder own = valueOf(kEulerOrders, (*euler)["order"].get<std::string>());
  std::array<Json, 3> inRadians;
  std::array<double, 3> angles{}, aboutAxes{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& angle = (*euler)["degrees"][i];
    if (!angle.is_number()) return;
    inRadians[i] = angle.dump() + "rad";
    angles[i] = angle;
  }
  t.change("radians", {{"euler.degrees", inRadians}}, "radians");
  for (std::size_t i = 0; i < 3; ++i) aboutAxes[own.axis[i]] = own.sign[i] * angles[own.listed[i]];
  for (const auto& [name, other] : kEulerOrders) {
    std::array<double, 3> sameTurns{};
    for (std::size_t i = 0; i < 3; ++i) sameTurns[other.listed[i]] = other.sign[i] * aboutAxes[other.axis[i]];
    if (other.axis[0] == other.axis[2] || name == (*euler)["order"]) continue;
    for (const auto& degrees : {angles, sameTurns})
      t.change("euler-order", {{"euler", {{"order", name}, {"degrees", degrees}}}}, name);
  }
  for (std::array<std::size_t, 3> from{0, 1, 2}; std::next_permutation(from.begin(), from.end());) {
    const std::array<double, 3> degrees{angles[from[0]], angles[from[1]], angles[from[2]]};
    t.change("euler-order", {{"euler.degrees", degrees}}, degrees);
  }
  for (unsigned signs = 1; signs < 8; ++signs) {
    std::array<double, 3> signedAngles{}, value{};
    for (std::size_t i = 0; i < 3; ++i) {
      value[i] = signs >> (2 - i) & 1 ? -1 : 1;
      signedAngles[i] = value[i] * angles[i];
    }
    t.change("euler-sign", {{"euler.degrees", signedAngles}}, value);
  }
}

void turnOnEarth(Trials& t) {
  std::vector<Set> inRadians;
  for (const char* const name : {"heading", "pitch", "roll"})
    if (const Json* const angle = t.find(name); angle && angle->is_number())
      inRadians.emplace_back(name, angle->dump() + "rad");
  if (inRadians.empty()) return;
  t.change("radians", inRadians, "radians");
  const double h = t.degreesOr("heading", 0), p = t.degreesOr("pitch", 0), r = t.degreesOr("roll", 0);
  for (const double v : {-h, 90 - h, h + 90, h - 90, h + 180, 180 - h})
    t.change("heading-convention", {{"heading", v}}, v);
  for (const double v : {-p, p - 90, p + 90, 90 - p, -90 - p}) t.change("pitch-convention", {{"pitch", v}}, v);
  for (const double v : {-r, r + 180, r + 90, r - 90}) t.change("roll-convention", {{"roll", v}}, v);
  if (r == 0) return;
  t.change("heading-convention", {{"heading", -h}, {"roll", -r}});
  t.change("pitch-convention", {{"pitch", -p}, {"roll", -r}});
}

void movePlace(Trials& t) {
  if (!t.has("position.lat")) return;
  const double lat = t.degreesOr("position.lat", 0), lon = t.degreesOr("position.lon", 0);
  for (const auto& [a, b] : {std::pair(lon, lat), {lat, -lon}, {-lat, lon}})
    t.change("place", {{"position.lat", a}, {"position.lon", b}}, {a, b});
  for (const PlaceMap map : {PlaceMap::exchange, PlaceMap::negateLon, PlaceMap::negateLat})
    t.add({.mistake = "place", .camera = t.plain(), .places = map});
}

/// The rotation R of the document's own axes and three numbers, read as something else. With the eye C, t = -R C is
/// what a view matrix holds.
void readPoseAsOther(Trials& t) {
  const Vec3 eye = t.plain().eye, none{};
  const Rows& axes = t.plain().axes;
  const CameraAxes ownAxes = cameraAxesOf(readValues(t.file().document), *t.file().preset);
  const Rows rotation = worldFromCamera(poseOf(t.plain()), ownAxes).columns, back = transposed(rotation);
  const Rows own = axes * back;  // a signed permutation
  const Vec3 view = scaled(rotation * eye, -1), away = scaled(eye, -1);
  const bool isProper = determinant(rotation) > 0;
  const bool isView = t.has("cameraFromWorld");
  if (length(eye) > 0) {
    t.pose("translation-as-position", axes, view, isView ? Json("position") : Json());
    t.pose("translation-as-position", axes, back * away, isView ? Json() : Json("translation"));
    for (const Vec3& to : {scaled(view, -1), back * eye}) t.pose("translation-as-position", axes, to);
    t.pose("position-sign", axes, away);
    t.pose("translation-left-out", axes, none);
    if (isProper) t.pose("pose-inverted", own * back, view);
    if (isProper && angleOf(rotation * rotation) > kNoTurn) {  // else it is its own inverse
      for (const Vec3& to : {eye, scaled(rotation * view, -1)}) t.pose("pose-inverted", own * back, to, "rotation");
      for (const Vec3& to : {away, scaled(view, -1), none}) t.pose("pose-inverted", own * back, to);
    }
    t.pose("pose-twice", axes * rotation, sum(eye, 1, back * eye));
    t.pose("pose-twice", axes, scaled(eye, 2));
  }
  const double angle = isProper ? angleOf(rotation) : 0;
  if (!(angle > kNoTurn)) return;
  for (const Vec3& to : {eye, none}) t.pose("pose-left-out", own, to);
  if (!(std::sin(angle) > kNoTurn)) return;
  const Vec3 vector = scaled(skewOf(rotation), angle / (2 * std::sin(angle)));
  for (const double unit : {1.0, std::numbers::pi / 180}) {
    const Vec3 v = scaled(vector, unit);
    const Rows x = turn({v.x, 0, 0}), y = turn({0, v.y, 0}), z = turn({0, 0, v.z});
    for (const Rows& turned : {z * y * x, x * y * z}) {  // each is of the inverse in the other order, too
      t.pose("rotation-vector", own * turned, transposed(turned) * scaled(view, -1));
      t.pose("rotation-vector", own * turned, eye);
    }
  }
}

void changeUnits(Trials& t) {
  const Vec3 eye = t.plain().eye;
  for (const double one : {1000.0, 100.0, 10.0, 1 / 0.3048, 2.54, 25.4, 1 / 0.0254})
    for (const double unit : {one, 1 / one}) {
      if (length(eye) > 0) t.pose("unit", t.plain().axes, scaled(eye, unit), {"position", unit});
      t.points("unit", diagonal(unit), {"points", unit});
    }
}

void turnAxes(Trials& t) {
  const PlainCamera& own = t.plain();
  for (const auto& [name, rows] : signedAxes()) {
    if (rows == kUnit) continue;
    const bool isUp = name == "x,z,-y" || name == "x,-z,y" || name == "x,z,y";
    const bool isMirror = name == "-x,y,z" || name == "x,-y,z" || name == "x,y,-z";
    const Vec3 up = t.up(), upOfPoints = transposed(rows) * up;
    const Json value = !isUp                            ? (isMirror ? Json() : Json(name))
                       : name == "x,z,y"                ? Json("exchanged")
                       : up.y == 1 && upOfPoints.z == 1 ? Json("z for y")
                       : up.z == 1 && upOfPoints.y == 1 ? Json("y for z")
                                                        : Json();
    t.points(isUp ? "up-axis" : isMirror ? "x-mirrored" : "point-axes", rows, value);
    if (determinant(rows) > 0) t.pose("camera-axes", rows * own.axes, own.eye, name);
  }
  if (t.has("target") || t.has("direction"))
    t.pose("up-axis", {scaled(own.axes[0], -1), scaled(own.axes[1], -1), own.axes[2]}, own.eye, "down");
}

}  // namespace

void addPoseRows(Trials& t) {
  readAsOther(t);
  turnEuler(t);
  turnOnEarth(t);
  movePlace(t);
  if (t.file().worldIsEcef) return;
  readPoseAsOther(t);
  changeUnits(t);
  turnAxes(t);
}

}  // namespace viewproj::cmd::mistakes
