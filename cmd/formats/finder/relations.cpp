// How well parts go together.
#include <algorithm>

#include "camera/fields.hpp"
#include "formats/finder/line.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

std::string sumOf(const std::vector<Chosen>& terms) {
  std::string sum;
  for (const Chosen& each : terms) sum += (sum.empty() ? "" : "+") + each->path();
  return sum;
}

bool isPoseKind(std::string_view kind) { return isAmong(kind, "X R V Q T E"); }

bool hasPart(std::string_view text, std::string_view parts) {
  const std::vector<std::string_view> all = wordsIn(parts);
  return std::any_of(all.begin(), all.end(),
                     [&](std::string_view part) { return text.find(part) != std::string_view::npos; });
}

bool shares(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>> towardOf(const Candidate& pose) {
  const std::string path = lowered(pose.path());
  for (const std::string_view link : {"_to_", "_2_", "2"}) {
    const std::size_t at = path.find(link);
    const std::size_t after = at + link.size();
    if (at == std::string::npos || at == 0 || after >= path.size() || path.find("c2w") != std::string::npos ||
        path.find("w2c") != std::string::npos || (link == "2" && !(isLetter(path[at - 1]) && isLetter(path[after]))))
      continue;
    const std::size_t first = path.find_last_of("._", at - 1);
    const std::size_t end = std::min(path.find_first_of("._", after), path.size());
    const std::size_t begin = first == std::string::npos ? 0 : first + 1;
    if (begin == at || end == after) continue;
    return std::pair(wordsOf(path.substr(begin, at - begin)), wordsOf(path.substr(after, end - after)));
  }
  return std::nullopt;
}

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
  std::vector<std::string> b = part.tag;
  if (!first.isStarred() && part.isStarred())
    std::erase_if(b, [](const std::string& word) { return isDigit(word[0]); });
  const auto includes = [](const std::vector<std::string>& all, const std::vector<std::string>& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
  };
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

std::vector<Chosen> together(const Scalars& scalars, std::initializer_list<std::string_view> kinds) {
  std::vector<Chosen> found;
  for (const std::string_view kind : kinds) {
    const auto each = scalars.find(kind);
    if (each == scalars.end()) return {};
    found.push_back(each->second);
  }
  return found;
}

void addFamilies(const std::vector<Scalars>& boxes, Candidates& all) {
  const auto add = [&](const char* kind, const std::vector<Chosen>& terms, double name) {
    if (terms.empty()) return;
    Candidate family{kind, terms.front()->steps, {}, name, ""};
    family.steps.back() = "";
    for (const Chosen& term : terms)
      family.numbers.insert(family.numbers.end(), term->numbers.begin(), term->numbers.end());
    if (family.kind == "R" && !isRotation(withThirdRow(family.numbers))) return;
    family.star = terms.front()->star;
    family.at = terms.front()->at;
    family.terms = terms;
    family.tag = findTag(family);
    all.push_back(std::make_shared<Candidate>(std::move(family)));
  };
  for (const Scalars& box : boxes) {
    add("R", together(box, {"r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"}), 2);
    add("R", together(box, {"r00", "r01", "r02", "r10", "r11", "r12", "r20", "r21", "r22"}), 2);
    add("Q", together(box, {"qx", "qy", "qz", "qw"}), 2);
    add("T", together(box, {"tx", "ty", "tz"}), 2);
    if (!box.contains("w")) add("E", together(box, {"x", "y", "z"}), 1);  // w: x y z of a quaternion
    add("pyr", together(box, {"pitch", "yaw", "roll"}), 2);
    add("rpy", together(box, {"roll", "pitch", "yaw"}), 2);
    add("opk", together(box, {"omega", "phi", "kappa"}), 2);
    add("A", together(box, {"rx", "ry", "rz"}), 1);
    for (const std::string_view turn : {"heading", "yaw"})  // on the Earth a yaw is a heading
      for (const auto& turns :
           {together(box, {turn, "pitch", "roll"}), together(box, {turn, "pitch"}), together(box, {turn})}) {
        if (turns.empty()) continue;
        add("hpr", turns, turn == "heading" ? 2 : 1);
        break;
      }
    add("place", together(box, {"lat", "lon", "alt"}), 2);
    if (!box.contains("w")) add("place", together(box, {"lat", "lon", "h"}), 2);
    add("place", together(box, {"lat", "lon"}), 2);
    add("E", together(box, {"gx", "gy", "pz"}), 1);
  }
  // Rows or columns whose names differ in the last letter: L1, L2, L3; and x_axis, y_axis, of which a third may be
  // missing.
  std::map<std::vector<std::string>, Scalars> rows;
  for (const Chosen& each : all) {
    std::vector<std::string> steps = each->steps;
    std::string& name = steps.back();
    const bool isStarOfRow = each->isStarred() && each->at + 1 == steps.size();
    if (each->numbers.size() != 3 || isStarOfRow || name.empty()) continue;
    const bool isAxis = isAmong(name.substr(0, 1), "x y z X Y Z") && hasWord(name.substr(1), "axis");
    const std::size_t at = isAxis ? 0 : name.size() - 1;
    const std::string letter = name.substr(at, 1);
    name.erase(at, 1);
    rows[steps].emplace(letter, each);
  }
  for (const auto& [steps, members] : rows) {
    if (members.size() != 3 && !(members.size() == 2 && hasWord(steps.back(), "axis"))) continue;
    std::vector<Chosen> terms;
    for (const auto& [last, each] : members) terms.push_back(each);
    add("R", terms, 2);
  }
}

}  // namespace viewproj::cmd
