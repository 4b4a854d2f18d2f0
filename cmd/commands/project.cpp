// viewproj project: world points to screen positions.
#include <algorithm>
#include <array>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/error.hpp"
#include "input/names.hpp"
#include "input/number.hpp"
#include "input/points.hpp"
#include "output/number.hpp"
#include "viewproj/view/clip.hpp"
#include "viewproj/view/screen.hpp"

namespace viewproj::cmd {
namespace {

enum class ResultField { screen, depth, viewDistance, visible, outside, ndc, clip, view, bound };

constexpr std::pair<std::string_view, ResultField> kFields[] = {
    {"screen", ResultField::screen},   {"depth", ResultField::depth},     {"viewDistance", ResultField::viewDistance},
    {"visible", ResultField::visible}, {"outside", ResultField::outside}, {"ndc", ResultField::ndc},
    {"clip", ResultField::clip},       {"view", ResultField::view},       {"bound", ResultField::bound},
};

struct Fields {
  std::vector<ResultField> wanted;
  bool outsideAlways = false;
};

Fields chooseFields(const std::string& list, bool asText) {
  using enum ResultField;
  if (list.empty())
    return {asText ? std::vector{screen, depth} : std::vector{screen, depth, viewDistance, visible, outside}};
  Fields fields;
  fields.outsideAlways = true;
  for (const std::string& name : splitList(list)) {
    std::vector<std::string_view> known;
    const std::size_t before = fields.wanted.size();
    for (const auto& [row, field] : kFields) {
      known.push_back(row);
      if (row == name) fields.wanted.push_back(field);
    }
    if (fields.wanted.size() == before) failUnknown("--fields", name, known);
    if (std::count(fields.wanted.begin(), fields.wanted.end(), fields.wanted.back()) > 1)
      throw UsageError("--fields: " + name + " is named twice");
  }
  return fields;
}

/// The names of what a point lies beyond, in the interface's order.
class Sides {
 public:
  explicit Sides(const ScreenPoint& p) {
    static constexpr std::pair<Side, std::string_view> kNames[] = {
        {sideLeft, "left"}, {sideRight, "right"}, {sideBottom, "bottom"},
        {sideTop, "top"},   {sideNear, "near"},   {sideFar, "far"},
    };
    if (p.status == PointStatus::behind) names_[count_++] = "behind";
    for (const auto& [side, name] : kNames)
      if (p.outside & side) names_[count_++] = name;
  }
  std::span<const std::string_view> names() const { return {names_.data(), count_}; }

 private:
  std::array<std::string_view, 6> names_;
  std::size_t count_ = 0;
};

void writeResults(const Fields& fields, const Camera& camera, const Convention& writing, const Vec4& point,
                  const ScreenPoint& p, ResultSink& sink) {
  for (ResultField field : fields.wanted) switch (field) {
      case ResultField::screen:
        sink.vector("screen", std::array{p.x, p.y});
        break;
      case ResultField::depth:
        sink.number("depth", p.depth);
        break;
      case ResultField::viewDistance:
        sink.number("viewDistance", p.viewDistance);
        break;
      case ResultField::visible:
        sink.flag("visible", p.visible());
        break;
      case ResultField::outside:
        sink.names("outside", Sides(p).names(), fields.outsideAlways);
        break;
      case ResultField::ndc: {
        const Vec3 ndc = worldToNdc(camera, point, writing);
        sink.vector("ndc", std::array{ndc.x, ndc.y, ndc.z});
        break;
      }
      case ResultField::clip: {
        const Vec4 clip = worldToClip(camera, point, writing);
        sink.vector("clip", std::array{clip.x, clip.y, clip.z, clip.w});
        break;
      }
      case ResultField::view: {
        const Vec3 view = worldToView(camera, point, writing);
        sink.vector("view", std::array{view.x, view.y, view.z});
        break;
      }
      case ResultField::bound:
        sink.number("bound", boundOfPoint(camera, point, p.precision).screen);
        break;
    }
}

/// Points of the command line as JSON records.
std::vector<GivenRecord> recordsOf(const std::vector<std::string>& points) {
  std::vector<GivenRecord> records;
  for (const std::string& text : points) {
    const auto numbers = parseNumberList(text);
    if (!numbers || numbers->size() < 3 || numbers->size() > 4)
      throw UsageError("--point " + text + ": expected X,Y,Z or X,Y,Z,W");
    std::string json;
    for (double number : *numbers) json += (json.empty() ? "[" : ",") + formatNumber(number);
    records.push_back({"--point " + text, json + "]"});
  }
  return records;
}

}  // namespace

int runProject(int argc, char** argv) {
  CLI::App app(
      "World points to screen positions.\n"
      "Example: echo '{\"id\":1,\"x\":0,\"y\":1,\"z\":2}' | viewproj project -c camera.json",
      "viewproj project");
  CameraOptions camera;
  StreamOptions stream;
  PrecisionOption precision;
  ToleranceOption tolerance;
  std::vector<std::string> points;
  std::string fieldList;
  camera.add(app);
  camera.addWriting(app);
  stream.add(app, "points");
  precision.add(app);
  tolerance.add(app);
  addRepeatable(app, "--point", points, "A point, in place of a file")->type_name("X,Y,Z[,W]");
  app.add_option("--fields", fieldList,
                 "Results to give: screen,depth,viewDistance,visible,outside,ndc,clip,view,bound")
      ->type_name("NAMES");
  parse(app, argc, argv);

  FilterSetup setup = stream.setup();
  setup.given = recordsOf(points);
  stream.requireOneInput(setup, camera);
  const CameraFile file = camera.read();
  const Camera built = makeCamera(file);
  const Convention writing = camera.writing(file);
  const std::optional<Precision> arithmetic = precision.value();
  if (arithmetic && tolerance.given()) throw UsageError("--tolerance is for --precision auto, which chooses by it");
  const Precision chosen = arithmetic ? *arithmetic : precisionWithin(built, tolerance.value());
  const std::vector<std::string> columns = stream.columns(3, 4);
  setup.csvDefaults = {"x", "y", "z", "w"};
  if (!columns.empty()) setup.csvDefaults = columns;
  setup.checkHeader = [&](const Record& header) { readPoint(header, columns); };
  setup.writer.arrayName = "position";
  Fields fields = chooseFields(fieldList, false);
  const Fields textFields = chooseFields(fieldList, true);
  const auto write = [&](const Vec4& point, ResultSink& sink) {
    const ScreenPoint p = arithmetic ? worldToScreen(built, point, chosen) : worldToScreenWithin(built, chosen, point);
    writeResults(sink.isText() ? textFields : fields, built, writing, point, p, sink);
  };
  setup.writer.exampleResults = [&](ResultSink& sink) { write({0, 0, 0, 1}, sink); };
  return runFilter(setup, [&](const Record& record, ResultSink& sink) { write(readPoint(record, columns), sink); });
}

}  // namespace viewproj::cmd
