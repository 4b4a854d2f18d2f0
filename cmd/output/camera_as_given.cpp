// A camera document as text, in the order of the table of fields.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/check.hpp"
#include "camera/fields.hpp"
#include "camera/read_pose.hpp"
#include "output/camera_json.hpp"
#include "output/camera_text.hpp"

namespace viewproj::cmd {
namespace {

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
  for (const char* name : {"lat", "lon", "height", "order", "degrees", "rotation", "rotationVector", "translation",
                           "model", "k", "p", "limit", "radius", "x", "y", "z", "w", "width"})
    if (const auto member = value.find(name); member != value.end() && !member->is_null())
      out.addText(name, textOf(*member));
  return out.text();
}

/// An object of the document, its members in the order of the table.
std::string objectAt(const Json& document, const std::string& path) {
  JsonObject out;
  for (const std::string_view name : namesUnder(path)) {
    const std::string member = joinedPath(path, name);
    if (const Json* const value = valueAt(document, member))
      out.addText(name, findField(member) ? textOf(*value) : objectAt(document, member));
  }
  return out.text();
}

}  // namespace

std::string writeDocument(const Document& given, const ConventionPreset& preset, const Convention& convention) {
  Json document = *given.root;
  const ConventionPreset& from = *readConvention(given).preset;
  const auto has = [&](std::initializer_list<const char*> paths) {
    return std::any_of(paths.begin(), paths.end(), [&](const char* path) { return valueAt(document, path); });
  };
  if (from.up != preset.up && has({"target", "direction"}) && !has({"up"}) && !worldIsEcef(given))
    document["up"] = {from.up.x, from.up.y, from.up.z};
  if (from.cameraAxes != preset.cameraAxes && has({"rotation", "euler", "worldFromCamera", "cameraFromWorld"}) &&
      !has({"cameraAxes"}))
    document["cameraAxes"] = nameOf(kCameraAxesNames, from.cameraAxes);
  if (from.pixelCenter != preset.pixelCenter && has({"viewport"}) && !has({"viewport.pixelCenter"}))
    document["viewport"]["pixelCenter"] = from.pixelCenter;
  constexpr std::string_view kLine = ",\n  ";
  JsonObject out;
  out.addText("convention", conventionAsJson(convention, preset), kLine);
  for (const std::string_view name : namesUnder("")) {
    const Json* const value = name == "convention" ? nullptr : valueAt(document, name);
    if (value) out.addText(name, findField(name) ? textOf(*value) : objectAt(document, std::string(name)), kLine);
  }
  return "{\n  " + out.members() + "\n}\n";
}

}  // namespace viewproj::cmd
