// --height and --altitude: the ground of a height.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>

#include "camera/read_camera.hpp"
#include "commands/cli.hpp"
#include "records/scene.hpp"

namespace viewproj::cmd {

class GroundHeight {
 public:
  /// Of these two and of the others a command line has one.
  void add(CLI::App& app, const std::string& help, std::initializer_list<CLI::Option*> others = {});
  bool isTyped() const { return height_ || altitude_; }

  /// The Earth's surface, or the plane z = H in another world. camera: where sea level counts; null: none is the only
  /// one. Throws UsageError if nothing is typed, or if there is no such surface.
  SceneObject surface(std::string id, bool worldIsEcef, const CameraFile* camera) const;
  /// H of that surface.
  double of(bool worldIsEcef, const CameraFile* camera) const;

 private:
  std::optional<double> height_, altitude_;
};

}  // namespace viewproj::cmd
