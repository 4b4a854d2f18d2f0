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
  const RayOrigin origin = from == "near" ? RayOrigin::nearPlane : RayOrigin::eye;
  const Camera built = makeCamera(camera.read());
  // Rays are within kRayDirectionBound in standard already: fast and auto need nothing else.
  const Precision arithmetic = precision.value() == Precision::exact ? Precision::exact : Precision::standard;
  const std::vector<std::string> columns = stream.columns(2, 2);
  setup.csvDefaults = {"x", "y", "depth"};
  if (!columns.empty()) setup.csvDefaults = columns;
  setup.checkHeader = [&](const Record& header) { readPixel(header, columns); };
  setup.writer.arrayName = "screen";
  setup.writer.arraySize = 2;
  setup.writer.extraName = "depth";

  const auto write = [&](const Pixel& pixel, ResultSink& sink) {
    Ray ray{{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}};
    WorldPoint point{{kNaN, kNaN, kNaN}};
    if (pixel.screen) {
      ray = screenToRay(built, *pixel.screen, arithmetic, origin);
      if (pixel.depth || pixel.viewDistance) point = pointBehind(built, pixel);
    }
    sink.vector("origin", toArray(ray.origin));
    sink.vector("direction", toArray(ray.direction));
    if (!pixel.hasDistance && !sink.hasFixedColumns()) return;
    sink.vector("point", toArray(point.position));
    if (wantBound) sink.number("bound", point.status == DepthStatus::point && pixel.screen ? point.bound : kNaN);
  };
  setup.writer.exampleResults = [&](ResultSink& sink) { write({}, sink); };
  return runFilter(setup, [&](const Record& record, ResultSink& sink) { write(readPixel(record, columns), sink); });
}

}  // namespace viewproj::cmd
