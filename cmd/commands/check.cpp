// viewproj check: whether points and pixels agree, and which mistake explains it where they do not.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands/command.hpp"
#include "commands/pair_check.hpp"
#include "commands/stream_options.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// Its exit status; 2 is that of all errors.
enum : int { kAgree = 0, kDisagree = 1, kTrouble = 2 };

/// Explanations as sections with their sentences, and what to know of them.
OrderedJson forPeople(OrderedJson report) {
  OrderedJson sections = OrderedJson::object(), notes = OrderedJson::array();
  for (const OrderedJson& one : report["explanations"]) {
    OrderedJson& section = sections[one["mistake"].get<std::string>()];
    section["cause"] = sentenceOf(one["mistake"].get<std::string>());
    if (!one["value"].is_null()) section["value"] = one["value"];
    section["mend"] = one["mend"];
    section["largestMiss"] = one["largestMiss"];
  }
  const bool agrees = report["agrees"].get<bool>(), hasFit = !agrees && !report["fit"]["offset"].is_null();
  if (report["noPixel"] != 0) notes.push_back("noPixel: points behind the camera or beyond its lens have none.");
  if (!agrees && sections.empty())
    notes.push_back(
        "None of the mistakes that are tried explains these pixels. Pixels rounded to whole numbers need --within 1, "
        "truncated ones 1.5.");
  if (!sections.empty() && report["records"] == 1)
    notes.push_back("One pair may fit a mistake by chance; a second one would tell.");
  if (hasFit)
    notes.push_back("fit: given = computed + offset, and given = scale * computed + scaleOffset; Rms is what is left.");
  if (sections.empty())
    report.erase("explanations");
  else
    report["explanations"] = std::move(sections);
  if (!hasFit) report.erase("fit");
  if (!report["worst"].is_null()) report["worst"] = "line " + report["worst"].dump();
  report["notes"] = std::move(notes);
  return report;
}

struct CheckOptions {
  CameraOptions camera;
  StreamOptions stream;
  std::vector<Vec2> pixels;
  double within = 0.1;
  ReportOptions report;
};

int runCheck(const CheckOptions& o) {
  StreamSetup setup = o.stream.setup(kPairColumns);
  if (setup.given.size() != o.pixels.size())
    throw UsageError("expected a --pixel for each --point, got " + std::to_string(setup.given.size()) +
                     " --point and " + std::to_string(o.pixels.size()) + " --pixel");
  for (std::size_t i = 0; i < o.pixels.size(); ++i) {
    const std::string x = formatNumber(o.pixels[i].x), y = formatNumber(o.pixels[i].y);
    setup.given[i].json = "{\"position\":" + setup.given[i].json + ",\"pixel\":[" + x + "," + y + "]}";
  }
  o.stream.reads(setup);
  const CameraFile file = o.camera.read();
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  PairCheck check(makeCamera(file), hypotheses(file.document, file.reading), o.within);
  const PointReading reading{.columns = setup.columns, .worldIsEcef = file.worldIsEcef};
  const RecordUse use{[&](const RecordView& record) { return findPair(record, reading); },
                      [&](const NumberPlan& plan, const Numbers& numbers, const RecordView&, std::size_t line) {
                        const Pair pair = toPair(plan, numbers);
                        check.add(pair.point, pair.pixel, line);
                      }};
  const int status = readRecords(setup, use);
  if (check.records() == 0) throw InputError(shownName(setup.file) + ": has no pairs of a point and a pixel");
  const OrderedJson report = check.report();
  o.report.write(o.report.form() == ReportForm::table ? forPeople(report) : report);
  return status != 0 ? kTrouble : check.agrees() ? kAgree : kDisagree;
}

}  // namespace

Action declareCheck(CLI::App& app) {
  const auto o = std::make_shared<CheckOptions>();
  app.description(
      "Whether each point lies at the pixel beside it (u,v, px,py, screen or pixel); where not, by how much it misses, "
      "and which single mistake explains all. Exit status: 0 all agree, 1 some do not, 2 an error.");
  app.footer(
      "Examples:\n"
      "  viewproj check --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 1280x720 --point 1,1,1 --pixel 687.1,428.7 ||\n"
      "    echo 'not its pixel'\n"
      "  printf 'x,y,z,u,v\\n1,1,1,687,291.3\\n0,0,0,640,360\\n' |\n"
      "    viewproj check --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 1280x720 --within 1");
  o->stream.addPoints(app);
  CLI::Option* const point = app.get_option("--point");
  CLI::Option* const pixel =
      addValues(app, "--pixel", "X,Y", o->pixels, readPixelPosition, "The pixel of the point, in the same order");
  point->needs(pixel);
  pixel->needs(point);
  addValue(app, "--within", "PIXELS", o->within,
           numberThat([](double pixels) { return pixels >= 0; }, "a number of pixels, 0 or more"),
           "Largest distance that still agrees (default: 0.1)");
  o->report.add(app, 6);
  o->stream.addInput(app, "pairs of a point and a pixel");
  o->camera.add(app);
  return [o] { return runCheck(*o); };
}

}  // namespace viewproj::cmd
