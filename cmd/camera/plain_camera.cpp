#include "camera/plain_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "camera/plain_vectors.hpp"
#include "camera/read_pose.hpp"
#include "numbers/vectors.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using detail::DDVec3;
using detail::toDoubleDouble;

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
/// Where rounding is all that differs.
constexpr double kRounding = 1e-12;

Json listOf(const Vec3& v) { return {v.x, v.y, v.z}; }
double dotOf(const Vec3& a, const Vec3& b) { return dot(toDoubleDouble(a), toDoubleDouble(b)).hi; }

/// The axis of a letter of RUB, FRD ...
Vec3 axisOf(char letter, const PlainPose& p) {
  const Vec3& axis = letter == 'R' || letter == 'L' ? p.right : letter == 'U' || letter == 'D' ? p.up : p.forward;
  return letter == 'L' || letter == 'D' || letter == 'B' ? scaled(axis, -1) : axis;
}

Vec3 rotationVectorOf(const PlainColumns& c) {
  const std::array<double, 4> q = quaternionOf(c);
  const double sine = detail::hypotenuse(q[0], q[1], q[2]);
  return scaled({q[0], q[1], q[2]}, sine > 0 ? 2 * std::atan2(sine, q[3]) / sine : 2);
}

/// Degrees of turns about these axes, in this order. Where the first and last turn are about one line, the last is 0.
Vec3 turnsOf(const PlainColumns& c, const std::array<std::size_t, 3>& axis) {
  const std::size_t i = axis[0], j = axis[1], k = 3 - i - j;
  const bool returns = i == axis[2];  // as in ZXZ
  const double e = (i + 1) % 3 == j ? 1 : -1;
  const auto r = [&](std::size_t row, std::size_t column) { return c[column][row]; };
  double first = 0, last = 0;
  const double across = returns ? std::hypot(r(i, j), r(i, k)) : std::hypot(r(i, i), r(i, j));
  const double middle = returns ? std::atan2(across, r(i, i)) : std::atan2(e * r(i, k), across);
  if (across < kRounding) {
    first = std::atan2(e * r(k, j), r(j, j));
  } else if (returns) {
    first = std::atan2(r(j, i), -e * r(k, i));
    last = std::atan2(r(i, j), e * r(i, k));
  } else {
    first = std::atan2(-e * r(j, k), r(k, k));
    last = std::atan2(-e * r(i, j), r(i, i));
  }
  return {first * kDegrees, middle * kDegrees, last * kDegrees};
}

// ---- Poses in the document's form

Json placeOf(const Vec3& point) {
  const Geodetic place = ecefToGeodetic(point);
  return {{"lat", place.lat}, {"lon", place.lon}, {"height", place.height}};
}

/// worldFromCamera or, if isInverse, cameraFromWorld, in the form of the old value.
Json rigidOf(const PlainPose& pose, CameraAxes axes, bool isInverse, const Json& old) {
  const PlainRigid plain = isInverse ? cameraFromWorld(pose, axes) : worldFromCamera(pose, axes);
  const PlainColumns& c = plain.columns;
  const auto row = [&](std::size_t i) { return Json{c[0][i], c[1][i], c[2][i]}; };
  if (!old.is_object()) {
    Json rows{row(0), row(1), row(2)};
    for (std::size_t i = 0; i < 3; ++i) rows[i].push_back(plain.translation[i]);
    if (old.size() != 3) rows.push_back({0, 0, 0, 1});
    return rows;
  }
  Json rigid{{"translation", listOf(plain.translation)}};
  if (old.contains("rotationVector"))
    rigid["rotationVector"] = listOf(rotationVectorOf(c));
  else if (old.contains("rotation") && old["rotation"].size() == 4)
    rigid["rotation"] = quaternionOf(c);
  else
    rigid["rotation"] = {row(0), row(1), row(2)};
  return rigid;
}

/// An angle within half a turn of the old one, which stays as it is where rounding is all that differs.
void putAngle(Json& root, const char* name, double degrees) {
  const double old = root.contains(name) && root[name].is_number() ? root[name].get<double>() : 0;
  const double change = std::remainder(degrees - old, 360);
  if (std::fabs(change) > 360 * kRounding) root[name] = old + change;
}

