// The pose of a line.
#include <algorithm>
#include <cmath>

#include "camera/sea_level.hpp"
#include "formats/finder/line.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view
    kToWorld =
        "c2w cam2world camera2world worldfromcam cam_to_world camera_to_world toworld world_from_cam t_wc t_bs t_sc "
        "transform_matrix t_world_cam t_imu_cam t_body_cam t_w_cam t_lidar_cam cam_to_imu cam_to_body "
        "camtoworld cameratoworld cam_to_base cam_to_lidar cam_to_velo cam_to_vehicle camera_to_lidar matrix_world "
        "cameraextrinsicmat",
    kToCamera =
        "extrinsic w2c world2cam world_to_cam worldtocam cam_from_world camera_from_world camerafromworld viewmatrix "
        "view_matrix t_cw t_cam_imu t_cam_body t_cam_world t_cam_lidar t_cam_velo lidar_to_cam lidar2cam "
        "velo_to_cam velo2cam _to_cam cam_from_rig",
    kRadians = "/0.017453292519943295", kOfNerf = "transform_matrix matrix_world camera_to_world";

/// Which way a pose goes, by its name; or empty.
std::string directionOf(const Candidate& pose, const Candidate* lens) {
  const std::string path = lowered(pose.path());
  if (hasPart(path, kToWorld)) return "worldFromCamera";
  if (!pose.terms.empty() && hasWord(pose.terms.front()->path(), "axis")) return "cameraFromWorld";
  const auto toward = lens ? towardOf(pose) : std::nullopt;
  const std::vector<std::string> names = lens ? wordsOf(lens->path()) : std::vector<std::string>{};
  if (toward && shares(toward->second, names) != shares(toward->first, names))
    return shares(toward->second, names) ? "cameraFromWorld" : "worldFromCamera";
  // Vehicles' files give extrinsics with quaternions, of either direction.
  const bool isUnclear = pose.kind == "Q" && hasPart(path, "extrinsic");
  return hasPart(path, kToCamera) && !isUnclear ? "cameraFromWorld" : "";
}

/// Of a matrix that takes the camera to the world: whether with OpenCV's axes the camera is upside down where z is up,
/// and has the world's origin behind it. Where y is down, up is -y.
bool isUpsideDown(const Candidate& pose) {
  if (pose.kind != "X") return false;
  const std::vector<double>& m = pose.numbers;
  return m[9] > std::fabs(m[5]) && m[2] * m[3] + m[6] * m[7] + m[10] * m[11] > 0;
}

/// How many objects down from the place's a turn stands; below 0: elsewhere.
std::ptrdiff_t depthOf(const Candidate& turn, const Candidate& place) {
  const std::ptrdiff_t depth = std::ssize(turn.steps) - std::ssize(place.steps);
  return depth >= 0 && std::equal(place.steps.begin(), place.steps.end() - 1, turn.steps.begin()) ? depth : -1;
}

}  // namespace

std::vector<Match> posesFor(const Candidate& first, const Candidates& all) {
  std::vector<Match> found;
  std::vector<std::pair<double, Chosen>> turns, places;
  for (const Chosen& each : all) {
    const auto score = isPoseKind(each->kind) ? nearness(first, *each) : std::nullopt;
    if (!score) continue;
    if (each->kind == "X" && *score >= 0.5) found.push_back({*score, {each}});
    if (isAmong(each->kind, "R V Q") && *score >= 0) turns.emplace_back(*score, each);
    if (isAmong(each->kind, "T E") && *score >= 0) places.emplace_back(*score, each);
  }
  constexpr std::size_t kMost = 50;
  turns.resize(std::min(turns.size(), kMost));
  places.resize(std::min(places.size(), kMost));
  for (const auto& [turnScore, turn] : turns)
    for (const auto& [placeScore, place] : places) {
      if (turn->isStarred() != place->isStarred() || turn->star.size() != place->star.size() ||
          !(turn->tag == place->tag || (place->steps.size() > 1 && depthOf(*turn, *place) > 0)) ||
          turn->path() == place->path())
        continue;
      const bool isBeside = depthOf(*turn, *place) == 0;
      found.push_back(
          {(turnScore + placeScore) / 2 + (isBeside ? 0.5 : 0) + (turn->kind == "R" ? 0.1 : 0), {turn, place}});
    }
  std::stable_sort(found.begin(), found.end(), [](const Match& a, const Match& b) { return a.score > b.score; });
  return found;
}

