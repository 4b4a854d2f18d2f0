// Kalibr's camchain. Its cameras stand in the world of cam0, by the links between neighbours, and in that of the IMU.
// Sources: Kalibr, "YAML formats" and "Supported models"; OpenVINS for T_imu_cam.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/rigid.hpp"
#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/writer.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace kalibr {

Json lensOfCamera(const Node& camera, std::vector<double>& intrinsics) {
  const Node numbers = camera.require("intrinsics");
  intrinsics = numbersOf(numbers);
  const auto model = camera.find("camera_model"), bent = camera.find("distortion_model"),
             list = camera.find("distortion_coeffs");
  const std::string name = model ? model->text() : "pinhole", distortion = bent ? bent->text() : "";
  const std::vector<double> c = list ? numbersOf(*list) : std::vector<double>{};
  const std::size_t own = name == "pinhole" ? 0 : name == "omni" ? 1 : name == "eucm" || name == "ds" ? 2 : 99;
  if (own == 99) model->fail("this camera model is not supported");
  if (intrinsics.size() != own + 4)
    numbers.fail("expected " + std::to_string(own + 4) + " numbers of the model " + name + ", got " +
                 std::to_string(intrinsics.size()));
  std::vector<double> first(intrinsics.begin(), intrinsics.begin() + static_cast<std::ptrdiff_t>(own));
  intrinsics.erase(intrinsics.begin(), intrinsics.begin() + static_cast<std::ptrdiff_t>(own));
  if (own == 0) {
    if (list) return lensOf(*list, distortion, c);
    if (bent && !mayBePinhole(distortion)) bent->fail("needs the coefficients of this lens");
    return nullptr;
  }
  const bool isBent = std::any_of(c.begin(), c.end(), [](double n) { return n != 0; });
  if (isBent && (name != "omni" || distortion != "radtan")) bent->fail("is not supported beside the model " + name);
  if (isBent) first.insert(first.end(), c.begin(), c.end());
  return lensOf(numbers, name, first);
}

Json cameraOf(const Node& camera) {
  std::vector<double> intrinsics;
  Json lens = lensOfCamera(camera, intrinsics);
  const std::vector<double> size = numbersOf(camera.require("resolution"), 2);
  refuse(camera, {"line_delay"}, "is of a rolling shutter, which is not supported");
  Json document = pinholeCamera(intrinsics, std::array{size[0], size[1]});
  if (!lens.is_null()) document["distortion"] = std::move(lens);
  return document;
}

Rigid rigidAt(const Node& matrix) {
  const std::vector<double> m = numbersOf(matrix);
  if (m.size() != 12 && m.size() != 16) matrix.fail("expected 4 rows of 4 numbers");
  return rigidOf(m);
}

Import open(const Node& root) {
  std::vector<Node> cameras;
  Import result;
  std::vector<std::string> names;
  for (const std::string& name : starsOf(root, "cam*.intrinsics")) {
    cameras.push_back(root.require("cam" + name));
    names.push_back("cam" + name);
  }
  bool isLinked = true, isOnImu = false;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto link = cameras[i].find("T_cn_cnm1");
    if (link) link->mark();
    isLinked = isLinked && (i == 0 || link);
    isOnImu = isOnImu || cameras[i].find("T_cam_imu") || cameras[i].find("T_imu_cam");
  }
  struct Place {
    std::size_t camera;
    bool isSeenFromImu;
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (!isLinked && isOnImu) continue;
    result.cameras.push_back({names[i], ""});
    places.push_back({i, false});
  }
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    for (const char* pose : {"T_cam_imu", "T_imu_cam"})
      if (const auto matrix = cameras[i].find(pose)) matrix->mark();
    if (!isOnImu) continue;
    result.cameras.push_back({"imu/" + names[i], ""});
    places.push_back({i, true});
  }
  result.document = [cameras, places](std::size_t which) {
    const auto [index, isSeenFromImu] = places[which];
    const Node& camera = cameras[index];
    Json document = cameraOf(camera);
    if (isSeenFromImu) {
      const auto toCamera = camera.find("T_cam_imu"), toImu = camera.find("T_imu_cam");
      if (!toCamera && !toImu) camera.fail("needs T_cam_imu");
      setPose(document, toCamera ? "cameraFromWorld" : "worldFromCamera",
              rowsOf(rigidAt(toCamera ? *toCamera : *toImu)));
    } else if (index > 0) {
      Rigid fromFirst;
      for (std::size_t i = 1; i <= index; ++i) {
        const auto link = cameras[i].find("T_cn_cnm1");
        if (!link) cameras[i].fail("needs T_cn_cnm1, the link to the camera before it");
        fromFirst = rigidAt(*link) * fromFirst;
      }
      setPose(document, "cameraFromWorld", rowsOf(fromFirst));
    }
    return document;
  };
  result.own = [cameras, places](std::size_t which) { return std::optional(cameras[places[which].camera]); };
  return result;
}  // namespace viewproj::cmd

}  // namespace kalibr

