// viewproj measure: speed and error of every precision, and of the textbook way, on the user's own points.
#include "commands/command.hpp"
#include "commands/measure/measurement.hpp"
#include "commands/measure/report.hpp"
#include "commands/options.hpp"
#include "commands/stream_options.hpp"
#include "input/points.hpp"
#include "output/output_file.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

/// Points that are kept at once.
constexpr std::size_t kMostPoints = 1'000'000;

/// What batches take, and how much was left out because they do not.
struct Sample {
  std::vector<Vec3> points;
  std::size_t leftOut = 0;
  std::size_t beyond = 0;  ///< with --keep-going, those beyond kMostPoints
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
    if (sample_.points.size() == kMostPoints && keepGoing_) {
      ++sample_.beyond;
      return;
    }
    if (sample_.points.size() == kMostPoints)
      throw RecordError(0, "is one more than the " + std::to_string(kMostPoints) +
                               " points that are measured at once; a sample of them will do");
    if (p.w == 1)
      sample_.points.push_back({p.x, p.y, p.z});
    else
      ++sample_.leftOut;
  }
  void write(std::size_t, ResultSink&) override {}  // uncounted: records are read alone
  void clear() override {}

 private:
  Sample& sample_;
  const PointReading& reading_;
  bool keepGoing_;
};

std::vector<std::string> notesOn(const Measurement& m, std::size_t leftOut) {
  std::vector<std::string> notes;
  const auto records = [](std::size_t count) { return std::to_string(count) + (count == 1 ? " point" : " points"); };
  if (leftOut > 0)
    notes.push_back("left out " + records(leftOut) + " with a weight or a direction; batches take x y z alone");
  if (m.points < kEnoughToTime)
    notes.push_back("too few points to time: with " + records(m.points) +
                    " the cost of a call is part of ns per point; repeat them to " + std::to_string(kEnoughToTime) +
                    " or more");
  if (m.visible == 0)
    notes.push_back("none of the points is in the picture: there are no errors to tell, and no rays");
  else if (m.points >= kEnoughToTime && m.visible < kEnoughToTime)
    notes.push_back("too few pixels to time: with " + records(m.visible) +
                    " in the picture the cost of a call is part of ns per ray");
  return notes;
}

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
  const Camera built = makeCamera(file);

  Sample sample;
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  const PointReading reading{.columns = setup.columns, .worldIsEcef = file.worldIsEcef};
  const int status = readRecords(setup, [&] { return std::make_unique<SampleWork>(sample, reading, setup.keepGoing); });
  if (sample.points.empty())
    throw InputError((setup.file == "-" ? kStandardInputName : visible(setup.file)) + ": has no points to measure" +
                     (sample.leftOut > 0 ? "; directions and weighted points are left out" : ""));
  const Measurement m = measure(built, sample.points);
  const std::vector<std::string> notes = notesOn(m, sample.leftOut);
  if (sample.beyond > 0)
    o.camera.notes().say("the first " + std::to_string(kMostPoints) + " points are measured, and " +
                         std::to_string(sample.beyond) + " left out");
  for (const std::string& note : notes) o.camera.notes().say(note);
  writeOutput(o.form == ReportForm::json ? measurementAsJson(m, sample.leftOut, notes) : measurementAsTable(m));
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
