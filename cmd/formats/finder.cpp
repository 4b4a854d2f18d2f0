// Which parts go together, and which of their lines is the likeliest.
#include "formats/finder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "camera/fields.hpp"
#include "formats/candidates.hpp"
#include "formats/parts.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

using Chosen = std::shared_ptr<const Candidate>;

bool isPoseKind(std::string_view kind) { return isAmong(kind, "X R V Q T E"); }

bool includes(const std::vector<std::string>& all, const std::vector<std::string>& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/// Of rotation_left_to_right, depth2color: the words before and after.
std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>> towardOf(const Candidate& pose) {
  const std::string path = lowered(pose.path());
  for (const std::string_view link : {"_to_", "_2_", "2"}) {
    const std::size_t at = path.find(link);
    if (at == std::string::npos || at == 0 || path.find("c2w") != std::string::npos ||
        path.find("w2c") != std::string::npos)
      continue;
    const std::size_t first = path.find_last_of("._", at - 1), after = at + link.size();
    const std::size_t end = std::min(path.find_first_of("._", after), path.size());
    const std::size_t begin = first == std::string::npos ? 0 : first + 1;
    if (begin == at || end == after) continue;
    return std::pair(wordsOf(path.substr(begin, at - begin)), wordsOf(path.substr(after, end - after)));
  }
  return std::nullopt;
}

/// How well a part goes with the line's first; nothing: not at all.
std::optional<double> nearness(const Candidate& first, const Candidate& part) {
  double score = part.name;
  if (first.isStarred() && part.isStarred()) {
    const auto shared = std::count_if(first.star.begin(), first.star.end(),
                                      [&](const auto& each) { return part.star.contains(each.first); });
    if (shared < std::min<std::ptrdiff_t>(2, std::ssize(first.star)) || 2 * shared < std::ssize(first.star))
      return std::nullopt;
    score += shared == std::ssize(first.star) ? 4 : 2;
  } else if (first.isStarred()) {
    const auto box = first.steps.begin() + static_cast<std::ptrdiff_t>(first.at);
    const bool isInside = part.steps.size() > first.at + 1 && std::equal(first.steps.begin(), box, part.steps.begin());
    if (isPoseKind(part.kind) || (isInside && *box == "*")) return std::nullopt;
  } else if (part.isStarred()) {
    const std::size_t depth = first.steps.size() - 1;
    const bool isBeside =
        part.steps.size() > depth && std::equal(first.steps.begin(), first.steps.end() - 1, part.steps.begin());
    if (!isPoseKind(part.kind) || !isBeside) return std::nullopt;
  }
  const std::vector<std::string>& a = first.tag;
  std::vector<std::string> words;
  if (!first.isStarred() && part.isStarred())
    std::copy_if(part.tag.begin(), part.tag.end(), std::back_inserter(words),
                 [](const std::string& word) { return !isDigit(word[0]); });
  const std::vector<std::string>& b = !first.isStarred() && part.isStarred() ? words : part.tag;
  if (a == b) return score + 3;
  if (includes(a, b)) return score + 2;
  if (includes(b, a)) return score + 1 - 0.3 * static_cast<double>(b.size() - a.size());
  const auto hasOther = [](const std::vector<std::string>& from, const std::vector<std::string>& without) {
    return std::any_of(from.begin(), from.end(), [&](const std::string& word) {
      return !isDigit(word[0]) && std::find(without.begin(), without.end(), word) == without.end();
    });
  };
  if (isAmong(part.kind, "S w h")) return score - 2;
  const auto leads = [&] { return isPoseKind(part.kind) && !part.isStarred() && towardOf(part); };
  if (hasOther(a, b) && hasOther(b, a) && !leads()) return std::nullopt;
  return score - 2;
}

struct Match {
  double score = 0;
  std::vector<Chosen> parts;
};

/// The best part of a kind, if it is good enough.
std::optional<Match> bestOf(const Candidate& first, const Candidates& all, std::string_view kind) {
  constexpr double kLeast = 0.5;
  std::optional<Match> best;
  for (const Chosen& each : all) {
    if (each->kind != kind) continue;
    const auto score = nearness(first, *each);
    if (score && *score >= kLeast && (!best || *score > best->score)) best = Match{*score, {each}};
  }
  return best;
}

/// Scalars of one object, or of several: by their container.
using Scalars = std::map<std::string, Chosen, std::less<>>;
std::vector<Scalars> scalarsOf(const Candidates& all) {
  std::map<std::string, Scalars> boxes;
  for (const Chosen& each : all) {
    if (each->numbers.size() != 1) continue;
    std::string key = each->isStarred() ? "*" + std::to_string(each->at) + "/" + std::to_string(each->star.size()) : "";
    for (std::size_t i = 0; i + 1 < each->steps.size(); ++i) key += "\n" + each->steps[i];
    // Camera1.fx and Camera2.fx of one object are of two cameras, and so are fx_color and fx_depth.
    const std::string& last = each->steps.back();
    key += "\n" + (last.rfind('.') == std::string::npos ? "" : last.substr(0, last.rfind('.'))) + besideScalar(last);
    boxes[key].emplace(each->kind, each);
  }
  std::vector<Scalars> list;
  for (auto& [key, scalars] : boxes) list.push_back(std::move(scalars));
  return list;
}

/// The scalars of these kinds, if all are there.
std::vector<Chosen> together(const Scalars& scalars, std::initializer_list<std::string_view> kinds) {
  std::vector<Chosen> found;
  for (const std::string_view kind : kinds) {
    const auto each = scalars.find(kind);
    if (each == scalars.end()) return {};
    found.push_back(each->second);
  }
  return found;
}

/// Adds what nine, four or three scalars make together.
void addFamilies(const std::vector<Scalars>& boxes, Candidates& all) {
  const auto add = [&](const char* kind, const std::vector<Chosen>& terms, double name) {
    if (terms.empty()) return;
    Candidate family{kind, terms.front()->steps, {}, name, ""};
    family.steps.back() = "";
    for (const Chosen& term : terms) family.numbers.push_back(term->numbers.front());
    if (family.kind == "R" && !isRotation(family.numbers)) return;
    family.star = terms.front()->star;
    family.at = terms.front()->at;
    family.terms = terms;
    family.tag = findTag(family);
    all.push_back(std::make_shared<Candidate>(std::move(family)));
  };
  for (const Scalars& box : boxes) {
    add("R", together(box, {"r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"}), 2);
    add("Q", together(box, {"qx", "qy", "qz", "qw"}), 2);
    add("T", together(box, {"tx", "ty", "tz"}), 2);
    if (!box.contains("w")) add("E", together(box, {"x", "y", "z"}), 1);  // w: x y z of a quaternion
    add("euler", together(box, {"pitch", "yaw", "roll"}), 2);
    add("E", together(box, {"gx", "gy", "pz"}), 1);
  }
}

/// Radial coefficients k of an object that is a lens, with the tangential p beside them.
void addCoefficients(Candidates& all) {
  const Candidates found = all;
  for (const Chosen& k : found) {
    if (k->kind != "k" || k->steps.size() < 2 || !hasWord(k->steps[k->steps.size() - 2], "lens dist distortion"))
      continue;
    const auto beside = std::find_if(found.begin(), found.end(), [&](const Chosen& p) {
      return p->kind == "p" && p->star.size() == k->star.size() && p->at == k->at &&
             std::equal(p->steps.begin(), p->steps.end() - 1, k->steps.begin(), k->steps.end() - 1);
    });
    const auto partOf = [&](const char* suffix) {
      Candidate part = *k;
      part.suffix = suffix;
      return std::make_shared<Candidate>(std::move(part));
    };
    const Chosen none = std::make_shared<Candidate>(Candidate{"?", {"0+0"}, {0, 0}, 0, ""});
    Candidate lens{"D", k->steps, k->numbers, 2, "", k->star, k->at};
    lens.steps.back() = "";
    const Chosen p = beside == found.end() ? none : *beside;
    if (k->numbers.size() == 3)
      lens.terms = {partOf("[0,1]"), p, partOf("[2]")};
    else if (p != none && k->numbers.size() == 2)
      lens.terms = {k, p};
    else
      lens.terms = {k};
    lens.tag = findTag(lens);
    all.push_back(std::make_shared<Candidate>(std::move(lens)));
  }
}

constexpr std::string_view
    kToWorld =
        "c2w cam2world camera2world cam_to_world camera_to_world toworld world_from_cam t_wc t_bs t_sc "
        "transform_matrix t_world_cam t_imu_cam t_body_cam t_w_cam t_lidar_cam cam_to_imu cam_to_body "
        "camtoworld cameratoworld cam_to_base cam_to_lidar cam_to_velo cam_to_vehicle camera_to_lidar matrix_world "
        "cameraextrinsicmat",
    kToCamera =
        "extrinsic w2c world2cam world_to_cam worldtocam cam_from_world camera_from_world viewmatrix "
        "view_matrix t_cw t_cam_imu t_cam_body t_cam_world t_cam_lidar t_cam_velo lidar_to_cam lidar2cam "
        "velo_to_cam velo2cam _to_cam cam_from_rig",
    kOfNerf = "transform_matrix matrix_world camera_to_world", kFisheye = "fisheye equidistant kannala \"kb4\"",
    kOfUnreal = "unreal carla sensor.camera image_size_x relativerotation";

/// Whether a text has one of these in it.
bool hasPart(std::string_view text, std::string_view parts) {
  const std::vector<std::string_view> all = wordsIn(parts);
  return std::any_of(all.begin(), all.end(),
                     [&](std::string_view part) { return text.find(part) != std::string_view::npos; });
}

bool shares(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](const std::string& word) { return std::find(b.begin(), b.end(), word) != b.end(); });
}

