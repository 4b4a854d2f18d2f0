// Camera files of other programs: which format claims a file, what its members mean, and that none is half read.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "formats/finder/finder.hpp"
#include "formats/open.hpp"
#include "formats/parts.hpp"
#include "formats/rows.hpp"
#include "formats/tree.hpp"
#include "formats/value.hpp"
#include "text/error.hpp"

using namespace viewproj::cmd;

namespace {

/// A file that is removed at the end.
class File {
 public:
  File(const std::string& name, const std::string& bytes)
      : folder_(std::filesystem::temp_directory_path() / ("viewproj-formats-" + std::to_string(::getpid()))) {
    std::filesystem::create_directory(folder_);
    path_ = folder_ / name;
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~File() { std::filesystem::remove_all(folder_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  std::string name() const { return path_.string(); }

 private:
  std::filesystem::path folder_, path_;
};

std::string fromHex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return bytes;
}

Json cameraOf(const std::string& source, const std::string& pick = "", const std::string& parts = "") {
  Opening opening{.option = "FILE"};
  if (!pick.empty()) opening.pick = pick;
  if (!parts.empty()) opening.parts = parts;
  const auto cameras = openCameras(source, opening, {});
  return *cameras->document(cameras->choose(opening.pick)).root;
}

std::string messageOf(const std::string& source, const std::string& pick = "", const std::string& parts = "") {
  try {
    (void)cameraOf(source, pick, parts);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

/// A file of a format, and the format that claims it. Every member of these is read.
struct Sample {
  const char* format;
  const char* text;
};
constexpr Sample kSamples[] = {
    {"opencv", R"({"camera_matrix": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "dist_coeffs": [0.1, 0.2, 0.01, 0.02, 0.3],
                   "image_size": [100, 50], "rvec": [0.1, 0.2, 0.3], "tvec": [1, 2, 3]})"},
    {"opencv",
     R"({"a": {"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "T_world_cam": [[1, 0, 0, 1], [0, 0, -1, 2], [0, 1, 0, 3], [0, 0, 0, 1]]},
                   "b": {"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "R": [[1, 0, 0], [0, 0, -1], [0, 1, 0]], "t": [4, 5, 6]}})"},
    {"matlab",
     R"({"K": [[100, 0, 51], [0, 110, 26], [0, 0, 1]], "RadialDistortion": [0.1, 0.2, 0.3], "TangentialDistortion": [0.01, 0.02],
                   "ImageSize": [50, 100], "RotationVectors": [[0.1, 0.2, 0.3]], "TranslationVectors": [[1, 2, 3]]})"},
    {"ros",
     R"({"image_width": 100, "image_height": 50, "camera_matrix": {"rows": 3, "cols": 3, "data": [100, 0, 50, 0, 110, 25, 0, 0, 1]},
                "distortion_model": "plumb_bob", "distortion_coefficients": {"rows": 1, "cols": 5, "data": [0.1, 0.2, 0.01, 0.02, 0.3]},
                "projection_matrix": {"rows": 3, "cols": 4, "data": [90, 0, 49, 0, 0, 91, 24, 0, 0, 0, 1, 0]}})"},
    {"flat",
     R"({"fx": 100, "fy": 110, "cx": 50, "cy": 25, "width": 100, "height": 50, "k1": 0.1, "k2": 0.2, "p1": 0.01, "p2": 0.02, "k3": 0.3})"},
    {"realsense",
     R"({"fx": 100, "fy": 110, "ppx": 50, "ppy": 25, "width": 100, "height": 50, "model": "Brown Conrady", "coeffs": [0.1, 0.2, 0.01, 0.02, 0.3]})"},
    {"slam",
     R"({"Camera.fx": 100, "Camera.fy": 110, "Camera.cx": 50, "Camera.cy": 25, "Camera.width": 100, "Camera.height": 50, "Camera.k1": 0.1,
                 "Camera.k2": 0.2, "Camera.p1": 0.01, "Camera.p2": 0.02})"},
    {"slam",
     R"({"Camera.type": "PinHole", "Camera1.fx": 100, "Camera1.fy": 110, "Camera1.cx": 50, "Camera1.cy": 25, "Camera.width": 100,
                 "Camera.height": 50, "Camera1.k1": 0.1, "Camera1.k2": 0.2, "Camera1.p1": 0.01, "Camera1.p2": 0.02, "Stereo.b": 0.1})"},
    {"slam",
     R"({"model_type": "KANNALA_BRANDT", "image_width": 100, "image_height": 50, "projection_parameters": {"k2": 0.1, "k3": 0.2, "k4": 0.3, "k5": 0.4,
                 "mu": 100, "mv": 110, "u0": 50, "v0": 25}})"},
    {"slam",
     R"({"model_type": "MEI", "image_width": 100, "image_height": 50, "mirror_parameters": {"xi": 1.5}, "distortion_parameters": {"k1": 0.1, "k2": 0.2,
                 "p1": 0.01, "p2": 0.02}, "projection_parameters": {"gamma1": 100, "gamma2": 110, "u0": 50, "v0": 25}})"},
    {"kalibr",
     R"({"cam0": {"camera_model": "pinhole", "intrinsics": [100, 110, 50, 25], "resolution": [100, 50], "distortion_model": "radtan",
                   "distortion_coeffs": [0.1, 0.2, 0.01, 0.02]},
                   "cam1": {"camera_model": "ds", "intrinsics": [-0.2, 0.6, 100, 110, 50, 25], "resolution": [100, 50], "distortion_model": "none",
                   "distortion_coeffs": [], "T_cn_cnm1": [[1, 0, 0, -0.1], [0, 1, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]]}})"},
    {"basalt", R"({"value0": {"T_imu_cam": [{"px": 1, "py": 2, "pz": 3, "qx": 0.5, "qy": 0.5, "qz": 0.5, "qw": 0.5}],
                   "intrinsics": [{"camera_type": "eucm", "intrinsics": {"fx": 100, "fy": 110, "cx": 50, "cy": 25, "alpha": 0.6, "beta": 1.1}}],
                   "resolution": [[100, 50]]}})"},
    {"euroc", R"({"intrinsics": [100, 110, 50, 25], "resolution": [100, 50], "distortion_model": "radial-tangential",
                  "distortion_coefficients": [0.1, 0.2, 0.01, 0.02], "T_BS": {"cols": 4, "rows": 4, "data": [1, 0, 0, 1, 0, 0, -1, 2, 0, 1, 0, 3, 0, 0, 0, 1]}})"},
    {"stereo",
     R"({"M1": [100, 0, 50, 0, 110, 25, 0, 0, 1], "D1": [0.1, 0.2, 0.01, 0.02, 0.3], "M2": [101, 0, 50, 0, 111, 25, 0, 0, 1], "D2": [0, 0, 0, 0, 0],
                   "R": [[1, 0, 0], [0, 0, -1], [0, 1, 0]], "T": [-1, 0, 0]})"},
    {"open3d", R"({"intrinsic": {"width": 100, "height": 50, "intrinsic_matrix": [100, 0, 0, 0, 110, 0, 50, 25, 1]},
                   "extrinsic": [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 1, 2, 3, 1]})"},
    {"3dgs",
     R"([{"id": 4, "img_name": "a", "width": 100, "height": 50, "position": [1, 2, 3], "rotation": [[1, 0, 0], [0, 0, -1], [0, 1, 0]], "fx": 100, "fy": 110}])"},
    {"transforms",
     R"({"w": 100, "h": 50, "fl_x": 100, "fl_y": 110, "cx": 51, "cy": 26, "distortion_params": [0.1, 0.2, 0.3, 0, 0.01, 0.02],
                       "frames": [{"file_path": "a", "transform_matrix": [[1, 0, 0, 1], [0, 0, -1, 2], [0, 1, 0, 3], [0, 0, 0, 1]]}]})"},
    {"polycam",
     R"({"fx": 100, "fy": 110, "cx": 50, "cy": 25, "width": 100, "height": 50, "t_00": 1, "t_01": 0, "t_02": 0, "t_03": 1, "t_10": 0, "t_11": 0,
                    "t_12": -1, "t_13": 2, "t_20": 0, "t_21": 1, "t_22": 0, "t_23": 3})"},
    {"record3d",
     R"({"w": 100, "h": 50, "K": [100, 0, 0, 0, 110, 0, 50, 25, 1], "poses": [[0.5, 0.5, 0.5, 0.5, 1, 2, 3]]})"},
    {"scanner-app",
     R"({"intrinsics": [100, 0, 50, 0, 100, 25, 0, 0, 1], "cameraPoseARFrame": [1, 0, 0, 1, 0, 0, -1, 2, 0, 1, 0, 3, 0, 0, 0, 0.9999998],
                        "projectionMatrix": [2, 0, 0, 0, 0, 4, 0, 0, 0, 0, -1, -0.1, 0, 0, -1, 0]})"},
    {"multical",
     R"({"cameras": {"a": {"K": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "dist": [0.1, 0.2, 0.01, 0.02, 0.3], "image_size": [100, 50]}},
                     "camera_poses": {"a": {"R": [[1, 0, 0], [0, 0, -1], [0, 1, 0]], "T": [1, 2, 3]}}})"},
    {"nuscenes",
     R"([{"camera_intrinsic": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "rotation": [0.5, 0.5, 0.5, 0.5], "translation": [1, 2, 3]}])"},
    {"meshroom",
     R"({"version": ["1", "2", "11"], "views": [{"viewId": "1", "poseId": "2", "intrinsicId": "3", "path": "/a/b.jpg"}],
                     "intrinsics": [{"intrinsicId": "3", "width": "100", "height": "50", "sensorWidth": "36", "focalLength": "36", "principalPoint": ["1", "2"],
                     "distortionType": "radialk3", "distortionParams": ["0.1", "0.2", "0.3"]}],
                     "poses": [{"poseId": "2", "pose": {"transform": {"rotation": ["1", "0", "0", "0", "0", "1", "0", "-1", "0"], "center": ["1", "2", "3"]}}}]})"},
    {"opensfm",
     R"([{"cameras": {"c": {"projection_type": "brown", "width": 100, "height": 50, "focal_x": 1, "focal_y": 1.1, "c_x": 0.01, "c_y": 0.02, "k1": 0.1,
                     "k2": 0.2, "k3": 0.3, "p1": 0.01, "p2": 0.02}}, "shots": {"a.jpg": {"camera": "c", "rotation": [0.1, 0.2, 0.3], "translation": [1, 2, 3]}}}])"},
    {"matrix34", R"({"P": [[100, 0, 50, 1], [0, 110, 25, 2], [0, 0, 1, 3]]})"},
    {"csv",
     R"([{"name": "a", "x": 1, "y": 2, "z": 3, "qx": 0.5, "qy": 0.5, "qz": 0.5, "qw": 0.5, "fx": 100, "fy": 110, "cx": 50, "cy": 25, "near": 0.1, "far": 9,
                     "viewport.width": 100, "viewport.height": 50, "distortion.model": "brown", "k1": 0.1, "k2": 0.2, "k3": 0.3, "p1": 0.01, "p2": 0.02}])"},
    {"gltf",
     R"({"asset": {"version": "2.0"}, "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}], "nodes": [{"camera": 0}]})"},
    {"threejs", R"({"object": {"type": "PerspectiveCamera", "fov": 50, "near": 0.1, "far": 9, "aspect": 1.5}})"},
    {"matrices", R"({"convention": "opengl", "view": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1]})"},
};

