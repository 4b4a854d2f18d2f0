// cameras.sfm of Meshroom, whose numbers are texts and whose rotations are by columns. Source: AliceVision, the reader
// of sfmDataIO/jsonIO.cpp, for each version of the file.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "formats/format.hpp"
#include "formats/value.hpp"

namespace viewproj::cmd {
namespace meshroom {

std::string textAt(const Node& node, std::string_view key) {
  const auto member = node.json().is_object() ? node.find(key) : std::nullopt;
  if (!member) return "";
  member->mark();
  return member->json().is_string() ? member->json().get<std::string>() : member->json().dump();
}

double numberAt(const Node& node, std::string_view key, double otherwise) {
  const auto member = node.find(key);
  return member ? numberOf(*member) : otherwise;
}

/// The items of a list by one of their members.
std::map<std::string, Node> byId(const Node& root, std::string_view list, std::string_view id) {
  std::map<std::string, Node> nodes;
  const Node items = root.require(list);
  for (std::size_t i = 0; i < items.size(); ++i) nodes.emplace(textAt(items[i], id), items[i]);
  return nodes;
}

Json lensOfIntrinsic(const Node& intrinsic, std::array<double, 2>& focal) {
  const auto params = intrinsic.find("distortionParams");
  const std::vector<double> k = params && !params->json().empty() ? numbersOf(*params) : std::vector<double>{};
  if (std::all_of(k.begin(), k.end(), [](double n) { return n == 0; })) return nullptr;
  std::string type = textAt(intrinsic, "distortionType");
  if (type.empty()) type = textAt(intrinsic, "type");  // before 1.2.8
  const auto requireCount = [&](std::size_t count) {
    if (k.size() != count)
      params->fail("expected " + std::to_string(count) + " numbers of " + type + ", got " + std::to_string(k.size()));
  };
  if (type == "radialk1" || type == "radial1") {
    requireCount(1);
    return lensOf(*params, "radial", k);
  }
  if (type == "brown") {
    requireCount(5);
    return lensOf(*params, "brown", std::vector{k[0], k[1], k[3], k[4], k[2]});
  }
  if (type == "fisheye" || type == "fisheye4") {
    requireCount(4);
    return lensOf(*params, "fisheye", k);
  }
  if (type != "radialk3" && type != "radial3" && type != "radialk3pt")
    params->fail("is of a lens of the type " + type + ", which is not supported");
  requireCount(3);
  if (type != "radialk3pt") return lensOf(*params, "brown", std::vector{k[0], k[1], 0., 0., k[2]});
  const double scale = 1 + k[0] + k[1] + k[2];
  for (double& f : focal) f *= scale;
  return lensOf(*params, "brown", std::vector{k[0] / scale, k[1] / scale, 0., 0., k[2] / scale});
}

Json cameraOf(const Node& intrinsic, const std::array<double, 3>& version) {
  const double w = numberAt(intrinsic, "width", 0), h = numberAt(intrinsic, "height", 0),
               ratio = numberAt(intrinsic, "pixelRatio", 1);
  const auto isFrom = [&](const std::array<double, 3>& first) { return version >= first; };
  std::array<double, 2> focal{};
  if (isFrom({1, 2, 2})) {
    const double f = numberAt(intrinsic, "focalLength", 0) * w / numberAt(intrinsic, "sensorWidth", 36);
    focal = {f, f};
    if (isFrom({1, 2, 11}))
      focal[0] = f / ratio;
    else if (isFrom({1, 2, 5}))
      focal[1] = f * ratio;
    else
      focal[1] = f / ratio;
    if (isFrom({1, 2, 11}) && h > w)
      intrinsic.fail("is of a portrait picture: programs do not agree on its focalLength");
  } else {
    const std::vector<double> f = numbersOf(intrinsic.require("pxFocalLength"));
    focal = {f.front(), f.back()};
  }
  const auto point = intrinsic.find("principalPoint");
  std::vector<double> center = point ? numbersOf(*point, 2) : std::vector<double>{0, 0};
  if (isFrom({1, 2, 1})) center = {center[0] + w / 2, center[1] + h / 2};
  Json lens = lensOfIntrinsic(intrinsic, focal);
  Json camera = pinholeCamera(std::array{focal[0], focal[1], center[0], center[1]}, std::array{w, h});
  if (!lens.is_null()) camera["distortion"] = std::move(lens);
  return camera;
}

Import open(const Node& root) {
  const auto stated = root.find("version");
  const std::vector<double> v = stated ? numbersOf(*stated, 3) : std::vector<double>{1, 2, 11};
  const std::array<double, 3> version{v[0], v[1], v[2]};
  const std::map<std::string, Node> intrinsics = byId(root, "intrinsics", "intrinsicId"),
                                    poses = byId(root, "poses", "poseId");
  const Node views = root.require("views");
  std::vector<Node> list;
  Import result;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Node view = views[i];
    if (!poses.contains(textAt(view, "poseId"))) continue;
    const std::string path = textAt(view, "path"), id = textAt(view, "viewId");
    result.cameras.push_back({path.empty() ? id : path.substr(path.find_last_of("/\\") + 1), id});
    list.push_back(view);
  }
  result.document = [=](std::size_t which) {
    const Node& view = list[which];
    const auto intrinsic = intrinsics.find(textAt(view, "intrinsicId"));
    if (intrinsic == intrinsics.end()) view.fail("is of an intrinsic that is not in the file");
    Json camera = cameraOf(intrinsic->second, version);
    const Node transform = poses.find(textAt(view, "poseId"))->second.require("pose").require("transform");
    const std::vector<double> r = numbersOf(transform.require("rotation"), 9),
                              c = numbersOf(transform.require("center"), 3);
    setPose(camera, "cameraFromWorld",
            {{"rotation", {{r[0], r[3], r[6]}, {r[1], r[4], r[7]}, {r[2], r[5], r[8]}}}, {"translation", {0, 0, 0}}});
    camera["position"] = c;
    return camera;
  };
  return result;
}  // namespace meshroom

}  // namespace meshroom

extern const Format kMeshroom{"meshroom", "a cameras.sfm of Meshroom", "views:list intrinsics:list poses:list",
                              meshroom::open, "*"};

}  // namespace viewproj::cmd
