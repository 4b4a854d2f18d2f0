// Every line of an explanation, recomputed from the lines above it as printed.
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "tool.hpp"

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

json run(const std::vector<std::string>& arguments) { return json::parse(tool::printed(arguments)); }

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Tally {
  int sums = 0, quotients = 0, roots = 0, cancelling = 0, zeros = 0, behind = 0, noFar = 0, rows = 0, exchanged = 0;
};

/// Numbers by name, as printed.
class Printed {
 public:
  double operator[](const std::string& name) const {
    if (name == "1") return 1;
    if (name == "-1") return -1;
    INFO(name);
    REQUIRE(values_.count(name) == 1);
    return values_.at(name);
  }
  bool has(const std::string& name) const { return values_.count(name) == 1; }
  void add(const std::string& name, const json& value) {
    INFO(name);
    REQUIRE(value.is_number());
    values_[name] = value.get<double>();
  }

 private:
  std::map<std::string, double> values_;
};

/// printed: relative error of a printed number. A term of two has twice that; agreed: what a line must agree to.
Printed recompute(const json& explanation, double printed, double agreed, Tally& tally) {
  Printed values;
  for (const json& stage : explanation["stages"]) {
    if (stage.contains("matrices"))
      for (const auto& [name, rows] : stage["matrices"].items())
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < 4; ++j)
            values.add(name + "[" + std::to_string(i) + "][" + std::to_string(j) + "]", rows[i][j]);
    for (const json& line : stage["lines"]) {
      const std::string name = line["name"];
      INFO(line.dump());
      values.add(name, line["value"]);
      const double value = values[name];
      if (line.contains("quotient")) {
        ++tally.quotients;
        const double got = values[line["quotient"][0]] / values[line["quotient"][1]];
        CHECK(std::fabs(got - value) <= agreed * std::fabs(value));
      }
      for (const char* kind : {"sum", "rootOfSum"}) {
        if (!line.contains(kind)) continue;
        double got = 0, sizes = 0;
        for (const json& term : line[kind]) {
          double product = 1;
          for (const json& factor : term) product *= values[factor];
          got += product;
          sizes += std::fabs(product);
        }
        if (kind == std::string("rootOfSum")) {
          ++tally.roots;
          CHECK(std::fabs(std::sqrt(got) - value) <= agreed * value);
          continue;
        }
        ++tally.sums;
        CHECK(std::fabs(got - value) <= 3 * printed * sizes);
        if (!line.contains("cancels")) {
          CHECK(std::fabs(got - value) <= agreed * std::fabs(value));
        } else if (line["cancels"].is_number()) {
          ++tally.cancelling;
          CHECK(sizes >= 9.9 * std::fabs(value));
          CHECK(std::fabs(std::log10(sizes / std::fabs(value)) - 0.5 - line["cancels"].get<double>()) <= 0.51);
        } else {
          ++tally.zeros;
          CHECK(value == 0);
          CHECK(line["cancels"] == "to 0");
        }
      }
    }
  }
  return values;
}

/// Nine digits are off by 5e-9, of numbers that begin with 1: lines agree to seven.
constexpr double kNineDigits = 5e-9, kSeven = 1.1e-7;
/// Doubles: three roundings, where as much as a digit cancels without being called so.
constexpr double kDouble = 0x1.01p-53, kDoubleAgreed = 4e-15;

bool sameMatrix(const Printed& values, const std::string& name, const json& rows) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      if (values[name + "[" + std::to_string(i) + "][" + std::to_string(j) + "]"] != rows[i][j].get<double>())
        return false;
  return true;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string listed(const std::vector<double>& values) {
  std::string out;
  for (double value : values) out += (out.empty() ? "" : ",") + number(value);
  return out;
}

/// A point as it is typed: with a camera on the Earth three numbers alone are none.
std::string typed(const std::vector<double>& point) {
  if (point.size() == 4) return listed(point);
  std::string out;
  for (std::size_t i = 0; i < point.size(); ++i)
    out += (i > 0 ? "," : "") + std::string(1, "xyz"[i]) + "=" + number(point[i]);
  return out;
}

struct Case {
  std::string name;
  std::vector<std::string> camera;
};