/// Which way a pose goes, by its name; or empty.
std::string directionOf(const Candidate& pose, const Candidate* lens) {
  const std::string path = lowered(pose.path());
  if (hasPart(path, kToWorld)) return "worldFromCamera";
  const auto toward = lens ? towardOf(pose) : std::nullopt;
  const std::vector<std::string> names = lens ? wordsOf(lens->path()) : std::vector<std::string>{};
  if (toward && shares(toward->second, names) != shares(toward->first, names))
    return shares(toward->second, names) ? "cameraFromWorld" : "worldFromCamera";
  // Vehicles' files give extrinsics with quaternions, of either direction.
  const bool isUnclear = pose.kind == "Q" && hasPart(path, "extrinsic");
  return hasPart(path, kToCamera) && !isUnclear ? "cameraFromWorld" : "";
}

std::string sumOf(const std::vector<Chosen>& terms) {
  std::string sum;
  for (const Chosen& each : terms) sum += (sum.empty() ? "" : "+") + each->path();
  return sum;
}

struct Line {
  std::vector<std::pair<std::string, std::string>> parts;
  double score = 0;
  std::vector<std::string> ask;
  Chosen first;
  std::vector<Chosen> used;
  std::vector<Match> poses{};
  bool isNerf = false, isUnreal = false;

