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

TEST_CASE("The pixel that lights, its depth and what is clipped are the tool's") {
  requireDriver();
  Judgement all;
  int border = 0, boundary = 0;
  Tally cameras, sides;
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
  }
  requireVisited(cameras, sides);
  CHECK(all.visible >= 20000);
  // What is left out is what the margins have to leave out, and no more.
  CHECK(border <= all.visible / 20);
  CHECK(boundary <= all.visible / 500);
}