/// Each number or list of numbers, by the path of its value.
void eachNumbers(Json& value, const std::string& path,
                 const std::function<void(Json& parent, const std::string& key, const std::string& path)>& visit) {
  if (!value.is_object() && !(value.is_array() && !value.empty() && value.front().is_object())) return;
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) eachNumbers(value[i], path + "." + std::to_string(i), visit);
    return;
  }
  const Json copy = value;
  for (const auto& item : copy.items()) {
    const bool saysNothing =
        item.key() == "version" || item.key() == "id" || item.key() == "rows" || item.key() == "cols";
    const auto numbers = numbersIn(item.value());
    if (numbers && !item.value().is_string() && !saysNothing &&
        std::any_of(numbers->begin(), numbers->end(), [](double number) { return number != 0; }))
      visit(value, item.key(), path + "." + item.key());
    if (value.contains(item.key())) eachNumbers(value[item.key()], path + "." + item.key(), visit);
  }
}

}  // namespace

TEST_CASE("exactly one format claims a file, and none a camera of ours") {
  for (const Sample& sample : kSamples) {
    INFO(sample.text);
    CHECK(claimants(readTree(sample.text, "FILE")) == std::vector<std::string>{sample.format});
  }
  for (const char* ours :
       {R"({"position": [1, 2, 3], "projection": {"type": "intrinsics", "fx": 1, "fy": 1, "cx": 2, "cy": 2}})",
        R"({"worldFromCamera": []})", "{}"})
    CHECK(claimants(readTree(ours, "FILE")).empty());
}

