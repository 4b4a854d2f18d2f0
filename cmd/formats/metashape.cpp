// Cameras of Agisoft Metashape: a project's cameras.xml, and a calibration alone. Source: Metashape's manual, "Camera
// models" (its p1 and p2 are OpenCV's p2 and p1; cx and cy count from the picture's middle).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"

namespace viewproj::cmd {
namespace metashape {

Json cameraOf(const Node& calibration, const std::string& type, double width, double height) {
  const auto number = [&](std::string_view name) { return numberAt(calibration, name); };
  const auto refuseUnlessZero = [&](std::string_view names, const char* why) {
    for (const std::string_view name : wordsIn(names))
      if (number(name) != 0) calibration.find(name)->fail(why);
  };
  if (!isAmong(type, "frame fisheye"))
    calibration.fail("is of a lens of the type " + type + ", which is not supported");
  if (!calibration.find("f")) calibration.fail("needs f");
  refuseUnlessZero("b2", "is a skew; pixels of a skewed grid are not supported");
  refuseUnlessZero("p3 p4", "is not supported");
  Json camera = pinholeCamera(
      std::array{number("f") + number("b1"), number("f"), width / 2 + number("cx"), height / 2 + number("cy")},
      std::array{width, height}, 0.5);
  if (type == "fisheye") {
    refuseUnlessZero("p1 p2", "is not supported beside a fisheye lens");
    setLens(camera, calibration, "fisheye", {number("k1"), number("k2"), number("k3"), number("k4")});
  } else {
    refuseUnlessZero("k4", "is not supported");
    setLens(camera, calibration, "brown", {number("k1"), number("k2"), number("p2"), number("p1"), number("k3")});
  }
  return camera;
}

/// A sensor's calibration: the adjusted one, else the only one.
Json sensorCamera(const Node& sensor) {
  const std::vector<Node> calibrations = itemsAt(sensor, "calibration");
  if (sensor.find("@master_id")) sensor.fail("is a slave of a rig, which is not supported");
  const auto adjusted = std::find_if(calibrations.begin(), calibrations.end(),
                                     [](const Node& each) { return textAt(each, "@class") == "adjusted"; });
  if (calibrations.empty()) sensor.fail("needs a calibration");
  const Node& calibration = adjusted != calibrations.end() ? *adjusted : calibrations.front();
  const Node size = sensor.require("resolution");
  const std::string type = textAt(sensor, "@type");
  return cameraOf(calibration, type.empty() ? "frame" : type, numberOf(size.require("@width")),
                  numberOf(size.require("@height")));
}

/// The camera in the chunk's world, which may be turned, scaled and moved into a coordinate system.
Json poseOf(const Node& camera, const std::optional<Node>& transform) {
  std::vector<double> pose = numbersOf(camera.require("transform"), 16);
  if (!transform) return rowsOf(pose, 4);
  const auto r = transform->find("rotation"), t = transform->find("translation");
  const double scale = numberAt(*transform, "scale", 1);
  for (const std::size_t i : {3u, 7u, 11u}) pose[i] *= scale;
  return Json::array({{{"rotation", rowsOf(r ? numbersOf(*r, 9) : std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}, 3)},
                       {"translation", t ? numbersOf(*t, 3) : std::vector<double>{0, 0, 0}}},
                      rowsOf(pose, 4)});
}

/// The item of a list of the chunk that has an id.
std::optional<Node> withId(const Node& chunk, std::string_view list, std::string_view item, const std::string& id) {
  const auto all = chunk.find(list);
  for (const Node& node : all ? itemsAt(*all, item) : std::vector<Node>{})
    if (textAt(node, "@id") == id) return node;
  return std::nullopt;
}

Json placedCamera(const Node& chunk, const Node& camera) {
  const auto sensor = withId(chunk, "sensors", "sensor", textAt(camera, "@sensor_id"));
  if (!sensor) camera.fail("is of a sensor that is not in the file");
  Json placed = sensorCamera(*sensor);
  const auto component = withId(chunk, "components", "component", textAt(camera, "@component_id"));
  auto transform = component && component->json().is_object() ? component->find("transform") : std::nullopt;
  if (!transform) transform = chunk.find("transform");
  setPose(placed, "worldFromCamera", poseOf(camera, transform));
  const std::string reference = textAt(chunk, "reference");
  if (transform && !reference.empty() && !reference.starts_with("LOCAL_CS")) placed["world"] = "ecef";
  return placed;
}

/// Those of a group that are aligned: that have a transform. others: the labels of those that are not.
void addCameras(const Node& group, std::vector<Node>& cameras, std::vector<std::string>& others) {
  for (const Node& camera : itemsAt(group, "camera"))
    if (camera.json().is_object() && camera.find("transform"))
      cameras.push_back(camera);
    else
      others.push_back(textAt(camera, "@label"));
}

Import open(const Node& root) {
  const Node document = root.require("document");
  const std::vector<Node> chunks = itemsAt(document, "chunk");
  if (chunks.size() != 1) document.fail("holds " + std::to_string(chunks.size()) + " chunks; export one");
  const Node chunk = chunks.front();
  const auto all = chunk.find("cameras");
  std::vector<Node> cameras;
  Import result;
  if (all) {
    addCameras(*all, cameras, result.withoutPose);
    for (const Node& group : itemsAt(*all, "group")) addCameras(group, cameras, result.withoutPose);
    if (cameras.empty()) all->fail("holds no camera that is aligned: none has a transform");
  }
  for (const Node& camera : cameras)
    result.add(textAt(camera, "@label"), textAt(camera, "@id"), [=] { return placedCamera(chunk, camera); });
  return result;
}

Import openLens(const Node& root) {
  return Import::one([calibration = root.require("calibration")] {
    return cameraOf(calibration, textAt(calibration, "projection"), numberOf(calibration.require("width")),
                    numberOf(calibration.require("height")));
  });
}

}  // namespace metashape

extern const Format kMetashape{"metashape", "cameras of Metashape", "document.chunk:object", metashape::open, "*"};
extern const Format kMetashapeLens{"metashape", "", "calibration.projection", metashape::openLens, "date"};

}  // namespace viewproj::cmd
