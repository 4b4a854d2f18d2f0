// glTF 2.0. Source: its specification, "Nodes and Hierarchy" and "Cameras".
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/node_tree.hpp"
#include "formats/writer.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace gltf {

/// An index into a list of this size.
std::size_t indexOf(const Node& node, std::size_t size) {
  const double index = node.number();
  if (!(index >= 0 && index < static_cast<double>(size) && index == std::floor(index)))
    node.fail("expected a whole number from 0 to below " + std::to_string(size));
  return static_cast<std::size_t>(index);
}

void findParents(NodeTree& tree) {
  tree.parents.assign(tree.nodes.size(), NodeTree::kNone);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    for (const Node& child : itemsAt(tree.nodes[i], "children")) {
      std::size_t& parent = tree.parents[indexOf(child, tree.nodes.size())];
      if (parent != NodeTree::kNone) child.fail("is a child of node " + std::to_string(parent) + " too");
      parent = i;
    }
}

Json lensOf(const Node& camera) {
  const std::string& type = camera.require("type").text();
  if (type == "perspective") {
    const Node lens = camera.require(type);
    // Stays in radians, to keep all digits.
    Json result{{"type", type},
                {"fovY", formatNumber(lens.require("yfov").number()) + "rad"},
                {"near", lens.require("znear").number()}};
    if (const auto aspect = lens.find("aspectRatio")) result["aspect"] = aspect->number();
    if (const auto far = lens.find("zfar")) result["far"] = far->number();
    return result;
  }
  if (type != "orthographic") camera.require("type").fail("expected perspective or orthographic");
  const Node lens = camera.require(type);
  return {{"type", type},
          {"width", 2 * lens.require("xmag").number()},
          {"height", 2 * lens.require("ymag").number()},
          {"near", lens.require("znear").number()},
          {"far", lens.require("zfar").number()}};
}

/// The camera without a place.
Json documentOf(const Node& camera) { return {{"convention", "opengl"}, {"projection", lensOf(camera)}}; }

Import open(const Node& root) {
  const Node version = root.require("asset").require("version");
  if (!version.text().starts_with("2.")) version.fail("is not supported; only glTF 2 is");
  const auto cameras = std::make_shared<const std::vector<Node>>(itemsAt(root, "cameras"));
  const auto tree = std::make_shared<NodeTree>("translation", "rotation");
  tree->nodes = itemsAt(root, "nodes");
  findParents(*tree);
  Import result{.ownNames = {{"projection.aspect", "aspectRatio"}}};
  std::vector<bool> hasNode(cameras->size());
  for (std::size_t i = 0; i < tree->nodes.size(); ++i) {
    const Node& node = tree->nodes[i];
    if (node.find("matrix") && node.findAny({"translation", "rotation", "scale"}))
      node.fail("has a matrix beside translation, rotation or scale");
    const auto camera = node.find("camera");
    if (!camera) continue;
    std::string name = stringAt(node, "name");
    if (camera->json().is_number_unsigned() && camera->json() < cameras->size()) {
      hasNode[camera->json()] = true;
      if (name.empty()) name = stringAt((*cameras)[camera->json()], "name");
    }
    result.add(name, std::to_string(i), [cameras, tree, node, i] {
      const std::size_t index = indexOf(node.require("camera"), cameras->size());
      Json document = documentOf((*cameras)[index]);
      tree->addPose(document, i);
      return document;
    });
  }
  for (std::size_t i = 0; i < cameras->size(); ++i) {
    const Node& camera = (*cameras)[i];
    if (!hasNode[i]) result.add(stringAt(camera, "name"), camera.path(), [camera] { return documentOf(camera); });
  }
  return result;
}

}  // namespace gltf

extern const Format kGltf{"gltf", "a glTF file", "asset.version", gltf::open, "*"};

std::vector<WrittenFile> writeGltf(std::span<const WrittenCamera> cameras, std::string_view) {
  std::vector<std::string> numbers, nodes, lenses;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const WrittenCamera& camera = cameras[i];
    const Projection& p = *camera.file.projection;
    const PlainRigid pose = worldFromCamera(camera.pose, CameraAxes::RUB);
    JsonObject node, lens, whole;
    numbers.push_back(std::to_string(i));
    if (!camera.name.empty()) node.add("name", camera.name);
    node.addText("camera", numbers.back());
    const Vec3& t = pose.translation;
    node.addText("translation", jsonListOf(std::array{t.x, t.y, t.z}));
    nodes.push_back(node.addText("rotation", jsonListOf(quaternionOf(pose.columns))).text());
    if (p.isOrthographic())
      lens.add("xmag", p.right()).add("ymag", p.top());
    else
      lens.add("yfov", 2 * std::atan(p.top())).add("aspectRatio", p.aspect());
    lens.add("znear", depthsFor(p).front());
    if (std::isfinite(p.zFar())) lens.add("zfar", p.zFar());
    const char* const type = p.isOrthographic() ? "orthographic" : "perspective";
    lenses.push_back(whole.add("type", type).addText(type, lens.text()).text());
  }
  constexpr std::string_view kLine = ",\n  ", kItem = ",\n    ";
  JsonObject out;
  out.addText("asset", R"({"version": "2.0", "generator": "viewproj"})").addText("scene", "0", kLine);
  out.addText("scenes", R"([{"nodes": )" + jsonList(numbers) + "}]", kLine);
  out.addText("nodes", jsonList(nodes, kItem), kLine).addText("cameras", jsonList(lenses, kItem), kLine);
  return {{"", "{\n  " + out.members() + "\n}\n"}};
}

}  // namespace viewproj::cmd
