// viewproj ray: pixels to rays, and to the points behind them.
#include <algorithm>
#include <array>
#include <cmath>

#include "camera/plain_camera.hpp"
#include "camera/plain_vectors.hpp"
#include "camera/sea_level.hpp"
#include "commands/command.hpp"
#include "commands/ground_height.hpp"
#include "commands/record_camera_options.hpp"
#include "commands/stream_options.hpp"
#include "numbers/vectors.hpp"
#include "output/results.hpp"
#include "records/arguments.hpp"
#include "records/model.hpp"
#include "records/points.hpp"
#include "records/scene.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// The point at a distance from the eye.
WorldPoint pointAtRange(const Camera& camera, const Ray& ray, double range) {
  if (!(range >= 0)) throw RecordError(0, "range " + formatNumber(range) + " is below 0");
  if (camera.projection().isOrthographic())
    throw RecordError(0, "range is of an eye, and the camera is orthographic; its distance is viewDistance");
  const Vec3 &o = ray.origin, &d = ray.direction, forward = camera.pose().forward();
  if (!std::isfinite(d.x)) return {{NAN, NAN, NAN}, DepthStatus::noRay};
  const Vec3 at{o.x + range * d.x, o.y + range * d.y, o.z + range * d.z};
  const PoseError pose = camera.pose().error();
  constexpr double kRounding = 0x1p-53;
  return {.position = at,
          .bound = range * (kRayDirectionBound + 2 * kRounding + pose.angle) + pose.eye +
                   kRounding * (std::fabs(at.x) + std::fabs(at.y) + std::fabs(at.z)),
          .viewDistance = range * (d.x * forward.x + d.y * forward.y + d.z * forward.z)};
}

/// The point behind the pixel, where the record tells how far away it is.
WorldPoint pointBehind(const Camera& camera, const Pixel& pixel) {
  const WorldPoint point = pixel.viewDistance ? screenToWorldAtDistance(camera, *pixel.screen, *pixel.viewDistance)
                                              : screenToWorld(camera, *pixel.screen, *pixel.depth);
  if (point.status != DepthStatus::beyond) return point;
  // A ray through a lens may point backwards: no point of it has a depth, or a distance of the other sign.
  if (lensOf(camera) && (pixel.viewDistance || hasDepth(camera.projection()))) {
    const WorldPoint ahead = screenToWorldAtDistance(camera, *pixel.screen, 1);
    if (pixel.viewDistance || ahead.status == DepthStatus::beyond) return point;
  }
  if (pixel.viewDistance)
    throw RecordError(0, "viewDistance " + formatNumber(*pixel.viewDistance) + " is not in front of the eye");
  if (!hasDepth(camera.projection()))
    throw RecordError(0,
                      "a window depth needs a camera with near; a distance along the viewing axis is viewDistance, as "
                      "in X,Y,viewDistance=D");
  throw RecordError(0, "no point has the window depth " + formatNumber(*pixel.depth) + ": that of infinity is " +
                           formatNumber(camera.depths().atInfinity) +
                           "; a distance along the viewing axis is viewDistance");
}

WorldPoint pointOfHit(const Camera& camera, const Hit& hit) {
  const Vec3 way = sum(hit.point, -1, camera.pose().eye());
  return {.position = hit.point, .bound = NAN, .viewDistance = detail::dot(way, camera.pose().forward())};
}

struct Casting {
  ColumnChoice columns;
  std::optional<ResultRows> fields = {};  ///< nothing: what is given by default
  std::optional<std::vector<SceneObject>> scene = {};
  bool worldIsEcef = false, sceneHasEllipsoid = false;
  bool allHits = false;
  std::optional<Mat4> localFromWorld = {}, worldFromLocal = {};  ///< of a model, whose coordinates the results have

  Vec3 placed(const Vec3& world) const {
    if (!localFromWorld) return world;
    const Vec4 local = toWorld(*localFromWorld, {world.x, world.y, world.z, 1});
    return {local.x, local.y, local.z};
  }
  /// Of unit length, by the columns of m in place of its rows for a normal.
  static Vec3 turned(const std::optional<Mat4>& m, const Vec3& world, bool byColumns) {
    if (!m) return world;
    Vec3 local;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) local[i] += (byColumns ? (*m)[j][i] : (*m)[i][j]) * world[j];
    return unit(local);
  }

  bool placesHits() const { return worldIsEcef || sceneHasEllipsoid; }
  const ResultRow& hits() const {
    if (!placesHits()) return allHits ? results::hits : results::hit;
    if (hasGeoid()) return allHits ? results::seaHits : results::seaHit;
    return allHits ? results::hits : results::placedHit;
  }
};

