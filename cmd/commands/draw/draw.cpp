// viewproj draw: an SVG of what the camera sees.
#include "commands/command.hpp"
#include "commands/draw/picture.hpp"
#include "commands/draw/records.hpp"
#include "commands/options.hpp"
#include "commands/output_option.hpp"
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
  if (o.camera.lists()) return o.camera.list();
  FilterSetup setup = o.stream.setup(kPointColumns);
  setup.note = [&](const std::string& note) { o.camera.notes().say(note); };
  const bool reads = o.stream.reads(setup, o.camera, {"the scene", isStandardInput(o.scene)});
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

Action defineDraw(CommandLine& line) {
  const auto o = std::make_shared<Options>();
  line.setDescription(
      "An SVG of what the camera sees: points under their id or name, segments, boxes, triangles and spheres, and "
      "where pixels hit a scene.");
  line.setExample(
      "viewproj draw -c samples/a-picture-of-a-harbour/camera.json samples/a-picture-of-a-harbour/points.ndjson \\\n"
      "  --scene samples/a-picture-of-a-harbour/scene.json --pixel 700,250 > view.svg");
  o->camera.add(line);
  o->stream.addInput(line, "points and shapes");
  o->stream.addPoints(line);
  o->stream.addKeepGoing(line);
  addSceneOption(line, o->scene, ": its outlines are drawn");
  addValues(line, "--pixel", "X,Y", o->pixels, readPixel, "A pixel to mark, with --scene what its ray hits first");
  addOnlyForm(line, "SVG", ".svg");
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
