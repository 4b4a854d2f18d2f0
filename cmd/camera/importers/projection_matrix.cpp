// A 3x4 matrix P = K [R | t], by itself or as KITTI's calibration files have several.
// Sources: Hartley and Zisserman, Multiple View Geometry, 6.2; Geiger and others, Vision meets Robotics.
#include <algorithm>
#include <array>
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
constexpr std::array<std::string_view, 8> kKittiNames{"P0",        "P1",        "P2",        "P3",
                                                      "P_rect_00", "P_rect_01", "P_rect_02", "P_rect_03"};

bool isSingle(const Json& root) { return holds(root, kSingle, 12); }

Import openSingle(const Node& root) {
  return {
      std::vector<CameraEntry>(1), [root](std::size_t) {
        const Node p = *oneOf(root, kSingle);
        return cameraOfMatrix(p, matrixOf(p, 3, 4), sizeOf(root, {"width", "image_width"}, {"height", "image_height"}));
      }};
}

/// Numbers between blanks, as a line of KITTI's is read as YAML; none where it is something else.
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

bool isMatrixOf(const Json& root, std::string_view name) {
  const auto value = root.find(name);
  return value != root.end() && numbersOf(*value).size() == 12;
}

bool isKitti(const Json& root) {
  return std::any_of(kKittiNames.begin(), kKittiNames.end(),
                     [&](std::string_view name) { return isMatrixOf(root, name); });
}

Import openKitti(const Node& root) {
  std::vector<CameraEntry> cameras;
  for (const std::string_view name : kKittiNames)
    if (isMatrixOf(root.json(), name)) cameras.push_back({std::string(name), ""});
  return {cameras, [root, cameras](std::size_t which) {
            const std::string& name = cameras[which].name;
            const auto pictures = root.find("S" + name.substr(1));  // S_rect_02 of P_rect_02
            const std::vector<double> size = pictures ? numbersOf(pictures->json()) : std::vector<double>{};
            const Node p = root.require(name);
            return cameraOfMatrix(p, numbersOf(p.json()),
                                  size.size() == 2 ? std::optional(Size{size[0], size[1]}) : std::nullopt);
          }};
}

}  // namespace

extern const Importer kProjectionMatrix{"matrix34", "a 3x4 matrix K [R | t]", isSingle, openSingle};
extern const Importer kKitti{"kitti", "a calibration file of KITTI", isKitti, openKitti};

}  // namespace viewproj::cmd
