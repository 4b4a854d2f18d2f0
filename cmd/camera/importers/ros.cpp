// A camera_info of ROS, as a file or a message, and the intrinsics of a RealSense. A camera_info has two pictures: raw,
// through the lens (K and D), and rectified (P, a pinhole's).
// Sources: sensor_msgs/CameraInfo; camera_calibration_parsers; librealsense, rs2_intrinsics.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/importers/calibration.hpp"

namespace viewproj::cmd {
namespace {

const Names kK{"camera_matrix", "K", "k"}, kP{"projection_matrix", "P", "p"};

/// Does not check the matrices: if one is broken, the other must not be used instead.
bool isCameraInfo(const Json& root) {
  const auto has = [&](std::string_view name) { return root.contains(name); };
  return root.is_object() && std::any_of(kK.begin(), kK.end(), has) && std::any_of(kP.begin(), kP.end(), has);
}

/// Throws if the pictures are smaller than the calibrated ones, because their pixels differ.
void requireFullPicture(const Node& root, const std::optional<Size>& size) {
  constexpr std::string_view kWhy = "is not supported: calibrate for the picture itself";
  for (const char* key : {"binning_x", "binning_y"})
    if (const auto binning = root.find(key); binning && binning->number() != 1) refuse(root, {key}, kWhy);
  const auto roi = root.find("roi");
  if (!roi) return;
  refuse(*roi, {"x_offset", "y_offset"}, kWhy);
  const auto width = roi->find("width"), height = roi->find("height");
  if (width && !(size && width->number() == size->front())) refuse(*roi, {"width"}, kWhy);
  if (height && !(size && height->number() == size->back())) refuse(*roi, {"height"}, kWhy);
}

Json cameraInfo(const Node& root, bool isRectified) {
  const auto size = sizeOf(root, {"image_width", "width"}, {"image_height", "height"});
  requireFullPicture(root, size);
  if (isRectified) {
    const Node p = *oneOf(root, kP);
    return cameraOfMatrix(p, matrixOf(p, 3, 4), size);
  }
  const Node k = *oneOf(root, kK);
  Json camera = pinholeCamera(intrinsicsOf(k, matrixOf(k, 3, 3)), size);
  setDistortion(camera, oneOf(root, {"distortion_coefficients", "D", "d"}), root.find("distortion_model"));
  return camera;
}

Import openCameraInfo(const Node& root) {
  return {{{"raw", ""}, {"rectified", ""}}, [root](std::size_t which) { return cameraInfo(root, which == 1); }};
}

bool hasPrincipalPoint(const Json& object) {
  return object.is_object() && object.contains("fx") && object.contains("fy") && object.contains("ppx") &&
         object.contains("ppy");
}

bool isRealSense(const Json& root) { return holdsCameras(root, hasPrincipalPoint); }

Json realSenseCamera(const Node& stream) {
  const double intrinsics[] = {stream.require("fx").number(), stream.require("fy").number(),
                               stream.require("ppx").number(), stream.require("ppy").number()};
  Json camera = pinholeCamera(intrinsics, sizeOf(stream, {"width"}, {"height"}));
  setDistortion(camera, stream.find("coeffs"), stream.find("model"));
  return camera;
}

Import openRealSense(const Node& root) { return openCameras(root, hasPrincipalPoint, realSenseCamera); }

}  // namespace

extern const Importer kRos{"ros", "a camera_info of ROS", isCameraInfo, openCameraInfo};
extern const Importer kRealSense{"realsense", "intrinsics of a RealSense", isRealSense, openRealSense};

}  // namespace viewproj::cmd
