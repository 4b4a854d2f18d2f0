// The options that say through which cameras of a set records are seen.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "commands/camera_options.hpp"
#include "stream/filter.hpp"

namespace viewproj::cmd {

/// --camera-by, --camera-in-record, --each-camera and --visible.
class RecordCameraOptions {
 public:
  /// canHide: --visible too.
  void add(CLI::App& app, bool canHide);
  /// --camera-by alone, which returns it; without it each record is seen through all cameras.
  CLI::Option* addNamed(CLI::App& app);
  bool areNamed() const { return by_.has_value(); }
  /// The cameras, and what setup has to know of them. require: throws if a camera does not do. Throws UsageError.
  RecordCameras read(const CameraOptions& options, StreamSetup& setup,
                     std::function<void(const CameraFile&)> require) const;

 private:
  std::optional<std::string> by_;
  bool own_ = false, each_ = false, visible_ = false;
};

}  // namespace viewproj::cmd
