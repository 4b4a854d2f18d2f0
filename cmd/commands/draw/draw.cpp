// viewproj draw: an SVG of what the camera sees.
#include <CLI/CLI.hpp>

#include "commands/command.hpp"
#include "commands/draw/picture.hpp"
#include "commands/draw/records.hpp"
#include "commands/notes.hpp"
#include "commands/options.hpp"
#include "commands/stream_options.hpp"
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
  FilterSetup setup = o.stream.setup(kPointColumns);
  setup.note = note;
  const bool reads = o.stream.readsBeside(o.scene, setup, o.camera,
                                          o.pixels.empty() ? "" : "--pixel takes the place of; - reads it as well");

  const CameraFile file = o.camera.read();
  if (reads) o.stream.settleOnEarth(setup, file.worldIsEcef);
  View view{.camera = makeCamera(file)};
  const Frustum frustum = viewFrustum(view.camera);
  std::vector<SceneObject> scene;
  if (o.scene) {
    requireNear(file, "--scene");
    scene = readScene(*o.scene, file.worldIsEcef);
    addScene(view, frustum, scene);
  }
  const int status = reads ? addRecords(view, frustum, setup, file.worldIsEcef) : 0;
  for (const Vec2& pixel : o.pixels) addPixel(view, pixel, o.scene ? &scene : nullptr);
  writeOutput(pictureOf(view));
  return status;
}

}  // namespace

Action declareDraw(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "An SVG of what the camera sees: points under their id or name, segments, boxes, triangles and spheres, and "
      "where pixels hit a scene.");
  app.footer(
      "Example:\n"
      "  viewproj draw --position 3,2,5 --target 0,0,0 --fov-y 60 --near 0.1 \\\n"
      "    --viewport 640x480 --pixel 320,240 -o view.svg");
  o->stream.addInput(app, "points and shapes");
  addScene(app, o->scene, "its outlines are drawn");
  addValues(app, "--pixel", "X,Y", o->pixels, readPixel, "A pixel to mark, with --scene what its ray hits first");
  addOnlyForm(app, "SVG", ".svg");
  o->camera.add(app);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
