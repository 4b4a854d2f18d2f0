// viewproj explain: every stage of one point or pixel.
#include "commands/explain/explain.hpp"

#include "camera/camera.hpp"
#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/options.hpp"
#include "output/output_file.hpp"
#include "records/model.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr std::size_t kDefaultDigits = 9;

GivenPoint readPoint(const std::string& option, const std::string& text) {
  const GivenPoint given = readGivenPoint(option, text);
  const Vec4 point = given.point();
  if (maxAbs(Vec3{point.x, point.y, point.z}) == 0 && point.w == 0)
    throw UsageError(given.text + ": is neither a point nor a direction, all four numbers are 0");
  return given;
}

struct Options {
  CameraOptions camera;
  std::optional<GivenPoint> point;
  std::optional<std::vector<double>> pixel;
  std::optional<std::string> model;
  std::optional<std::size_t> digits;
  ReportForm form = ReportForm::table;
};

int run(const Options& o) {
  if (o.camera.lists()) return o.camera.list();
  if (!o.point && !o.pixel) throw UsageError("--point X,Y,Z or --pixel X,Y is needed: what to follow");
  if (o.point && o.pixel) throw UsageError("--point and --pixel are two explanations; leave out one of them");
  if (o.pixel && o.model) throw UsageError("--model goes with --point");
  requireOneStandardInput({{"the camera", o.camera.fromStandardInput()}, {"the model", isStandardInput(o.model)}});
  const CameraFile file = o.camera.read();
  if (o.point) o.point->requireFit(file.worldIsEcef);
  const Camera built = makeCamera(file);
  const Convention writing = o.camera.writing(file);
  o.camera.noteHandedness(file);
  const auto explain = [&] {
    if (o.point)
      return explainPoint(built, writing, o.point->point(),
                          o.model ? std::optional(readModel(*o.model)) : std::nullopt);
    const std::vector<double>& n = *o.pixel;
    return explainPixel(built, writing, {n[0], n[1]}, n.size() > 2 ? std::optional(n[2]) : std::nullopt);
  };
  const Explanation explanation = explain();
  const int shown = static_cast<int>(o.digits.value_or(kDefaultDigits));
  writeOutput(o.form == ReportForm::json ? explanationAsJson(explanation, shown)
                                         : explanationAsTable(explanation, shown));
  return 0;
}

}  // namespace

Action defineExplain(CommandLine& line) {
  const auto o = std::make_shared<Options>();
  line.setDescription(
      "Every stage of one point's way to its pixel, or of one pixel's way back: world, view, clip and where w comes "
      "from, the clip inequalities, NDC, screen, each number with what it is made of.");
  line.setExample("viewproj explain -c samples/picking-a-pixel/camera.json --point 1,1,1 --convention d3d");
  o->camera.add(line);
  o->camera.addWriting(line);
  addValue(line, "--point", kPointForm, o->point, readPoint, "The point to follow");
  addValue(line, "--pixel", "X,Y[,DEPTH]", o->pixel, readPixelNumbers,
           "The pixel to follow back, with a window depth if known");
  addModelOption(line, o->model, "point");
  addDigits(line, o->digits, std::to_string(kDefaultDigits));
  addReportForm(line, o->form);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
