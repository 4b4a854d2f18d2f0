// viewproj ray: pixels to rays, and to the points behind them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <limits>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "commands/stream_options.hpp"
#include "output/output_file.hpp"
#include "output/results.hpp"
#include "records/arguments.hpp"
#include "records/points.hpp"
#include "records/scene.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The point behind the pixel, where the record tells how far away it is.
WorldPoint pointBehind(const Camera& camera, const Pixel& pixel) {
  const WorldPoint point = pixel.viewDistance ? screenToWorldAtDistance(camera, *pixel.screen, *pixel.viewDistance)
                                              : screenToWorld(camera, *pixel.screen, *pixel.depth);
  if (point.status != DepthStatus::beyond) return point;
  if (pixel.viewDistance)
    throw RecordError(0, "viewDistance " + formatNumber(*pixel.viewDistance) + " is not in front of the eye");
  if (!hasDepth(camera.projection()))
    throw RecordError(0, "a window depth needs a camera with near; a distance along the viewing axis is viewDistance");
  throw RecordError(0, "depth " + formatNumber(*pixel.depth) + " lies beyond infinity, whose window depth is " +
                           formatNumber(camera.depths().atInfinity) +
                           ": no point in front of the eye has it; a distance along the viewing axis is viewDistance");
}

struct Casting {
  Camera camera;
  Precision precision = Precision::exact;
  ColumnChoice columns;
  std::optional<Results> fields = {};  ///< nothing: what is given by default
  std::optional<std::vector<SceneObject>> scene = {};
  bool worldIsEcef = false, sceneHasEllipsoid = false;
  bool allHits = false;

  bool placesHits() const { return worldIsEcef || sceneHasEllipsoid; }
  const ResultRow& hits() const { return allHits ? results::hits : placesHits() ? results::placedHit : results::hit; }
};

bool isOfTheEarth(const SceneObject& object) {
  return std::holds_alternative<Ellipsoid>(object.shape) || std::holds_alternative<HeightSurface>(object.shape);
}

struct SceneHit {
  const SceneObject* object = nullptr;
  Hit hit;
};

/// A pixel, and what is behind it.
struct Cast {
  const Pixel& pixel;
  Ray ray{{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}};
  WorldPoint point{{kNaN, kNaN, kNaN}, DepthStatus::notFinite};
};