void putPose(LineDraft& line, const Match& match, const Candidate* lens) {
  const Chosen& turn = match.parts.front();
  const Chosen& place = match.parts.back();
  const bool areAxes = !turn->terms.empty() && hasWord(turn->terms.front()->path(), "axis");
  const bool isOpenCv =
      place->kind == "T" &&
      (turn->kind == "V" || (turn->kind == "R" && (hasWord(turn->path(), "r") || turn->suffix.starts_with('['))));
  std::string direction = directionOf(*turn, lens);
  const std::string shown = turn->terms.empty() ? turn->path() : turn->terms.front()->path() + " ...";
  const bool isNerf = hasPart(lowered(turn->path()), kOfNerf);
  if (isNerf) line.set = {"cameraAxes=RUB", "viewport.pixelCenter=0.5"};
  if (direction.empty() && isOpenCv) {
    direction = "cameraFromWorld";
    line.ask.push_back(shown + ", " + place->path() +
                       ": taken as camera from world, as solvePnP and calibrateCamera return them");
  }
  line.isEitherWay = direction.empty();
  if (line.isEitherWay) direction = "worldFromCamera";
  line.pose = turn->path() + (turn == place ? "" : ", " + place->path());
  if (match.parts.size() > 1) {
    const bool isList = turn->kind == "Q" && turn->terms.empty() && !turn->isOrdered;
    const std::string_view order = quaternionOrderOf(turn->path());
    const bool isWFirst =
        isList && (order == "wxyz" ||
                   (order.empty() && (hasWord(turn->path(), "qvec") || std::fabs(turn->numbers.front()) > 0.9)));
    const std::string form = turn->kind == "R"   ? "rotation"
                             : turn->kind == "V" ? "rotationVector"
                             : isWFirst          ? "quaternionWFirst"
                                                 : "quaternion";
    if (isList && order.empty()) {
      line.turnOfNoOrder = turn->path();
      line.ask.push_back(turn->path() + ": x y z w, or w first (quaternionWFirst)?");
    }
    const bool isByColumns = lens && lens->suffix == "^T" && turn->kind == "R" && turn->terms.empty();
    line.add(direction + "." + form, {turn}, match.score / 2, isByColumns ? "^T" : "");
    if (isByColumns) line.ask.push_back(turn->path() + "^T: by columns, as K is; without ^T if it is by rows");
    line.add(place->kind == "T" && !areAxes ? direction + ".translation" : "position", {place}, match.score / 2);
  } else {
    line.add(direction, {turn}, match.score);
  }
  const auto isByRows = [](const Candidate& each) {
    return !each.isFlat || each.numbers == transposed(each.numbers, 3);
  };
  if (turn->kind == "R" && !isByRows(turn->isStarred() ? *turn->star.begin()->second : *turn))
    line.ask.push_back(turn->path() + ": its 9 numbers by rows; " + turn->path() +
                       "^T if they go by columns, as RealSense's extrinsics do");
  if (line.isEitherWay)
    line.ask.push_back(
        shown +
        ": worldFromCamera if its translation is the camera's place, cameraFromWorld as solvePnP and COLMAP give it");
  const bool isInPixels = lens && !lens->kind.starts_with("fov"), isPair = place->kind == "T" && turn->kind != "Q";
  if (!isNerf && direction == "worldFromCamera" && isUpsideDown(*turn)) {
    line.set.emplace_back("cameraAxes=RUB");
    line.ask.push_back(shown +
                       ": worldFromCamera likely of axes right, up, back; with right, down, forward it is upside down "
                       "where z is up, and looks away from the origin");
  } else if (areAxes || (!isNerf && !isOpenCv && !(isInPixels && (isPair || direction == "cameraFromWorld")))) {
    line.ask.push_back(shown +
                       ": axes right, down, forward; --set cameraAxes=RUB if it looks along its -z, FLU along x");
  }
}

void putAim(LineDraft& line, const Candidate& first, const Candidates& all) {
  const auto eye = bestOf(first, all, "E");
  for (const char* kind : {"direction", "target"})
    if (const auto aim = eye ? bestOf(first, all, kind) : std::nullopt) {
      line.pose = sumOf(eye->parts) + ", " + sumOf(aim->parts);
      line.add("position", eye->parts, eye->score);
      line.add(kind, aim->parts, aim->score);
      const auto up = bestOf(first, all, "up");
      line.add("up", up ? up->parts : std::vector<Chosen>{}, 0, up ? "" : "0+0+1");
      if (!up) line.ask.push_back("up=0+0+1 where z is up, up=0+1+0 where y is");
      line.ask.emplace_back(
          "a right-handed world; --set convention=unity where it is left-handed with y up, =unreal with z up");
      return;
    }
}

namespace {

/// Three angles beside a place, without a compass: scalars of these names, or a list that is called so.
struct AnglesBesidePlace {
  std::string_view kind, words, suffix, order, axes, question;
};
constexpr std::string_view kOfOpk = "omega, phi, kappa of photogrammetry, x east, y north, z up",
                           kOfRpy =
                               "roll, pitch, yaw as ROS has them, of a camera that looks along x at zeros, where z is "
                               "up; cameraAxes=FRD where z is down; heading=yaw+pitch+roll for a compass's yaw; "
                               "convention=unreal and euler.order=unreal for Unreal's",
                           kOfXyz = "turns about x, y, z as Blender has them; euler.order=unity or godot where y is up";
constexpr AnglesBesidePlace kAngles[] = {
    {"opk", "", "", "opk", "RUB", kOfOpk},         {"rpy", "", "", "rpy", "FLU", kOfRpy},
    {"A", "opk", "", "opk", "RUB", kOfOpk},        {"A", "rpy", "", "rpy", "FLU", kOfRpy},
    {"A", "ypr", "[2,1,0]", "rpy", "FLU", kOfRpy}, {"A", "", "", "blender", "RUB", kOfXyz}};

}  // namespace

