// Kalibr's camchain, and the sensor.yaml of EuRoC: every camera is at the origin. Poses relative to another camera
// (T_cn_cnm1) or to the robot (T_cam_imu, T_BS) are not poses in a world, and are not read.
// Sources: Kalibr, "YAML formats" and "Supported models"; the EuRoC MAV dataset.
#include <nlohmann/json.hpp>

#include "camera/importers/calibration.hpp"

namespace viewproj::cmd {
namespace kalibr {

bool isCamera(const Json& object) {
  return holds(object, {"resolution"}, 2) && object.contains("intrinsics") && object["intrinsics"].is_array();
}

bool recognises(const Json& root) { return holdsCameras(root, isCamera); }

Json document(const Node& sensor) {
  const auto camera = sensor.find("camera_model");
  if (camera && camera->text() != "pinhole") camera->fail("this camera model is not supported");
  const std::vector<double> size = sensor.require("resolution").numbers(2);
  Json result = pinholeCamera(sensor.require("intrinsics").numbers(4), Size{size[0], size[1]});
  setDistortion(result, oneOf(sensor, {"distortion_coeffs", "distortion_coefficients"}),
                sensor.find("distortion_model"));
  return result;
}

Import open(const Node& root) { return openCameras(root, isCamera, document); }

}  // namespace kalibr

extern const Importer kKalibr{"kalibr", "a camchain of Kalibr or a sensor.yaml of EuRoC", kalibr::recognises,
                              kalibr::open};

}  // namespace viewproj::cmd
