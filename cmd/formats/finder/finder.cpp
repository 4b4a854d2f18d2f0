// Which parts go together, and which of their lines is the likeliest.
#include "formats/finder/finder.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/finder/line.hpp"
#include "formats/parts.hpp"
#include "formats/unread.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kFisheye = "fisheye equidistant kannala \"kb4\"",
                           kOfUnreal = "unreal carla sensor.camera image_size_x relativerotation";

/// A text with several lenses, of which a line takes the first.
void askAboutOthers(LineDraft& line, const Document& file) {
  const std::string path = line.first->path();
  const auto others = file.isPlainText ? valueAt(Node(file), path + "#") : std::nullopt;
  if (others && others->json().is_array())
    line.ask.push_back(path + ": comes " + std::to_string(others->size() + 1) +
                       " times, and this line reads the first; for the second write " + path +
                       "#.0, and #.0 behind the other names too");
}

std::vector<LineDraft> linesOf(const Document& file, const Candidates& all, const std::vector<Scalars>& boxes) {
  constexpr std::size_t kMost = 64;  // each looks at all candidates
  std::vector<LineDraft> lines = lensLines(all, boxes);
  if (lines.size() > kMost) lines.resize(kMost);
  const std::string text = lowered(file.root->dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 1 << 16));
  const bool isFisheye = hasPart(text, kFisheye), isUnreal = hasPart(text, kOfUnreal);
  for (LineDraft& line : lines) {
    askAboutOthers(line, file);
    putSize(line, all, boxes);
    const std::string name = line.parts.front().first;
    if (name == "P" && line.first->path().ends_with("^T")) {
      line.set = {"viewport.pixelCenter=1"};
      line.ask.push_back(line.first->path() + ": by columns, as MATLAB's cameraMatrix, whose pixels count from 1");
    }
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
      putAngles(line, all, isUnreal);
    }
  }
  sharePoses(lines);
  // Two lenses with one pose are a pair, and no set: the pose is the second's alone.
  std::erase_if(lines, [&](const LineDraft& pair) {
    return pair.first->star.size() == 2 && pair.poses.empty() &&
           std::any_of(lines.begin(), lines.end(), [&](const LineDraft& line) {
             const auto isFirst = [&](const auto& each) { return each.second == line.first; };
             return line.isOfPair && std::any_of(pair.first->star.begin(), pair.first->star.end(), isFirst);
           });
  });
  if (lines.empty()) {
    for (const Chosen& each : all) {
      if (lines.size() == kMost) break;
      LineDraft line;
      line.first = each;
      if (isAmong(each->kind, "X R V Q"))
        for (const Match& match : posesFor(*each, all)) {
          if (match.parts.front() != each) continue;
          putPose(line, match, nullptr);
          break;
        }
      if (each->kind == "E") putAim(line, *each, all);
      if (line.parts.empty()) continue;
      line.ask.push_back("no lens found: add K=… if it is among what is left out, or give it by --fx … or --fov-y");
      lines.push_back(std::move(line));
    }
  }
  for (LineDraft& line : lines)
    if (line.first->isStarred())
      line.score += 2 + 0.1 * static_cast<double>(std::min<std::size_t>(line.first->star.size(), 20));
  std::stable_sort(lines.begin(), lines.end(),
                   [](const LineDraft& a, const LineDraft& b) { return a.score > b.score; });
  // One line for one set of numbers.
  std::set<const Candidate*> seen;
  std::erase_if(lines, [&](const LineDraft& line) {
    std::vector<const Candidate*> covered{line.first.get()};
    for (const auto& [star, each] : line.first->star) covered.push_back(each.get());
    if (std::any_of(covered.begin(), covered.end(), [&](const Candidate* each) { return seen.contains(each); }))
      return true;
    seen.insert(covered.begin(), covered.end());
    return false;
  });
  return lines;
}

