// Random lenses against OpenCV's projectPoints and undistortPoints, in pixels.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/screen.hpp"

using namespace viewproj;
using nlohmann::json;

namespace {

Lens lensOf(const json& test) {
  const json& v = test["vector"];
  const auto at = [&](std::size_t i) { return i < v.size() ? v[i].get<double>() : 0; };
  if (test["model"] == "fisheye") return fisheyeLens({at(0), at(1), at(2), at(3)});
  return brownLens({at(0), at(1), at(4), at(5), at(6), at(7)}, {at(2), at(3)});
}

}  // namespace

TEST_CASE("Calibrations' lenses put points where OpenCV puts them, to 1e-9 px, but for those that it folds") {
  const char* fresh = std::getenv("VIEWPROJ_FIXTURES");
  std::ifstream lines(std::string(fresh ? fresh : VIEWPROJ_FIXTURES_DIR) + "/lenses.jsonl");
  int lenses = 0, points = 0, folded = 0, foldedIntoPicture = 0, lost = 0;
  double worst = 0, worstBack = 0, worstOfOpenCV = 0;
  for (std::string line; std::getline(lines, line); ++lenses) {
    const json test = json::parse(line);
    INFO(line);
    const json& K = test["K"];
    const double fx = K[0], fy = K[1], cx = K[2], cy = K[3];
    const Viewport viewport{.width = test["size"][0], .height = test["size"][1], .pixelCenter = 0};
    const Pose pose = poseFromRotation({0, 0, 0}, {}, CameraAxes::RDF, Handedness::right);
    const Camera camera =
        withLens(makeCamera(pose, intrinsics(fx, fy, cx, cy, viewport, 0.1, 1000), viewport), lensOf(test));
    for (std::size_t i = 0; i < test["points"].size(); ++i) {
      const json &p = test["points"][i], &said = test["pixels"][i], &back = test["undistorted"][i];
      const Vec3 point{p[0], p[1], p[2]};
      const Vec2 pixel{said[0], said[1]};
      const ScreenPoint got = worldToScreen(camera, point);
      if (got.status == PointStatus::beyondLens) {
        ++folded;
        foldedIntoPicture += pixel.x >= 0 && pixel.x <= viewport.width && pixel.y >= 0 && pixel.y <= viewport.height;
        continue;
      }
      REQUIRE(got.status == PointStatus::inFront);
      const double off = std::hypot(got.x - pixel.x, got.y - pixel.y);
      REQUIRE(off <= 1e-9);
      worst = std::max(worst, off);
      ++points;
      // The way back: how far from the point's own pinhole pixel.
      const auto missed = [&](double x, double y) {
        return std::hypot(fx * (x - point.x / point.z), fy * (y - point.y / point.z));
      };
      const Vec3 ray = screenToRay(camera, pixel).direction;
      if (std::isnan(ray.x)) {
        ++lost;
        continue;
      }
      worstBack = std::max(worstBack, missed(ray.x / ray.z, ray.y / ray.z));
      worstOfOpenCV = std::max(worstOfOpenCV, missed(back[0], back[1]));
    }
  }
  std::printf("  %d lenses, %d points: %.1e px; back %.1e px, OpenCV's %.1e px; %d folded, %d into the picture\n",
              lenses, points, worst, worstBack, worstOfOpenCV, folded, foldedIntoPicture);
  CHECK((lenses >= 60 && points > lenses));
  CHECK((folded > lenses / 20 && foldedIntoPicture > lenses / 30));
  CHECK(lost == 0);
  CHECK(worstBack <= 1e-9);
}
