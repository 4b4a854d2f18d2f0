// Sources: KITTI odometry (12 numbers a line), TUM RGB-D (time, place, quaternion), EuRoC's ground truth, ScanNet and
// 7-Scenes (4 lines of 4).
#include "formats/poses.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/claims.hpp"
#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "formats/writer.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace poses {

/// Numbers alone: of a text file, of an array.
const Json* numbersAlone(const Json& root) {
  if (root.is_array()) return &root;
  const auto first = root.find("#1");
  return root.is_object() && first != root.end() && root.size() == 1 ? &*first : nullptr;
}

bool isLost(const std::vector<double>& m) {
  return std::any_of(m.begin(), m.end(), [](double number) { return !std::isfinite(number); });
}

bool isUnit(const std::vector<double>& row) {
  constexpr double kTolerance = 2e-3;
  return row.size() == 8 &&
         std::fabs(row[4] * row[4] + row[5] * row[5] + row[6] * row[6] + row[7] * row[7] - 1) < kTolerance;
}

/// How many numbers a pose has: 12, 16 or 8 (a time, a place and a quaternion); 0: these are no poses.
std::size_t widthOf(const Json& value, bool& isOne) {
  const auto numbers = numbersIn(value);
  if (!numbers || numbers->empty() || (value.is_array() && value.front().is_object())) return 0;
  const std::vector<std::size_t> shape = shapeOf(value);
  isOne = numbers->size() == 12 || numbers->size() == 16;
  if (isOne && (isRigid(*numbers) || (isLost(*numbers) && !isIntrinsic(*numbers)))) return numbers->size();
  isOne = false;  // two lines of 8 are a trajectory
  if (shape.empty()) return 0;
  const std::size_t rows = value.size(), width = rows > 0 ? numbers->size() / rows : 0;
  if (!value.is_array() || (width != 8 && width != 12 && width != 16) || width * rows != numbers->size())
    return numbers->size() == 8 && isUnit(*numbers) ? 8 : 0;
  // A lost pose may be the first one.
  for (std::size_t i = 0; i < rows; ++i) {
    const std::vector<double> row(numbers->begin() + static_cast<std::ptrdiff_t>(i * width),
                                  numbers->begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
    if (isLost(row)) continue;
    return width == 8 ? (isUnit(row) ? 8 : 0) : isRigid(row) ? width : 0;
  }
  return 0;
}

/// The columns of a table; a unit may stand behind a name.
std::optional<std::array<std::string, 8>> columnsOf(const Json& root) {
  if (!root.is_array() || root.empty() || !root.front().is_object()) return std::nullopt;
  constexpr std::string_view kForms[][8] = {
      {"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"},
      {"time", "tx", "ty", "tz", "qx", "qy", "qz", "qw"},
      {"timestamp", "x", "y", "z", "qx", "qy", "qz", "qw"},
      {"time", "x", "y", "z", "qx", "qy", "qz", "qw"},
      {"timestamp", "p_RS_R_x", "p_RS_R_y", "p_RS_R_z", "q_RS_x", "q_RS_y", "q_RS_z", "q_RS_w"}};
  for (const auto& form : kForms) {
    std::array<std::string, 8> columns;
    for (std::size_t i = 0; i < 8; ++i)
      for (const auto& [name, cell] : root.front().items())
        if (name == form[i] || (form[i].size() > 3 && name.starts_with(form[i]))) columns[i] = name;
    if (std::none_of(columns.begin(), columns.end(), [](const std::string& name) { return name.empty(); }))
      return columns;
  }
  return std::nullopt;
}

Json quaternionPose(const std::vector<double>& row) {
  return {{"translation", {row[1], row[2], row[3]}}, {"rotation", {row[4], row[5], row[6], row[7]}}};
}

[[noreturn]] void failLost(const Node& node) {
  node.fail("is not a pose: it holds inf or nan, as a pose that was lost does");
}

Json matrixPose(const Node& node, std::vector<double> m) {
  if (isLost(m)) failLost(node);
  if (m.size() == 16 && m[15] != 0 && m[15] != 1)
    for (double& entry : m) entry /= m[15];
  return rowsOf(m, 4);
}

/// A turn and a place by OpenCV's names.
std::optional<std::pair<Node, Node>> turnAndPlace(const Node& root) {
  if (!root.json().is_object() || root.json().size() > 3) return std::nullopt;
  for (const Json& member : root.json())
    if (const auto numbers = numbersIn(member); numbers && isIntrinsic(*numbers)) return std::nullopt;
  for (const auto& [turn, place] :
       {std::pair{"rvec", "tvec"}, {"R", "T"}, {"R", "t"}, {"rotation_vector", "translation_vector"}}) {
    const auto r = root.find(turn), t = root.find(place);
    if (!r || !t) continue;
    const auto numbers = numbersIn(r->json()), offset = numbersIn(t->json());
    if (numbers && offset && (numbers->size() == 3 || numbers->size() == 9) && offset->size() == 3)
      return std::pair(*r, *t);
  }
  return std::nullopt;
}

Import open(const Node& root) {
  PosesOfFile poses = posesOf(root);
  if (poses.direction.empty() || poses.names.size() == 1)
    root.fail(
        "is a pose and has no lens; give it to --world-from-camera or --camera-from-world, beside a lens from -c or "
        "options");
  Import result;
  result.cameras = poses.names;
  result.document = [poses](std::size_t which) {
    return Json{{"convention", "opencv"}, {poses.direction, poses.pose(which)}};
  };
  return result;
}

}  // namespace poses

