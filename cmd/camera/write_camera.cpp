#include "camera/write_camera.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/change_camera.hpp"
#include "text/json_text.hpp"

namespace viewproj::cmd {
namespace {

/// The members of a value, in the order in which they are written.
std::vector<std::string_view> membersOf(const Field& field, const Json& value) {
  std::vector<std::string_view> names = wordsIn(rowOf(field.kind).members);
  for (const LensForm& form : lensForms())
    if (field.kind == Kind::lens && value.contains("model") && value["model"] == form.model) names = lensMembers(form);
  return names;
}

std::string textOf(const Json& value) {
  if (value.is_number()) return jsonOf(value.get<double>());
  if (value.is_string()) return jsonOf(value.get<std::string>());
  if (!value.is_structured()) return value.dump();
  std::vector<std::string> items;
  if (value.is_array()) {
    for (const Json& item : value) items.push_back(textOf(item));
    return jsonList(items);
  }
  if (value.contains("data")) return textOf(value["data"]);
  for (const char* const name : {"x", "y", "z", "w"})
    if (value.contains(name)) items.push_back(textOf(value[name]));
  if (!items.empty()) return jsonList(items);
  JsonObject out;
  for (const auto& [name, member] : value.items()) out.addText(name, textOf(member));
  return out.text();
}

std::string textOf(const Field& field, const Json& value) {
  const auto names = value.is_object() ? membersOf(field, value) : std::vector<std::string_view>{};
  if (std::none_of(names.begin(), names.end(), [&](std::string_view name) { return value.contains(name); }))
    return textOf(value);
  JsonObject out;
  for (const std::string_view name : names)
    if (const auto member = value.find(name); member != value.end() && !member->is_null())
      out.addText(name, textOf(*member));
  return out.text();
}

/// An object of the document, with its members in the order of the table.
std::string objectAt(const Json& document, const std::string& path) {
  JsonObject out;
  for (const std::string_view name : namesUnder(path)) {
    const std::string member = joinedPath(path, name);
    const Json* const value = valueAt(document, member);
    const Field* const field = findField(member);
    if (value) out.addText(name, field ? textOf(*field, *value) : objectAt(document, member));
  }
  return out.text();
}

}  // namespace

std::string writeCamera(const CameraFile& camera, const ConventionPreset& preset, const Convention& convention,
                        std::string_view between) {
  const Document written = inConvention(camera, preset, convention);
  const Json& document = *written.root;
  JsonObject out;
  out.addText("convention", jsonOf(preset, convention), between);
  for (const std::string_view name : namesUnder(""))
    if (const Json* const value = name == "convention" ? nullptr : valueAt(document, name)) {
      const Field* const field = findField(name);
      out.addText(name, field ? textOf(*field, *value) : objectAt(document, std::string(name)), between);
    }
  const std::string line(between.substr(std::min(between.find('\n'), between.size())));
  return "{" + line + out.members() + (line.empty() ? "}" : "\n}\n");
}

std::vector<std::string> setsBetween(const Document& from, const Document& to) {
  std::vector<std::string> sets;
  const auto differ = [&](std::string_view path) {
    const Json *const a = valueAt(*from.root, path), *const b = valueAt(*to.root, path);
    return a && b ? *a != *b : a != b;
  };
  const bool isOther = valueAt(*to.root, "projection") && differ("projection.type");
  if (isOther) sets.push_back("projection=" + objectAt(*to.root, "projection"));
  for (const Field& field : kFields) {
    if (!differ(field.path) || (isOther && field.types != 0)) continue;
    const Json* const value = valueAt(*to.root, field.path);
    const bool isPlain = value && value->is_string();
    sets.push_back(std::string(field.path) + "=" +
                   (isPlain ? value->get<std::string>()
                    : value ? textOf(field, *value)
                            : "null"));
  }
  return sets;
}

}  // namespace viewproj::cmd