/// A target at its old distance, or a direction; and up, if the old one does not give this pose.
void putLook(Json& root, const FieldValues& values, const CameraFile& camera, const PlainPose& pose) {
  const Vec3& eye = pose.eye;
  if (values.has("target")) {
    const Vec3 ahead = scaled(pose.forward, *camera.targetDistance);
    root["target"] = {eye.x + ahead.x, eye.y + ahead.y, eye.z + ahead.z};
  } else {
    root["direction"] = listOf(scaled(pose.forward, length(*values.find<Vec3>("direction"))));
  }
  try {
    const Handedness hand = camera.convention.world;
    const Vec3 usual = values.valueOr("up", camera.worldIsEnu ? Vec3{0, 0, 1} : camera.preset->up);
    const bool isNormal = camera.worldIsEcef && !values.has("up");
    const Pose upright = isNormal ? lookAlongOnEarth(eye, pose.forward, ecefToGeodetic(eye), hand)
                                  : lookAlong(eye, pose.forward, usual, hand);
    const Vec3 above = upright.up();
    if (apart(above, pose.up) <= kRounding) return;
  } catch (const CameraError&) {  // straight up or down
  }
  root["up"] = listOf(pose.up);
}

// ---- Windows

Json edgesOf(const char* type, const Projection& p, double scale) {
  return {{"type", type},
          {"left", p.left() * scale},
          {"right", p.right() * scale},
          {"bottom", p.bottom() * scale},
          {"top", p.top() * scale}};
}

/// Puts a window into the document's form of projection. before: the window that it has.
struct WindowWriter {
  const CameraFile& camera;
  const FieldValues& values;
  const Projection &before, &after;
  Json& fields;  ///< the projection

  double width() const { return after.right() - after.left(); }
  double height() const { return after.top() - after.bottom(); }
  bool isCentred() const {
    return std::fabs(after.left() + after.right()) <= kRounding * width() &&
           std::fabs(after.bottom() + after.top()) <= kRounding * height();
  }
  bool hasOldShape() const { return std::fabs(after.aspect() - before.aspect()) <= kRounding * before.aspect(); }
  /// How much narrower the window is.
  double narrower() const { return (before.right() - before.left()) / width(); }
  double old(FieldId field) const { return *values.find<double>(field); }

  bool perspective() const {
    if (!isCentred()) return false;
    if (values.has("projection.nearWidth")) {
      fields["nearWidth"] = width() * after.zNear();
      fields["nearHeight"] = height() * after.zNear();
      return after.zNear() > 0;
    }
    if (!hasOldShape()) return false;
    if (values.has("projection.focalLength"))
      fields["focalLength"] = old("projection.focalLength") * narrower();
    else
      for (const auto& [name, of] :
           {std::pair("fovY", Fov::vertical), {"fovX", Fov::horizontal}, {"fovDiagonal", Fov::diagonal}})
        if (fields.contains(name)) fields[name] = after.fov(of);
    return true;
  }

  bool orthographic() const {
    const bool hasWidth = values.has("projection.width"), hasHeight = values.has("projection.height");
    if (!isCentred() || (hasWidth != hasHeight && !hasOldShape())) return false;
    if (hasWidth) fields["width"] = width();
    if (hasHeight) fields["height"] = height();
    return hasWidth || hasHeight;
  }

  void intrinsics() const {
    const auto picture = readPicture(values, {camera.preset, camera.convention, camera.statesConvention});
    if (!picture) return;
    const auto [fx, fy, cx, cy] =
        cameraIn(camera.convention, {}, asCalibrated(camera, after), pictureOfIntrinsics(values, picture->frame))
            .intrinsics();
    fields.update({{"fx", fx}, {"fy", fy}, {"cx", cx}, {"cy", cy}});
  }

  bool ps2() const {
    if (!isCentred()) camera.fail(camera.name + ": a ps2 projection has its viewing axis in the middle of the picture");
    fields["scrz"] = old("projection.scrz") * narrower();
    if (!hasOldShape()) fields["ay"] = old("projection.ay") * (before.top() - before.bottom()) / height() / narrower();
    return true;
  }

