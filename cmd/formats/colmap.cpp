// Cameras of a COLMAP reconstruction, from readColmap. Source: COLMAP documentation, "Camera Models".
#include "formats/colmap.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"

namespace viewproj::cmd {
namespace colmap {

struct Model {
  std::string_view name;
  std::size_t focalLengths, coefficients;
  std::string_view lens;
};
/// One or two focal lengths and cx, cy come before the coefficients, which are in the order of the lens.
constexpr Model kModels[] = {{"SIMPLE_PINHOLE", 1, 0, ""},
                             {"PINHOLE", 2, 0, ""},
                             {"SIMPLE_RADIAL", 1, 1, "radial"},
                             {"RADIAL", 1, 2, "radial"},
                             {"OPENCV", 2, 4, "opencv"},
                             {"FULL_OPENCV", 2, 8, "opencv"},
                             {"SIMPLE_FISHEYE", 1, 0, "fisheye"},
                             {"FISHEYE", 2, 0, "fisheye"},
                             {"SIMPLE_RADIAL_FISHEYE", 1, 1, "fisheye"},
                             {"RADIAL_FISHEYE", 1, 2, "fisheye"},
                             {"OPENCV_FISHEYE", 2, 4, "fisheye"},
                             {"FOV", 2, 1, "fov"},
                             {"EUCM", 2, 2, "eucm"}};

Json cameraOf(const Node& node) {
  const Node name = node.require("model");
  const Model* const model =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const Model& each) { return each.name == name.text(); });
  if (model == std::end(kModels)) name.fail("this camera model is not supported; undistort the pictures first");
  const Node params = node.require("params");
  std::vector<double> p = params.numbers(model->focalLengths + 2 + model->coefficients);
  if (model->focalLengths == 1) p.insert(p.begin(), p.front());
  Json camera = pinholeCamera(p, std::array{node.require("width").number(), node.require("height").number()}, 0.5);
  p.erase(p.begin(), p.begin() + 4);
  if (model->lens.empty()) return camera;
  if (Json lens = lensOf(params, model->lens, p); !lens.is_null()) camera["distortion"] = std::move(lens);
  return camera;
}

}  // namespace colmap

Import openColmap(const Node& root) {
  const Node cameras = root.require("cameras");
  const auto images = root.find("images");
  std::vector<CameraEntry> list;
  if (!images) {
    for (const auto& item : cameras.json().items()) list.push_back({item.key(), ""});
    return {list, [cameras, list](std::size_t which) { return colmap::cameraOf(cameras.require(list[which].name)); }};
  }
  for (const Json& image : images->json()) list.push_back({image["name"], image["id"]});
  return {std::move(list), [cameras, images](std::size_t which) {
            const Node image = (*images)[which];
            Json camera = colmap::cameraOf(cameras.require(image.require("camera_id").text()));
            const std::vector<double> q = image.require("qvec").numbers(4);  // w first
            setPose(camera, "cameraFromWorld",
                    {{"rotation", {q[1], q[2], q[3], q[0]}}, {"translation", image.require("tvec").json()}});
            return camera;
          }};
}

}  // namespace viewproj::cmd
