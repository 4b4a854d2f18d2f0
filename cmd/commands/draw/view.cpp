#include "commands/draw/view.hpp"

#include <algorithm>
#include <cmath>

#include "viewproj/clip.hpp"

namespace viewproj::cmd {

void addPoint(View& view, std::string label, const Vec4& point) {
  if (++view.pointsRead > kMostDrawn) return;
  DrawnPoint drawn{std::move(label), worldToScreen(view.camera, point)};
  if (drawn.screen.status != PointStatus::inFront) {
    // View space of the default convention: x right, y up.
    const Vec3 eye = worldToView(view.camera, point, Convention{});
    const double size = std::max({std::fabs(eye.x), std::fabs(eye.y), 1e-300});
    drawn.toward = {eye.x / size * std::fabs(view.camera.screen.scaleX.hi),
                    eye.y / size * std::fabs(view.camera.screen.scaleY.hi)};
  }
  view.points.push_back(std::move(drawn));
}

}  // namespace viewproj::cmd
