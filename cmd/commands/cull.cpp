// viewproj cull: what of points and shapes lies in the view.
#include <string>

#include "commands/command.hpp"
#include "commands/record_camera_options.hpp"
#include "commands/stream_options.hpp"
#include "output/results.hpp"
#include "records/arguments.hpp"
#include "records/points.hpp"
#include "records/scene.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

class Culler final : public RecordProcessor {
 public:
  explicit Culler(const PointReading& reading) : reading_(reading) {}

  NumberPlan locate(const RecordView& record) const override { return findPoint(record, reading_); }
  ResultRows rows(const NumberPlan&) const override { return {std::begin(results::kCull), std::end(results::kCull)}; }
  void add(const NumberPlan& plan, const Numbers& numbers, const RecordCamera& camera) override {
    shapes_.push_back(numbers.isNull ? std::nullopt : std::optional(toShape(plan, numbers)));
    frustums_.push_back(&*camera.frustum);
  }
  void results(std::size_t i, ResultValues& values) override {
    Cull result;
    if (shapes_[i]) result = std::visit([&](const auto& shape) { return cull(*frustums_[i], shape); }, *shapes_[i]);
    const bool inside = result.verdict == CullVerdict::inside, outside = result.verdict == CullVerdict::outside;
    values.addWord(!shapes_[i] ? "" : inside ? "inside" : outside ? "outside" : "intersects");
    values.addWord(sideName(result.side));
    isVisible_ = shapes_[i] && !outside;
  }
  bool isVisible(std::size_t) const override { return isVisible_; }
  void clear() override {
    shapes_.clear();
    frustums_.clear();
  }

 private:
  const PointReading& reading_;
  std::vector<std::optional<CullShape>> shapes_;  ///< nothing: a point that is null
  std::vector<const Frustum*> frustums_;
  bool isVisible_ = false;  ///< the last one that had results
};

struct Options {
  CameraOptions camera;
  RecordCameraOptions cameras;
  StreamOptions stream;
  std::vector<GivenRecord> shapes;
};

int run(const Options& o) {
  StreamSetup setup = o.stream.setup(kSphereColumns);
  setup.given.insert(setup.given.end(), o.shapes.begin(), o.shapes.end());
  o.stream.reads(setup);
  const RecordCameras cameras =
      o.cameras.read(o.camera, setup, [](const CameraFile& file) { requireStraightEdges(file, "cull"); });
  o.stream.settleOnEarth(setup, cameras.worldIsEcef());
  const PointReading reading{.columns = setup.columns,
                             .worldIsEcef = cameras.worldIsEcef(),
                             .shapes = true,
                             .radius = true,
                             .besideCamera = cameras.areInRecords()};
  setup.arrayName = "position";
  setup.areWords = true;
  return runFilter(setup, cameras, [&](OutputForm) { return std::make_unique<Culler>(reading); });
}

}  // namespace

Action declareCull(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  describe(
      app,
      "Which points, spheres, boxes and triangles are inside the view: each record of FILE with cull (inside, "
      "intersects or outside) and plane (the plane that decides) appended. A point with a radius is a sphere. Planes "
      "are tested one by one: a shape outside near a corner of the view may be called intersects.",
      "Examples:\n"
      "  echo '{\"sphere\": {\"center\": [1, 1, -5], \"radius\": 0.5}}' |\n"
      "    viewproj cull --position 0,0,9 --target 0,0,0 --fov-y 60 --viewport 640x480\n"
      "  printf 'x,y,z,radius\\n1,2,-9,3\\n' |\n"
      "    viewproj cull --position 0,0,9 --target 0,0,0 --fov-y 60 --viewport 640x480");
  o->stream.add(app, "points and shapes");
  o->stream.addPoints(app);
  const auto shapeOf = [](std::string (*read)(const std::string&, const std::string&)) {
    return [read](const std::string& option, const std::string& text) {
      return GivenRecord{option + " " + text, read(option, text)};
    };
  };
  addValues(app, "--sphere", "X,Y,Z,R", o->shapes, shapeOf(readSphereArgument), "A sphere, in place of FILE");
  addValues(app, "--box", "X,Y,Z,X,Y,Z", o->shapes, shapeOf(readBoxArgument),
            "A box, from its lower to its upper corner, in place of FILE");
  removeOption(app, "--digits");
  o->camera.add(app);
  o->cameras.add(app, true);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
