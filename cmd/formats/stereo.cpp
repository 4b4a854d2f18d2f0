// OpenCV's stereo calibration: intrinsics.yml and extrinsics.yml, or one file with the names of both. Camera 1 is the
// world; camera 2 is X2 = R X1 + T; the rectified pictures are P1 R1 X and P2 R2 (R X + T).
// Source: OpenCV, samples/cpp/stereo_calib.cpp, stereoRectify.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "camera/rigid.hpp"
#include "formats/format.hpp"
#include "formats/tree.hpp"
#include "formats/value.hpp"
#include "text/system.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace stereo {

/// Both files.
class Files {
 public:
  explicit Files(const Node& root) : root_(root) {
    const std::string& name = root.document().name;
    for (const auto& [one, other] : {std::pair{"intrinsics", "extrinsics"}, std::pair{"extrinsics", "intrinsics"}}) {
      const std::size_t at = name.rfind(one);
      std::error_code ignored;
      if (at == std::string::npos) continue;
      const std::string beside = name.substr(0, at) + other + name.substr(at + std::string_view(one).size());
      if (std::filesystem::is_regular_file(pathOf(beside), ignored))
        other_ = std::make_shared<Document>(readTree(beside, ""));
    }
  }

  std::optional<Node> find(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names) {
      if (const auto node = valueAt(root_, name)) return node;
      if (other_)
        if (const auto node = valueAt(Node(*other_), name)) return node;
    }
    return std::nullopt;
  }
  Node require(std::initializer_list<std::string_view> names, const char* file) const {
    if (const auto node = find(names)) return *node;
    root_.fail("needs " + std::string(*names.begin()) + ", which is in " + file + " beside it");
  }

 private:
  Node root_;
  std::shared_ptr<Document> other_;
};

std::optional<std::array<double, 2>> sizeOf(const Files& files) {
  if (const auto size = files.find({"image_size", "imageSize", "size"})) {
    const std::vector<double> s = numbersOf(*size, 2);
    return std::array{s[0], s[1]};
  }
  const auto w = files.find({"image_width", "width"}), h = files.find({"image_height", "height"});
  return w && h ? std::optional(std::array{numberOf(*w), numberOf(*h)}) : std::nullopt;
}

Json rawCamera(const Files& files, bool isSecond) {
  const Node k = isSecond ? files.require({"M2", "K2", "cameraMatrix2", "camera_matrix_2", "RIGHT.K"}, "intrinsics.yml")
                          : files.require({"M1", "K1", "cameraMatrix1", "camera_matrix_1", "LEFT.K"}, "intrinsics.yml");
  const auto d = isSecond ? files.find({"D2", "distCoeffs2", "dist_coeffs_2", "RIGHT.D"})
                          : files.find({"D1", "distCoeffs1", "dist_coeffs_1", "LEFT.D"});
  Json camera = pinholeCamera(intrinsicsOf(k, numbersOf(k, 9)), sizeOf(files));
  if (d)
    if (Json lens = lensOf(*d, "plumb_bob", numbersOf(*d)); !lens.is_null()) camera["distortion"] = std::move(lens);
  if (isSecond)
    setPose(camera, "cameraFromWorld",
            {{"rotation", rowsOf(numbersOf(files.require({"R"}, "extrinsics.yml"), 9), 3)},
             {"translation", numbersOf(files.require({"T"}, "extrinsics.yml"), 3)}});
  return camera;
}

/// Both stand in the world of camera 1, turned by R1; the second is moved along its x by P2's fourth column.
Json rectifiedCamera(const Files& files, bool isSecond) {
  const Node p = files.require({isSecond ? "P2" : "P1"}, "extrinsics.yml"), r = files.require({"R1"}, "extrinsics.yml");
  const std::vector<double> m = numbersOf(p, 12);
  const std::array<double, 4> k = intrinsicsOf(p, std::vector{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]});
  Json camera = pinholeCamera(k, sizeOf(files));
  Rigid shift;
  shift.origin = {DoubleDouble(m[3]) / DoubleDouble(k[0]), DoubleDouble(m[7]) / DoubleDouble(k[1]), 0};
  setPose(camera, "cameraFromWorld", rowsOf(shift * rigidOf(numbersOf(r, 9), {})));
  return camera;
}

Import open(const Node& root) {
  const auto files = std::make_shared<const Files>(root);
  for (const char* known : {"M1", "K1", "M2", "K2", "D1", "D2", "R", "T", "R1", "R2", "P1", "P2", "cameraMatrix1",
                            "cameraMatrix2", "distCoeffs1", "distCoeffs2"})
    if (const auto node = root.find(known)) node->mark();
  Import result;
  if (files->find({"M1", "K1", "cameraMatrix1", "camera_matrix_1", "LEFT.K"})) result.cameras = {{"1", ""}, {"2", ""}};
  if (files->find({"R1"}) && files->find({"P1"}) && files->find({"P2"})) {
    result.cameras.push_back({"rectified1", ""});
    result.cameras.push_back({"rectified2", ""});
  }
  result.document = [files, cameras = result.cameras](std::size_t which) {
    const std::string& name = cameras[which].name;
    return name.size() > 1 ? rectifiedCamera(*files, name.ends_with('2')) : rawCamera(*files, name == "2");
  };
  return result;
}  // namespace stereo

}  // namespace stereo

extern const Format kStereo{"stereo", "a stereo calibration of OpenCV",
                            "M1:9|K1:9|cameraMatrix1:9|camera_matrix_1:9|R1:9 !Camera.fx", stereo::open,
                            "E F Q validRoi* roi* rms* error* *_error image_* board* square* map* R2 newCameraMatrix*"};

}  // namespace viewproj::cmd
