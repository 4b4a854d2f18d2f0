#include "input/geodetic.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kTurns[] = {"heading", "pitch", "roll"};
constexpr std::pair<std::string_view, bool> kWorldIsEcef[] = {{"ecef", true}};

}  // namespace

bool worldIsEcef(const ObjectReader& camera) {
  return camera.choice("world", kWorldIsEcef).value_or(false) || camera.isObject("position") ||
         camera.isObject("target");
}

std::optional<Geodetic> readPlace(const ObjectReader& camera, const char* key) {
  if (!camera.isObject(key)) return std::nullopt;
  const ObjectReader fields = *camera.object(key);
  fields.allow({"lat", "lon", "height"});
  const Geodetic place{fields.requireNumber("lat"), fields.requireNumber("lon"), fields.requireNumber("height")};
  if (!isPlace(place)) fields.fail("lat", "must be from -90 to 90 degrees");
  return place;
}

std::optional<Vec3> readPosition(const ObjectReader& camera, const char* key) {
  if (const auto place = readPlace(camera, key)) return geodeticToEcef(*place);
  return camera.vec3(key);
}

const char* turnOf(const ObjectReader& camera) {
  for (const char* turn : kTurns)
    if (camera.has(turn)) return turn;
  return nullptr;
}

HeadingPitchRoll readTurn(const ObjectReader& camera) {
  return {camera.numberOr("heading", 0), camera.numberOr("pitch", 0), camera.numberOr("roll", 0)};
}

}  // namespace viewproj::cmd
