// OpenGL as the judge: it draws points with the matrices that the tool prints, and its framebuffer says what the tool
// says.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "catch.hpp"
#include "random.hpp"
#include "rasteriser.hpp"
#include "tool.hpp"

using namespace rasterisers;
using nlohmann::json;

namespace {

/// A camera file, and how its matrices are written and drawn.
struct CameraCase {
  int index = 0;
  json camera;
  std::string preset;  ///< the convention written
  bool reverseZ = false, infinite = false, orthographic = false;
  bool minusOneToOne = false;  ///< written so, whatever the preset has
  bool otherWay = false;       ///< the matrices have the other reverseZ than the file
  bool relativeToEye = false;  ///< float32 holds the points only so
  bool product = false;        ///< viewProjection in one matrix, else view and projection
  bool mirrored = false;
  DepthFormat format = DepthFormat::f32;

  std::string name() const {
    const bool writtenReversed = reverseZ != otherWay;
    return "camera " + std::to_string(index) + " as " + preset + (minusOneToOne ? ", -1..1" : "") +
           (writtenReversed ? ", reversed" : "") + (infinite ? ", infinite" : "") + ": " + camera.dump();
  }
};

constexpr int kCameras = 80;

struct Base {
  const char* camera;
  bool relativeToEye;
};

// As small as shows every way to describe a camera. Those on the Earth and in large numbers are drawn relative to the
// eye.
constexpr Base kBases[] = {
    {R"({"convention": "d3d", "position": [-2, 3, -4], "target": [1, 0.5, 2],
         "projection": {"type": "perspective", "fovX": 75, "near": 1, "far": 60},
         "viewport": {"width": 317, "height": 201, "x": 7, "y": 5}})",
     false},
    {R"({"convention": "d3d-rh", "position": [0.5, 1, 2], "direction": [1, -0.25, -2],
         "projection": {"type": "frustum", "left": -0.3, "right": 0.5, "bottom": -0.2, "top": 0.25, "near": 0.5, "far": 50},
         "viewport": {"width": 320, "height": 180}})",
     false},
    {R"({"convention": "metal", "position": [4, 1, 0], "target": [0, 2, 1],
         "projection": {"type": "perspective", "fovY": 45, "near": 1, "far": 200, "shift": [0.25, -0.5]},
         "viewport": {"width": 256, "height": 256, "origin": "bottom-left", "x": 3, "y": 9}})",
     false},
    {R"({"convention": "vulkan", "position": [1, 0.5, -1], "target": [3, 1, 4],
         "projection": {"type": "perspective", "fovY": 40, "near": 2, "far": 90},
         "viewport": {"width": 960, "height": 540, "crop": {"x": 600, "y": 90, "width": 200, "height": 160}}})",
     false},
    {R"({"convention": "opengl", "position": [2, 3, 4], "target": [0, 0, 1],
         "projection": {"type": "orthographic", "left": -6, "right": 10, "bottom": -5, "top": 3, "near": -5, "far": 20},
         "viewport": {"width": 320, "height": 160}})",
     false},
    {R"({"convention": "d3d", "position": [1, 1, -7], "direction": [1, -1, 3],
         "projection": {"type": "orthographic", "width": 12, "height": 9, "near": 1, "far": 30, "shift": [-0.3, 0.1]},
         "viewport": {"width": 240, "height": 180, "depthRange": [0.1, 0.7]}})",
     false},
    {R"({"convention": "opencv", "cameraFromWorld": [[0.8, 0, -0.6, 0.5], [0, 1, 0, -1], [0.6, 0, 0.8, 2], [0, 0, 0, 1]],
         "projection": {"type": "intrinsics", "fx": 280, "fy": 250, "cx": 148.25, "cy": 131, "near": 0.5, "far": 40},
         "viewport": {"width": 320, "height": 240, "pixelCenter": 0}})",
     false},
    {R"({"convention": "opengl", "position": {"lat": 45.98333, "lon": 7.785, "height": 3185}, "heading": 198, "pitch": -4, "roll": 2,
         "projection": {"type": "perspective", "fovX": 70, "near": 1, "far": 30000},
         "viewport": {"width": 320, "height": 240}})",
     true},
    {R"({"convention": "unreal", "position": [637813700.25, -41231.5, 120000.125], "rotation": [0.1, -0.3, 0.5, 0.8], "cameraAxes": "FRU",
         "projection": {"type": "perspective", "fovX": 90, "near": 10, "far": 500000},
         "viewport": {"width": 320, "height": 180}})",
     true},
    {R"({"convention": "unity", "position": [2, 1, -3], "target": [0, 1, 0],
         "projection": {"type": "perspective", "fovDiagonal": 80, "near": 1, "far": 70},
         "viewport": {"width": 320, "height": 240, "depthRange": [1, 0]}})",
     false},
};
constexpr int kBaseCount = static_cast<int>(std::size(kBases));

