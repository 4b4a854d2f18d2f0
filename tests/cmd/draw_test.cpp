// Pictures of random scenes, taken apart: every mark lies where `project` says, by the picture's own frame.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <sstream>

#include "catch.hpp"
#include "tool.hpp"

namespace {

using nlohmann::json;

struct Point {
  double x = 0, y = 0;
};

struct Element {
  std::string kind, name, title;  ///< the class, what stands before the title's colon, and what behind it
  std::vector<Point> points;
};

struct Label {
  std::string words;
  double left = 0, right = 0, middle = 0;
};

double attribute(const std::string& element, const std::string& name) {
  std::smatch match;
  REQUIRE(std::regex_search(element, match, std::regex(" " + name + "=\"([^\"]*)\"")));
  return std::stod(match[1]);
}

std::vector<Point> pointsOfPath(const std::string& path) {
  std::vector<Point> points;
  std::string numbers = path;
  for (char& c : numbers)
    if (c == 'M' || c == 'L' || c == 'z') c = ' ';
  std::istringstream in(numbers);
  for (Point p; in >> p.x >> p.y;) points.push_back(p);
  return points;
}

/// What the test reads of a picture.
struct Drawn {
  double left = 0, top = 0, width = 0, height = 0;
  std::vector<Element> elements;
  std::vector<Label> labels;
  int withoutRoom = 0;

  const Element* find(const std::string& name) const {
    const Element* found = nullptr;
    for (const Element& element : elements)
      if (element.name == name) {
        CHECK(!found);
        found = &element;
      }
    return found;
  }
};

Drawn readPicture(const std::string& svg) {
  Drawn drawn;
  std::istringstream in(svg);
  const std::regex titled("<(circle|path) class=\"([^\"]*)\".*<title>([^:<]*)(?:: )?([^<]*)</title>");
  const std::regex path(" d=\"([^\"]*)\""), label("<text.*class=\"label.*>([^<]*)</text>");
  const std::regex more("\\+([0-9]+) more without");
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (line.find("class=\"frame\"") != std::string::npos) {
      drawn.left = attribute(line, "x");
      drawn.top = attribute(line, "y");
      drawn.width = attribute(line, "width");
      drawn.height = attribute(line, "height");
    } else if (std::regex_search(line, match, titled)) {
      Element element{match[2], match[3], match[4], {}};
      if (match[1] == "circle")
        element.points = {{attribute(line, "cx"), attribute(line, "cy")}};
      else if (std::smatch d; std::regex_search(line, d, path))
        element.points = pointsOfPath(d[1]);
      drawn.elements.push_back(element);
    } else if (std::regex_search(line, match, label)) {
      Label found{match[1]};
      // Digits, the narrowest that a sans-serif face has.
      const double width = 0.55 * 13 * static_cast<double>(found.words.size()), x = attribute(line, "x");
      const bool middle = line.find("\"middle\"") != std::string::npos, end = line.find("\"end\"") != std::string::npos;
      found.left = middle ? x - width / 2 : end ? x - width : x;
      found.right = found.left + width;
      found.middle = attribute(line, "y");
      drawn.labels.push_back(found);
    } else if (std::regex_search(line, match, more)) {
      drawn.withoutRoom = std::stoi(match[1]);
    }
  }
  return drawn;
}

/// Viewport numbers to the sheet, as the interface defines pixels.
struct PixelsToSheet {
  const Drawn& drawn;
  json viewport;

  Point operator()(double x, double y) const {
    const double halfPixel = viewport["pixelCenter"].get<double>() - 0.5;
    const double right = (x - viewport["x"].get<double>() - halfPixel) / viewport["width"].get<double>();
    double down = (y - viewport["y"].get<double>() - halfPixel) / viewport["height"].get<double>();
    if (viewport["origin"] == "bottom-left") down = 1 - down;
    return {drawn.left + right * drawn.width, drawn.top + down * drawn.height};
  }
};

/// Half of the last digit that is written.
constexpr double kRounding = 0.00501;

bool isNear(const Point& a, const Point& b) {
  return std::fabs(a.x - b.x) < kRounding && std::fabs(a.y - b.y) < kRounding;
}

struct Tally {
  int visible = 0, beyond = 0, aside = 0, behind = 0, segments = 0, dropped = 0, spheres = 0;
};

