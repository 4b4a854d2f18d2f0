// Every camera of the samples and of the transcripts, written as a camera file, in every convention and for other
// worlds, and read again: the same pixels.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "camera/change_camera.hpp"
#include "camera/plain_camera.hpp"
#include "camera/write_camera.hpp"
#include "catch.hpp"
#include "formats/open.hpp"
#include "random.hpp"
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
    cameras.push_back(completed(openCameras(text, {.option = "FILE"}, {})->document(0)));
  }
  for (const char* folder : {"samples", "tests/cmd/transcripts"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::string(VIEWPROJ_SAMPLES "/../") + folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".json" && ending != ".gltf" && ending != ".yaml" && ending != ".yml" && ending != ".txt") continue;
      try {
        const auto set = openCameras(entry.path().string(), {.option = "FILE"}, {});
        for (std::size_t i = 0; i < set->size(); ++i) cameras.push_back(completed(set->document(i)));
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
      const std::string text = writeCamera(again, *again.preset, again.convention);
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

namespace {

double lengthOf(const Vec3& v) { return std::hypot(v.x, v.y, v.z); }
double apart(const Vec3& a, const Vec3& b) { return lengthOf({a.x - b.x, a.y - b.y, a.z - b.z}); }

/// The names of what orients the camera.
std::vector<std::string> poseForm(const Document& document) {
  std::vector<std::string> names;
  for (const Field& field : kFields)
    if (field.group == Group::pose && field.path != "up" && valueAt(*document.root, field.path))
      names.emplace_back(field.path);
  return names;
}

/// The second document, made of the first by the values that --set would have.
Document bySets(const Document& from, const Document& to) {
  std::vector<Patch> patches;
  for (const std::string& text : setsBetween(from, to)) patches.push_back(setPatch(text));
  Document made = copied(from);
  applyPatches(made, patches);
  return made;
}

}  // namespace

TEST_CASE("A camera that is given a pose has it, in the form that it had, and --set gives the same") {
  std::map<std::string, int> forms;
  const std::vector<CameraFile> cameras = allCameras();
  for (std::size_t i = 0; i < cameras.size(); ++i)
    for (std::uint64_t trial = 0; trial < 6; ++trial) {
      const CameraFile& camera = cameras[i];
      Random random(100 * i + trial);
      const Vec3 old = camera.pose->eye();
      const double size = camera.worldIsEcef ? 1000 : 10;
      const Vec3 by = random.vector(size), look = random.direction(), up = random.direction();
      const Vec3 eye{old.x + by.x, old.y + by.y, old.z + by.z};
      const PlainPose pose = plainPose(lookAlong(eye, look, up, camera.convention.world));
      const Document changed = withPose(camera, pose);
      INFO(camera.name << " " << camera.document.root->dump() << "\n" << changed.root->dump());
      for (const Document& document : {changed, bySets(camera.document, changed)}) {
        const Pose again = *readCamera(copied(document), kReading).pose;
        CHECK(apart(again.eye(), eye) <= (camera.worldIsEcef ? 2e-8 : 1e-12 * (1 + lengthOf(eye))));
        CHECK(apart(again.right(), pose.right) <= 1e-12);
        CHECK(apart(again.up(), pose.up) <= 1e-12);
        CHECK(apart(again.forward(), pose.forward) <= 1e-12);
      }
      const Json* const target = valueAt(*camera.document.root, "target");
      const bool becomesHeading = target && target->contains("lat");
      if (!becomesHeading && !valueAt(*camera.document.root, "heading"))
        CHECK(poseForm(changed) == poseForm(camera.document));
      for (const std::string& name : poseForm(changed)) ++forms[name];
    }
  for (const char* form :
       {"target", "direction", "rotation", "euler", "worldFromCamera", "cameraFromWorld", "heading"}) {
    INFO(form);
    CHECK(forms[form] > 0);
  }
}

TEST_CASE("Euler angles of every order give the pose, straight up and down too") {
  for (const auto& [order, as] : kEulerOrders) {
    const bool isLeft = as.cameraAxes == CameraAxes::FRU;
    const std::string convention = isLeft ? "unreal" : "opengl";
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
      const CameraFile camera =
          readCamera(openCameras(R"({"convention": ")" + convention +
                                     R"(", "position": [1, 2, 3], "euler": {"order": ")" + std::string(order) +
                                     R"(", "degrees": [10, 20, 30]}, "projection": {"type": "perspective", "fovY": 60},
                          "viewport": {"width": 2, "height": 2}})",
                                 {.option = "C"}, {})
                         ->document(0),
                     {});
      Random random(trial);
      const bool isQuarter = trial % 4 == 0;  // the middle turn is at its pole in some orders
      const auto angle = [&] {
        return isQuarter ? 90.0 * std::floor(random.uniform(-2, 3)) : random.uniform(-180, 180);
      };
      const std::array<Turn, 3> turns{{{0, angle()}, {1, angle()}, {2, angle()}}};
      const PlainPose pose = plainPose(poseFromTurns({4, 5, 6}, turns, isLeft ? CameraAxes::RUF : CameraAxes::RUB));
      const Document changed = withPose(camera, pose);
      INFO(changed.root->dump());
      const Pose again = *readCamera(copied(changed), {}).pose;
      CHECK(apart(again.right(), pose.right) <= 1e-14);
      CHECK(apart(again.forward(), pose.forward) <= 1e-14);
    }
  }
}

