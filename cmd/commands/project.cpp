// viewproj project: world points to screen positions.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "commands/command.hpp"
#include "commands/stream_options.hpp"
#include "output/results.hpp"
#include "records/model.hpp"
#include "records/points.hpp"
#include "records/scene.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Rows = std::vector<const PointResult*>;

bool isIn(const Rows& rows, const ResultRow& row) {
  return std::any_of(rows.begin(), rows.end(), [&](const PointResult* one) { return one->row.name == row.name; });
}

/// The results to write.
struct Fields {
  Rows named, numbers;  ///< numbers: in text and f64, where names have no place
  Rows ofShapes;        ///< in place of named; empty where --fields names results
};

/// Without --fields, the usual ones.
Fields fieldsOf(const std::optional<Several<const PointResult*>>& chosen) {
  if (chosen && !chosen->all) return {chosen->named, chosen->named, {}};
  Fields fields;
  for (const PointResult& result : pointResults()) {
    const ResultRow& row = result.row;
    const bool isBox = row.name == results::screenBox.name;  // of shapes alone
    if (chosen ? !isBox : row.byDefault != Default::never) fields.named.push_back(&result);
    if (chosen ? !isBox && numbersOf(row) > 0 : row.byDefault == Default::everywhere) fields.numbers.push_back(&result);
    if (isBox) fields.ofShapes.insert(fields.ofShapes.begin(), &result);
    if (row.name == results::visible.name || row.name == results::outside.name) fields.ofShapes.push_back(&result);
  }
  return fields;
}

Names<const PointResult*> fieldNames() {
  Names<const PointResult*> names;
  for (const PointResult& result : pointResults()) names.emplace_back(result.row.name, &result);
  return names;
}

std::string helpOnFields() {
  std::vector<std::string_view> usual;
  for (const PointResult* result : fieldsOf({}).named) usual.push_back(result->row.name);
  return withNames("Results, in this order, or all", known(fieldNames()), joined(usual));
}

struct Projecting {
  Camera camera;
  Convention writing;  ///< of ndc, clip and view
  Precision precision;
  PointReading reading;
  Fields fields;
  bool hasDepth = true;
  bool hasUsualNumbers = true;              ///< in text and f64
  std::optional<Mat4> worldFromLocal = {};  ///< of a model that the points are in
  std::optional<Frustum> frustum = {};      ///< for segments and shapes; nothing where a lens bends its edges
};

/// Of a camera without near. Throws for results of depth that --fields names; from all and the usual ones, those that
/// would be null are left out.
void leaveDepthOut(Projecting& how, const CameraFile& file) {
  how.hasDepth = false;
  const auto needsNear = [](const PointResult* result) {
    return result->row.name == results::ndc.name || result->row.name == results::clip.name;
  };
  for (const PointResult* result : how.fields.named)
    if (how.fields.ofShapes.empty() && (needsNear(result) || result->row.name == results::depth.name))
      requireNear(file, "--fields " + std::string(result->row.name));
  for (auto* rows : {&how.fields.named, &how.fields.numbers}) std::erase_if(*rows, needsNear);
}

/// A segment among the points.
struct Segment {
  Vec3 a, b;
};

/// What of the world a screen position and a distance speak of is no single point.
constexpr ScreenPoint kNoPoint{.x = kNaN, .y = kNaN, .depth = kNaN, .viewDistance = kNaN};

/// The sides of the picture beyond which all of a rectangle lies.
std::uint8_t sidesBeyond(const Camera& camera, const ScreenBox& box) {
  return static_cast<std::uint8_t>(viewproj::sidesBeyond(camera, Vec2{box.left, box.top}) &
                                   viewproj::sidesBeyond(camera, Vec2{box.right, box.bottom}));
}

/// Zero times a number is zero, and NaN of what is not finite: no branch for each.
bool areFinite(std::span<const Vec3> points) {
  double zero = 0;
  for (const Vec3& p : points) zero += 0 * p.x + 0 * p.y + 0 * p.z;
  return zero == 0;
}

/// How many from the start are points in range whose numbers on the screen exist or are NaN. What overflowed has no
/// value: the writer knows what becomes of it.
std::size_t countUsable(const Camera& camera, std::span<const Vec3> points, std::span<const Vec3> screen) {
  if (areFinite(screen)) return screen.size();  // then so are the points
  const auto overflowed = [](const Vec3& p) { return std::isinf(p.x) || std::isinf(p.y) || std::isinf(p.z); };
  std::size_t i = 0;
  const auto isUsable = [&](const Vec3& p) { return isInRange(camera, Vec4{p.x, p.y, p.z, 1}); };
  while (i < screen.size() && isUsable(points[i]) && !overflowed(screen[i])) ++i;
  return i;
}

class ProjectWork final : public RecordWork {
 public:
  explicit ProjectWork(const Projecting& how) : how_(how) {}

