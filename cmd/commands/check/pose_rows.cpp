// Mistakes of the pose and of the points' axes and units.
#include <algorithm>
#include <cmath>

#include "camera/names.hpp"
#include "commands/check/hypothesis.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr const char* kRigid[] = {"worldFromCamera", "cameraFromWorld"};

Json transposed(const Json& rotation) {
  Json turned = rotation;
  for (std::size_t i = 0; i < 9; ++i) turned[i / 3][i % 3] = rotation[i % 3][i / 3];
  return turned;
}

/// A quaternion or a rotation vector, a matrix by rows, or one with its translation, of the inverse rotation.
Json inverseOf(const Json& rotation) {
  if (rotation[0].is_array()) return transposed(rotation);
  Json inverse = rotation;
  for (std::size_t i = 0; i < 3; ++i) inverse[i] = 0.0 - rotation[i].get<double>();
  return inverse;
}

void invertPose(Trials& t) {
  for (const char* const path : kRigid) {
    const Json* const pose = t.find(path);
    if (!pose) continue;
    t.change("pose-inverted", {{path, nullptr}, {path == kRigid[0] ? kRigid[1] : kRigid[0], *pose}});
    if (pose->is_array()) t.change("pose-inverted", {{path, transposed(*pose)}});
    for (const char* const name : {".rotation", ".rotationVector"})
      if (const Json* const turn = t.find(std::string(path) + name); turn && (turn->size() == 3 || turn->size() == 4))
        t.change("pose-inverted", {{std::string(path) + name, inverseOf(*turn)}});
  }
  const Json *const rotation = t.find("rotation"), *const position = t.find("position");
  if (!rotation || !position || !position->is_array()) return;
  t.change("pose-inverted", {{"rotation", inverseOf(*rotation)}});
  t.change("pose-inverted", {{"position", nullptr},
                             {"rotation", nullptr},
                             {"cameraFromWorld", {{"rotation", *rotation}, {"translation", *position}}}});
}

void changeForm(Trials& t) {
  for (const auto& [path, other] : {std::pair("target", "direction"), {"direction", "target"}})
    if (const Json* const value = t.find(path); value && value->is_array())
      t.change("direction-as-target", {{other, *value}});
  if (t.has("target") || t.has("direction"))
    for (const Json& up : {Json{0, 1, 0}, Json{0, 0, 1}})
      if (const Json* const own = t.find("up"); !own || *own != up) t.change("up-axis", {{"up", up}});
  const Json *const target = t.find("target"), *const position = t.find("position");
  if (target && position && target->is_array() && position->is_array())
    t.change("eye-target-exchanged", {{"position", *target}, {"target", *position}});
  for (const char* const path : {"rotation", "worldFromCamera.rotation", "cameraFromWorld.rotation"})
    if (const Json* const q = t.find(path); q && q->size() == 4 && (*q)[0].is_number())
      for (const auto& order : {std::array{1, 2, 3, 0}, {3, 0, 1, 2}}) {
        Json turned = Json::array();
        for (const int i : order) turned.push_back((*q)[static_cast<std::size_t>(i)]);
        t.change("quaternion-order", {{path, turned}});
      }
  const Json* const axes = t.find("cameraAxes");
  for (const auto& [name, each] : kCameraAxesNames)
    if (!axes || *axes != name) t.change("camera-axes", {{"cameraAxes", name}}, name);
}

void turnEuler(Trials& t) {
  const Json* const euler = t.find("euler");
  if (!euler) return;
  const std::string order = (*euler)["order"].get<std::string>();
  Json inRadians = Json::array();
  std::array<double, 3> angles{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& angle = (*euler)["degrees"][i];
    inRadians.push_back((angle.is_string() ? angle.get<std::string>() : angle.dump()) + "rad");
    angles[i] = angle.is_number() ? angle.get<double>() : NAN;
  }
  if (!std::all_of(angles.begin(), angles.end(), [](double angle) { return std::isfinite(angle); })) return;
  t.change("radians", {{"euler.degrees", inRadians}});
  std::string other = "XYZ";
  do {
    if (other != order) t.change("euler-order", {{"euler", {{"order", other}, {"degrees", angles}}}}, other);
    std::array<double, 3> byAxis{};
    for (std::size_t i = 0; i < 3; ++i)
      if (const std::size_t at = order.find(other[i]); at != order.npos) byAxis[i] = angles[at];
    if (byAxis != angles) t.change("euler-order", {{"euler", {{"order", other}, {"degrees", byAxis}}}}, other);
  } while (std::next_permutation(other.begin(), other.end()));
  for (unsigned signs = 1; signs < 8; ++signs) {
    std::array<double, 3> signedAngles = angles;
    Json value = Json::array();
    for (std::size_t i = 0; i < 3; ++i) {
      const int sign = signs >> (2 - i) & 1 ? -1 : 1;
      signedAngles[i] *= sign;
      value.push_back(sign);
    }
    t.change("euler-sign", {{"euler.degrees", signedAngles}}, value);
  }
}

