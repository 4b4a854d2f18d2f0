#include "commands/geojson.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace viewproj::cmd {
namespace {

constexpr double kEdge = 180, kTurn = 360;

/// Where a line of the map passes an antimeridian: 180, 540, ...
std::optional<Vec2> crossingOf(const Vec2& a, const Vec2& b) {
  const double low = std::min(a.x, b.x), lon = kEdge + kTurn * std::ceil((low - kEdge) / kTurn);
  if (!(lon < std::max(a.x, b.x))) return std::nullopt;
  return Vec2{lon, a.y + (b.y - a.y) * (lon - a.x) / (b.x - a.x)};
}

/// A ring without jumps of longitude. One round a pole begins where it first passes an antimeridian, and returns along
/// the pole.
MapRing unwrapped(const MapRing& ring, double pole) {
  MapRing line{ring.front()};
  for (std::size_t i = 1; i <= ring.size(); ++i) {
    const Vec2& last = line.back();
    line.push_back({last.x + std::remainder(ring[i % ring.size()].x - last.x, kTurn), ring[i % ring.size()].y});
  }
  const double turn = kTurn * std::round((line.back().x - line.front().x) / kTurn);
  for (std::size_t i = 0; turn != 0 && i + 1 < line.size(); ++i)
    if (const auto start = crossingOf(line[i], line[i + 1])) {
      line.pop_back();
      for (std::size_t k = 0; k <= i; ++k) line[k].x += turn;
      std::rotate(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(i) + 1, line.end());
      line.insert(line.begin(), *start);
      line.insert(line.end(), {{start->x + turn, start->y}, {start->x + turn, pole}, {start->x, pole}});
      return line;
    }
  line.pop_back();
  return line;
}

/// Cut at the antimeridians that it passes. Of its crossings with one, in order of latitude, the first and second
/// belong together, the third and fourth, and so on: between them it is inside.
std::vector<MapRing> cutParts(const MapRing& ring) {
  MapRing all;
  std::vector<std::size_t> crossings;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    all.push_back(ring[i]);
    const auto crossing = crossingOf(ring[i], ring[(i + 1) % ring.size()]);
    if (!crossing) continue;
    crossings.push_back(all.size());
    all.push_back(*crossing);
  }
  if (crossings.empty()) return {ring};
  std::stable_sort(crossings.begin(), crossings.end(), [&](std::size_t a, std::size_t b) {
    return all[a].x != all[b].x ? all[a].x < all[b].x : all[a].y < all[b].y;
  });
  std::vector<std::size_t> partner(all.size(), all.size());
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    partner[crossings[k]] = crossings[k + 1];
    partner[crossings[k + 1]] = crossings[k];
  }
  std::vector<MapRing> parts;
  std::vector<bool> isUsed(all.size());
  for (const std::size_t start : crossings) {
    MapRing part;
    for (std::size_t i = start; !isUsed[i]; i = partner[i]) {
      isUsed[i] = true;
      part.push_back(all[i]);
      do part.push_back(all[i = (i + 1) % all.size()]);
      while (partner[i] == all.size());
    }
    if (!part.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

/// Twice the area, above 0 if it runs anticlockwise.
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
  std::vector<MapRing> parts = cutParts(unwrapped(ring, pole));
  std::erase_if(parts, [](const MapRing& part) { return turnedArea(part) == 0; });  // along an antimeridian
  for (MapRing& part : parts) {
    const auto [low, high] =
        std::minmax_element(part.begin(), part.end(), [](const Vec2& a, const Vec2& b) { return a.x < b.x; });
    const double shift = kTurn * std::round((low->x + high->x) / 2 / kTurn);
    for (Vec2& place : part) place.x -= shift;
    if (turnedArea(part) < 0) std::reverse(part.begin(), part.end());
    part.push_back(part.front());
  }
  return parts;
}

}  // namespace viewproj::cmd
