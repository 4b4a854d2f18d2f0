// viewproj check: whether points and pixels agree, and which mistake explains it where they do not.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/check/report.hpp"
#include "commands/check/words.hpp"
#include "commands/command.hpp"
#include "commands/stream_options.hpp"
#include "formats/colmap.hpp"
#include "formats/observations.hpp"
#include "formats/open.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// Its exit status; 2 is that of all errors.
enum : int { kAgree = 0, kDisagree = 1, kTrouble = 2 };

std::string capitalized(std::string text) {
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// What is said where nothing explains the pixels: of measured ones, how far they are off.
std::string unexplained(const OrderedJson& report) {
  constexpr double kMeasured = 5;  // pixels
  const OrderedJson& largest = report["largestMiss"];
  if (report["records"] < 2 || report["noPixel"] != 0 || largest.is_null() || largest > kMeasured)
    return "No explanation found.";
  const double miss = largest, step = std::pow(10, std::floor(std::log10(miss)));
  return "No explanation found. All miss by about " + formatDigits(report["rmsMiss"], 2) +
         " px without a pattern: measured or rounded pixels? --within " +
         formatDigits(std::ceil(miss / step) * step, 2);
}

/// Explanations as sections under their sentences, and what to know of them.
OrderedJson forPeople(OrderedJson report) {
  OrderedJson notes = OrderedJson::array();
  const OrderedJson wrong = report["wrongPairs"], list = report["explanations"];
  if (report["noPixel"] != 0) notes.push_back("noPixel: points that have a pixel on one side alone.");
  if (!wrong.empty()) {
    const bool isOne = wrong.size() == 1, othersAgree = !(report["medianMiss"] > report["within"]);
    notes.push_back(capitalized(mistakes::shownLines(wrong.get<std::vector<std::size_t>>())) +
                    (othersAgree ? std::string(isOne ? " alone disagrees" : " alone disagree")
                                 : (isOne ? " misses" : " miss") + std::string(" by far more than the others (") +
                                       formatDigits(report["medianMiss"], 2) + " px, median)") +
                    ": a point or a pixel is wrong there, not the camera.");
  }
  if (!report["verdict"].is_null()) notes.push_back(unexplained(report));
  if (std::any_of(list.begin(), list.end(),
                  [](const OrderedJson& one) { return !one["mend"].is_null() && !one["pairs"].is_null(); }))
    notes.push_back("Where an explanation has mend and pairs, both are needed.");
  if (!list.empty() && report["records"] == 1)
    notes.push_back("One pair may fit a mistake by chance; a second one would tell.");
  if (!report["worst"].is_null()) report["worst"] = "line " + report["worst"].dump();
  if (report["agrees"] || report["judged"] == report["records"])
    report.erase("judged");
  else
    report["judged"] = report["judged"].dump() + " of " + report["records"].dump();
  OrderedJson cameras = report["cameras"];
  for (const char* const said : {"wrongPairs", "explanations", "verdict", "cameras"}) report.erase(said);
  if (!cameras.is_null()) {  // the worst first
    constexpr std::size_t kMost = 10;
    std::stable_sort(cameras.begin(), cameras.end(), [](const OrderedJson& a, const OrderedJson& b) {
      const auto rms = [](const OrderedJson& camera) {
        return camera["rmsMiss"].is_null() ? HUGE_VAL : camera["rmsMiss"].get<double>();
      };
      return rms(a) > rms(b);
    });
    if (cameras.size() > kMost) {
      notes.push_back("cameras: and " + std::to_string(cameras.size() - kMost) + " more.");
      cameras.erase(cameras.begin() + kMost, cameras.end());
    }
    report["cameras"] = std::move(cameras);
  }
  for (const OrderedJson& one : list) {
    OrderedJson& section = report[capitalized(one["sentence"].get<std::string>()) + "."];
    for (const char* const row : {"mistake", "mend", "pairs", "rmsMiss", "largestMiss", "camerasMended"})
      if (!one[row].is_null()) section[row] = one[row];
  }
  report["notes"] = std::move(notes);
  return report;
}

struct CheckOptions {
  CameraOptions camera;
  std::optional<std::string> cameraBy;
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
  const auto set = o.camera.readAll();
  const CameraSet& cameras = *set.first;
  // A model of COLMAP holds pairs, of pictures that have names.
  const bool areOfModel = colmapModel(setup.file).has_value();
  if (areOfModel && o.cameraBy)
    throw UsageError("--camera-by is of records; the observations of " + shownName(setup.file) +
                     " name their pictures");
  const std::string forSeveral =
      "; --camera-by FIELD names each pair's; a FILE that is a model of COLMAP has its own pairs";
  const std::vector<std::size_t> picked = cameras.chooseAll(set.second);
  const bool areOfSeveral = o.cameraBy || areOfModel;
  const std::size_t chosen = areOfSeveral ? picked.front() : cameras.choose(set.second, forSeveral);
  const CameraFile file = o.camera.readOne(cameras, chosen);
  std::vector<bool> isPicked(cameras.size());
  for (const std::size_t which : picked) isPicked[which] = true;
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  const PointReading reading{.columns = setup.columns, .worldIsEcef = file.worldIsEcef};
  mistakes::PairReport all = areOfSeveral ? mistakes::PairReport(o.within) : mistakes::PairReport(file, o.within);
  const auto addOf = [&](const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line, std::size_t which) {
    all.add(point, pixel, line, which, [&] {
      CameraFile each = o.camera.readOne(cameras, which);
      if (each.worldIsEcef != file.worldIsEcef)
        throw InputError(each.name + ": expected all cameras on the Earth, or none");
      return std::pair(cameras.pickOf(which), std::move(each));
    });
  };
  const auto add = [&](const NumberPlan& plan, const Numbers& numbers, const RecordView& record, std::size_t line) {
    const Vec4 point = toPoint(plan, numbers);
    const std::optional<Vec2> pixel = pixelBesidePoint(plan, numbers);
    if (!o.cameraBy) return all.add(point, pixel, line);
    const std::size_t field = cameraFieldOf(*o.cameraBy, record);
    addOf(point, pixel, line, cameraNamed(cameras, isPicked, record, field, cameraNameAt(record, field)));
  };
  const auto addObservations = [&] {
    const std::unique_ptr<CameraSet> own = openCameras(setup.file, {.option = "FILE"}, {});
    std::size_t line = 0;  // as convert --to observations writes those that are picked
    const std::string told = eachObservation(setup.file, [&](const Observation& seen) {
      const std::string& name = own->nameOf(seen.camera);
      const auto which = cameras.find(name);
      if (!which) throw InputError(cameras.name() + ": has no camera " + inQuotes(name) + " of " + setup.file);
      const auto& [x, y, z] = seen.position;
      if (isPicked[*which]) addOf({x, y, z, 1}, seen.pixel, ++line, *which);
    });
    if (!told.empty()) note(told);
    return 0;
  };
  const int status =
      areOfModel ? addObservations()
                 : readRecords(setup, {[&](const RecordView& record) { return findPair(record, reading); }, add});
  if (all.records() == 0) throw InputError(shownName(setup.file) + ": has no pairs of a point and a pixel");
  const auto others = [&] {
    constexpr std::size_t kMost = 100;
    std::vector<std::pair<std::string, CameraFile>> list;
    for (std::size_t i = 0; i < std::min(cameras.size(), kMost); ++i) {
      if (i == chosen) continue;
      try {
        list.emplace_back("#" + cameras.pickOf(i), o.camera.readOne(cameras, i));
      } catch (const InputError&) {  // no camera without what only the chosen one has
      } catch (const UsageError&) {
      }
    }
    return list;
  };
  const OrderedJson report = areOfSeveral ? all.report() : all.report(others);
  o.report.write(o.report.form() == ReportForm::table ? forPeople(report) : report);
  return status != 0 ? kTrouble : report["agrees"].get<bool>() ? kAgree : kDisagree;
}

}  // namespace