void turnOnEarth(Trials& t) {
  const char* const names[] = {"heading", "pitch", "roll"};
  if (!t.has("heading") && !t.has("pitch") && !t.has("roll")) return;
  std::vector<Set> radians;
  for (const char* const name : names)
    if (const Json* const angle = t.find(name); angle && angle->is_number())
      radians.emplace_back(name, angle->dump() + "rad");
  if (!radians.empty()) t.change("radians", radians);
  const double h = t.degreesOr("heading", 0), p = t.degreesOr("pitch", 0), r = t.degreesOr("roll", 0);
  for (const double v : {-h, 90 - h, h + 90, h - 90, h + 180, 180 - h})
    t.change("heading-convention", {{"heading", v}}, v);
  for (const double v : {-p, p - 90, p + 90, 90 - p, -90 - p}) t.change("pitch-convention", {{"pitch", v}}, v);
  for (const double v : {-r, r + 180, r + 90, r - 90}) t.change("roll-convention", {{"roll", v}}, v);
  t.change("heading-convention", {{"heading", -h}, {"roll", -r}});
  t.change("pitch-convention", {{"pitch", -p}, {"roll", -r}});
}

void movePlace(Trials& t) {
  const Json* const place = t.find("position");
  if (!place || !place->is_object()) return;
  const double lat = t.degreesOr("position.lat", 0), lon = t.degreesOr("position.lon", 0);
  for (const auto& [a, b] : {std::pair(lon, lat), {lat, -lon}, {-lat, lon}})
    t.change("place", {{"position.lat", a}, {"position.lon", b}}, {a, b});
  for (const PlaceMap map : {PlaceMap::exchange, PlaceMap::negateLon, PlaceMap::negateLat}) {
    Hypothesis points = t.next("place");
    points.places = map;
    t.add(std::move(points));
  }
}

/// With the rotation R in the document's own axes and the eye C, t = -R C is what a view matrix holds.
void rereadTranslation(Trials& t) {
  const Rows own = t.ownAxes(), rotation = mistakes::transposed(own) * t.plain().axes,
             back = mistakes::transposed(rotation);
  const Vec3 eye = t.plain().eye, none{}, view = scaled(rotation * eye, -1);
  const bool isProper = determinant(rotation) > 0;
  struct Reading {
    const char* mistake;
    bool isTransposed;
    Vec3 eye;
  };
  const Reading readings[] = {
      {"translation-as-position", false, view},
      {"translation-as-position", false, scaled(back * eye, -1)},
      {"translation-as-position", false, scaled(view, -1)},
      {"translation-as-position", false, back * eye},
      {"position-sign", false, scaled(eye, -1)},
      {"translation-left-out", false, none},
      {"pose-inverted", true, eye},
      {"pose-inverted", true, view},
      {"pose-inverted", true, scaled(eye, -1)},
      {"pose-inverted", true, scaled(view, -1)},
      {"pose-inverted", true, scaled(rotation * eye, -1)},
      {"pose-inverted", true, rotation * eye},
      {"pose-inverted", true, scaled(rotation * view, -1)},
      {"pose-inverted", true, none},
  };
  if (length(eye) > 0) {
    for (const Reading& each : readings)
      if (!each.isTransposed || isProper) t.pose(each.mistake, own * (each.isTransposed ? back : rotation), each.eye);
    t.pose("pose-twice", own * rotation * rotation, sum(eye, 1, back * eye));
    t.pose("pose-twice", t.plain().axes, scaled(eye, 2));
  }
  if (isProper && angleOf(rotation) > 1e-9) {
    t.pose("pose-left-out", own, eye);
    t.pose("pose-left-out", own, none);
  }
}

void changeUnits(Trials& t) {
  for (const double unit : {1000.0, 100.0, 10.0, 0.001, 0.01, 0.1, 0.3048, 1 / 0.3048, 2.54, 1 / 2.54, 25.4, 1 / 25.4,
                            0.0254, 1 / 0.0254}) {
    if (length(t.plain().eye) > 0) t.pose("unit", t.plain().axes, scaled(t.plain().eye, unit), {"position", unit});
    t.points("unit", {Vec3{unit, 0, 0}, {0, unit, 0}, {0, 0, unit}}, {"points", unit});
  }
}

void turnAxes(Trials& t) {
  for (const auto& [name, rows] : signedAxes()) {
    if (rows == kUnit) continue;
    const bool isUp = name == "x,z,-y" || name == "x,-z,y" || name == "x,z,y";
    const bool isMirror = name == "-x,y,z" || name == "x,-y,z" || name == "x,y,-z";
    t.points(isUp ? "up-axis" : isMirror ? "x-mirrored" : "point-axes", rows, isUp || isMirror ? Json() : Json(name));
  }
  for (const auto& [name, rows] : signedAxes())
    if (rows != kUnit && determinant(rows) > 0) t.pose("camera-axes", rows * t.plain().axes, t.plain().eye, name);
  if (t.has("target") || t.has("direction")) {
    const Rows& axes = t.plain().axes;
    t.pose("up-axis", {scaled(axes[0], -1), scaled(axes[1], -1), axes[2]}, t.plain().eye);
  }
}

}  // namespace

void addPoseRows(Trials& t) {
  invertPose(t);
  changeForm(t);
  turnEuler(t);
  turnOnEarth(t);
  movePlace(t);
  if (t.file().worldIsEcef) return;
  rereadTranslation(t);
  changeUnits(t);
  turnAxes(t);
}

}  // namespace viewproj::cmd::mistakes
