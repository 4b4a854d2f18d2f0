// Cameras of Open3D: PinholeCameraParameters, trajectories of them, and intrinsics alone. Its matrices are stored by
// columns. Source: Open3D, ConvertToJsonValue of PinholeCameraParameters, PinholeCameraTrajectory and
// PinholeCameraIntrinsic.
#include <nlohmann/json.hpp>

#include "camera/importers/calibration.hpp"

namespace viewproj::cmd {
namespace open3d {

/// A K by rows has cx and cy where a K by columns has zeros.
bool isIntrinsic(const Json& object) {
  if (!holds(object, {"intrinsic_matrix"}, 9) || !object.contains("width") || !object.contains("height")) return false;
  const Json& k = object["intrinsic_matrix"];
  return k.size() == 9 && k[2] == 0 && k[5] == 0;
}

bool isCamera(const Json& object) {
  return holds(object, {"extrinsic"}, 16) && object.contains("intrinsic") && isIntrinsic(object["intrinsic"]);
}

bool isTrajectory(const Json& root) {
  const auto list = root.find("parameters");
  return list != root.end() && list->is_array() && !list->empty() && isCamera(list->front());
}

bool recognises(const Json& root) { return isIntrinsic(root) || isCamera(root) || isTrajectory(root); }

Json intrinsicCamera(const Node& intrinsic) {
  const Node matrix = intrinsic.require("intrinsic_matrix");
  const std::vector<double> m = matrix.numbers(9);
  const double byRows[] = {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
  return pinholeCamera(intrinsicsOf(matrix, byRows), sizeOf(intrinsic, {"width"}, {"height"}));
}

Json document(const Node& node) {
  if (isIntrinsic(node.json())) return intrinsicCamera(node);
  Json camera = intrinsicCamera(node.require("intrinsic"));
  const std::vector<double> m = node.require("extrinsic").numbers(16);
  Mat4 rows;
  for (std::size_t i = 0; i < 16; ++i) rows[i % 4][i / 4] = m[i];
  setPose(camera, "cameraFromWorld", rowsOf(rows));
  return camera;
}

Import open(const Node& root) {
  if (!isTrajectory(root.json())) return {std::vector<CameraEntry>(1), [root](std::size_t) { return document(root); }};
  const Node list = root.require("parameters");
  return {std::vector<CameraEntry>(list.size()), [list](std::size_t which) { return document(list[which]); }};
}

}  // namespace open3d

extern const Importer kOpen3d{"open3d", "cameras of Open3D", open3d::recognises, open3d::open};

}  // namespace viewproj::cmd
