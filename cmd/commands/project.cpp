// viewproj project: world points to screen positions.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/model.hpp"
#include "input/points.hpp"
#include "output/side_names.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"
#include "text/names.hpp"
#include "viewproj/clip.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

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

Fields chooseFields(const std::optional<std::vector<ResultField>>& asked, bool asText) {
  using enum ResultField;
  if (asked) return {*asked, true};
  return {asText ? std::vector{screen, depth} : std::vector{screen, depth, viewDistance, visible, outside}};
}

/// The names of what a point lies beyond, in the interface's order.
class Sides {
 public:
  explicit Sides(const ScreenPoint& p) {
    if (p.status == PointStatus::behind) names_[count_++] = "behind";
    for (Side side : kSides)
      if (p.outside & side) names_[count_++] = sideName(side);
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
  std::optional<Mat4> worldFromLocal = {};  ///< of a model that the points are in
  Frustum frustum = {};                     ///< for segments
};

/// A segment among the points, and the pixel to find a point of it under.
struct SegmentRow {
  Vec3 a = {}, b = {};
  std::optional<Vec2> pixel = {};
  bool hasPixel = false;
};

/// Eight at a time, which compilers make vector instructions of: zero times a number is a number.
bool areFinite(std::span<const Vec3> points) {
  constexpr std::size_t kStep = 8;
  if (points.empty()) return true;
  const double* const numbers = &points[0].x;
  const std::size_t count = 3 * points.size();
  std::array<double, kStep> zeros = {};
  std::size_t i = 0;
  for (; i + kStep <= count; i += kStep)
    for (std::size_t lane = 0; lane < kStep; ++lane) zeros[lane] += 0 * numbers[i + lane];
  for (; i < count; ++i) zeros[0] += 0 * numbers[i];
  return std::accumulate(zeros.begin(), zeros.end(), 0.0) == 0;
}

/// How many from the start are finite points whose numbers on the screen exist or are NaN. What overflowed has no
/// value: the writer knows what becomes of it.
std::size_t countUsable(std::span<const Vec3> points, std::span<const Vec3> screen) {
  if (areFinite(screen)) return screen.size();  // then so are the points
  const auto overflowed = [](const Vec3& p) { return std::isinf(p.x) || std::isinf(p.y) || std::isinf(p.z); };
  std::size_t i = 0;
  while (i < screen.size() && isFinite(points[i]) && !overflowed(screen[i])) ++i;
  return i;
}

bool isScreenAndDepth(const Fields& fields) {
  return fields.wanted == std::vector{ResultField::screen, ResultField::depth};
}

class ProjectWork final : public RecordWork {
 public:
  explicit ProjectWork(const Projecting& how)
      : how_(how), chosen_(how.arithmetic ? *how.arithmetic : precisionWithin(how.camera, how.tolerance)) {}

  Layout find(const RecordParts& record) const override {
    if (const auto segment = findSegment(record)) return *segment;
    return findPoint(record, how_.columns, how_.worldIsEcef);
  }

  void nameResults(const Layout& layout, ResultSink& sink) const override {
    if (layout.kind == kindSegment || layout.kind == kindSegmentAndPixel)
      writeSegment({.hasPixel = layout.kind == kindSegmentAndPixel}, sink);
    else
      writeFields({}, {0, 0, 0, 1}, sink);
  }