class Trial {
 public:
  explicit Trial(unsigned seed, const std::string& origin, double pixelCenter) : random_(seed) {
    const bool portrait = uniform(0, 1) < 0.3;
    const double width = std::floor(std::exp(uniform(std::log(40), std::log(8000))));
    camera_ = {{"position", point(3)}, {"target", point(3)}};
    viewport_ = {{"width", width},
                 {"height", std::ceil(width * (portrait ? 1.7 : 0.6))},
                 {"x", std::floor(uniform(-500, 3000))},
                 {"y", std::floor(uniform(-500, 3000))},
                 {"origin", origin},
                 {"pixelCenter", pixelCenter}};
    camera_["viewport"] = viewport_;
    if (uniform(0, 1) < 0.25)
      camera_["projection"] = {{"type", "orthographic"},
                               {"width", 12},
                               {"near", -2},
                               {"far", 9},
                               {"height", 12 * std::ceil(width * (portrait ? 1.7 : 0.6)) / width}};
    else
      camera_["projection"] = {{"type", "perspective"}, {"fovY", uniform(20, 100)}, {"near", 0.3}, {"far", 12}};
    for (int i = 0; i < 60; ++i) records_.push_back({{"id", 100 + i}, {"position", point(8)}});
    for (int i = 0; i < 6; ++i) records_.push_back({{"id", 500 + i}, {"segment", {point(8), point(8)}}});
  }

  void check(Tally& tally) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "viewproj-draw-test";
    std::filesystem::create_directories(folder);
    const std::string camera = (folder / "camera.json").string(), points = (folder / "points.ndjson").string();
    std::ofstream(camera) << camera_;
    std::ofstream out(points);
    for (const json& record : records_) out << record << "\n";
    out.close();
    const Drawn drawn = readPicture(tool::printed("draw -c " + camera + " " + points));
    CHECK(drawn.width / drawn.height ==
          Approx(viewport_["width"].get<double>() / viewport_["height"].get<double>()).epsilon(3e-5));
    std::istringstream results(
        tool::printed("project --fields screen,visible,outside,view -c " + camera + " " + points));
    std::size_t count = 0;
    for (std::string line; std::getline(results, line); ++count) checkRecord(json::parse(line), drawn, tally);
    CHECK(count == records_.size());
    checkLabels(drawn, tally);
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  json point(double reach) { return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)}; }

  void checkRecord(const json& result, const Drawn& drawn, Tally& tally) {
    INFO(result.dump());
    const PixelsToSheet toSheet{drawn, viewport_};
    const Element* element = drawn.find(std::to_string(result["id"].get<int>()));
    if (result.contains("segment")) {
      REQUIRE((element != nullptr) == result["visible"].get<bool>());
      if (!element) return;
      ++tally.segments;
      REQUIRE(element->points.size() == 2);
      const json &start = result["start"]["screen"], &end = result["end"]["screen"];
      CHECK(isNear(element->points[0], toSheet(start[0], start[1])));
      CHECK(isNear(element->points[1], toSheet(end[0], end[1])));
      return;
    }
    REQUIRE(element);
    if (result["screen"].is_null()) {
      ++tally.behind;
      CHECK(element->kind == "away behind");
      CHECK(element->title == "behind the eye");
      const Point tip = element->points[0];
      checkTip(tip, drawn);
      // x right and y up in view space, as pixels are square.
      checkWay(tip, {result["view"][0], -result["view"][1].get<double>()}, drawn);
      return;
    }
    const double x = result["screen"][0], y = result["screen"][1];
    std::istringstream title(element->title.substr(7));
    double shownX = NAN, shownY = NAN;
    title >> shownX >> shownY;
    CHECK(element->title.starts_with("screen "));
    CHECK(shownX == x);
    CHECK(shownY == y);
    const Point at = toSheet(x, y);
    bool aside = false;
    if (!result["visible"])
      for (const json& side : result["outside"]) aside |= side != "near" && side != "far";
    if (!aside) {
      ++(result["visible"] ? tally.visible : tally.beyond);
      CHECK(element->kind == (result["visible"] ? "point" : "point beyond"));
      REQUIRE(element->points.size() == 1);
      CHECK(isNear(element->points[0], at));
      return;
    }
    ++tally.aside;
    CHECK(element->kind == "away");
    const Point tip = element->points[0];
    checkTip(tip, drawn);
    checkWay(tip, {at.x - drawn.left - drawn.width / 2, at.y - drawn.top - drawn.height / 2}, drawn);
  }

  /// The tip lies that way from the middle.
  static void checkWay(const Point& tip, const Point& way, const Drawn& drawn) {
    const double x = tip.x - drawn.left - drawn.width / 2, y = tip.y - drawn.top - drawn.height / 2;
    CHECK(std::fabs(way.x * y - way.y * x) <= (2 * kRounding + 3e-5 * drawn.width) * std::hypot(way.x, way.y));
    CHECK(way.x * x + way.y * y > 0);
  }

  static void checkTip(const Point& tip, const Drawn& drawn) {
    const double right = drawn.left + drawn.width, bottom = drawn.top + drawn.height;
    CHECK(tip.x >= drawn.left - kRounding);
    CHECK(tip.x <= right + kRounding);
    CHECK(tip.y >= drawn.top - kRounding);
    CHECK(tip.y <= bottom + kRounding);
    const double nearest =
        std::min(std::min(tip.x - drawn.left, right - tip.x), std::min(tip.y - drawn.top, bottom - tip.y));
    CHECK(std::fabs(nearest) < kRounding);
  }

  void checkLabels(const Drawn& drawn, Tally& tally) {
    CHECK(drawn.labels.size() + static_cast<std::size_t>(drawn.withoutRoom) == drawn.elements.size());
    tally.dropped += drawn.withoutRoom;
    for (std::size_t i = 0; i < drawn.labels.size(); ++i) {
      const Label& a = drawn.labels[i];
      CHECK(a.left >= drawn.left);
      CHECK(a.right <= drawn.left + drawn.width);
      for (std::size_t j = 0; j < i; ++j) {
        const Label& b = drawn.labels[j];
        INFO(a.words << " and " << b.words);
        const bool overlap =
            std::min(a.right, b.right) > std::max(a.left, b.left) && std::fabs(a.middle - b.middle) < 13;
        CHECK(!overlap);
      }
      // The marks of others are not covered.
      for (const Element& element : drawn.elements) {
        if (!element.kind.starts_with("point")) continue;
        const Point p = element.points[0];
        const bool covered = p.x > a.left && p.x < a.right && p.y > a.middle - 11 && p.y < a.middle + 2;
        CHECK(!covered);
      }
    }
  }

  std::mt19937_64 random_;
  json camera_, viewport_, records_ = json::array();
};

}  // namespace

