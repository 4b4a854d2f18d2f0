// viewproj project: world points to screen positions.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/error.hpp"
#include "input/names.hpp"
#include "input/number.hpp"
#include "input/points.hpp"
#include "output/number.hpp"
#include "stream/filter.hpp"
#include "viewproj/view/batch.hpp"
#include "viewproj/view/clip.hpp"
#include "viewproj/view/screen.hpp"

namespace viewproj::cmd {
namespace {

enum class ResultField { screen, depth, viewDistance, visible, outside, ndc, clip, view, bound };

constexpr std::pair<std::string_view, ResultField> kFields[] = {
    {"screen", ResultField::screen},   {"depth", ResultField::depth},     {"viewDistance", ResultField::viewDistance},
    {"visible", ResultField::visible}, {"outside", ResultField::outside}, {"ndc", ResultField::ndc},
    {"clip", ResultField::clip},       {"view", ResultField::view},       {"bound", ResultField::bound},
};

struct Fields {
  std::vector<ResultField> wanted;
  bool outsideAlways = false;
};

Fields chooseFields(const std::string& list, bool asText) {
  using enum ResultField;
  if (list.empty())
    return {asText ? std::vector{screen, depth} : std::vector{screen, depth, viewDistance, visible, outside}};
  Fields fields;
  fields.outsideAlways = true;
  for (const std::string& name : splitList(list)) {
    std::vector<std::string_view> known;
    const std::size_t before = fields.wanted.size();
    for (const auto& [row, field] : kFields) {
      known.push_back(row);
      if (row == name) fields.wanted.push_back(field);
    }
    if (fields.wanted.size() == before) failUnknown("--fields", name, known);
    if (std::count(fields.wanted.begin(), fields.wanted.end(), fields.wanted.back()) > 1)
      throw UsageError("--fields: " + name + " is named twice");
  }
  return fields;
}

/// The names of what a point lies beyond, in the interface's order.
class Sides {
 public:
  explicit Sides(const ScreenPoint& p) {
    static constexpr std::pair<Side, std::string_view> kNames[] = {
        {sideLeft, "left"}, {sideRight, "right"}, {sideBottom, "bottom"},
        {sideTop, "top"},   {sideNear, "near"},   {sideFar, "far"},
    };
    if (p.status == PointStatus::behind) names_[count_++] = "behind";
    for (const auto& [side, name] : kNames)
      if (p.outside & side) names_[count_++] = name;
  }
  std::span<const std::string_view> names() const { return {names_.data(), count_}; }

 private:
  std::array<std::string_view, 6> names_;
  std::size_t count_ = 0;
};

struct Projecting {
  Camera camera;
  Convention writing;                   ///< of ndc, clip and view
  std::optional<Precision> arithmetic;  ///< nothing: auto, within the tolerance
  double tolerance = 0;
  std::vector<std::string> columns;
  bool worldIsEcef = false;
  Fields fields, textFields;
};

bool isScreenAndDepth(const Fields& fields) {
  return fields.wanted == std::vector{ResultField::screen, ResultField::depth};
}

class ProjectWork final : public RecordWork {
 public:
  explicit ProjectWork(const Projecting& how)
      : how_(how), chosen_(how.arithmetic ? *how.arithmetic : precisionWithin(how.camera, how.tolerance)) {}

  Layout find(const RecordParts& record) const override { return findPoint(record, how_.columns, how_.worldIsEcef); }
  void nameResults(const Layout&, ResultSink& sink) const override { writeFields({}, {0, 0, 0, 1}, sink); }

  void add(const Layout& layout, const Numbers& numbers) override {
    const Vec4 point = toPoint(layout, numbers);
    points_.push_back(point);
    positions_.push_back({point.x, point.y, point.z});
  }

  void compute() override {
    screen_.resize(points_.size());
    if (how_.arithmetic)
      worldToScreen(how_.camera, positions_, screen_, chosen_);
    else
      worldToScreenWithin(how_.camera, how_.tolerance, positions_, screen_);
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_[i].w != 1)
        screen_[i] = how_.arithmetic ? worldToScreen(how_.camera, points_[i], chosen_)
                                     : worldToScreenWithin(how_.camera, chosen_, points_[i]);
  }

  void write(std::size_t i, ResultSink& sink) override { writeFields(screen_[i], points_[i], sink); }

  void clear() override {
    points_.clear();
    positions_.clear();
  }

