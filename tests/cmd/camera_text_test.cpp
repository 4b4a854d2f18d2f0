// Every camera of the samples and of the transcripts, written as a camera file, in every convention and for other
// worlds, and read again: the same pixels.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "camera/change_camera.hpp"
#include "camera/read_pose.hpp"
#include "camera/write_camera.hpp"
#include "catch.hpp"
#include "formats/open.hpp"
#include "text/error.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

constexpr ReadOptions kReading{.allowStretch = true, .ignoreDistortion = true};

/// Whole cameras; what has no pose or no projection of its own stands somewhere and sees something.
CameraFile completed(const Document& document) {
  Document whole = copied(document);
  CameraFile file = readCamera(whole, {.allowStretch = true, .ignoreDistortion = true, .needsPicture = false});
  if (!file.viewport) (*whole.root)["viewport"] = {{"width", 640}, {"height", 480}};
  if (!file.pose) (*whole.root)["cameraFromWorld"] = {{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}, {0, 0, 0, 1}};
  if (!file.projection) (*whole.root)["projection"] = {{"type", "perspective"}, {"fovY", 50}, {"near", 0.1}};
  return readCamera(whole, kReading);
}

/// Forms that no sample has.
constexpr const char* kOthers[] = {
    R"({"convention": "unity", "position": [1, 2, 3], "euler": {"order": "YXZ", "degrees": [30, 20, 10]}})",
    R"({"convention": "unreal", "position": [1, 2, 3], "rotation": [1, 2, 3, 4]})",
    R"({"convention": "opencv", "position": [1, 2, 3], "worldFromCamera": {"rotation": [1, 2, 3, 4], "translation": [0, 0, 0]}})",
    R"({"cameraAxes": "RDF", "cameraFromWorld": {"rotation": [[1, 0, 0], [0, 0.6, 0.8], [0, -0.8, 0.6]], "translation": [4, 5, 6]},
        "projection": {"type": "perspective", "fovX": 60, "near": 1, "shift": [0.1, -0.2]},
        "viewport": {"width": 200, "height": 100, "crop": {"x": 20, "y": 10, "width": 50, "height": 30}}})",
    R"({"convention": "d3d", "position": [1, 2, 3], "direction": [1, 0, 1], "viewport": {"width": 200, "height": 100},
        "projection": {"type": "matrix", "shift": [0.1, 0], "matrix": [[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1.01, 1], [0, 0, -0.101, 0]]}})",
};

std::vector<CameraFile> allCameras() {
  std::vector<CameraFile> cameras;
  for (const char* text : kOthers) {
    const auto opened = openCameras(text, {.option = "FILE"}, {});
    const CameraDocuments& documents = *opened;
    cameras.push_back(completed(documents.document(0)));
  }
  for (const char* folder : {"samples", "tests/cmd/transcripts"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::string(VIEWPROJ_SAMPLES "/../") + folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".json" && ending != ".gltf" && ending != ".yaml" && ending != ".yml" && ending != ".txt") continue;
      try {
        const auto opened = openCameras(entry.path().string(), {.option = "FILE"}, {});
        const CameraDocuments& documents = *opened;
        for (std::size_t i = 0; i < documents.size(); ++i) cameras.push_back(completed(documents.document(i)));
      } catch (const InputError&) {  // a scene, points, a camera that is to be refused
      }
    }
  return cameras;
}

/// The most by which a pixel of the picture moves where the second camera shows the points that toSecond makes of the
/// first one's.
template <class Map>
double apart(const CameraFile& a, const CameraFile& b, const Map& toSecond) {
  const Camera first = makeCamera(a), second = makeCamera(b);
  const auto [low, high] = pictureCorners(first.viewport());
  const double near = first.projection().zNear(), far = first.projection().zFar();
  double most = 0;
  for (const double across : {0.0, 0.5, 1.0})
    for (const double along : {0.0, 0.5, 1.0})
      for (const double distance : {near == 0 ? 1 : near, std::isinf(far) ? 1000 : far}) {
        const Vec2 pixel{low.x + across * (high.x - low.x), low.y + along * (high.y - low.y)};
        const Vec3 point = screenToWorldAtDistance(first, pixel, distance).position;
        const ScreenPoint p = worldToScreen(first, point), q = worldToScreen(second, toSecond(point));
        most = std::max({most, std::fabs(p.x - q.x), std::fabs(p.y - q.y)});
        if (std::isnan(p.x - q.x) || std::isnan(p.y - q.y)) return INFINITY;
      }
  return most;
}

}  // namespace

TEST_CASE("A camera written in any convention and read again shows the same pixels") {
  const std::vector<CameraFile> cameras = allCameras();
  CHECK(cameras.size() > 30);
  std::map<std::string, int> forms;
  for (const CameraFile& camera : cameras)
    for (const ConventionPreset& preset : conventionPresets()) {
      Convention convention = preset.convention;
      convention.world = camera.convention.world;
      INFO(camera.name << " as " << preset.name);
      const Json& document = *camera.document.root;
      const bool isPs2 = document["projection"]["type"] == "ps2";
      if (isPs2 && !convention.reverseZ) {
        CHECK_THROWS_AS(writeCamera(camera, preset, convention), InputError);
        continue;
      }
      const std::string text = writeCamera(camera, preset, convention);
      INFO(text);
      const CameraFile again = readCamera(load(text, "the file written"), kReading);
      CHECK(again.convention == convention);
      CHECK(again.worldIsEcef == camera.worldIsEcef);
      // A matrix of another convention has other entries, each rounded; all else is the same numbers.
      const bool isOther = document["projection"].contains("matrix") && convention != camera.convention;
      CHECK(apart(camera, again, [](const Vec3& p) { return p; }) <= (isOther ? 1e-9 : 0));
      for (const auto& [name, value] : document.items()) ++forms[name];
      ++forms[document["projection"]["type"]];
    }
  for (const char* form : {"target", "direction", "rotation", "euler", "worldFromCamera", "cameraFromWorld", "heading",
                           "matrix", "ps2", "perspective", "frustum", "intrinsics", "orthographic"}) {
    INFO(form);
    CHECK(forms[form] > 0);
  }
}

TEST_CASE("A camera for another world shows its points at the same pixels") {
  int mirrored = 0;
  for (const CameraFile& camera : allCameras())
    for (const AxisMap& map :
         {AxisMap{}, AxisMap{{0, 1, 2}, {1, 1, -1}}, AxisMap{{2, 0, 1}, {-1, 1, 1}}, AxisMap{{2, 1, 0}, {1, 1, 1}}}) {
      const double scale = map == AxisMap{} ? 3 : 100;
      const CameraFile again = readCamera(mapped(camera, map, scale), kReading);
      const std::string text = writeCamera(again, *readConvention(again.document).preset, again.convention);
      INFO(camera.name << "\n" << text);
      mirrored += again.convention.world != camera.convention.world;
      const double pixels = apart(camera, readCamera(load(text, "the file written"), kReading), [&](const Vec3& p) {
        Vec3 moved;
        for (std::size_t i = 0; i < 3; ++i) moved[i] = scale * map.signs[i] * p[map.from[i]];
        return moved;
      });
      const Vec3 eye = camera.pose->eye();
      const double away = 1 + std::max({std::fabs(eye.x), std::fabs(eye.y), std::fabs(eye.z)});
      CHECK(pixels <= 1e-9 + 4e-12 * away);
    }
  CHECK(mirrored > 50);
}
