#include "judgement.hpp"

#include <algorithm>
#include <cmath>
#include <set>

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

/// The window depth of the written convention, from the file's or back.
double otherWay(double depth, const Scene& scene) {
  return scene.camera.otherWay ? scene.draw.depthRange[0] + scene.draw.depthRange[1] - depth : depth;
}

double depthBound(const Point& point, const Scene& scene) {
  return point.rounding.depth + storageStep(scene.draw.format);
}

void judgeVisible(const Scene& scene, const std::vector<const Point*>& points, const Picture& picture,
                  Judgement& judgement) {
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
    if (!(off <= 1)) {
      ++judgement.wronglyDeep;
      say(judgement, point, "depth " + json(stored).dump() + " and not " + json(otherWay(point.depth, scene)).dump());
    }
  }
}

}  // namespace

Judgement judge(const Scene& scene) {
  Judgement judgement;
  for (const std::vector<const Point*>& points : apart(scene))
    judgeVisible(scene, points, draw(scene, points), judgement);

  std::vector<const Point*> clipped;
  for (const Point& point : scene.points)
    if (!point.visible) clipped.push_back(&point);
  std::set<std::uint32_t> appeared;
  for (std::uint32_t id : draw(scene, clipped).ids)
    if (id != 0 && appeared.insert(id).second) {
      ++judgement.appeared;
      say(judgement, *clipped[id - 1], "clipped, but there");
    }
  return judgement;
}

}  // namespace rasterisers