TEST_CASE("a member that is renamed, deleted or added changes the camera, is named, or is an error") {
  std::size_t changed = 0, named = 0, refused = 0;
  for (const Sample& sample : kSamples) {
    // Trees of nodes and projects have hundreds of members that are no camera's.
    const std::string_view format = sample.format;
    if (format == "gltf" || format == "threejs" || format == "matrices" || format == "opensfm" ||
        format == "meshroom" || format == "scanner-app")
      continue;
    Json root = Json::parse(sample.text);
    const auto before = openCameras(root.dump(), {.option = "FILE"}, {});
    std::vector<std::string> cameras;
    for (std::size_t i = 0; i < before->size(); ++i) cameras.push_back(before->document(i).root->dump());
    const auto isTold = [&] {
      try {
        const auto after = openCameras(root.dump(), {.option = "FILE"}, {});
        if (after->size() != cameras.size()) return ++changed > 0;
        for (std::size_t i = 0; i < after->size(); ++i) {
          if (after->document(i).root->dump() != cameras[i]) return ++changed > 0;
          if (!after->unreadOf(i).empty()) return ++named > 0;
        }
      } catch (const InputError&) {
        return ++refused > 0;
      }
      return false;
    };
    eachNumbers(root, "", [&](Json& parent, const std::string& key, const std::string& path) {
      INFO(sample.text);
      INFO(path);
      Json value = parent[key];
      parent.erase(key);
      CHECK(isTold());
      parent[key + "q"] = value;
      CHECK(isTold());
      parent.erase(key + "q");
      parent[key] = std::move(value);
    });
    // Lists of numbers, a pose, a part of a lens and a crop, beside the first member that is read.
    Json& beside = root.is_array() ? root.front() : root;
    for (const auto& [key, value] : {std::pair{"levels", Json{1.5, 2.5, 3.5}},
                                     {"sensor_pose", Json{0.5, 0.5, 0.5, 0.5, 4, 5, 6}},
                                     {"extraSkew", Json(0.37)},
                                     {"crop", Json{1, 2, 30, 40}}}) {
      INFO(sample.text);
      INFO(key);
      beside[key] = value;
      CHECK(isTold());
      beside.erase(key);
    }
  }
  CHECK(changed > 40);
  CHECK(named > 10);
  CHECK(refused > 100);
}

TEST_CASE("what may be a pose or a lens is refused, beside the lens and in an object beside it") {
  const std::pair<const char*, const char*> kRefused[] = {
      {R"({"extrinsic": {"baseline": 0.2, "pitch": 0.04, "x": 1.7}, "intrinsic": {"fx": 500, "fy": 500, "u0": 320, "v0": 240}})",
       "extrinsic.pitch"},
      {R"({"LEFT": {"fx": 500, "fy": 500, "cx": 320, "cy": 240}, "STEREO": {"baseline": 120, "TY": 0.05}})",
       "STEREO.TY"},
      {R"({"intrinsics": {"fx": 500, "fy": 500, "cx": 320, "cy": 240}, "yaw": 10})", "yaw"},
      {R"({"fx": 500, "fy": 500, "cx": 320, "cy": 240, "rotate": 90})", "rotate"},
      {R"({"fx": 500, "fy": 500, "cx": 320, "cy": 240, "flip": true})", "flip"},
      {R"({"fx": 500, "fy": 500, "cx": 320, "cy": 240, "t1": 0.01})", "t1"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "roi": [1, 2, 90, 40]})", "roi"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "w": 100, "h": 50, "fx": 101})", "fx: differs"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "w": 100, "h": 50, "cx": 51})", "cx: differs"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "w": 100, "h": 50, "image_width": 200})", "w: differs"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "w": 100, "h": 50, "resolution": [100, 60]})", "height, 50"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "w": 100, "h": 50, "camera_angle_x": 0.9})", "fovX, 53.1301"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "new_K": [90, 0, 50, 0, 100, 25, 0, 0, 1]})", "new_K"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "dist": [0.1, 0, 0, 0, 0], "D": [0.5, 0, 0, 0, 0]})",
       "D: differs from dist"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "dist": [0.1, 0.2, 0, 0, 0.3], "D": [0.1, 0.2, 0, 0]})",
       "D: differs from dist"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "R": [1, 0, 0, 0, 1, 0, 0, 0, 1], "t": [1, 2, 3], "tvec": [1, 2, 4]})",
       "tvec: differs from t"},
      {R"([{"w": 100, "h": 50, "fx": 100, "fy": 100, "cx": 50, "cy": 25, "cameraFromWorld": "1 0 0 0 1 2 3"}])",
       "[3:7]"},
      {R"([{"lat": 47, "lon": 8, "heading": 0, "width": 100, "height": 50, "fovX": 60}])",
       "call it viewport.height or position.height"},
      {R"([{"x": 1, "y": 2, "z": 3, "heading": 0, "viewport": 640, "viewport.width": 640}])",
       "viewport.width: is said by another column too"},
      {R"([{"x": 1, "y": 2, "z": 3, "target.x": 0, "target.y": 0, "target.z": 0, "fov": 60}])", "fovX or fovY"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "map1": [[1, 2], [3, 4]]})", "map1"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "D": [0.1, 0.2, 0.3, 0.4], "w": 100, "h": 50})",
       "--parts 'K=K, fisheye=D, size=w+h'"},
      {R"({"camera_path": [{"camera_to_world": [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 10, 0, 0, 0, 1], "fov": 150}],
           "camera_type": "fisheye", "render_height": 1080, "render_width": 1920})",
       "camera_type"},
  };
  // Whatever depth, form and word says it.
  const char* const kMovesPixels[] = {R"("lens": {"k": [-0.2, 0.03]})",
                                      R"("lens": {"k": -0.2})",
                                      R"("optics": {"barrel": -0.2})",
                                      R"("kc1": 0.1)",
                                      R"("mount": {"pitch_deg": -10})",
                                      R"("cal": {"mount": {"roll_deg": 3}})",
                                      R"("place": {"east": 5, "north": 2})",
                                      R"("place": {"lat": 46.1, "lon": 7.2})",
                                      R"("upside_down": true)",
                                      R"("mirrored": "yes")",
                                      R"("vflip": 1)",
                                      R"("origin": "bottom-left")",
                                      R"("y_axis": "up")",
                                      R"("handedness": "left")",
                                      R"("convention": "opengl")",
                                      R"("calib_size": [1280, 960])",
                                      R"("sensor": [1280, 960])",
                                      R"("ref_size": "1280x960")",
                                      R"("binning": "2x2")",
                                      R"("scale": "1/2")",
                                      R"("projection": "stereographic")",
                                      R"("lens_type": "equisolid")",
                                      R"("model": "rational")",
                                      R"("units": "normalized")",
                                      R"("rotation_deg": 90)"};
  for (const std::string text : kMovesPixels) {
    INFO(text);
    const std::string name = text.substr(1, text.find('"', 1) - 1);
    CHECK(messageOf(R"({"fx": 600, "fy": 601, "cx": 320, "cy": 240, "width": 640, "height": 480, )" + text + "}")
              .find(name) != std::string::npos);
  }
  for (const auto& [text, place] : kRefused) {
    INFO(text);
    const std::string got = messageOf(text);
    INFO(got);
    CHECK(got.find(place) != std::string::npos);
  }
  // One that is alone names what it is of.
  CHECK(messageOf(kRefused[3].first).find("rotate") != std::string::npos);
  const auto named =
      openCameras(R"({"fx": 500, "fy": 500, "cx": 320, "cy": 240, "baseline": 0.12})", {.option = "FILE"}, {});
  (void)named->document(0);
  CHECK(named->unreadOf(0) == "baseline");
  const auto words = openCameras(
      R"({"fx": 600, "fy": 601, "cx": 320, "cy": 240, "width": 640, "height": 480, "mount": {"gap": 2}, "lens": {"focal_mm": 4.2},
          "rectified": true, "projection": "odd", "note": "in the hall", "origin": "top-left", "units": "m", "camera": "left",
          "binning": "1x1", "aspect_ratio": "4/3", "size": "640x480", "file": "fisheye/1.png", "flip": false, "frame_id": "up"})",
      {.option = "FILE"}, {});
  (void)words->document(0);
  CHECK(words->unreadOf(0) == "lens.focal_mm, mount.gap, projection, rectified");
  const auto agreed = openCameras(
      R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "w": 100, "h": 50, "fx": 100, "cy": 24.5, "fovx": 53, "image_width": 100, "resolution": [50, 100]})",
      {.option = "FILE"}, {});
  (void)agreed->document(0);
  CHECK(agreed->unreadOf(0).empty());
  // A choice of the calibration bends nothing, and all that is not read is named at once.
  CHECK(messageOf(R"({"fx": 500, "fy": 500, "cx": 320, "cy": 240, "estimateSkew": 1})").empty());
  CHECK(messageOf(R"({"fx": 500, "fy": 500, "cx": 320, "cy": 240, "skew": 1, "t1": 2, "pitch": 3})")
            .ends_with("others like it: skew, t1"));
  // Two names of one lens, of which one has zeros at its end.
  CHECK(cameraOf(R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "w": 100, "h": 50, "dist": [0.1, 0.2, 0, 0, 0],
                     "D": [0.1, 0.2, 0, 0]})")["distortion"]["k"][1] == 0.2);
}

