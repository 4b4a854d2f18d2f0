// viewproj explain: every stage of one point or pixel.
#include "commands/explain/explain.hpp"

#include <cmath>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/model.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/parse_number.hpp"

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

Vec4 pointOf(const GivenPoint& given) {
  const Vec4 point = given.point();
  if (maxAbs(Vec3{point.x, point.y, point.z}) == 0 && point.w == 0)
    throw UsageError("--point " + given.text + ": is neither a point nor a direction, all four numbers are 0");
  return point;
}

struct Options {
  CameraOptions camera;
  std::string point, pixel, model, digits, format = "table";
};

int run(const Options& o) {
  static constexpr std::string_view kFormats[] = {"table", "json"};
  requireKnown("--to", o.format, kFormats);
  if (o.point.empty() == o.pixel.empty())
    throw UsageError(o.point.empty() ? "--point X,Y,Z or --pixel X,Y is needed: what to follow"
                                     : "--point and --pixel are two explanations; leave out one of them");
  if (!o.pixel.empty() && !o.model.empty()) throw UsageError("--model goes with --point");
  const int shown = readDigits(o.digits);
  const auto given = o.point.empty() ? std::nullopt : std::optional(readPointOption(o.point));
  const Vec4 local = given ? pointOf(*given) : Vec4{};
  const std::vector<double> position = o.pixel.empty() ? std::vector<double>{} : readPixelOption(o.pixel);
  requireOneStandardInput({{"the camera", o.camera.fromStandardInput()}, {"the model", o.model == "-"}});
  const CameraFile file = o.camera.read();
  if (given) given->requireFit(file.worldIsEcef);
  const Camera built = makeCamera(file);
  const Convention writing = o.camera.writing(file);
  const auto explain = [&] {
    if (position.empty())
      return explainPoint(built, writing, local, o.model.empty() ? std::nullopt : std::optional(readModel(o.model)));
    return explainPixel(built, writing, {position[0], position[1]},
                        position.size() > 2 ? std::optional(position[2]) : std::nullopt);
  };
  const Explanation explanation = explain();
  writeOutput(o.format == "json" ? explanationAsJson(explanation, shown) : explanationAsTable(explanation, shown));
  return 0;
}

}  // namespace

Action defineExplain(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "Every stage of one point's way to its pixel, or of one pixel's way back: world, view, clip and where w comes "
      "from, the clip inequalities, NDC, screen, each number with what it is made of.");
  app.footer("viewproj explain -c samples/picking-a-pixel/camera.json --point 1,1,1 --convention d3d");
  o->camera.add(app);
  o->camera.addWriting(app);
  app.add_option("--point", o->point, "The point to follow")->type_name("X,Y,Z[,W]|lat=..,lon=..,height=..");
  app.add_option("--pixel", o->pixel, "The pixel to follow back, with a window depth if known")
      ->type_name("X,Y[,DEPTH]");
  addModel(app, o->model, "point");
  app.add_option("--digits", o->digits, "Significant digits, from 1 to 17, which gives all (default: 9)")
      ->type_name("N");
  app.add_option("--to", o->format, "Form of the output: table, json (default: table)")->type_name("FORM");
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
