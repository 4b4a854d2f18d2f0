#include "camera/read_convention.hpp"

#include <nlohmann/json.hpp>

namespace viewproj::cmd {
namespace {

/// Calls take(name, table of words, member) for each axis but reverseZ.
template <class Take>
void forEachAxis(const Take& take) {
  take(FieldId("convention.world"), kWorldNames, &Convention::world);
  take(FieldId("convention.view"), kViewNames, &Convention::view);
  take(FieldId("convention.ndcZ"), kNdcZNames, &Convention::ndcZ);
  take(FieldId("convention.ndcY"), kNdcYNames, &Convention::ndcY);
  take(FieldId("convention.vectors"), kVectorsNames, &Convention::vectors);
  take(FieldId("convention.storage"), kStorageNames, &Convention::storage);
}

/// Adds every axis of the convention, or those that differ from the other one, in the order of the fields.
void addAxes(JsonObject& out, const Convention& c, const Convention* other) {
  const auto addReverseZ = [&] {
    if (!other || c.reverseZ != other->reverseZ) out.add("reverseZ", c.reverseZ);
  };
  forEachAxis([&](FieldId field, const auto& words, auto axis) {
    if (field->path == "convention.ndcY") addReverseZ();
    if (!other || c.*axis != other->*axis)
      out.add(field->path.substr(field->path.find('.') + 1), nameOf(words, c.*axis));
  });
}

}  // namespace

DocumentConvention readConvention(const FieldValues& values) {
  const auto* const type = values.find<std::string_view>("projection.type");
  DocumentConvention result{type && *type == "ps2" ? &conventions::ps2 : &conventions::opengl, {}, false};
  if (const auto* const preset = values.find<std::string_view>("convention.preset"))
    result.preset = findPreset(*preset);
  const Json* const stated = valueAt(*values.document().root, "convention");
  result.isStated = stated && !stated->empty();
  Convention& c = result.convention = result.preset->convention;
  forEachAxis([&](FieldId field, const auto& words, auto axis) {
    if (const auto* const word = values.find<std::string_view>(field)) c.*axis = valueOf(words, *word);
  });
  c.reverseZ = values.valueOr("convention.reverseZ", c.reverseZ);
  return result;
}

DocumentConvention readConvention(const Document& document) {
  Document alone = document;
  alone.root = std::make_shared<Json>(Json::object());
  if (const Json* const convention = valueAt(*document.root, "convention")) (*alone.root)["convention"] = *convention;
  normalize(alone);
  return readConvention(readValues(alone));
}

std::string jsonOf(const Convention& convention) {
  JsonObject out;
  addAxes(out, convention, nullptr);
  return out.text();
}

std::string jsonOf(const ConventionPreset& preset, const Convention& convention) {
  if (preset.convention == convention) return jsonOf(preset.name);
  JsonObject out;
  out.add("preset", preset.name);
  addAxes(out, convention, &preset.convention);
  return out.text();
}

}  // namespace viewproj::cmd