std::vector<Case> cameras() {
  std::vector<Case> cases;
  for (const auto& entry : std::filesystem::directory_iterator(VIEWPROJ_SAMPLES))
    if (std::filesystem::exists(entry.path() / "camera.json"))
      cases.push_back({entry.path().filename(), {"-c", entry.path() / "camera.json"}});
  REQUIRE(cases.size() >= 10);
  const auto inlined = [&](const char* name, const char* text) { cases.push_back({name, {"-c", text}}); };
  inlined("orthographic", R"({"position": [5, 4, 3], "target": [0, 1, 0], "projection": {"type": "orthographic",
    "left": -3, "right": 5, "bottom": -1, "top": 3, "near": -2, "far": 30},
    "viewport": {"width": 400, "height": 200, "x": 7, "y": 9, "pixelCenter": 0, "depthRange": [0.25, 0.75]}})");
  inlined("a view matrix of twelve digits", R"({"cameraFromWorld": [[0.6, 0, -0.8, 1234567.25],
    [0.48, 0.8, 0.36, -7654321.5], [0.64, -0.6, 0.48, 3333333.125], [0, 0, 0, 1]], "convention": "opencv",
    "cameraAxes": "RDF", "projection": {"type": "intrinsics", "fx": 500, "fy": 510, "cx": 300, "cy": 250,
    "near": 0.5, "far": 1e15}, "viewport": {"width": 640, "height": 480, "crop": {"x": 100, "y": 50, "width": 320,
    "height": 200}}})");
  inlined("the other depth", R"({"position": [1, 2, 3], "direction": [1, 1, 1], "convention": {"preset": "unity",
    "reverseZ": true}, "projection": {"type": "frustum", "left": -0.1, "right": 0.3, "bottom": -0.1, "top": 0.1,
    "near": 0.25, "far": 100}, "viewport": {"width": 800, "height": 400, "origin": "bottom-left"}})");
  return cases;
}

const std::vector<std::vector<std::string>> kWritten = {
    {},
    {"--convention", "opengl"},
    {"--convention", "d3d"},
    {"--convention", "vulkan", "--reverse-z"},
    {"--convention", "opencv"},
    {"--convention", "unreal"},
    {"--convention", "unreal", "--no-reverse-z", "--ndc-z", "-1..1"},
    {"--convention", "ps2"},
    {"--convention", "unity", "--reverse-z"},
};

}  // namespace

TEST_CASE("Every line of a point's way follows from those printed above it, and the last is what project gives") {
  Tally tally;
  for (const Case& c : cameras()) {
    const json start = run(joined(joined({"explain"}, c.camera), {"--pixel", "0,0", "--digits", "17", "--to", "json"}));
    const std::vector<double> origin = start["result"]["origin"], direction = start["result"]["direction"];
    // Before and behind the eye, near and far, beside the middle, weighted, and directions.
    std::vector<std::vector<double>> points;
    for (double along : {0.3, 7.0, 1e4, -2.0}) {
      std::vector<double> point;
      for (std::size_t i = 0; i < 3; ++i) point.push_back(origin[i] + along * (direction[i] + 0.01 * double(i)));
      points.push_back(point);
      if (along == 7) points.push_back({point[0] * 3, point[1] * 3, point[2] * 3, 3});
    }
    for (double sign : {1.0, -1.0})
      points.push_back({sign * direction[0], sign * direction[1] + 0.01, sign * direction[2], 0});
    for (const auto& written : kWritten) {
      const std::vector<std::string> which = joined(c.camera, written);
      const json matrices = run(joined({"matrix"}, which));
      std::vector<std::string> project =
          joined(joined({"project"}, which),
                 {"--to", "json", "--fields", "screen,depth,viewDistance,visible,outside,ndc,view"});
      for (const auto& point : points) project = joined(project, {"--point", typed(point)});
      const json all = run(project);
      for (std::size_t i = 0; i < points.size(); ++i) {
        INFO(c.name << (written.empty() ? "" : " in " + written[1]) << ", point " << listed(points[i]));
        const std::vector<std::string> question =
            joined(joined({"explain"}, which), {"--point", typed(points[i]), "--to", "json"});
        const json brief = run(question);
        recompute(brief, kNineDigits, kSeven, tally);

        const json whole = run(joined(question, {"--digits", "17"}));
        const Printed values = recompute(whole, kDouble, kDoubleAgreed, tally);
        const json& projected = all[i];
        json result = whole["result"];
        if (!result.contains("outside")) result["outside"] = json::array();
        for (const char* field : {"screen", "depth", "viewDistance", "visible", "outside"})
          CHECK(result[field] == projected[field]);
        if (!projected["screen"].is_null()) {
          CHECK(values["screen.x"] == projected["screen"][0].get<double>());
          CHECK(values["screen.y"] == projected["screen"][1].get<double>());
          CHECK(values["depth"] == projected["depth"].get<double>());
          CHECK(values["ndc.z"] == projected["ndc"][2].get<double>());
          // Inside by the inequalities is visible, and outside the sides it is outside of.
          for (const char* side : {"left", "right", "bottom", "top", "near", "far"}) {
            const std::string margin = std::string("margin.") + side;
            const json& sides = projected["outside"];
            const bool outside = std::find(sides.begin(), sides.end(), side) != sides.end();
            tally.noFar += !values.has(margin);
            CHECK((values.has(margin) && values[margin] < 0) == outside);
          }
        } else {
          ++tally.behind;
        }
        CHECK(values["view.x"] == projected["view"][0].get<double>());

        CHECK(sameMatrix(values, "V", matrices["view"]));
        CHECK(sameMatrix(values, "P", matrices["projection"]));
        if (!projected["screen"].is_null()) CHECK(sameMatrix(values, "S", matrices["viewport"]));
        const bool byRows = matrices["convention"]["vectors"] == "row";
        tally.rows += byRows;
        tally.exchanged += values.has("depth.written");
        for (const json& stage : whole["stages"])
          if (stage["name"] == "clip")
            CHECK(stage["lines"][3]["remark"].get<std::string>().find(byRows ? "fourth column" : "fourth row") !=
                  std::string::npos);
      }
    }
  }
  CAPTURE(tally.sums, tally.quotients, tally.cancelling, tally.zeros, tally.behind, tally.noFar, tally.rows);
  CHECK(tally.sums > 10000);
  CHECK(tally.quotients > 1000);
  CHECK(tally.cancelling > 300);
  CHECK(std::min({tally.behind, tally.noFar, tally.rows, tally.exchanged}) > 50);
}

