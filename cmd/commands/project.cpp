// viewproj project: world points to screen positions.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "camera/camera.hpp"
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

using namespace detail;
namespace {

/// Those to give. In text and f64 names have no place.
struct Fields {
  std::vector<const PointResult*> named, numbers;
  bool outsideAlways = false;
};

Fields defaultFields() {
  Fields fields;
  for (const PointResult& result : pointResults()) {
    if (result.row.given != Given::asked) fields.named.push_back(&result);
    if (result.row.given == Given::everywhere) fields.numbers.push_back(&result);
  }
  return fields;
}

Fields readFields(const std::string& option, const std::string& text) {
  constexpr std::string_view kAll = "all";
  Names<const PointResult*> known = {{kAll, nullptr}};
  for (const PointResult& result : pointResults()) known.emplace_back(result.row.name, &result);
  Fields fields{.named = {}, .numbers = {}, .outsideAlways = true};
  const std::vector<std::string> names = splitNames(option, text);
  for (const std::string& name : names) {
    const PointResult* const chosen = choose(option, name, known);
    if (chosen)
      fields.named.push_back(chosen);
    else if (names.size() > 1)
      throw UsageError(option + " all gives every result; leave the other names out");
  }
  fields.numbers = fields.named;
  if (!fields.named.empty()) return fields;
  for (const PointResult& result : pointResults()) {
    fields.named.push_back(&result);
    if (numbersOf(result.row) > 0) fields.numbers.push_back(&result);
  }
  return fields;
}

/// What --fields says of itself.
std::string helpOnFields() {
  std::string all, named, everywhere;
  const auto add = [](std::string& list, const ResultRow& row) {
    list += (list.empty() ? "" : ",") + std::string(row.name);
  };
  for (const PointResult& result : pointResults()) {
    add(all, result.row);
    if (result.row.given != Given::asked) add(named, result.row);
    if (result.row.given == Given::everywhere) add(everywhere, result.row);
  }
  return "Results to give, in this order: " + all + " or all (default: " + named + "; in text and f64: " + everywhere +
         ")";
}

struct Projecting {
  Camera camera;
  Convention writing;                   ///< of ndc, clip and view
  std::optional<Precision> arithmetic;  ///< nothing: auto, within the tolerance
  double tolerance = 0;
  PointReading reading;
  Fields fields;
  std::vector<const PointResult*> ofText;   ///< by default
  std::optional<Mat4> worldFromLocal = {};  ///< of a model that the points are in
  std::optional<Frustum> frustum = {};      ///< for segments
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

class ProjectWork final : public RecordWork {
 public:
  explicit ProjectWork(const Projecting& how)
      : how_(how), chosen_(how.arithmetic ? *how.arithmetic : precisionWithin(how.camera, how.tolerance)) {}

  Layout find(const RecordParts& record) const override { return findPoint(record, how_.reading); }

  Results results(const Layout& layout, OutputForm form) const override {
    Results rows;
    if (isSegment(layout)) {
      rows.assign(std::begin(results::kSegment), std::end(results::kSegment));
      if (layout.kind == kindSegment) rows.pop_back();
      return rows;
    }
    const bool numbers = form == OutputForm::text || form == OutputForm::f64;
    for (const PointResult* result : numbers ? how_.fields.numbers : how_.fields.named) rows.push_back(&result->row);
    return rows;
  }

  void add(const Layout& layout, const Numbers& n) override {
    Vec4 point{0, 0, 0, 1};
    if (isSegment(layout)) {
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
    if (how_.fields.numbers != how_.ofText || how_.worldFromLocal) return 0;
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
    const VisibleSegment segment = clipSegment(*how_.frustum, row.a, row.b);
    sink.flag(results::visible, segment.visible);
    const auto writeEnd = [&](const ResultRow& result, const SegmentEnd& end) {
      sink.group(result, segment.visible, [&](ResultSink& part) {
        part.number(results::t, end.t);
        part.vector(results::screen, end.screen);
        part.number(results::depth, end.depth);
        part.number(results::viewDistance, end.viewDistance);
        part.word(results::cutBy, sideName(end.side));
      });
    };
    writeEnd(results::start, segment.start);
    writeEnd(results::end, segment.end);
    if (!row.hasPixel) return;
    sink.group(results::under, segment.visible && row.pixel, [&](ResultSink& part) {
      const double t = parameterUnder(*how_.frustum, segment, *row.pixel);
      const Vec3 point = pointAlong(row.a, row.b, t);
      part.number(results::underT, t);
      part.vector(results::underPoint, point);
    });
  }

  void writeFields(const ScreenPoint& screen, const Vec4& point, ResultSink& sink) const {
    const ProjectedPoint projected{how_.camera, how_.writing, point, screen, how_.fields.outsideAlways};
    for (const PointResult* result : sink.isText() ? how_.fields.numbers : how_.fields.named)
      result->write(result->row, projected, sink);
  }

  const Projecting& how_;
  Precision chosen_;
  std::vector<Vec4> points_;  ///< a segment has a place among them that is not used
  std::vector<Vec3> positions_;
  std::vector<std::pair<std::size_t, SegmentRow>> segments_;
  std::size_t nextSegment_ = 0;
  std::vector<ScreenPoint> screen_;
};

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  PrecisionMode precision;
  std::optional<double> tolerance;
  std::vector<GivenPoint> points;
  std::optional<Fields> fields;
  std::optional<std::string> model;
};

/// Fields that no option names show nothing of the convention that is written.
CameraOptions::Shown shownOf(const std::optional<Fields>& fields) {
  bool view = false, depth = false;
  if (fields)
    for (const PointResult* result : fields->named) {
      view |= result->shows != PointResult::Shows::nothing;
      depth |= result->shows == PointResult::Shows::depth;
    }
  return {.axes = view, .range = depth, .reversal = depth, .world = view};
}

int run(const Options& o) {
  if (o.camera.lists()) return o.camera.list();
  FilterSetup setup = o.stream.setup(kPointColumns);
  setup.note = [&](const std::string& note) { o.camera.notes().say(note); };
  for (const GivenPoint& point : o.points) setup.given.push_back({point.text, point.json()});
  o.stream.requireOneInput(setup, o.camera, {"the model", isStandardInput(o.model)});
  if (o.precision.arithmetic && o.tolerance)
    throw UsageError("--tolerance is for --precision auto, which chooses by it");
  const CameraFile file = o.camera.read();
  for (const GivenPoint& point : o.points) point.requireFit(file.worldIsEcef);
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  Projecting how{.camera = makeCamera(file),
                 .writing = o.camera.writing(file),
                 .arithmetic = o.precision.arithmetic,
                 .tolerance = o.tolerance.value_or(kDefaultTolerance),
                 .reading = {.columns = setup.columns, .worldIsEcef = file.worldIsEcef, .segments = true},
                 .fields = o.fields.value_or(defaultFields()),
                 .ofText = defaultFields().numbers};
  how.frustum = viewFrustum(how.camera);
  if (o.model) how.worldFromLocal = readModel(*o.model);
  o.camera.noteWriting(file, shownOf(o.fields), "--fields with ndc or clip");
  setup.writer.arrayName = "position";
  return runFilter(setup, [&] { return std::make_unique<ProjectWork>(how); });
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
  addValues(app, "--point", kPointForm, o->points, readGivenPoint, "A point, in place of FILE and standard input");
  addValue(app, "--fields", "NAMES", o->fields, readFields, helpOnFields());
  addModelOption(app, o->model, "points");
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