TEST_CASE("forms of formats that are less common are read") {
  struct Read {
    const char* text;
    const char* pick;
    std::size_t cameras;
    const char* part;  ///< of the camera's document
  };
  const Read kRead[] = {
      {R"({"cameras": {"a": {"model": "standard", "K": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "dist": [0.1, 0.2, 0, 0, 0], "image_size": [100, 50]},
                       "b": {"model": "rational", "K": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "dist": [0.1, 0.2, 0, 0, 0], "image_size": [100, 50]}},
           "camera_poses": {"a": {"R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "T": [0, 0, 0]},
                            "b_to_a": {"R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "T": [7, 0, 0]}}})",
       "b", 2, R"("translation":[7)"},
      {R"({"w": 100, "h": 50, "K": [100, 0, 0, 0, 110, 0, 50, 25, 1], "poses": [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 1, 2, 3]],
           "perFrameIntrinsicCoeffs": [[100, 110, 50, 25], [105, 106, 51, 26]]})",
       "1", 2, R"("fx":105)"},
      {R"({"world_mat_0": [[100, 0, 50, 1], [0, 110, 25, 2], [0, 0, 1, 3], [0, 0, 0, 1]],
           "world_mat_inv_0": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]})",
       "", 1, R"("fx":100)"},
      {R"({"camera model m": "K [R|-Rt] X", "a.jpg": [100, 50, 100, 0, 50, 0, 110, 25, 0, 0, 1, 0.1, 0.2, 0.3, 0.01, 0.02, 1, 2, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1]})",
       "", 1, R"("position":[1)"},
      {R"({"cam_model": "Pinhole", "cam_width": 100, "cam_height": 50, "cam_fx": 100, "cam_fy": 110, "cam_cx": 50, "cam_cy": 25,
           "cam_d0": 0.1, "cam_d1": 0.2, "cam_d2": 0.01, "cam_d3": 0.02})",
       "", 1, R"("p":[0.01,0.02])"},
      {R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "qvec": [0.5, 0.1, 0.7, 0.5], "tvec": [1, 2, 3]})", "", 1,
       R"("rotation":[0.1,0.7,0.5,0.5])"},
      // Columns of tables, in any case.
      {R"([{"lat": 47, "lon": 8, "alt": 500, "heading": 1, "fx": 100, "fy": 100, "width": 100, "height": 50}])", "", 1,
       R"("viewport":{"height":50.0,"width":100.0})"},
      {R"([{"LAT": 47, "Longitude": 8, "Altitude": 500, "Yaw": 1, "FocalLengthIn35mmFormat": 24, "ImageWidth": 100, "ImageHeight": 50}])",
       "", 1, R"("fovDiagonal":84.06222754839457)"},
      {R"([{"x": 1, "y": 2, "z": 3, "qx": 0, "qy": 0, "qz": 0, "qw": 1, "f": 100, "cx": 50, "cy": 25, "w": 100, "h": 50}])",
       "", 1, R"("cx":50.0,"cy":25.0,"fx":100.0,"fy":100.0)"},
      {R"([{"viewport.width": 100, "viewport.height": 50, "fx": 100, "fy": 110, "cx": 50, "cy": 25}])", "", 1,
       R"("viewport":{"height":50.0,"width":100.0})"},
      {R"([{"X0": 1, "Y0": 2, "Z0": 3, "Omega": 4, "Phi": 5, "Kappa": 6, "fl_x": 100, "fl_y": 110, "w": 100, "h": 50}])",
       "", 1, R"("fx":100.0,"fy":110.0)"},
      {R"([{"C_x": 1, "C_y": 2, "C_z": 3, "omega": 4, "phi": 5, "kappa": 6, "fx": 100, "fy": 110, "cx": 50, "cy": 25, "w": 100, "h": 50}])",
       "", 1, R"("position":{"x":1.0,"y":2.0,"z":3.0})"},
      {R"([{"Easting": 1, "Northing": 2, "Altitude": 3, "Yaw": 4, "Pitch": 5, "fov_x": 60, "w": 100, "h": 50}])", "", 1,
       R"("world":"enu")"},
      {R"([{"name": "a", "x": 1, "y": null, "z": 3, "target.x": 0, "target.y": 0, "target.z": 0, "fx": 100, "fy": 100}])",
       "", 1, R"("fx":100)"},
      {R"([{"name": "a", "size": [100, 50], "matrix": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "rotation": [0.1, 0.2, 0.3],
            "translation": [1, 2, 3], "distortions": [0.1, 0, 0, 0, 0]}])",
       "a", 1, R"("rotationVector":[0.1,0.2,0.3])"},
      {R"([{"x": 1, "y": 2, "z": 3, "pitch": 4, "yaw": 5, "roll": 6, "order": "unreal", "fovX": 60, "w": 100, "h": 50}])",
       "", 1, R"("convention":{"preset":"unreal"},"euler":{"degrees":[4.0,5.0,6.0],"order":"unreal"})"},
      {R"([{"Image": "a", "X": 1, "Y": 2, "Z": 3, "OMEGA": 4, "Phi": 5, "KAPPA": 6, "r11": 0.9}])", "a", 1,
       R"("euler":{"degrees":[4.0,5.0,6.0],"order":"opk"})"},
      {R"({"lens": {"camera_matrix": [], "size": []}, "fisheye_params": {"camera_matrix": [[100, 0, 50], [0, 110, 25], [0, 0, 1]],
           "distortion_coeffs": [0.1, 0.2, 0.3, 0.4]}})",
       "", 1, R"("model":"fisheye")"},
  };
  for (const auto& [text, pick, count, part] : kRead) {
    INFO(text);
    INFO(messageOf(text, pick));
    const auto cameras = openCameras(text, {.option = "FILE"}, {});
    CHECK(cameras->size() == count);
    const std::string document = cameraOf(text, pick).dump();
    INFO(document);
    CHECK(document.find(part) != std::string::npos);
  }
}