TEST_CASE("Every line of a pixel's way back follows from those printed above it, and the last is what ray gives") {
  Tally tally;
  for (const Case& c : cameras()) {
    const json camera = run(joined({"explain"}, joined(c.camera, {"--pixel", "0,0", "--to", "json"})));
    const bool isConsole = c.name.find("ps2") != std::string::npos;
    const double depths[] = {isConsole ? 16000000.0 : 0.3, isConsole ? 100.0 : 0.7};
    for (const auto& written : kWritten)
      for (const std::string& pixel :
           {std::string("10.5,20"), "300,100.25," + number(depths[0]), "2000,1500," + number(depths[1])}) {
        const std::vector<std::string> options = joined(c.camera, {"--pixel", pixel});
        INFO(c.name << (written.empty() ? "" : " in " + written[1]) << ", pixel " << pixel);
        const std::vector<std::string> question = joined(joined({"explain", "--to", "json"}, options), written);
        recompute(run(question), kNineDigits, kSeven, tally);
        const json whole = run(joined(question, {"--digits", "17"}));
        const Printed values = recompute(whole, kDouble, kDoubleAgreed, tally);
        const json ray = run(joined({"ray"}, options));
        for (const char* field : {"origin", "direction", "point"}) {
          CHECK(whole["result"].contains(field) == ray.contains(field));
          if (ray.contains(field)) CHECK(whole["result"][field] == ray[field]);
          if (ray.contains(field)) CHECK(values[field + std::string(".z")] == ray[field][2].get<double>());
        }
      }
  }
  CAPTURE(tally.sums, tally.quotients, tally.roots, tally.cancelling);
  CHECK(std::min({tally.sums, tally.quotients, tally.roots}) > 400);
  CHECK(tally.cancelling > 30);
}

TEST_CASE("With a model matrix the way begins at the model's own coordinates") {
  Tally tally;
  const std::string camera = VIEWPROJ_SAMPLES "/picking-a-pixel/camera.json";
  const char* models[] = {"[[0,-2,0,1],[2,0,0,0.3],[0,0,3,-1],[0,0,0,1]]",
                          "{\"translation\":[1,0.3,-1],\"rotation\":[0.1,0.2,-0.3,0.9],\"scale\":[2,0.5,-3]}",
                          "{\"matrix\":[0,2,0,0, -2,0,0,0, 0,0,3,0, 1,0.3,-1,1]}"};
  std::vector<json> worlds;
  for (const char* model : models)
    for (const char* point : {"0.1,0.2,0.3", "0.1,0.2,0.3,2", "0.1,0.2,0.3,0"})
      for (const char* convention : {"opengl", "d3d"}) {
        INFO(model << " " << point << " " << convention);
        const std::vector<std::string> question = {"explain", "-c",   camera, "--point",      point,     "--model",
                                                   model,     "--to", "json", "--convention", convention};
        recompute(run(question), kNineDigits, kSeven, tally);
        const json whole = run(joined(question, {"--digits", "17"}));
        const Printed values = recompute(whole, kDouble, kDoubleAgreed, tally);
        std::vector<double> world = {values["world.x"], values["world.y"], values["world.z"]};
        worlds.push_back(world);
        const bool isDirection = std::string(point).ends_with(",0");
        if (isDirection) world.push_back(0);
        const json projected = run({"project", "-c", camera, "--point", listed(world)});
        // A weight of two divides exactly.
        CHECK(whole["result"]["screen"] == projected["screen"]);
      }
  // By hand: (0.1, 0.2, 0.3) turned a quarter about z, doubled, tripled in z, and moved; and a glTF matrix is by
  // columns.
  CHECK(worlds[0][0].get<double>() == closely(1 - 0.4).margin(1e-15));
  CHECK(worlds[0][1].get<double>() == closely(0.3 + 0.2).margin(1e-15));
  CHECK(worlds[0][2].get<double>() == closely(-1 + 0.9).margin(1e-15));
  CHECK(worlds[12] == worlds[0]);
}
