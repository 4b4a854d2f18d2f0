#include "judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "records.hpp"

namespace rasterisers {
namespace {

using nlohmann::json;

void say(Judgement& judgement, const Point& point, const std::string& what) {
  if (judgement.words.size() >= 5) return;
  judgement.words.push_back(json(point.position).dump() + " at " + json(point.screen).dump() + ": " + what);
}

/// The points in as few pictures as have one of them a pixel.
std::vector<std::vector<const Point*>> apart(const Scene& scene) {
  std::vector<std::vector<const Point*>> pictures;
  std::vector<std::set<std::pair<int, int>>> taken;
  for (const Point& point : scene.points) {
    if (!point.visible) continue;
    std::size_t i = 0;
    while (i < taken.size() && taken[i].count({point.column, point.row})) ++i;
    if (i == taken.size()) {
      taken.emplace_back();
      pictures.emplace_back();
    }
    taken[i].insert({point.column, point.row});
    pictures[i].push_back(&point);
  }
  return pictures;
}

Picture draw(const Scene& scene, const std::vector<const Point*>& points) {
  Draw d = scene.draw;
  for (const Point* point : points) d.points.push_back(point->vertex);
  return render(d);
}

struct Seen {
  const Point* point;
  double depth;  ///< as the buffer stored it, with the file's reverseZ
};

/// The window depth of the written convention, from the file's or back.
double otherWay(double depth, const Scene& scene) {
  return scene.camera.otherWay ? scene.draw.depthRange[0] + scene.draw.depthRange[1] - depth : depth;
}

double depthBound(const Point& point, const Scene& scene) {
  return point.rounding.depth + storageStep(scene.draw.format);
}

void judgeVisible(const Scene& scene, const std::vector<const Point*>& points, const Picture& picture,
                  Judgement& judgement, std::vector<Seen>& seen) {
  const Draw& d = scene.draw;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = *points[i];
    ++judgement.visible;
    judgement.worstPixels = std::max({judgement.worstPixels, point.rounding.x, point.rounding.y});
    const int row = scene.upsideDown ? d.height - 1 - point.row : point.row;
    const std::size_t pixel =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(d.width) + static_cast<std::size_t>(point.column);
    if (picture.ids[pixel] != i + 1) {
      ++judgement.misplaced;
      say(judgement, point, "its pixel holds " + std::to_string(picture.ids[pixel]));
      continue;
    }
    const double stored = picture.depths[pixel];
    const double off = std::fabs(stored - otherWay(point.depth, scene)) / depthBound(point, scene);
    judgement.worstDepth = std::max(judgement.worstDepth, off);
    if (!(off <= 1)) {
      ++judgement.wronglyDeep;
      say(judgement, point, "depth " + json(stored).dump() + " and not " + json(otherWay(point.depth, scene)).dump());
      continue;
    }
    seen.push_back({&point, otherWay(stored, scene)});
  }
}

/// How far a stored depth may be from the point's distance; nothing where it may be infinite.
std::optional<double> distanceBound(const Point& point, const Scene& scene) {
  const json& projection = scene.camera.camera["projection"];
  const double near = projection["near"];
  const double far = projection.value("far", std::numeric_limits<double>::infinity());
  const double share = depthBound(point, scene) / std::fabs(scene.draw.depthRange[1] - scene.draw.depthRange[0]);
  if (scene.camera.orthographic) return share * (far - near);
  // depth = (1/near - 1/distance) / (1/near - 1/far)
  const double nearness = 1 / point.viewDistance - share * (1 / near - 1 / far);
  if (!(nearness > 0)) return std::nullopt;
  return 1 / nearness - point.viewDistance;
}

// With distance z along the view axis and the ray r that goes a unit along it, a point is eye + z r. So
// picked - point = z' (r' - r) + (z' - z) r: what the pixel is off at the picked distance, and what the depth is off.
void judgePicks(const Scene& scene, const std::vector<Seen>& seen, Judgement& judgement) {
  std::vector<json> pixels;
  std::vector<std::array<double, 2>> off;
  const double centre = scene.camera.camera["viewport"].value("pixelCenter", 0.5);
  for (const auto& [point, depth] : seen) {
    const double x = std::floor(point->screen[0] + 0.5 - centre) + centre;
    const double y = std::floor(point->screen[1] + 0.5 - centre) + centre;
    pixels.push_back({{"screen", point->screen}, {"depth", depth}});
    pixels.push_back({{"screen", {x, y}}, {"depth", depth}});
    off.push_back({0, 0});
    off.push_back({x - point->screen[0], y - point->screen[1]});
  }
  const std::vector<json> rays = filter({"ray", "-c", scene.camera.camera.dump()}, pixels);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Point& point = *seen[i / 2].point;
    const std::optional<double> distance = distanceBound(point, scene);
    if (!distance) {
      ++judgement.unbounded;
      continue;
    }
    ++judgement.picked;
    const std::array<double, 3> eye = rays[i]["origin"];
    std::array<double, 3> picked;
    picked.fill(std::numeric_limits<double>::quiet_NaN());
    if (!rays[i]["point"].is_null()) picked = rays[i]["point"];
    double apartSquared = 0, fromEye = 0, magnitude = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      apartSquared += std::pow(picked[k] - point.position[k], 2);
      fromEye += std::pow(point.position[k] - eye[k], 2);
      magnitude += std::fabs(point.position[k]) + std::fabs(eye[k]);
    }
    const double slant = scene.camera.orthographic ? 1 : std::sqrt(fromEye) / point.viewDistance;
    const double reach = scene.camera.orthographic ? 1 : point.viewDistance + *distance;
    const double bound =
        reach * std::hypot(scene.pixelSize[0] * off[i][0], scene.pixelSize[1] * off[i][1]) + *distance * slant;
    // The pixel's size comes from a float32 matrix, the points are doubles.
    const double units = std::sqrt(apartSquared) / (bound * (1 + 4 * kUnit) + 0x1p-50 * magnitude);
    if (i % 2 == 0) judgement.worstPick = std::max(judgement.worstPick, units);
    if (!(units <= 1)) {
      ++judgement.mispicked;
      say(judgement, point, "picked back as " + rays[i].dump());
    }
  }
}

}  // namespace

Judgement judge(const Scene& scene) {
  Judgement judgement;
  std::vector<Seen> seen;
  for (const std::vector<const Point*>& points : apart(scene))
    judgeVisible(scene, points, draw(scene, points), judgement, seen);

  std::vector<const Point*> clipped;
  for (const Point& point : scene.points)
    if (!point.visible) clipped.push_back(&point);
  judgement.clipped = static_cast<int>(clipped.size());
  std::set<std::uint32_t> appeared;
  for (std::uint32_t id : draw(scene, clipped).ids)
    if (id != 0 && appeared.insert(id).second) {
      ++judgement.appeared;
      say(judgement, *clipped[id - 1], "clipped, but there");
    }
  judgePicks(scene, seen, judgement);
  return judgement;
}

}  // namespace rasterisers