  void add(const std::string& name, const std::vector<Chosen>& chosen, double value, const std::string& suffix = "") {
    parts.emplace_back(name, sumOf(chosen) + suffix);
    score += value;
    used.insert(used.end(), chosen.begin(), chosen.end());
  }
};

/// A matrix, or a turn and a place of the same tag.
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
          turn->tag != place->tag || turn->path() == place->path())
        continue;
      const bool isBeside =
          std::equal(turn->steps.begin(), turn->steps.end() - 1, place->steps.begin(), place->steps.end() - 1);
      found.push_back(
          {(turnScore + placeScore) / 2 + (isBeside ? 0.5 : 0) + (turn->kind == "R" ? 0.1 : 0), {turn, place}});
    }
  std::stable_sort(found.begin(), found.end(), [](const Match& a, const Match& b) { return a.score > b.score; });
  return found;
}

/// Of a matrix that takes the camera to the world: whether with OpenCV's axes the camera is upside down where z is up,
/// and has the world's origin behind it. Where y is down, up is -y.
bool isUpsideDown(const Candidate& pose) {
  if (pose.kind != "X" || !pose.suffix.empty()) return false;
  const std::vector<double>& m = pose.numbers;
  return m[9] > std::fabs(m[5]) && m[2] * m[3] + m[6] * m[7] + m[10] * m[11] > 0;
}

void putPose(Line& line, const Match& match, const Candidate* lens) {
  const Chosen& turn = match.parts.front();
  const Chosen& place = match.parts.back();
  const bool isOpenCv = place->kind == "T" && (turn->kind == "V" || (turn->kind == "R" && hasWord(turn->path(), "r")));
  std::string direction = directionOf(*turn, lens);
  line.isNerf = hasPart(lowered(turn->path()), kOfNerf);
  if (match.parts.size() > 1) {
    if (direction.empty() && isOpenCv) {
      direction = "cameraFromWorld";
      line.ask.push_back(turn->path() + ", " + place->path() +
                         ": taken as camera from world, as solvePnP and calibrateCamera return them");
    }
    const bool isList = turn->kind == "Q" && turn->terms.empty() && !turn->isOrdered;
    const std::string_view order = quaternionOrderOf(turn->path());
    const bool isWFirst =
        isList && (order == "wxyz" ||
                   (order.empty() && (hasWord(turn->path(), "qvec") || std::fabs(turn->numbers.front()) > 0.9)));
    const std::string form = turn->kind == "R"   ? "rotation"
                             : turn->kind == "V" ? "rotationVector"
                             : isWFirst          ? "quaternionWFirst"
                                                 : "quaternion";
    if (isList && order.empty()) line.ask.push_back(turn->path() + ": x y z w, or w first (quaternionWFirst)?");
    const std::string pose = direction.empty() ? "pose" : direction;
    line.add(pose + "." + form, {turn}, match.score / 2);
    line.add(place->kind == "T" ? pose + ".translation" : "position", {place}, match.score / 2);
  } else {
    line.add(direction.empty() ? "pose" : direction, {turn}, match.score);
  }
  const auto isByRows = [](const Candidate& each) {
    return !each.isFlat || each.numbers == transposed(each.numbers, 3);
  };
  if (turn->kind == "R" && !isByRows(turn->isStarred() ? *turn->star.begin()->second : *turn))
    line.ask.push_back(turn->path() + ": its 9 numbers by rows; " + turn->path() +
                       "^T if they go by columns, as RealSense's extrinsics do");
  if (direction.empty())
    line.ask.push_back(
        turn->path() +
        ": camera from world (as solvePnP, COLMAP give it) or world from camera (its translation is the place)?");
  const bool isInPixels = lens && !lens->kind.starts_with("fov"), isPair = place->kind == "T" && turn->kind != "Q";
  if (!line.isNerf && direction != "cameraFromWorld" && isUpsideDown(*turn))
    line.ask.push_back(
        turn->path() +
        ": if world from camera, likely right, up, back: --set cameraAxes=RUB; with right, down, forward it "
        "is upside down where z is up, and looks away from the origin");
  else if (!line.isNerf && !isOpenCv && !(isInPixels && (isPair || direction == "cameraFromWorld")))
    line.ask.push_back(turn->path() + ": axes right, down, forward; --set cameraAxes=RUB if it looks along its -z");
}

