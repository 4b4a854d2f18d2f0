#include "camera/write_camera.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/change_camera.hpp"
#include "camera/patch.hpp"
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

bool differ(const Json* a, const Json* b) { return a && b ? *a != *b : a != b; }

/// As --set reads it: "60", "60deg", "1,2,3", or JSON.
std::string shortTextOf(const Field& field, const Json& value) {
  if (value.is_string()) return value;
  const bool isList = value.is_array() && value.size() > 1 &&
                      std::all_of(value.begin(), value.end(), [](const Json& part) { return part.is_number(); });
  if (!isList) return textOf(field, value);
  std::string text;
  for (const Json& part : value) text += (text.empty() ? "" : ",") + textOf(part);
  return text;
}

/// What makes the second value of the first: of objects with the same members, what makes each of those.
void addSets(const std::string& path, const Field& field, const Json* from, const Json* to,
             std::vector<std::string>& sets) {
  if (!differ(from, to)) return;
  const auto isLike = [&](const auto& member) { return to->contains(member.key()); };
  if (from && to && from->is_object() && to->is_object() && from->size() == to->size() &&
      std::all_of(from->items().begin(), from->items().end(), isLike))
    for (const auto& [name, value] : from->items()) addSets(joinedPath(path, name), field, &value, &(*to)[name], sets);
  else
    sets.push_back(path + "=" + (to ? shortTextOf(field, *to) : "null"));
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
  const Json* const type = valueAt(*to.root, "projection.type");
  const bool isOther = type && differ(valueAt(*from.root, "projection.type"), type);
  if (isOther) sets.push_back("projection=" + objectAt(*to.root, "projection"));
  for (const Field& field : kFields) {
    if (isOther && field.types != 0) continue;
    std::string path(field.path);
    for (std::size_t dot = path.find('.'); dot < path.size(); dot = path.find('.', dot + 1))
      if (const std::string object = path.substr(0, dot); !valueAt(*to.root, object)) path = object;  // all of it goes
    if (sets.empty() || sets.back() != path + "=null")
      addSets(path, field, valueAt(*from.root, path), valueAt(*to.root, path), sets);
  }
  // What another field removes needs no null.
  for (std::size_t i = sets.size(); i-- > 0;) {
    std::vector<Patch> others;
    for (std::size_t j = 0; j < sets.size(); ++j)
      if (j != i) others.push_back(setPatch(sets[j]));
    Document without{from.name, std::make_shared<Json>(*from.root)};
    if (!sets[i].ends_with("=null")) continue;
    applyPatches(without, others);
    if (*without.root == *to.root) sets.erase(sets.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return sets;
}

}  // namespace viewproj::cmd
