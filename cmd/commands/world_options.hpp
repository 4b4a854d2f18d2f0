// The options of the world that a camera is written for.
#pragma once

#include <optional>
#include <string_view>

#include "camera/change_camera.hpp"
#include "commands/cli.hpp"

namespace viewproj::cmd {

/// --map and --scale: the same picture of another world.
class WorldOptions {
 public:
  void add(CLI::App& app);
  CameraFile mapped(const CameraFile& file) const;
  /// Without --map, notes a world of the other handedness or up than the preset's. form: what is written in it.
  void noteWorld(const CameraFile& file, const ConventionPreset& preset, std::string_view form) const;

 private:
  std::optional<AxisMap> map_;
  std::optional<double> scale_;
};

/// --angles ORDER.
void addAngles(CLI::App& app, const NameRow<EulerOrder>*& order, const std::string& help);
/// The pose as angles of this order, as the field euler has them; null members without a pose. Throws UsageError where
/// the order is of other axes or another world.
OrderedJson anglesOf(const NameRow<EulerOrder>& order, const FieldValues& values, const ConventionPreset& preset,
                     const std::optional<Pose>& pose);

}  // namespace viewproj::cmd
