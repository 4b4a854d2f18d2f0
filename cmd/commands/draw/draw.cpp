// viewproj draw: an SVG of what the camera sees.
#include "commands/command.hpp"
#include "commands/draw/picture.hpp"
#include "commands/draw/records.hpp"
#include "commands/options.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/file.hpp"

namespace viewproj::cmd {
namespace {

std::vector<Vec2> readPixels(const std::vector<std::string>& texts) {
  std::vector<Vec2> pixels;
  for (const std::string& text : texts) {
    const std::vector<double> n = readNumbers("--pixel", text, 2, 2, "X,Y");
    pixels.push_back({n[0], n[1]});
  }
  return pixels;
}

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  std::vector<std::string> pixels;
  std::string scene;
};

int run(const Options& o, const CLI::App& app) {
  const std::vector<Vec2> pixels = readPixels(o.pixels);
  FilterSetup setup = o.stream.setup(kPointColumns);
  // With --pixel standard input is read only if asked for; with a scene also where something can be in it.
  const NamedInput ofScene{"the scene", o.scene == "-"};
  const bool isFree = !o.camera.fromStandardInput() && !ofScene.isStandard && !isTerminal();
  const bool reads = app.count("FILE") > 0 || (pixels.empty() && (o.scene.empty() || isFree));
  if (reads) {
    o.stream.requireOneInput(setup, o.camera, ofScene);
  } else {
    o.stream.requireNoInputOption(pixels.empty() ? "is not given" : "--pixel takes the place of; - reads it as well");
    requireOneStandardInput({{"the camera", o.camera.fromStandardInput()}, ofScene});
  }

  const CameraFile file = o.camera.read();
  if (reads) o.stream.settleOnEarth(setup, file.worldIsEcef);
  View view{.camera = makeCamera(file)};
  const Frustum frustum = viewFrustum(view.camera);
  std::vector<SceneObject> scene;
  if (!o.scene.empty()) {
    scene = readScene(o.scene);
    addScene(view, frustum, scene);
  }
  if (reads) addRecords(view, frustum, setup, file.worldIsEcef);
  for (const Vec2& pixel : pixels) addPixel(view, pixel, o.scene.empty() ? nullptr : &scene);
  writeOutput(pictureOf(view));
  return 0;
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
  app.add_option("--scene", o->scene, "Scene file, or the JSON itself: its outlines are drawn")->type_name("FILE");
  addRepeatable(app, "--pixel", o->pixels,
                "A pixel to mark, with --scene what its ray hits first; standard input is then read only for FILE -")
      ->type_name("X,Y");
  return [o, &app] { return run(*o, app); };
}

}  // namespace viewproj::cmd
