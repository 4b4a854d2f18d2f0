// Sources: KITTI odometry (12 numbers a line), TUM RGB-D (time, place, quaternion), EuRoC's ground truth, ScanNet and
// 7-Scenes (4 lines of 4), PandaSet (position, heading), nuScenes (token, and quaternions w first), OpenCV's solvePnP.
// Four numbers without names are x, y, z, w in our own form alone: a turn and a place, and no other member.
#include "formats/poses.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/patch.hpp"
#include "formats/claims.hpp"
#include "formats/finder/finder.hpp"
#include "formats/format.hpp"
#include "formats/parts.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "formats/writer.hpp"
#include "text/number.hpp"
#include "text/pasted_matrices.hpp"

namespace viewproj::cmd {
namespace poses {

struct Form {
  std::string_view when;  ///< see claims.hpp
  std::string_view parts;
  std::string_view names = "";
  bool isDirected = true;  ///< the form has the direction of its parts; else no number tells it
  bool isAlone = true;     ///< the file holds no more
};
constexpr Form kForms[] = {
    {":few !*:K rvec:3|rotation_vector:3|R:3 tvec:3|translation_vector:3|T:3|t:3",
     "cameraFromWorld.rotationVector=rvec|rotation_vector|R, cameraFromWorld.translation=tvec|translation_vector|T|t"},
    {":few !*:K R:9|rvec:9 T:3|t:3|tvec:3", "cameraFromWorld.rotation=R|rvec, cameraFromWorld.translation=T|t|tvec"},
    {":list *.time~ *.tx|*.x|*.p_RS_R_x~ *.qw|*.q_RS_w~",
     "name=*.time~, worldFromCamera.translation=*.tx|*.x|*.p_RS_R_x~+*.ty|*.y|*.p_RS_R_y~+*.tz|*.z|*.p_RS_R_z~, "
     "worldFromCamera.quaternion=*.qx|*.q_RS_x~+*.qy|*.q_RS_y~+*.qz|*.q_RS_z~+*.qw|*.q_RS_w~"},
    {":list *:few *.position:3 *.heading:xyzw|*.rotation:xyzw|*.orientation:xyzw",
     "worldFromCamera.translation=*.position, worldFromCamera.quaternion=*.heading|*.rotation|*.orientation", "",
     false},
    {":list *.token *.rotation:4 *.translation:3 !*.camera_intrinsic:9",
     "name=*.token, worldFromCamera.translation=*.translation, worldFromCamera.quaternionWFirst=*.rotation"},
    {":list *:two *.rotation:4 *.translation:3|*.position:3",
     "worldFromCamera.translation=*.translation|*.position, worldFromCamera.quaternion=*.rotation", "", false},
    {":list :M", "worldFromCamera=.", "", false},
    {":MN", "worldFromCamera=*", "", false},
    {":QN", "name=*[0], worldFromCamera.translation=*[1:4], worldFromCamera.quaternion=*[4:8]"},
    {":list :Q", "name=.[0], worldFromCamera.translation=.[1:4], worldFromCamera.quaternion=.[4:8]"},
    {"rotation:xyzw|orientation:xyzw|quaternion:xyzw translation:3|position:3",
     "worldFromCamera.quaternion=rotation|orientation|quaternion, worldFromCamera.translation=translation|position", "",
     false, false},
    {"token rotation:4 translation:3 !camera_intrinsic:9",
     "name=token, worldFromCamera.quaternionWFirst=rotation, worldFromCamera.translation=translation"},
    {":two rotation:4 translation:3|position:3",
     "worldFromCamera.quaternion=rotation, worldFromCamera.translation=translation|position", "", false, false},
    {"rotation:3x3 translation:3", "worldFromCamera.rotation=rotation, worldFromCamera.translation=translation", "",
     false, false},
    {"rotationVector:3 translation:3",
     "worldFromCamera.rotationVector=rotationVector, worldFromCamera.translation=translation", "", false, false},
    {"R:9 T:3|t:3", "cameraFromWorld.rotation=R, cameraFromWorld.translation=T|t", "", true, false}};

struct Place {
  const Form* form;  ///< null: the file holds no pose
  std::string_view container;
};

/// Where the poses of a file stand. areAlone: and nothing else.
Place placeOf(const Node& root, bool areAlone) {
  // Numbers alone are at the top, or the only block of a text; ROS has messages in messages.
  const std::string_view first = holds(root, ":alone #1") ? "#1" : ".";
  for (const std::string_view each :
       {first, std::string_view("pose"), std::string_view("transform"), std::string_view("pose.pose")}) {
    const std::string_view container = each == "." ? "" : each;
    for (const Form& form : kForms)
      if ((form.isAlone ? each == first : !areAlone) && holds(root, form.when, container)) return {&form, container};
  }
  return {nullptr, ""};
}

Import open(const Node& root) {
  PosesOfFile file = posesOf(root);
  if (file.poses.cameras.size() < 2)
    root.fail(
        "is a pose and has no lens; give it to --world-from-camera or --camera-from-world, beside a lens from -c or "
        "options");
  return std::move(file.poses);
}

}  // namespace poses

bool holdsPoses(const Node& root) { return poses::placeOf(root, true).form != nullptr; }

PosesOfFile posesOf(const Node& root) {
  const auto [form, container] = poses::placeOf(root, false);
  if (!form) return {};
  PosesOfFile file{
      {camerasOfParts(root, parseParts(form->parts, "poses", container), {}, form->names)},
      form->parts.find("worldFromCamera") == std::string_view::npos ? "cameraFromWorld" : "worldFromCamera",
      form->isDirected};
  file.poses.noun = "pose";
  return file;
}

std::optional<PosesOfFile> namedPose(const Document& file, const std::string& field) {
  const std::vector<ProposedLine> lines = proposeParts(file).lines;
  if (lines.size() != 1 || lines.front().hasLens || lines.front().parts.find(".quaternion") == std::string::npos)
    return std::nullopt;
  if (const std::string& turn = lines.front().turnOfNoOrder; !turn.empty()) {
    const std::string name = turn.substr(turn.rfind('.') + 1);
    throw InputError(file.name + ": " + turn + ": x y z w, or w first? call it " + name + "_xyzw or " + name +
                     "_wxyz in the file, or give 'X,Y,Z quat:X,Y,Z,W'");
  }
  for (const auto& [again, value] : file.root->items()) {
    const std::string name = again.substr(0, again.size() - 1);
    if (file.isPlainText && again.ends_with('#') &&
        lines.front().parts.find("translation=" + name) != std::string::npos)
      throw InputError(file.name + ": " + inQuotes(name) + " comes again, and other names do not; keep one pose");
  }
  const bool isOther = lines.front().isEitherWay && field == "cameraFromWorld";
  std::vector<Part> parts = parseParts((isOther ? otherWay(lines.front()) : lines.front()).parts, "poses");
  const std::string direction = parts.front().name.substr(0, parts.front().name.find('.'));
  // A place is the translation of what takes the camera to the world.
  for (Part& part : parts)
    if (part.name == "position") {
      if (direction != "worldFromCamera") return std::nullopt;
      part.name = "worldFromCamera.translation";
    }
  return PosesOfFile{{camerasOfParts(Node(file), std::move(parts), {}, "")}, direction, true};
}

namespace {

/// The rows of a printed pose; nothing for a matrix that is none.
std::optional<Json> poseIn(const PastedMatrix& m) {
  if (m.numbers.size() < 12) return std::nullopt;
  const auto endsRigid = [&](bool isTransposed) {
    for (std::size_t i = 0; i < 4; ++i)
      if ((isTransposed ? m.at(i, 3) : m.at(3, i)) != (i < 3 ? 0 : 1)) return false;
    return true;
  };
  const bool isTransposed =
      m.isByColumns || m.isCss || m.columns == 3 || (m.rows == 4 && !endsRigid(false) && endsRigid(true));
  if (isTransposed && m.rows != 4) return std::nullopt;
  Json rows = Json::array();
  for (std::size_t i = 0; i < std::min(isTransposed ? m.columns : m.rows, std::size_t{4}); ++i) {
    rows.push_back(Json::array());
    for (std::size_t j = 0; j < 4; ++j) rows.back().push_back(isTransposed ? m.at(j, i) : m.at(i, j));
  }
  return rows;
}

}  // namespace

std::vector<std::pair<std::string, Json>> printedPoses(std::string_view text) {
  std::vector<std::pair<std::string, Json>> poses;
  for (const PastedMatrix& matrix : findMatrices(text).matrices) {
    const auto pose = poseIn(matrix);
    if (!pose) return {};
    poses.emplace_back(matrix.name, *pose);
  }
  return poses;
}

std::optional<Json> poseAt(const Document& file, const std::string& path) {
  std::optional<Json> pose;
  for (const std::string& each : pathsOfNumbers(*file.root)) {
    if (each != path && !each.ends_with("." + path)) continue;
    const auto node = valueAt(Node(file), each);
    const auto numbers = node ? numbersIn(node->json()) : std::nullopt;
    if (!numbers || !isRigid(*numbers)) continue;
    if (pose) return std::nullopt;
    pose = rowsOf(*numbers, 4);
  }
  return pose;
}

std::optional<Json> printedRotation(std::string_view text) {
  const PastedMatrices pasted = findMatrices(text);
  std::size_t others = 0;
  for (const PassedOver& over : pasted.passedOver) others += over.numbers;
  constexpr std::size_t kCoordinates = 3;
  if (pasted.matrices.size() != 1 || pasted.matrices.front().numbers.size() != 9 || others >= kCoordinates)
    return std::nullopt;
  const PastedMatrix& m = pasted.matrices.front();
  Json rows = Json::array();
  for (std::size_t i = 0; i < 3; ++i) {
    rows.push_back(Json::array());
    for (std::size_t j = 0; j < 3; ++j) rows.back().push_back(m.isByColumns || m.isCss ? m.at(j, i) : m.at(i, j));
    rows.back().push_back(0);
  }
  return rows;
}

namespace {

void eachObject(const Json& value, const std::function<void(const Json& object)>& visit) {
  if (value.is_object()) visit(value);
  if (!value.is_structured()) return;
  for (const Json& part : value) eachObject(part, visit);
}

std::string linkOf(const Json& joint, const char* end) {
  return joint.contains(end) && joint[end].is_object() ? joint[end].value("@link", "") : "";
}

}  // namespace

std::optional<Json> jointPose(const Document& file, const std::optional<std::string>& name) {
  std::vector<const Json*> origins, joints;
  eachObject(*file.root, [&](const Json& each) {
    if (each.contains("origin") && (!name || each.value("@name", "") == *name)) origins.push_back(&each["origin"]);
    if (!linkOf(each, "child").empty()) joints.push_back(&each);
  });
  // A joint may be called as a link is: the origin of the one and the whole way to the other are two poses.
  const auto leadsTo = [&](const std::string& link) {
    return std::find_if(joints.begin(), joints.end(), [&](const Json* each) { return linkOf(*each, "child") == link; });
  };
  if (const auto joint = name ? leadsTo(*name) : joints.end();
      joint != joints.end() && origins.size() == 1 &&
      (valueAt(**joint, "origin") != origins.front() || leadsTo(linkOf(**joint, "parent")) != joints.end()))
    throw InputError(file.name + ": " + inQuotes(*name) + " is a joint and a link, which have other poses");
  if (origins.size() == 1) return poseOfOrigin(*origins.front());
  if (joints.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const Json* joint : joints) names.push_back(joint->value("@name", "") + " to " + linkOf(*joint, "child"));
  constexpr std::size_t kMost = 8;
  const std::string known = "its joints are " + visible(someOf(names, kMost));
  if (!name)
    throw InputError(file.name + ": " + known +
                     "; FILE#JOINT is a joint's own origin, FILE#LINK all the way from the root to a link");
  Json chain = Json::array();
  for (std::string link = *name; chain.size() < joints.size();) {
    const auto joint = leadsTo(link);
    if (joint == joints.end()) break;
    const Json& moved = **joint;
    if (const std::string type = moved.value("@type", ""); type != "fixed")
      throw InputError(file.name + ": the joint " + inQuotes(moved.value("@name", "")) + " is " + type +
                       ", and its position is not in the file; give the pose of each joint to " + inQuotes(*name) +
                       ", base first");
    const auto pose = poseOfOrigin(moved.value("origin", Json()));
    if (!pose) return std::nullopt;
    chain.insert(chain.begin(), *pose);
    link = linkOf(moved, "parent");
  }
  if (!chain.empty()) return chain;
  if (std::any_of(joints.begin(), joints.end(), [&](const Json* each) { return linkOf(*each, "parent") == *name; }))
    return Json{{"translation", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}};  // the root
  throw InputError(file.name + ": has no joint or link " + inQuotes(*name) + "; " + known);
}

extern const Format kPoses{"poses", "poses without a lens",
                           "",      poses::open,
                           "*",     [](const Node& root) { return holdsPoses(root) && !kTable.recognises(root); }};

namespace {

/// The number that a camera's name is, without its folders and ending; nothing for another name.
std::optional<std::string> timeIn(const WrittenCamera& camera) {
  std::string text = camera.name.substr(camera.name.rfind('/') + 1);
  if (!parseNumber(text)) text.resize(std::min(text.rfind('.'), text.size()));
  return parseNumber(text) ? std::optional(text) : std::nullopt;
}

struct Timed {
  std::string time;  ///< as it is written: a double has not all of its digits
  const WrittenCamera* camera;
  double seconds = 0;
};

/// Seconds of times, where whole ones count what the longest tells: milliseconds (13 digits), microseconds (16) or
/// nanoseconds (17 and more).
void makeSeconds(std::vector<Timed>& all) {
  const auto isWhole = [](const std::string& time) { return std::all_of(time.begin(), time.end(), isDigit); };
  std::size_t digits = 0;
  for (const Timed& each : all)
    if (isWhole(each.time)) digits = std::max(digits, each.time.size());
  const std::size_t decimals = digits > 16 ? 9 : digits == 16 ? 6 : digits == 13 ? 3 : 0;
  for (auto& [time, camera, seconds] : all) {
    if (decimals > 0 && isWhole(time)) {
      if (time.size() <= decimals) time.insert(0, decimals + 1 - time.size(), '0');
      time.insert(time.size() - decimals, ".");
    }
    seconds = *parseNumber(time);
  }
}

}  // namespace

std::vector<WrittenFile> writeTum(std::span<const WrittenCamera> cameras, std::string_view) {
  std::vector<Timed> timed;
  for (const WrittenCamera& camera : cameras)
    if (const auto time = timeIn(camera)) timed.push_back({*time, &camera});
  std::string text = "# timestamp tx ty tz qx qy qz qw\n", told;
  std::size_t next = 0;
  const bool areTimes = timed.size() == cameras.size();
  if (!areTimes ||
      std::all_of(timed.begin(), timed.end(), [&](const Timed& each) { return each.time == std::to_string(next++); })) {
    const bool areNamed = !areTimes && std::any_of(cameras.begin(), cameras.end(),
                                                   [](const WrittenCamera& camera) { return !camera.name.empty(); });
    told = std::string(areNamed ? "names are no times" : "there are no times") + ": 0, 1, 2 \u2026 are written";
    timed.clear();
    for (const WrittenCamera& camera : cameras) timed.push_back({camera.number, &camera});
  }
  makeSeconds(timed);
  std::stable_sort(timed.begin(), timed.end(), [](const Timed& a, const Timed& b) {
    return a.seconds != b.seconds ? a.seconds < b.seconds : a.time < b.time;
  });
  for (std::size_t i = 1; i < timed.size() && told.empty(); ++i)
    if (timed[i - 1].time == timed[i].time) told = "several have the time " + timed[i].time;
  for (const auto& [time, camera, seconds] : timed) {
    const auto [columns, place] = worldFromCamera(camera->pose, CameraAxes::RDF);
    text += time;
    for (std::size_t i = 0; i < 3; ++i) text += " " + formatNumber(place[i]);
    for (const double number : quaternionOf(columns)) text += " " + formatNumber(number);
    text += "\n";
  }
  return {{"", text, told}};
}

std::vector<WrittenFile> writeKittiPoses(std::span<const WrittenCamera> cameras, std::string_view) {
  std::string text;
  for (const WrittenCamera& camera : cameras) {
    std::string line;
    for (const double number : worldFromCamera(camera, CameraAxes::RDF))
      line += (line.empty() ? "" : " ") + formatNumber(number);
    text += line + "\n";
  }
  return {{"", text}};
}

}  // namespace viewproj::cmd
