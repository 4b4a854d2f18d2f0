// glTF 2.0: cameras stand on nodes, and a node's transform is relative to its parent's.
// Source: glTF 2.0 specification, "Nodes and Hierarchy" and "Cameras".
#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "camera/camera.hpp"
#include "input/importers/importer.hpp"
#include "input/placement.hpp"
#include "numbers/radians.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

bool recognises(const nlohmann::json& root) {
  const auto asset = root.find("asset");
  return asset != root.end() && asset->is_object() && asset->contains("version");
}

struct Gltf {
  ObjectReader root;
  ObjectList nodes, cameras;
  std::vector<std::size_t> cameraNodes;  ///< nodes that have a camera

  explicit Gltf(const Document& document) : root(document, document.root(), {}) {
    const std::string version = root.object("asset")->string("version").value_or("");
    if (!version.starts_with("2.")) root.object("asset")->fail("version", "is not read: only glTF 2");
    nodes = root.objects("nodes");
    cameras = root.objects("cameras");
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].has("camera")) cameraNodes.push_back(i);
    if (!cameraNodes.empty()) return;
    if (cameras.empty()) root.fail("has no cameras");
    root.fail("cameras", "stand on no node: none says where one is");
  }

  /// Of one of cameraNodes. Throws where there is none of the number.
  ObjectReader cameraOf(std::size_t node) const {
    return cameras[*nodes[node].index("camera", cameras.size(), "cameras")];
  }
};

std::vector<HeldCamera> list(const Document& document) {
  const Gltf gltf(document);
  const auto meanwhile = document.withoutPlaces();
  std::vector<HeldCamera> result;
  for (std::size_t node : gltf.cameraNodes) {
    HeldCamera held;
    held.number = std::to_string(node);
    held.note = "node " + held.number;
    try {
      held.name = gltf.nodes[node].text("name").value_or("");
      const ObjectReader camera = gltf.cameraOf(node);
      held.alias = camera.text("name").value_or("");
      held.kind = camera.text("type").value_or("");
      if (const auto lens = camera.object("perspective"))
        held.note += shortNumbers(*lens, {"yfov", "aspectRatio", "znear", "zfar"});
      else if (const auto box = camera.object("orthographic"))
        held.note += shortNumbers(*box, {"xmag", "ymag", "znear", "zfar"});
    } catch (const InputError& e) {  // reading it says the same
      held.note += ", cannot be read: " + std::string(e.what());
    }
    result.push_back(held);
  }
  return result;
}

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Of each node.
std::vector<std::size_t> parentsIn(const Gltf& gltf) {
  std::vector<std::size_t> parents(gltf.nodes.size(), kNone);
  for (std::size_t i = 0; i < gltf.nodes.size(); ++i)
    for (std::size_t child : gltf.nodes[i].indices("children", gltf.nodes.size(), "nodes")) {
      if (parents[child] != kNone)
        gltf.nodes[i].fail("children", "has node " + std::to_string(child) + ", which is a child of node " +
                                           std::to_string(parents[child]) + " already");
      parents[child] = i;
    }
  return parents;
}

PlacedNode placedNode(const ObjectReader& fields) {
  PlacedNode placed{fields, readColumnMajor(fields, "matrix"), fields.vec3("translation"), fields.vec3("scale"), {}};
  if (const auto q = fields.numbers("rotation", 4, 4)) placed.rotation = Quaternion{(*q)[0], (*q)[1], (*q)[2], (*q)[3]};
  if (placed.matrix && (placed.translation || placed.scale || placed.rotation))
    fields.fail("matrix", "is given beside translation, rotation or scale; one of them is expected");
  return placed;
}

/// The nodes and what each hangs from.
struct Tree {
  Gltf gltf;
  std::vector<std::size_t> parents = parentsIn(gltf);
  std::unordered_map<std::size_t, Chain> chains = {};  ///< to nodes that have others below them, as far as asked for

  /// From the root of the node's tree to the node.
  std::vector<PlacedNode> nodesTo(std::size_t node) const {
    std::vector<PlacedNode> nodes;
    for (std::size_t at = node; at != kNone; at = parents[at]) nodes.push_back(placedNode(gltf.nodes[at]));
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
  }

