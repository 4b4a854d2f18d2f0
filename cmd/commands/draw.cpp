// viewproj draw: an SVG of what the camera sees.
#include "commands/command.hpp"
#include "commands/options.hpp"
#include "draw/picture.hpp"
#include "draw/records.hpp"
#include "input/error.hpp"
#include "input/number.hpp"
#include "output/output_file.hpp"

namespace viewproj::cmd {
namespace {

std::vector<Vec2> readPixels(const std::vector<std::string>& texts) {
  std::vector<Vec2> pixels;
  for (const std::string& text : texts) {
    const auto numbers = parseNumberList(text);
    if (!numbers || numbers->size() != 2) throw UsageError("--pixel " + text + ": expected X,Y");
    pixels.push_back({(*numbers)[0], (*numbers)[1]});
  }
  return pixels;
}

}  // namespace

int runDraw(int argc, char** argv) {
  CLI::App app(
      "An SVG of what the camera sees: points under their id or name, segments, boxes, triangles and spheres, and\n"
      "where pixels hit a scene.\n"
      "Example: viewproj draw -c camera.json points.csv > view.svg",
      "viewproj draw");
  CameraOptions camera;
  StreamOptions stream;
  std::vector<std::string> pixelTexts;
  std::string sceneFile;
  camera.add(app);
  stream.addInput(app, "points and shapes");
  app.add_option("--scene", sceneFile, "Scene to draw the outlines of")->type_name("FILE");
  addRepeatable(app, "--pixel", pixelTexts, "A pixel to mark, with --scene what its ray hits first")->type_name("X,Y");
  parse(app, argc, argv);

  const std::vector<Vec2> pixels = readPixels(pixelTexts);
  const FilterSetup setup = stream.setup();
  const std::vector<std::string> columns = stream.columns(3, 4);
  // Where there is something else to draw, standard input is read only if asked for.
  const bool reads = app.count("FILE") > 0 || (pixels.empty() && sceneFile.empty());
  if (reads) stream.requireOneInput(setup, camera);

  const CameraFile file = camera.read();
  View view{.camera = makeCamera(file)};
  const Frustum frustum = viewFrustum(view.camera);
  std::vector<SceneObject> scene;
  if (!sceneFile.empty()) {
    scene = readScene(sceneFile);
    addScene(view, frustum, scene);
  }
  if (reads) {
    FilterSetup records = setup;
    records.csvDefaults = columns.empty() ? std::vector<std::string>{"x", "y", "z", "w"} : columns;
    addRecords(view, frustum, std::move(records), columns, file.worldIsEcef);
  }
  for (const Vec2& pixel : pixels) addPixel(view, pixel, sceneFile.empty() ? nullptr : &scene);
  writeOutput(pictureOf(view));
  return 0;
}

}  // namespace viewproj::cmd
