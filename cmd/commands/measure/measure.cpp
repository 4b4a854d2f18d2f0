// viewproj measure: speed and error of every precision, and of the textbook way, on the user's own points.
#include "commands/command.hpp"
#include "commands/measure/measurement.hpp"
#include "commands/measure/report.hpp"
#include "commands/options.hpp"
#include "commands/stream_options.hpp"
#include "output/output_file.hpp"
#include "records/points.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// Points that are kept at once.
constexpr std::size_t kMostPoints = 1'000'000;

/// What batches take, and how much was left out because they do not.
struct Sample {
  std::vector<Vec3> points;
  std::size_t leftOut = 0;
};

/// Keeps the points of a stream.
class SampleWork final : public RecordWork {
 public:
  SampleWork(Sample& sample, const PointReading& reading, bool keepGoing)
      : sample_(sample), reading_(reading), keepGoing_(keepGoing) {}

  Layout find(const RecordParts& record) const override { return findPoint(record, reading_); }
  Results results(const Layout&, OutputForm) const override { return {}; }
  void add(const Layout& layout, const Numbers& numbers) override {
    const Vec4 p = toPoint(layout, numbers);
    if (sample_.points.size() == kMostPoints && keepGoing_) return;
    if (sample_.points.size() == kMostPoints)
      throw RecordError(0, "is one more than the " + std::to_string(kMostPoints) +
                               " points that are measured at once; a sample of them will do");
    if (p.w == 1)
      sample_.points.push_back({p.x, p.y, p.z});
    else
      ++sample_.leftOut;
  }
  void write(std::size_t, ResultSink&) override {}  // records are read alone
  void clear() override {}

 private:
  Sample& sample_;
  const PointReading& reading_;
  bool keepGoing_;
};

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  ReportForm form = ReportForm::table;
};

int run(const Options& o) {
  if (o.camera.lists()) return o.camera.list();
  FilterSetup setup = o.stream.setup(kPointColumns);
  setup.note = [&](const std::string& note) { o.camera.notes().say(note); };
  o.stream.requireOneInput(setup, o.camera);
  const CameraFile file = o.camera.read();
  requireNear(file, "measure");
  const Camera built = makeCamera(file);

  Sample sample;
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  const PointReading reading{.columns = setup.columns, .worldIsEcef = file.worldIsEcef};
  const int status = readRecords(setup, [&] { return std::make_unique<SampleWork>(sample, reading, setup.keepGoing); });
  if (sample.points.empty())
    throw InputError((setup.file == "-" ? kStandardInputName : visible(setup.file)) + ": has no points to measure" +
                     (sample.leftOut > 0 ? "; directions and weighted points are left out" : ""));
  const Measurement m = measure(built, sample.points);
  writeOutput(o.form == ReportForm::json ? measurementAsJson(m, sample.leftOut) : measurementAsTable(m));
  return status;
}

}  // namespace

Action defineMeasure(CommandLine& line) {
  const auto o = std::make_shared<Options>();
  line.setDescription(
      "Speed and error of every precision on your own points, beside the textbook way: the view-projection matrix in "
      "double and in float, and rays by its inverse.");
  line.setExample("viewproj measure -c samples/measuring-the-trade/camera.json samples/measuring-the-trade/points.txt");
  o->camera.add(line);
  o->stream.addInput(line, "points");
  o->stream.addKeepGoing(line);
  addReportForm(line, o->form);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
