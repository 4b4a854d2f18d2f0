#include "input/convention_fields.hpp"

#include "input/camera_fields.hpp"
#include "text/error.hpp"
#include "text/json_build.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

StatedConvention presetOf(const ObjectReader& object, const Field& field) {
  const std::string name = *object.string(field);
  const ConventionPreset* const preset = findPreset(name);
  if (!preset) object.fail(field, "is not a known convention" + suggestion(name, presetNames()));
  return {preset->convention, preset};
}

}  // namespace

Convention readAxes(const ObjectReader& fields, Convention c) {
  c.world = fields.choice(field::handedness, kWorldNames).value_or(c.world);
  c.view = fields.choice(field::view, kViewNames).value_or(c.view);
  c.ndcZ = fields.choice(field::ndcZ, kNdcZNames).value_or(c.ndcZ);
  c.reverseZ = fields.flag(field::reverseZ).value_or(c.reverseZ);
  c.ndcY = fields.choice(field::ndcY, kNdcYNames).value_or(c.ndcY);
  c.vectors = fields.choice(field::vectors, kVectorsNames).value_or(c.vectors);
  c.storage = fields.choice(field::storage, kStorageNames).value_or(c.storage);
  return c;
}

std::string jsonOf(const Convention& c) {
  JsonObject out;
  out.add(field::handedness, nameOf(kWorldNames, c.world)).add(field::view, nameOf(kViewNames, c.view));
  out.add(field::ndcZ, nameOf(kNdcZNames, c.ndcZ)).add(field::reverseZ, c.reverseZ);
  out.add(field::ndcY, nameOf(kNdcYNames, c.ndcY)).add(field::vectors, nameOf(kVectorsNames, c.vectors));
  return out.add(field::storage, nameOf(kStorageNames, c.storage)).text();
}

std::optional<StatedConvention> readConvention(const ObjectReader& file, const ConventionPreset& fallback) {
  if (!file.has(field::convention)) return std::nullopt;
  if (file.isString(field::convention)) return presetOf(file, field::convention);
  const ObjectReader fields = *file.object(field::convention);
  fields.allow(field::axes);
  StatedConvention stated{fallback.convention, &fallback, false};
  if (fields.has(field::preset)) stated = presetOf(fields, field::preset);
  stated.convention = readAxes(fields, stated.convention);
  return stated;
}

StatedConvention readStated(const ObjectReader& file, const std::string& readAs, const ConventionPreset& fallback) {
  if (!readAs.empty() && file.has(field::convention) && file.document().isSet(std::string(field::convention)))
    throw UsageError("--set " + std::string(field::convention) + " and --read-as " + readAs +
                     " both say how the file is read; --set convention=" + readAs +
                     " with --set convention.AXIS=VALUE changes single axes");
  const ConventionPreset* const named = findPreset(readAs);
  const ConventionPreset& preset = named ? *named : fallback;
  const StatedConvention stated{preset.convention, &preset, !readAs.empty()};
  return readAs.empty() ? readConvention(file, fallback).value_or(stated) : stated;
}

}  // namespace viewproj::cmd