TEST_CASE("every mark of a picture lies where project says, in every origin and pixelCenter, and no label on another") {
  Tally tally;
  unsigned seed = 0;
  for (const char* origin : {"top-left", "bottom-left"})
    for (double pixelCenter : {0.5, 0.0, 0.25})
      for (int i = 0; i < 8; ++i, ++seed) {
        INFO("trial " << seed);
        Trial(seed, origin, pixelCenter).check(tally);
      }
  CHECK(tally.visible > 100);
  CHECK(tally.beyond > 20);
  CHECK(tally.aside > 100);
  CHECK(tally.behind > 100);
  CHECK(tally.segments > 20);
  CHECK(tally.dropped > 20);
}

TEST_CASE("the outline of a sphere is where the rays of its pixels touch it, between and at its corners") {
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int outlines = 0, cut = 0;
  for (int trial = 0; trial < 40; ++trial) {
    INFO("trial " << trial);
    // Eye at the origin, looking along -z: the ray of a pixel is written down at once.
    const double focal = std::exp(uniform(std::log(150), std::log(1500)));
    const double z = -std::exp(uniform(0, 3)), x = uniform(-1, 1) * z * 300 / focal,
                 y = uniform(-1, 1) * z * 200 / focal;
    const double distance = std::hypot(x, y, z), radius = distance * std::exp(uniform(-4, -0.2));
    std::ostringstream camera, scene;
    camera.precision(17);
    scene.precision(17);
    camera
        << R"({"position":[0,0,0],"target":[0,0,-1],"viewport":{"width":800,"height":600},"projection":{"type":"intrinsics",)"
        << "\"cx\":400,\"cy\":300,\"fx\":" << focal << ",\"fy\":" << focal << ",\"near\":1e-6}}";
    scene << R"({"objects":[{"id":"ball","sphere":{"center":[)" << x << "," << y << "," << z
          << "],\"radius\":" << radius << "}}]}";
    const Drawn drawn = readPicture(tool::printed("draw -c '" + camera.str() + "' --scene '" + scene.str() + "'"));
    const Element* ball = drawn.find("ball");
    if (!ball) continue;
    ++outlines;
    const double toPixels = 800 / drawn.width;
    const auto offBy = [&](const Point& p) {
      const double h = ((p.x - drawn.left) * toPixels - 400) / focal,
                   v = (300 - (p.y - drawn.top) * 600 / drawn.height) / focal;
      const double angle = std::atan2(std::hypot(y * -1 - z * v, z * h - x * -1, x * v - y * h), x * h + y * v - z);
      // A pixel is at most 1 / focal radians.
      return std::fabs(angle - std::asin(radius / distance)) * focal;
    };
    for (std::size_t i = 0; i < ball->points.size(); ++i) {
      const Point a = ball->points[i];
      const bool atBorder = std::min(std::min(a.x - drawn.left, drawn.left + drawn.width - a.x),
                                     std::min(a.y - drawn.top, drawn.top + drawn.height - a.y)) < 0.02;
      cut += atBorder;
      // The rounding of a coordinate, and where the border cuts a chord what it lies within the circle.
      const double chord = 6e-5 * 800;
      CHECK(offBy(a) <= 2 * kRounding * toPixels + (atBorder ? chord : 0));
      if (i == 0) continue;
      const Point b = ball->points[i - 1];
      if (std::hypot(a.x - b.x, a.y - b.y) < 30)
        CHECK(offBy({(a.x + b.x) / 2, (a.y + b.y) / 2}) <= 2 * kRounding * toPixels + chord);
    }
  }
  CHECK(outlines > 25);
  CHECK(cut > 5);
}
