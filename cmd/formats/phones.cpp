// Frames of the 3D Scanner App: ARKit's numbers, whose pixels count centres. The picture's size is in the projection.
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"

namespace viewproj::cmd {
namespace scanner {

/// 2 f / m, if it is a whole number but for float's rounding.
double sideOf(const Node& projection, double focal, double entry) {
  const double side = 2 * focal / entry;
  if (!(std::fabs(side - std::round(side)) < 1e-3 * side) || !(side >= 1))
    projection.fail("does not fit the intrinsics");
  return std::round(side);
}

Json document(const Node& root) {
  const Node k = root.require("intrinsics"), pose = root.require("cameraPoseARFrame"),
             projection = root.require("projectionMatrix");
  const std::array<double, 4> intrinsics = intrinsicsOf(k, numbersOf(k, 9));
  const std::vector<double> p = numbersOf(projection, 16);
  std::vector<double> m = numbersOf(pose, 16);
  for (double& entry : m) entry /= m[15] == 0 ? 1 : m[15];
  Json camera = pinholeCamera(
      intrinsics, std::array{sideOf(projection, intrinsics[0], p[0]), sideOf(projection, intrinsics[1], p[5])});
  setPose(camera, "worldFromCamera", rowsOf(m, 4));
  camera["cameraAxes"] = "RUB";
  return camera;
}

Import open(const Node& root) {
  return {std::vector<CameraEntry>(1), [root](std::size_t) { return document(root); }};
}

}  // namespace scanner

extern const Format kScanner{"scanner-app", "a frame of the 3D Scanner App",
                             "cameraPoseARFrame intrinsics:9 projectionMatrix:16", scanner::open, "*"};

}  // namespace viewproj::cmd
