// cameras.json of 3D Gaussian splatting. Source: graphdeco-inria/gaussian-splatting, camera_to_JSON.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/importers/importer.hpp"

namespace viewproj::cmd {
namespace splats {

bool recognises(const Json& root) {
  return root.is_array() && !root.empty() && root[0].is_object() && root[0].contains("img_name") &&
         root[0].contains("position") && root[0].contains("rotation");
}

Json documentOf(const Node& camera) {
  const double width = camera.require("width").number(), height = camera.require("height").number();
  const std::vector<double> r = camera.require("rotation").numbers(9);
  return {{"convention", "opencv"},
          {"worldFromCamera",
           {{"rotation", {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}}},
            {"translation", camera.require("position").numbers(3)}}},
          {"projection",
           {{"type", "intrinsics"},
            {"fx", camera.require("fx").number()},
            {"fy", camera.require("fy").number()},
            {"cx", width / 2},
            {"cy", height / 2},
            {"pixels", {width, height}}}},
          {"viewport", {{"width", width}, {"height", height}, {"pixelCenter", 0.5}}}};
}

std::string textOf(const Json& camera, const char* key) {
  const Json value = camera.is_object() ? camera.value(key, Json()) : Json();
  return value.is_string() ? value.get<std::string>() : value.is_number() ? value.dump() : "";
}

Import open(const Node& root) {
  Import result;
  for (const Json& camera : root.json()) result.cameras.push_back({textOf(camera, "img_name"), textOf(camera, "id")});
  result.document = [root](std::size_t which) { return documentOf(root[which]); };
  return result;
}

}  // namespace splats

extern const Importer kSplats{"3dgs", "a cameras.json of 3D Gaussian splatting", splats::recognises, splats::open};

}  // namespace viewproj::cmd