  bool inOldForm() const {
    switch (typeOf(values)) {
      case kPerspective:
        return perspective();
      case kFrustum:
      case kScreen:
        for (const char* const name : {"left", "right", "bottom", "top", "bottomLeft", "bottomRight", "topLeft"})
          fields.erase(name);
        fields.update(edgesOf("frustum", after, after.zNear()));
        return after.zNear() > 0;
      case kIntrinsics:
        intrinsics();
        return true;
      case kOrthographic:
        return orthographic();
      case kPs2:
        return ps2();
      default:
        putMatrix(*camera.document.root, after, camera.convention);
        return true;
    }
  }
};

}  // namespace

PlainPose plainPose(const Pose& pose) { return {pose.eye(), pose.right(), pose.up(), pose.forward()}; }

LocalAxes localAxes(const Geodetic& place) {
  const double lat = place.lat / kDegrees, lon = place.lon / kDegrees;
  const double sp = std::sin(lat), cp = std::cos(lat), sl = std::sin(lon), cl = std::cos(lon);
  return {{-sl, cl, 0}, {-sp * cl, -sp * sl, cp}, {cp * cl, cp * sl, sp}};
}

PlainRigid worldFromCamera(const PlainPose& pose, CameraAxes axes) {
  const std::string_view name = nameOf(kCameraAxesNames, axes);
  return {{axisOf(name[0], pose), axisOf(name[1], pose), axisOf(name[2], pose)}, pose.eye};
}

PlainRigid cameraFromWorld(const PlainPose& pose, CameraAxes axes) {
  const PlainColumns c = worldFromCamera(pose, axes).columns;
  return {{Vec3{c[0].x, c[1].x, c[2].x}, Vec3{c[0].y, c[1].y, c[2].y}, Vec3{c[0].z, c[1].z, c[2].z}},
          {-dotOf(c[0], pose.eye) + 0.0, -dotOf(c[1], pose.eye) + 0.0, -dotOf(c[2], pose.eye) + 0.0}};
}

std::array<double, 4> quaternionOf(const PlainColumns& c) {
  const std::array<double, 4> squares = {1 + c[0].x - c[1].y - c[2].z, 1 - c[0].x + c[1].y - c[2].z,
                                         1 - c[0].x - c[1].y + c[2].z, 1 + c[0].x + c[1].y + c[2].z};
  const double xy = c[1].x + c[0].y, xz = c[2].x + c[0].z, yz = c[2].y + c[1].z;
  const double xw = c[1].z - c[2].y, yw = c[2].x - c[0].z, zw = c[0].y - c[1].x;
  // Products with the largest component, times four. Dividing by it gives the quaternion.
  const std::array<std::array<double, 4>, 4> products = {
      {{squares[0], xy, xz, xw}, {xy, squares[1], yz, yw}, {xz, yz, squares[2], zw}, {xw, yw, zw, squares[3]}}};
  const auto largest = std::max_element(squares.begin(), squares.end());
  std::array<double, 4> q = products[static_cast<std::size_t>(largest - squares.begin())];
  const double divisor = std::copysign(2 * std::sqrt(*largest), q[3]);
  for (double& part : q) part = part / divisor + 0.0;
  return q;
}

Projection asCalibrated(const CameraFile& camera, const Projection& p) {
  if (!camera.lens) return p;
  const double slope = 1 / calibrated(perspectiveWindow(-1, 1, -1, 1, 0, kInfiniteFar), *camera.lens).right();
  if (slope == 1) return p;
  return perspectiveWindow(p.left() * slope, p.right() * slope, p.bottom() * slope, p.top() * slope, p.zNear(),
                           p.zFar());
}

Document copied(const Document& document) {
  Document copy = document;
  copy.root = std::make_shared<Json>(*document.root);
  return copy;
}

Bearing bearingOf(const Vec3& direction, const Vec3& eye, bool worldIsEcef) {
  const LocalAxes at = worldIsEcef ? localAxes(ecefToGeodetic(eye)) : LocalAxes{};
  const double toEast = dotOf(direction, at.east), toNorth = dotOf(direction, at.north), rise = dotOf(direction, at.up);
  const double level = std::hypot(toEast, toNorth), azimuth = std::atan2(toEast, toNorth) * kDegrees;
  const double around = azimuth < 0 ? azimuth + 360 : azimuth;
  const bool isUpright = level <= kRounding * std::fabs(rise), isNone = level == 0 && rise == 0;
  return {isUpright ? NAN : around >= 360 ? 0 : around, isNone ? NAN : std::atan2(rise, level) * kDegrees};
}