bool isOfTheEarth(const SceneObject& object) {
  return std::holds_alternative<Ellipsoid>(object.shape) || std::holds_alternative<HeightSurface>(object.shape);
}

const ResultRow& placeRow() { return hasGeoid() ? results::seaPlace : results::place; }

/// A pixel, and what is behind it.
struct Cast {
  const Pixel& pixel;
  const RecordCamera& from;
  const Camera& camera = from.camera;
  Ray ray;  ///< NaN where the record has no pixel
  WorldPoint point{{NAN, NAN, NAN}, DepthStatus::notFinite};
  std::vector<SceneHit> hits = {};
};

class Caster final : public RecordProcessor {
 public:
  Caster(const Casting& how, OutputForm to)
      : how_(how),
        isFixed_(hasColumns(to) || to == OutputForm::f64),
        pointless_(rowsFor(isFixed_, !hasNumbersOnly(to) && !hasColumns(to))),
        pointed_(rowsFor(true, !hasNumbersOnly(to) && !hasColumns(to))) {}

  NumberPlan locate(const RecordView& record) const override { return findPixel(record, how_.columns); }
  ResultRows rows(const NumberPlan& plan) const override { return rowsOf(hasDistance(plan)); }
  void add(const NumberPlan& plan, const Numbers& numbers, const RecordCamera& camera) override {
    pixels_.push_back(toPixel(plan, numbers));
    screens_.push_back(pixels_.back().screen.value_or(Vec2{NAN, NAN}));
    cameras_.push_back(&camera);
  }
  void clear() override {
    pixels_.clear();
    screens_.clear();
    cameras_.clear();
  }

  void compute() override {
    rays_.resize(pixels_.size());
    for (std::size_t begin = 0, end = 0; begin < pixels_.size(); begin = end) {
      while (end < pixels_.size() && cameras_[end] == cameras_[begin]) ++end;
      screenToRays(cameras_[begin]->camera, std::span(screens_).subspan(begin, end - begin),
                   std::span(rays_).subspan(begin, end - begin));
    }
  }

  void results(std::size_t i, ResultValues& values) override {
    const Pixel& pixel = pixels_[i];
    Cast cast{.pixel = pixel, .from = *cameras_[i], .ray = rays_[i]};
    if (pixel.screen) {
      if (pixel.depth || pixel.viewDistance)
        cast.point = pointBehind(cast.camera, pixel);
      else if (pixel.range)
        cast.point = pointAtRange(cast.camera, cast.ray, *pixel.range);
    }
    if (how_.scene) cast.hits = hitsOf(cast.camera, cast.ray, *how_.scene);
    if (!pixel.hasDistance && !cast.hits.empty()) cast.point = pointOfHit(cast.camera, cast.hits[0].hit);
    for (const ResultRow* row : rowsOf(pixel.hasDistance)) addResult(*row, cast, values);
  }

 private:
  const ResultRows& rowsOf(bool hasDistance) const { return hasDistance ? pointed_ : pointless_; }

  ResultRows rowsFor(bool hasDistance, bool isJson) const {
    if (how_.fields) return *how_.fields;
    ResultRows rows = {&results::origin, &results::direction};
    if (hasDistance) rows.push_back(&results::point);
    if (hasDistance && isJson && how_.worldIsEcef) rows.push_back(&placeRow());
    if (how_.scene) rows.push_back(&how_.hits());
    return rows;
  }

  void addResult(const ResultRow& row, const Cast& cast, ResultValues& values) const {
    const bool isPoint = cast.point.status == DepthStatus::point;
    if (&row == &results::origin) {
      values.add(how_.placed(cast.ray.origin));
    } else if (&row == &results::direction) {
      values.add(how_.turned(how_.localFromWorld, cast.ray.direction, false));
    } else if (&row == &results::point) {
      values.add(how_.placed(cast.point.position));
    } else if (&row == &placeRow()) {
      values.addCount(isPoint ? 1 : 0);
      if (isPoint) addPlace(cast.point.position, values);
    } else if (&row == &results::pointDistance) {
      values.add(cast.point.viewDistance);
    } else if (&row == &results::azimuth || &row == &results::elevation) {
      const Bearing bearing = cast.from.knowsUp
                                  ? bearingOf(cast.ray.direction, cast.camera.pose().eye(), cast.from.worldIsEcef)
                                  : Bearing{NAN, NAN};
      values.add(&row == &results::azimuth ? bearing.azimuth : bearing.elevation);
    } else if (&row == &results::range) {
      values.add(apart(cast.point.position, cast.camera.pose().eye()));
    } else if (&row == &results::bound) {
      values.add(isPoint ? cast.point.bound : NAN);
    } else if (&row == &results::undistorted) {
      values.add(undistorted(cast));
    } else {
      const std::size_t count = how_.allHits ? cast.hits.size() : std::min<std::size_t>(cast.hits.size(), 1);
      values.addCount(count);
      for (std::size_t i = 0; i < count; ++i) addHit(cast.hits[i], values);
    }
  }