TEST_CASE("A camera that is given fx, fy, cx, cy, near and far has them, and --set gives the same") {
  std::map<std::string, int> kept, others;
  for (const CameraFile& camera : allCameras()) {
    const Camera before = makeCamera(camera);
    if (before.projection().isOrthographic()) continue;
    const Intrinsics k = before.intrinsics();
    const double near = before.projection().zNear(), far = before.projection().zFar();
    const std::string type = (*camera.document.root)["projection"]["type"];
    const std::pair<Intrinsics, double> rows[] = {{{1.25 * k.fx, 1.25 * k.fy, k.cx, k.cy}, near},
                                                  {{k.fx, 1.1 * k.fy, k.cx, k.cy}, near},
                                                  {{k.fx, k.fy, k.cx + 7, k.cy - 3}, near == 0 ? 0 : near / 2}};
    for (const auto& [wanted, zNear] : rows) {
      if (type == "ps2" && wanted.cx != k.cx) continue;
      const Document changed = withProjection(camera, frameProjection(camera, wanted, zNear, far));
      INFO(camera.name << " " << camera.document.root->dump() << "\n" << changed.root->dump());
      for (const Document& document : {changed, bySets(camera.document, changed)}) {
        const Camera again = makeCamera(readCamera(copied(document), kReading));
        const Intrinsics found = again.intrinsics();
        CHECK(found.fx == Approx(wanted.fx).epsilon(1e-12));
        CHECK(found.fy == Approx(wanted.fy).epsilon(1e-12));
        CHECK(found.cx == Approx(wanted.cx).margin(1e-9));
        CHECK(found.cy == Approx(wanted.cy).margin(1e-9));
        CHECK(again.projection().zNear() == Approx(zNear).epsilon(1e-12));
        CHECK((again.projection().zFar() == far || again.projection().zFar() == Approx(far).epsilon(1e-9)));
      }
      ++((*changed.root)["projection"]["type"] == type ? kept : others)[type];
    }
  }
  for (const char* form : {"matrix", "ps2", "perspective", "frustum", "intrinsics"}) {
    INFO(form);
    CHECK(kept[form] > 0);
  }
  CHECK(others["perspective"] > 0);
  CHECK(others["intrinsics"] + others["frustum"] + others["matrix"] == 0);
}

TEST_CASE("An orthographic camera that is given a window has it") {
  for (const char* const size :
       {R"("width": 4, "height": 2)", R"("height": 2)", R"("left": -1, "right": 3, "bottom": -1, "top": 1)"})
    for (const auto& [wanted, keeps] :
         {std::pair(orthographic(-4, 4, -2, 2, 1, 9), true),
          {orthographic(-1, 3, -1, 1, -2, 9), std::string_view(size).starts_with("\"l")}}) {
      const CameraFile camera =
          readCamera(load(R"({"position": [0, 0, 0], "direction": [0, 0, 1], "viewport": {"width": 20, "height": 10},
                              "projection": {"type": "orthographic", "near": 1, "far": 9, )" +
                              std::string(size) + "}}",
                          "C"),
                     {});
      const Document changed = withProjection(camera, wanted);
      INFO(changed.root->dump());
      const Projection again = *readCamera(copied(changed), {}).projection;
      for (const auto side : {&Projection::left, &Projection::right, &Projection::bottom, &Projection::top,
                              &Projection::zNear, &Projection::zFar})
        CHECK((again.*side)() == (wanted.*side)());
      CHECK(((*changed.root)["projection"].contains("left") == std::string_view(size).starts_with("\"l")) == keeps);
    }
}
