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

}  // namespace viewproj::cmd