bool holdsPoses(const Node& root) {
  const Json* const alone = poses::numbersAlone(root.json());
  bool isOne = false;
  return (alone && poses::widthOf(*alone, isOne) != 0) || poses::columnsOf(root.json()) || poses::turnAndPlace(root);
}

PosesOfFile posesOf(const Node& root) {
  PosesOfFile file;
  if (const auto pair = poses::turnAndPlace(root)) {
    file.names.resize(1);
    file.direction = "cameraFromWorld";
    file.pose = [turn = pair->first, place = pair->second](std::size_t) {
      const std::vector<double> r = numbersOf(turn);
      Json pose{{"translation", numbersOf(place, 3)}};
      if (r.size() == 3)
        pose["rotationVector"] = r;
      else
        pose["rotation"] = rowsOf(r, 3);
      return pose;
    };
    return file;
  }
  if (const auto columns = poses::columnsOf(root.json())) {
    for (const Json& row : root.json()) {
      const Json& time = row[(*columns)[0]];
      file.names.push_back({time.is_number()   ? formatNumber(time.get<double>())
                            : time.is_string() ? time.get<std::string>()
                                               : "",
                            ""});
    }
    file.direction = "worldFromCamera";
    file.pose = [root, columns](std::size_t which) {
      const Node row = root[which];
      std::vector<double> numbers{0};
      for (std::size_t i = 1; i < 8; ++i) numbers.push_back(numberOf(row.require((*columns)[i])));
      if (poses::isLost(numbers)) poses::failLost(row);
      return poses::quaternionPose(numbers);
    };
    return file;
  }
  const Json* const alone = poses::numbersAlone(root.json());
  bool isOne = false;
  const std::size_t width = alone ? poses::widthOf(*alone, isOne) : 0;
  if (width == 0)
    root.fail("holds no pose: expected 4 rows of 4 numbers, 12 or 16 numbers a line, or time x y z qx qy qz qw");
  const Node node(root.document(), *alone, root.json().is_array() ? "" : "#1");
  const std::vector<double> numbers = numbersOf(node);
  const std::size_t count = numbers.size() / width;
  for (std::size_t i = 0; i < count; ++i)
    file.names.push_back({width == 8 ? formatNumber(numbers[8 * i]) : isOne ? "" : std::to_string(i), ""});
  if (!isOne) file.direction = "worldFromCamera";
  file.pose = [node, numbers, width, isOne](std::size_t which) {
    const std::vector<double> row(numbers.begin() + static_cast<std::ptrdiff_t>(which * width),
                                  numbers.begin() + static_cast<std::ptrdiff_t>((which + 1) * width));
    const Node where(node.document(), node.json(),
                     isOne ? node.path() : joinedPath(node.path(), std::to_string(which)));
    if (width != 8) return poses::matrixPose(where, row);
    if (poses::isLost(row)) poses::failLost(where);
    return poses::quaternionPose(row);
  };
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