HeadingPitchRoll headingPitchRollOf(const PlainPose& pose, bool worldIsEcef) {
  const LocalAxes at = worldIsEcef ? localAxes(ecefToGeodetic(pose.eye)) : LocalAxes{};
  const double toEast = dotOf(pose.forward, at.east), toNorth = dotOf(pose.forward, at.north);
  const double level = std::hypot(toEast, toNorth), rise = dotOf(pose.forward, at.up);
  if (level < kRounding)
    return {std::atan2(-dotOf(pose.right, at.north), dotOf(pose.right, at.east)) * kDegrees, rise < 0 ? -90.0 : 90.0,
            0};
  // The level camera of that heading has these axes to the right and up.
  const double sine = toEast / level, cosine = toNorth / level;
  const auto inWorld = [&](double east, double north, double up) {
    return Vec3{east * at.east.x + north * at.north.x + up * at.up.x,
                east * at.east.y + north * at.north.y + up * at.up.y,
                east * at.east.z + north * at.north.z + up * at.up.z};
  };
  const Vec3 right = inWorld(cosine, -sine, 0), up = inWorld(-rise * sine, -rise * cosine, level);
  return {std::atan2(toEast, toNorth) * kDegrees, std::atan2(rise, level) * kDegrees,
          std::atan2(-dotOf(pose.right, up), dotOf(pose.right, right)) * kDegrees};
}

Vec3 eulerDegreesOf(const PlainPose& pose, const EulerOrder& order, CameraAxes axes) {
  const Vec3 turns = turnsOf(worldFromCamera(pose, axes).columns, order.axis);
  Vec3 degrees;
  for (std::size_t i = 0; i < 3; ++i) degrees[order.listed[i]] = order.sign[i] * turns[i] + 0.0;
  return degrees;
}

void orient(Json& root, FieldId field, Json value) {
  for (const Field& other : kFields)
    if (contradict(other, *field)) root.erase(std::string(other.path));
  root[std::string(field->path)] = std::move(value);
}

void putRotation(Json& root, const PlainPose& pose, Handedness world) {
  const CameraAxes axes = world == Handedness::right ? CameraAxes::RUB : CameraAxes::RUF;
  orient(root, "rotation", quaternionOf(worldFromCamera(pose, axes).columns));
  root["cameraAxes"] = nameOf(kCameraAxesNames, axes);
}

Mat4 clipFromView(const Projection& p, const Convention& convention) {
  const auto matrixOf = [&](const Projection& each) {
    return matrix(cameraIn(convention, {}, each), Space::clip, Space::view);
  };
  if (hasDepth(p)) return matrixOf(p);
  Mat4 rows = matrixOf(perspectiveWindow(p.left(), p.right(), p.bottom(), p.top(), 1, kInfiniteFar));
  rows[2] = {};
  return rows;
}

void putMatrix(Json& root, const Projection& projection, const Convention& convention) {
  root["projection"]["matrix"] = laidOut(clipFromView(projection, convention), convention).m;
  if (!hasDepth(projection)) return;
  root["projection"].erase("near");
  root["projection"].erase("far");
}

Document withoutScreen(const CameraFile& camera) {
  const bool isScreen = typeOf(readValues(camera.document)) == kScreen;
  return isScreen ? withProjection(camera, frameProjection(camera)) : copied(camera.document);
}

