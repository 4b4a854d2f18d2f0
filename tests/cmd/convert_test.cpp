// Cameras as files of other programs: what is written reads back to the same pixels.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "formats/open.hpp"
#include "formats/writer.hpp"
#include "random.hpp"
#include "text/json_text.hpp"
#include "viewproj/screen.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

/// A folder that is removed at the end.
struct Folder {
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("viewproj-convert-" + std::to_string(::getpid()));
};

bool has(const Writer& writer, std::uint32_t place) { return (writer.places & place) != 0; }

/// A lens that the form has a place for; null: none.
Json randomLens(Random& random, const Writer& writer) {
  const auto n = [&](double size) { return random.uniform(-size, size); };
  constexpr std::uint32_t kLenses[] = {kBrownPlace,        kRationalPlace, kFisheyePlace, kUnifiedPlace,
                                       kDoubleSpherePlace, kOmniPlace,     kFovPlace};
  const std::uint32_t lens = random.oneOf(kLenses);
  if (random.oneIn(4) || !has(writer, lens)) return nullptr;
  switch (lens) {
    case kBrownPlace: {
      Json brown{{"model", "brown"}, {"k", {n(0.2), n(0.1)}}, {"p", {n(0.002), n(0.002)}}};
      if (has(writer, kK3Place) && random.coin()) brown["k"].push_back(n(0.05));
      return brown;
    }
    case kRationalPlace:
      return {
          {"model", "brown"}, {"k", {n(0.2), n(0.1), n(0.05), n(0.2), n(0.1), n(0.05)}}, {"p", {n(0.002), n(0.002)}}};
    case kFisheyePlace:
      return {{"model", "fisheye"}, {"k", {n(0.05), n(0.02), n(0.01), n(0.001)}}};
    case kUnifiedPlace:
      return {{"model", "unified"}, {"alpha", random.uniform(0.1, 0.8)}, {"beta", random.uniform(0.7, 1.4)}};
    case kDoubleSpherePlace:
      return {{"model", "double-sphere"}, {"xi", n(0.4)}, {"alpha", random.uniform(0.3, 0.7)}};
    case kOmniPlace:
      return {{"model", "omni"}, {"xi", random.uniform(0.2, 2)}, {"k", {n(0.2), n(0.1)}}, {"p", {n(0.002), n(0.002)}}};
    default:
      return {{"model", "fov"}, {"omega", random.uniform(0.3, 1.4)}};
  }
}

/// Some poses are matrices of few digits, which are no exact rotations.
Json randomPose(Random& random, const Writer& writer) {
  const Vec3 eye = random.vector(10);
  std::vector<double> q;
  for (int i = 0; i < 4; ++i) q.push_back(random.uniform(-1, 1));
  const Json place{eye.x, eye.y, eye.z};
  if (random.oneIn(4)) return {{"position", place}, {"target", {0, 0, 0}}, {"up", {q[0], q[1], q[2]}}};
  if (random.oneIn(3)) return {{"position", place}, {"rotation", q}};
  if (!has(writer, kQuaternions) && writer.name != "kitti" && random.coin()) {
    const Pose pose = poseFromRotation(eye, {q[0], q[1], q[2], q[3]}, CameraAxes::RUB);
    Json rows = Json::array();
    for (std::size_t i = 0; i < 3; ++i) {
      rows.push_back({pose.right()[i], pose.up()[i], -pose.forward()[i], eye[i]});
      for (Json& entry : rows.back()) entry = std::round(entry.get<double>() * 1e5) / 1e5;
    }
    return {{random.coin() ? "cameraFromWorld" : "worldFromCamera", rows}, {"cameraAxes", "RUB"}};
  }
  return {{random.coin() ? "cameraFromWorld" : "worldFromCamera", {{"rotation", q}, {"translation", place}}}};
}