  Layout find(const RecordParts& record) const override { return findPoint(record, how_.reading); }

  Results results(const Layout& layout, OutputForm form) const override {
    const bool numbers = form == OutputForm::text || form == OutputForm::f64;
    if (numbers && isSegment(layout))
      throw RecordError(0, "has a segment, whose results have no place in text and f64; write JSON or CSV");
    if (numbers && isShape(layout) && !isIn(how_.fields.named, results::screenBox))
      throw RecordError(0, "has a shape, for whose screenBox there is no place; --fields screenBox,visible makes it");
    if (isSegment(layout)) return {std::begin(results::kSegment), std::end(results::kSegment)};
    Results rows;
    for (const PointResult* result : rowsOf(isShape(layout), numbers)) rows.push_back(&result->row);
    return rows;
  }

  void add(const Layout& layout, const Numbers& n) override {
    Vec4 point{0, 0, 0, 1};
    bool isRounded = false;
    if (!isPoint(layout)) requireEdges(isSegment(layout) ? "a segment" : "a shape");
    if (isSegment(layout)) {
      const Segment segment{placed({n[0], n[1], n[2]}), placed({n[3], n[4], n[5]})};
      if (!isValid(Sphere{segment.a}) || !isValid(Sphere{segment.b})) throw RecordError(0, "has a number beyond 1e91");
      others_.push_back({points_.size(), segment});
    } else if (isShape(layout)) {
      if (how_.worldFromLocal) throw RecordError(0, "has a shape; --model places points and segments alone");
      const CullShape shape = toShape(layout, n);
      if (const auto* const sphere = std::get_if<Sphere>(&shape))
        point = {sphere->center.x, sphere->center.y, sphere->center.z, 1};
      others_.push_back({points_.size(), shape});
    } else {
      point = toPoint(layout, n);
      isRounded = how_.reading.worldIsEcef && mayBePlace(layout);
      if (how_.worldFromLocal) point = toWorld(*how_.worldFromLocal, point);
    }
    points_.push_back(point);
    positions_.push_back({point.x, point.y, point.z});
    errors_.push_back(isRounded ? placeError(positions_.back()) : 0);
  }

