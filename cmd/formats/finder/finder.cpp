// Which parts go together, and which of their lines is the likeliest.
#include "formats/finder/finder.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/finder/line.hpp"
#include "formats/parts.hpp"
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
  // Two lenses with one pose are a pair, and no set: the pose is the second's alone.
  std::erase_if(lines, [&](const LineDraft& pair) {
    return pair.first->star.size() == 2 && pair.poses.empty() &&
           std::any_of(lines.begin(), lines.end(), [&](const LineDraft& line) {
             const auto isFirst = [&](const auto& each) { return each.second == line.first; };
             return line.isOfPair && std::any_of(pair.first->star.begin(), pair.first->star.end(), isFirst);
           });
  });
  if (lines.empty()) {
    const bool hasTarget =
        std::any_of(all.begin(), all.end(), [](const Chosen& each) { return each->kind == "target"; });
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
      if (each->kind == "E" && hasTarget) putAim(line, *each, all);
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
  std::vector<LineDraft> kept;
  std::set<const Candidate*> seen;
  for (LineDraft& line : lines) {
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
  const std::vector<LineDraft> lines = linesOf(file, all, boxes);
  const std::map<std::string, std::string> stars = starsOf(lines);
  Proposal proposal;
  std::set<std::string> used;
  for (const LineDraft& line : lines) {
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
               isBeside =
                   isAmong(each->kind,
                           "? d x y z tx ty tz qx qy qz qw rx ry rz pitch roll yaw heading k1 k2 k3 k4 k5 k6 p1 p2");
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
