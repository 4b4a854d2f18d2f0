// viewproj ray: pixels to rays, and to the points behind them.
#include <algorithm>
#include <atomic>
#include <limits>

#include "camera/camera.hpp"
#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/points.hpp"
#include "input/scene.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"
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
  throw RecordError(0, "depth " + formatNumber(*pixel.depth) + " lies beyond infinity, whose window depth is " +
                           formatNumber(parts(camera).depthAtInfinity) + ": no point in front of the eye has it");
}

struct Casting {
  Camera camera;
  Precision arithmetic = Precision::exact;
  RayOrigin origin = RayOrigin::eye;
  bool wantBound = false;
  ColumnChoice columns;
  std::optional<std::vector<SceneObject>> scene = {};
  bool sceneHasEllipsoid = false;
  bool allHits = false;
  bool clipped = false;                           ///< hits between near and far alone
  mutable std::atomic<bool> hadDistance = false;  ///< of a record
};

struct SceneHit {
  const SceneObject* object = nullptr;
  Hit hit;
};

class RayWork final : public RecordWork {
 public:
  explicit RayWork(const Casting& how) : how_(how) {}

  Layout find(const RecordParts& record) const override { return findPixel(record, how_.columns); }
  Results results(const Layout& layout, OutputForm form) const override {
    Results rows = {&results::origin, &results::direction};
    if (hasDistance(layout) || hasColumns(form) || form == OutputForm::f64) {
      rows.push_back(&results::point);
      if (how_.wantBound) rows.push_back(&results::pointBound);
    }
    if (how_.scene) rows.push_back(how_.allHits ? &results::hits : &hitRow());
    return rows;
  }

  void add(const Layout& layout, const Numbers& numbers) override { pixels_.push_back(toPixel(layout, numbers)); }
  void write(std::size_t i, ResultSink& sink) override { writeRay(pixels_[i], sink); }
  void clear() override { pixels_.clear(); }

 private:
  void writeRay(const Pixel& pixel, ResultSink& sink) const {
    Ray ray{{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}};
    WorldPoint point{{kNaN, kNaN, kNaN}, DepthStatus::notFinite};
    if (pixel.screen) {
      ray = screenToRay(how_.camera, *pixel.screen, how_.arithmetic, how_.origin);
      if (pixel.depth || pixel.viewDistance) point = pointBehind(how_.camera, pixel);
    }
    sink.vector(results::origin, ray.origin);
    sink.vector(results::direction, ray.direction);
    if (pixel.hasDistance || sink.hasFixedColumns()) {
      sink.vector(results::point, point.position);
      if (how_.wantBound) sink.number(results::pointBound, point.status == DepthStatus::point ? point.bound : kNaN);
      if (pixel.hasDistance) how_.hadDistance.store(true, std::memory_order_relaxed);
    }
    if (how_.scene) writeHits(ray, sink);
  }

  const ResultRow& hitRow() const { return how_.sceneHasEllipsoid ? results::placedHit : results::hit; }

  void writeHits(const Ray& ray, ResultSink& sink) const {
    const std::vector<SceneHit> hits = hitsOf(ray);
    if (how_.allHits) {
      sink.list(results::hits, hits.size(), [&](ResultSink& part, std::size_t i) { writeHit(hits[i], part); });
      return;
    }
    const SceneHit none{nullptr, {kNaN, {kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}}};
    sink.group(hitRow(), !hits.empty(), [&](ResultSink& part) { writeHit(hits.empty() ? none : hits.front(), part); });
  }

  void writeHit(const SceneHit& hit, ResultSink& sink) const {
    sink.json(results::hitId, hit.object ? std::string_view(hit.object->id) : "null");
    sink.number(results::distance, hit.hit.distance);
    sink.vector(results::hitPoint, hit.hit.point);
    sink.vector(results::normal, hit.hit.normal);
    // Only points of the Earth are places; where columns are fixed, they are empty for the others.
    const bool onEllipsoid = hit.object && std::holds_alternative<Ellipsoid>(hit.object->shape);
    if (!onEllipsoid && !(sink.hasFixedColumns() && how_.sceneHasEllipsoid)) return;
    const Geodetic place = onEllipsoid ? ecefToGeodetic(hit.hit.point) : Geodetic{kNaN, kNaN, kNaN};
    sink.number(results::lat, place.lat);
    sink.number(results::lon, place.lon);
    sink.number(results::height, place.height);
  }

  /// Nearest first; of hits at the same distance, in the scene's order.
  std::vector<SceneHit> hitsOf(const Ray& ray) const {
    std::vector<SceneHit> found;
    for (const SceneObject& object : *how_.scene)
      std::visit(
          [&](const auto& shape) {
            for (const Hit& hit : intersect(ray, shape))
              if (!how_.clipped || isBetweenNearAndFar(hit)) found.push_back({&object, hit});
          },
          object.shape);
    std::stable_sort(found.begin(), found.end(),
                     [](const SceneHit& a, const SceneHit& b) { return a.hit.distance < b.hit.distance; });
    return found;
  }

