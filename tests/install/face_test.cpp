// With the public headers alone a program makes the very cameras that the tool makes: of every camera.json of the
// samples, bits compared. It is linked with the library and nothing of cmd.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <viewproj/geodesy.hpp>
#include <viewproj/viewproj.hpp>

#include "tool.hpp"

using namespace viewproj;
using nlohmann::json;

namespace {

Vec3 vectorOf(const json& v) { return {v[0], v[1], v[2]}; }

Convention conventionOf(const json& camera, const ConventionPreset& preset) {
  Convention convention = preset;
  if (const json stated = camera.value("convention", json()); stated.is_object())
    convention.reverseZ = stated.value("reverseZ", convention.reverseZ);
  return convention;
}

Pose poseOf(const json& camera, const ConventionPreset& preset) {
  const json& at = camera["position"];
  if (at.is_object())
    return poseFromHeadingPitchRoll({at["lat"], at["lon"], at["height"]}, {camera["heading"].get<double>(), 0, 0});
  const Vec3 up = camera.contains("up") ? vectorOf(camera["up"]) : preset.up;
  const Handedness world = preset.convention.world;
  return camera.contains("target") ? lookAt(vectorOf(at), vectorOf(camera["target"]), up, world)
                                   : lookAlong(vectorOf(at), vectorOf(camera["direction"]), up, world);
}

Viewport viewportOf(const json& camera, const ConventionPreset& preset) {
  const json &v = camera["viewport"], &p = camera["projection"];
  Viewport viewport{.width = v["width"], .height = v["height"]};
  viewport.pixelCenter = preset.pixelCenter;
  if (v.value("origin", "") == "bottom-left") viewport.origin = Origin::bottomLeft;
  if (p["type"] == "ps2") {
    viewport.x = p["cx"].get<double>() - viewport.width / 2;
    viewport.y = p["cy"].get<double>() - viewport.height / 2;
    viewport.depthFirst = p["zMin"];
    viewport.depthSecond = p["zMax"];
  }
  return viewport;
}

Projection projectionOf(const json& p, const Viewport& viewport) {
  const double near = p.value("near", 0.0), far = p.value("far", kInfiniteFar);
  if (p.contains("fovY")) return perspective(p["fovY"].get<double>(), viewport, near, far);
  if (p.contains("fovX")) return perspective(p["fovX"].get<double>(), viewport, near, far, Fov::horizontal);
  if (p.contains("nearWidth")) {
    const double right = p["nearWidth"].get<double>() / 2, top = p["nearHeight"].get<double>() / 2;
    return frustum(-right, right, -top, top, near, far);
  }
  if (p.contains("focalLength"))
    return perspectiveFocalLength(p["focalLength"], {p["sensorWidth"], p["sensorHeight"]}, viewport, near, far);
  if (p.contains("fx")) return intrinsics(p["fx"], p["fy"], p["cx"], p["cy"], viewport, near, far);
  return ps2Intrinsics(p["scrz"], p["ax"], p["ay"], p["cx"], p["cy"], viewport, near, far);
}

Camera cameraOf(const json& camera) {
  const json stated = camera.value("convention", json());
  const std::string name = stated.is_string()                      ? stated.get<std::string>()
                           : stated.is_object()                    ? stated["preset"].get<std::string>()
                           : camera["projection"]["type"] == "ps2" ? "ps2"
                                                                   : "opengl";
  const ConventionPreset& preset = *findPreset(name);
  const Viewport viewport = viewportOf(camera, preset);
  const Camera pinhole = makeCamera(poseOf(camera, preset), projectionOf(camera["projection"], viewport), viewport,
                                    conventionOf(camera, preset));
  if (!camera.contains("distortion")) return pinhole;
  const json& k = camera["distortion"]["k"];
  if (camera["distortion"]["model"] == "fisheye") return withLens(pinhole, fisheyeLens({k[0], k[1], k[2], k[3]}));
  const json& p = camera["distortion"]["p"];
  return withLens(pinhole, brownLens({k[0], k[1], k[2]}, {p[0], p[1]}));
}

bool isSame(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("A program makes the cameras of the samples as the tool does, to the last bit") {
  int cameras = 0, inFront = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(VIEWPROJ_SAMPLES)) {
    if (entry.path().filename() != "camera.json") continue;
    INFO(entry.path().string());
    ++cameras;
    const Camera camera = cameraOf(json::parse(std::ifstream(entry.path())));
    const Viewport& v = camera.viewport();
    std::vector<std::string> arguments{"project", "-c", entry.path().string(), "--to", "json"};
    std::vector<Vec3> points;
    for (const double across : {0.1, 0.3, 0.77, 1.05})
      for (const double distance : {0.7, 13.1, 1234.5}) {
        const Vec3 eye = camera.pose().eye(),
                   direction = screenToRay(camera, {v.x + across * v.width, v.y + 0.4 * v.height}).direction;
        if (std::isnan(direction.x)) continue;  // the lens shows nothing there
        points.push_back(
            {eye.x + distance * direction.x, eye.y + distance * direction.y, eye.z + distance * direction.z});
        const json written = {points.back().x, points.back().y, points.back().z};
        arguments.push_back("--point=x=" + written[0].dump() + ",y=" + written[1].dump() + ",z=" + written[2].dump());
      }
    const json told = json::parse(tool::printed(arguments));
    REQUIRE(told.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ScreenPoint p = worldToScreen(camera, points[i]);
      INFO(told[i].dump());
      REQUIRE(p.status == PointStatus::inFront);
      ++inFront;
      CHECK(isSame(p.x, told[i]["screen"][0]));
      CHECK(isSame(p.y, told[i]["screen"][1]));
      CHECK((told[i]["depth"].is_null() ? std::isnan(p.depth) : isSame(p.depth, told[i]["depth"])));
      CHECK(isSame(p.viewDistance, told[i]["viewDistance"]));
    }
  }
  CHECK(cameras >= 10);
  CHECK(inFront >= 11 * cameras);
}