std::optional<std::array<double, 2>> centreOf(const Line& line) {
  std::vector<double> k;
  for (const Chosen& each : line.used) k.insert(k.end(), each->numbers.begin(), each->numbers.end());
  if (k.size() == 9) return std::array{k[2], k[5]};
  if (k.size() == 3 || k.size() == 4) return std::array{k[k.size() - 2], k[k.size() - 1]};
  return std::nullopt;
}

/// A focal length that is short beside the picture is in millimetres, which the size of a pixel divides. lens: the
/// parts of K.
void putUnit(Line& line, const Candidates& all, const std::vector<Chosen>& lens, double width) {
  const std::string focal = lens.front()->path();
  const double f = lens.front()->numbers.front();
  if (line.parts.front().first != "K" || f >= kLeastFocal * width) return;
  const auto pixel = bestOf(*line.first, all, "pixel");
  if (!pixel || f < 1 || lens.front()->numbers.size() > 2)
    return line.ask.push_back(focal +
                              ": so short beside the picture that it is no pixels: millimetres over the size of a "
                              "pixel, as in /0.00345, or a fraction of the width?");
  constexpr double kLeastMicrometres = 0.1, kLeastMillimetres = 1e-4;
  const double size = pixel->parts.front()->numbers.front();
  const double millimetres = size >= kLeastMicrometres ? size / 1000 : size >= kLeastMillimetres ? size : size * 1000;
  constexpr int kDigits = 12;
  std::string& terms = line.parts.front().second;
  terms.clear();
  for (const Chosen& each : lens)
    terms += (terms.empty() ? "" : "+") + each->path() +
             (isAmong(each->kind, "f fx fy F") ? "/" + formatDigits(millimetres, kDigits) : "");
  line.used.push_back(pixel->parts.front());
  line.ask.push_back(focal + ": in millimetres, over " + pixel->parts.front()->path() + " of " +
                     formatDigits(1000 * millimetres, kDigits) + " micrometres?");
}

void putSize(Line& line, const Candidates& all, const std::vector<Scalars>& boxes) {
  const std::vector<Chosen> lens = line.used;
  const auto centre = centreOf(line);
  auto best = bestOf(*line.first, all, "S");
  for (const Scalars& box : boxes) {
    const std::vector<Chosen> sides = together(box, {"w", "h"});
    if (sides.empty() || sides[0]->numbers[0] < 16 || sides[1]->numbers[0] < 16 ||
        sides[0]->star.size() != sides[1]->star.size())
      continue;
    const auto score = nearness(*line.first, *sides[0]);
    if (score && *score >= 0.5 && (!best || *score >= best->score)) best = Match{*score, sides};
  }
  if (!best) return;
  std::vector<double> size;
  for (const Chosen& each : best->parts) size.insert(size.end(), each->numbers.begin(), each->numbers.end());
  const auto missOf = [&](double w, double h) {
    return std::fabs((*centre)[0] - w / 2) / w + std::fabs((*centre)[1] - h / 2) / h;
  };
  const bool isSwapped =
      best->parts.size() == 1 && centre && missOf(size[1], size[0]) < missOf(size[0], size[1]) - 0.02;
  line.add("size", best->parts, best->score, isSwapped ? "[1,0]" : "");
  if (isSwapped)
    line.ask.push_back(best->parts.front()->path() + ": cx, cy fit the other order better, which [1,0] gives");
  else if (best->parts.size() == 1 && size[1] > size[0])
    line.ask.push_back(best->parts.front()->path() + ": is taller than wide; [1,0] if it is height, width");
  if (centre && !isSwapped &&
      ((*centre)[0] < 0.1 * size[0] || (*centre)[0] > 0.9 * size[0] || (*centre)[1] < 0.1 * size[1] ||
       (*centre)[1] > 0.9 * size[1])) {
    line.ask.push_back("cx, cy are far from the middle of the picture: from its middle, or of another size?");
    line.score -= 2;
  }
  putUnit(line, all, lens, size[isSwapped ? 1 : 0]);
}

