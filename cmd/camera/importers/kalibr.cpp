// Kalibr's camchain, and the sensor.yaml of EuRoC: every camera is at the origin. Poses relative to another camera
// (T_cn_cnm1) or to the robot (T_cam_imu, T_BS) are not poses in a world, and are not read.
// Sources: Kalibr, "YAML formats" and "Supported models"; the EuRoC MAV dataset.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/importers/calibration.hpp"

namespace viewproj::cmd {
namespace kalibr {

/// Numbers of the lens come before fu, fv, pu, pv.
struct Model {
  std::string_view name;
  const char* lens;
  std::vector<const char*> numbers;
};
const Model kModels[] = {{"pinhole", "brown", {}},
                         {"omni", "omni", {"xi"}},
                         {"eucm", "unified", {"alpha", "beta"}},
                         {"ds", "double-sphere", {"xi", "alpha"}}};

bool isCamera(const Json& object) {
  return holds(object, {"resolution"}, 2) && object.contains("intrinsics") && object["intrinsics"].is_array();
}

bool recognises(const Json& root) { return holdsCameras(root, isCamera); }

Json document(const Node& sensor) {
  const auto camera = sensor.find("camera_model");
  const std::string name = camera ? camera->text() : "pinhole";
  const Model* const model =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const Model& each) { return each.name == name; });
  if (model == std::end(kModels)) camera->fail("this camera model is not supported");
  const std::vector<double> size = sensor.require("resolution").numbers(2);
  std::vector<double> numbers = sensor.require("intrinsics").numbers(4 + model->numbers.size());
  Json lens{{"model", model->lens}};
  for (const char* const number : model->numbers) {
    lens[number] = numbers.front();
    numbers.erase(numbers.begin());
  }
  Json result = pinholeCamera(numbers, Size{size[0], size[1]});
  const auto distortion = sensor.find("distortion_model");
  setDistortion(result, oneOf(sensor, {"distortion_coeffs", "distortion_coefficients"}), distortion);
  if (model->numbers.empty()) return result;
  if (result.contains("distortion")) {
    const Json& brown = result["distortion"];
    if (name != "omni" || brown["model"] != "brown") distortion->fail("is not supported with the camera model " + name);
    lens["k"] = brown["k"];
    lens["p"] = brown["p"];
  }
  result["distortion"] = lens;
  return result;
}

Import open(const Node& root) { return openCameras(root, isCamera, document); }

}  // namespace kalibr

extern const Importer kKalibr{"kalibr", "a camchain of Kalibr or a sensor.yaml of EuRoC", kalibr::recognises,
                              kalibr::open};

}  // namespace viewproj::cmd
