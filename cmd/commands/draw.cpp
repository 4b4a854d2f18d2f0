// viewproj draw: an SVG of what the camera sees.
#include <CLI/CLI.hpp>
#include <type_traits>

#include "commands/command.hpp"
#include "commands/picture.hpp"
#include "commands/stream_options.hpp"
#include "output/output_file.hpp"
#include "records/scene.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// JSON text, a string without its quotes.
std::string labelOfJson(std::string_view value) {
  return visible(value.starts_with('"') ? unescaped(value.substr(1, value.size() - 2)) : std::string(value));
}

/// By its id or name, else by its number counted from 1.
std::string labelOf(const RecordView& record, std::size_t number) {
  for (const char* name : {"id", "name"})
    if (const auto field = record.schema->find(name)) {
      const std::string label = visible(plainText(record, *field));
      const bool isNull = record.schema->form == Form::json && record.values[*field] == "null";
      if (!label.empty() && isUtf8(label) && !isNull) return label;
    }
  return std::to_string(number);
}

using Drawn = std::variant<Vec4, std::array<Vec3, 2>, Sphere, Box, Triangle>;

Drawn toDraw(const NumberPlan& plan, const Numbers& n) {
  if (isPoint(plan)) return toPoint(plan, n);
  if (isSegment(plan)) return std::array{Vec3{n[0], n[1], n[2]}, Vec3{n[3], n[4], n[5]}};
  return std::visit(
      [](const auto& shape) -> Drawn {
        if constexpr (requires { shape.x; })
          return Vec4{shape.x, shape.y, shape.z, 1};
        else
          return shape;
      },
      toShape(plan, n));
}

/// Planes have no outline.
void drawObject(Picture& picture, const SceneObject& object) {
  const std::string label = labelOfJson(object.id);
  if (const auto* surface = std::get_if<HeightSurface>(&object.shape))
    return picture.add(label, Ellipsoid{kWgs84.equatorial + surface->height, kWgs84.polar + surface->height});
  std::visit(
      [&](const auto& shape) {
        if constexpr (requires { picture.add(label, shape); }) picture.add(label, shape);
      },
      object.shape);
}

/// What the pixel's ray hits first.
std::string hitLabel(const Camera& camera, const Vec2& pixel, const std::vector<SceneObject>& scene) {
  const std::vector<SceneHit> hits = hitsOf(camera, screenToRay(camera, pixel), scene);
  if (hits.empty()) return "no hit";
  return labelOfJson(hits[0].object->id) + " at " + formatDigits(hits[0].hit.distance, 6);
}

struct DrawOptions {
  CameraOptions camera;
  StreamOptions stream;
  std::vector<Vec2> pixels;
  std::optional<std::string> scene;
};

int runDraw(const DrawOptions& o) {
  StreamSetup setup = o.stream.setup(kPointColumns);
  const bool reads = o.stream.reads(setup);
  const CameraFile file = o.camera.read();
  if (reads) o.stream.settleOnEarth(setup, file.worldIsEcef);
  Picture picture(makeCamera(file));
  std::vector<SceneObject> scene;
  if (o.scene) {
    requireNear(file, "--scene");
    scene = readScene(*o.scene, file.worldIsEcef);
    for (const SceneObject& object : scene) drawObject(picture, object);
  }
  const PointReading reading{
      .columns = setup.columns, .worldIsEcef = file.worldIsEcef, .segments = true, .shapes = true};
  std::size_t count = 0;
  const auto make = [&](const NumberPlan& plan, const Numbers& numbers) {
    if (!isPoint(plan) && !file.lens && !hasDepth(*file.projection))
      throw RecordError(0, "a shape needs a camera with near; --near gives it");
    return toDraw(plan, numbers);
  };
  const auto draw = [&](const Drawn& drawn, const RecordView& record, std::size_t) {
    const std::string label = labelOf(record, ++count);
    std::visit([&](const auto& what) { picture.add(label, what); }, drawn);
  };
  const int status = reads ? readEachPoint(setup, reading, make, draw) : 0;
  for (const Vec2& pixel : o.pixels)
    picture.addPixel(
        o.scene ? hitLabel(picture.camera(), pixel, scene) : formatNumber(pixel.x) + ", " + formatNumber(pixel.y),
        pixel);
  const Viewport& v = *file.viewport;
  writeOutput(picture.svg(formatNumber(v.width) + " x " + formatNumber(v.height) + " pixels from the " +
                          (v.origin == Origin::topLeft ? "top" : "bottom") + " left"));
  return status;
}

}  // namespace

Action declareDraw(CLI::App& app) {
  const auto o = std::make_shared<DrawOptions>();
  app.description(
      "An SVG of what the camera sees: points under their id, name or number, segments, boxes, triangles and spheres "
      "of FILE and of a scene, and what the rays of pixels hit.");
  app.footer(
      "Examples:\n"
      "  viewproj draw --position 3,2,5 --target 0,0,0 --fov-y 60 --near 0.1 \\\n"
      "    --viewport 640x480 --point 0,0,0 --point 1,1,1 -o view.svg\n"
      "  printf 'x,y,z\\n1,1,1\\n0,2,0\\n' |\n"
      "    viewproj draw --position 3,2,5 --target 0,0,0 --fov-y 60 --viewport 640x480");
  o->stream.addPoints(app);
  addValues(app, "--pixel", "X,Y", o->pixels, readPixelPosition,
            "A pixel to mark, and with --scene what its ray hits first");
  addScene(app, o->scene, "Shapes to draw");
  o->stream.addInput(app, "points and shapes");
  o->camera.add(app);
  addOnlyForm(app, "SVG", ".svg");
  return [o] { return runDraw(*o); };
}

}  // namespace viewproj::cmd