  void add(const Layout& layout, const Numbers& n) override {
    Vec4 point{0, 0, 0, 1};
    if (layout.kind == kindSegment || layout.kind == kindSegmentAndPixel) {
      SegmentRow segment{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {}, layout.kind == kindSegmentAndPixel};
      if (segment.hasPixel && !std::isnan(n[6])) segment.pixel = Vec2{n[6], n[7]};
      segment.a = placed(segment.a);
      segment.b = placed(segment.b);
      segments_.emplace_back(points_.size(), segment);
    } else {
      point = toPoint(layout, n);
      if (how_.worldFromLocal) point = toWorld(*how_.worldFromLocal, point);
    }
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

  void write(std::size_t i, ResultSink& sink) override {
    if (nextSegment_ < segments_.size() && segments_[nextSegment_].first == i)
      writeSegment(segments_[nextSegment_++].second, sink);
    else
      writeFields(screen_[i], points_[i], sink);
  }

  void clear() override {
    segments_.clear();
    nextSegment_ = 0;
    points_.clear();
    positions_.clear();
  }

  std::size_t convert(std::span<const double> in, TextBuffer& out) override {
    if (!isScreenAndDepth(how_.textFields) || how_.worldFromLocal) return 0;
    const std::size_t count = in.size() / 3;
    char* const room = out.room(count * sizeof(Vec3));
    const std::span points(reinterpret_cast<const Vec3*>(in.data()), count);
    const std::span screen(reinterpret_cast<Vec3*>(room), count);
    if (how_.arithmetic)
      worldToScreen(how_.camera, points, screen, chosen_);
    else
      worldToScreenWithin(how_.camera, how_.tolerance, points, screen);
    const std::size_t good = countUsable(points, screen);
    out.written(room + good * sizeof(Vec3));
    return good;
  }

 private:
  Vec3 placed(const Vec3& local) const {
    if (!how_.worldFromLocal) return local;
    const Vec4 world = toWorld(*how_.worldFromLocal, {local.x, local.y, local.z, 1});
    return {world.x, world.y, world.z};
  }

  void writeSegment(const SegmentRow& row, ResultSink& sink) const {
    if (sink.isText() || sink.hasFixedColumns())
      throw RecordError(0, "has a segment, whose results have no place in columns; write JSON");
    const VisibleSegment segment = clipSegment(how_.frustum, row.a, row.b);
    sink.flag("visible", segment.visible);
    const auto writeEnd = [&](std::string_view name, const SegmentEnd& end) {
      sink.group(name, segment.visible, [&](ResultSink& part) {
        part.number("t", end.t);
        part.vector("screen", end.screen);
        part.number("depth", end.depth);
        part.number("viewDistance", end.viewDistance);
        part.word("cutBy", sideName(end.side));
      });
    };
    writeEnd("start", segment.start);
    writeEnd("end", segment.end);
    if (!row.hasPixel) return;
    sink.group("under", segment.visible && row.pixel, [&](ResultSink& part) {
      const double t = parameterUnder(how_.frustum, segment, *row.pixel);
      const Vec3 point = pointAlong(row.a, row.b, t);
      part.number("t", t);
      part.vector("point", point);
    });
  }

  void writeFields(const ScreenPoint& p, const Vec4& point, ResultSink& sink) const {
    const Fields& fields = sink.isText() ? how_.textFields : how_.fields;
    const Camera& camera = how_.camera;
    for (ResultField field : fields.wanted) switch (field) {
        case ResultField::screen:
          sink.vector("screen", Vec2{p.x, p.y});
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
        case ResultField::ndc:
          sink.vector("ndc", worldToNdc(camera, point, how_.writing));
          break;
        case ResultField::clip:
          sink.vector("clip", worldToClip(camera, point, how_.writing));
          break;
        case ResultField::view:
          sink.vector("view", worldToView(camera, point, how_.writing));
          break;
        case ResultField::bound:
          sink.number("bound", boundOfPoint(camera, point, p.precision).screen);
          break;
      }
  }

  const Projecting& how_;
  Precision chosen_;
  std::vector<Vec4> points_;  ///< a segment has a place among them that is not used
  std::vector<Vec3> positions_;
  std::vector<std::pair<std::size_t, SegmentRow>> segments_;
  std::size_t nextSegment_ = 0;
  std::vector<ScreenPoint> screen_;
};

/// A point of the command line as a JSON record.
GivenRecord readPoint(const std::string& option, const std::string& text) {
  std::string json;
  for (double number : readPointNumbers(option, text)) json += (json.empty() ? "[" : ",") + formatNumber(number);
  return {option + " " + text, json + "]"};
}

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  PrecisionMode precision;
  std::optional<double> tolerance;
  std::vector<GivenRecord> points;
  std::optional<std::vector<ResultField>> fields;
  std::optional<std::string> model;
};

/// Fields that no option names show nothing of the convention that is written.
CameraOptions::Shown shownOf(const std::optional<std::vector<ResultField>>& fields) {
  const auto has = [&](ResultField field) {
    return fields && std::find(fields->begin(), fields->end(), field) != fields->end();
  };
  const bool depth = has(ResultField::ndc) || has(ResultField::clip), view = has(ResultField::view);
  return {.axes = depth || view, .range = depth, .reversal = depth, .world = depth || view};
}

int run(const Options& o) {
  if (o.camera.lists()) return o.camera.list();
  FilterSetup setup = o.stream.setup(kPointCoordinates);
  setup.given = o.points;
  o.stream.requireOneInput(setup, o.camera, {"the model", isStandardInput(o.model)});
  if (o.precision.arithmetic && o.tolerance)
    throw UsageError("--tolerance is for --precision auto, which chooses by it");
  const CameraFile file = o.camera.read();
  Projecting how{.camera = makeCamera(file),
                 .writing = o.camera.writing(file),
                 .arithmetic = o.precision.arithmetic,
                 .tolerance = o.tolerance.value_or(kDefaultTolerance),
                 .columns = setup.columns,
                 .worldIsEcef = file.worldIsEcef,
                 .fields = chooseFields(o.fields, false),
                 .textFields = chooseFields(o.fields, true)};
  how.frustum = viewFrustum(how.camera);
  if (o.model) how.worldFromLocal = readModel(*o.model);
  o.camera.noteWriting(file, shownOf(o.fields), "--fields with ndc or clip");
  setup.writer.arrayName = "position";
  const auto makeWork = [&] { return std::make_unique<ProjectWork>(how); };
  setup.writer.exampleResults = [&](ResultSink& sink) { makeWork()->nameResults({}, sink); };
  return runFilter(setup, makeWork);
}

}  // namespace

Action defineProject(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "World points to screen positions: every record of FILE comes out with its pixel, its depth and whether it is "
      "visible.");
  app.footer("viewproj project -c samples/cornell-box/camera.json samples/cornell-box/quads.csv");
  o->camera.add(app);
  o->camera.addWriting(app);
  o->stream.add(app, "points");
  addPrecision(app, o->precision);
  addTolerance(app, o->tolerance);
  addValues(app, "--point", "X,Y,Z[,W]", o->points, readPoint, "A point, in place of FILE and standard input");
  addChoices(app, "--fields", o->fields, namesOf(kFields), "Results to give",
             "the first five; in text and f64 the first two");
  addModelOption(app, o->model, "points");
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
