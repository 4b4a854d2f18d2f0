// reconstruction.json and camera_models.json of OpenSfM, cameras.json of OpenDroneMap: lengths are fractions of the
// picture's larger side. Source: OpenSfM, "Geometric models" and "Dataset structure".
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/plain_camera.hpp"
#include "formats/format.hpp"
#include "formats/words.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace opensfm {

Json cameraOf(const Node& node) {
  const Node type = node.require("projection_type");
  const double w = numberOf(node.require("width")), h = numberOf(node.require("height")), side = std::max(w, h);
  const auto number = [&](std::string_view name) { return numberAt(node, name); };
  const bool isFisheye = isAmong(type.text(), "fisheye fisheye_opencv");
  if (!isFisheye && !isAmong(type.text(), "perspective brown radial simple_radial"))
    type.fail("is a lens that is not supported");
  const double fx = numberAt(node, "focal_x", number("focal")), fy = numberAt(node, "focal_y", fx);
  if (!(fx > 0)) node.fail("needs focal, or focal_x and focal_y");
  Json camera = pinholeCamera(
      std::array{fx * side, fy * side, number("c_x") * side + (w - 1) / 2, number("c_y") * side + (h - 1) / 2},
      std::array{w, h});
  const double k1 = number("k1"), k2 = number("k2"), k3 = number("k3");
  if (isFisheye)
    setLens(camera, node, "fisheye", {k1, k2, k3, number("k4")});
  else
    setLens(camera, node, "brown", {k1, k2, number("p1"), number("p2"), k3});
  return camera;
}

Json shotOf(const Node& reconstruction, const Node& shot) {
  Json camera = cameraOf(reconstruction.require("cameras").require(shot.require("camera").text()));
  setPose(camera, "cameraFromWorld",
          {{"rotationVector", numbersOf(shot.require("rotation"), 3)},
           {"translation", numbersOf(shot.require("translation"), 3)}});
  return camera;
}

/// From metres east, north and up of a place to a world of ECEF.
void moveToEarth(Json& camera, const Node& place) {
  const Geodetic from{numberOf(place.require("latitude")), numberOf(place.require("longitude")),
                      numberOf(place.require("altitude"))};
  if (!isPlace(from)) place.fail("expected a latitude from -90 to 90, a longitude and an altitude");
  const auto [east, north, up] = localAxes(from);
  const Vec3 origin = geodeticToEcef(from);
  Json rows = Json::array();
  for (const Vec3& axis : {east, north, up}) rows.push_back({axis.x, axis.y, axis.z, -dot(axis, origin)});
  camera["world"] = "ecef";
  camera["cameraFromWorld"] = {camera["cameraFromWorld"], rows};
}

Import open(const Node& root) {
  Import result;
  const std::size_t count = root.json().is_array() ? root.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Node reconstruction = root.json().is_array() ? root[i] : root;
    const auto shots = reconstruction.find("shots"), place = reconstruction.find("reference_lla");
    if (!shots || !shots->json().is_object()) continue;
    for (const char* world : {"", "earth/"})
      for (const auto& item : shots->json().items()) {
        const auto shot = [reconstruction, place, name = item.key(), isOnEarth = *world != 0] {
          Json camera = shotOf(reconstruction, reconstruction.require("shots").require(name));
          if (isOnEarth) moveToEarth(camera, *place);
          return camera;
        };
        if (*world == 0 || place) result.add(world + (count > 1 ? std::to_string(i) + "/" : "") + item.key(), "", shot);
      }
    if (!result.unread && reconstruction.find("reference_lla"))
      result.unread = [](std::size_t) {
        return "reference_lla, from where x, y and z are metres east, north and up (--set world=enu says so)";
      };
  }
  return result;
}

Import openLenses(const Node& root) {
  Import result;
  for (const auto& item : root.json().items()) {
    const Node camera(root.document(), item.value(), item.key());
    result.add(
        item.key(), "", [camera] { return cameraOf(camera); }, camera);
  }
  return result;
}

}  // namespace opensfm

extern const Format kOpenSfm{"opensfm", "a reconstruction of OpenSfM or OpenDroneMap",
                             "*.shots:object|shots:object *.cameras:object|cameras:object", opensfm::open, "*"};
extern const Format kOpenSfmLenses{"opensfm", "", "*.projection_type:text !shots !*.shots", opensfm::openLenses};

}  // namespace viewproj::cmd