void putAngles(LineDraft& line, const Candidates& all, bool isUnreal) {
  const auto best = [&](std::string_view kind) { return bestOf(*line.first, all, kind); };
  if (isUnreal && line.first->kind == "fov") {
    line.parts.front().first = "fovX";
    line.ask = {line.first->path() + ": across, as Unreal and CARLA have it"};
  }
  const auto heading = best("hpr"), pyr = best("pyr"), rpy = best("rpy"), opk = best("opk"), list = best("A");
  const auto turns = rpy ? rpy : opk ? opk : heading ? heading : list;
  if (!turns) return;
  // The place beside the angles.
  const Candidate& first = *turns->parts.front();
  const auto earth = bestOf(first, all, "place"), eye = earth ? earth : bestOf(first, all, "E");
  if (!line.poses.empty() || !line.pose.empty() || !eye) return;
  const auto put = [&](const std::string& part, const Match& match, const std::string& suffix,
                       const std::vector<std::string>& set, const std::string& question) {
    const bool areRadians = line.parts.front().second.ends_with(kRadians);  // as the angle of view
    const std::string places = sumOf(eye->parts), unit(areRadians ? kRadians : "");
    std::string angles;
    const Candidate& listed = *match.parts.front();
    for (const Chosen& each : listed.terms) angles += (angles.empty() ? "" : "+") + each->path() + unit;
    if (listed.terms.empty()) angles = listed.path() + suffix + unit;
    const bool isLow = earth && earth->parts.front()->numbers.size() < 3;
    line.pose = places + ", " + angles;
    line.add(earth ? "latLonHeight" : "position", eye->parts, eye->score, isLow ? "+0" : "");
    line.add(part, match.parts, match.score);
    line.parts.back().second = angles;
    line.set.insert(line.set.end(), set.begin(), set.end());
    line.ask.push_back(angles + ": " + question);
    if (earth && !isLow && isSeaLevelName(eye->parts.front()->terms.back()->steps.back()))
      line.ask.push_back(eye->parts.front()->terms.back()->path() +
                         ": taken as above the ellipsoid; to one above sea level add the geoid's height there");
    if (isLow) line.ask.push_back(places + ": with a height of 0; write that above the ellipsoid in its place");
    if (!areRadians &&
        std::all_of(listed.numbers.begin(), listed.numbers.end(), [](double angle) { return std::fabs(angle) < 7; }))
      line.ask.push_back(angles + ": degrees; " + std::string(kRadians) + " behind each path of radians");
  };
  if (heading && (earth || !rpy))
    return put(
        "heading", *heading, "", {},
        "clockwise from north, above the horizon, right side down; /-1 behind an angle that counts the other way");
  if (earth) return;
  if (isUnreal && pyr)
    return put("euler", *pyr, "", {"convention=unreal", "euler.order=unreal"},
               "taken as Unreal's and CARLA's, y to the right, pitch up, yaw clockwise; ROS's y is to the left");
  for (const AnglesBesidePlace& each : kAngles) {
    const auto match = best(each.kind);
    if (!match || !(each.words.empty() || hasWord(match->parts.front()->path(), each.words))) continue;
    std::vector<std::string> set{"euler.order=" + std::string(each.order), "cameraAxes=" + std::string(each.axes)};
    if (each.order == "opk") set.emplace_back("world=enu");
    return put("euler", *match, std::string(each.suffix), set, std::string(each.question));
  }
}

void sharePoses(std::vector<LineDraft>& lines) {
  for (LineDraft& line : lines) {
    if (line.poses.empty()) continue;
    const Match& match = line.poses.front();
    const Chosen& pose = match.parts.front();
    if (!pose->isStarred() && !line.first->isStarred()) {
      LineDraft* owner = nullptr;
      std::size_t rivals = 0;
      for (LineDraft& other : lines) {
        const bool isRival = !other.poses.empty() && !other.first->isStarred() &&
                             other.first->kind == line.first->kind && other.poses.front().parts.front() == pose &&
                             std::fabs(other.poses.front().score - match.score) < 1e-9 &&
                             other.first->steps.size() == line.first->steps.size();
        if (!isRival) continue;
        ++rivals;
        const auto toward = towardOf(*pose);
        if (!owner || !toward || shares(other.first->tag, toward->second)) owner = &other;
      }
      if (rivals > 1 && owner != &line) {
        line.ask.push_back(pose->path() + ": one pose for " + std::to_string(rivals) +
                           " cameras; here it is given to the other");
        continue;
      }
      line.isOfPair = rivals > 1;
      if (line.isOfPair)
        line.ask.push_back(sumOf(match.parts) + ": one pose beside " + std::to_string(rivals) +
                           " cameras: this one's, as stereoCalibrate gives it from the first?");
    }
    putPose(line, match, line.first.get());
  }
}

}  // namespace viewproj::cmd