Action declareCheck(CLI::App& app) {
  const auto o = std::make_shared<CheckOptions>();
  describe(
      app,
      "Whether each point lies at the pixel beside it (u,v, px,py, screen or pixel); where not, by how much it misses, "
      "which mistake explains it (viewproj help mistakes), and what mends it. Exit status: 0 all agree, 1 some do not, "
      "2 an error.",
      "Examples:\n"
      "  camera='--position 3,2,5 --target 0,0,0 --viewport 1280x720'\n"
      "  viewproj check $camera --fov-y 60 --point 1,1,1 --pixel 687.1,428.7 || true\n"
      "  viewproj project $camera --fov-y 60 --point 1,1,1 --point 0,2,1 |\n"
      "    viewproj check $camera --fov-x 60 || true");
  o->stream.addPoints(app);
  CLI::Option* const point = findOption(app, "--point");
  CLI::Option* const pixel =
      addValues(app, "--pixel", "X,Y", o->pixels, readPixelPosition, "The pixel of the point, in the same order");
  require(point, pixel);
  require(pixel, point);
  addValue(app, "--within", "PIXELS", o->within,
           numberThat([](double pixels) { return pixels >= 0; }, "a number of pixels, 0 or more"),
           "Largest distance that still agrees (default: 0.1)");
  addValue(app, "--camera-by", "FIELD", o->cameraBy, readText, "The field that names a record's camera of -c");
  o->report.add(app, 6);
  o->stream.addInput(app, "pairs of a point and a pixel, or a COLMAP model");
  o->camera.add(app);
  return [o] { return runCheck(*o); };
}

}  // namespace viewproj::cmd