Document withPose(const CameraFile& camera, const PlainPose& pose) {
  Document document = withoutScreen(camera);
  Json& root = *document.root;
  const FieldValues values = readValues(document);
  const CameraAxes axes = cameraAxesOf(values, *camera.preset);
  const auto* const position = values.find<Position>("position");
  if (position) root["position"] = position->place ? placeOf(pose.eye) : listOf(pose.eye);
  for (const FieldId field : {FieldId("worldFromCamera"), FieldId("cameraFromWorld")})
    if (const Json* const old = valueAt(*camera.document.root, field->path)) {
      root[std::string(field->path)] = rigidOf(pose, axes, field->path == "cameraFromWorld", *old);
      return document;
    }
  const auto* const target = values.find<Position>("target");
  if (values.has("rotation")) {
    root["rotation"] = quaternionOf(worldFromCamera(pose, axes).columns);
  } else if (const auto* const euler = values.find<EulerTurns>("euler")) {
    const EulerOrder& order = euler->order->second;
    root["euler"]["degrees"] = listOf(eulerDegreesOf(pose, order, axes));
  } else if (values.has("direction") || (target && !target->place)) {
    putLook(root, values, camera, pose);
  } else {
    const HeadingPitchRoll angles = headingPitchRollOf(pose, camera.worldIsEcef);
    if (target) orient(root, "heading", angles.heading.value);
    putAngle(root, "heading", angles.heading.value);
    putAngle(root, "pitch", angles.pitch.value);
    putAngle(root, "roll", angles.roll.value);
  }
  return document;
}

Projection frameProjection(const CameraFile& camera) {
  Document whole = copied(camera.document);
  (*whole.root)["projection"].erase("shift");
  if (valueAt(*whole.root, "viewport")) (*whole.root)["viewport"].erase("crop");
  return *readCamera(whole, {.allowStretch = true, .needsPicture = camera.reading.needsPicture}).projection;
}

Projection frameProjection(const CameraFile& camera, const Intrinsics& ofTile, double zNear, double zFar) {
  const FieldValues values = readValues(camera.document);
  const auto picture = readPicture(values, {camera.preset, camera.convention, camera.statesConvention});
  const Crop crop = picture->crop.value_or(Crop{});
  const Projection shown =
      intrinsics(ofTile.fx, ofTile.fy, ofTile.cx + crop.x, ofTile.cy + crop.y, picture->frame, zNear, zFar);
  const auto* const shift = values.find<Vec2>("projection.shift");
  return shift ? shifted(shown, -shift->x, -shift->y) : shown;
}

Document withProjection(const CameraFile& camera, const Projection& projection) {
  CameraFile changed = camera;
  changed.document = copied(camera.document);
  Json& root = *changed.document.root;
  const FieldValues values = readValues(camera.document);
  const Projection before = frameProjection(camera);
  const WindowWriter writer{changed, values, before, projection, root["projection"]};
  const auto putRange = [&](Json& fields) {
    if (projection.zNear() != before.zNear() || !fields.contains("near")) fields["near"] = projection.zNear();
    if (projection.zFar() != before.zFar() || !fields.contains("far")) fields["far"] = projection.zFar();
    if (!hasDepth(projection)) fields.erase("near");
    if (!std::isfinite(projection.zFar())) fields.erase("far");
  };
  // A screen orients the camera too.
  if (typeOf(values) == kScreen && camera.pose) putRotation(root, plainPose(*camera.pose), camera.convention.world);
  const bool keeps = projection.isOrthographic() == before.isOrthographic() && writer.inOldForm();
  if (keeps) {
    if (typeOf(values) != kMatrix) putRange(root["projection"]);
    return changed.document;
  }
  Json fields;
  if (projection.isOrthographic()) {
    fields = edgesOf("orthographic", projection, 1);
    if (const Json* const shift = valueAt(root, "projection.shift")) fields["shift"] = *shift;
  } else {
    const auto picture = readPicture(values, {camera.preset, camera.convention, camera.statesConvention});
    if (!picture)
      camera.fail(camera.name + ": this projection has no form without a viewport; --viewport WIDTHxHEIGHT gives one");
    const auto* const shift = values.find<Vec2>("projection.shift");
    const auto [fx, fy, cx, cy] =
        cameraIn(camera.convention, {},
                 asCalibrated(camera, shift ? shifted(projection, shift->x, shift->y) : projection), picture->frame)
            .intrinsics();
    fields = {{"type", "intrinsics"}, {"fx", fx}, {"fy", fy}, {"cx", cx}, {"cy", cy}};
  }
  putRange(fields);
  root["projection"] = std::move(fields);
  return changed.document;
}

}  // namespace viewproj::cmd