  Pose poseOf(std::size_t node) {
    const PlacedNode own = placedNode(gltf.nodes[node]);
    struct Link {
      std::size_t node;
      PlacedNode placed;
    };
    std::vector<Link> links;  // from the node's parent on, to what is known
    Chain chain;
    for (std::size_t at = parents[node]; at != kNone; at = parents[at]) {
      if (links.size() == gltf.nodes.size()) gltf.nodes[node].fail("has ancestors that run in a circle");
      if (const auto known = chains.find(at); known != chains.end()) {
        chain = known->second;
        break;
      }
      links.push_back({at, placedNode(gltf.nodes[at])});
    }
    for (auto link = links.rbegin(); link != links.rend(); ++link)
      chain = chains.emplace(link->node, behind(chain, link->placed)).first->second;
    return poseAtEndOf(chain, own, [&] { return nodesTo(node); });
  }
};

Projection readPerspective(const ObjectReader& lens, const std::optional<ReadViewport>& viewport,
                           const CameraReading& reading) {
  const auto ownAspect = lens.number("aspectRatio"), wanted = ownAspect ? ownAspect : reading.aspect;
  const double yfov = lens.requireNumber("yfov");
  const double near = lens.requireNumber("znear");
  const double far = lens.number("zfar").value_or(kInfiniteFar);
  if (ownAspect && !(*ownAspect > 0)) lens.fail("aspectRatio", "must be above 0");
  if (!wanted && !viewport) lens.fail("has no aspectRatio and needs a viewport; --viewport WIDTHxHEIGHT gives one");
  const DoubleDouble halfHeight = tanHalfRadians(yfov);
  if (!(halfHeight.hi > 0)) lens.fail("yfov", "must be an angle between 0 and pi radians");
  const DoubleDouble aspect =
      wanted ? DoubleDouble(*wanted) : DoubleDouble(viewport->frame.width) / DoubleDouble(viewport->frame.height);
  if (ownAspect && viewport && !reading.allowStretch)
    requireShape(aspect, viewport->frame, lens,
                 "take the viewport's with --set " + dotted(lens.path()) + ".aspectRatio=null, ");
  const DoubleDouble halfWidth = halfHeight * aspect;
  return located(lens, {{"near", "znear"}, {"far", "zfar"}},
                 [&] { return perspectiveWindow(-halfWidth, halfWidth, -halfHeight, halfHeight, near, far); });
}

/// xmag and ymag are half the width and half the height.
Projection readOrthographic(const ObjectReader& box, const std::optional<ReadViewport>& viewport,
                            const CameraReading& reading) {
  const double x = box.requireNumber("xmag"), y = box.requireNumber("ymag");
  const double near = box.requireNumber("znear"), far = box.requireNumber("zfar");
  if (!(x > 0)) box.fail("xmag", "must be above 0");
  if (!(y > 0)) box.fail("ymag", "must be above 0");
  if (viewport && !reading.allowStretch) requireShape(DoubleDouble(x) / DoubleDouble(y), viewport->frame, box);
  return located(box, {{"near", "znear"}, {"far", "zfar"}, {"right", "xmag"}, {"top", "ymag"}},
                 [&] { return orthographic(-x, x, -y, y, near, far); });
}

CameraFile read(Tree& tree, std::size_t node, const CameraReading& reading) {
  const Gltf& gltf = tree.gltf;
  const Document& document = gltf.root.document();
  (void)gltf.nodes[node].text("name");
  const ObjectReader camera = gltf.cameraOf(node);
  (void)camera.text("name");
  const auto viewport = importedViewport(document);
  const auto type = camera.string("type").value_or("");
  if (type.empty()) camera.fail("needs a type");
  if (type != "perspective" && type != "orthographic") camera.fail("type", "is neither perspective nor orthographic");
  const auto lens = camera.object(type);
  if (!lens) camera.fail("needs " + type);
  const bool perspective = type == "perspective";
  CameraFile file = imported(
      document, *conventionPreset("opengl"), tree.poseOf(node),
      perspective ? readPerspective(*lens, viewport, reading) : readOrthographic(*lens, viewport, reading), viewport);
  file.tookAspect = perspective && reading.aspect && !lens->number("aspectRatio");
  return file;
}

CameraReader open(const Document& document) {
  return [tree = Tree{Gltf(document)}](std::size_t which, const CameraReading& reading) mutable {
    return read(tree, tree.gltf.cameraNodes[which], reading);
  };
}

}  // namespace

const Importer kGltf{"gltf", "a glTF file", recognises, list, open};

}  // namespace viewproj::cmd
