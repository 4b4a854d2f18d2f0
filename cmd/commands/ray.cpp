// viewproj ray: pixels to rays, and to the points behind them.
#include "viewproj/view/ray.hpp"

#include <array>
#include <limits>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/error.hpp"
#include "input/number.hpp"
#include "input/points.hpp"
#include "output/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::array<double, 3> toArray(const Vec3& v) { return {v.x, v.y, v.z}; }

/// The point behind the pixel, where the record tells how far away it is.
WorldPoint pointBehind(const Camera& camera, const Pixel& pixel) {
  const WorldPoint point = pixel.viewDistance ? screenToWorldAtDistance(camera, *pixel.screen, *pixel.viewDistance)
                                              : screenToWorld(camera, *pixel.screen, *pixel.depth);
  if (point.status != DepthStatus::beyond) return point;
  if (pixel.viewDistance)
    throw RecordError(0, "viewDistance " + formatNumber(*pixel.viewDistance) + " is not in front of the eye");
  throw RecordError(0, "depth " + formatNumber(*pixel.depth) + " lies beyond infinity, whose window depth is " +
                           formatNumber(camera.depthAtInfinity) + ": no point in front of the eye has it");
}

struct Casting {
  Camera camera;
  Precision arithmetic = Precision::exact;
  RayOrigin origin = RayOrigin::eye;
  bool wantBound = false;
  std::vector<std::string> columns;
};

class RayWork final : public RecordWork {
 public:
  explicit RayWork(const Casting& how) : how_(how) {}

  Layout find(const RecordParts& record) const override { return findPixel(record, how_.columns); }
  void nameResults(const Layout& layout, ResultSink& sink) const override {
    Pixel pixel;
    pixel.hasDistance = hasDistance(layout);
    writeRay(pixel, sink);
  }

  void add(const Layout& layout, const Numbers& numbers) override { pixels_.push_back(toPixel(layout, numbers)); }
  void write(std::size_t i, ResultSink& sink) override { writeRay(pixels_[i], sink); }
  void clear() override { pixels_.clear(); }

 private:
  void writeRay(const Pixel& pixel, ResultSink& sink) const {
    Ray ray{{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}};
    WorldPoint point{{kNaN, kNaN, kNaN}};
    if (pixel.screen) {
      ray = screenToRay(how_.camera, *pixel.screen, how_.arithmetic, how_.origin);
      if (pixel.depth || pixel.viewDistance) point = pointBehind(how_.camera, pixel);
    }
    sink.vector("origin", toArray(ray.origin));
    sink.vector("direction", toArray(ray.direction));
    if (!pixel.hasDistance && !sink.hasFixedColumns()) return;
    sink.vector("point", toArray(point.position));
    if (how_.wantBound) sink.number("bound", point.status == DepthStatus::point && pixel.screen ? point.bound : kNaN);
  }

  const Casting& how_;
  std::vector<Pixel> pixels_;
};

/// Pixels of the command line as JSON records.
std::vector<GivenRecord> recordsOf(const std::vector<std::string>& pixels) {
  std::vector<GivenRecord> records;
  for (const std::string& text : pixels) {
    const auto numbers = parseNumberList(text);
    if (!numbers || numbers->size() < 2 || numbers->size() > 3)
      throw UsageError("--pixel " + text + ": expected X,Y or X,Y,DEPTH");
    std::string json = "{\"screen\":[" + formatNumber((*numbers)[0]) + "," + formatNumber((*numbers)[1]) + "]";
    if (numbers->size() > 2) json += ",\"depth\":" + formatNumber((*numbers)[2]);
    records.push_back({"--pixel " + text, json + "}"});
  }
  return records;
}

}  // namespace

int runRay(int argc, char** argv) {
  CLI::App app(
      "Pixels to rays: origin and unit direction, and with a depth or viewDistance the point itself.\n"
      "Example: viewproj ray -c camera.json --pixel 640,360",
      "viewproj ray");
  CameraOptions camera;
  StreamOptions stream;
  PrecisionOption precision;
  std::vector<std::string> pixels;
  std::string from = "eye";
  bool wantBound = false;
  camera.add(app);
  stream.add(app, "pixels");
  precision.add(app);
  addRepeatable(app, "--pixel", pixels, "A pixel, in place of a file")->type_name("X,Y[,DEPTH]");
  app.add_option("--ray-from", from, "Where rays begin: eye (the plane through it) or near (the near plane)")
      ->type_name("PLACE");
  app.add_flag("--bound", wantBound,
               "Give each point's bound: how far it can be from the true one if its depth was rounded to double");
  parse(app, argc, argv);

  FilterSetup setup = stream.setup();
  setup.given = recordsOf(pixels);
  stream.requireOneInput(setup, camera);
  if (from != "eye" && from != "near") {
    static constexpr std::string_view kPlaces[] = {"eye", "near"};
    failUnknown("--ray-from", from, kPlaces);
  }
  // Rays are within kRayDirectionBound in standard already: fast and auto need nothing else.
  const bool exact = precision.value() == Precision::exact;
  const Casting how{.camera = makeCamera(camera.read()),
                    .arithmetic = exact ? Precision::exact : Precision::standard,
                    .origin = from == "near" ? RayOrigin::nearPlane : RayOrigin::eye,
                    .wantBound = wantBound,
                    .columns = stream.columns(2, 2)};
  setup.csvDefaults = {"x", "y", "depth"};
  if (!how.columns.empty()) setup.csvDefaults = how.columns;
  setup.writer.arrayName = "screen";
  setup.writer.arraySize = 2;
  setup.writer.extraName = "depth";
  const auto makeWork = [&] { return std::make_unique<RayWork>(how); };
  setup.writer.exampleResults = [&](ResultSink& sink) { makeWork()->nameResults({}, sink); };
  return runFilter(setup, makeWork);
}

}  // namespace viewproj::cmd
