// three.js cameras as Object3D.toJSON writes them, alone or in a scene. Formulas: updateProjectionMatrix of
// PerspectiveCamera and OrthographicCamera, three.js r187. Its matrixWorldInverse ignores scales too.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/node_tree.hpp"
#include "formats/writer.hpp"
#include "numbers/degrees.hpp"
#include "text/json_text.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace threejs {

constexpr std::string_view kPerspective = "PerspectiveCamera", kOrthographic = "OrthographicCamera";

void addObjects(NodeTree& tree, const Node& object, std::size_t parent) {
  const std::size_t index = tree.nodes.size();
  tree.nodes.push_back(object);
  tree.parents.push_back(parent);
  const auto children = object.find("children");
  for (std::size_t i = 0; children && i < children->size(); ++i) addObjects(tree, (*children)[i], index);
}

/// A part of the full picture, which is drawn alone.
struct View {
  double fullWidth, fullHeight, x, y, width, height;
};
std::optional<View> viewOf(const Node& camera) {
  const auto view = camera.find("view");
  const auto isOn = view ? view->find("enabled") : std::nullopt;
  if (!isOn || !isOn->flag()) return std::nullopt;
  const auto number = [&](const char* key) { return view->require(key).number(); };
  return View{number("fullWidth"), number("fullHeight"), number("offsetX"),
              number("offsetY"),   number("width"),      number("height")};
}

/// The edges of a perspective window that is moved by the film's offset, or cut by a view.
Json windowOf(const Node& camera, Json lens, double zoom, const std::optional<View>& view) {
  const DoubleDouble tangent = tanHalfDegrees(camera.require("fov").number());
  const auto stated = [&](const char* key, double otherwise) {
    const auto member = camera.find(key);
    return member ? member->number() : otherwise;
  };
  const double near = lens["near"].get<double>(), aspect = stated("aspect", 1);
  DoubleDouble top = DoubleDouble(near) * tangent / DoubleDouble(zoom), height = top * DoubleDouble(2);
  DoubleDouble width = height * DoubleDouble(aspect), left = width * DoubleDouble(-0.5);
  if (view) {
    left = left + width * DoubleDouble(view->x) / DoubleDouble(view->fullWidth);
    top = top - height * DoubleDouble(view->y) / DoubleDouble(view->fullHeight);
    width = width * DoubleDouble(view->width) / DoubleDouble(view->fullWidth);
    height = height * DoubleDouble(view->height) / DoubleDouble(view->fullHeight);
  }
  // filmGauge is the larger side of the film, in the unit of filmOffset.
  const double film = stated("filmGauge", 35) * std::min(aspect, 1.0);
  left = left + DoubleDouble(near) * DoubleDouble(stated("filmOffset", 0)) / DoubleDouble(film);
  lens.erase("aspect");
  lens.update({{"type", "frustum"},
               {"left", rounded(left)},
               {"right", rounded(left + width)},
               {"bottom", rounded(top - height)},
               {"top", rounded(top)}});
  return lens;
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
    const auto view = viewOf(camera);
    const auto offset = camera.find("filmOffset");
    if (view || (offset && offset->number() != 0)) return windowOf(camera, std::move(lens), zoom, view);
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
  if (camera.require("type").text() == kOrthographic && viewOf(camera))
    camera.require("view").fail("is not supported for an orthographic camera; use viewport.crop");
  for (std::size_t at = place; at != NodeTree::kNone; at = tree.parents[at])
    if (const Node& object = tree.nodes[at]; !object.find("matrix") && !object.find("quaternion"))
      refuse(object, "rotation", "is not supported without a matrix or a quaternion");
  Json document{{"convention", "opengl"}, {"projection", lensOf(camera)}};
  tree.addPose(document, place);
  return document;
}

Import open(const Node& root) {
  const auto tree = std::make_shared<NodeTree>("position", "quaternion");
  // The editor's app.json has the scene and the editor's own camera.
  for (const auto& part : {std::optional(root), root.find("camera"), root.find("scene")})
    if (part && part->json().is_object())
      if (const auto object = part->find("object")) addObjects(*tree, *object, NodeTree::kNone);
  Import result;
  for (std::size_t i = 0; i < tree->nodes.size(); ++i) {
    const Node& object = tree->nodes[i];
    const std::string type = stringAt(object, "type");
    if (type == kPerspective || type == kOrthographic)
      result.add(stringAt(object, "name"), stringAt(object, "uuid"), [tree, i] { return documentOf(*tree, i); });
  }
  return result;
}

}  // namespace threejs

extern const Format kThreeJs{"threejs", "a three.js file", "object.type:text|scene.object.type:text", threejs::open,
                             "*"};

std::vector<WrittenFile> writeThreeJs(std::span<const WrittenCamera> cameras, std::string_view) {
  const auto begin = [](std::size_t number, std::string_view type) {
    const std::string digits = std::to_string(number);
    JsonObject out;
    out.add("uuid", "00000000-0000-4000-8000-" + std::string(12 - digits.size(), '0') + digits).add("type", type);
    return out;
  };
  std::vector<std::string> objects;
  for (const WrittenCamera& camera : cameras) {
    const Projection& p = *camera.file.projection;
    JsonObject out = begin(objects.size() + 1, p.isOrthographic() ? threejs::kOrthographic : threejs::kPerspective);
    if (!camera.name.empty()) out.add("name", camera.name);
    const auto matrix = columnsOf(worldFromCamera(camera, CameraAxes::RUB));
    out.addText("layers", "1").addText("matrix", jsonListOf(matrix)).addText("zoom", "1");
    const auto [near, far] = depthsFor(p);
    out.add("near", near).add("far", far);
    if (p.isOrthographic()) {
      out.add("left", p.left()).add("right", p.right()).add("top", p.top()).add("bottom", p.bottom());
    } else {
      // A full picture whose middle is the viewing axis, and of it the part that is seen.
      const bool isCentred = p.left() == -p.right() && p.bottom() == -p.top();
      const double halfHeight = (p.top() - p.bottom()) / 2;
      out.add("fov", isCentred ? p.fov(Fov::vertical) : degreesOf(Angle::radians(2 * std::atan(halfHeight))));
      out.add("aspect", p.aspect()).addText("focus", "10").addText("filmGauge", "35").addText("filmOffset", "0");
      if (!isCentred) {
        const Viewport picture = camera.file.viewport.value_or(Viewport{p.aspect(), 1});
        const Intrinsics k = cameraIn({}, {}, p, Viewport{picture.width, picture.height}).intrinsics();
        JsonObject view;
        view.add("enabled", true).add("fullWidth", picture.width).add("fullHeight", picture.height);
        view.add("offsetX", picture.width / 2 - k.cx).add("offsetY", picture.height / 2 - k.cy);
        out.addText("view", view.add("width", picture.width).add("height", picture.height).text());
      }
    }
    objects.push_back(out.text());
  }
  std::string object = objects.front();
  if (objects.size() > 1)
    object = begin(0, "Group").addText("layers", "1").addText("children", jsonList(objects, ",\n    ")).text();
  return {{"", R"({"metadata": {"version": 4.6, "type": "Object", "generator": "viewproj"},)"
               "\n  \"object\": " +
                   object + "}\n"}};
}

}  // namespace viewproj::cmd
