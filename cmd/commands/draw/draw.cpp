// viewproj draw: an SVG of what the camera sees.
#include "commands/command.hpp"
#include "commands/draw/picture.hpp"
#include "commands/draw/records.hpp"
#include "commands/options.hpp"
#include "commands/output_option.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/file.hpp"

namespace viewproj::cmd {
namespace {

Vec2 readPixel(const std::string& option, const std::string& text) {
  const std::vector<double> n = readNumbers(option, text, 2, 2, "X,Y");
  return {n[0], n[1]};
}

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  std::vector<Vec2> pixels;
  std::optional<std::string> scene;
};

int run(const Options& o) {
  if (o.camera.lists()) return o.camera.list();
  FilterSetup setup = o.stream.setup(kPointColumns);
  setup.note = [&](const std::string& note) { o.camera.notes().say(note); };
  // With --pixel standard input is read only if asked for; with a scene also where something can be in it.
  const NamedInput ofScene{"the scene", isStandardInput(o.scene)};
  const bool isFree = !o.camera.fromStandardInput() && !ofScene.isStandard && !isTerminal();
  const bool reads = o.stream.hasFile() || (o.pixels.empty() && (!o.scene || isFree));
  if (reads) {
    o.stream.requireOneInput(setup, o.camera, ofScene);
  } else {
    o.stream.requireNoInputOption(o.pixels.empty() ? "is not given" : "--pixel takes the place of; - reads it as well");
    requireOneStandardInput({{"the camera", o.camera.fromStandardInput()}, ofScene});
  }

  const CameraFile file = o.camera.read();
  if (reads) o.stream.settleOnEarth(setup, file.worldIsEcef);
  View view{.camera = makeCamera(file)};
  const Frustum frustum = viewFrustum(view.camera);
  std::vector<SceneObject> scene;
  if (o.scene) {
    scene = readScene(*o.scene);
    addScene(view, frustum, scene);
  }
  const int status = reads ? addRecords(view, frustum, setup, file.worldIsEcef) : 0;
  for (const Vec2& pixel : o.pixels) addPixel(view, pixel, o.scene ? &scene : nullptr);
  writeOutput(pictureOf(view));
  return status;
}

}  // namespace

Action defineDraw(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "An SVG of what the camera sees: points under their id or name, segments, boxes, triangles and spheres, and "
      "where pixels hit a scene.");
  app.footer(
      "viewproj draw -c samples/a-picture-of-a-harbour/camera.json samples/a-picture-of-a-harbour/points.ndjson \\\n"
      "  --scene samples/a-picture-of-a-harbour/scene.json --pixel 700,250 > view.svg");
  o->camera.add(app);
  o->stream.addInput(app, "points and shapes");
  o->stream.addKeepGoing(app);
  addSceneOption(app, o->scene, ": its outlines are drawn");
  addValues(app, "--pixel", "X,Y", o->pixels, readPixel,
            "A pixel to mark, with --scene what its ray hits first; standard input is then read only for FILE -");
  addOnlyForm(app, "SVG", ".svg");
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