void putLens(Line& line, const Candidates& all, const std::vector<Scalars>& boxes, bool isFisheye) {
  constexpr std::string_view kFisheyeWords = "fisheye equidistant kb4 kannalabrandt kannala brandt equi";
  const auto list = bestOf(*line.first, all, "D");
  const Scalars* named = nullptr;
  double score = list ? list->score : 0;
  for (const Scalars& box : boxes) {
    const auto k1 = box.find("k1");
    const auto near = k1 == box.end() ? std::nullopt : nearness(*line.first, *k1->second);
    if (near && *near >= 0.5 && *near > score) {
      named = &box;
      score = *near;
    }
  }
  const bool isFish = isFisheye || hasWord(line.first->path(), kFisheyeWords);
  if (!named && list) {
    const Chosen& d = list->parts.front();
    const bool isFour = d->numbers.size() == 4, isF = isFour && (isFish || hasWord(d->path(), kFisheyeWords));
    line.add(isF ? "fisheye" : "distortion", list->parts, list->score);
    if (isFour && !isF)
      line.ask.push_back(d->path() +
                         ": 4 numbers are k1 k2 p1 p2; fisheye=… if its program says fisheye or equidistant");
    return;
  }
  if (!named) return;
  std::vector<Chosen> k = together(*named, {"k1", "k2", "p1", "p2"});
  // k4 to k6 are of the rational lens, with p1 and p2 or without.
  const bool isRational = named->contains("k6") && !together(*named, {"k1", "k2", "k3", "k4", "k5"}).empty();
  if (k.empty() && isRational) {
    line.add("distortion", together(*named, {"k1", "k2"}), score,
             "+0+0+" + sumOf(together(*named, {"k3", "k4", "k5", "k6"})));
    for (const Chosen& each : together(*named, {"k3", "k4", "k5", "k6"})) line.used.push_back(each);
    return;
  }
  if (!k.empty()) {
    if (hasWord(k[2]->path(), "tangential"))
      line.ask.push_back(k[2]->path() + ", " + k[3]->path() +
                         ": taken as p1 and p2, as Azure Kinect has them; else exchange them");
    for (const char* more : {"k3", "k4", "k5", "k6"})
      if (named->contains(more) && (more[1] == '3' || named->contains("k6"))) k.push_back(named->find(more)->second);
    return line.add("distortion", k, score);
  }
  k = together(*named, {"k1", "k2", "k3", "k4"});
  if (!k.empty()) {
    line.add("fisheye", k, score);
    if (!isFish) line.ask.push_back("k1 to k4 without p1, p2: fisheye, or brown?");
    return;
  }
  if (named->contains("k2") && named->contains("k3")) {
    line.add("distortion", together(*named, {"k1", "k2"}), score / 2, "+0+0+" + named->find("k3")->second->path());
    line.used.push_back(named->find("k3")->second);
    return;
  }
  k = together(*named, {"k1", "k2"});
  line.add("distortion", k.empty() ? std::vector<Chosen>{named->find("k1")->second} : k, score);
}

/// What may be wrong with a lens that begins with these coefficients.
void askAboutLens(Line& line, const Candidate& lens, const Candidates& all, std::string_view text) {
  constexpr double kLeast = 1e-6;
  if (const double k1 = std::fabs(lens.numbers.front()); k1 > 0 && k1 < kLeast)
    line.ask.push_back(lens.path() + ": so small that it may count pixels; k1 here is of focal lengths, f^2 as large");
  if (text.find("inverse brown") != std::string_view::npos || text.find("inverse_brown") != std::string_view::npos)
    line.ask.push_back(lens.path() + ": of an inverse Brown-Conrady lens, as the file says, which parts cannot say");
  for (const Chosen& other : all)
    if (other->kind == "K" && other != line.first && hasWord(other->steps.back(), "original raw distorted") &&
        !hasWord(line.first->steps.back(), "original raw distorted") &&
        std::equal(other->steps.begin(), other->steps.end() - 1, line.first->steps.begin(),
                   line.first->steps.end() - 1))
      line.ask.push_back(other->path() + ": this K may be the one that the distortion goes with");
}

/// A text with several lenses, of which a line takes the first.
void askAboutOthers(Line& line, const Document& file) {
  const std::string path = line.first->path();
  const auto others = file.isPlainText ? valueAt(Node(file), path + "#") : std::nullopt;
  if (others && others->json().is_array())
    line.ask.push_back(path + ": comes " + std::to_string(others->size() + 1) +
                       " times, and this line reads the first; for the second write " + path +
                       "#.0, and #.0 behind the other names too");
}

/// The place and the turns of a camera in Unreal or CARLA, whose angle of view is that across.
void putUnreal(Line& line, const Candidates& all) {
  if (line.first->kind == "fov") {
    line.parts.front().first = "fovX";
    line.ask = {line.first->path() + ": across, as Unreal and CARLA have it"};
  }
  const auto eye = bestOf(*line.first, all, "E"), turns = bestOf(*line.first, all, "euler");
  if (!line.poses.empty() || !eye || !turns) return;
  line.add("position", eye->parts, eye->score);
  line.add("euler", turns->parts, turns->score);
  line.ask.push_back(
      turns->parts.front()->path() +
      ": taken as Unreal's and CARLA's, y to the right, pitch up, yaw clockwise; ROS's y is to the left");
  line.isUnreal = true;
}

/// A place, and what is looked at from there.
void putAim(Line& line, const Candidate& first, const Candidates& all) {
  const auto eye = bestOf(first, all, "E");
  for (const char* kind : {"direction", "target"})
    if (const auto aim = eye ? bestOf(first, all, kind) : std::nullopt) {
      line.add("position", eye->parts, eye->score);
      line.add(kind, aim->parts, aim->score);
      const auto up = bestOf(first, all, "up");
      line.add("up", up ? up->parts : std::vector<Chosen>{}, 0, up ? "" : "0+0+1");
      if (!up) line.ask.push_back("up=0+0+1 where z is up, up=0+1+0 where y is");
      return;
    }
}