constexpr const char* kPresets[] = {"opengl", "opengl-lh", "d3d",    "d3d-rh", "vulkan", "metal",
                                    "webgpu", "unity",     "unreal", "opencv", "ps2"};
constexpr int kPresetCount = static_cast<int>(std::size(kPresets));

CameraCase cameraCase(int index) {
  // The counts of bases and presets have no common factor, so every pair comes up in time.
  const Base& base = kBases[index % kBaseCount];
  const int round = index / kPresetCount;
  CameraCase c;
  c.index = index;
  c.camera = json::parse(base.camera);
  c.preset = kPresets[index % kPresetCount];
  c.orthographic = c.camera["projection"]["type"] == "orthographic";
  c.reverseZ = round % 2 == 1;
  c.infinite = round / 2 % 2 == 1 && !c.orthographic;
  c.minusOneToOne = index % 9 < 2;
  c.otherWay = index % 7 == 5;
  c.relativeToEye = base.relativeToEye;
  c.product = index % 4 >= 2;
  c.mirrored = (index + round) % 2 == 1;
  constexpr DepthFormat formats[] = {DepthFormat::f32, DepthFormat::d24, DepthFormat::f32, DepthFormat::d16,
                                     DepthFormat::f32};
  c.format = formats[index % 5];
  c.camera["convention"] = {{"preset", c.camera["convention"]}, {"reverseZ", c.reverseZ}};
  if (c.infinite) c.camera["projection"].erase("far");
  return c;
}

/// Unit roundoff of float32.
constexpr double kUnit = 0x1p-24;

/// A matrix for column vectors, whatever the memory held.
using Mat = std::array<std::array<double, 4>, 4>;

struct Pipeline {
  Mat view, projection;
  bool product = false;        ///< view is the identity, which rounds nothing
  bool pointsRounded = false;  ///< the points were rounded to float32
  bool zeroToOne = false;
  double x = 0, y = 0, width = 0, height = 0;  ///< of the viewport
  double depthRange[2] = {0, 1};
};

/// Bounds of the errors: of window x and y in pixels, of window depth before it is stored, of clip w.
struct Rounding {
  double x = 0, y = 0, depth = 0, w = 0;
};

using Vec = std::array<double, 4>;

/// A vector and a bound of its error, componentwise.
struct Inexact {
  Vec value{}, error{};
};

// Each entry of the matrix is rounded once; a dot product of four terms rounds each term at most four times, in
// whatever order it is summed and with or without fused operations.
Inexact times(const Mat& m, const Inexact& v) {
  Inexact out;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double magnitude = std::fabs(m[i][j] * v.value[j]);
      out.value[i] += m[i][j] * v.value[j];
      out.error[i] += std::fabs(m[i][j]) * v.error[j] + 5 * kUnit * magnitude;
    }
  return out;
}