/// Paths with their numbers, or how many they are.
void addNumbers(const Document& file, Proposal& proposal) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string>& shown = proposal.numbers = pathsOfNumbers(*file.root);
  const auto isOfCamera = [](const std::string& path) { return mayBeOfCamera(path.substr(path.rfind('.') + 1)); };
  proposal.ofCamera =
      static_cast<std::size_t>(std::stable_partition(shown.begin(), shown.end(), isOfCamera) - shown.begin());
  for (std::string& path : shown) {
    const auto node = valueAt(Node(file), withStar(path, "0"));
    const std::vector<double> numbers =
        node ? numbersIn(node->json()).value_or(std::vector<double>{}) : std::vector<double>{};
    path += ":";
    for (const double number : numbers)
      if (numbers.size() <= kMost) path += " " + formatDigits(number, 6);
    if (numbers.size() > kMost) path += " " + std::to_string(numbers.size()) + " numbers";
  }
}

/// A path without what is done to its numbers.
std::string bareOf(const Candidate& candidate) {
  const std::string path = candidate.path();
  return path.substr(0, path.size() - (candidate.terms.empty() ? candidate.suffix.size() : 0));
}

void addUsed(const Candidate& candidate, std::set<std::string>& used) {
  used.insert(bareOf(candidate));
  for (const auto& [star, one] : candidate.star) used.insert(bareOf(*one));
  for (const auto& term : candidate.terms) addUsed(*term, used);
}

/// The containers that a line's star stands for, and their path with the star.
std::map<std::string, std::string> starsOf(const std::vector<LineDraft>& lines) {
  std::map<std::string, std::string> stars;
  for (const LineDraft& line : lines) {
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
  const std::size_t dot = std::min(path.find('.'), path.size());
  return fitsAny(path.substr(0, dot), kSaysNothing) || (dot < path.size() && saysNothing(path.substr(dot + 1)));
}

void addOnce(std::vector<std::string>& paths, const std::string& path) {
  if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
}

/// "cameras.*.name" of cameras.*.fx, where the items of the list have names.
std::string pathOfNames(const Document& file, const std::string& path) {
  constexpr std::string_view kNamesOfItems =
      "name label id camera_name image_name file_name filename image camera_id camera";
  const std::size_t star = path.find('*');
  if (star == path.npos || path.find_first_of(".+", star) != star + 1 || (star > 0 && path[star - 1] != '.')) return "";
  const auto list = star == 0 ? std::optional(Node(file)) : valueAt(Node(file), path.substr(0, star - 1));
  if (!list || !list->json().is_array()) return "";
  for (const std::string_view name : wordsIn(kNamesOfItems)) {
    const auto isNamed = [&](const Json& item) {
      return item.is_object() && item.contains(name) && item[std::string(name)].is_string();
    };
    if (std::all_of(list->json().begin(), list->json().end(), isNamed))
      return path.substr(0, star + 1) + "." + std::string(name);
  }
  return "";
}

}  // namespace

ProposedLine otherWay(ProposedLine line) {
  constexpr std::string_view kEither = "worldFromCamera";
  for (std::size_t at; (at = line.parts.find(kEither)) != std::string::npos;)
    line.parts.replace(at, kEither.size(), "cameraFromWorld");
  std::erase(line.set, "cameraAxes=RUB");  // likely in the one direction alone
  return line;
}

std::string optionsOf(const ProposedLine& line) {
  std::string text = "--parts '" + line.parts + "'";
  for (const std::string& set : line.set) text += " --set " + set;
  return text;
}