  static Vec2 undistorted(const Cast& cast) {
    if (!lensOf(cast.camera)) return cast.pixel.screen.value_or(Vec2{NAN, NAN});
    const Vec3& d = cast.ray.direction;
    const ScreenPoint straight = worldToScreen(withoutLens(cast.camera), Vec4{d.x, d.y, d.z, 0});
    return {straight.x, straight.y};
  }

  static void addPlace(const Vec3& point, ResultValues& values) {
    const Geodetic place = ecefToGeodetic(point);
    for (const double number : {place.lat, place.lon, place.height}) values.add(number);
    if (hasGeoid()) values.add(place.height - seaLevelAt(place.lat, place.lon));
  }

  void addHit(const SceneHit& hit, ResultValues& values) const {
    values.addWord(hit.object->id);
    values.add(hit.hit.distance);
    values.add(how_.placed(hit.hit.point));
    values.add(how_.turned(how_.worldFromLocal, hit.hit.normal, true));
    if (!how_.allHits && !how_.placesHits()) return;
    const bool isPlace = how_.worldIsEcef || isOfTheEarth(*hit.object);
    addPlace(isPlace ? hit.hit.point : Vec3{NAN, NAN, NAN}, values);
  }

  const Casting& how_;
  bool isFixed_;                    ///< all records get the same results, with or without a point
  ResultRows pointless_, pointed_;  ///< of records without and with a distance
  std::vector<Pixel> pixels_;
  std::vector<Vec2> screens_;  ///< NaN where a record has none
  std::vector<Ray> rays_;
  std::vector<const RecordCamera*> cameras_;
};

/// A pixel of the command line as a JSON record; a distance by its name.
GivenRecord readPixel(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('='), comma = text.rfind(',', equals);
  const bool isNamed = equals != std::string::npos && comma != std::string::npos;
  const std::vector<double> n = readPixelNumbers(option, isNamed ? text.substr(0, comma) : text);
  std::string json = "{\"screen\":[" + formatNumber(n[0]) + "," + formatNumber(n[1]) + "]";
  if (n.size() > 2) json += ",\"depth\":" + formatNumber(n[2]);
  if (isNamed) {
    const std::string name = text.substr(comma + 1, equals - comma - 1);
    const auto value = parseNumber(text.substr(equals + 1));
    if (!value || n.size() > 2 || (name != "depth" && name != "viewDistance" && name != "range"))
      throw UsageError(option + " " + text + ": expected X,Y,viewDistance=D, X,Y,range=R or X,Y,depth=DEPTH");
    json += ",\"" + name + "\":" + formatNumber(*value);
  }
  return {option + " " + text, json + "}"};
}

/// What --fields can name: all that `ray` writes, of a hit the one name. Those of the scene are settled once it is
/// read.
constexpr const ResultRow* kFields[] = {&results::origin,    &results::direction,     &results::point,
                                        &results::place,     &results::pointDistance, &results::azimuth,
                                        &results::elevation, &results::range,         &results::bound,
                                        &results::hit,       &results::undistorted};

Names<const ResultRow*> fieldNames() {
  Names<const ResultRow*> names;
  for (const ResultRow* row : kFields) names.emplace_back(row->name, row);
  return names;
}

struct Options {
  CameraOptions camera;
  RecordCameraOptions cameras;
  StreamOptions stream;
  std::optional<Several<const ResultRow*>> fields;
  std::vector<GivenRecord> pixels;
  std::optional<std::string> scene;
  std::vector<std::string> models;
  std::vector<PlaneEquation> planes;
  GroundHeight height;
  bool allHits = false;
};

bool needsUp(const ResultRow& row) { return &row == &results::azimuth || &row == &results::elevation; }