/// The lines that begin with a lens.
std::vector<Line> lensLines(const Candidates& all, const std::vector<Scalars>& boxes) {
  std::vector<Line> lines;
  // What many cameras have in common is said by the line of all of them.
  constexpr std::size_t kMany = 10;
  std::set<const Candidate*> covered;
  for (const Chosen& each : all)
    if (each->star.size() >= kMany)
      for (const auto& [star, one] : each->star) covered.insert(one.get());
  const auto begin = [&](const std::string& name, const std::vector<Chosen>& chosen, double score,
                         const std::string& suffix = "") {
    Line line;
    line.first = chosen.front();
    line.add(name, chosen, score, suffix);
    lines.push_back(std::move(line));
  };
  for (const Chosen& each : all) {
    if (covered.contains(each.get())) continue;
    if (each->kind == "K" && each->name >= 0) begin("K", {each}, 3 + each->name);
    if (each->kind == "P") begin("P", {each}, 2 + each->name);
    if (each->kind == "F" || (each->kind == "f" && each->numbers.front() > 5))
      if (const auto centre = bestOf(*each, all, "C")) begin("K", {each, centre->parts.front()}, 4);
  }
  for (const Scalars& box : boxes) {
    if (covered.contains(box.begin()->second.get())) continue;
    const auto tryOut = [&](std::initializer_list<std::string_view> kinds, double score) {
      const std::vector<Chosen> chosen = together(box, kinds);
      if (chosen.empty() || chosen.front()->numbers.front() <= 5) return false;
      begin("K", chosen, score);
      return true;
    };
    if (tryOut({"fx", "fy", "cx", "cy"}, 4.5) || tryOut({"gx", "gy", "cx", "cy"}, 4.5) ||
        tryOut({"fx", "cx", "cy"}, 4) || tryOut({"f", "cx", "cy"}, 4) ||
        (!box.contains("cx") &&
         (tryOut({"fx", "fy"}, 2) || (box.contains("pixel") && box.contains("w") && tryOut({"f"}, 2))))) {
      if (lines.back().used.size() <= 2) lines.back().ask.push_back("no cx, cy: the middle of the picture is taken");
      continue;
    }
    for (const auto& [kind, name] : {std::pair{"fovY", "fovY"}, {"fovX", "fovX"}, {"fov", "fovY"}}) {
      const auto angle = box.find(std::string_view(kind));
      if (angle == box.end() || angle->second->numbers.front() < 0.2) continue;
      const bool isRadians =
          angle->second->numbers.front() < 3.2 && !hasWord(angle->second->path(), "deg degs degrees");
      begin(name, {angle->second}, kind == std::string_view("fov") ? 1 : 2, isRadians ? "/0.017453292519943295" : "");
      if (isRadians && !hasWord(angle->second->path(), "rad rads radians angle"))
        lines.back().ask.push_back(angle->second->path() +
                                   ": in radians, as it is below 3.2? Without /0.0174… where it is in degrees");
      if (kind == std::string_view("fov")) lines.back().ask.push_back(angle->second->path() + ": fovY or fovX?");
      break;
    }
  }
  return lines;
}

/// One pose beside two lenses of one template is the last one's, or that of B in A_to_B.
void sharePoses(std::vector<Line>& lines) {
  for (Line& line : lines) {
    if (line.poses.empty()) continue;
    const Match& match = line.poses.front();
    const Chosen& pose = match.parts.front();
    if (!pose->isStarred() && !line.first->isStarred()) {
      Line* owner = nullptr;
      std::size_t rivals = 0;
      for (Line& other : lines) {
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
    }
    putPose(line, match, line.first.get());
  }
}

std::vector<Line> linesOf(const Document& file, const Candidates& all, const std::vector<Scalars>& boxes) {
  constexpr std::size_t kMost = 64;  // each looks at all candidates
  std::vector<Line> lines = lensLines(all, boxes);
  if (lines.size() > kMost) lines.resize(kMost);
  const std::string text = lowered(file.root->dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 1 << 16));
  const bool isFisheye = hasPart(text, kFisheye), isUnreal = hasPart(text, kOfUnreal);
  for (Line& line : lines) {
    askAboutOthers(line, file);
    putSize(line, all, boxes);
    const std::string name = line.parts.front().first;
    if (name == "P" && line.first->path().ends_with("^T"))
      line.ask.push_back(
          line.first->path() +
          ": by columns, as MATLAB's cameraMatrix; its pixels count from 1: --set viewport.pixelCenter=1");
    const bool isFlat = name == "P" || (name == "K" && line.used.size() == 1 &&
                                        hasWord(line.first->steps.back(), "p projection rect rectified"));
    if (!isFlat) {
      const std::size_t before = line.used.size();
      putLens(line, all, boxes, isFisheye);
      if (line.used.size() > before) askAboutLens(line, *line.used[before], all, text);
    }
    if (name != "P") {
      line.poses = posesFor(*line.first, all);
      if (isFlat) std::erase_if(line.poses, [](const Match& match) { return match.parts.size() > 1; });
      if (line.poses.empty()) putAim(line, *line.first, all);
      if (isUnreal) putUnreal(line, all);
    }
  }
  sharePoses(lines);
  if (lines.empty()) {
    const bool hasTarget =
        std::any_of(all.begin(), all.end(), [](const Chosen& each) { return each->kind == "target"; });
    for (const Chosen& each : all) {
      if (lines.size() == kMost) break;
      Line line;
      line.first = each;
      if (isAmong(each->kind, "X R V Q"))
        for (const Match& match : posesFor(*each, all)) {
          if (match.parts.front() != each) continue;
          putPose(line, match, nullptr);
          break;
        }
      if (each->kind == "E" && hasTarget) putAim(line, *each, all);
      if (line.parts.empty()) continue;
      line.ask.push_back("no lens found: add K=… if it is among what is left out, or give it by --fx … or --fov-y");
      lines.push_back(std::move(line));
    }
  }
  for (Line& line : lines)
    if (line.first->isStarred())
      line.score += 2 + 0.1 * static_cast<double>(std::min<std::size_t>(line.first->star.size(), 20));
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.score > b.score; });
  // One line for one set of numbers.
  std::vector<Line> kept;
  std::set<const Candidate*> seen;
  for (Line& line : lines) {
    std::vector<const Candidate*> covered{line.first.get()};
    for (const auto& [star, each] : line.first->star) covered.push_back(each.get());
    if (std::any_of(covered.begin(), covered.end(), [&](const Candidate* each) { return seen.contains(each); }))
      continue;
    seen.insert(covered.begin(), covered.end());
    kept.push_back(std::move(line));
  }
  return kept;
}

