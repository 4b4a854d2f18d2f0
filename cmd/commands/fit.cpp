// viewproj fit: the camera that shows all of something.

#include "commands/command.hpp"
#include "commands/fitting.hpp"
#include "commands/stream_options.hpp"
#include "output/output_file.hpp"
#include "records/scene.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

enum class Means { place, lens, size };

void addScene(Fitting& fitting, const std::vector<SceneObject>& scene) {
  for (const SceneObject& object : scene)
    std::visit(
        [&](const auto& shape) {
          if constexpr (requires { fitting.add(shape); })
            fitting.add(shape);
          else
            throw InputError("--scene: object " + object.id +
                             " is no sphere, box or triangle, and has no place to fit");
        },
        object.shape);
}

struct FitOptions {
  CameraOptions camera;
  StreamOptions stream;
  std::optional<std::string> scene;
  std::optional<Means> by;
  double margin = 0.05;
};

/// "0.05" or "5%".
double readMargin(const std::string& option, const std::string& text) {
  const bool isPercent = text.ends_with('%');
  const auto number = parseNumber(isPercent ? text.substr(0, text.size() - 1) : text);
  const double share = number.value_or(-1) / (isPercent ? 100 : 1);
  if (!(share >= 0 && share < 0.5))
    throw UsageError(option + " " + text + ": expected a share from 0 to below 0.5, or a percentage below 50%");
  return share;
}

int runFit(const FitOptions& o) {
  StreamSetup setup = o.stream.setup(kSphereColumns);
  const bool reads = o.stream.reads(setup);
  const auto [cameras, pick] = o.camera.readAll();
  CameraFile file = o.camera.readOne(*cameras, cameras->choose(pick), true, BoxLack::sizeToo);
  // A box needs no picture; without one, or where it may be stretched, it is as tight across as it is upwards.
  const bool isBox = file.projection && file.projection->isOrthographic(), lacksPicture = isBox && !file.viewport;
  const bool isFree =
      isBox && (lacksPicture || file.reading.allowStretch) && !readValues(file.document).has("projection.aspect");
  if (lacksPicture) file.viewport = Viewport{.width = file.projection->aspect(), .height = 1};
  if (reads) o.stream.settleOnEarth(setup, file.worldIsEcef);
  requireStraightEdges(file, "fit");
  (void)makeCamera(file);  // names the part that it lacks
  const bool orthographic = file.projection->isOrthographic();
  if (o.by == (orthographic ? Means::lens : Means::size))
    throw UsageError(orthographic ? "--by fov is of a perspective; --by size changes an orthographic box alone"
                                  : "--by size is of an orthographic camera; --by fov opens a lens");
  Fitting fitting(file, o.margin, isFree);
  const PointReading reading{
      .columns = setup.columns, .worldIsEcef = file.worldIsEcef, .segments = true, .shapes = true, .radius = true};
  if (o.scene) addScene(fitting, readScene(*o.scene, file.worldIsEcef));
  const auto make = [](const NumberPlan& plan, const Numbers& n) {
    if (!isSegment(plan)) return std::vector{toShape(plan, n)};
    return std::vector<CullShape>{Vec3{n[0], n[1], n[2]}, Vec3{n[3], n[4], n[5]}};
  };
  const auto add = [&](const std::vector<CullShape>& shapes, const RecordView&, std::size_t) {
    for (const CullShape& shape : shapes) std::visit([&](const auto& one) { fitting.add(one); }, shape);
  };
  const int status = reads ? readEachPoint(setup, reading, make, add) : 0;
  const Document fitted = o.by == Means::lens || o.by == Means::size ? fitting.byWindow() : fitting.byPlace();
  writeOutput(o.camera.written(readCamera(fitted, file.reading)));
  return status;
}

}  // namespace

Action declareFit(CLI::App& app) {
  const auto o = std::make_shared<FitOptions>();
  describe(
      app,
      "The camera that shows all of it: points, segments, spheres, boxes and triangles of FILE, a scene, or both. The "
      "camera moves without turning, until all of it fits and is centred; with --by fov it stays, and its angle of "
      "view changes. An orthographic camera also gets the width, height, near and far that options do not give; with "
      "--by size it stays. Its box has the shape of --aspect or the viewport; with neither, or with --allow-stretch, "
      "it is tight on every side. Writes a camera file.",
      "Examples:\n"
      "  viewproj fit --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 640x480 --point 0,0,0 --point 9,1,0\n"
      "  printf 'x,y,z\\n1,1,1\\n0,2,0\\n' | viewproj fit --position 3,2,5 \\\n"
      "    --target 0,0,0 --fov-y 60 --viewport 640x480 --margin 10%");
  o->stream.addPoints(app);
  addScene(app, o->scene, "Shapes to fit");
  static constexpr std::pair<std::string_view, Means> kMeans[] = {
      {"place", Means::place}, {"fov", Means::lens}, {"size", Means::size}};
  addChoice(app, "--by", "WHAT", o->by, rowsOf(kMeans), "What changes", "place");
  addValue(app, "--margin", "SHARE", o->margin, readMargin,
           "Share of the picture to leave free on each side, as in 0.05 or 5% (default: 0.05)");
  o->stream.addInput(app, "points and shapes");
  o->camera.add(app);
  addOnlyForm(app, "a camera file", ".json");
  return [o] {
    if (o->by.value_or(Means::place) == Means::place) o->camera.takeAnyPosition();
    return runFit(*o);
  };
}

}  // namespace viewproj::cmd