TEST_CASE("poses are read from what people hold, and the option's direction counts where no form has one") {
  const auto poseOf = [](const std::string& source, const std::string& direction) {
    Opening opening{.option = "FILE"};
    opening.poses = {source};
    opening.direction = direction;
    const auto cameras = openPoses(opening, {});
    return (*cameras->document(0).root)[direction];
  };
  for (const char* direction : {"worldFromCamera", "cameraFromWorld"}) {
    const Json turn = Json::parse(R"({"rotation": [0, 0, 0, 1], "translation": [1, 2, 3]})");
    for (
        const char* source :
        {R"({"rotation": [0, 0, 0, 1], "translation": [1, 2, 3]})",
         R"({"position": {"x": 1, "y": 2, "z": 3}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}})",
         R"({"header": {"seq": 3}, "pose": {"position": {"x": 1, "y": 2, "z": 3}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}})"})
      CHECK(poseOf(source, direction) == turn);
    CHECK(poseOf("1,2,3 quat:0,0,0,1", direction) == turn);
    CHECK(poseOf("1,2,3 rvec:0,0,1", direction)["rotationVector"] == Json{0, 0, 1});
    const File stack("stack.txt", "1 0 0 1 0 1 0 2 0 0 1 3\n1 0 0 4 0 1 0 5 0 0 1 6\n");
    CHECK(poseOf(stack.name() + "#0", direction)[2][3] == 3);
  }
  const File velodyne("calib_velo_to_cam.txt", "calib_time: 15-Mar\nR: 1 0 0 0 1 0 0 0 1\nT: 1 2 3\ndelta_f: 0 0\n");
  CHECK(poseOf(velodyne.name(), "cameraFromWorld")["translation"] == Json{1, 2, 3});
  // The pose of a camera, and the note where it is replaced.
  const std::string camera =
      R"({"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "T_world_cam": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]})";
  CHECK(poseOf(camera, "worldFromCamera")[0][3] == 1);
  Opening opening{.option = "FILE"};
  opening.poses = {"7,8,9 quat:0,0,0,1"};
  opening.direction = "worldFromCamera";
  const auto cameras = openCameras(camera, opening, {});
  (void)cameras->document(0);
  CHECK(cameras->unreadOf(0).starts_with("its own pose, which --world-from-camera replaces"));
}

TEST_CASE("numbers mean what the format says") {
  CHECK(cameraOf(kSamples[5].text)["distortion"] ==
        Json::parse(R"({"model": "brown", "k": [0.1, 0.2, 0.3], "p": [0.01, 0.02]})"));
  const auto lensOf = [](std::string_view format, const std::string& pick = "") {
    for (const Sample& sample : kSamples)
      if (format == sample.format) return cameraOf(sample.text, pick)["distortion"];
    return Json();
  };
  const auto lensOfSlam = [](std::string_view word) {
    for (const Sample& sample : kSamples)
      if (std::string_view(sample.text).find(word) != std::string_view::npos)
        return cameraOf(sample.text)["distortion"];
    return Json();
  };
  CHECK(lensOf("kalibr", "cam1") == Json::parse(R"({"model": "double-sphere", "xi": -0.2, "alpha": 0.6})"));
  CHECK(lensOf("basalt") == Json::parse(R"({"model": "unified", "alpha": 0.6, "beta": 1.1})"));
  CHECK(lensOfSlam("KANNALA_BRANDT") == Json::parse(R"({"model": "fisheye", "k": [0.1, 0.2, 0.3, 0.4]})"));
  CHECK(lensOfSlam("MEI") == Json::parse(R"({"model": "omni", "xi": 1.5, "k": [0.1, 0.2], "p": [0.01, 0.02]})"));
  CHECK(lensOf("transforms") == Json::parse(R"({"model": "brown", "k": [0.1, 0.2, 0.3], "p": [0.01, 0.02]})"));
  const Json matlab = cameraOf(kSamples[2].text, "K");
  CHECK(matlab["distortion"] == Json::parse(R"({"model": "brown", "k": [0.1, 0.2, 0.3], "p": [0.01, 0.02]})"));
  CHECK(matlab["viewport"] == Json::parse(R"({"pixelCenter": 1, "width": 100, "height": 50})"));
  CHECK(lensOf("opensfm")["k"] == Json::parse("[0.1, 0.2, 0.3]"));
}

TEST_CASE("numpy's archives are read, packed or not") {
  const std::string stored =
      "504b0304140000000000f0b27a5d5cf794ffc8000000c8000000070000006d74782e6e7079934e554d5059010076007b27646573637227"
      "3a20273c6638272c2027666f727472616e5f6f72646572273a2046616c73652c20277368617065273a2028332c2033292c207d20202020"
      "2020202020202020202020202020202020202020202020202020202020202020202020202020202020202020202020202020202020200a"
      "00000000000059400000000000000000000000000000494000000000000000000000000000805b40000000000000394000000000000000"
      "000000000000000000000000000000f03f504b0304140000000000f0b27a5dcda37667940000009400000008000000646973742e6e7079"
      "934e554d5059010076007b276465736372273a20273c6634272c2027666f727472616e5f6f72646572273a2046616c73652c2027736861"
      "7065273a2028312c2035292c207d2020202020202020202020202020202020202020202020202020202020202020202020202020202020"
      "20202020202020202020202020202020200a0000003f0000803e0000003e000000be0000803d504b01021403140000000000f0b27a5d5c"
      "f794ffc8000000c80000000700000000000000000000008001000000006d74782e6e7079504b01021403140000000000f0b27a5dcda376"
      "6794000000940000000800000000000000000000008001ed000000646973742e6e7079504b050600000000020002006b000000a7010000"
      "0000";
  const std::string deflated =
      "504b0304140000000800f0b27a5d5cf794ff5b000000c8000000070000006d74782e6e70799bec17ea1b10c9c850c650ad9e925a9c5ca4"
      "6ea5a06e9366a1aea3a09e965f54529498179f5f94920a12774bcc294e058a17672416a402f91ac63a0ac69a3a0ab50a64032e06308874"
      "6040019ea8fc866828df124d1d0c7cb00700504b0304140000000800f0b27a5dcda37667550000009400000008000000646973742e6e70"
      "799bec17ea1b10c9c850c650ad9e925a9c5ca46ea5a06e9366a2aea3a09e965f54529498179f5f94920a12774bcc294e058a17672416a4"
      "02f91a863a0aa69a3a0ab50a64032e0606067b0686063b200dc2fb806c5b00504b01021403140000000800f0b27a5d5cf794ff5b000000"
      "c80000000700000000000000000000008001000000006d74782e6e7079504b01021403140000000800f0b27a5dcda37667550000009400"
      "0000080000000000000000000000800180000000646973742e6e7079504b050600000000020002006b000000fb0000000000";
  const Json lens = Json::parse(R"({"model": "brown", "k": [0.5, 0.25, 0.0625], "p": [0.125, -0.125]})");
  for (const std::string& hex : {stored, deflated}) {
    const File file("calibration.npz", fromHex(hex));
    const Json camera = cameraOf(file.name());
    CHECK(camera["distortion"] == lens);
    CHECK(camera["projection"]["fx"] == 100);
    CHECK(camera["projection"]["fy"] == 110);
    CHECK(camera["projection"]["cx"] == 50);
    CHECK(camera["projection"]["cy"] == 25);
  }
  // What is cut off or changed is refused, and nothing worse.
  for (std::size_t i = 0; i < stored.size() / 2; i += 7) {
    std::string bytes = fromHex(stored);
    bytes[i] = static_cast<char>(bytes[i] ^ 0x41);
    const File changed("calibration.npz", bytes);
    CHECK(messageOf(changed.name()).find("exception") == std::string::npos);
    const File cut("calibration.npz", fromHex(stored).substr(0, i));
    CHECK(messageOf(cut.name()).find("exception") == std::string::npos);
  }
}

