#include <array>
#include <cmath>

#include "camera/camera.hpp"
#include "camera/names.hpp"
#include "output/camera_json.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using namespace detail;

std::string matrixAsJson(const Mat4& m) {
  std::vector<std::string> rows;
  for (const auto& row : m.m) rows.push_back(jsonListOf(row));
  return jsonList(rows);
}

namespace {

Vec3 roundedUnlessTiny(const DDVec3& v) {
  Vec3 result = rounded(v);
  for (std::size_t i = 0; i < 3; ++i)
    if (std::fabs(result[i]) < kCancellation) result[i] = 0;
  return result;
}

/// The multiple by a power of two that takes the fewest digits: [-3, -2, -5] for [-0.75, -0.5, -1.25]; of those that
/// take as few the nearest to unit length.
Vec3 shortest(const Vec3& direction) {
  const double size = maxAbs(direction);
  if (!(size > 0x1p-1000 && size < 0x1p1000)) return direction;
  constexpr int kMost = 20;  // a longer number is none that somebody wrote
  const int unit = -std::ilogb(size);
  Vec3 best = direction;
  for (int k = 0; k <= kMost; ++k)
    for (int exponent : {unit - k, unit + k}) {
      Vec3 scaled;
      for (std::size_t i = 0; i < 3; ++i) scaled[i] = std::ldexp(direction[i], exponent);
      const bool isExact = std::ldexp(scaled.x, -exponent) == direction.x &&
                           std::ldexp(scaled.y, -exponent) == direction.y &&
                           std::ldexp(scaled.z, -exponent) == direction.z;
      const auto length = jsonOf(scaled).size(), least = jsonOf(best).size();
      if (isExact && (length < least || (k == 0 && length == least))) best = scaled;
    }
  return best;
}

/// position with direction or target, and an up where it is not the default.
void addLooking(std::vector<std::string>& forms, const Pose& pose, Vec3 defaultUp) {
  const auto add = [&](std::string_view name, const Vec3& where) {
    // An axis of the world that gives the same picture before the camera's own.
    const auto addWith = [&](const Vec3& up) {
      JsonObject out;
      out.addText("position", jsonOf(pose.eye()));
      out.addText(name, jsonOf(where));
      if (!(up == defaultUp)) out.addText("up", jsonOf(up));
      forms.push_back(out.members());
    };
    const Vec3 axes[] = {defaultUp, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {-1, 0, 0}};
    for (const Vec3& up : axes) {
      const DDVec3 u = toDoubleDouble(up);
      if (dot(parts(pose).rows.up, u).hi > 0 && std::fabs(dot(parts(pose).rows.right, u).hi) <= kCancellation) {
        addWith(up);
        break;
      }
    }
    addWith(roundedUnlessTiny(parts(pose).rows.up));
  };
  const DDVec3& given = parts(pose).way;
  if (maxAbs(given) == 0) return add("direction", roundedUnlessTiny(parts(pose).rows.forward));
  // As it was given, up to a power of two: the direction, or a target where that is longer than doubles.
  const auto isRound = [](const DDVec3& v) { return v.x.lo == 0 && v.y.lo == 0 && v.z.lo == 0; };
  if (!isRound(given))
    for (int k = -60; k <= 60; ++k) {
      const DDVec3 target = toDoubleDouble(pose.eye()) + scaleByPowerOfTwo(given, k);
      if (!isRound(target) || !isFinite(rounded(target))) continue;
      add("target", rounded(target));
      break;
    }
  add("direction", shortest(rounded(given)));
}

/// x, y, z, w of the rotation with these columns.
std::array<DoubleDouble, 4> quaternionOf(const std::array<DDVec3, 3>& c) {
  const DoubleDouble one = 1;
  const std::array<DoubleDouble, 4> squares = {one + c[0].x - c[1].y - c[2].z, one - c[0].x + c[1].y - c[2].z,
                                               one - c[0].x - c[1].y + c[2].z, one + c[0].x + c[1].y + c[2].z};
  const DoubleDouble xy = c[1].x + c[0].y, xz = c[2].x + c[0].z, yz = c[2].y + c[1].z;
  const DoubleDouble xw = c[1].z - c[2].y, yw = c[2].x - c[0].z, zw = c[0].y - c[1].x;
  // Four times the products with the largest, which then divides.
  const std::array<std::array<DoubleDouble, 4>, 4> products = {
      {{squares[0], xy, xz, xw}, {xy, squares[1], yz, yw}, {xz, yz, squares[2], zw}, {xw, yw, zw, squares[3]}}};
  std::size_t largest = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (squares[i].hi > squares[largest].hi) largest = i;
  const DoubleDouble divisor = timesPowerOfTwo(sqrt(squares[largest]), 2);
  std::array<DoubleDouble, 4> q = products[largest];
  for (DoubleDouble& part : q) part = part / divisor;
  return q;
}

void addAxes(JsonObject& out, CameraAxes axes, const ConventionPreset& preset) {
  if (axes != preset.cameraAxes) out.add("cameraAxes", nameOf(kCameraAxesNames, axes));
}

std::array<DDVec3, 3> columnsOf(const Axes& a, CameraAxes axes) {
  switch (axes) {
    case CameraAxes::RUB:
      return {a.right, a.up, -a.forward};
    case CameraAxes::RUF:
      return {a.right, a.up, a.forward};
    case CameraAxes::RDF:
      return {a.right, -a.up, a.forward};
    case CameraAxes::FRU:
      break;
  }
  return {a.forward, a.right, a.up};
}

}  // namespace

std::array<DoubleDouble, 4> rotationOf(const Pose& pose, CameraAxes axes) {
  return quaternionOf(columnsOf(parts(pose).columns, axes));
}

namespace {

/// Of the length it was given in, where it was given: then its parts are doubles.
void addRotation(std::vector<std::string>& forms, const Pose& pose, CameraAxes axes, const ConventionPreset& preset) {
  const DoubleDouble length = parts(pose).rotationLength;
  JsonObject out;
  out.addText("position", jsonOf(pose.eye()));
  addAxes(out, axes, preset);
  std::vector<std::string> numbers;
  for (const DoubleDouble& part : rotationOf(pose, axes)) numbers.push_back(jsonOf(part * length));
  out.addText("rotation", jsonList(numbers));
  forms.push_back(out.members());
}

}  // namespace

std::vector<std::string> poseForms(const CameraFile& camera, const ConventionPreset& preset) {
  if (!camera.pose) return {""};
  std::vector<std::string> forms;
  addLooking(forms, *camera.pose, preset.up);
  const Handedness world = camera.convention.world;
  const bool right = world == Handedness::right;
  const bool downwards = right && preset.cameraAxes == CameraAxes::RDF;
  const CameraAxes axes = downwards ? CameraAxes::RDF : right ? CameraAxes::RUB : CameraAxes::RUF;
  addRotation(forms, *camera.pose, axes, preset);
  if (!right) addRotation(forms, *camera.pose, CameraAxes::FRU, preset);
  const Convention read{.world = world, .view = downwards ? ViewAxes::RDF : right ? ViewAxes::RUB : ViewAxes::RUF};
  const auto addMatrix = [&](std::string_view field, const Mat4& matrix) {
    JsonObject out;
    addAxes(out, axes, preset);
    out.addText(field, matrixAsJson(matrix));
    forms.push_back(out.members());
  };
  addMatrix("worldFromCamera", worldFromView(*camera.pose, read));
  addMatrix("cameraFromWorld", viewFromWorld(*camera.pose, read));
  return forms;
}

}  // namespace viewproj::cmd
