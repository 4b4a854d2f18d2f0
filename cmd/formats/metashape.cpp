// Cameras of Agisoft Metashape: a project's cameras.xml, and a calibration alone. Source: Metashape's manual, "Camera
// models" (its p1 and p2 are OpenCV's p2 and p1; cx and cy count from the picture's middle).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/rigid.hpp"
#include "formats/format.hpp"
#include "formats/value.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace metashape {

/// The children of a name: none, one, or several.
std::vector<Node> childrenOf(const Node& node, std::string_view name) {
  const auto child = node.json().is_object() ? node.find(name) : std::nullopt;
  std::vector<Node> children;
  if (child && child->json().is_array())
    for (std::size_t i = 0; i < child->size(); ++i) children.push_back((*child)[i]);
  else if (child)
    children.push_back(*child);
  return children;
}

/// The text of an element, which may have attributes.
std::optional<Node> contentOf(const Node& node, std::string_view name) {
  const auto child = node.json().is_object() ? node.find(name) : std::nullopt;
  return child && child->json().is_object() ? child->find("#text") : child;
}

std::string textOf(const Node& node, std::string_view name) {
  const auto child = contentOf(node, name);
  return child && child->json().is_string() ? child->text() : "";
}

Json cameraOf(const Node& calibration, std::string_view type, double width, double height) {
  const auto number = [&](std::string_view name, double otherwise = 0) {
    const auto child = contentOf(calibration, name);
    return child ? numberOf(*child) : otherwise;
  };
  const auto refuseUnlessZero = [&](std::initializer_list<std::string_view> names, const char* why) {
    for (const std::string_view name : names)
      if (number(name) != 0) contentOf(calibration, name)->fail(why);
  };
  if (type != "frame" && type != "fisheye")
    calibration.fail("is of a lens of the type " + std::string(type) + ", which is not supported");
  if (!contentOf(calibration, "f")) calibration.fail("needs f");
  const bool isFisheye = type == "fisheye";
  refuseUnlessZero({"b2"}, "is a skew; pixels of a skewed grid are not supported");
  refuseUnlessZero({"p3", "p4"}, "is not supported");
  if (isFisheye)
    refuseUnlessZero({"p1", "p2"}, "is not supported beside a fisheye lens");
  else
    refuseUnlessZero({"k4"}, "is not supported");
  const double intrinsics[] = {number("f") + number("b1"), number("f"), width / 2 + number("cx"),
                               height / 2 + number("cy")};
  Json camera = pinholeCamera(intrinsics, std::array{width, height}, 0.5);
  const std::vector<double> k{number("k1"), number("k2"), number("k3"), number("k4")};
  Json lens = isFisheye ? lensOf(calibration, "fisheye", k)
                        : lensOf(calibration, "brown", std::vector{k[0], k[1], number("p2"), number("p1"), k[2]});
  if (!lens.is_null()) camera["distortion"] = std::move(lens);
  return camera;
}

/// A sensor's calibration: the adjusted one, else the only one.
Json sensorCamera(const Node& sensor) {
  const std::vector<Node> calibrations = childrenOf(sensor, "calibration");
  if (sensor.find("@master_id")) sensor.fail("is a slave of a rig, which is not supported");
  const auto adjusted = std::find_if(calibrations.begin(), calibrations.end(),
                                     [](const Node& each) { return textOf(each, "@class") == "adjusted"; });
  if (calibrations.empty()) sensor.fail("needs a calibration");
  const Node& calibration = adjusted != calibrations.end() ? *adjusted : calibrations.front();
  const Node size = sensor.require("resolution");
  const std::string type = textOf(sensor, "@type");
  return cameraOf(calibration, type.empty() ? "frame" : type, numberOf(size.require("@width")),
                  numberOf(size.require("@height")));
}

/// The camera in the chunk's world, which may be turned, scaled and moved into a coordinate system.
Json poseOf(const Node& camera, const std::optional<Node>& transform) {
  Rigid pose = rigidOf(numbersOf(*contentOf(camera, "transform"), 16));
  if (!transform) return rowsOf(pose);
  const auto r = contentOf(*transform, "rotation"), t = contentOf(*transform, "translation"),
             s = contentOf(*transform, "scale");
  if (s) pose.origin = pose.origin * DoubleDouble(numberOf(*s));
  const std::vector<double> place = t ? numbersOf(*t, 3) : std::vector<double>{0, 0, 0};
  const DDVec3 origin{place[0], place[1], place[2]};
  const std::vector<double> turn = r ? numbersOf(*r, 9) : std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1};
  return rowsOf(rigidOf(turn, origin) * pose);
}

/// The node with an id among several.
std::optional<Node> withId(const std::vector<Node>& nodes, const std::string& id) {
  for (const Node& node : nodes)
    if (textOf(node, "@id") == id) return node;
  return std::nullopt;
}

void addCameras(const Node& group, std::vector<Node>& cameras) {
  for (const Node& camera : childrenOf(group, "camera"))
    if (camera.json().is_object() && contentOf(camera, "transform")) cameras.push_back(camera);
  for (const Node& inner : childrenOf(group, "group"))
    for (const Node& camera : childrenOf(inner, "camera"))
      if (camera.json().is_object() && contentOf(camera, "transform")) cameras.push_back(camera);
}

Import open(const Node& root) {
  const Node document = root.require("document");
  const std::vector<Node> chunks = childrenOf(document, "chunk");
  if (chunks.size() != 1) document.fail("holds " + std::to_string(chunks.size()) + " chunks; export one");
  const Node chunk = chunks.front();
  const auto sensors = chunk.find("sensors"), cameras = chunk.find("cameras"), components = chunk.find("components");
  std::vector<Node> list;
  if (cameras) addCameras(*cameras, list);
  if (cameras && list.empty()) cameras->fail("holds no camera that is aligned: none has a transform");
  const std::vector<Node> lenses = sensors ? childrenOf(*sensors, "sensor") : std::vector<Node>{};
  const std::vector<Node> parts = components ? childrenOf(*components, "component") : std::vector<Node>{};
  Import result;
  for (const Node& camera : list) result.cameras.push_back({textOf(camera, "@label"), textOf(camera, "@id")});
  result.document = [chunk, list, lenses, parts](std::size_t which) {
    const Node& camera = list[which];
    const auto sensor = withId(lenses, textOf(camera, "@sensor_id"));
    if (!sensor) camera.fail("is of a sensor that is not in the file");
    Json placed = sensorCamera(*sensor);
    const auto component = withId(parts, textOf(camera, "@component_id"));
    auto transform = component && component->json().is_object() ? component->find("transform") : std::nullopt;
    if (!transform) transform = chunk.find("transform");
    setPose(placed, "worldFromCamera", poseOf(camera, transform));
    const std::string reference = textOf(chunk, "reference");
    if (transform && !reference.empty() && !reference.starts_with("LOCAL_CS")) placed["world"] = "ecef";
    return placed;
  };
  return result;
}

Import openLens(const Node& root) {
  const Node calibration = root.require("calibration");
  return {std::vector<CameraEntry>(1), [calibration](std::size_t) {
            return cameraOf(calibration, textOf(calibration, "projection"), numberOf(calibration.require("width")),
                            numberOf(calibration.require("height")));
          }};
}

}  // namespace metashape

extern const Format kMetashape{"metashape", "cameras of Metashape", "document.chunk:object", metashape::open, "*"};
extern const Format kMetashapeLens{"metashape", "", "calibration.projection", metashape::openLens, "date"};

}  // namespace viewproj::cmd
