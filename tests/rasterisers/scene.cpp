#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "catch.hpp"
#include "judgement.hpp"
#include "random.hpp"
#include "records.hpp"
#include "tool.hpp"

namespace rasterisers {
namespace {

using nlohmann::json;

constexpr double kMargin = 1.0 / 256;  // pixels: the grid to which rasterisers snap
constexpr int kFrame = 8;              // pixels of framebuffer around the viewport
constexpr int kPoints = 700;
constexpr double kReach = 2000;  // the farthest points in near distances

/// The picture that the camera file describes, its tile where it has a crop.
struct Frame {
  double x, y, width, height, pixelCenter, nearDepth, farDepth;
  bool fromBottom;

  explicit Frame(const CameraCase& c) {
    const json& v = c.camera["viewport"];
    const json& size = v.contains("crop") ? v["crop"] : v;
    x = v.contains("crop") ? 0 : v.value("x", 0.0);
    y = v.contains("crop") ? 0 : v.value("y", 0.0);
    width = size["width"];
    height = size["height"];
    pixelCenter = v.value("pixelCenter", 0.5);
    fromBottom = v.value("origin", "top-left") == "bottom-left";
    const json range = v.value("depthRange", json{0, 1});
    nearDepth = range[c.reverseZ ? 1 : 0];
    farDepth = range[c.reverseZ ? 0 : 1];
  }
};

/// Where a pixel less than a hundredth off would be the next one.
double besideBorder(Random& random, double pixel) {
  const double off = random.uniform(kMargin, 2.5 * kMargin);
  return std::round(pixel) + (random.coin() ? off : -off);
}

/// World points in the picture and around it, beyond near and far, and behind the eye.
std::vector<std::array<double, 3>> randomPoints(const CameraCase& c, const std::string& file, const Frame& frame) {
  Random random(static_cast<std::uint64_t>(c.index));
  const json& projection = c.camera["projection"];
  const double near = projection["near"], far = projection.value("far", kReach * near);
  std::vector<json> pixels;
  std::vector<bool> mirrored;
  for (int i = 0; i < kPoints; ++i) {
    const bool inPicture = i % 10 < 7;
    const double around = inPicture ? 0 : 0.6;
    double px = frame.x + frame.width * random.uniform(-around, 1 + around);
    double py = frame.y + frame.height * random.uniform(-around, 1 + around);
    if (i % 10 == 0) px = besideBorder(random, px);
    if (i % 10 == 1) py = besideBorder(random, py);
    double distance;
    if (c.orthographic) {
      const double depth = far - near;
      distance =
          inPicture || i % 10 == 9 ? random.uniform(near, far) : random.uniform(near - 0.3 * depth, far + 0.3 * depth);
    } else if (inPicture || i % 10 == 9) {
      distance = random.logUniform(near, std::min(far, kReach * near));
    } else {
      distance = i % 4 < 2 ? random.logUniform(near / 4, near) : random.logUniform(far / 2, far * 4);
    }
    pixels.push_back(
        {{"screen", {px + frame.pixelCenter - 0.5, py + frame.pixelCenter - 0.5}}, {"viewDistance", distance}});
    mirrored.push_back(!c.orthographic && i % 10 == 8 && i % 20 == 8);
  }
  std::vector<std::array<double, 3>> points;
  for (const json& ray : filter({"ray", "-c", file}, pixels)) {
    std::array<double, 3> point = ray["point"];
    const std::array<double, 3> eye = ray["origin"];
    if (mirrored[points.size()])
      for (std::size_t k = 0; k < 3; ++k) point[k] = 2 * eye[k] - point[k];
    points.push_back(point);
  }
  return points;
}

struct Written {
  Pipeline pipeline;
  std::array<double, 3> eye{};
};

std::vector<std::string> matrixArguments(const CameraCase& c, const std::string& file) {
  std::vector<std::string> arguments{"matrix",
                                     "-c",
                                     file,
                                     "--float",
                                     "--convention",
                                     c.preset,
                                     c.reverseZ != c.otherWay ? "--reverse-z" : "--no-reverse-z",
                                     "--which",
                                     c.product ? "viewProjection,projection" : "view,projection"};
  if (c.minusOneToOne) arguments.insert(arguments.end(), {"--ndc-z", "-1..1"});
  if (c.relativeToEye) arguments.push_back("--relative-to-eye");
  return arguments;
}

/// The numbers as they are pasted, and what the tool says about how they are meant.
Written readMatrices(const CameraCase& c, const std::string& file, Scene& scene) {
  std::vector<std::string> arguments = matrixArguments(c, file);
  const json stated = json::parse(tool::printed(arguments));
  arguments.insert(arguments.end(), {"--to", "flat"});
  std::istringstream lines(tool::printed(arguments));
  Matrix matrices[2];
  for (Matrix& m : matrices) {
    std::string line;
    REQUIRE(std::getline(lines, line));
    m = json::parse(line).get<Matrix>();
  }
  const json& convention = stated["convention"];
  Draw& draw = scene.draw;
  draw.rowVectors = convention["vectors"] == "row";
  draw.rowMajor = convention["storage"] == "row-major";
  draw.zeroToOne = convention["ndcZ"] == "0..1";
  draw.mirrored = c.mirrored;
  scene.upsideDown = (convention["ndcY"] == "up") != c.mirrored;
  Written written;
  Pipeline& p = written.pipeline;
  constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  draw.view = c.product ? identity : matrices[0];
  draw.projection = c.product ? matrices[0] : matrices[1];
  p.view = fromMemory(draw.view, draw.rowVectors, draw.rowMajor);
  p.projection = fromMemory(draw.projection, draw.rowVectors, draw.rowMajor);
  p.product = c.product;
  p.pointsRounded = c.relativeToEye;
  p.zeroToOne = draw.zeroToOne;
  if (c.relativeToEye) written.eye = stated["eye"];
  return written;
}

void placeViewport(Scene& scene, const Frame& frame, Pipeline& p) {
  Draw& draw = scene.draw;
  draw.viewportWidth = static_cast<int>(frame.width);
  draw.viewportHeight = static_cast<int>(frame.height);
  draw.width = static_cast<int>(frame.x) + draw.viewportWidth + 2 * kFrame;
  draw.height = static_cast<int>(frame.y) + draw.viewportHeight + 2 * kFrame;
  const double before = kFrame + frame.y;  // rows on the origin's side
  draw.x = kFrame + frame.x;
  draw.y = frame.fromBottom == scene.upsideDown ? before : draw.height - before - frame.height;
  const json range = scene.camera.camera["viewport"].value("depthRange", json{0, 1});
  for (std::size_t k = 0; k < 2; ++k) p.depthRange[k] = draw.depthRange[k] = range[k];
  p.x = draw.x;
  p.y = draw.y;
  p.width = frame.width;
  p.height = frame.height;
}

enum class Place { inside, outside, beside };

/// Where a point lies beyond any doubt.
Place placeOf(const Point& point, const CameraCase& c, const Frame& frame) {
  if (!c.orthographic) {
    if (point.viewDistance < -point.rounding.w) return Place::outside;
    if (point.viewDistance <= point.rounding.w) return Place::beside;
  }
  const double x = point.screen[0] + 0.5 - frame.pixelCenter - frame.x;
  const double y = point.screen[1] + 0.5 - frame.pixelCenter - frame.y;
  const double mx = std::max(kMargin, point.rounding.x), my = std::max(kMargin, point.rounding.y);
  const double range = frame.farDepth - frame.nearDepth;
  const double z = (point.depth - frame.nearDepth) / range, mz = point.rounding.depth / std::fabs(range);
  const double beyond[][2] = {{-x, mx}, {x - frame.width, mx}, {-y, my}, {y - frame.height, my}, {-z, mz}, {z - 1, mz}};
  Place place = Place::inside;
  for (const auto& [distance, margin] : beyond) {
    if (distance > margin) return Place::outside;
    if (distance >= -margin) place = Place::beside;
  }
  return place;
}

/// The pixel by its centre; false where another one is within the margin.
bool findPixel(Point& point, const Frame& frame, const Draw& draw) {
  const double x = point.screen[0] + 0.5 - frame.pixelCenter, y = point.screen[1] + 0.5 - frame.pixelCenter;
  for (double v : {x, y})
    if (std::fabs(v - std::round(v)) <= kMargin) return false;
  const int up = static_cast<int>(std::floor(y)) + kFrame;
  point.column = static_cast<int>(std::floor(x)) + kFrame;
  point.row = frame.fromBottom ? draw.height - 1 - up : up;
  return true;
}

}  // namespace

Scene prepare(const CameraCase& c) {
  INFO(c.name());
  const std::string file = c.camera.dump();
  const Frame frame(c);
  Scene scene;
  scene.camera = c;
  auto [pipeline, eye] = readMatrices(c, file, scene);
  placeViewport(scene, frame, pipeline);
  scene.draw.format = c.format;

  std::vector<json> records;
  std::vector<std::array<double, 3>> positions = randomPoints(c, file, frame);
  for (std::array<double, 3>& p : positions) {
    if (!c.relativeToEye)
      for (double& v : p) v = static_cast<double>(static_cast<float>(v));
    records.push_back(p);
  }
  const std::vector<json> results = filter(
      {"project", "-c", file, "--columns", "x,y,z", "--fields", "screen,depth,viewDistance,visible,outside"}, records);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const json& result = results[i];
    Point point;
    point.position = positions[i];
    std::array<double, 3> drawn;
    for (std::size_t k = 0; k < 3; ++k) {
      drawn[k] = positions[i][k] - eye[k];
      point.vertex[k] = static_cast<float>(drawn[k]);
    }
    point.rounding = roundingOf(drawn, pipeline);
    point.visible = result["visible"];
    if (result.contains("outside")) point.outside = result["outside"].get<std::vector<std::string>>();
    point.viewDistance = result["viewDistance"];
    if (!result["screen"].is_null()) {
      for (std::size_t k = 0; k < 2; ++k) point.screen[k] = result["screen"][k];
      point.depth = result["depth"];
    }
    if (placeOf(point, c, frame) == Place::beside) {
      ++scene.besideBoundary;
      continue;
    }
    if (point.visible && !findPixel(point, frame, scene.draw)) {
      ++scene.besideBorder;
      continue;
    }
    scene.points.push_back(point);
  }
  return scene;
}

}  // namespace rasterisers
