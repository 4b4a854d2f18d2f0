#include "camera/write_camera.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/change_camera.hpp"
#include "camera/check.hpp"
#include "camera/fields.hpp"
#include "camera/read_pose.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {
namespace {

/// Adds every field of the convention, or those that differ from the other one.
void addAxes(JsonObject& out, const Convention& c, const Convention* other) {
  const auto add = [&](std::string_view name, const auto& names, auto axis) {
    if (!other || c.*axis != other->*axis) out.add(name, nameOf(names, c.*axis));
  };
  add("world", kWorldNames, &Convention::world);
  add("view", kViewNames, &Convention::view);
  add("ndcZ", kNdcZNames, &Convention::ndcZ);
  if (!other || c.reverseZ != other->reverseZ) out.add("reverseZ", c.reverseZ);
  add("ndcY", kNdcYNames, &Convention::ndcY);
  add("vectors", kVectorsNames, &Convention::vectors);
  add("storage", kStorageNames, &Convention::storage);
}

/// The order of members that are not in the table of fields.
constexpr const char* kMembers[] = {"lat",         "lon",   "height", "order", "degrees", "rotation", "rotationVector",
                                    "translation", "rows",  "cols",   "data",  "model",   "xi",       "alpha",
                                    "beta",        "omega", "k",      "p",     "limit",   "radius",   "x",
                                    "y",           "z",     "w"};

std::string textOf(const Json& value) {
  if (value.is_number()) return jsonOf(value.get<double>());
  if (value.is_string()) return jsonOf(value.get<std::string>());
  if (!value.is_structured()) return value.dump();
  if (value.is_array()) {
    std::vector<std::string> items;
    for (const Json& item : value) items.push_back(textOf(item));
    return jsonList(items);
  }
  JsonObject out;
  for (const char* name : kMembers)
    if (const auto member = value.find(name); member != value.end() && !member->is_null())
      out.addText(name, textOf(*member));
  return out.text();
}

/// An object of the document, with its members in the order of the table.
std::string objectAt(const Json& document, const std::string& path) {
  JsonObject out;
  for (const std::string_view name : namesUnder(path)) {
    const std::string member = joinedPath(path, name);
    if (const Json* const value = valueAt(document, member))
      out.addText(name, findField(member) ? textOf(*value) : objectAt(document, member));
  }
  return out.text();
}

/// Writes the defaults of the old preset into the document where the new preset has other defaults.
void settleDefaults(Json& document, const ConventionPreset& from, const ConventionPreset& to, bool worldIsEcef) {
  const auto has = [&](std::initializer_list<const char*> paths) {
    return std::any_of(paths.begin(), paths.end(), [&](const char* path) { return valueAt(document, path); });
  };
  if (from.up != to.up && has({"target", "direction"}) && !has({"up"}) && !worldIsEcef)
    document["up"] = {from.up.x, from.up.y, from.up.z};
  if (from.cameraAxes != to.cameraAxes && has({"rotation", "euler", "worldFromCamera", "cameraFromWorld"}) &&
      !has({"cameraAxes"}))
    document["cameraAxes"] = nameOf(kCameraAxesNames, from.cameraAxes);
  if (from.pixelCenter != to.pixelCenter && has({"viewport"}) && !has({"viewport.pixelCenter"}))
    document["viewport"]["pixelCenter"] = from.pixelCenter;
}

}  // namespace

std::string jsonOf(const Convention& convention) {
  JsonObject out;
  addAxes(out, convention, nullptr);
  return out.text();
}

std::string writeCamera(const CameraFile& camera, const ConventionPreset& preset, const Convention& convention) {
  Document written = copied(camera.document);
  Json& document = *written.root;
  settleDefaults(document, *readConvention(camera.document).preset, preset, camera.worldIsEcef);
  if (const Json* const type = valueAt(document, "projection.type"); type && *type == "ps2" && !convention.reverseZ)
    throw InputError(camera.name +
                     ": a ps2 projection has no form in a convention whose depth is not reversed; "
                     "--reverse-z or --convention ps2 reverses it");
  if (valueAt(document, "projection.matrix") && convention != camera.convention)
    setLensMatrix(written, uncroppedProjection(camera.document), convention);
  JsonObject axes;
  axes.add("preset", preset.name);
  addAxes(axes, convention, &preset.convention);
  constexpr std::string_view kLine = ",\n  ";
  JsonObject out;
  out.addText("convention", preset.convention == convention ? jsonOf(preset.name) : axes.text(), kLine);
  for (const std::string_view name : namesUnder(""))
    if (const Json* const value = name == "convention" ? nullptr : valueAt(document, name))
      out.addText(name, findField(name) ? textOf(*value) : objectAt(document, std::string(name)), kLine);
  return "{\n  " + out.members() + "\n}\n";
}

}  // namespace viewproj::cmd