class RayWork final : public RecordWork {
 public:
  explicit RayWork(const Casting& how) : how_(how) {
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i] = how.fields ? *how.fields : defaultRows(i);
  }

  Layout find(const RecordParts& record) const override {
    Layout layout = findPixel(record, how_.columns);
    const auto& names = record.shape.names;
    if (std::find(names.begin(), names.end(), results::pointDistance.name) == names.end()) layout.kind |= kNoDistance;
    return layout;
  }

  Results results(const Layout& layout, OutputForm form) const override {
    const bool fixed = hasColumns(form) || form == OutputForm::f64, isText = form == OutputForm::text;
    return rowsOf(hasDistance(layout), (layout.kind & kNoDistance) != 0, fixed, isText);
  }

  void add(const Layout& layout, const Numbers& numbers) override {
    pixels_.push_back({toPixel(layout, numbers), (layout.kind & kNoDistance) != 0});
  }

  void write(std::size_t i, ResultSink& sink) override {
    const auto& [pixel, tellsDistance] = pixels_[i];
    Cast cast{.pixel = pixel};
    if (pixel.screen) {
      cast.ray = screenToRay(how_.camera, *pixel.screen, how_.precision);
      if (pixel.depth || pixel.viewDistance) cast.point = pointBehind(how_.camera, pixel);
    }
    for (const ResultRow* row : rowsOf(pixel.hasDistance, tellsDistance, sink.hasFixedColumns(), sink.isText()))
      writeResult(*row, cast, sink);
  }

  void clear() override { pixels_.clear(); }

 private:
  static constexpr unsigned kNoDistance = 1u << 16;  ///< of a layout: no field is called viewDistance

  // Of the rows of a record.
  static constexpr std::size_t kHasDistance = 1, kTellsDistance = 2, kFixed = 4, kText = 8;

  const Results& rowsOf(bool hasDistance, bool tellsDistance, bool fixed, bool isText) const {
    return rows_[(hasDistance ? kHasDistance : 0) | (tellsDistance ? kTellsDistance : 0) | (fixed ? kFixed : 0) |
                 (isText ? kText : 0)];
  }

  Results defaultRows(std::size_t kind) const {
    const bool isJson = (kind & (kFixed | kText)) == 0;
    Results rows = {&results::origin, &results::direction};
    if (kind & (kHasDistance | kFixed)) {
      rows.push_back(&results::point);
      if (isJson && how_.worldIsEcef) rows.push_back(&results::place);
      if (isJson && (kind & kTellsDistance)) rows.push_back(&results::pointDistance);
    }
    if (how_.scene) rows.push_back(&how_.hits());
    return rows;
  }

  void writeResult(const ResultRow& row, const Cast& cast, ResultSink& sink) const {
    const bool isPoint = cast.point.status == DepthStatus::point;
    if (&row == &results::origin)
      sink.vector(row, cast.ray.origin);
    else if (&row == &results::direction)
      sink.vector(row, cast.ray.direction);
    else if (&row == &results::point)
      sink.vector(row, cast.point.position);
    else if (&row == &results::place)
      sink.object(row, isPoint ? 1 : 0, [&](ResultSink& part, std::size_t) { writePlace(cast.point.position, part); });
    else if (&row == &results::pointDistance)
      sink.number(row, distanceOf(cast));
    else if (&row == &results::pixelSize)
      sink.vector(row, pixelSize(how_.camera, distanceOf(cast)));
    else if (&row == &results::pointBound)
      sink.number(row, isPoint ? cast.point.bound : kNaN);
    else
      writeHits(cast.ray, sink);
  }

  /// Of the point behind the pixel, or of what the ray hits where the record has none.
  double distanceOf(const Cast& cast) const {
    if (!std::isnan(cast.point.viewDistance) || !how_.scene || cast.pixel.hasDistance) return cast.point.viewDistance;
    const std::vector<SceneHit> hits = hitsOf(cast.ray);
    return hits.empty() ? kNaN : worldToScreen(how_.camera, hits.front().hit.point).viewDistance;
  }

  static void writePlace(const Vec3& point, ResultSink& sink) {
    const Geodetic place = ecefToGeodetic(point);
    sink.number(results::lat, place.lat);
    sink.number(results::lon, place.lon);
    sink.number(results::height, place.height);
  }

  void writeHits(const Ray& ray, ResultSink& sink) const {
    const std::vector<SceneHit> hits = hitsOf(ray);
    if (how_.allHits) {
      sink.object(results::hits, hits.size(), [&](ResultSink& part, std::size_t i) { writeHit(hits[i], part); });
      return;
    }
    const SceneHit none{nullptr, {kNaN, {kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}}};
    sink.object(how_.hits(), hits.empty() ? 0 : 1,
                [&](ResultSink& part, std::size_t) { writeHit(hits.empty() ? none : hits.front(), part); });
  }

  void writeHit(const SceneHit& hit, ResultSink& sink) const {
    sink.text(results::hitId, hit.object ? std::string_view(hit.object->id) : "");
    sink.number(results::distance, hit.hit.distance);
    sink.vector(results::hitPoint, hit.hit.point);
    sink.vector(results::normal, hit.hit.normal);
    // Only points of the Earth are places; where columns are fixed, they are empty for the others.
    const bool onEllipsoid = hit.object && isOfTheEarth(*hit.object);
    const bool isPlace = onEllipsoid || (hit.object && how_.worldIsEcef);
    if (isPlace || (sink.hasFixedColumns() && how_.placesHits()))
      writePlace(isPlace ? hit.hit.point : Vec3{kNaN, kNaN, kNaN}, sink);
  }

  /// Nearest first; of hits at the same distance, in the scene's order.
  std::vector<SceneHit> hitsOf(const Ray& ray) const {
    std::vector<SceneHit> found;
    for (const SceneObject& object : *how_.scene)
      std::visit(
          [&](const auto& shape) {
            for (const Hit& hit : intersect(ray, shape)) found.push_back({&object, hit});
          },
          object.shape);
    std::stable_sort(found.begin(), found.end(),
                     [](const SceneHit& a, const SceneHit& b) { return a.hit.distance < b.hit.distance; });
    return found;
  }

  const Casting& how_;
  std::array<Results, 16> rows_;
  std::vector<std::pair<Pixel, bool>> pixels_;  ///< and whether no field is called viewDistance
};

/// A pixel of the command line as a JSON record.
GivenRecord readPixel(const std::string& option, const std::string& text) {
  const std::vector<double> n = readPixelNumbers(option, text);
  std::string json = "{\"screen\":[" + formatNumber(n[0]) + "," + formatNumber(n[1]) + "]";
  if (n.size() > 2) json += ",\"depth\":" + formatNumber(n[2]);
  return {option + " " + text, json + "}"};
}

