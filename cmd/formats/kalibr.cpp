// Kalibr's camchain. Its cameras stand in the world of cam0, by the links between neighbours, and in that of the IMU.
// Sources: Kalibr, "YAML formats" and "Supported models"; OpenVINS for T_imu_cam.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/rigid.hpp"
#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "formats/writer.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace kalibr {

/// The camera models, with how many numbers stand before fu, fv, pu, pv.
constexpr std::pair<std::string_view, std::size_t> kModels[] = {{"pinhole", 0}, {"omni", 1}, {"eucm", 2}, {"ds", 2}};

Json lensOfCamera(const Node& camera) {
  const Node numbers = camera.require("intrinsics"), size = camera.require("resolution");
  const auto model = camera.find("camera_model"), bent = camera.find("distortion_model"),
             list = camera.find("distortion_coeffs");
  const std::string name = model ? model->text() : "pinhole", distortion = bent ? bent->text() : "";
  const auto* const row =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const auto& each) { return each.first == name; });
  if (row == std::end(kModels)) model->fail("this camera model is not supported");
  const std::size_t own = row->second;
  const std::vector<double> all = numbersOf(numbers), c = list ? numbersOf(*list) : std::vector<double>{};
  if (all.size() != own + 4)
    numbers.fail("expected " + std::to_string(own + 4) + " numbers of the model " + name + ", got " +
                 std::to_string(all.size()));
  refuse(camera, "line_delay", "is of a rolling shutter, which is not supported");
  const std::vector<double> sides = numbersOf(size, 2);
  Json document = pinholeCamera(std::span(all).subspan(own), std::array{sides[0], sides[1]});
  if (own == 0) {
    if (list)
      setLens(document, *list, distortion, c);
    else if (bent && !mayBePinhole(distortion))
      bent->fail("needs the coefficients of this lens");
    return document;
  }
  std::vector<double> whole(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(own));
  if (!areZero(c)) {
    if (!bent) camera.fail("has distortion_coeffs; needs distortion_model, which says what they are");
    if (name != "omni" || distortion != "radtan") bent->fail("is not supported beside the model " + name);
    whole.insert(whole.end(), c.begin(), c.end());
  }
  setLens(document, numbers, name, whole);
  return document;
}

Json poseAt(const Node& matrix) {
  const std::vector<double> m = numbersOf(matrix);
  if (m.size() != 12 && m.size() != 16) matrix.fail("expected 4 rows of 4 numbers");
  return rowsOf(m, 4);
}

/// The links to cam0 of the camera of a number, its own first.
Json linksOf(const std::vector<Node>& cameras, std::size_t number) {
  Json links = Json::array();
  for (std::size_t i = number; i > 0; --i) {
    const auto link = cameras[i].find("T_cn_cnm1");
    if (!link) cameras[i].fail("needs T_cn_cnm1, the link to the camera before it");
    links.push_back(poseAt(*link));
  }
  return links.size() == 1 ? links.front() : links;
}

Import open(const Node& root) {
  const auto cameras = std::make_shared<std::vector<Node>>();
  bool isLinked = true, isOnImu = false;
  const Part all = parseParts("K=cam*.intrinsics", "kalibr").front();
  for (const std::string& name : starsOf(root, all.starredPaths())) {
    const Node camera = root.require("cam" + name);
    isLinked = isLinked && (cameras->empty() || camera.find("T_cn_cnm1"));
    isOnImu = isOnImu || camera.findAny({"T_cam_imu", "T_imu_cam"});
    for (const char* pose : {"T_cn_cnm1", "T_cam_imu", "T_imu_cam"})
      if (const auto matrix = camera.find(pose)) matrix->mark();
    cameras->push_back(camera);
  }
  Import result;
  for (const bool isOfImu : {false, true})
    for (std::size_t i = 0; i < cameras->size() && (isOfImu ? isOnImu : isLinked || !isOnImu); ++i) {
      const Node& node = (*cameras)[i];
      const auto document = [cameras, node, i, isOfImu] {
        Json camera = lensOfCamera(node);
        const auto toCamera = node.find("T_cam_imu"), toImu = node.find("T_imu_cam");
        if (isOfImu && !toCamera && !toImu) node.fail("needs T_cam_imu");
        if (isOfImu)
          setPose(camera, toCamera ? "cameraFromWorld" : "worldFromCamera", poseAt(toCamera ? *toCamera : *toImu));
        else if (i > 0)
          setPose(camera, "cameraFromWorld", linksOf(*cameras, i));
        return camera;
      };
      result.add((isOfImu ? "imu/" : "") + node.path(), "", document, node);
    }
  return result;
}

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
