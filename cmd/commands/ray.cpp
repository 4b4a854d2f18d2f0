// viewproj ray: pixels to rays, and to the points behind them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <limits>

#include "commands/command.hpp"
#include "commands/stream_options.hpp"
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

/// A pixel, and what is behind it.
struct Cast {
  const Pixel& pixel;
  Ray ray{{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}};
  WorldPoint point{{kNaN, kNaN, kNaN}, DepthStatus::notFinite};
};

class RayWork final : public RecordWork {
 public:
  explicit RayWork(const Casting& how) : how_(how) {
    for (const bool hasDistance : {false, true})
      for (const bool isJson : {false, true}) rows_[hasDistance][isJson] = rowsFor(hasDistance, isJson);
  }

  Layout find(const RecordParts& record) const override { return findPixel(record, how_.columns); }

  Results results(const Layout& layout, OutputForm form) const override {
    const bool fixed = hasColumns(form) || form == OutputForm::f64;
    return rowsOf(hasDistance(layout), fixed, form == OutputForm::text);
  }

  void add(const Layout& layout, const Numbers& numbers) override { pixels_.push_back(toPixel(layout, numbers)); }

  void write(std::size_t i, ResultSink& sink) override {
    const Pixel& pixel = pixels_[i];
    Cast cast{.pixel = pixel};
    if (pixel.screen) {
      cast.ray = screenToRay(how_.camera, *pixel.screen, how_.precision);
      if (pixel.depth || pixel.viewDistance) cast.point = pointBehind(how_.camera, pixel);
    }
    for (const ResultRow* row : rowsOf(pixel.hasDistance, sink.hasFixedColumns(), sink.isText()))
      writeResult(*row, cast, sink);
  }

  void clear() override { pixels_.clear(); }

 private:
  /// fixed: all records get the same, with or without a point.
  const Results& rowsOf(bool hasDistance, bool fixed, bool isText) const {
    return rows_[hasDistance || fixed][!fixed && !isText];
  }

  Results rowsFor(bool hasDistance, bool isJson) const {
    if (how_.fields) return *how_.fields;
    Results rows = {&results::origin, &results::direction};
    if (hasDistance) rows.push_back(&results::point);
    if (hasDistance && isJson && how_.worldIsEcef) rows.push_back(&results::place);
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
      sink.number(row, cast.point.viewDistance);
    else if (&row == &results::bound)
      sink.number(row, isPoint ? cast.point.bound : kNaN);
    else
      writeHits(cast.ray, sink);
  }

  static void writePlace(const Vec3& point, ResultSink& sink) {
    const Geodetic place = ecefToGeodetic(point);
    sink.number(results::lat, place.lat);
    sink.number(results::lon, place.lon);
    sink.number(results::height, place.height);
  }

  void writeHits(const Ray& ray, ResultSink& sink) const {
    const std::vector<SceneHit> hits = hitsOf(ray, *how_.scene);
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

  const Casting& how_;
  std::array<std::array<Results, 2>, 2> rows_;  ///< of records without and with a distance; else than JSON, in JSON
  std::vector<Pixel> pixels_;
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
constexpr const ResultRow* kFields[] = {&results::origin,        &results::direction, &results::point, &results::place,
                                        &results::pointDistance, &results::bound,     &results::hit};

Names<const ResultRow*> fieldNames() {
  Names<const ResultRow*> names;
  for (const ResultRow* row : kFields) names.emplace_back(row->name, row);
  return names;
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
  if (how.scene && std::find(how.fields->begin(), how.fields->end(), &results::hit) == how.fields->end())
    throw UsageError("--scene and --plane are for hit, and --fields leaves it out");
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
  return runFilter(setup, [&] { return std::make_unique<RayWork>(how); });
}

}  // namespace

Action declareRay(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "Pixels to rays: each record with the ray's origin and unit direction, the point itself where there is a depth, "
      "and the nearest hit with a scene. A pixel that the lens does not reach gives null. Text and f64 have these "
      "numbers "
      "in order.");
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
  const auto readFields = [](const std::string& option, const std::string& text) {
    return chooseSeveral(option, text, fieldNames());
  };
  addValue(app, "--fields", "NAMES", o->fields, readFields,
           withNames("Results, in this order, or all", known(fieldNames()),
                     "origin and direction; with a depth point, with a scene hit"));
  addPrecision(app, o->precision);
  o->camera.add(app);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
