// viewproj cull: what of points and shapes lies in the view.
#include <array>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/error.hpp"
#include "input/shapes.hpp"
#include "output/number.hpp"
#include "output/output_file.hpp"
#include "output/side_names.hpp"
#include "stream/filter.hpp"
#include "viewproj/view/frustum.hpp"

namespace viewproj::cmd {
namespace {

class CullWork final : public RecordWork {
 public:
  CullWork(const Frustum& frustum, const std::vector<std::string>& columns, bool worldIsEcef)
      : frustum_(frustum), columns_(columns), worldIsEcef_(worldIsEcef) {}

  Layout find(const RecordParts& record) const override { return findShape(record, columns_, worldIsEcef_); }
  void nameResults(const Layout&, ResultSink& sink) const override { writeCull({}, sink); }
  void add(const Layout& layout, const Numbers& numbers) override { shapes_.push_back(toShape(layout, numbers)); }
  void write(std::size_t i, ResultSink& sink) override {
    writeCull(std::visit([&](const auto& shape) { return cull(frustum_, shape); }, shapes_[i]), sink);
  }
  void clear() override { shapes_.clear(); }

 private:
  static void writeCull(const Cull& result, ResultSink& sink) {
    if (sink.isText()) throw UsageError("the results of cull are words, which have no place in text and f64");
    const bool inside = result.verdict == CullVerdict::inside, outside = result.verdict == CullVerdict::outside;
    sink.word("cull", inside ? "inside" : outside ? "outside" : "intersects");
    sink.word("plane", sideName(result.side));
  }

  const Frustum& frustum_;
  const std::vector<std::string>& columns_;
  bool worldIsEcef_;
  std::vector<CullShape> shapes_;
};

std::string planesAsJson(const Frustum& frustum) {
  std::string out;
  for (const FrustumPlane& plane : frustum) {
    out += (out.empty() ? "{\"" : ",\n \"") + std::string(sideName(plane.side)) + "\":[";
    const Vec4& e = plane.equation;
    out += formatNumber(e.x) + "," + formatNumber(e.y) + "," + formatNumber(e.z) + "," + formatNumber(e.w) + "]";
  }
  return out + "}\n";
}

}  // namespace

int runCull(int argc, char** argv) {
  CLI::App app(
      "Which points, spheres, boxes and triangles lie in the view: inside, intersects or outside, and by which plane.\n"
      "Example: echo '{\"id\":1,\"sphere\":{\"center\":[0,1,2],\"radius\":3}}' | viewproj cull -c camera.json",
      "viewproj cull");
  CameraOptions camera;
  StreamOptions stream;
  bool planes = false;
  camera.add(app);
  stream.add(app, "points and shapes");
  app.add_flag("--planes", planes, "Print the view's planes [a,b,c,d], ax + by + cz + d >= 0 inside, and read nothing");
  parse(app, argc, argv);

  FilterSetup setup = stream.setup();
  if (!planes) stream.requireOneInput(setup, camera);
  const CameraFile file = camera.read();
  const Frustum frustum = viewFrustum(makeCamera(file));
  if (planes) {
    writeOutput(planesAsJson(frustum));
    return 0;
  }
  const std::vector<std::string> columns = stream.columns(3, 4);
  setup.csvDefaults = {"x", "y", "z", "w"};
  if (!columns.empty()) setup.csvDefaults = columns;
  setup.wordsOnly = true;
  setup.writer.arrayName = "position";
  const auto makeWork = [&] { return std::make_unique<CullWork>(frustum, columns, file.worldIsEcef); };
  setup.writer.exampleResults = [&](ResultSink& sink) { makeWork()->nameResults({}, sink); };
  return runFilter(setup, makeWork);
}

}  // namespace viewproj::cmd
