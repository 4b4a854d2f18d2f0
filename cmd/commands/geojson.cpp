#include "commands/geojson.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace viewproj::cmd {
namespace {

constexpr double kEdge = 180, kTurn = 360;

Vec2 crossingOf(const Vec2& a, const Vec2& b, double lon) {
  return {lon, a.y + (b.y - a.y) * (lon - a.x) / (b.x - a.x)};
}

/// The ring without jumps of longitude, and its first vertex again at the end.
MapRing unwrapped(const MapRing& ring) {
  MapRing line{ring.front()};
  for (std::size_t i = 1; i <= ring.size(); ++i) {
    const Vec2& next = ring[i % ring.size()];
    line.push_back({line.back().x + std::remainder(next.x - line.back().x, kTurn), next.y});
  }
  return line;
}

/// A line round a pole as a ring: from where it first passes the antimeridian once round, and back along the pole.
MapRing closedAtPole(const MapRing& line, double turn, double pole) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 &a = line[i], &b = line[i + 1];
    const double low = std::min(a.x, b.x), high = std::max(a.x, b.x);
    const double lon = kEdge + kTurn * std::ceil((low - kEdge) / kTurn);
    if (lon >= high) continue;
    const Vec2 start = crossingOf(a, b, lon);
    MapRing ring{start};
    ring.insert(ring.end(), line.begin() + static_cast<std::ptrdiff_t>(i) + 1, line.end() - 1);
    for (std::size_t k = 0; k <= i; ++k) ring.push_back({line[k].x + turn, line[k].y});
    ring.insert(ring.end(), {{lon + turn, start.y}, {lon + turn, pole}, {lon, pole}});
    return ring;
  }
  return line;
}

/// A part of a ring on one side of the antimeridian, from edge to edge.
struct Chain {
  MapRing points;
  bool isBeyond;
};

std::vector<Chain> chainsOf(const MapRing& ring) {
  const std::size_t n = ring.size();
  const auto isBeyond = [&](std::size_t i) { return ring[i % n].x > kEdge; };
  std::size_t first = 1;
  while (isBeyond(first) == isBeyond(first - 1)) ++first;
  std::vector<Chain> chains;
  for (std::size_t i = first; i <= first + n; ++i) {
    if (isBeyond(i) != isBeyond(i + n - 1)) {
      const Vec2 crossing = crossingOf(ring[(i + n - 1) % n], ring[i % n], kEdge);
      if (!chains.empty()) chains.back().points.push_back(crossing);
      if (i < first + n) chains.push_back({{crossing}, isBeyond(i)});
    }
    if (i < first + n) chains.back().points.push_back(ring[i % n]);
  }
  return chains;
}

/// The chains of one side as rings: of their ends in order along the edge, the first and second belong together, the
/// third and fourth, and so on.
std::vector<MapRing> joined(const std::vector<Chain>& chains, bool beyond) {
  struct End {
    double lat;
    std::size_t chain;
  };
  std::vector<End> ends;
  for (std::size_t i = 0; i < chains.size(); ++i)
    if (chains[i].isBeyond == beyond)
      for (const Vec2& end : {chains[i].points.front(), chains[i].points.back()}) ends.push_back({end.y, i});
  std::vector<std::size_t> order(ends.size()), partner(ends.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return ends[a].lat < ends[b].lat; });
  for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
    partner[order[i]] = order[i + 1];
    partner[order[i + 1]] = order[i];
  }
  std::vector<MapRing> rings;
  std::vector<bool> isUsed(ends.size());
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    if (isUsed[i]) continue;
    rings.emplace_back();
    for (std::size_t end = i; !isUsed[end];) {  // 2k and 2k + 1 are the ends of a chain
      isUsed[end] = isUsed[end ^ 1U] = true;
      const MapRing& points = chains[ends[end].chain].points;
      if (end % 2 == 0)
        rings.back().insert(rings.back().end(), points.begin(), points.end());
      else
        rings.back().insert(rings.back().end(), points.rbegin(), points.rend());
      end = partner[end ^ 1U];
    }
  }
  return rings;
}

void addParts(MapRing ring, std::vector<MapRing>& parts) {
  const auto [low, high] =
      std::minmax_element(ring.begin(), ring.end(), [](const Vec2& a, const Vec2& b) { return a.x < b.x; });
  const double shift = kTurn * std::floor((low->x + kEdge) / kTurn);
  const bool passes = high->x - shift > kEdge;
  for (Vec2& place : ring) place.x -= shift;
  if (!passes) {
    parts.push_back(std::move(ring));
    return;
  }
  const std::vector<Chain> chains = chainsOf(ring);
  for (MapRing& part : joined(chains, false)) parts.push_back(std::move(part));
  for (MapRing& part : joined(chains, true)) {
    for (Vec2& place : part) place.x -= kTurn;
    addParts(std::move(part), parts);
  }
}

double turnedArea(const MapRing& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += (a.x - ring[0].x) * (b.y - ring[0].y) - (b.x - ring[0].x) * (a.y - ring[0].y);
  }
  return twice;
}

}  // namespace

std::vector<MapRing> mapRings(const MapRing& ring, double pole) {
  MapRing line = unwrapped(ring);
  const double turn = kTurn * std::round((line.back().x - line.front().x) / kTurn);
  if (turn != 0)
    line = closedAtPole(line, turn, pole);
  else
    line.pop_back();
  std::vector<MapRing> parts;
  addParts(std::move(line), parts);
  for (MapRing& part : parts) {
    if (turnedArea(part) < 0) std::reverse(part.begin(), part.end());
    part.push_back(part.front());
  }
  return parts;
}

}  // namespace viewproj::cmd
