// viewproj cull: what of points and shapes lies in the view.
#include <array>
#include <cmath>
#include <string>

#include "camera/camera.hpp"
#include "commands/command.hpp"
#include "commands/output_option.hpp"
#include "commands/stream_options.hpp"
#include "output/output_file.hpp"
#include "output/side_names.hpp"
#include "records/points.hpp"
#include "records/shapes.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

class CullWork final : public RecordWork {
 public:
  CullWork(const Frustum& frustum, const PointReading& reading) : frustum_(frustum), reading_(reading) {}

  Layout find(const RecordParts& record) const override { return findPoint(record, reading_); }
  Results results(const Layout&, OutputForm) const override {
    return {std::begin(results::kCull), std::end(results::kCull)};
  }
  void add(const Layout& layout, const Numbers& numbers) override { shapes_.push_back(toShape(layout, numbers)); }
  void write(std::size_t i, ResultSink& sink) override {
    writeCull(std::visit([&](const auto& shape) { return cull(frustum_, shape); }, shapes_[i]), sink);
  }
  void clear() override { shapes_.clear(); }

 private:
  static void writeCull(const Cull& result, ResultSink& sink) {
    const bool inside = result.verdict == CullVerdict::inside, outside = result.verdict == CullVerdict::outside;
    sink.word(results::cull, inside ? "inside" : outside ? "outside" : "intersects");
    sink.word(results::plane, sideName(result.side));
  }

  const Frustum& frustum_;
  const PointReading& reading_;
  std::vector<CullShape> shapes_;
};

/// Which names make which shape.
std::string helpOnShapes() {
  std::string columns, fields;
  for (const Coordinate* row : coordinates::kShapes) {
    fields += (fields.empty() ? "\"" : ", \"") + std::string(row->name) + "\": " + exampleOf(*row);
    const std::vector<std::string> names = columnsOf(*row);
    if (names.empty()) continue;
    columns += (columns.empty() ? "" : ", or ");
    for (std::size_t i = 0; i < names.size(); ++i) columns += (i > 0 ? "," : "") + names[i];
    columns += " (a " + std::string(row->name) + ")";
  }
  return "A shape is in JSON " + fields + "; in CSV the columns " + columns +
         ". A point (x,y,z, lat,lon,height or position) with a radius is a sphere too. With --columns, a radius is "
         "used if it is named: as radius=R, or by a fourth name that is radius. Planes decide one by one, so that a "
         "shape outside near a corner of the view may be called intersects.";
}

std::string planesAsJson(const Frustum& frustum) {
  std::string out;
  for (const FrustumPlane& plane : frustum.planes()) {
    out += (out.empty() ? "{\"" : ",\n \"") + std::string(sideName(plane.side)) + "\":[";
    const Vec4& e = plane.equation;
    out += formatNumber(e.x) + "," + formatNumber(e.y) + "," + formatNumber(e.z) + "," + formatNumber(e.w) + "]";
  }
  return out + "}\n";
}

/// The corners of the view, on near and, where far is not infinite, on far; or the directions to these.
std::string cornersAsJson(const Camera& camera) {
  static constexpr struct {
    std::string_view name;
    bool right, top;
  } kCorners[] = {
      {"BottomLeft", false, false}, {"BottomRight", true, false}, {"TopRight", true, true}, {"TopLeft", false, true}};
  const CameraParts& c = parts(camera);
  const bool down = c.viewport.origin == Origin::topLeft;
  JsonObject out;
  const auto pixel = [&](bool right, bool top) {
    return Vec2{right ? c.corners.last.x : c.corners.first.x, top == down ? c.corners.first.y : c.corners.last.y};
  };
  const auto add = [&](const std::string& name, const Vec3& v) {
    if (!isFinite(v)) throw InputError(name + " of the view is beyond the range of doubles");
    out.addText(name, jsonListOf(std::array{v.x, v.y, v.z}), ",\n ");
  };
  const auto addAt = [&](const char* plane, double distance) {
    for (const auto& [name, right, top] : kCorners)
      add(plane + std::string(name), screenToWorldAtDistance(camera, pixel(right, top), distance).position);
  };
  if (hasDepth(camera.projection())) addAt("near", c.projection.near);
  if (std::isfinite(c.projection.far))
    addAt("far", c.projection.far);
  else
    for (const auto& [name, right, top] : kCorners)
      add("direction" + std::string(name), screenToRay(camera, pixel(right, top)).direction);
  return out.text() + "\n";
}

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  bool planes = false, corners = false;
};

int run(const Options& o, const CommandLine& line) {
  if (o.camera.lists()) return o.camera.list();
  const char* const alone = o.planes ? "--planes" : "--corners";
  const bool readsNothing = o.planes || o.corners;
  if (line.has(kDigitsOption))
    throw UsageError(std::string(kDigitsOption) + " is of results that are numbers, and cull has none");
  if (o.planes && o.corners) throw UsageError("--planes and --corners are one JSON document each; ask for one of them");
  if (readsNothing)
    for (const Option& option : line.options())
      if (option.isGiven && (option.heading == kInput || option.heading == kOutput))
        throw UsageError(option.name() + " is for records, and with " + alone + " none are read");
  FilterSetup setup = o.stream.setup(kSphereColumns);
  if (const auto file = line.valueOf(kOutputOption); readsNothing && file)
    (void)formOfOutputName(*file, {{"JSON", ".json"}});
  if (!readsNothing) o.stream.requireOneInput(setup, o.camera);
  const CameraFile file = o.camera.read();
  const Frustum frustum = viewFrustum(makeCamera(file));
  if (readsNothing) {
    writeOutput(o.planes ? planesAsJson(frustum) : cornersAsJson(frustum.camera()));
    return 0;
  }
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  const PointReading reading{
      .columns = setup.columns, .worldIsEcef = file.worldIsEcef, .shapes = "culled", .radius = true};
  setup.note = [&](const std::string& note) { o.camera.notes().say(note); };
  setup.writer.arrayName = "position";
  return runFilter(setup, [&] { return std::make_unique<CullWork>(frustum, reading); });
}

}  // namespace

Action defineCull(CommandLine& line) {
  const auto o = std::make_shared<Options>();
  line.setDescription(
      "Which points, spheres, boxes and triangles lie in the view: inside, intersects or outside, and by which "
      "plane. " +
      helpOnShapes());
  line.setExample(
      "echo '{\"sphere\": {\"center\": [1, 1, 1], \"radius\": 0.5}}' |\n"
      "  viewproj cull -c samples/picking-a-pixel/camera.json");
  o->camera.add(line);
  o->stream.add(line, "points and shapes");
  line.addFlag("--planes", o->planes,
               "Print the view's planes [a,b,c,d], ax + by + cz + d >= 0 inside, and read nothing");
  line.addFlag("--corners", o->corners,
               "Print the view's corners on near and far, or where far is infinite the directions to these, and read "
               "nothing");
  return [o, &line] { return run(*o, line); };
}

}  // namespace viewproj::cmd
