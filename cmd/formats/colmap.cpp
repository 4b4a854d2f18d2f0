// Cameras of a COLMAP reconstruction, from readColmap. Source: COLMAP documentation, "Camera Models".
#include "formats/colmap.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "camera/rigid.hpp"
#include "formats/format.hpp"
#include "formats/writer.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace colmap {

Json cameraOf(const Node& node) {
  const Node name = node.require("model"), params = node.require("params");
  const auto* const model = std::find_if(std::begin(kColmapModels), std::end(kColmapModels),
                                         [&](const ColmapModel& each) { return each.name == name.text(); });
  if (model == std::end(kColmapModels) || model->lens == "-")
    name.fail("this camera model is not supported; undistort the pictures first");
  std::vector<double> p = params.numbers(model->focalLengths + 2 + model->coefficients);
  if (model->focalLengths == 1) p.insert(p.begin(), p.front());
  Json camera = pinholeCamera(p, std::array{node.require("width").number(), node.require("height").number()}, 0.5);
  p.erase(p.begin(), p.begin() + 4);
  if (!model->lens.empty()) setLens(camera, params, model->lens, p);
  return camera;
}

Json imageOf(const Node& cameras, const Node& image) {
  Json camera = cameraOf(cameras.require(image.require("camera_id").text()));
  const std::vector<double> q = image.require("qvec").numbers(4);  // w first
  setPose(camera, "cameraFromWorld",
          {{"rotation", {q[1], q[2], q[3], q[0]}}, {"translation", image.require("tvec").json()}});
  return camera;
}

/// What puts the eye in its place, whatever rounding did to the quaternion.
Vec3 translationOf(const std::array<double, 4>& q, const Vec3& eye) {
  const auto columns = rotationColumns({q[0], q[1], q[2], q[3]});
  Vec3 t;
  for (std::size_t i = 0; i < 3; ++i)
    t[i] = 0.0 - rounded(columns[0][i] * DoubleDouble(eye.x) + columns[1][i] * DoubleDouble(eye.y) +
                         columns[2][i] * DoubleDouble(eye.z));
  return t;
}

/// MODEL WIDTH HEIGHT PARAMS[] of a line of cameras.txt.
std::string lineOf(const WrittenCamera& camera) {
  const std::optional<Lens>& lens = camera.file.lens;
  const Intrinsics k = camera.intrinsics(0.5);
  std::vector<double> params{k.fx, k.fy, k.cx, k.cy}, c = lens ? coefficientsOf(*lens) : std::vector<double>{};
  std::string_view model = "PINHOLE";
  if (lens && lens->model() == LensModel::brown) {
    model = c.size() > 5 || c[4] != 0 ? "FULL_OPENCV" : "OPENCV";
    c.resize(model == "OPENCV" ? 4 : 8);
  } else if (lens) {
    model = lens->model() == LensModel::fisheye ? "OPENCV_FISHEYE" : lens->model() == LensModel::fov ? "FOV" : "EUCM";
  }
  params.insert(params.end(), c.begin(), c.end());
  std::string line = std::string(model) + " " + formatNumber(camera.width()) + " " + formatNumber(camera.height());
  for (const double param : params) line += " " + formatNumber(param);
  return line;
}

}  // namespace colmap

Import openColmap(const Node& root) {
  const Node cameras = root.require("cameras");
  const auto images = root.find("images");
  Import result;
  for (std::size_t i = 0; images && i < images->size(); ++i) {
    const Node image = (*images)[i];
    result.add(image.require("name").text(), image.require("id").text(),
               [cameras, image] { return colmap::imageOf(cameras, image); });
  }
  if (!images)
    for (const auto& item : cameras.json().items())
      result.add(item.key(), "", [camera = cameras.require(item.key())] { return colmap::cameraOf(camera); });
  return result;
}

std::vector<WrittenFile> writeColmap(std::span<const WrittenCamera> cameras, std::string_view) {
  std::string lenses = "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n";
  std::string images = "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, and a line of its points\n";
  std::map<std::string, std::string> ids;  // equal lenses share one
  std::unordered_set<std::string> names;
  bool areNumbers = true;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const WrittenCamera& camera = cameras[i];
    // COLMAP looks for the picture below its folder by this very text.
    const std::string name = camera.label().starts_with("./") ? camera.label().substr(2) : camera.label();
    if (name.find_first_of(" \t\r\n") != std::string::npos)
      throw InputError(camera.file.name + ": COLMAP ends a name at its first blank, and this one is " + inQuotes(name));
    areNumbers = areNumbers && std::all_of(name.begin(), name.end(), isDigit);
    if (!names.insert(name).second)
      throw InputError(camera.file.name + ": another camera has the name " + inQuotes(name));
    const auto [id, isNew] = ids.emplace(colmap::lineOf(camera), std::to_string(ids.size() + 1));
    if (isNew) lenses += id->second + " " + id->first + "\n";
    const std::array<double, 4> q = quaternionOf(cameraFromWorld(camera.pose, CameraAxes::RDF).columns);
    const Vec3 t = colmap::translationOf(q, camera.pose.eye);
    images += std::to_string(i + 1);
    for (const double number : {q[3], q[0], q[1], q[2], t.x, t.y, t.z}) images += " " + formatNumber(number);
    images += " " + id->second + " " + name + "\n\n";
  }
  return {{"cameras.txt", lenses, areNumbers ? "images are called by numbers; COLMAP looks for pictures by name" : ""},
          {"images.txt", images},
          {"points3D.txt", "# Points: none\n"}};
}

}  // namespace viewproj::cmd
