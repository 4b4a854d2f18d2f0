#include "commands/ground_height.hpp"

#include <cmath>

#include "camera/sea_level.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {

void GroundHeight::add(CLI::App& app, const std::string& help, std::initializer_list<CLI::Option*> others) {
  const auto isFinite = [](double number) { return std::isfinite(number); };
  CLI::Option* const height =
      addValue(app, "--height", "H", height_, numberThat(isFinite, "a height in metres, or a z"), help);
  CLI::Option* const altitude = addValue(app, "--altitude", "H", altitude_, numberThat(isFinite, "metres"),
                                         "The same above sea level, which --geoid gives");
  exclude(altitude, height);
  for (CLI::Option* const other : others) {
    exclude(height, other);
    exclude(altitude, other);
  }
}

double GroundHeight::of(bool worldIsEcef, const CameraFile* camera) const {
  if (altitude_ && !camera) throw UsageError("--altitude needs one camera, or cameras that -c holds");
  const double height = altitude_ ? heightOfAltitude(*camera, *altitude_) : height_.value();
  if (worldIsEcef && height < kLeastCrossedHeight)
    throw UsageError("--height " + formatNumber(height) + ": the Earth has a surface from " +
                     formatNumber(kLeastCrossedHeight) + " metres on");
  return height;
}

SceneObject GroundHeight::surface(std::string id, bool worldIsEcef, const CameraFile* camera) const {
  const double height = of(worldIsEcef, camera);
  if (worldIsEcef) return {std::move(id), HeightSurface{height}};
  return {std::move(id), PlaneEquation{{0, 0, 1}, -height}};
}

}  // namespace viewproj::cmd