TEST_CASE("a line of parts and paths makes a camera") {
  const std::string text =
      R"({"calib": {"m": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "d": [[0.1, 0.2, 0.01, 0.02, 0.3, 9]]}, "w": 100, "h": 50,
      "views": {"a": {"r": [0.1, 0.2, 0.3], "t": [1, 2, 3]}, "b": {"r": [0, 0, 0], "t": [4, 5, 6]}}, "v2 1.5": {"f": 700}})";
  const std::string lens = "K=calib.m, size=w+h, distortion=calib.d[0:5]";
  const Json camera = cameraOf(text, "", lens);
  CHECK(camera["projection"]["fx"] == 100);
  CHECK(camera["viewport"] == Json::parse(R"({"width": 100, "height": 50})"));
  CHECK(camera["distortion"] == Json::parse(R"({"model": "brown", "k": [0.1, 0.2, 0.3], "p": [0.01, 0.02]})"));
  const std::string posed = lens + ", cameraFromWorld.rotationVector=views.*.r, cameraFromWorld.translation=views.*.t";
  CHECK(cameraOf(text, "b", posed)["cameraFromWorld"] ==
        Json::parse(R"({"rotationVector": [0, 0, 0], "translation": [4, 5, 6]})"));
  CHECK(cameraOf(text, "", "K=v2 1.5.f+50+25")["projection"]["fx"] == 700);
  const std::pair<const char*, const char*> kWrong[] = {
      {"pose=views.a.t", "'pose' is no part"},
      {"K", "expected name=path"},
      {"K=calib.x", "K: calib.x: is not in the file"},
      {"K=calib.d", "expected 1, 2, 3, 4, 9, 12 or 16 numbers, got 6"},
      {"K=calib.m, distortion=calib.d", "say which"},
      {"K=views.*.*", "two stars"},
      {"K=calib.m, K=calib.m", "given twice"},
      {"K=calib.m^T", "transpose"},
      {"K=w", "needs"},
  };
  for (const auto& [parts, message] : kWrong) {
    INFO(parts);
    const std::string got = messageOf(text, "", parts);
    INFO(got);
    CHECK((got.find(message) != std::string::npos || std::string_view(parts) == "K=w"));
  }
  // A camera that lacks a part is an error, and the others are read.
  const std::string lacking =
      R"({"a": {"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "R": [1, 0, 0, 0, 1, 0, 0, 0, 1], "T": [1, 2, 3]},
                                  "b": {"K": [100, 0, 50, 0, 110, 25, 0, 0, 1], "R": [1, 0, 0, 0, 1, 0, 0, 0, 1]}})";
  const std::string set = "K=*.K, cameraFromWorld.rotation=*.R, cameraFromWorld.translation=*.T";
  CHECK(cameraOf(lacking, "a", set)["cameraFromWorld"]["translation"] == Json::parse("[1, 2, 3]"));
  CHECK(messageOf(lacking, "b", set).find("b.T: is not in the file") != std::string::npos);
}

TEST_CASE("every row of the formats is a line that can be read") {
  for (const Row& row : rows())
    for (std::string_view rest = row.lines; !rest.empty();) {
      std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
      if (line.find(": ") < line.find('=')) line.remove_prefix(line.find(": ") + 2);
      INFO(line);
      CHECK_NOTHROW(requireNames(parseParts(line, "row"), "row", true));
    }
}

TEST_CASE("stars are in the file's order, numbers by their size") {
  const Document file =
      readTree(R"({"cam10": {"k": 1}, "cam2": {"k": 1}, "cam1": {"k": 1}, "x": {"k": 1}, "cam3": {"j": 1}})", "FILE");
  const Part part = parseParts("K=cam*.k", "row").front();
  CHECK(starsOf(Node(file), part.starredPaths()) == std::vector<std::string>{"1", "2", "10"});
}

