#include "input/geodetic.hpp"

#include "input/camera_fields.hpp"

namespace viewproj::cmd {

bool worldIsEcef(const ObjectReader& camera) {
  return camera.choice(field::world, field::kWorlds).value_or(false) || camera.isObject(field::position) ||
         camera.isObject(field::target);
}

std::optional<Geodetic> readPlace(const ObjectReader& camera, std::string_view key) {
  if (!camera.isObject(key)) return std::nullopt;
  const ObjectReader fields = *camera.object(key);
  fields.allow(field::place);
  const Geodetic place{fields.requireNumber(field::lat), fields.requireNumber(field::lon),
                       fields.requireNumber(field::height)};
  if (!isPlace(place)) fields.fail(field::lat, "must be from -90 to 90 degrees");
  return place;
}

std::optional<Vec3> readPosition(const ObjectReader& camera, std::string_view key) {
  if (const auto place = readPlace(camera, key)) return geodeticToEcef(*place);
  return camera.vec3(key);
}

HeadingPitchRoll readTurn(const ObjectReader& camera) {
  return {camera.numberOr(field::heading, 0), camera.numberOr(field::pitch, 0), camera.numberOr(field::roll, 0)};
}

}  // namespace viewproj::cmd
