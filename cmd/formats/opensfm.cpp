// reconstruction.json and camera_models.json of OpenSfM, cameras.json of OpenDroneMap: lengths are fractions of the
// picture's larger side. Source: OpenSfM, "Geometric models" and "Dataset structure".
#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"

namespace viewproj::cmd {
namespace opensfm {

Json cameraOf(const Node& node) {
  const std::string type = node.require("projection_type").text();
  const double w = numberOf(node.require("width")), h = numberOf(node.require("height")), side = std::max(w, h);
  const auto number = [&](std::string_view name, double otherwise) {
    const auto member = node.find(name);
    return member ? numberOf(*member) : otherwise;
  };
  const bool isFisheye = type == "fisheye" || type == "fisheye_opencv";
  const bool isBrown = type == "perspective" || type == "brown" || type == "radial" || type == "simple_radial";
  if (!isFisheye && !isBrown) node.require("projection_type").fail("is a lens that is not supported");
  const double focal = number("focal", 0), fx = number("focal_x", focal), fy = number("focal_y", fx);
  if (!(fx > 0)) node.fail("needs focal, or focal_x and focal_y");
  const double intrinsics[] = {fx * side, fy * side, number("c_x", 0) * side + (w - 1) / 2,
                               number("c_y", 0) * side + (h - 1) / 2};
  Json camera = pinholeCamera(intrinsics, std::array{w, h});
  const double k1 = number("k1", 0), k2 = number("k2", 0), k3 = number("k3", 0);
  Json lens = isFisheye ? lensOf(node, "fisheye", std::vector{k1, k2, k3, number("k4", 0)})
                        : lensOf(node, "brown", std::vector{k1, k2, number("p1", 0), number("p2", 0), k3});
  if (!lens.is_null()) camera["distortion"] = std::move(lens);
  return camera;
}

Import open(const Node& root) {
  std::vector<Node> reconstructions;
  if (root.json().is_array())
    for (std::size_t i = 0; i < root.size(); ++i) reconstructions.push_back(root[i]);
  else
    reconstructions.push_back(root);
  struct Place {
    std::size_t reconstruction;
    std::string shot;
  };
  std::vector<Place> places;
  Import result;
  for (std::size_t i = 0; i < reconstructions.size(); ++i) {
    const auto shots = reconstructions[i].find("shots");
    if (!shots || !shots->json().is_object()) continue;
    for (const auto& item : shots->json().items()) {
      result.cameras.push_back({reconstructions.size() > 1 ? std::to_string(i) + "/" + item.key() : item.key(), ""});
      places.push_back({i, item.key()});
    }
  }
  result.document = [reconstructions, places](std::size_t which) {
    const Node& reconstruction = reconstructions[places[which].reconstruction];
    const Node shot = reconstruction.require("shots").require(places[which].shot);
    Json camera = cameraOf(reconstruction.require("cameras").require(shot.require("camera").text()));
    setPose(camera, "cameraFromWorld",
            {{"rotationVector", numbersOf(shot.require("rotation"), 3)},
             {"translation", numbersOf(shot.require("translation"), 3)}});
    return camera;
  };
  return result;
}  // namespace opensfm

Import openLenses(const Node& root) {
  Import result;
  for (const auto& item : root.json().items()) result.cameras.push_back({item.key(), ""});
  result.document = [root, cameras = result.cameras](std::size_t which) {
    return cameraOf(root.require(cameras[which].name));
  };
  result.own = [root, cameras = result.cameras](std::size_t which) {
    return std::optional(root.require(cameras[which].name));
  };
  return result;
}

}  // namespace opensfm

extern const Format kOpenSfm{"opensfm", "a reconstruction of OpenSfM or OpenDroneMap",
                             "*.shots:object|shots:object *.cameras:object|cameras:object", opensfm::open, "*"};
extern const Format kOpenSfmLenses{"opensfm", "", "*.projection_type:text !shots !*.shots", opensfm::openLenses};

}  // namespace viewproj::cmd
