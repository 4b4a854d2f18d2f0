// A graphics API as the judge: it draws points with the matrices that the tool prints, and its framebuffer says what
// the tool says. One program for OpenGL, one for Vulkan.
#include <cstdio>
#include <cstdlib>
#include <map>

#include "catch.hpp"
#include "judgement.hpp"

using namespace rasterisers;

namespace {

void requireDriver() {
  const std::string trouble = unavailable();
  if (trouble.empty()) return;
  std::printf("skipped: %s\n", trouble.c_str());
  std::exit(77);
}

bool canDraw(const Scene& scene) { return scene.draw.zeroToOne || drawsMinusOneToOne(); }

}  // namespace

TEST_CASE("The pixel that lights, its depth, what is clipped and what a pixel picks are the tool's") {
  requireDriver();
  Judgement all;
  int cameras = 0, left = 0, border = 0, boundary = 0;
  std::map<std::string, int> visited;
  for (int i = 0; i < kCameras; ++i) {
    const CameraCase camera = cameraCase(i);
    const Scene scene = prepare(camera);
    INFO(camera.name());
    if (!canDraw(scene)) {
      ++left;
      continue;
    }
    ++cameras;
    const Judgement j = judge(scene);
    for (const std::string& words : j.words) UNSCOPED_INFO(words);
    CHECK(j.misplaced == 0);
    CHECK(j.wronglyDeep == 0);
    CHECK(j.appeared == 0);
    CHECK(j.mispicked == 0);
    // A rasteriser snaps to the nearest 1/256 pixel; the rest of the margin is float32's.
    CHECK(j.worstPixels <= 1.0 / 512);
    all.visible += j.visible;
    all.clipped += j.clipped;
    all.picked += j.picked;
    all.unbounded += j.unbounded;
    all.misplaced += j.disagreements();
    all.worstPixels = std::max(all.worstPixels, j.worstPixels);
    all.worstDepth = std::max(all.worstDepth, j.worstDepth);
    all.worstPick = std::max(all.worstPick, j.worstPick);
    border += scene.besideBorder;
    boundary += scene.besideBoundary;

    const bool reversed = camera.reverseZ != camera.otherWay;
    ++visited[camera.preset + (reversed ? " reversed" : "")];
    ++visited[std::string(scene.draw.zeroToOne ? "0..1" : "-1..1") + (reversed ? " reversed" : "") +
              (camera.orthographic ? " orthographic"
               : camera.infinite   ? " infinite"
                                   : "")];
    ++visited["format " + std::to_string(static_cast<int>(camera.format))];
    ++visited[scene.upsideDown ? "upside down" : "upright"];
    ++visited[camera.product ? "one matrix" : "two matrices"];
    for (const Point& point : scene.points)
      for (const std::string& side : point.outside) ++visited[side];
  }
  std::printf(
      "%s\n%d cameras (%d left out), %d points in the picture, %d clipped; left out: %d at a pixel's border, %d at a "
      "clip "
      "boundary\n%d disagreements; depth within %.2f of its bound; %d picks within %.2f of theirs (%d without); "
      "float32 "
      "within %.2g px\n",
      driver().c_str(), cameras, left, all.visible, all.clipped, border, boundary, all.misplaced, all.worstDepth,
      all.picked, all.worstPick, all.unbounded, all.worstPixels);
  for (const auto& [what, count] : visited) std::printf("  %s %d\n", what.c_str(), count);
}