  void compute() override {
    screen_.resize(points_.size());
    worldToScreen(how_.camera, positions_, screen_, how_.precision);
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_[i].w != 1) screen_[i] = worldToScreen(how_.camera, points_[i], how_.precision);
  }

  void write(std::size_t i, ResultSink& sink) override {
    // Found by its number: of a record that could not be written, write was not called.
    const auto other = std::lower_bound(others_.begin(), others_.end(), i,
                                        [](const Other& one, std::size_t index) { return one.index < index; });
    if (other != others_.end() && other->index == i)
      writeOther(*other, sink);
    else if (screen_[i].status == PointStatus::outOfRange)
      throw RecordError(0, "lies farther than 1e91 from the eye");
    else
      writeFields(screen_[i], points_[i], sink, std::nullopt, rowsOf(false, sink.isText()), errors_[i]);
  }

  void clear() override {
    others_.clear();
    points_.clear();
    positions_.clear();
    errors_.clear();
  }

  std::size_t convert(std::span<const double> in, TextBuffer& out) override {
    if (!how_.hasUsualNumbers || how_.worldFromLocal) return 0;
    const std::size_t count = in.size() / 3;
    char* const room = out.room(count * sizeof(Vec3));
    const std::span points(reinterpret_cast<const Vec3*>(in.data()), count);
    const std::span screen(reinterpret_cast<Vec3*>(room), count);
    worldToScreen(how_.camera, points, screen, how_.precision);
    const std::size_t good = countUsable(how_.camera, points, screen);
    out.written(room + good * sizeof(Vec3));
    return good;
  }

 private:
  /// A segment or a shape, which was added as number index.
  struct Other {
    std::size_t index;
    std::variant<Segment, CullShape> what;
  };

  void requireEdges(const std::string& what) const {
    if (!how_.frustum)
      throw RecordError(
          0, what + " needs straight edges, which the lens bends; --ignore-distortion leaves its distortion out");
    if (!how_.hasDepth) throw RecordError(0, what + " needs a camera with near; --near gives it");
  }

  Vec3 placed(const Vec3& local) const {
    if (!how_.worldFromLocal) return local;
    const Vec4 world = toWorld(*how_.worldFromLocal, {local.x, local.y, local.z, 1});
    return {world.x, world.y, world.z};
  }

  void writeSegment(const Segment& whole, ResultSink& sink) const {
    VisibleSegment segment = clipSegment(*how_.frustum, whole.a, whole.b);
    constexpr SegmentEnd kNoEnd{.t = kNaN, .screen = {kNaN, kNaN}, .depth = kNaN, .viewDistance = kNaN};
    if (!segment.visible) segment.start = segment.end = kNoEnd;
    sink.flag(results::visible, segment.visible);
    const auto writeEnd = [&](const ResultRow& result, const SegmentEnd& end) {
      sink.object(result, segment.visible ? 1 : 0, [&](ResultSink& part, std::size_t) {
        part.number(results::t, end.t);
        part.vector(results::screen, end.screen);
        part.number(results::depth, end.depth);
        part.number(results::viewDistance, end.viewDistance);
        part.text(results::cutBy, sideName(end.side));
      });
    };
    writeEnd(results::start, segment.start);
    writeEnd(results::end, segment.end);
  }

  const Rows& rowsOf(bool isShape, bool numbers) const {
    if (isShape && !numbers && !how_.fields.ofShapes.empty()) return how_.fields.ofShapes;
    return numbers ? how_.fields.numbers : how_.fields.named;
  }

  void writeOther(const Other& other, ResultSink& sink) const {
    if (const auto* const segment = std::get_if<Segment>(&other.what)) return writeSegment(*segment, sink);
    const CullShape& shape = std::get<CullShape>(other.what);
    const auto box = std::visit(
        [&](const auto& one) -> std::optional<ScreenBox> {
          if constexpr (std::is_same_v<decltype(one), const Vec3&>)
            return std::nullopt;  // a point is none of these
          else
            return screenBox(how_.camera, one);
        },
        shape);
    const Cull verdict = std::visit([&](const auto& one) { return cull(*how_.frustum, one); }, shape);
    // Of a sphere what is of one point is its center's.
    const bool isSphere = std::holds_alternative<Sphere>(shape);
    ScreenPoint screen = isSphere ? screen_[other.index] : kNoPoint;
    screen.status = PointStatus::inFront;
    if (verdict.verdict == CullVerdict::outside)
      screen.outside = verdict.side;
    else
      screen.outside = box ? sidesBeyond(how_.camera, *box) : static_cast<std::uint8_t>(sideNear);
    const Vec4 point = isSphere ? points_[other.index] : Vec4{kNaN, kNaN, kNaN, 1};
    writeFields(screen, point, sink, box, rowsOf(true, sink.isText()));
  }

  void writeFields(const ScreenPoint& screen, const Vec4& point, ResultSink& sink, const std::optional<ScreenBox>& box,
                   const Rows& rows, double error = 0) const {
    const ProjectedPoint projected{how_.camera, how_.writing, point, screen, box, error};
    for (const PointResult* result : rows) result->write(result->row, projected, sink);
  }

  const Projecting& how_;
  std::vector<Vec4> points_;  ///< a segment or a shape has a place among them that is not used
  std::vector<Vec3> positions_;
  std::vector<double> errors_;  ///< how far each may be from the true one
  std::vector<Other> others_;
  std::vector<ScreenPoint> screen_;
};

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  Precision precision = Precision::exact;
  std::optional<Several<const PointResult*>> fields;
  std::optional<std::string> model;
};

int run(const Options& o) {
  // Then a point with a radius is a sphere.
  const bool asksForBoxes = o.fields && isIn(o.fields->named, results::screenBox);
  FilterSetup setup = o.stream.setup(asksForBoxes ? kSphereColumns : kPointColumns);
  o.stream.reads(setup);
  const CameraFile file = o.camera.read();
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  Projecting how{.camera = makeCamera(file),
                 .writing = o.camera.writing(file.convention),
                 .precision = o.precision,
                 .reading = {.columns = setup.columns,
                             .worldIsEcef = file.worldIsEcef,
                             .segments = true,
                             .shapes = true,
                             .radius = asksForBoxes},
                 .fields = fieldsOf(o.fields)};
  how.hasUsualNumbers = how.fields.numbers == fieldsOf({}).numbers;
  if (!lensOf(how.camera)) how.frustum = viewFrustum(how.camera);
  if (o.model) how.worldFromLocal = readModel(*o.model);
  if (!hasDepth(*file.projection)) leaveDepthOut(how, file);
  o.camera.noteHandedness(file);
  setup.writer.arrayName = "position";
  return runFilter(setup, [&] { return std::make_unique<ProjectWork>(how); });
}

}  // namespace

Action declareProject(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "World points to screen positions: each record of FILE with its pixel, depth and visibility appended.");
  app.footer(
      "Examples:\n"
      "  viewproj project --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 1280x720 --point 1,1,1\n"
      "  printf 'x,y,z\\n1,2,-9\\n' |\n"
      "    viewproj project --position 0,0,9 --target 0,0,0 --fov-y 60 --viewport 64x48");
  o->stream.add(app, "points");
  o->stream.addPoints(app);
  const auto readFields = [](const std::string& option, const std::string& text) {
    return chooseSeveral(option, text, fieldNames());
  };
  addValue(app, "--fields", "NAMES", o->fields, readFields, helpOnFields());
  addPrecision(app, o->precision);
  addModel(app, o->model, "Place in the world of the model that the points are in");
  o->camera.add(app);
  o->camera.addWriting(app);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
