// Sources: KITTI odometry (12 numbers a line), TUM RGB-D (time, place, quaternion), EuRoC's ground truth, ScanNet and
// 7-Scenes (4 lines of 4), OpenCV's solvePnP.
#include "formats/poses.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/claims.hpp"
#include "formats/format.hpp"
#include "formats/parts.hpp"
#include "formats/writer.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace poses {

struct Form {
  std::string_view when;  ///< see claims.hpp
  std::string_view parts;
  std::string_view names = "";
  bool isDirected = true;
};
constexpr Form kForms[] = {
    {":few !*:K rvec:3|rotation_vector:3|R:3 tvec:3|translation_vector:3|T:3|t:3",
     "cameraFromWorld.rotationVector=rvec|rotation_vector|R, "
     "cameraFromWorld.translation=tvec|translation_vector|T|t"},
    {":few !*:K R:9|rvec:9 T:3|t:3|tvec:3", "cameraFromWorld.rotation=R|rvec, cameraFromWorld.translation=T|t|tvec"},
    {":list *.time~ *.tx|*.x|*.p_RS_R_x~ *.qw|*.q_RS_w~",
     "name=*.time~, worldFromCamera.translation=*.tx|*.x|*.p_RS_R_x~+*.ty|*.y|*.p_RS_R_y~+*.tz|*.z|*.p_RS_R_z~, "
     "worldFromCamera.quaternion=*.qx|*.q_RS_x~+*.qy|*.q_RS_y~+*.qz|*.q_RS_z~+*.qw|*.q_RS_w~"},
    {":list :M", "worldFromCamera=.", "", false},
    {":MN", "worldFromCamera=*"},
    {":QN", "name=*[0], worldFromCamera.translation=*[1:4], worldFromCamera.quaternion=*[4:8]"},
    {":list :Q", "name=.[0], worldFromCamera.translation=.[1:4], worldFromCamera.quaternion=.[4:8]"}};

/// Where numbers alone stand: at the top, or as the only block of a text.
std::string_view containerOf(const Node& root) { return holds(root, ":alone #1") ? "#1" : ""; }

const Form* formOf(const Node& root) {
  const auto* const form = std::find_if(std::begin(kForms), std::end(kForms),
                                        [&](const Form& each) { return holds(root, each.when, containerOf(root)); });
  return form == std::end(kForms) ? nullptr : form;
}

Import open(const Node& root) {
  PosesOfFile file = posesOf(root);
  if (!file.isDirected || file.poses.cameras.size() == 1)
    root.fail(
        "is a pose and has no lens; give it to --world-from-camera or --camera-from-world, beside a lens from -c or "
        "options");
  return std::move(file.poses);
}

}  // namespace poses

bool holdsPoses(const Node& root) { return poses::formOf(root) != nullptr; }

PosesOfFile posesOf(const Node& root) {
  const poses::Form* const form = poses::formOf(root);
  if (!form)
    root.fail("holds no pose: expected 4 rows of 4 numbers, 12 or 16 numbers a line, or time x y z qx qy qz qw");
  PosesOfFile file{
      {camerasOfParts(root, parseParts(form->parts, "poses", poses::containerOf(root)), {}, form->names)},
      form->parts.find("worldFromCamera") == std::string_view::npos ? "cameraFromWorld" : "worldFromCamera",
      form->isDirected};
  file.poses.noun = "pose";
  return file;
}

extern const Format kPoses{"poses", "poses without a lens",
                           "",      poses::open,
                           "*",     [](const Node& root) { return holdsPoses(root) && !kTable.recognises(root); }};

std::vector<WrittenFile> writeTum(std::span<const WrittenCamera> cameras, std::string_view) {
  const bool areTimes = std::all_of(cameras.begin(), cameras.end(), [](const WrittenCamera& camera) {
    return parseNumber(camera.label()).has_value();
  });
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const WrittenCamera& camera : cameras) {
    const auto [columns, place] = worldFromCamera(camera.pose, CameraAxes::RDF);
    text += areTimes ? camera.label() : camera.number;
    for (std::size_t i = 0; i < 3; ++i) text += " " + formatNumber(place[i]);
    for (const double number : quaternionOf(columns)) text += " " + formatNumber(number);
    text += "\n";
  }
  return {{"", text}};
}

}  // namespace viewproj::cmd