/// Throws UsageError for those that need what is not there; of all, those are left out.
void settleFields(Casting& how, const Several<const ResultRow*>& fields, bool knowsUp) {
  how.fields = fields.named;
  if (fields.all)
    for (const ResultRow* row : kFields)
      if ((row != &results::place || how.worldIsEcef) && (row != &results::hit || how.scene) &&
          (!needsUp(*row) || knowsUp))
        how.fields->push_back(row);
  const auto hasAnyOf = [&](const ResultRows& rows) {
    return std::find_first_of(how.fields->begin(), how.fields->end(), rows.begin(), rows.end()) != how.fields->end();
  };
  if (how.allHits && !hasAnyOf({&results::hit})) throw UsageError("--all-hits is for hit, and --fields leaves it out");
  if (how.scene &&
      !hasAnyOf({&results::hit, &results::point, &results::place, &results::pointDistance, &results::range}))
    throw UsageError(
        "--scene, --plane and --height are for hit, point, place, viewDistance and range; --fields has none of them");
  for (const ResultRow*& row : *how.fields) {
    if (row == &results::place && !how.worldIsEcef)
      throw UsageError(
          "--fields place needs a camera that stands on the Earth; --set world=ecef says that records' cameras do");
    if (row == &results::place) row = &placeRow();
    if (row != &results::hit) continue;
    if (!how.scene) throw UsageError("--fields hit needs --scene, --plane or --height");
    row = &how.hits();
  }
}

int run(const Options& o) {
  const bool hasScene = o.scene || !o.planes.empty() || o.height.isTyped();
  if (!hasScene && o.allHits) throw UsageError("--all-hits needs --scene, --plane or --height");
  StreamSetup setup = o.stream.setup(kPixelColumns);
  setup.given = o.pixels;
  o.stream.reads(setup);
  const RecordCameras cameras = o.cameras.read(o.camera, setup, [&](const CameraFile& file) {
    if (!o.fields) return;
    for (const ResultRow* row : o.fields->named)
      if (needsUp(*row)) requireUp(file, "--fields " + std::string(row->name));
  });
  const bool worldIsEcef = cameras.worldIsEcef();
  Casting how{.columns = setup.columns, .worldIsEcef = worldIsEcef, .allHits = o.allHits};
  if (!o.models.empty()) {
    how.worldFromLocal = readModel(o.models);
    how.localFromWorld = inverseOfAffine(*how.worldFromLocal);
    if (!how.localFromWorld) throw UsageError("--model: has no inverse, so that no point of the world is in it");
  }
  if (hasScene) {
    if (!o.planes.empty() && worldIsEcef)
      throw UsageError(
          "--plane is of Earth-centred x, y, z with a camera on the Earth; --height 545 is the surface of that height");
    how.scene.emplace();
    if (o.scene) how.scene = readScene(*o.scene, worldIsEcef);
    const auto next = [&] { return std::to_string(how.scene->size()); };
    if (o.height.isTyped()) how.scene->push_back(o.height.surface(next(), worldIsEcef, cameras.first()));
    for (const PlaneEquation& plane : o.planes) how.scene->push_back({next(), plane});
    for (const SceneObject& object : *how.scene) how.sceneHasEllipsoid |= isOfTheEarth(object);
  }
  if (o.fields) settleFields(how, *o.fields, !cameras.first() || knowsUp(*cameras.first()));
  setup.arrayName = "screen";
  setup.arraySize = 2;
  setup.extraName = "depth";
  return runFilter(setup, cameras, [&](OutputForm to) { return std::make_unique<Caster>(how, to); });
}

}  // namespace

Action declareRay(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  describe(
      app,
      "The ray of each pixel, and the point: at the pixel's depth if it has one, else the nearest hit; `hit` says what "
      "was hit. Outside the lens all are null.",
      "Examples:\n"
      "  viewproj ray --position 0,0,9 --target 0,0,0 --fov-y 60 --viewport 640x480 \\\n"
      "    --pixel 320,240 --plane z=0\n"
      "  viewproj ray --fx 600 --fy 600 --cx 320 --cy 240 --viewport 640x480 \\\n"
      "    --world-from-camera '1,0,0.5 rpy:-90,0,0' --pixel 400,300,viewDistance=0.8");
  o->stream.add(app, "pixels");
  addValues(app, "--pixel", "X,Y[,DEPTH]", o->pixels, readPixel, "A pixel, in place of FILE");
  addScene(app, o->scene, "Shapes to hit");
  addValues(app, "--plane", "z=0|A,B,C,D", o->planes, readPlaneArgument, "A plane: x=, y=, z= or ax+by+cz+d=0");
  o->height.add(app, "Hit the Earth's surface of this height, or z = H");
  addFlag(app, "--all-hits", o->allHits, "Every hit, nearest first");
  const auto readFields = [](const std::string& option, const std::string& text) {
    return chooseSeveral(option, text, fieldNames());
  };
  addValue(app, "--fields", "NAMES", o->fields, readFields,
           withNames("Results, or all", known(fieldNames()), "origin, direction, point, hit"));
  addModel(app, o->models, "Results, but distances, in the model's coordinates");
  o->camera.takeAnySize();
  o->camera.add(app);
  o->camera.addReversed(app);
  o->cameras.add(app, false);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
