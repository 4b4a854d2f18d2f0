#include "picture/labels.hpp"

#include <algorithm>

#include "text/utf8.hpp"

namespace viewproj::cmd {

double textWidth(std::string_view utf8, const TextStyle& style) {
  constexpr std::size_t kFirstOfEastAsia = 0xE3;  // the first byte from U+3000 on
  double ems = 0;
  for (const char letter : utf8) {
    if (continuesCharacter(letter)) continue;
    const auto isOneOf = [&](std::string_view group) { return group.find(letter) != std::string_view::npos; };
    const auto byte = static_cast<unsigned char>(letter);
    ems += byte >= kFirstOfEastAsia || isOneOf("mwMW@%#+=<>~^")                ? 1
           : isOneOf("iljI.,:;'|")                                             ? 0.34
           : isOneOf("frt()[]/ -!\"`")                                         ? 0.45
           : (letter >= 'A' && letter <= 'Z') || letter == '&' || byte >= 0x80 ? 0.79
                                                                               : 0.645;
  }
  return ems * style.size * (style.isBold ? 1.12 : 1);
}

Vec2 Spot::leaderEnd() const {
  return {std::clamp(mark->x, box.left, box.right), std::clamp(mark->y, box.top, box.bottom)};
}

Rect Spot::bounds() const {
  const Vec2 other = mark.value_or(Vec2{box.left, box.top});
  return boundsOf({{box.left, box.top}, {box.right, box.bottom}, other});
}

Vec2 Label::size() const {
  const double beside = note.empty() ? 0 : 5 + textWidth(note, {style.name, style.size});
  return {textWidth(text, style) + beside + 4, style.size * 1.28};
}

void Label::addSpot(double cost, const Vec2& middle, const std::optional<Vec2>& mark) {
  const auto [width, height] = size();
  spots.push_back({cost, around(middle, width / 2, height / 2), mark});
}

void Label::addSpotsAround(const Vec2& at, double radius, int first) {
  constexpr double kGaps[] = {3, 16, 34, 56, 84, 120};
  constexpr int kWays[][2] = {{1, 0}, {1, -1}, {1, 1}, {-1, 0}, {-1, -1}, {-1, 1}, {0, -1}, {0, 1}};
  const auto [width, height] = size();
  for (int ring = first; ring < 6; ++ring)
    for (int k = 0; k < 8; ++k) {
      const auto [x, y] = kWays[k];
      const double gap = (radius + kGaps[ring]) * (x != 0 && y != 0 ? 0.72 : 1);
      addSpot(0.6 * k + (ring > 0 ? 12 + 5 * ring : 0),
              {at.x + x * (gap + width / 2), at.y + y * (gap + height * (x != 0 ? 0.4 : 0.5))},
              ring > 0 ? std::optional(at) : std::nullopt);
    }
}

bool Labels::isNew(std::set<std::array<double, 4>>& known, const Rect& ends) {
  return known.insert({std::floor(ends.left), std::floor(ends.top), std::floor(ends.right), std::floor(ends.bottom)})
      .second;
}

void Labels::addMark(const Rect& box) {
  if (isNew(knownMarks_, box)) marks_.add(grown(box, 1), box);
}

bool Labels::hasMark(const Rect& box) const {
  return marks_.any(box, [&](const Rect& mark) { return meet(box, grown(mark, 1)); });
}

void Labels::addInk(const std::vector<Vec2>& line, double weight) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 &from = line[i - 1], &to = line[i];
    if (isNew(knownInk_, {from.x, from.y, to.x, to.y})) ink_.add(grown(boundsOf({from, to}), 2), {from, to, weight});
  }
}

double Labels::costOf(const Label& label, const Spot& spot, double least) const {
  const Rect& box = spot.box;
  const std::optional<Vec2>& mark = spot.mark;
  if (spot.cost >= least || !holds(grown(frame_, -1), box) || hasMark(box)) return least;
  const Vec2 end = mark ? spot.leaderEnd() : Vec2{};
  const Rect all = spot.bounds();
  const auto leaderMeets = [&](const Rect& other) { return mark && lengthWithin(*mark, end, other) > 0; };
  const auto leaderCrosses = [&](const Vec2& a, const Vec2& b) { return mark && cross(*mark, end, a, b); };
  if (marks_.any(all, [&](const Rect& other) { return leaderMeets(other) && !holds(other, *mark); })) return least;
  const bool meetsName = names_.any(all, [&](std::size_t index) {
    const Label& other = labels_[index];
    if (&other == &label || !other.chosen) return false;
    const Spot& taken = *other.chosen;
    if (meet(box, grown(taken.box, 1)) || leaderMeets(taken.box)) return true;
    return taken.mark &&
           (lengthWithin(*taken.mark, taken.leaderEnd(), box) > 0 || leaderCrosses(*taken.mark, taken.leaderEnd()));
  });
  if (meetsName) return least;
  double cost = spot.cost;
  ink_.any(all, [&](const Ink& ink) {
    cost +=
        ink.weight * (lengthWithin(ink.from, ink.to, grown(box, 1.5)) / 2 + (leaderCrosses(ink.from, ink.to) ? 4 : 0));
    return cost >= least;
  });
  return std::min(cost, least);
}

const std::vector<Label>& Labels::place() {
  constexpr int kRounds = 3;  // in the first each takes the cheapest free place, then each may move to a cheaper one
  std::stable_sort(labels_.begin(), labels_.end(), [](const Label& a, const Label& b) { return a.rank < b.rank; });
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      double least = HUGE_VAL;
      const Spot* best = nullptr;
      for (const Spot& spot : labels_[i].spots)
        if (const double cost = costOf(labels_[i], spot, least); cost < least) least = cost, best = &spot;
      labels_[i].chosen = best ? std::optional(*best) : std::nullopt;
      if (best) names_.add(grown(best->bounds(), 1), i);
    }
  return labels_;
}

}  // namespace viewproj::cmd
