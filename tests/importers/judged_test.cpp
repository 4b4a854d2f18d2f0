// Cameras in other programs' files put points where those programs put them. What they say is in fixtures, written by
// judge.sh; VIEWPROJ_FIXTURES in the environment names other ones, fresh from the judges.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "tool.hpp"

namespace {

using nlohmann::json;

json run(const std::vector<std::string>& arguments) { return json::parse(tool::printed(arguments)); }

/// Files of this test alone.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "viewproj-judged-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    folder_ = name;
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const json& value) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << value;
    return path;
  }

 private:
  std::filesystem::path folder_;
};

/// The largest difference to the judge, by the name of the case.
std::map<std::string, double> compare(const std::string& fixture, double pixelTolerance, double depthTolerance) {
  const char* fresh = std::getenv("VIEWPROJ_FIXTURES");
  std::ifstream lines(std::string(fresh ? fresh : VIEWPROJ_FIXTURES_DIR) + "/" + fixture);
  REQUIRE(lines);
  const Scratch scratch;
  std::map<std::string, double> worst;
  for (std::string line; std::getline(lines, line);) {
    const json test = json::parse(line);
    const std::string name = test["name"];
    std::string camera = scratch.write("camera", test["file"]);
    if (test["pick"].is_string()) camera += "#" + test["pick"].get<std::string>();
    std::vector<std::string> arguments{"project", "-c", camera, scratch.write("points.json", test["points"])};
    if (test["viewport"].is_string()) {
      arguments.push_back("--viewport");
      arguments.push_back(test["viewport"]);
    }
    if (test.contains("options"))
      for (const json& option : test["options"]) arguments.push_back(option);
    const json got = run(arguments);
    REQUIRE(got.size() == test["points"].size());
    REQUIRE(!got.empty());
    for (std::size_t i = 0; i < got.size(); ++i) {
      INFO(name << ": " << line);
      INFO(got[i].dump());
      const json& pixel = test["pixels"][i];
      for (std::size_t k = 0; k < 2; ++k) {
        const double off = std::fabs(got[i]["screen"][k].get<double>() - pixel[k].get<double>());
        REQUIRE(off <= pixelTolerance);
        worst[name] = std::max(worst[name], off);
      }
      if (test["depth"]) REQUIRE(std::fabs(got[i]["depth"].get<double>() - pixel[2].get<double>()) <= depthTolerance);
    }
  }
  return worst;
}

void report(const std::map<std::string, double>& worst) {
  for (const auto& [name, off] : worst) std::printf("  %-45s %.1e px\n", name.c_str(), off);
}

}  // namespace

TEST_CASE("three.js and glTF cameras put points where three.js puts them, to 1e-9 px") {
  const auto worst = compare("threejs.jsonl", 1e-9, 1e-9);
  report(worst);
  for (const char* name :
       {"three perspective", "three perspective zoom", "three view offset", "three film offset",
        "three film offset in portrait", "three orthographic", "three orthographic view offset", "three scene",
        "glTF perspective", "glTF without aspectRatio", "glTF without zfar", "glTF orthographic", "glTF hierarchy"}) {
    INFO(name);
    CHECK(worst.count(name) == 1);
  }
}

TEST_CASE("Calibrations and transforms.json put points where OpenCV puts them, to 1e-6 px") {
  const auto worst = compare("opencv.jsonl", 1e-6, 0);
  report(worst);
  for (const char* name : {"OpenCV K, R, t", "OpenCV K, R, t flat, viewport given", "OpenCV rvec tiny",
                           "OpenCV rvec ordinary", "OpenCV rvec of pi", "OpenCV rvec beyond pi", "OpenCV FileStorage",
                           "OpenCV without a pose", "OpenCV R nearly a rotation", "transforms.json",
                           "transforms.json nearly a rotation", "transforms.json with distortion to ignore",
                           "transforms.json per-frame intrinsics", "transforms.json of Blender"}) {
    INFO(name);
    CHECK(worst.count(name) == 1);
  }
}

TEST_CASE("What matrix writes in any convention is read as the camera again, to 1e-9 px") {
  const json cameras[] = {
      json::parse(R"({"position": [0, 0, 0], "direction": [0, 0, -1],
                      "projection": {"type": "perspective", "fovY": 50, "near": 0.1, "far": 100}})"),
      json::parse(R"({"position": [3, 2, 5], "target": [0, 0.5, 0], "up": [0.1, 1, 0],
                      "projection": {"type": "perspective", "fovY": 50, "near": 0.25, "shift": [0.1, 0]}})"),
      json::parse(R"({"convention": "d3d", "position": [3, 2, -5], "target": [0, 0.5, 0],
                      "projection": {"type": "perspective", "fovY": 50, "near": 0.25, "far": 1e5}})"),
      json::parse(R"({"position": [3, 2, 5], "target": [0, 0.5, 0],
                      "projection": {"type": "orthographic", "width": 16, "height": 9, "near": -1, "far": 30}})"),
  };
  const Scratch scratch;
  const std::string points = scratch.write("points.json", json::parse("[[1, 1, -2], [0.5, -0.25, -1], [-1, 0.5, -4]]"));
  int compared = 0, withInverse = 0;
  for (const json& camera : cameras) {
    const std::string file = scratch.write("camera.json", camera);
    const json truth = run({"project", "-c", file, points, "--viewport", "1280x720"});
    for (const char* reverse : {"--reverse-z", "--no-reverse-z"})
      for (const char* convention :
           {"opengl", "opengl-lh", "d3d", "d3d-rh", "vulkan", "metal", "webgpu", "unity", "unreal", "opencv", "ps2"})
        for (const char* which : {"view,projection,viewport", "viewProjection,viewport", "inverse"}) {
          INFO(camera.dump() << " " << convention << " " << reverse << " " << which);
          const bool inverse = which == std::string("inverse");
          std::vector<std::string> arguments{"matrix",   file,           "--viewport",
                                             "1280x720", "--convention", convention,
                                             reverse,    "--which",      inverse ? "view,projection,viewport" : which};
          if (inverse) arguments.push_back("--inverse");
          json matrices = run(arguments);
          if (inverse) {
            matrices.erase("view");
            ++withInverse;
          }
          const json again = run({"project", "-c", scratch.write("matrices.json", matrices), points});
          REQUIRE(again.size() == truth.size());
          for (std::size_t i = 0; i < truth.size(); ++i) {
            INFO(truth[i].dump() << again[i].dump());
            for (std::size_t k = 0; k < 2; ++k)
              REQUIRE(std::fabs(again[i]["screen"][k].get<double>() - truth[i]["screen"][k].get<double>()) <= 1e-9);
            REQUIRE(again[i]["visible"] == truth[i]["visible"]);
            ++compared;
          }
        }
  }
  CHECK(compared == 4 * 2 * 11 * 3 * 3);
  CHECK(withInverse == 4 * 2 * 11);
}
