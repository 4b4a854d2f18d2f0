// The lens and the size of a line.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "formats/finder/line.hpp"
#include "formats/parts.hpp"
#include "formats/words.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

std::optional<std::array<double, 2>> centreOf(const LineDraft& line) {
  if (line.parts.front().first != "K") return std::nullopt;
  std::vector<double> k;
  for (const Chosen& each : line.used) k.insert(k.end(), each->numbers.begin(), each->numbers.end());
  if (k.size() == 9) return std::array{k[2], k[5]};
  if (k.size() == 3 || k.size() == 4) return std::array{k[k.size() - 2], k[k.size() - 1]};
  return std::nullopt;
}

/// A focal length that is called so, or is short beside the picture, is in millimetres, which the size of a pixel
/// divides. lens: the parts of K.
void putUnit(LineDraft& line, const Candidates& all, const std::vector<Chosen>& lens, double width) {
  const std::string focal = lens.front()->path();
  const double f = lens.front()->numbers.front();
  const bool isInMillimetres = hasWord(lens.front()->steps.back(), "mm");
  if (line.parts.front().first != "K" || (f >= kLeastFocal * width && !isInMillimetres)) return;
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

/// Numbers that are called a lens, and whose count does not say which they are.
void askForLens(LineDraft& line, const Candidates& all) {
  const auto lens = bestOf(*line.first, all, "d");
  if (!lens) return;
  const std::string path = lens->parts.front()->path();
  const std::size_t count = lens->parts.front()->numbers.size();
  line.ask.push_back(path + ": the lens? " +
                     (count == 3 ? "distortion=" + path + "[0,1]+0+0+" + path + "[2] if its numbers are k1 k2 k3"
                                 : "Say which of its " + std::to_string(count) +
                                       " numbers are k1 k2 p1 p2 k3, as in distortion=" + path + "[0,1,4,5,2]"));
}

/// Radial coefficients k in an object that is a lens, with the tangential p beside them.
void putRadial(LineDraft& line, const Candidates& all) {
  const auto radial = bestOf(*line.first, all, "k"), tangential = bestOf(*line.first, all, "p");
  const std::vector<std::string> steps = radial ? radial->parts.front()->steps : std::vector<std::string>{};
  if (steps.size() < 2 || !hasWord(steps[steps.size() - 2], "lens dist distortion")) return askForLens(line, all);
  std::vector<Chosen> parts = radial->parts;
  if (tangential) parts.push_back(tangential->parts.front());
  const std::string k = parts.front()->path();
  if (parts.front()->numbers.size() == 2) return line.add("distortion", parts, radial->score);
  line.parts.emplace_back("distortion", k + "[0,1]+" + (tangential ? parts.back()->path() : "0+0") + "+" + k + "[2]");
  line.used.insert(line.used.end(), parts.begin(), parts.end());
  line.score += radial->score;
}

}  // namespace

void putSize(LineDraft& line, const Candidates& all, const std::vector<Scalars>& boxes) {
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

void putLens(LineDraft& line, const Candidates& all, const std::vector<Scalars>& boxes, bool isFisheye) {
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
  if (!named) return putRadial(line, all);
  const auto at = [&](std::string_view kind) {
    const auto each = named->find(kind);
    return each == named->end() ? nullptr : each->second;
  };
  const Chosen p1 = at("p1"), p2 = at("p2");
  if (const std::vector<Chosen> k = together(*named, {"k1", "k2", "k3", "k4"}); !k.empty() && !p1 && !at("k6")) {
    line.add("fisheye", k, score);
    if (!isFish) line.ask.push_back("k1 to k4 without p1, p2: fisheye, or brown?");
    return;
  }
  if (p1 && p2 && hasWord(p1->path(), "tangential"))
    line.ask.push_back(p1->path() + ", " + p2->path() +
                       ": taken as p1 and p2, as Azure Kinect has them; else exchange them");
  constexpr std::string_view kOrder[] = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  const std::size_t count = at("k6") ? 8 : at("k3") ? 5 : p1 && p2 ? 4 : at("k2") ? 2 : 1;
  std::string terms;
  for (const std::string_view kind : std::span(kOrder).first(count)) {
    const Chosen each = at(kind);
    terms += (terms.empty() ? "" : "+") + (each ? each->path() : "0");
    if (each) line.used.push_back(each);
  }
  line.parts.emplace_back("distortion", terms);
  line.score += score;
}

void askAboutLens(LineDraft& line, const Candidate& lens, const Candidates& all, std::string_view text) {
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

std::vector<LineDraft> lensLines(const Candidates& all, const std::vector<Scalars>& boxes) {
  std::vector<LineDraft> lines;
  // What many cameras have in common is said by the line of all of them.
  constexpr std::size_t kMany = 10;
  std::set<const Candidate*> covered;
  for (const Chosen& each : all)
    if (each->star.size() >= kMany)
      for (const auto& [star, one] : each->star) covered.insert(one.get());
  const auto begin = [&](const std::string& name, const std::vector<Chosen>& chosen, double score,
                         const std::string& suffix = "") {
    LineDraft line;
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
    if (const auto sensor = each->kind == "f" ? bestOf(*each, all, "sensor") : std::nullopt) {
      const Chosen& width = sensor->parts.front();
      constexpr double kLeastMillimetres = 3;  // less are Maya's inches
      const bool isInches = hasWord(width->path(), "film") && width->numbers.front() < kLeastMillimetres;
      begin("focalLength", {each}, 2);
      lines.back().add("sensorWidth", sensor->parts, sensor->score,
                       isInches                    ? "/0.03937007874015748"
                       : width->numbers.size() > 1 ? "[0]"
                                                   : "");
      lines.back().ask.push_back(width->path() + ": " + (isInches ? "inches, and " : "") +
                                 "the width of what the picture shows, also where that is taller than wide?");
    }
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

}  // namespace viewproj::cmd