/// Paths with their numbers, or how many they are.
std::vector<std::string> shownNumbers(const Document& file) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> shown = pathsOfNumbers(*file.root);
  for (std::string& path : shown) {
    const auto node = valueAt(Node(file), withStar(path, "0"));
    const std::vector<double> numbers =
        node ? numbersIn(node->json()).value_or(std::vector<double>{}) : std::vector<double>{};
    path += ":";
    for (const double number : numbers)
      if (numbers.size() <= kMost) path += " " + formatDigits(number, 6);
    if (numbers.size() > kMost) path += " " + std::to_string(numbers.size()) + " numbers";
  }
  return shown;
}

/// A path without what is done to its numbers.
std::string bareOf(const Candidate& candidate) {
  const std::string path = candidate.path();
  return path.substr(0, path.size() - (candidate.terms.empty() ? candidate.suffix.size() : 0));
}

/// The containers that a line's star stands for, and their path with the star.
std::map<std::string, std::string> starsOf(const std::vector<Line>& lines) {
  std::map<std::string, std::string> stars;
  for (const Line& line : lines) {
    const Candidate& first = *line.first;
    const std::string box =
        joined({first.steps.begin(), first.steps.begin() + static_cast<std::ptrdiff_t>(first.at)}, ".");
    for (const auto& [star, each] : first.star)
      stars.emplace(joinedPath(box, withStar(first.steps[first.at], star)), joinedPath(box, first.steps[first.at]));
  }
  return stars;
}

/// The ends of a path's containers, the outermost first.
std::vector<std::size_t> endsOf(const std::string& path) {
  std::vector<std::size_t> ends;
  for (std::size_t at = path.find('.'); at != path.npos; at = path.find('.', at + 1)) ends.push_back(at);
  return ends;
}

/// A path beside a starred one has its star.
std::string shownPath(const std::string& path, const std::map<std::string, std::string>& stars) {
  for (const std::size_t end : endsOf(path))
    if (const auto box = stars.find(path.substr(0, end)); box != stars.end()) return box->second + path.substr(end);
  return path;
}

bool isUsedAbove(const std::string& path, const std::set<std::string>& used) {
  const std::vector<std::size_t> ends = endsOf(path);
  return std::any_of(ends.begin(), ends.end(), [&](std::size_t end) { return used.contains(path.substr(0, end)); });
}

bool saysNothing(const std::string& path) {
  const std::vector<std::size_t> ends = endsOf(path);
  const auto isOf = [&](std::size_t from, std::size_t end) {
    return fitsAny(path.substr(from, end - from), kSaysNothing);
  };
  std::size_t from = 0;
  for (const std::size_t end : ends) {
    if (isOf(from, end)) return true;
    from = end + 1;
  }
  return isOf(from, path.size());
}

void addOnce(std::vector<std::string>& paths, const std::string& path) {
  if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
}

std::string shownLine(const ProposedLine& line) {
  std::string text = "--parts '" + line.parts + "'";
  for (const std::string& set : line.set) text += " --set " + set;
  return line.cameras > 1 ? text + "   (" + std::to_string(line.cameras) + " cameras)" : text;
}

}  // namespace