extern const Format kKalibr{"kalibr", "a camchain of Kalibr",
                            "cam0.intrinsics:4/5/6|cam1.intrinsics:4/5/6 cam0.resolution|cam1.resolution", kalibr::open,
                            "rostopic cam_overlaps timeshift_* T_imu_body rolling*"};

std::vector<WrittenFile> writeKalibr(std::span<const WrittenCamera> cameras, std::string_view) {
  std::string text;
  // The world of the links is cam0's. Where cam0 stands elsewhere, the IMU's world is ours.
  const bool isOnImu = !cameras.front().isAtOrigin();
  const auto matrix = [&](std::string_view name, std::span<const double> rows) {
    text += "  " + std::string(name) + ":\n";
    for (std::size_t i = 0; i < 4; ++i)
      text += "  - " + (i < 3 ? yamlList(rows.subspan(4 * i, 4)) : "[0.0, 0.0, 0.0, 1.0]") + "\n";
  };
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const WrittenCamera& camera = cameras[i];
    const Intrinsics k = camera.intrinsics(0);
    std::vector<double> c = camera.file.lens ? coefficientsOf(*camera.file.lens) : std::vector<double>{}, own;
    const LensModel model = camera.file.lens ? camera.file.lens->model() : LensModel::brown;
    const bool isOmni = model == LensModel::omni,
               isWhole = c.size() > 1 && model != LensModel::fisheye && model != LensModel::brown;
    if (isWhole) own.assign(c.begin(), isOmni ? c.begin() + 1 : c.end());
    c.erase(c.begin(), c.begin() + std::ssize(own));
    if (model == LensModel::brown) c.resize(std::min<std::size_t>(c.size(), 4));
    text += "cam" + std::to_string(i) + ":\n  camera_model: " +
            (isOmni                             ? "omni"
             : model == LensModel::unified      ? "eucm"
             : model == LensModel::doubleSphere ? "ds"
                                                : "pinhole");
    own.insert(own.end(), {k.fx, k.fy, k.cx, k.cy});
    text += "\n  intrinsics: " + yamlList(own) + "\n  distortion_model: " +
            (c.empty()                     ? "none"
             : model == LensModel::fisheye ? "equidistant"
             : model == LensModel::fov     ? "fov"
                                           : "radtan");
    text += "\n  distortion_coeffs: " + yamlList(c) + "\n  resolution: [" + formatNumber(camera.width()) + ", " +
            formatNumber(camera.height()) + "]\n  rostopic: /cam" + std::to_string(i) + "/image_raw\n";
    if (isOnImu) matrix("T_cam_imu", cameraFromWorld(camera));
    if (i == 0) continue;
    std::vector<double> link;
    const Rigid toWorld = rigidOf(worldFromCamera(cameras[i - 1], CameraAxes::RDF));
    const Mat4 toThis = matrixOf(rigidOf(cameraFromWorld(camera)) * toWorld);
    for (std::size_t row = 0; row < 3; ++row) link.insert(link.end(), toThis[row].begin(), toThis[row].end());
    matrix("T_cn_cnm1", link);
  }
  return {{"", text, isOnImu ? "the world is written as the IMU's, by T_cam_imu; FILE#imu/cam0 reads it" : ""}};
}

}  // namespace viewproj::cmd