Mat fromMemory(const Matrix& memory, bool rowVectors, bool rowMajor) {
  Mat m{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      m[i][j] = static_cast<double>(memory[rowVectors == rowMajor ? 4 * j + i : 4 * i + j]);
  return m;
}

/// Of a point with w > 0; only w counts where it is not.
Rounding roundingOf(const std::array<double, 3>& point, const Pipeline& p) {
  Inexact v{{point[0], point[1], point[2], 1}, {}};
  if (p.pointsRounded)
    for (std::size_t i = 0; i < 3; ++i) v.error[i] = kUnit * std::fabs(point[i]);
  if (!p.product) v = times(p.view, v);
  const Inexact clip = times(p.projection, v);
  const Vec& error = clip.error;

  // NDC is one quotient, or a reciprocal and a product: two roundings. The window is NDC * scale + offset: two more.
  const double w = clip.value[3];
  const auto window = [&](std::size_t axis, double scale, double offset) {
    const double ndc = clip.value[axis] / w;
    const double ndcError = (error[axis] + std::fabs(ndc) * error[3]) / w + 2 * kUnit * std::fabs(ndc);
    return std::fabs(scale) * ndcError + kUnit * (std::fabs(scale * ndc) + std::fabs(scale * ndc + offset));
  };
  const double near = p.depthRange[0], far = p.depthRange[1];
  const double depthScale = p.zeroToOne ? far - near : (far - near) / 2;
  const double depthOffset = p.zeroToOne ? near : (far + near) / 2;
  // The depth range is rounded as well, and so are its difference and its sum; 0 and 1 stay as they are.
  const bool plain = std::fabs(far - near) == 1;
  const double rangeError = plain ? 0 : 2 * kUnit * (std::fabs(near) + std::fabs(far));
  // What is of second order lies far below a thousandth.
  constexpr double secondOrder = 1.001;
  return {secondOrder * window(0, p.width / 2, p.x + p.width / 2),
          secondOrder * window(1, p.height / 2, p.y + p.height / 2),
          secondOrder * (window(2, depthScale, depthOffset) + rangeError), secondOrder * error[3]};
}

/// What storing may add: one step. OpenGL 4.5, 2.3.5 and Vulkan 1.3, "Conversion from Floating-Point to Normalized
/// Fixed-Point": one of the two nearest numbers.
double storageStep(DepthFormat format) {
  if (format == DepthFormat::f32) return 0;
  return format == DepthFormat::d24 ? 1 / 16777215.0 : 1 / 65535.0;
}

struct Point {
  std::array<double, 3> position;
  Vertex vertex;  ///< what is drawn of it
  bool visible = false;
  double screen[2] = {0, 0};
  double depth = 0, viewDistance = 0;
  std::vector<std::string> outside;
  Rounding rounding;
  int column = 0, row = 0;  ///< its pixel, from the framebuffer's upper left corner; where visible
};

struct Scene {
  CameraCase camera;
  Draw draw;                  ///< but for the points
  bool upsideDown = false;    ///< the picture's first row in memory is its lowest
  std::vector<Point> points;  ///< that are judged
  int besideBorder = 0;       ///< points left out: within 1/256 pixel of their pixel's border
  int besideBoundary =
      0;  ///< points left out: within 1/256 pixel, or what float32 leaves open, of being clipped or not
};

struct Judgement {
  int visible = 0;
  int misplaced = 0, wronglyDeep = 0;  ///< of the visible
  int appeared = 0;                    ///< of the clipped
  double worstPixels = 0;              ///< what float32 may move a point by, the largest
  std::vector<std::string> words;      ///< about the first disagreements

  int disagreements() const { return misplaced + wronglyDeep + appeared; }
};

/// What the tool makes of them: one JSON value in, one out.
std::vector<json> filter(const std::vector<std::string>& arguments, const std::vector<json>& records) {
  std::string line;
  for (const std::string& argument : arguments) line += tool::quoted(argument) + " ";
  line += "<<'END'\n";
  for (const json& record : records) line += record.dump() + "\n";
  std::istringstream output(tool::printed(line + "END\n"));
  std::vector<json> results;
  while (std::getline(output, line)) results.push_back(json::parse(line));
  REQUIRE(results.size() == records.size());
  return results;
}

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

/// Asks the tool. The points are random, by the camera's index.
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

/// Draws the scene.
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