TEST_CASE("the finder proposes the line that reads a file") {
  const std::string text =
      R"({"CameraMatrix": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "DistCoeffs": [0.1, 0.2, 0.01, 0.02, 0.3],
                               "TranslationVector": [1, 2, 3], "Rotation": [[1, 0, 0], [0, 0, -1], [0, 1, 0]]})";
  const Proposal proposal = proposeParts(readTree(text, "FILE"));
  REQUIRE(!proposal.lines.empty());
  CHECK(proposal.lines[0].parts ==
        "K=CameraMatrix, distortion=DistCoeffs, worldFromCamera.rotation=Rotation, "
        "worldFromCamera.translation=TranslationVector");
  CHECK(proposal.lines[0].decide.size() == 1);
  const Proposal set = proposeParts(readTree(
      R"({"left": {"mtx": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "w2c": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]},
          "right": {"mtx": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "w2c": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]}})",
      "FILE"));
  REQUIRE(!set.lines.empty());
  CHECK(set.lines[0].parts == "K=*.mtx, cameraFromWorld=*.w2c");
  CHECK(set.lines[0].cameras == 2);
  const auto proposed = [](const char* file) { return proposeParts(readTree(file, "FILE")); };
  const Proposal autoware = proposed(
      R"({"CameraExtrinsicMat": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]], "CameraMat": [[100, 0, 50], [0, 110, 25], [0, 0, 1]]})");
  CHECK(autoware.lines[0].parts == "K=CameraMat, worldFromCamera=CameraExtrinsicMat");
  const Proposal vehicle = proposed(
      R"({"extrinsics": {"rotation": {"qx": 0, "qy": 0, "qz": 0, "qw": 1}, "translation": {"x": 1, "y": 2, "z": 3}},
          "lens": {"mtx": [[100, 0, 50], [0, 110, 25], [0, 0, 1]]}})");
  REQUIRE(!vehicle.lines.empty());
  for (const std::string& question : vehicle.lines[0].decide) CHECK(question.find("w first") == std::string::npos);
  const Proposal radial = proposed(
      R"({"lens": {"focal_length": 1000, "principal_point": [500, 300], "disto_k3": [-0.05, 0.02, 0.01]}, "spawn": {"x": 1, "pitch": 3, "z": 2}})");
  CHECK(std::count(radial.leftOut.begin(), radial.leftOut.end(), "lens.disto_k3") == 1);
  CHECK(std::count(radial.leftOut.begin(), radial.leftOut.end(), "spawn") == 1);
  // All that holds numbers is in the line or left out; k and p of a lens are its distortion.
  const Proposal mounted = proposed(
      R"({"cams": [{"f": [920, 920], "c": [640, 360], "pixels": [1280, 720], "lens": {"k": [-0.1, 0.2, 0.3], "p": [0.01, 0]},
                    "mount": {"xyz": [1, 0, 0], "rpy": [0, 0, 0]}, "tilt": 3, "version": 2}]})");
  CHECK(mounted.lines.at(0).parts ==
        "K=cams.0.f+cams.0.c, size=cams.0.pixels, "
        "distortion=cams.0.lens.k[0,1]+cams.0.lens.p+cams.0.lens.k[2]");
  CHECK(mounted.leftOut == std::vector<std::string>{"cams.0.tilt", "cams.0.mount.xyz"});
  const Proposal starred = proposed(
      R"({"a": {"f": [920, 920], "c": [640, 360], "pan": 1}, "b": {"f": [920, 920], "c": [640, 360], "pan": 2}})");
  CHECK(starred.leftOut == std::vector<std::string>{"*.pan"});
  const File xml("set.xml",
                 R"(<Set><Cam W="2048" H="1536"><Foc X="2311" Y="2310"/><Ctr X="1019" Y="771"/></Cam></Set>)");
  CHECK(proposed(xml.name().c_str()).lines.at(0).parts == "K=Set.Cam.Foc+Set.Cam.Ctr, size=Set.Cam.@W+Set.Cam.@H");
  // MATLAB's camera matrix is the transposed one of others.
  const Proposal turned = proposed(
      R"({"camMatrix": [[1226.7, -30.5, -0.219], [100.1, 1440, 0.156], [930.2, 133.9, 0.963], [392010, 256050, 872]]})");
  CHECK(turned.lines.at(0).parts == "P=camMatrix^T");
  CHECK(turned.lines.at(0).set == std::vector<std::string>{"viewport.pixelCenter=1"});
  // An orbit's camera that would be upside down and look away with OpenCV's axes.
  const Proposal orbit = proposed(
      R"({"K": [[1111, 0, 400], [0, 1111, 400], [0, 0, 1]], "pose_a": [[0.8253, -0.283, 0.4886, 1.95], [0.5647, 0.4136, -0.7142, -2.85], [0, 0.8653, 0.5012, 2.1], [0, 0, 0, 1]]})");
  // Where no name tells the direction, both lines can be typed as they stand.
  CHECK(optionsOf(orbit.lines.at(0)) == "--parts 'K=K, worldFromCamera=pose_a' --set cameraAxes=RUB");
  CHECK(optionsOf(otherWay(orbit.lines.at(0))) == "--parts 'K=K, cameraFromWorld=pose_a'");
  // Rows of a rotation, or nine numbers counted from 0, with the place around them.
  const Proposal rows = proposed(
      R"({"S": {"Interne": {"F": 90, "PP": [45, 30]}, "Externe": {"Centre": [4, 5, 6], "Rows": {"L1": [0.6, 0.8, 0], "L2": [-0.8, 0.6, 0], "L3": [0, 0, 1]}}}})");
  CHECK(rows.lines.at(0).parts ==
        "K=S.Interne.F+S.Interne.PP, worldFromCamera.rotation=S.Externe.Rows.L1+S.Externe.Rows.L2+S.Externe.Rows.L3, "
        "position=S.Externe.Centre");
  CHECK(rows.leftOut.empty());
  const File named("named.xml",
                   R"(<A><F name="Fov">50</F><C name="At"><X>1</X><Y>2</Y><Z>3</Z><R00>0.6</R00><R01>0.8</R01>
      <R02>0</R02><R10>-0.8</R10><R11>0.6</R11><R12>0</R12><R20>0</R20><R21>0</R21><R22>1</R22></C></A>)");
  CHECK(proposed(named.name().c_str()).lines.at(0).parts ==
        "fovY=A.Fov, worldFromCamera.rotation=A.C.R00+A.C.R01+A.C.R02+A.C.R10+A.C.R11+A.C.R12+A.C.R20+A.C.R21+A.C.R22, "
        "position=A.C.X+A.C.Y+A.C.Z");
  // What is called as a camera's comes first of what a person may use, and all of it.
  std::string many = R"({"far away": {"longitude": 7)";
  for (int i = 0; i < 20; ++i) many = R"({"n)" + std::to_string(i) + "\": " + std::to_string(i) + ", " + many.substr(1);
  CHECK(textOf(proposed((many + "}}").c_str())).find("far away.longitude: 7") != std::string::npos);
  CHECK(!proposed(R"({"mtx_a": [[100, 0, 50], [0, 110, 25], [0, 0, 1]], "radial": [2.1e-8, -1.2e-14]})")
             .lines[0]
             .decide.empty());
}