/// A camera that the form can say all of.
Json randomCamera(Random& random, const Writer& writer, std::size_t number) {
  const double w = 64 + static_cast<double>(random.below(4000)), h = 64 + static_cast<double>(random.below(3000));
  Json camera{{"convention", random.coin()   ? "opengl"
                             : random.coin() ? "opencv"
                                             : "vulkan"},
              {"viewport", {{"width", w}, {"height", h}}}};
  if (random.coin()) camera["viewport"]["pixelCenter"] = random.coin() ? 0 : 0.5;
  Json& projection = camera["projection"];
  const bool isOffCentre = has(writer, kOffCentrePlace),
             isOrthographic = has(writer, kOrthographicPlace) && random.oneIn(4);
  if (isOrthographic) {
    projection = {{"type", "orthographic"}, {"height", random.uniform(0.5, 20)}};
    if (isOffCentre && random.coin()) projection["shift"] = {random.uniform(-1, 1), random.uniform(-1, 1)};
  } else if (isOffCentre && random.coin()) {
    const double f = random.uniform(0.4, 2) * w;
    projection = {{"type", "intrinsics"},
                  {"fx", f},
                  {"fy", has(writer, kShapePlace) ? f * random.uniform(0.9, 1.1) : f},
                  {"cx", random.uniform(0.3, 0.7) * w},
                  {"cy", random.uniform(0.3, 0.7) * h}};
  } else {
    projection = {{"type", "perspective"}, {random.coin() ? "fovX" : "fovY", random.uniform(20, 100)}};
    if (isOffCentre && random.coin()) projection["shift"] = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
  }
  if (has(writer, kNeedsNear) || isOrthographic || random.coin()) projection["near"] = random.uniform(0.01, 0.2);
  if (has(writer, kNeedsFar) || isOrthographic || random.coin()) projection["far"] = random.uniform(50, 500);
  // The file's K of the origin: right, down, forward.
  if (has(writer, kStereoPosePlace) && random.coin())
    camera.update({{"worldFromCamera",
                    {{"rotation", {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 1}},
                     {"translation", {random.uniform(-1, 1), random.uniform(-1, 1), 0}}}},
                   {"cameraAxes", "RDF"}});
  else if (has(writer, kPosePlace) && !random.oneIn(6))
    camera.update(randomPose(random, writer));
  else
    camera.update({{"position", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}, {"cameraAxes", "RDF"}});
  if (!isOrthographic)
    if (Json lens = randomLens(random, writer); !lens.is_null()) camera["distortion"] = std::move(lens);
  if (has(writer, kNamePlace) && !random.oneIn(4)) camera["name"] = "left/" + std::to_string(number) + ".jpg";
  if (writer.name == "tum") camera["name"] = std::to_string(number) + ".25";
  return camera;
}

/// The written files, where openCameras finds them.
std::string write(const Folder& folder, const Writer& writer, std::span<const WrittenCamera> cameras,
                  std::string_view ending) {
  for (const WrittenFile& file : writer.write(cameras, ending))
    std::ofstream(folder.path / (file.name.empty() ? "camera" + std::string(ending) : file.name), std::ios::binary)
        << file.text;
  return has(writer, 0) || writer.name == "colmap" ? folder.path.string()
                                                   : (folder.path / ("camera" + std::string(ending))).string();
}

/// What a file does not say is typed beside it.
CameraPatches patchesOf(const Writer& writer, const WrittenCamera& camera) {
  CameraPatches patches;
  if (!has(writer, kSizePlace)) patches.patches = viewportPatches(camera.width(), camera.height());
  return patches;
}

constexpr double kMostPixels = 1e-9, kMostDepth = 1e-12;

}  // namespace

