// A 3x4 matrix P = K [R | t], alone or several in a calibration file of KITTI.
// Sources: Hartley and Zisserman, Multiple View Geometry, 6.2; Geiger and others, Vision meets Robotics.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/importers/calibration.hpp"
#include "camera/split_matrix.hpp"
#include "text/number.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

Json cameraOfMatrix(const Node& node, std::span<const double> p, const std::optional<Size>& size) {
  try {
    const SplitMatrix split = splitMatrix(p);
    requireNoSkew(split);
    const double intrinsics[] = {detail::rounded(split.fx), detail::rounded(split.fy), detail::rounded(split.cx),
                                 detail::rounded(split.cy)};
    const Vec3 x = detail::rounded(split.columns[0]), y = detail::rounded(split.columns[1]),
               z = detail::rounded(split.columns[2]), eye = detail::rounded(split.eye);
    Json camera = pinholeCamera(intrinsics, size);
    setPose(
        camera, "worldFromCamera",
        {{"rotation", {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}}, {"translation", {eye.x, eye.y, eye.z}}});
    return camera;
  } catch (const CameraError& e) {
    node.fail(e.message());
  }
}

namespace {

const Names kSingle{"P", "projection_matrix", "P_matrix"};
bool isSingle(const Json& root) { return holds(root, kSingle, 12); }

Import openSingle(const Node& root) {
  return {
      std::vector<CameraEntry>(1), [root](std::size_t) {
        const Node p = *oneOf(root, kSingle);
        return cameraOfMatrix(p, matrixOf(p, 3, 4), sizeOf(root, {"width", "image_width"}, {"height", "image_height"}));
      }};
}

/// The numbers of a text, separated by blanks, as YAML reads a line of KITTI; empty if there is anything else.
std::vector<double> numbersOf(const Json& value) {
  if (!value.is_string()) return {};
  std::vector<double> numbers;
  std::string_view text = value.get_ref<const std::string&>();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (const auto number = parseNumber(text.substr(0, end)))
      numbers.push_back(*number);
    else if (end > 0)
      return {};
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return numbers;
}

bool holdsNumbers(const Json& root, std::string_view name, std::size_t count) {
  const auto value = root.find(name);
  return value != root.end() && numbersOf(*value).size() == count;
}

/// The cameras of a file: P2 or P_rect_02 for rectified pictures, K_02 for raw ones.
std::vector<CameraEntry> kittiCameras(const Json& root) {
  std::vector<CameraEntry> cameras;
  for (const char* name : {"P0", "P1", "P2", "P3", "P_rect_00", "P_rect_01", "P_rect_02", "P_rect_03"})
    if (holdsNumbers(root, name, 12)) cameras.push_back({name, ""});
  for (const char* name : {"K_00", "K_01", "K_02", "K_03"})
    if (holdsNumbers(root, name, 9)) cameras.push_back({name, ""});
  return cameras;
}

bool isKitti(const Json& root) { return root.is_object() && !kittiCameras(root).empty(); }

Json kittiCamera(const Node& root, const std::string& name) {
  const auto pictures = root.find("S" + name.substr(1));  // S_rect_02 for P_rect_02, S_02 for K_02
  const std::vector<double> numbers = pictures ? numbersOf(pictures->json()) : std::vector<double>{};
  const auto size = numbers.size() == 2 ? std::optional(Size{numbers[0], numbers[1]}) : std::nullopt;
  const Node matrix = root.require(name);
  if (name.front() == 'P') return cameraOfMatrix(matrix, numbersOf(matrix.json()), size);
  Json camera = pinholeCamera(intrinsicsOf(matrix, numbersOf(matrix.json())), size);
  if (const auto distortion = root.find("D" + name.substr(1))) {
    const Json coefficients = numbersOf(distortion->json());
    setDistortion(camera, Node(root.document(), coefficients, distortion->path()), std::nullopt);
  }
  return camera;
}

Import openKitti(const Node& root) {
  std::vector<CameraEntry> cameras = kittiCameras(root.json());
  return {cameras, [root, cameras](std::size_t which) { return kittiCamera(root, cameras[which].name); }};
}

}  // namespace

extern const Importer kProjectionMatrix{"matrix34", "a 3x4 matrix K [R | t]", isSingle, openSingle};
extern const Importer kKitti{"kitti", "a calibration file of KITTI", isKitti, openKitti};

}  // namespace viewproj::cmd