  bool isBetweenNearAndFar(const Hit& hit) const {
    const ScreenPoint p = worldToScreen(how_.camera, hit.point);
    return p.status == PointStatus::inFront && (p.outside & (sideNear | sideFar)) == 0;
  }

  const Casting& how_;
  std::vector<Pixel> pixels_;
};

/// A pixel of the command line as a JSON record.
struct GivenPixel {
  GivenRecord record;
  bool hasDepth = false;
};

GivenPixel readPixel(const std::string& option, const std::string& text) {
  const std::vector<double> n = readPixelNumbers(option, text);
  std::string json = "{\"screen\":[" + formatNumber(n[0]) + "," + formatNumber(n[1]) + "]";
  if (n.size() > 2) json += ",\"depth\":" + formatNumber(n[2]);
  return {{option + " " + text, json + "}"}, n.size() > 2};
}

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  PrecisionMode precision;
  std::vector<GivenPixel> pixels;
  RayOrigin from = RayOrigin::eye;
  std::optional<std::string> scene;
  bool wantBound = false, allHits = false, clipped = false;
};

int run(const Options& o) {
  if (o.camera.lists()) return o.camera.list();
  if (!o.scene && (o.allHits || o.clipped))
    throw UsageError(std::string(o.allHits ? "--all-hits" : "--clipped") + " is for --scene, which is not given");
  FilterSetup setup = o.stream.setup(kPixelColumns);
  bool mayHaveDepth = o.pixels.empty();
  for (const GivenPixel& pixel : o.pixels) {
    setup.given.push_back(pixel.record);
    mayHaveDepth = mayHaveDepth || pixel.hasDepth;
  }
  if (o.wantBound && !mayHaveDepth)
    throw UsageError("--bound is of the point at a pixel's DEPTH, and --pixel gives none");
  o.stream.requireOneInput(setup, o.camera, {"the scene", isStandardInput(o.scene)});
  // Rays are within kRayDirectionBound in standard already: fast and auto need nothing else.
  const bool exact = o.precision.arithmetic == Precision::exact;
  Casting how{.camera = makeCamera(o.camera.read()),
              .arithmetic = exact ? Precision::exact : Precision::standard,
              .origin = o.from,
              .wantBound = o.wantBound,
              .columns = setup.columns,
              .allHits = o.allHits,
              .clipped = o.clipped};
  if (o.scene) {
    how.scene = readScene(*o.scene);
    for (const SceneObject& object : *how.scene)
      how.sceneHasEllipsoid |= std::holds_alternative<Ellipsoid>(object.shape);
  }
  setup.writer.arrayName = "screen";
  setup.writer.arraySize = 2;
  setup.writer.extraName = "depth";
  setup.note = [&](const std::string& note) { o.camera.notes().say(note); };
  const int status = runFilter(setup, [&] { return std::make_unique<RayWork>(how); });
  if (o.wantBound && !how.hadDistance)
    o.camera.notes().say("--bound changes nothing here: it is of the point at a depth, and no pixel has one");
  return status;
}

}  // namespace

Action defineRay(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "Pixels to rays: origin and unit direction, with a depth or viewDistance the point itself, and what of a scene "
      "the ray hits. Text has 6 numbers a record, origin and direction, or 9 with the point where there is a depth; "
      "f64 always 9, NaN where there is no point. --bound adds one after the point; --scene adds 7 at the end, "
      "distance, point and normal of the hit, NaN where there is none: 13 without a point, 16 with it; and if the "
      "scene has an ellipsoid, 3 more: lat, lon, height. With --columns, a third column called depth or viewDistance "
      "is that, one of another name a depth, and a distance that is not named is not used.");
  app.footer(
      "viewproj ray -c samples/picking-a-pixel/camera.json --scene samples/picking-in-a-scene/scene.json \\\n"
      "  --pixel 640,360 --to table");
  o->camera.add(app);
  o->stream.add(app, "pixels");
  static constexpr std::pair<std::string_view, RayOrigin> kPlaces[] = {{"eye", RayOrigin::eye},
                                                                       {"near", RayOrigin::nearPlane}};
  addPrecision(app, o->precision);
  addValues(app, "--pixel", "X,Y[,DEPTH]", o->pixels, readPixel,
            "A pixel, with a window depth if known, in place of FILE and standard input");
  addChoice(app, "--ray-from", "PLACE", o->from, rowsOf(kPlaces),
            "Where rays begin, on the plane through the eye or on the near plane");
  app.add_flag("--bound", o->wantBound,
               "Give each point's bound: how far it can be from the true one if its depth was rounded to double");
  addSceneOption(app, o->scene, ", to shoot at: the nearest hit of each ray");
  app.add_flag("--all-hits", o->allHits, "Every hit with the scene, nearest first");
  app.add_flag("--clipped", o->clipped, "Only hits between near and far");
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