TEST_CASE("what is written reads back to the same pixels") {
  std::map<std::string, int> points, lenses;
  for (const Writer& writer : writers())
    for (std::uint64_t trial = 0; trial < 120; ++trial) {
      CAPTURE(writer.name, trial);
      Random random(trial);
      const Folder folder;
      const std::size_t most = writer.name == "kitti" ? 4 : has(writer, kSeveralPlace) ? 3 : 1;
      const bool isEachAlone = has(writer, kStereoPosePlace);  // in a file
      const std::size_t count = isEachAlone ? 1 : 1 + random.below(std::min(most, writer.most));
      const bool isStereo = writer.name == "opencv" && count == 2;
      std::vector<WrittenCamera> cameras;
      const Json first = randomCamera(random, writer, 0);
      for (std::size_t i = 0; i < count; ++i) {
        Json json = i == 0 ? first : randomCamera(random, writer, i);
        // Files without a size have one that is typed for all; and lenses may be shared.
        if (!has(writer, kSizePlace) || random.oneIn(3))
          for (const char* member : {"viewport", "projection", "convention", "distortion"})
            if (json.erase(member); first.contains(member)) json[member] = first[member];
        // Two cameras of OpenCV have one size, the first one's world, and lenses that need no name.
        if (isStereo) {
          json["viewport"] = first["viewport"];
          if (json.contains("distortion") && json["distortion"]["model"] != "brown") json.erase("distortion");
          for (const char* member : {"target", "up", "worldFromCamera", "cameraFromWorld"})
            if (i == 0) json.erase(member);
          if (i == 0) json.update({{"position", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}, {"cameraAxes", "RDF"}});
        }
        cameras.emplace_back(readCamera({"camera", std::make_shared<Json>(json)}, {}), json.value("name", ""), i);
      }
      REQUIRE_NOTHROW(requirePlaces(cameras, writer));
      constexpr std::string_view kEndings[] = {".yml", ".json", ".xml"};
      const std::string file =
          write(folder, writer, cameras, writer.name == "opencv" ? random.oneOf(kEndings) : std::string_view(".out"));
      const bool isOnImu = writer.name == "kalibr" && !cameras.front().isAtOrigin();
      Opening opening{.option = "FILE"};
      if (isOnImu) opening.pick = "imu/*";
      opening.takesAll = isEachAlone;
      if (has(writer, kPosesAlone)) {
        opening.poses = {file};
        opening.direction = "worldFromCamera";
      }
      const auto set = has(writer, kPosesAlone) ? openPoses(opening, {})
                                                : openCameras(file, opening, patchesOf(writer, cameras.front()));
      const std::size_t other = isEachAlone ? *set->find("stereo") : 0;
      if (!isEachAlone) REQUIRE(set->size() == count);
      for (std::size_t i = 0; i < count; ++i) {
        const CameraFile back = readCamera(set->document(i + other), {.allowStretch = true});
        const CameraFile& given = cameras[i].file;
        const bool isNamed = has(writer, kSeveralPlace) && !isEachAlone && !(has(writer, kPosesAlone) && count == 1);
        if (isNamed && has(writer, kNamePlace) && !cameras[i].name.empty()) CHECK(set->nameOf(i) == cameras[i].name);
        const Camera from = makeCamera(given);
        const Camera to = [&] {
          if (!has(writer, kPosesAlone)) return makeCamera(back);
          const Camera pinhole = makeCamera(*back.pose, *given.projection, *given.viewport, given.convention);
          return given.lens ? withLens(pinhole, *given.lens) : pinhole;
        }();
        const double shift = to.viewport().pixelCenter - from.viewport().pixelCenter;
        for (int n = 0; n < 12; ++n) {
          const Vec2 pixel{random.uniform(0, cameras[i].width()), random.uniform(0, cameras[i].height())};
          const Ray ray = screenToRay(from, pixel);
          if (!(std::isfinite(ray.direction.x))) continue;
          const double distance = random.logUniform(0.1, 100);
          const Vec3 point{ray.origin.x + distance * ray.direction.x, ray.origin.y + distance * ray.direction.y,
                           ray.origin.z + distance * ray.direction.z};
          const ScreenPoint a = worldToScreen(from, point), b = worldToScreen(to, point);
          CHECK(std::fabs(b.x - shift - a.x) <= kMostPixels);
          CHECK(std::fabs(b.y - shift - a.y) <= kMostPixels);
          if (has(writer, kNearPlace))
            CHECK((std::fabs(a.depth - b.depth) <= kMostDepth || (std::isnan(a.depth) && std::isnan(b.depth))));
          ++points[std::string(writer.name)];
          if (given.lens)
            ++lenses[std::string(writer.name) + " " + std::to_string(static_cast<int>(given.lens->model()))];
        }
      }
    }
  for (const Writer& writer : writers()) CHECK(points[std::string(writer.name)] > 1000);
  for (const auto& [name, visited] : lenses) {
    CAPTURE(name, visited);
    CHECK(visited > 50);
  }
  CHECK(lenses.size() == 23);  // forms and their lenses
}
