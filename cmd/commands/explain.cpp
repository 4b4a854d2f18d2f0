// viewproj explain: every stage of one point or pixel.
#include "explain/explain.hpp"

#include <algorithm>
#include <cmath>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/error.hpp"
#include "input/model.hpp"
#include "input/number.hpp"
#include "output/output_file.hpp"

namespace viewproj::cmd {
namespace {

constexpr int kDefaultDigits = 9, kMostDigits = 17;

int readDigits(const std::string& text) {
  if (text.empty()) return kDefaultDigits;
  const auto digits = parseNumber(text);
  if (!digits || *digits != std::floor(*digits) || !(*digits >= 1 && *digits <= kMostDigits))
    throw UsageError("--digits " + text + ": expected a whole number from 1 to 17");
  return static_cast<int>(*digits);
}

Vec4 readPoint(const std::string& text) {
  const auto numbers = parseNumberList(text);
  if (!numbers || numbers->size() < 3 || numbers->size() > 4)
    throw UsageError("--point " + text + ": expected X,Y,Z or X,Y,Z,W");
  const std::vector<double>& n = *numbers;
  const Vec4 point{n[0], n[1], n[2], n.size() > 3 ? n[3] : 1};
  if (maxAbs(Vec3{point.x, point.y, point.z}) == 0 && point.w == 0)
    throw UsageError("--point " + text + ": is neither a point nor a direction, all four numbers are 0");
  return point;
}

std::vector<double> readPixel(const std::string& text) {
  const auto numbers = parseNumberList(text);
  if (!numbers || numbers->size() < 2 || numbers->size() > 3)
    throw UsageError("--pixel " + text + ": expected X,Y or X,Y,DEPTH");
  return *numbers;
}

}  // namespace

int runExplain(int argc, char** argv) {
  CLI::App app(
      "Every stage of one point's way to its pixel, or of one pixel's way back: world, view, clip and where w comes\n"
      "from, the clip inequalities, NDC, screen, each number with what it is made of.\n"
      "Example: viewproj explain -c camera.json --point 1,2,3",
      "viewproj explain");
  CameraOptions camera;
  std::string point, pixel, model, digits, format = "table";
  camera.add(app);
  camera.addWriting(app);
  app.add_option("--point", point, "The point to follow")->type_name("X,Y,Z[,W]");
  app.add_option("--pixel", pixel, "The pixel to follow back, with a window depth if known")->type_name("X,Y[,DEPTH]");
  app.add_option("--model", model, "Matrix from the point's own coordinates to the world: 4 rows, or a glTF node")
      ->type_name("JSON");
  app.add_option("--digits", digits, "Significant digits (default 9; 17 gives all)")->type_name("N");
  app.add_option("--to", format, "Output: table (default), json")->type_name("FORM");
  parse(app, argc, argv);

  static constexpr std::string_view kFormats[] = {"table", "json"};
  if (std::find(std::begin(kFormats), std::end(kFormats), format) == std::end(kFormats))
    failUnknown("--to", format, kFormats);
  if (point.empty() == pixel.empty())
    throw UsageError(point.empty() ? "--point X,Y,Z or --pixel X,Y is needed: what to follow"
                                   : "--point and --pixel are two explanations; leave out one of them");
  if (!pixel.empty() && !model.empty()) throw UsageError("--model goes with --point");
  const int shown = readDigits(digits);
  const Vec4 local = point.empty() ? Vec4{} : readPoint(point);
  const std::vector<double> position = pixel.empty() ? std::vector<double>{} : readPixel(pixel);
  const CameraFile file = camera.read();
  const Camera built = makeCamera(file);
  const Convention writing = camera.writing(file);
  const auto explain = [&] {
    if (position.empty())
      return explainPoint(built, writing, local, model.empty() ? std::nullopt : std::optional(readModel(model)));
    return explainPixel(built, writing, {position[0], position[1]},
                        position.size() > 2 ? std::optional(position[2]) : std::nullopt);
  };
  const Explanation explanation = explain();
  writeOutput(format == "json" ? explanationAsJson(explanation, shown) : explanationAsTable(explanation, shown));
  return 0;
}

}  // namespace viewproj::cmd
