// Calibrations of OpenCV: FileStorage as YAML or JSON, and the JSON that scripts write with the same names.
// Sources: OpenCV, "Camera Calibration and 3D Reconstruction"; samples/cpp/.../camera_calibration.cpp; FileStorage.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/importers/calibration.hpp"

namespace viewproj::cmd {
namespace opencv {

const Names kIntrinsics{"K", "camera_matrix", "cameraMatrix", "mtx", "Camera_Matrix", "cam_matrix", "intrinsic_matrix"};
const Names kDistortion{"distortion_coefficients", "dist_coeffs",       "distCoeffs", "dist", "D", "d", "distortion",
                        "Distortion_Coefficients", "distortion_coeffs", "dist_coeff", "kc"};
const Names kFisheyeFlags{"fisheye_model", "is_fisheye", "fisheye"};

bool isCamera(const Json& root) {
  const bool hasDistortion =
      std::any_of(kDistortion.begin(), kDistortion.end(), [&](std::string_view name) { return root.contains(name); });
  return holds(root, kIntrinsics, 9) || (holds(root, {"matrix"}, 9) && hasDistortion);
}

bool recognises(const Json& root) { return holdsCameras(root, isCamera); }

std::optional<Size> pictureSize(const Node& root) {
  const auto sides = sizeOf(root, {"width", "image_width", "image_Width"}, {"height", "image_height", "image_Height"});
  const auto size = oneOf(root, {"image_size", "img_size", "resolution"});
  if (!size) return sides;
  const Size result{size->numbers(2)[0], size->numbers(2)[1]};
  if (sides && *sides != result) size->fail("differs from the width and height beside it");
  return result;
}

void readPose(const Node& root, Json& camera) {
  refuse(root, {"pose", "c2w", "w2c"}, "a pose of this name is not read: call it T_cam_world or T_world_cam");
  refuse(root, {"rvecs", "extrinsic_parameters"},
         "holds the poses of several pictures: leave it out, or give rvec and tvec of one");
  const auto toCamera = oneOf(root, {"extrinsic", "extrinsics", "extrinsic_matrix", "T_cam_world"});
  const auto toWorld = oneOf(root, {"T_world_cam"});
  const auto rotation = oneOf(root, {"R", "rotation_matrix"}), vector = oneOf(root, {"rvec", "rotation_vector"});
  const auto translation = oneOf(root, {"t", "tvec", "T", "translation_vector"});
  if (toCamera || toWorld) {
    const auto& second = toCamera && toWorld ? toWorld : rotation ? rotation : vector ? vector : translation;
    if (second) second->fail("the camera has another pose; leave one of them out");
    const Node& matrix = toCamera ? *toCamera : *toWorld;
    (void)matrixOf(matrix, matrix.holdsNumbers(12) ? 3 : 4, 4);
    return setPose(camera, toCamera ? "cameraFromWorld" : "worldFromCamera", rowsOf(matrix.mat4()));
  }
  if (rotation && vector) vector->fail("is the same thing as " + rotation->path() + "; leave one of them out");
  if (!rotation && !vector && !translation) return;
  if (!translation) (rotation ? rotation : vector)->fail("needs t or tvec beside it");
  Json pose{{"translation", translation->numbers(3)}};
  if (rotation) {
    const std::vector<double> r = matrixOf(*rotation, 3, 3);
    pose["rotation"] = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
  } else if (vector) {
    pose["rotationVector"] = vector->numbers(3);
  } else {
    translation->fail("needs R or rvec beside it");
  }
  setPose(camera, "cameraFromWorld", std::move(pose));
}

void readDistortion(const Node& root, Json& camera) {
  refuse(root, {"k1"}, "is not read: give distortion_coefficients, in OpenCV's order");
  const auto coefficients = oneOf(root, kDistortion), model = oneOf(root, {"distortion_model", "camera_model"});
  const auto isFisheye = oneOf(root, kFisheyeFlags);
  if (model || !coefficients) return setDistortion(camera, coefficients, model);
  const std::vector<double> c = coefficients->numbers();
  // The flag is true, or 1 in FileStorage.
  const bool fisheye = isFisheye && isFisheye->json() != false && isFisheye->json() != 0;
  if (c.size() == 4 && !isFisheye && !root.find("xi") &&
      std::any_of(c.begin(), c.end(), [](double n) { return n != 0; }))
    coefficients->fail(
        "4 coefficients may be k1, k2, p1, p2, or k1 to k4 of a fisheye; add distortion_model to the file, "
        "\"plumb_bob\" or \"fisheye\"");
  if (Json distortion = distortionOf(*coefficients, fisheye ? "fisheye" : ""); !distortion.is_null())
    camera["distortion"] = std::move(distortion);
}

Json document(const Node& root) {
  const auto matrix = oneOf(root, kIntrinsics);
  const Node k = matrix ? *matrix : root.require("matrix");
  Json camera = pinholeCamera(intrinsicsOf(k, matrixOf(k, 3, 3)), pictureSize(root));
  for (const char* key : {"near", "far"})
    if (const auto value = root.find(key)) camera["projection"][key] = value->json();
  readPose(root, camera);
  readDistortion(root, camera);
  if (const auto xi = root.find("xi")) {
    Json& lens = camera["distortion"];
    if (!lens.is_null() && lens["model"] != "brown") xi->fail("goes with the coefficients k1, k2, p1, p2 of omnidir");
    lens["model"] = "omni";
    lens["xi"] = xi->json().is_number() ? xi->number() : xi->numbers(1)[0];
  }
  return camera;
}

Import open(const Node& root) { return openCameras(root, isCamera, document); }

}  // namespace opencv

extern const Importer kOpenCv{"opencv", "a calibration of OpenCV", opencv::recognises, opencv::open};

}  // namespace viewproj::cmd