  std::size_t convert(std::span<const double> in, TextBuffer& out) override {
    if (!isScreenAndDepth(how_.textFields)) return 0;
    const auto usable = [](double v) { return std::fabs(v) <= std::numeric_limits<double>::max(); };
    const std::size_t count = static_cast<std::size_t>(std::find_if_not(in.begin(), in.end(), usable) - in.begin()) / 3;
    const std::size_t bytes = count * sizeof(Vec3);
    char* const room = out.room(bytes);
    const std::span points(reinterpret_cast<const Vec3*>(in.data()), count);
    const std::span screen(reinterpret_cast<Vec3*>(room), count);
    if (how_.arithmetic)
      worldToScreen(how_.camera, points, screen, chosen_);
    else
      worldToScreenWithin(how_.camera, how_.tolerance, points, screen);
    // What overflowed has no value: the writer knows what becomes of it.
    const auto overflowed = [](const Vec3& p) { return std::isinf(p.x) || std::isinf(p.y) || std::isinf(p.z); };
    const auto good = static_cast<std::size_t>(std::find_if(screen.begin(), screen.end(), overflowed) - screen.begin());
    out.written(room + good * sizeof(Vec3));
    return good;
  }

 private:
  void writeFields(const ScreenPoint& p, const Vec4& point, ResultSink& sink) const {
    const Fields& fields = sink.isText() ? how_.textFields : how_.fields;
    const Camera& camera = how_.camera;
    for (ResultField field : fields.wanted) switch (field) {
        case ResultField::screen:
          sink.vector("screen", std::array{p.x, p.y});
          break;
        case ResultField::depth:
          sink.number("depth", p.depth);
          break;
        case ResultField::viewDistance:
          sink.number("viewDistance", p.viewDistance);
          break;
        case ResultField::visible:
          sink.flag("visible", p.visible());
          break;
        case ResultField::outside:
          sink.names("outside", Sides(p).names(), fields.outsideAlways);
          break;
        case ResultField::ndc: {
          const Vec3 ndc = worldToNdc(camera, point, how_.writing);
          sink.vector("ndc", std::array{ndc.x, ndc.y, ndc.z});
          break;
        }
        case ResultField::clip: {
          const Vec4 clip = worldToClip(camera, point, how_.writing);
          sink.vector("clip", std::array{clip.x, clip.y, clip.z, clip.w});
          break;
        }
        case ResultField::view: {
          const Vec3 view = worldToView(camera, point, how_.writing);
          sink.vector("view", std::array{view.x, view.y, view.z});
          break;
        }
        case ResultField::bound:
          sink.number("bound", boundOfPoint(camera, point, p.precision).screen);
          break;
      }
  }

  const Projecting& how_;
  Precision chosen_;
  std::vector<Vec4> points_;
  std::vector<Vec3> positions_;
  std::vector<ScreenPoint> screen_;
};

/// Points of the command line as JSON records.
std::vector<GivenRecord> recordsOf(const std::vector<std::string>& points) {
  std::vector<GivenRecord> records;
  for (const std::string& text : points) {
    const auto numbers = parseNumberList(text);
    if (!numbers || numbers->size() < 3 || numbers->size() > 4)
      throw UsageError("--point " + text + ": expected X,Y,Z or X,Y,Z,W");
    std::string json;
    for (double number : *numbers) json += (json.empty() ? "[" : ",") + formatNumber(number);
    records.push_back({"--point " + text, json + "]"});
  }
  return records;
}

}  // namespace

int runProject(int argc, char** argv) {
  CLI::App app(
      "World points to screen positions.\n"
      "Example: echo '{\"id\":1,\"x\":0,\"y\":1,\"z\":2}' | viewproj project -c camera.json",
      "viewproj project");
  CameraOptions camera;
  StreamOptions stream;
  PrecisionOption precision;
  ToleranceOption tolerance;
  std::vector<std::string> points;
  std::string fieldList;
  camera.add(app);
  camera.addWriting(app);
  stream.add(app, "points");
  precision.add(app);
  tolerance.add(app);
  addRepeatable(app, "--point", points, "A point, in place of a file")->type_name("X,Y,Z[,W]");
  app.add_option("--fields", fieldList,
                 "Results to give: screen,depth,viewDistance,visible,outside,ndc,clip,view,bound")
      ->type_name("NAMES");
  parse(app, argc, argv);

  FilterSetup setup = stream.setup();
  setup.given = recordsOf(points);
  stream.requireOneInput(setup, camera);
  const CameraFile file = camera.read();
  Projecting how{.camera = makeCamera(file),
                 .writing = camera.writing(file),
                 .arithmetic = precision.value(),
                 .tolerance = tolerance.value(),
                 .columns = stream.columns(3, 4),
                 .worldIsEcef = file.worldIsEcef,
                 .fields = chooseFields(fieldList, false),
                 .textFields = chooseFields(fieldList, true)};
  if (how.arithmetic && tolerance.given()) throw UsageError("--tolerance is for --precision auto, which chooses by it");
  setup.csvDefaults = {"x", "y", "z", "w"};
  if (!how.columns.empty()) setup.csvDefaults = how.columns;
  setup.writer.arrayName = "position";
  const auto makeWork = [&] { return std::make_unique<ProjectWork>(how); };
  setup.writer.exampleResults = [&](ResultSink& sink) { makeWork()->nameResults({}, sink); };
  return runFilter(setup, makeWork);
}

}  // namespace viewproj::cmd
