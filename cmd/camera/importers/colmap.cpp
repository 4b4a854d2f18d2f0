// Cameras of a COLMAP reconstruction, from readColmap. Source: COLMAP documentation, "Camera Models".
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/importers/calibration.hpp"

namespace viewproj::cmd {
namespace colmap {

struct Model {
  std::string_view name;
  std::size_t focalLengths, coefficients;
};
/// One or two focal lengths and cx, cy come before the coefficients, which are in OpenCV's order.
constexpr Model kModels[] = {{"SIMPLE_PINHOLE", 1, 0},
                             {"PINHOLE", 2, 0},
                             {"SIMPLE_RADIAL", 1, 1},
                             {"RADIAL", 1, 2},
                             {"OPENCV", 2, 4},
                             {"FULL_OPENCV", 2, 8},
                             {"SIMPLE_FISHEYE", 1, 0},
                             {"FISHEYE", 2, 0},
                             {"SIMPLE_RADIAL_FISHEYE", 1, 1},
                             {"RADIAL_FISHEYE", 1, 2},
                             {"OPENCV_FISHEYE", 2, 4},
                             {"FOV", 2, 1},
                             {"EUCM", 2, 2}};

Json cameraOf(const Node& node) {
  const Node name = node.require("model");
  const Model* const model =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const Model& each) { return each.name == name.text(); });
  if (model == std::end(kModels)) name.fail("this camera model is not supported; undistort the pictures first");
  std::vector<double> p = node.require("params").numbers(model->focalLengths + 2 + model->coefficients);
  if (model->focalLengths == 1) p.insert(p.begin(), p.front());
  Json camera = pinholeCamera(p, sizeOf(node, {"width"}, {"height"}));
  camera["viewport"]["pixelCenter"] = 0.5;
  p.erase(p.begin(), p.begin() + 4);
  if (model->name == "FOV" && p[0] != 0) camera["distortion"] = {{"model", "fov"}, {"omega", p[0]}};
  if (model->name == "EUCM") camera["distortion"] = {{"model", "unified"}, {"alpha", p[0]}, {"beta", p[1]}};
  if (model->name == "FOV" || model->name == "EUCM") return camera;
  const bool isFisheye = model->name.ends_with("FISHEYE");
  if (!isFisheye && std::all_of(p.begin(), p.end(), [](double coefficient) { return coefficient == 0; })) return camera;
  Json& distortion = camera["distortion"] = {{"model", isFisheye ? "fisheye" : "brown"}};
  if (!isFisheye && p.size() >= 4) {
    distortion["p"] = {p[2], p[3]};
    p.erase(p.begin() + 2, p.begin() + 4);
  }
  distortion["k"] = p;
  return camera;
}

Import open(const Node& root) {
  const Node cameras = root.require("cameras");
  const auto images = root.find("images");
  std::vector<CameraEntry> list;
  if (!images) {
    for (const auto& item : cameras.json().items()) list.push_back({item.key(), ""});
    return {list, [cameras, list](std::size_t which) { return cameraOf(cameras.require(list[which].name)); }};
  }
  for (const Json& image : images->json()) list.push_back({image["name"], image["id"]});
  return {std::move(list), [cameras, images](std::size_t which) {
            const Node image = (*images)[which];
            Json camera = cameraOf(cameras.require(image.require("camera_id").text()));
            const std::vector<double> q = image.require("qvec").numbers(4);  // w first
            setPose(camera, "cameraFromWorld",
                    {{"rotation", {q[1], q[2], q[3], q[0]}}, {"translation", image.require("tvec").json()}});
            return camera;
          }};
}

}  // namespace colmap

// Its files are known by their lines (isColmap).
const Importer kColmap{"colmap", "a reconstruction of COLMAP as text", [](const Json&) { return false; }, colmap::open};

}  // namespace viewproj::cmd
