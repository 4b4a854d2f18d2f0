#include "input/kinds/kind.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace viewproj::cmd {
namespace {

consteval KindField ofWhole(KindField field) {
  field.ofView = false;
  return field;
}

constexpr KindField kFields[] = {
    ofWhole({"kind", KindValue::text, "a short name of the kind"}),
    ofWhole({"form", KindValue::text, "what messages call such a file, as in \"a transforms.json\""}),
    ofWhole({"source", KindValue::text, "where the kind is described"}),
    ofWhole({"lengths", KindValue::text, "the unit of its lengths, for who reads about it; nothing is converted"}),
    ofWhole(
        {"like", KindValue::text,
         "the name of an earlier kind; what this row says neither so nor in another way is as there, null is nothing"}),
    ofWhole(
        {"knownBy", KindValue::known,
         "places in a camera that make the file one of the kind; [9] behind one: nine numbers, []: an array, {}: an "
         "object; a / in front: from the file; a list in the list: one of these"}),
    ofWhole({"cameras", KindValue::paths, "where the cameras stand, as in frames.*; /: the file is one (default)"}),
    {"beside", KindValue::paths, "where else a camera's fields are looked for; /: the file; {key}: the text under key"},
    ofWhole({"views", KindValue::views, "several cameras in one: names, and what differs in each"}),
    {"needs", KindValue::paths, "what each camera has to have, though the file is known without it"},
    ofWhole({"rows", KindValue::path,
             "what has a row for each of several cameras: rotationVector and translation, or one of them beside the "
             "other"}),
    ofWhole({"skipWithout", KindValue::path, "what has nothing here is passed over, and no camera"}),
    ofWhole({"name", KindValue::path, "what picks the camera after # (default: its key)"}),
    ofWhole({"id", KindValue::path, "what picks it too"}),
    {"width", KindValue::path, "pixels"},
    {"height", KindValue::path, "pixels"},
    {"size", KindValue::path, "[width, height]", {}, 2},
    {"fx", KindValue::path, "focal length; one of fx and fy stands for both"},
    {"fy", KindValue::path, "focal length"},
    {"focalIn",
     KindValue::word,
     "unit of fx and fy: pixels (default), the picture's width, its larger side, or that of sensorWidth",
     {"pixels", "widths", "largerSides", "sensor"}},
    {"sensorWidth", KindValue::path, "in the unit of fx"},
    {"sensorHeight", KindValue::path, "in the unit of fx (default: as wide and high pixels)"},
    {"fovX", KindValue::path, "whole horizontal angle, where there is no fx"},
    {"fovY", KindValue::path, "whole vertical angle, where there is no fy"},
    {"angles", KindValue::word, "unit of angles (default: degrees)", {"degrees", "radians"}},
    {"cx", KindValue::path, "principal point (default: the middle)"},
    {"cy", KindValue::path, "principal point (default: the middle)"},
    {"centerIn",
     KindValue::word,
     "unit of cx and cy: pixels (default), the picture's width and height, its larger side from the middle, or that of "
     "sensorWidth from the picture's corner",
     {"pixels", "shares", "largerSidesFromMiddle", "sensor"}},
    {"K", KindValue::path, "3x3 matrix fx 0 cx, 0 fy cy, 0 0 1"},
    {"intrinsics", KindValue::path, "[fx, fy, cx, cy] in pixels", {}, 4},
    {"P", KindValue::path, "3x4 matrix K [R | t], which is split"},
    {"near", KindValue::path, "distance of the near plane (default: 0.01)"},
    {"far", KindValue::path, "distance of the far plane (default: none)"},
    {"pose",
     KindValue::word,
     "what matrix, rotation and translation map; needed with a rotation",
     {"cameraFromWorld", "worldFromCamera", "cameraFromPrevious"}},
    {"matrix", KindValue::path, "3x4 or 4x4 matrix"},
    {"rotation", KindValue::path, "3x3 matrix"},
    {"quaternion", KindValue::path, "4 numbers", {}, 4},
    {"quaternionOrder", KindValue::word, "their order; needed", {"wxyz", "xyzw"}},
    {"rotationVector", KindValue::path, "3 numbers: the axis, as long as the angle in radians", {}, 3},
    {"euler",
     KindValue::euler,
     "three turns, as in {\"order\": \"ZYX\", \"degrees\": [\"yaw\", \"pitch\", \"roll\"]}, or radians: Rz(yaw) "
     "Ry(pitch) "
     "Rx(roll) is the rotation, so each letter is an axis of the camera as those before have turned it",
     {},
     3},
    {"translation", KindValue::path, "3 numbers beside the rotation", {}, 3},
    {"position", KindValue::path, "3 numbers: the eye in the world", {}, 3},
    {"order", KindValue::word, "how matrices stand in the file (default: rows)", {"rows", "columns"}},
    {"scale", KindValue::number, "what lengths of the pose, near and far are multiplied by, as in 0.001 (default: 1)"},
    {"convention", KindValue::preset, "the convention whose world, camera axes and pixel centres the file has"},
    {"axes", KindValue::axes, "where the camera's x, y, z point, as in RDF or FLU (default: the convention's)"},
    {"pixelCenter", KindValue::number, "where in a pixel its centre is, 0 or 0.5 (default: the convention's)"},
    {"model", KindValue::paths, "names of the lens model: what is no pinhole is refused"},
    {"distortion", KindValue::paths, "coefficients k1 k2 p1 p2 k3 k4 k5 k6; [] none (default: known names of them)"},
    {"passedOver", KindValue::paths, "names that say nothing of the camera, though they look so"},
    {"only", KindValue::allowed,
     "places, and the values that are no obstacle there: numbers, \"identity\", or the place of the same number"},
};

}  // namespace

std::span<const KindField> kindFields() { return kFields; }

const KindField* kindField(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kFields), std::end(kFields), [&](const auto& row) { return row.name == name; });
  return found == std::end(kFields) ? nullptr : found;
}

std::size_t numbersOfWord(std::string_view word) {
  const KindField* const field = kindField(word);
  return field ? field->numbers : 0;
}

const Where& Kind::at(std::string_view word) const {
  static const Where kNowhere;
  const auto found = places.find(word);
  return found == places.end() ? kNowhere : found->second;
}

std::string_view Kind::word(std::string_view asked) const {
  const auto found = words.find(asked);
  return found == words.end() ? kindField(asked)->words[0] : std::string_view(found->second);
}

bool leadsTo(const Steps& path, const std::string& name, const nlohmann::json& value) {
  return value.is_structured() ? std::find(path.begin(), path.end(), name) != path.end()
                               : !path.empty() && path.back() == name;
}

bool readsField(const Kind& kind, const std::string& name, const nlohmann::json& value) {
  return std::any_of(kind.places.begin(), kind.places.end(), [&](const auto& word) {
    const std::vector<Steps>& paths = word.second.paths;
    return std::any_of(paths.begin(), paths.end(), [&](const Steps& path) { return leadsTo(path, name, value); });
  });
}

const std::vector<Kind>& builtInKinds() {
  static const std::vector<Kind> kKinds = readKinds(Document(kindsText(), "kinds.json", ""), {});
  return kKinds;
}

}  // namespace viewproj::cmd
