// Kalibr's camchain, and the sensor.yaml of EuRoC: every camera is at the origin. Poses relative to another camera
// (T_cn_cnm1) or to the robot (T_cam_imu, T_BS) are not poses in a world, and are not read.
// Sources: Kalibr, "YAML formats" and "Supported models"; the EuRoC MAV dataset.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/importers/calibration.hpp"

namespace viewproj::cmd {
namespace {

bool isCamera(const Json& object) {
  return holds(object, {"resolution"}, 2) && object.contains("intrinsics") && object["intrinsics"].is_array();
}

bool recognises(const Json& root) {
  return root.is_object() && (isCamera(root) || std::any_of(root.begin(), root.end(), isCamera));
}

Json document(const Node& sensor) {
  const auto camera = sensor.find("camera_model");
  if (camera && camera->text() != "pinhole") camera->fail("this camera model is not supported");
  const std::vector<double> size = sensor.require("resolution").numbers(2);
  Json result = pinholeCamera(sensor.require("intrinsics").numbers(4), Size{size[0], size[1]});
  setDistortion(result, oneOf(sensor, {"distortion_coeffs", "distortion_coefficients"}),
                sensor.find("distortion_model"));
  return result;
}

Import open(const Node& root) {
  if (isCamera(root.json())) return {std::vector<CameraEntry>(1), [root](std::size_t) { return document(root); }};
  std::vector<CameraEntry> cameras;
  for (const auto& [name, sensor] : root.json().items())
    if (isCamera(sensor)) cameras.push_back({name, ""});
  return {cameras, [root, cameras](std::size_t which) { return document(root.require(cameras[which].name)); }};
}

}  // namespace

extern const Importer kKalibr{"kalibr", "a camchain of Kalibr or a sensor.yaml of EuRoC", recognises, open};

}  // namespace viewproj::cmd
