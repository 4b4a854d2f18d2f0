// three.js cameras as Object3D.toJSON writes them, alone or in a scene. Formulas: updateProjectionMatrix of
// PerspectiveCamera and OrthographicCamera, three.js r187. Its matrixWorldInverse ignores scales too.
#include <nlohmann/json.hpp>

#include "camera/importers/chain.hpp"
#include "camera/importers/importer.hpp"
#include "numbers/degrees.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace threejs {

constexpr std::string_view kPerspective = "PerspectiveCamera", kOrthographic = "OrthographicCamera";

bool recognises(const Json& root) {
  const auto object = root.find("object");
  if (object == root.end() || !object->is_object()) return false;
  const auto type = object->find("type");
  return type != object->end() && type->is_string();
}

std::string textOf(const Node& object, std::string_view key) {
  const auto text = object.find(key);
  return text && text->json().is_string() ? text->text() : "";
}

void addObjects(NodeTree& tree, const Node& object, std::size_t parent) {
  const std::size_t index = tree.nodes.size();
  tree.nodes.push_back(object);
  tree.parents.push_back(parent);
  const auto children = object.find("children");
  for (std::size_t i = 0; children && i < children->size(); ++i) addObjects(tree, (*children)[i], index);
}

/// Zoom divides the window's size and keeps its centre.
Json lensOf(const Node& camera) {
  const auto zoomField = camera.find("zoom");
  const double zoom = zoomField ? zoomField->number() : 1;
  if (!(zoom > 0)) zoomField->fail("must be above 0");
  if (!camera.json().contains("far")) camera.fail("needs far; null is infinite");
  Json lens{{"near", camera.require("near").number()}};
  if (const auto far = camera.find("far")) lens["far"] = far->number();
  if (camera.require("type").text() == kPerspective) {
    lens["type"] = "perspective";
    if (const auto aspect = camera.find("aspect")) lens["aspect"] = aspect->number();
    const Node fov = camera.require("fov");
    if (zoom == 1) {
      lens["fovY"] = fov.number();
      return lens;
    }
    const DoubleDouble tangent = tanHalfDegrees(fov.number());
    if (!(tangent.hi > 0)) fov.fail("must be above 0 and below 180 degrees");
    lens["focalLength"] = zoom;
    lens["sensorHeight"] = 2 * tangent.hi;
    return lens;
  }
  lens["type"] = "orthographic";
  const auto edges = [&](const char* low, const char* high) {
    const double a = camera.require(low).number(), b = camera.require(high).number();
    const DoubleDouble middle = twoSum(a, b) * DoubleDouble(0.5);
    const DoubleDouble half = twoDiff(b, a) * DoubleDouble(0.5) / DoubleDouble(zoom);
    lens[low] = rounded(middle - half);
    lens[high] = rounded(middle + half);
  };
  edges("left", "right");
  edges("bottom", "top");
  return lens;
}

Json documentOf(NodeTree& tree, std::size_t place) {
  const Node& camera = tree.nodes[place];
  if (const auto view = camera.find("view"); view && view->find("enabled"))
    refuse(*view, {"enabled"}, "a view offset is not supported; set it to false and use viewport.crop");
  refuse(camera, {"filmOffset"}, "is not supported");
  for (std::size_t at = place; at != NodeTree::kNone; at = tree.parents[at])
    if (const Node& object = tree.nodes[at]; !object.find("matrix") && !object.find("quaternion"))
      refuse(object, {"rotation"}, "is not supported without a matrix or a quaternion");
  Json document{{"convention", "opengl"}, {"projection", lensOf(camera)}};
  tree.addPose(document, place);
  return document;
}

Import open(const Node& root) {
  NodeTree tree{"position", "quaternion"};
  addObjects(tree, root.require("object"), NodeTree::kNone);
  Import result;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const std::string type = textOf(tree.nodes[i], "type");
    if (type != kPerspective && type != kOrthographic) continue;
    result.cameras.push_back({textOf(tree.nodes[i], "name"), textOf(tree.nodes[i], "uuid")});
    places.push_back(i);
  }
  result.document = [tree = std::move(tree), places](std::size_t which) mutable {
    return documentOf(tree, places[which]);
  };
  return result;
}

}  // namespace threejs

extern const Importer kThreeJs{"threejs", "a three.js file", threejs::recognises, threejs::open};

}  // namespace viewproj::cmd
