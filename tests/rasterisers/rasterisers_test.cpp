// OpenGL as the judge: it draws points with the matrices that the tool prints, and its framebuffer says what the tool
// says.
#include <cmath>
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

using Tally = std::map<std::string, int>;

constexpr const char* kFormats[] = {"D32F", "D24", "D16"};

std::string depthConvention(const Scene& scene) {
  const CameraCase& c = scene.camera;
  return std::string(scene.draw.zeroToOne ? "0..1" : "-1..1") + (c.reverseZ != c.otherWay ? " reversed" : "") +
         (c.orthographic ? " orthographic"
          : c.infinite   ? " infinite"
                         : "");
}

/// What the scene shows, and how many points lie beyond one side alone.
void count(const Scene& scene, Tally& cameras, Tally& sides) {
  const CameraCase& c = scene.camera;
  ++cameras[c.preset + (c.reverseZ != c.otherWay ? " reversed" : "")];
  ++cameras[depthConvention(scene)];
  ++cameras[kFormats[static_cast<int>(c.format)]];
  ++cameras[scene.upsideDown ? "upside down" : "upright"];
  ++cameras[c.mirrored ? "mirrored by the API" : "not mirrored"];
  ++cameras[c.product ? "one matrix" : "two matrices"];
  ++cameras[c.relativeToEye ? "relative to the eye" : "from the origin"];
  for (const Point& point : scene.points)
    if (point.outside.size() == 1) ++sides[point.outside[0]];
}

void requireVisited(const Tally& cameras, const Tally& sides) {
  std::vector<std::string> wanted{
      "D32F",           "D24",        "D16",          "upside down",         "upright",
      "not mirrored",   "one matrix", "two matrices", "mirrored by the API", "relative to the eye",
      "from the origin"};
  for (const char* preset :
       {"opengl", "opengl-lh", "d3d", "d3d-rh", "vulkan", "metal", "webgpu", "unity", "unreal", "opencv", "ps2"})
    for (const char* reversed : {"", " reversed"}) wanted.push_back(std::string(preset) + reversed);
  for (const char* range : {"0..1", "-1..1"})
    for (const char* reversed : {"", " reversed"})
      for (const char* kind : {"", " infinite", " orthographic"})
        wanted.push_back(std::string(range) + reversed + kind);
  for (const std::string& what : wanted) {
    INFO(what);
    CHECK(cameras.count(what) == 1);
  }
  for (const char* side : {"left", "right", "bottom", "top", "near", "far", "behind"}) {
    INFO(side);
    CHECK((sides.count(side) == 1 && sides.at(side) >= 100));
  }
}

}  // namespace

TEST_CASE("The pixel that lights, its depth, what is clipped and what a pixel picks are the tool's") {
  requireDriver();
  Judgement all;
  int border = 0, boundary = 0;
  Tally cameras, sides;
  std::map<std::string, double> worstDepth;
  for (int i = 0; i < kCameras; ++i) {
    const CameraCase camera = cameraCase(i);
    const Scene scene = prepare(camera);
    const Judgement j = judge(scene);
    INFO(camera.name());
    for (const std::string& words : j.words) UNSCOPED_INFO(words);
    CHECK(j.disagreements() == 0);
    // A rasteriser snaps to the nearest 1/256 pixel, which is half of the margin; the other half is float32's.
    CHECK(j.worstPixels <= 1.0 / 512);
    count(scene, cameras, sides);
    border += scene.besideBorder;
    boundary += scene.besideBoundary;
    all.visible += j.visible;
    all.clipped += j.clipped;
    all.picked += j.picked;
    all.unbounded += j.unbounded;
    all.misplaced += j.disagreements();
    all.worstPixels = std::max(all.worstPixels, j.worstPixels);
    all.worstPick = std::max(all.worstPick, j.worstPick);
    double& worst = worstDepth[kFormats[static_cast<int>(camera.format)]];
    worst = std::max(worst, j.worstDepth);
  }
  requireVisited(cameras, sides);
  CHECK(all.visible >= 20000);
  // What is left out is what the margins have to leave out, and no more.
  CHECK(border <= all.visible / 20);
  CHECK(boundary <= all.visible / 500);

  std::printf("%s\n%d disagreements over %d cameras, %d visible and %d clipped points, %d picks\n", driver().c_str(),
              all.misplaced, kCameras, all.visible, all.clipped, all.picked);
  std::printf("left out: %d points at a pixel's border, %d at a clip boundary, %d picks near infinity\n", border,
              boundary, all.unbounded);
  std::printf("float32 moves a point by at most %.2g px; worst, in units of its bound: pick %.2f, depth",
              all.worstPixels, all.worstPick);
  for (const auto& [format, worst] : worstDepth) std::printf(" %s %.2f", format.c_str(), worst);
  std::printf("\n");
  for (const Tally& tally : {cameras, sides}) {
    for (const auto& [what, times] : tally) std::printf("%s: %d; ", what.c_str(), times);
    std::printf("\n");
  }
}

TEST_CASE("A rasteriser that is told something else disagrees") {
  requireDriver();
  struct Spoil {
    const char* what;
    double share;  ///< of the visible points at least
    bool appears;  ///< clipped points too
    std::function<void(Draw&)> spoil;
  };
  const Spoil spoils[] = {
      {"y the other way", 0.9, false, [](Draw& d) { d.mirrored = !d.mirrored; }},
      {"the other range of NDC z", 0.9, true, [](Draw& d) { d.zeroToOne = !d.zeroToOne; }},
      {"near and far exchanged", 0.9, false, [](Draw& d) { std::swap(d.depthRange[0], d.depthRange[1]); }},
      {"the depth range short by a ten-thousandth", 0.5, false,
       [](Draw& d) { d.depthRange[1] += (d.depthRange[0] - d.depthRange[1]) * 1e-4; }},
      {"matrices transposed", 0.9, false,
       [](Draw& d) {
         if (d.rowVectors)
           d.rowVectors = false;
         else
           d.rowMajor = !d.rowMajor;
       }},
      {"a pixel to the right", 0.9, false, [](Draw& d) { d.x += 1; }},
      {"half a pixel down", 0.4, false, [](Draw& d) { d.y += 0.5; }},
      {"a 64th of a pixel to the right", 0.03, false, [](Draw& d) { d.x += 1.0 / 64; }},
      {"a 64th of a pixel down", 0.03, false, [](Draw& d) { d.y += 1.0 / 64; }},
      {"everything nearer to the middle", 0.9, true,
       [](Draw& d) {
         for (std::size_t row : {0u, 1u})
           for (std::size_t j = 0; j < 4; ++j)
             d.projection[d.rowVectors == d.rowMajor ? 4 * j + row : 4 * row + j] *= 0.8f;
       }},
      {"a pixel wider", 0.4, false, [](Draw& d) { ++d.viewportWidth; }},
  };
  std::map<std::string, int> appeared;
  for (int i = 0; i < kCameras; i += 5) {
    const CameraCase camera = cameraCase(i);
    const Scene scene = prepare(camera);
    for (const auto& [what, share, appears, spoil] : spoils) {
      Draw told = scene.draw;
      spoil(told);
      const Judgement j = judge(scene, spoil);
      INFO(what << ": " << camera.name());
      CHECK(j.disagreements() > share * j.visible);
      if (appears) appeared[what] += j.appeared;
    }
  }
  for (const auto& [what, points] : appeared) {
    INFO(what);
    CHECK(points > 0);
  }
}
