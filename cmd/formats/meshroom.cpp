// cameras.sfm of Meshroom, whose numbers are texts and whose rotations are by columns. Source: AliceVision, the reader
// of sfmDataIO/jsonIO.cpp, for each version of the file.
#include <map>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"

namespace viewproj::cmd {
namespace meshroom {

/// The items of a list by one of their members.
std::map<std::string, Node> byId(const Node& root, std::string_view list, std::string_view id) {
  std::map<std::string, Node> nodes;
  for (const Node& item : itemsAt(root, list)) nodes.emplace(textAt(item, id), item);
  return nodes;
}

struct Lens {
  std::string_view types;  ///< those of before 1.2.8 too
  std::string_view model;
  std::size_t count;
};
constexpr Lens kLenses[] = {{"radialk1 radial1", "radial", 1},
                            {"brown", "brown", 5},
                            {"fisheye fisheye4", "fisheye", 4},
                            {"radialk3 radial3 radialk3pt", "brown", 3}};

/// Sets the lens of a camera with these focal lengths, one form of which scales them.
void readLens(const Node& intrinsic, Json& camera) {
  const auto params = intrinsic.find("distortionParams");
  std::vector<double> k;
  for (const Node& each : itemsAt(intrinsic, "distortionParams")) k.push_back(numberOf(each));
  std::string type = textAt(intrinsic, "distortionType");
  if (type.empty()) type = textAt(intrinsic, "type");
  const bool isFisheye = hasWord(type, "fisheye fisheye4 equidistant");
  if (areZero(k) && !isFisheye) return;
  const auto* const lens =
      std::find_if(std::begin(kLenses), std::end(kLenses), [&](const Lens& each) { return isAmong(type, each.types); });
  const Node& at = params ? *params : intrinsic;
  if (lens == std::end(kLenses)) at.fail("is of a lens of the type " + type + ", which is not supported");
  if (k.empty()) k.resize(lens->count);
  if (k.size() != lens->count)
    at.fail("expected " + std::to_string(lens->count) + " numbers of " + type + ", got " + std::to_string(k.size()));
  if (type == "radialk3pt") {
    const double scale = 1 + k[0] + k[1] + k[2];
    for (const char* focal : {"fx", "fy"})
      camera["projection"][focal] = camera["projection"][focal].get<double>() * scale;
    for (double& coefficient : k) coefficient /= scale;
  }
  const bool isTangential = lens->count > 3;
  if (lens->model == "brown") k = {k[0], k[1], isTangential ? k[3] : 0, isTangential ? k[4] : 0, k[2]};
  setLens(camera, at, lens->model, k);
}

using Version = std::array<double, 3>;

Json cameraOf(const Node& intrinsic, const Version& version) {
  const double w = numberAt(intrinsic, "width"), h = numberAt(intrinsic, "height"),
               ratio = numberAt(intrinsic, "pixelRatio", 1);
  std::array<double, 2> focal{};
  if (version >= Version{1, 2, 2}) {
    const double f = numberAt(intrinsic, "focalLength") * w / numberAt(intrinsic, "sensorWidth", 36);
    focal = version >= Version{1, 2, 11}  ? std::array{f / ratio, f}
            : version >= Version{1, 2, 5} ? std::array{f, f * ratio}
                                          : std::array{f, f / ratio};
    if (version >= Version{1, 2, 11} && h > w)
      intrinsic.fail("is of a portrait picture: programs do not agree on its focalLength");
  } else {
    const std::vector<double> f = numbersOf(intrinsic.require("pxFocalLength"));
    focal = {f.front(), f.back()};
  }
  const auto point = intrinsic.find("principalPoint");
  std::vector<double> center = point ? numbersOf(*point, 2) : std::vector<double>{0, 0};
  if (version >= Version{1, 2, 1}) center = {center[0] + w / 2, center[1] + h / 2};
  Json camera = pinholeCamera(std::array{focal[0], focal[1], center[0], center[1]}, std::array{w, h});
  readLens(intrinsic, camera);
  return camera;
}

Import open(const Node& root) {
  const auto stated = root.find("version");
  const std::vector<double> v = stated ? numbersOf(*stated, 3) : std::vector<double>{1, 2, 11};
  const Version version{v[0], v[1], v[2]};
  const std::map<std::string, Node> intrinsics = byId(root, "intrinsics", "intrinsicId"),
                                    poses = byId(root, "poses", "poseId");
  refuse(root, "rigs", "has poses of rigs, which are not those of their cameras, and are not supported");
  Import result;
  for (const Node& view : itemsAt(root, "views")) {
    const std::string path = textAt(view, "path"), id = textAt(view, "viewId");
    const std::string name = path.empty() ? id : path.substr(path.find_last_of("/\\") + 1);
    const auto pose = poses.find(textAt(view, "poseId"));
    if (pose == poses.end()) {
      result.withoutPose.push_back(name);
      continue;
    }
    const auto intrinsic = intrinsics.find(textAt(view, "intrinsicId"));
    const std::optional<Node> lens = intrinsic == intrinsics.end() ? std::nullopt : std::optional(intrinsic->second);
    result.add(name, id, [view, lens, pose = pose->second, version] {
      if (!lens) view.fail("is of an intrinsic that is not in the file");
      Json camera = cameraOf(*lens, version);
      const Node transform = pose.require("pose").require("transform");
      const std::vector<double> r = transposed(numbersOf(transform.require("rotation"), 9), 3);
      setPose(camera, "cameraFromWorld", {{"rotation", rowsOf(r, 3)}, {"translation", {0, 0, 0}}});
      camera["position"] = numbersOf(transform.require("center"), 3);
      return camera;
    });
  }
  return result;
}

}  // namespace meshroom

extern const Format kMeshroom{"meshroom", "a cameras.sfm of Meshroom", "views:list intrinsics:list poses",
                              meshroom::open, "*"};

}  // namespace viewproj::cmd
