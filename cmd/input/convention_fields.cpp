#include "input/convention_fields.hpp"

#include "input/convention_names.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

Convention presetOrFail(const ObjectReader& fields, std::string_view key, const std::string& name) {
  if (const auto preset = conventionPreset(name)) return *preset;
  fields.fail(key, "is not a known convention" + suggestion(name, presetNames()));
}

}  // namespace

Convention readAxes(const ObjectReader& fields, Convention c) {
  c.world = fields.choice("world", kWorldNames).value_or(c.world);
  c.view = fields.choice("view", kViewNames).value_or(c.view);
  c.ndcZ = fields.choice("ndcZ", kNdcZNames).value_or(c.ndcZ);
  c.reverseZ = fields.flag("reverseZ").value_or(c.reverseZ);
  c.ndcY = fields.choice("ndcY", kNdcYNames).value_or(c.ndcY);
  c.vectors = fields.choice("vectors", kVectorsNames).value_or(c.vectors);
  c.storage = fields.choice("storage", kStorageNames).value_or(c.storage);
  return c;
}

std::optional<StatedConvention> readConvention(const ObjectReader& file, const Convention& fallback) {
  if (!file.has("convention")) return std::nullopt;
  if (file.isString("convention")) {
    const std::string name = *file.string("convention");
    return StatedConvention{presetOrFail(file, "convention", name), name};
  }
  const ObjectReader fields = *file.object("convention");
  fields.allow({"preset", "world", "view", "ndcZ", "reverseZ", "ndcY", "vectors", "storage"});
  StatedConvention stated{fallback, ""};
  if (const auto preset = fields.string("preset")) stated = {presetOrFail(fields, "preset", *preset), *preset};
  stated.convention = readAxes(fields, stated.convention);
  return stated;
}

}  // namespace viewproj::cmd