Proposal proposeParts(const Document& file) {
  Candidates all = candidatesIn(file);
  const std::vector<Scalars> boxes = scalarsOf(all);
  addFamilies(boxes, all);
  const std::vector<LineDraft> lines = linesOf(file, all, boxes);
  const std::map<std::string, std::string> stars = starsOf(lines);
  Proposal proposal;
  std::set<std::string> used;
  for (const LineDraft& line : lines) {
    proposal.lines.push_back({"", line.set, line.ask, std::max<std::size_t>(1, line.first->star.size()),
                              !isPoseKind(line.first->kind), line.pose, line.isEitherWay, line.turnOfNoOrder});
    std::string& parts = proposal.lines.back().parts;
    for (const auto& [name, path] : line.parts) parts += (parts.empty() ? "" : ", ") + name + "=" + path;
    if (const std::string names = pathOfNames(file, line.parts.front().second); !names.empty())
      parts += ", name=" + names;
    for (const Chosen& each : line.used) addUsed(*each, used);
  }
  const auto isUsedBelow = [&](const std::string& front) {
    const auto first = used.lower_bound(front);
    return first != used.end() && first->starts_with(front);
  };
  for (const Chosen& each : all) {
    const std::string path = each->path(), box = path.substr(0, path.rfind('.') == path.npos ? 0 : path.rfind('.') + 1);
    // Numbers of no kind and single ones are left out beside the parts that are used, and above them.
    const bool isKind = isAmong(each->kind, "K P X R V Q T E D S F C direction target up"),
               isBeside =
                   isAmong(each->kind,
                           "? d x y z tx ty tz qx qy qz qw rx ry rz pitch roll yaw heading k1 k2 k3 k4 k5 k6 p1 p2");
    const bool isLeft = !lines.empty() && !each->isStarred() && each->terms.empty() &&
                        (isKind || (isBeside && (isUsedBelow(box) || hasWord(path, "dist distortion")))) &&
                        !used.contains(bareOf(*each)) && !isUsedBelow(path + ".") &&
                        std::any_of(each->numbers.begin(), each->numbers.end(), [](double n) { return n != 0; });
    if (isLeft) addOnce(proposal.leftOut, shownPath(path, stars));
  }
  if (lines.empty()) return addNumbers(file, proposal), proposal;
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

std::vector<std::string> pathsOfOthers(const Document& file, const std::set<double>& known) {
  std::vector<std::string> others = pathsOfNumbers(*file.root);
  std::erase_if(others, [&](const std::string& path) {
    const auto node = valueAt(Node(file), withStar(path, "0"));
    const auto numbers = node ? numbersIn(node->json()) : std::nullopt;
    return saysNothing(path) || !numbers ||
           std::all_of(numbers->begin(), numbers->end(), [&](double number) { return known.contains(number); });
  });
  return others;
}

std::string textOf(const Proposal& proposal) {
  constexpr std::size_t kMostLines = 5, kMostQuestions = 5, kMostPaths = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(proposal.lines.size(), kMostLines); ++i) {
    const ProposedLine& line = proposal.lines[i];
    const std::string count = line.cameras > 1 ? "   (" + std::to_string(line.cameras) + " cameras)" : "";
    text += (i > 0 ? "or " : "") + optionsOf(line) + count + "\n";
    if (line.isEitherWay) text += "or " + optionsOf(otherWay(line)) + count + "\n";
    for (std::size_t j = 0; i == 0 && j < std::min(line.decide.size(), kMostQuestions); ++j)
      text += "  decide: " + line.decide[j] + "\n";
  }
  if (proposal.lines.size() > kMostLines)
    text += "and " + std::to_string(proposal.lines.size() - kMostLines) + " more lines like these\n";
  if (!proposal.leftOut.empty()) text += "left out: " + someOf(proposal.leftOut, kMostPaths) + "\n";
  if (!text.empty()) return text;
  const std::size_t most = std::min(proposal.numbers.size(), std::max<std::size_t>(12, proposal.ofCamera));
  text = "nothing in it looks like a camera";
  if (!proposal.numbers.empty()) text += "; its numbers, for a line of parts (viewproj help parts):";
  for (std::size_t i = 0; i < most; ++i) text += "\n  " + proposal.numbers[i];
  if (proposal.numbers.size() > most) text += "\n  and " + std::to_string(proposal.numbers.size() - most) + " more";
  return text + "\n";
}

Json jsonOf(const Proposal& proposal) {
  Json parts = Json::array();
  for (const ProposedLine& each : proposal.lines)
    for (const ProposedLine& line : each.isEitherWay ? std::vector{each, otherWay(each)} : std::vector{each})
      parts.push_back({{"line", line.parts}, {"set", line.set}, {"decide", line.decide}, {"cameras", line.cameras}});
  return {{"parts", parts}, {"leftOut", proposal.leftOut}};
}

}  // namespace viewproj::cmd