Proposal proposeParts(const Document& file) {
  Candidates all = candidatesIn(file);
  const std::vector<Scalars> boxes = scalarsOf(all);
  addFamilies(boxes, all);
  addCoefficients(all);
  const std::vector<Line> lines = linesOf(file, all, boxes);
  const std::map<std::string, std::string> stars = starsOf(lines);
  Proposal proposal;
  std::set<std::string> used;
  for (const Line& line : lines) {
    ProposedLine proposed;
    for (const auto& [name, path] : line.parts)
      proposed.parts += (proposed.parts.empty() ? "" : ", ") + name + "=" + path;
    if (line.isNerf) proposed.set = {"cameraAxes=RUB", "viewport.pixelCenter=0.5"};
    if (line.isUnreal) proposed.set = {"convention=unreal", "euler.order=unreal"};
    proposed.decide = line.ask;
    proposed.cameras = std::max<std::size_t>(1, line.first->star.size());
    proposed.hasLens = !isPoseKind(line.first->kind);
    proposal.lines.push_back(std::move(proposed));
    for (const Chosen& each : line.used) {
      used.insert(bareOf(*each));
      for (const auto& [star, one] : each->star) used.insert(bareOf(*one));
      for (const Chosen& term : each->terms) {
        used.insert(bareOf(*term));
        for (const auto& [star, one] : term->star) used.insert(bareOf(*one));
      }
    }
  }
  const auto isUsedBelow = [&](const std::string& front) {
    const auto first = used.lower_bound(front);
    return first != used.end() && first->starts_with(front);
  };
  for (const Chosen& each : all) {
    const std::string path = each->path(), box = path.substr(0, path.rfind('.') == path.npos ? 0 : path.rfind('.') + 1);
    // Numbers of no kind and single ones are left out beside the parts that are used, and above them.
    const bool isKind = isAmong(each->kind, "K P X R V Q T E D S F C direction target up"),
               isBeside = isAmong(
                   each->kind, "? x y z tx ty tz qx qy qz qw rx ry rz pitch roll yaw heading k1 k2 k3 k4 k5 k6 p1 p2");
    const bool isLeft = !lines.empty() && !each->isStarred() && each->terms.empty() &&
                        (isKind || (isBeside && (isUsedBelow(box) || hasWord(path, "dist distortion")))) &&
                        !used.contains(bareOf(*each)) && !isUsedBelow(path + ".") &&
                        std::any_of(each->numbers.begin(), each->numbers.end(), [](double n) { return n != 0; });
    if (isLeft) addOnce(proposal.leftOut, shownPath(path, stars));
  }
  if (lines.empty()) return proposal.numbers = shownNumbers(file), proposal;
  // What has no kind may be a part all the same, under a name that is not known.
  for (const std::string& path : pathsOfNumbers(*file.root)) {
    const bool isFurther = file.isPlainText && path.find('#') != path.npos;  // one that comes again
    const bool isIn = isFurther || used.contains(path) || isUsedBelow(path + ".") || isUsedAbove(path, used);
    const auto node = valueAt(Node(file), withStar(path, "0"));
    const auto numbers = node ? numbersIn(node->json()) : std::nullopt;
    constexpr std::size_t kMost = 17;
    if (isIn || !numbers || numbers->size() > kMost || saysNothing(path) ||
        std::all_of(numbers->begin(), numbers->end(), [](double n) { return n == 0; }))
      continue;
    addOnce(proposal.leftOut, shownPath(path, stars));
  }
  return proposal;
}

std::string textOf(const Proposal& proposal) {
  constexpr std::size_t kMostLines = 5, kMostQuestions = 5, kMostPaths = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(proposal.lines.size(), kMostLines); ++i) {
    text += (i > 0 ? "or " : "") + shownLine(proposal.lines[i]) + "\n";
    for (std::size_t j = 0; i == 0 && j < std::min(proposal.lines[0].decide.size(), kMostQuestions); ++j)
      text += "  decide: " + proposal.lines[0].decide[j] + "\n";
  }
  if (proposal.lines.size() > kMostLines)
    text += "and " + std::to_string(proposal.lines.size() - kMostLines) + " more lines like these\n";
  if (!proposal.leftOut.empty()) text += "left out: " + someOf(proposal.leftOut, kMostPaths) + "\n";
  if (!text.empty()) return text;
  constexpr std::size_t kMostNumbers = 12;
  text = "nothing in it looks like a camera";
  if (!proposal.numbers.empty()) text += "; its numbers, for a line of parts (viewproj help parts):";
  for (std::size_t i = 0; i < std::min(proposal.numbers.size(), kMostNumbers); ++i)
    text += "\n  " + proposal.numbers[i];
  if (proposal.numbers.size() > kMostNumbers)
    text += "\n  and " + std::to_string(proposal.numbers.size() - kMostNumbers) + " more";
  return text + "\n";
}

Json jsonOf(const Proposal& proposal) {
  Json parts = Json::array();
  for (const ProposedLine& line : proposal.lines)
    parts.push_back({{"line", line.parts}, {"set", line.set}, {"decide", line.decide}, {"cameras", line.cameras}});
  return {{"parts", parts}, {"leftOut", proposal.leftOut}};
}

}  // namespace viewproj::cmd