TEST_CASE("names that state an order or a direction up are obeyed by the finder and by --parts") {
  const auto proposed = [](const std::string& file) { return proposeParts(readTree(file, "FILE")).lines.at(0); };
  const std::string w = R"({"cam": {"pos": [1, 2, 3], "fov": 40, "q_wxyz": [0.5, 0.1, 0.7, 0.5]}})";
  const std::string x = R"({"cam": {"pos": [1, 2, 3], "fov": 40, "quatXYZW": [0.1, 0.7, 0.5, 0.5]}})";
  CHECK(proposed(w).parts == "fovY=cam.fov, worldFromCamera.quaternionWFirst=cam.q_wxyz, position=cam.pos");
  CHECK(proposed(x).parts == "fovY=cam.fov, worldFromCamera.quaternion=cam.quatXYZW, position=cam.pos");
  const auto turnOf = [](const std::string& file, const std::string& turn) {
    return cameraOf(file, "",
                    "fovY=cam.fov, worldFromCamera." + turn + ", position=cam.pos")["worldFromCamera"]["rotation"];
  };
  const Json turn{0.1, 0.7, 0.5, 0.5};
  CHECK(turnOf(w, "quaternion=cam.q_wxyz") == turn);
  CHECK(turnOf(w, "quaternionWFirst=cam.q_wxyz") == turn);
  CHECK(turnOf(w, "quaternion=cam.q_wxyz[1,2,3,0]") == turn);
  CHECK(turnOf(x, "quaternion=cam.quatXYZW") == turn);
  CHECK(messageOf(x, "", "fovY=cam.fov, worldFromCamera.quaternionWFirst=cam.quatXYZW, position=cam.pos")
            .find("say worldFromCamera.quaternion") != std::string::npos);
  // Which way the camera's axes point is asked, where no program's name says it.
  CHECK(proposed(w).decide.back().find("cameraAxes=RUB") != std::string::npos);
  CHECK(proposed(R"({"shot": {"eye": [12, 8, 15], "target": [1, 2, 0], "up": [0, 1, 0], "vfov": 50}})").parts ==
        "fovY=shot.vfov, position=shot.eye, target=shot.target, up=shot.up");
  CHECK(proposed(R"({"shot": {"eye": [12, 8, 15], "center": [1, 2, 0], "up": [0, 1, 0], "vfov": 50}})").parts ==
        "fovY=shot.vfov, position=shot.eye, target=shot.center, up=shot.up");
  CHECK(proposed(R"({"shot": {"from": [12, 8, 15], "to": [1, 2, 0], "up": [0, 1, 0], "vfov": 50}})").parts ==
        "fovY=shot.vfov, position=shot.from, target=shot.to, up=shot.up");
  // The name of a lens's model names its coefficients; those of another lens are no distortion.
  const std::string k = R"({"f": [612, 611], "p": [319, 236], "size": [640, 480], ")";
  CHECK(proposed(k + R"(Brown_Conrady": [0.15, -0.49, 0.0006, -0.001, 0.44]})").parts ==
        "K=f+p, size=size, distortion=Brown_Conrady");
  CHECK(proposed(k + R"(Inverse_Brown_Conrady": [0.15, -0.49, 0.0006, -0.001, 0.44]})").parts == "K=f+p, size=size");
  // Three coefficients are k1, k2 and k3, and single numbers of a pose are no less left out than others.
  const Proposal mount = proposeParts(readTree(
      R"({"mount": {"X": 0.5, "Yaw": 20, "lens": {"fx_px": 90, "fy_px": 91, "cx_px": 45, "cy_px": 30, "k1": 0.1, "k2": 0.2, "k3": 0.3}}})",
      "FILE"));
  const std::string lens = "mount.lens.";
  CHECK(mount.lines.at(0).parts == "K=" + lens + "fx_px+" + lens + "fy_px+" + lens + "cx_px+" + lens +
                                       "cy_px, distortion=" + lens + "k1+" + lens + "k2+0+0+" + lens + "k3");
  CHECK(mount.leftOut == std::vector<std::string>{"mount.X", "mount.Yaw"});
  // k5 and k6 beside k1 to k4 are no fisheye's, a centre of the distortion is no coefficient, and one vector no pose.
  const std::string pinhole = R"("fx": 900, "fy": 910, "cx": 640, "cy": 360, )";
  CHECK(
      proposed("{\"camera_0\": {" + pinhole + R"("k1": 5, "k2": 3, "k3": 0.2, "k4": 5.5, "k5": 4.5, "k6": 1}, "x": 1})")
          .parts.ends_with("distortion=camera_0.k1+camera_0.k2+0+0+camera_0.k3+camera_0.k4+camera_0.k5+camera_0.k6"));
  const Proposal centred = proposeParts(
      readTree("{\"lens\": {" + pinhole + R"("SzIm": "1280 720", "ModRad": {"CDist": "650 355"}}})", "FILE"));
  CHECK(centred.lines.at(0).parts == "K=lens.fx+lens.fy+lens.cx+lens.cy, size=lens.SzIm");
  CHECK(centred.leftOut == std::vector<std::string>{"lens.ModRad.CDist"});
  CHECK(proposed("{\"lens\": {" + pinhole + R"("Translation_Vector": [0.1, 0.2, 0.3]}})").parts ==
        "K=lens.fx+lens.fy+lens.cx+lens.cy");
  // The turns of Unreal and CARLA.
  const ProposedLine carla = proposed(
      R"({"type": "sensor.camera.depth", "location": {"x": 1, "y": 2, "z": 3}, "rotation": {"pitch": 4, "yaw": 5, "roll": 6}, "fov": 80})");
  CHECK(carla.parts == "fovX=fov, position=location, euler=rotation.pitch+rotation.yaw+rotation.roll");
  CHECK(carla.set == std::vector<std::string>{"convention=unreal", "euler.order=unreal"});
  // Members that many programs have do not make a file ours.
  const char* const others[] = {
      R"({"cameras": [{"focal": 900, "center": [45, 30], "distortion": [-0.1, 0.05]}, {"focal": 901, "center": [45, 30], "distortion": [-0.1, 0.06]}]})",
      R"({"position": [1, 2, 3], "orientation_wxyz": [1, 0, 0, 0], "focal_length": 24, "clipping": [0.1, 9]})"};
  for (const char* file : others) CHECK(messageOf(file).find("of a known kind") != std::string::npos);
  CHECK(messageOf(R"({"position": [1, 2, 3], "target": [0, 0, 0], "fovy": 60})").find("fovy: is not known") !=
        std::string::npos);
  // A table of one row is a set.
  CHECK(proposed(R"([{"shot": "a", "fovy": 40, "w2c": [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3]}])").parts ==
        "fovY=*.fovy, cameraFromWorld=*.w2c");
}

TEST_CASE("the finder proposes nothing for files that hold no camera") {
  for (
      const char* text :
      {R"({"title": "notes", "list": [1, 2, 3]})",
       R"({"name": "pkg", "version": "1.2.3", "scripts": {"test": "x"}, "dependencies": {"three": "^0.1"}, "size": [640, 480]})",
       R"({"compilerOptions": {"target": "es2020", "lib": ["dom"], "rotation": 90}, "include": ["src"]})",
       R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"id": 7, "width": 640, "height": 480},
            "geometry": {"type": "Polygon", "coordinates": [[[7.1, 46.2], [7.3, 46.2], [7.3, 46.4], [7.1, 46.2]]]}}]})",
       R"({"v": "5.7", "fr": 30, "w": 512, "h": 512, "layers": [{"ks": {"r": {"k": 0}, "p": {"k": [256, 256, 0]}, "s": {"k": [100, 100, 100]}}}]})",
       R"({"colors": {"red": [1, 0, 0], "matrix": [0.41, 0.36, 0.18, 0.21, 0.72, 0.07, 0.02, 0.12, 0.95]}, "transform": [1, 0, 0, 1, 10, 20]})",
       R"({"model": {"k": 5, "weights": [0.5, 0.25, 0.125, 0.125], "shape": [224, 224], "mean": [0.485, 0.456, 0.406]}, "p1": 0.1})",
       R"({"windows": [{"x": 10, "y": 20, "width": 800, "height": 600}], "font": {"size": 12, "f": 2}})",
       R"([{"date": "2024-01-01", "t": 12.5, "p": 1013.2, "position": "3"}, {"date": "2024-01-02", "t": 11.5, "p": 1012.2}])",
       R"({"inertia": {"K": [[4, 0.1, 0], [0.1, 5, 0], [0, 0, 6]], "center": [0.1, 0.2, 0.3]}, "gains": {"k1": 0.5, "k2": 0.1}})"}) {
    INFO(text);
    CHECK(textOf(proposeParts(readTree(text, "FILE"))).find("--parts") == std::string::npos);
  }
}
