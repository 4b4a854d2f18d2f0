#include "commands/world_options.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/plain_camera.hpp"
#include "camera/read_pose.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

/// "x,y,-z".
AxisMap readMap(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = splitNames(option, text);
  const UsageError wrong(option + " " + text +
                         ": expected the new x, y, z in terms of the old, as in x,y,-z or -z,x,y");
  if (parts.size() != 3) throw wrong;
  AxisMap map;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool against = parts[i].starts_with('-');
    const std::string axis = parts[i].substr(against || parts[i].starts_with('+') ? 1 : 0);
    const std::size_t from = std::string("xyz").find(axis);
    if (axis.size() != 1 || from == std::string::npos) throw wrong;
    map.from[i] = from;
    map.signs[i] = against ? -1 : 1;
  }
  if (map.from[0] == map.from[1] || map.from[0] == map.from[2] || map.from[1] == map.from[2]) throw wrong;
  return map;
}

/// The value of --map from a world where `from` is up to one where `to` is: each along y or z.
std::string mapBetween(const Vec3& from, const Vec3& to, bool mirrors) {
  const auto axis = [](double sign, bool isZ) { return std::string(sign < 0 ? "-" : "") + (isZ ? 'z' : 'y'); };
  const bool fromZ = from.z != 0, toZ = to.z != 0;
  const double turn = (from.y + from.z) * (to.y + to.z), side = mirrors ? -1 : 1;
  const std::string up = axis(turn, fromZ),
                    other = axis(fromZ == toZ ? side * turn : -side * turn, fromZ == toZ ? !fromZ : toZ);
  return "x," + (toZ ? other + "," + up : up + "," + other);
}

}  // namespace

void WorldOptions::add(CLI::App& app) {
  addValue(app, "--map", "X,Y,Z", map_, readMap,
           "New axes of the world in terms of the old, as in x,y,-z; a map that mirrors changes the handedness");
  addValue(app, "--scale", "N", scale_,
           numberThat([](double scale) { return scale > 0 && std::isfinite(scale); }, "a number above 0"),
           "Multiply lengths by N: 0.01 for cm to metres");
}

CameraFile WorldOptions::mapped(const CameraFile& file) const {
  if (!map_ && !scale_) return file;
  return readCamera(cmd::mapped(file, map_.value_or(AxisMap{}), scale_.value_or(1)), file.reading);
}

void WorldOptions::noteWorld(const CameraFile& file, const ConventionPreset& preset, std::string_view form) const {
  const Vec3 up = file.worldIsEnu ? Vec3{0, 0, 1} : file.preset->up;
  const bool mirrors = file.convention.world != preset.convention.world;
  if (map_ || file.worldIsEcef || (up == preset.up && !mirrors)) return;
  const auto words = [](Handedness world, const Vec3& top) {
    return std::string(nameOf(kWorldNames, world)) + "-handed with " + (top.y + top.z < 0 ? "-" : "") +
           (top.z != 0 ? "z" : "y") + " up";
  };
  note(file.name + ": its world stays " + words(file.convention.world, up) + ", and that of " + std::string(form) +
       " is " + words(preset.convention.world, preset.up) + "; --map " + mapBetween(up, preset.up, mirrors) +
       " changes it");
}

void addAngles(CLI::App& app, const NameRow<EulerOrder>*& order, const std::string& help) {
  addOption(
      app, "--angles", "ORDER",
      [&order](const std::string& option, const std::string& text) {
        order = rowNamed(kEulerOrders, text);
        if (!order)
          throw UsageError(option + " " + text +
                           ": expected axes, such as YXZ, or rpy, blender, unity, godot, unreal or opk");
      },
      help + ", as YXZ, rpy, blender, unity, godot, unreal, opk");
}

OrderedJson anglesOf(const NameRow<EulerOrder>& order, const FieldValues& values, const ConventionPreset& preset,
                     const std::optional<Pose>& pose) {
  if (!pose) return {{"order", order.first}, {"degrees", nullptr}};
  if (const std::string fault = faultOfOrder(order, values, pose->world()); !fault.empty())
    throw UsageError("--angles " + fault);
  if (const auto* const told = rowNamed(kOrderNotes, order.first); told && pose->world() == Handedness::right)
    note(std::string(told->second));
  const bool isUnity = order.first == "unity", isUnreal = order.first == "unreal";
  if (pose->world() == Handedness::left && ((isUnity && preset.up.z != 0) || (isUnreal && preset.up.y != 0)))
    note("order " + std::string(order.first) + " is of a world with " + (isUnity ? "y" : "z") +
         " up, unlike this one; viewproj convert --map " +
         (isUnity ? "y,z,x turns Unreal's into Unity's" : "z,x,y turns Unity's into Unreal's"));
  const CameraAxes axes = axesOfOrder(order.second, pose->world(), cameraAxesOf(values, preset));
  Vec3 degrees = eulerDegreesOf(plainPose(*pose), order.second, axes);
  for (std::size_t i = 0; i < 3; ++i) degrees[i] = certainDegrees(degrees[i]);
  return {{"order", order.first}, {"degrees", asJson(degrees)}};
}

}  // namespace viewproj::cmd
