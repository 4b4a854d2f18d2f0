// KITTI's calibration files: rectified cameras P0 to P3 in the world of the first, also seen from the lidar and the
// IMU; raw cameras K_00 to K_03. Source: Geiger and others, Vision meets Robotics; the readme of its development kit.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/rigid.hpp"
#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "formats/writer.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace kitti {

using Size = std::optional<std::array<double, 2>>;

std::optional<Node> firstOf(const Node& root, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const auto node = root.find(name)) return node;
  return std::nullopt;
}

/// Matrices of zeros stand for cameras that are absent.
bool isThere(const Node& root, const std::string& name, std::size_t count) {
  const auto node = root.find(name);
  const auto numbers = node ? numbersIn(node->json()) : std::nullopt;
  if (!numbers || numbers->size() != count) return false;
  node->mark();
  return std::any_of(numbers->begin(), numbers->end(), [](double n) { return n != 0; });
}

/// S_rect_02 of P_rect_02, S_02 of K_02.
Size sizeOf(const Node& root, const std::string& name) {
  const auto size = name.find('_') == std::string::npos ? std::nullopt : root.find("S" + name.substr(1));
  if (!size) return std::nullopt;
  const std::vector<double> numbers = numbersOf(*size, 2);
  return std::array{numbers[0], numbers[1]};
}

Json rawCamera(const Node& root, const std::string& name) {
  const Node k = root.require(name);
  Json camera = pinholeCamera(intrinsicsOf(k, numbersOf(k, 9)), sizeOf(root, name));
  if (const auto d = root.find("D" + name.substr(1)))
    if (Json lens = lensOf(*d, "plumb_bob", numbersOf(*d)); !lens.is_null()) camera["distortion"] = std::move(lens);
  const auto r = root.find("R" + name.substr(1)), t = root.find("T" + name.substr(1));
  if (r && t)
    setPose(camera, "cameraFromWorld", {{"rotation", rowsOf(numbersOf(*r, 9), 3)}, {"translation", numbersOf(*t, 3)}});
  else if (r || t)
    (r ? *r : *t).fail("needs R and T of the camera");
  return camera;
}

/// P's camera in the lidar's world or the IMU's: K of P, and [I | K^-1 p4] [R0 0; 0 1] [Tr; 0 0 0 1]. Its rotation is
/// not made orthogonal on the way.
Json cameraSeenFrom(const Node& root, const std::string& name, bool isImu) {
  const Node p = root.require(name);
  const std::vector<double> m = numbersOf(p);
  const std::array<double, 4> k = intrinsicsOf(p, std::vector{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]});
  Json camera = pinholeCamera(k, sizeOf(root, name));
  const DoubleDouble z = m[11];
  Rigid pose;
  pose.origin = {(DoubleDouble(m[3]) - DoubleDouble(k[2]) * z) / DoubleDouble(k[0]),
                 (DoubleDouble(m[7]) - DoubleDouble(k[3]) * z) / DoubleDouble(k[1]), z};
  if (const auto r = firstOf(root, {"R0_rect", "R_rect"})) pose = pose * rigidOf(numbersOf(*r, 9), {});
  pose = pose * rigidOf(numbersOf(*firstOf(root, {"Tr_velo_to_cam", "Tr_velo_cam", "Tr"}), 12));
  if (isImu) pose = pose * rigidOf(numbersOf(*firstOf(root, {"Tr_imu_to_velo", "Tr_imu_velo"}), 12));
  setPose(camera, "cameraFromWorld", rowsOf(pose));
  return camera;
}

Import open(const Node& root) {
  std::vector<std::string> names;
  std::size_t rectified = 0;
  for (const char* form : {"P", "P_rect_0", "K_0"})
    for (const char digit : {'0', '1', '2', '3'})
      if (const std::string name = std::string(form) + digit; isThere(root, name, form[0] == 'P' ? 12 : 9)) {
        names.push_back(name);
        if (form == std::string_view("P")) rectified = names.size();
      }
  const bool hasLidar =
      isThere(root, "Tr_velo_to_cam", 12) || isThere(root, "Tr_velo_cam", 12) || isThere(root, "Tr", 12);
  const bool hasImu = hasLidar && (isThere(root, "Tr_imu_to_velo", 12) || isThere(root, "Tr_imu_velo", 12));
  for (const char* rotation : {"R0_rect", "R_rect"}) (void)isThere(root, rotation, 9);
  Import result;
  for (const std::string& name : names) result.cameras.push_back({name, ""});
  for (const auto& [world, isIn] : {std::pair{"velodyne/", hasLidar}, std::pair{"imu/", hasImu}})
    for (std::size_t i = 0; isIn && i < rectified; ++i) result.cameras.push_back({world + names[i], ""});
  result.document = [root, cameras = result.cameras](std::size_t which) {
    const std::string& name = cameras[which].name;
    if (const std::size_t slash = name.find('/'); slash != std::string::npos)
      return cameraSeenFrom(root, name.substr(slash + 1), name.starts_with("imu"));
    if (name.front() == 'K') return rawCamera(root, name);
    const Node p = root.require(name);
    return cameraOfMatrix(p, numbersOf(p, 12), sizeOf(root, name));
  };
  return result;
}  // namespace kitti

}  // namespace kitti

extern const Format kKitti{"kitti", "a calibration file of KITTI",
                           "P0:12|P1:12|P2:12|P3:12|P_rect_00:12|P_rect_01:12|P_rect_02:12|P_rect_03:12|K_00:9|K_01:9|"
                           "K_02:9|K_03:9 !R1 !names",
                           kitti::open, "calib_time corner_dist S_* R_rect_* P_rect_* K_* D_* R_* T_*"};

std::vector<WrittenFile> writeKitti(std::span<const WrittenCamera> cameras, std::string_view) {
  std::string text;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Intrinsics k = cameras[i].intrinsics(0);
    const auto m = cameraFromWorld(cameras[i]);
    text += "P" + std::to_string(i) + ":";
    for (const auto& [f, c, row] : {std::tuple(k.fx, k.cx, std::size_t{0}), {k.fy, k.cy, 4}, {0.0, 1.0, 8}})
      for (std::size_t j = 0; j < 4; ++j)
        text += " " + formatNumber(rounded(twoProd(f, m[row + j]) + twoProd(c, m[8 + j])));
    text += "\n";
  }
  return {{"", text}};
}

}  // namespace viewproj::cmd
