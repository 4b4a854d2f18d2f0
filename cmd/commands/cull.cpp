// viewproj cull: what of points and shapes lies in the view.
#include <string>

#include "commands/command.hpp"
#include "commands/stream_options.hpp"
#include "output/results.hpp"
#include "records/points.hpp"
#include "records/shapes.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
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

struct Options {
  CameraOptions camera;
  StreamOptions stream;
};

int run(const Options& o, const CommandLine& line) {
  if (o.camera.lists()) return o.camera.list();
  if (line.has(kDigitsOption))
    throw UsageError(std::string(kDigitsOption) + " is of results that are numbers, and cull has none");
  FilterSetup setup = o.stream.setup(kSphereColumns);
  o.stream.requireOneInput(setup, o.camera);
  const CameraFile file = o.camera.read();
  const Frustum frustum = viewFrustum(makeCamera(file));
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
  return [o, &line] { return run(*o, line); };
}

}  // namespace viewproj::cmd
