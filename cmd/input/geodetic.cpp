#include "input/geodetic.hpp"

#include <nlohmann/json.hpp>

#include "input/camera_fields.hpp"
#include "input/value_form.hpp"

namespace viewproj::cmd {
namespace {

bool saysPlace(const ObjectReader& camera, const Field& field) {
  const nlohmann::json* const value = camera.find(field);
  return value && value->is_object() && !hasCoordinates(*value);
}

}  // namespace

bool worldIsEcef(const ObjectReader& camera) {
  return camera.choice(field::world, field::kWorlds).value_or(false) || saysPlace(camera, field::position) ||
         saysPlace(camera, field::target);
}

Geodetic requirePlace(const ObjectReader& fields) {
  fields.allow(field::place);
  const Geodetic place{fields.requireNumber(field::lat), fields.requireNumber(field::lon),
                       fields.requireNumber(field::height)};
  if (!isPlace(place)) fields.fail(field::lat, "must be from -90 to 90 degrees");
  return place;
}

std::optional<Geodetic> readPlace(const ObjectReader& camera, const Field& field) {
  if (!saysPlace(camera, field)) return std::nullopt;
  return requirePlace(*camera.object(field));
}

std::optional<Vec3> readPosition(const ObjectReader& camera, const Field& field) {
  if (const auto place = readPlace(camera, field)) return geodeticToEcef(*place);
  return camera.vec3(field);
}

HeadingPitchRoll readTurn(const ObjectReader& camera) {
  return {camera.numberOr(field::heading, 0), camera.numberOr(field::pitch, 0), camera.numberOr(field::roll, 0)};
}

}  // namespace viewproj::cmd
