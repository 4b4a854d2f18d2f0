#include "commands/record_camera_options.hpp"

#include "output/output_file.hpp"

namespace viewproj::cmd {

CLI::Option* RecordCameraOptions::addNamed(CLI::App& app) {
  each_ = true;
  return addValue(app, "--camera-by", "FIELD", by_, readText, "The field that names a record's camera of -c");
}

void RecordCameraOptions::add(CLI::App& app, bool canHide) {
  const OptionGroup group(app, kStreamGroup);
  CLI::Option* const by = addNamed(app);
  each_ = false;
  CLI::Option* const own = addFlag(app, "--camera-in-record", own_, "Lay each record's fields over the camera");
  CLI::Option* const each = addFlag(app, "--each-camera", each_, "Each record through every camera of -c");
  exclude(by, own);
  exclude(by, each);
  exclude(own, each);
  if (canHide) addFlag(app, "--visible", visible_, "Write only what is visible");
}

RecordCameras RecordCameraOptions::read(const CameraOptions& options, StreamSetup& setup,
                                        std::function<void(const CameraFile&)> require) const {
  setup.visibleOnly = visible_;
  if (!by_ && !own_ && !each_) {
    const CameraFile file = options.read();
    require(file);
    return RecordCameras(file);
  }
  setup.namesCameras = each_;
  RecordCameras::Setup how{.choice = by_    ? CameraChoice::named
                                     : own_ ? CameraChoice::own
                                            : CameraChoice::each,
                           .field = by_.value_or(""),
                           .reading = options.reading(),
                           .require = std::move(require)};
  auto [cameras, pick] = options.readAll(own_);
  how.picked = own_ ? std::vector{cameras->choose(pick)} : cameras->chooseAll(pick);
  how.cameras = std::move(cameras);
  RecordCameras all(std::move(how));
  for (const std::string& each : all.notes()) note(each);
  return all;
}

}  // namespace viewproj::cmd