/// What --fields can name: all that `ray` writes, of a hit the one name. Those of the scene are settled once it is
/// read.
constexpr const ResultRow* kFields[] = {
    &results::origin,        &results::direction, &results::point,      &results::place,
    &results::pointDistance, &results::pixelSize, &results::pointBound, &results::hit};

std::string helpOnFields() {
  std::vector<std::string_view> names;
  for (const ResultRow* row : kFields) names.push_back(row->name);
  return "Results, in this order: " + joined(names) +
         ", or all (default: origin and direction; with a depth point, with a scene hit)";
}

Several<const ResultRow*> readFields(const std::string& option, const std::string& text) {
  Names<const ResultRow*> names;
  for (const ResultRow* row : kFields) names.emplace_back(row->name, row);
  return chooseSeveral(option, text, names);
}

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  Precision precision = Precision::exact;
  std::optional<Several<const ResultRow*>> fields;
  std::vector<GivenRecord> pixels;
  std::optional<std::string> scene;
  std::vector<Plane> planes;
  bool allHits = false;
};

/// Throws UsageError for those that need what is not there; of all, those are left out.
void settleFields(Casting& how, const Several<const ResultRow*>& fields) {
  how.fields = fields.named;
  if (fields.all)
    for (const ResultRow* row : kFields)
      if ((row != &results::place || how.worldIsEcef) && (row != &results::hit || how.scene))
        how.fields->push_back(row);
  const auto has = [&](const ResultRow& row) {
    return std::find(how.fields->begin(), how.fields->end(), &row) != how.fields->end();
  };
  if (!has(results::hit) && how.allHits) throw UsageError("--all-hits is of hits, and --fields leaves hit out");
  if (how.scene && !has(results::hit) && !has(results::pointDistance) && !has(results::pixelSize))
    throw UsageError("--scene is for hit, viewDistance and pixelSize, and --fields leaves these out");
  for (const ResultRow*& row : *how.fields) {
    if (row == &results::place && !how.worldIsEcef)
      throw UsageError("--fields place needs a camera that stands on the Earth");
    if (row != &results::hit) continue;
    if (!how.scene) throw UsageError("--fields hit needs --scene or --plane");
    row = &how.hits();
  }
}

int run(const Options& o) {
  const bool hasScene = o.scene || !o.planes.empty();
  if (!hasScene && o.allHits) throw UsageError("--all-hits needs --scene or --plane");
  FilterSetup setup = o.stream.setup(kPixelColumns);
  setup.given = o.pixels;
  o.stream.reads(setup);
  const CameraFile file = o.camera.read();
  Casting how{.camera = makeCamera(file),
              .precision = o.precision,
              .columns = setup.columns,
              .worldIsEcef = file.worldIsEcef,
              .allHits = o.allHits};
  if (hasScene) {
    how.scene.emplace();
    if (o.scene) how.scene = readScene(*o.scene, file.worldIsEcef);
    for (const Plane& plane : o.planes) how.scene->push_back({std::to_string(how.scene->size()), plane});
    for (const SceneObject& object : *how.scene) how.sceneHasEllipsoid |= isOfTheEarth(object);
  }
  if (o.fields) settleFields(how, *o.fields);
  setup.writer.arrayName = "screen";
  setup.writer.arraySize = 2;
  setup.writer.extraName = "depth";
  setup.note = note;
  return runFilter(setup, [&] { return std::make_unique<RayWork>(how); });
}

}  // namespace

Action declareRay(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "Pixels to rays: each record of FILE with the ray's origin and unit direction, the point itself where there is a "
      "depth or viewDistance, and the nearest hit with a scene. Text and f64 have these numbers in order.");
  app.footer(
      "Examples:\n"
      "  viewproj ray --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 1280x720 --pixel 640,360 --to table\n"
      "  viewproj ray --position 0,0,9 --target 0,0,0 --fov-y 60 --viewport 640x480 \\\n"
      "    --pixel 320,240 --plane z=0");
  o->stream.add(app, "pixels");
  addValues(app, "--pixel", "X,Y[,DEPTH]", o->pixels, readPixel, "A pixel, in place of FILE");
  addScene(app, o->scene, "Shapes to hit");
  addValues(app, "--plane", "z=0|A,B,C,D", o->planes, readPlaneArgument,
            "A plane to hit: x=.., y=.., z=.. or ax+by+cz+d=0");
  app.add_flag("--all-hits", o->allHits, "Every hit, nearest first");
  addValue(app, "--fields", "NAMES", o->fields, readFields, helpOnFields());
  addPrecision(app, o->precision);
  o->camera.add(app);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
